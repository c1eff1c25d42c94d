// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/tetrahedra/gmsh_library.h"

#include "wscvt/base/error.h"

#ifdef WSCVT_HAS_GMSH
#include <dlfcn.h>
#include <gmshc.h>
#include <sys/auxv.h>

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#endif

namespace wscvt {

#ifndef WSCVT_HAS_GMSH

void require_gmsh() {
  refuse(
      "This program was built without Gmsh, which makes tetrahedra. Install libgmsh-dev, and build "
      "it again.");
}

GmshVolume gmsh_volume(std::vector<double>, std::vector<std::size_t>, double) {
  require_gmsh();
  return {};
}

#else

namespace {

#define WSCVT_TEXT_OF(word) #word
#define WSCVT_TEXT(word) WSCVT_TEXT_OF(word)
/// The interface changes with the numbers, so only the library of the headers fits.
constexpr const char* library_name =
    "libgmsh.so." WSCVT_TEXT(GMSH_API_VERSION_MAJOR) "." WSCVT_TEXT(GMSH_API_VERSION_MINOR);
#undef WSCVT_TEXT
#undef WSCVT_TEXT_OF

/// Gmsh's functions by their names.
class Library {
 public:
  Library() : handle_(opened()) {
    if (!handle_) {
      refuse(std::string("Gmsh, which makes tetrahedra, is not there: ") + library_name +
             " cannot be opened. Install libgmsh-dev, or this version of Gmsh.");
    }
  }

  /// The address of a declared function would make the linker ask for the library.
  template <class Function>
  Function* of(const char* name) const {
    void* const found = dlsym(handle_.get(), name);
    if (found == nullptr) refuse(std::string(library_name) + " has no function " + name + ".");
    return reinterpret_cast<Function*>(found);
  }

