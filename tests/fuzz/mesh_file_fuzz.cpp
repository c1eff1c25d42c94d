// SPDX-License-Identifier: GPL-3.0-or-later
// Files that claim to be meshes. The first byte names the reader: p PLY, s STL, o OBJ, k and v
// VTK's older files and those in XML, x points as text, c PCD, g Gmsh, a Abaqus, any other OFF.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/promise.h"
#include "wscvt/base/error.h"
#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/readers.h"

namespace {

using namespace wscvt;

IndexedMesh read(char format, ByteReader& reader) {
  switch (format) {
    case 'p':
      return read_ply(reader);
    case 's':
      return read_stl(reader);
    case 'o': {
      MeshAttributes attributes;
      std::vector<std::string> libraries;
      std::vector<NamedFaces> names;
      return read_obj_attributes(reader, attributes, libraries, names);
    }
    case 'g':
      return read_gmsh(reader);
    case 'a':
      return read_abaqus(reader);
    case 'k':
      return read_legacy_vtk(reader);
    case 'v':
      return read_vtp(reader);
    case 'x':
      return read_point_text(reader);
    case 'c':
      return read_pcd(reader);
    default:
      return read_off(reader);
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string content(reinterpret_cast<const char*>(data) + 1, size - 1);
  std::istringstream stream(content);
  ByteReader reader(stream, content.size(), "file");
  try {
    const IndexedMesh mesh = read(static_cast<char>(data[0]), reader);
    for (const Triangle& t : mesh.triangles) {
      for (const std::int32_t v : t) {
        promise(v >= 0 && static_cast<std::size_t>(v) < mesh.points.size(),
                "an index does not fit");
      }
    }
    // A byte holds a coordinate at most, a corner, or a digit of one; packed, up to 1100 of them.
    const std::size_t most = content.size() * (data[0] == 'v' || data[0] == 'c' ? 1100 : 1);
    promise(mesh.points.size() <= most, "more points than bytes");
    promise(mesh.triangles.size() <= most, "more triangles than bytes");
  } catch (const Error& error) {
    promise(error.code() == ErrorCode::InputOutput, error.what());
    promise(std::string(error.what()).size() > 20, "no sentence");
  }
  return 0;
}