 private:
  struct Close {
    // Gmsh leaves objects behind whose ends run with the program's.
    void operator()(void* /*handle*/) const {}
  };
  static void* opened() {
    // A program in one file has no loader that could bring the library's C library along.
    if (getauxval(AT_BASE) == 0) return nullptr;
    return dlopen(library_name, RTLD_NOW | RTLD_LOCAL);
  }
  std::unique_ptr<void, Close> handle_;
};

#define WSCVT_GMSH(library, name) (library).of<decltype(name)>(#name)

/// One use of Gmsh, from its initialization to its end.
class Session {
 public:
  explicit Session(const Library& library)
      : library_(library), end_(WSCVT_GMSH(library, gmshFinalize)) {
#if GMSH_API_VERSION_MAJOR > 4 || GMSH_API_VERSION_MINOR >= 9
    WSCVT_GMSH(library_, gmshInitialize)(0, nullptr, 0, 0, &error_);
#else
    WSCVT_GMSH(library_, gmshInitialize)(0, nullptr, 0, &error_);
#endif
    check();
  }
  ~Session() {
    int ignored = 0;
    end_(&ignored);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void set(const char* option, double value) {
    WSCVT_GMSH(library_, gmshOptionSetNumber)(option, value, &error_);
    check();
  }
  void fill(std::vector<double>& coordinates, std::vector<std::size_t>& corners, double edge);
  GmshVolume volume();

 private:
  void check() const {
    if (error_ == 0) return;
    char* words = nullptr;
    int ignored = 0;
    WSCVT_GMSH(library_, gmshLoggerGetLastError)(&words, &ignored);
    const std::string said = words == nullptr ? "no reason" : words;
    if (words != nullptr) WSCVT_GMSH(library_, gmshFree)(words);
    throw Error(ErrorCode::NumericalFailure, "Gmsh cannot fill the surface with tetrahedra (" +
                                                 said + "). Use another number of nodes.");
  }

  const Library& library_;
  void (*end_)(int*);
  int error_ = 0;
};

void Session::fill(std::vector<double>& coordinates, std::vector<std::size_t>& corners,
                   double edge) {
  set("General.Terminal", 0);
  set("General.NumThreads", 1);
  set("Mesh.MeshSizeMax", edge);
  // Algorithm 10 (HXT) leaves smallest angles of 21 to 25 degrees on 20 remeshes instead of 11 to
  // 21 by Delaunay, but other tetrahedra each time in one process. By default Gmsh improves only
  // tetrahedra of quality .3, which leaves angles of 12 degrees.
  set("Mesh.OptimizeThreshold", 0.5);
  WSCVT_GMSH(library_, gmshModelAdd)("grain", &error_);
  check();
  int surface = WSCVT_GMSH(library_, gmshModelAddDiscreteEntity)(2, -1, nullptr, 0, &error_);
  check();
  std::vector<std::size_t> tags;
  for (std::size_t i = 1; i <= coordinates.size() / 3; ++i) tags.push_back(i);
  WSCVT_GMSH(library_, gmshModelMeshAddNodes)
  (2, surface, tags.data(), tags.size(), coordinates.data(), coordinates.size(), nullptr, 0,
   &error_);
  check();
  for (std::size_t& corner : corners) ++corner;
  constexpr int triangle_type = 2;
  WSCVT_GMSH(library_, gmshModelMeshAddElementsByType)
  (surface, triangle_type, nullptr, 0, corners.data(), corners.size(), &error_);
  check();
  int loop = WSCVT_GMSH(library_, gmshModelGeoAddSurfaceLoop)(&surface, 1, -1, &error_);
  check();
  WSCVT_GMSH(library_, gmshModelGeoAddVolume)(&loop, 1, -1, &error_);
  check();
  WSCVT_GMSH(library_, gmshModelGeoSynchronize)(&error_);
  check();
  WSCVT_GMSH(library_, gmshModelMeshGenerate)(3, &error_);
  check();
  // Of twenty cells of a packing 13 had angles of 12 degrees without a second pass, 16 with it.
  WSCVT_GMSH(library_, gmshModelMeshOptimize)("", 1, 1, nullptr, 0, &error_);
  check();
}

GmshVolume Session::volume() {
  std::size_t* tags = nullptr;
  std::size_t tag_count = 0;
  double* coordinates = nullptr;
  std::size_t coordinate_count = 0;
  double* parameters = nullptr;
  std::size_t parameter_count = 0;
  WSCVT_GMSH(library_, gmshModelMeshGetNodes)
  (&tags, &tag_count, &coordinates, &coordinate_count, &parameters, &parameter_count, -1, -1, 0, 0,
   &error_);
  check();
  std::size_t* elements = nullptr;
  std::size_t element_count = 0;
  std::size_t* corners = nullptr;
  std::size_t corner_count = 0;
  constexpr int tetrahedron_type = 4;
  WSCVT_GMSH(library_, gmshModelMeshGetElementsByType)
  (tetrahedron_type, &elements, &element_count, &corners, &corner_count, -1, 0, 1, &error_);
  check();
  GmshVolume volume;
  volume.coordinates.resize(coordinate_count);
  // The surface's nodes have the tags 1, 2, ..., and the inner ones follow in some order.
  std::unordered_map<std::size_t, std::size_t> number;
  for (std::size_t i = 0; i < tag_count; ++i) {
    if (tags[i] <= tag_count) number[tags[i]] = tags[i] - 1;
  }
  std::vector<char> used(tag_count, 0);
  for (const auto& [tag, place] : number) used[place] = 1;
  std::size_t next = 0;
  for (std::size_t i = 0; i < tag_count; ++i) {
    if (tags[i] > tag_count) {
      while (used[next] != 0) ++next;
      used[next] = 1;
      number[tags[i]] = next;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      volume.coordinates[3 * number[tags[i]] + axis] = coordinates[3 * i + axis];
    }
  }
  for (std::size_t k = 0; k < corner_count; ++k) volume.corners.push_back(number[corners[k]]);
  for (void* memory :
       {static_cast<void*>(tags), static_cast<void*>(coordinates), static_cast<void*>(parameters),
        static_cast<void*>(elements), static_cast<void*>(corners)}) {
    if (memory != nullptr) WSCVT_GMSH(library_, gmshFree)(memory);
  }
  return volume;
}

#undef WSCVT_GMSH

}  // namespace

void require_gmsh() { const Library library; }

GmshVolume gmsh_volume(std::vector<double> coordinates, std::vector<std::size_t> corners,
                       double edge) {
  static std::mutex one_at_a_time;  // Gmsh has one state for the whole program
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  const Library library;
  Session session(library);
  session.fill(coordinates, corners, edge);
  return session.volume();
}

#endif

}  // namespace wscvt
