// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/mesh_io.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

namespace {

using LibraryPoint = CGAL::Simple_cartesian<double>::Point_3;

/// Collects bytes before they are written, because a stream takes ten times as long per vertex.
class Bytes {
 public:
  explicit Bytes(std::ostream& stream) : stream_(stream), bytes_(std::size_t{1} << 16) {}

  template <class Number>
  void add(Number number) {
    if (used_ + sizeof(Number) > bytes_.size()) flush();
    boost::endian::endian_store<Number, sizeof(Number), boost::endian::order::little>(
        bytes_.data() + used_, number);
    used_ += sizeof(Number);
  }

  /// Writes the remaining bytes.
  void flush() {
    stream_.write(reinterpret_cast<const char*>(bytes_.data()),
                  static_cast<std::streamsize>(used_));
    used_ = 0;
  }

 private:
  std::ostream& stream_;
  std::vector<unsigned char> bytes_;
  std::size_t used_ = 0;
};

const char* ply_name(ScalarType type) {
  constexpr std::array<const char*, 8> names{"char", "uchar", "short", "ushort",
                                             "int",  "uint",  "float", "double"};
  return names[static_cast<std::size_t>(type)];
}

/// Adds the nearest whole number in the type's range.
template <class Whole>
void add_rounded(Bytes& bytes, double value) {
  const double low = std::numeric_limits<Whole>::min();
  const double high = std::numeric_limits<Whole>::max();
  bytes.add(static_cast<Whole>(std::nearbyint(value > low ? std::min(value, high) : low)));
}

void add_number(Bytes& bytes, ScalarType type, double value) {
  switch (type) {
    case ScalarType::Int8:
      return add_rounded<std::int8_t>(bytes, value);
    case ScalarType::Uint8:
      return add_rounded<std::uint8_t>(bytes, value);
    case ScalarType::Int16:
      return add_rounded<std::int16_t>(bytes, value);
    case ScalarType::Uint16:
      return add_rounded<std::uint16_t>(bytes, value);
    case ScalarType::Int32:
      return add_rounded<std::int32_t>(bytes, value);
    case ScalarType::Uint32:
      return add_rounded<std::uint32_t>(bytes, value);
    case ScalarType::Float32:
      return bytes.add(static_cast<float>(value));
    case ScalarType::Float64:
      return bytes.add(value);
  }
}

void write_properties(std::ostream& stream, const std::vector<MeshAttribute>& attributes) {
  for (const MeshAttribute& attribute : attributes) {
    stream << "\nproperty " << ply_name(attribute.type) << ' ' << attribute.name;
  }
}

void write_ply_with(std::ostream& stream, const IndexedMesh& mesh, PlyCoordinates coordinates,
                    const MeshAttributes& attributes) {
  const ScalarType type =
      coordinates == PlyCoordinates::Double ? ScalarType::Float64 : ScalarType::Float32;
  stream << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.points.size();
  for (const char* name : {" x", " y", " z"}) stream << "\nproperty " << ply_name(type) << name;
  write_properties(stream, attributes.of_vertices);
  stream << "\nelement face " << mesh.triangles.size()
         << "\nproperty list uchar int vertex_indices";
  write_properties(stream, attributes.of_faces);
  stream << "\nend_header\n";
  Bytes bytes(stream);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (const double coordinate : mesh.points[i]) add_number(bytes, type, coordinate);
    for (const MeshAttribute& a : attributes.of_vertices) add_number(bytes, a.type, a.values[i]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bytes.add(std::uint8_t{3});
    for (const std::int32_t v : mesh.triangles[t]) bytes.add(v);
    for (const MeshAttribute& a : attributes.of_faces) add_number(bytes, a.type, a.values[t]);
  }
  bytes.flush();
}

void write_ply(std::ostream& stream, const IndexedMesh& mesh) {
  write_ply_with(stream, mesh, PlyCoordinates::Double, MeshAttributes());
}

/// Returns the number of points that single precision makes equal to a different point.
std::size_t fallen_together(const std::vector<Vector3>& points) {
  struct Rounded {
    std::array<float, 3> place;
    const Vector3* point;
  };
  std::vector<Rounded> sorted;
  sorted.reserve(points.size());
  for (const Vector3& p : points) {
    sorted.push_back(
        {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())}, &p});
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const Rounded& a, const Rounded& b) { return a.place < b.place; });
  std::size_t count = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].place == sorted[i - 1].place && *sorted[i].point != *sorted[i - 1].point) ++count;
  }
  return count;
}

std::vector<LibraryPoint> library_points(const IndexedMesh& mesh) {
  std::vector<LibraryPoint> points;
  points.reserve(mesh.points.size());
  for (const Vector3& p : mesh.points) points.emplace_back(p.x(), p.y(), p.z());
  return points;
}

void write_stl(std::ostream& stream, const IndexedMesh& mesh) {
  CGAL::IO::set_binary_mode(stream);
  CGAL::IO::write_STL(stream, library_points(mesh), mesh.triangles);
}

void write_obj(std::ostream& stream, const IndexedMesh& mesh) {
  stream.precision(17);  // the library forgets it where it is a parameter
  CGAL::IO::write_OBJ(stream, library_points(mesh), mesh.triangles);
}

void write_off(std::ostream& stream, const IndexedMesh& mesh) {
  CGAL::IO::write_OFF(stream, library_points(mesh), mesh.triangles,
                      CGAL::parameters::stream_precision(17));
}

void write_plain_vtp(std::ostream& stream, const IndexedMesh& mesh) { write_vtp(stream, mesh); }

struct Format {
  std::string_view extension;
  void (*read)(ByteReader& reader, MeshFile& file);  ///< null: only written
  /// Null: only read. A stream that fails tells it.
  void (*write)(std::ostream& stream, const IndexedMesh& mesh);
  bool is_scan = true;  ///< else a file in a folder counts only if it is named
};

/// The extension of text STL also ends in that of binary STL; readers accept both forms.
constexpr std::string_view text_stl = ".ascii.stl";

constexpr Format formats[] = {
    {".ply", read_ply, write_ply},
    {".stl", read_stl, write_stl},
    {text_stl, nullptr, write_stl_text},
    {".obj", read_obj, write_obj},
    {".off", read_off, write_off},
    {".vtp", read_vtp, write_plain_vtp},
    {".vtk", read_legacy_vtk, write_legacy_vtk},
    {".vtu", read_vtp, write_vtu, false},
    {".msh", read_gmsh, write_gmsh, false},
    {".inp", read_abaqus, write_abaqus, false},
    {".xyz", read_point_text, nullptr, false},
    {".csv", read_point_text, nullptr, false},
    {".pcd", read_pcd, nullptr, false},
};

bool is_of(const Format& format, MeshUse use) {
  return use == MeshUse::Read ? format.read != nullptr : format.write != nullptr;
}

/// Returns null if there is no such format. Files to read may be packed.
const Format* known_format(const std::string& path, MeshUse use) {
  std::string extension = ending_of(path);
  constexpr std::string_view packed = ".gz";
  if (use == MeshUse::Write && extension == ".stl") {
    const std::string before = ending_of(path.substr(0, path.size() - extension.size()));
    if (before + extension == text_stl) extension = text_stl;
  }
  if (use == MeshUse::Read && extension == packed) {
    extension = ending_of(path.substr(0, path.size() - packed.size()));
  }
  const auto* const found = std::find_if(
      std::begin(formats), std::end(formats),
      [&](const Format& format) { return format.extension == extension && is_of(format, use); });
  return found == std::end(formats) ? nullptr : found;
}

const Format& format_of(const std::string& path, MeshUse use) {
  const Format* const format = known_format(path, use);
  if (format == nullptr) {
    std::error_code error;
    const bool is_lost = use == MeshUse::Read && !std::filesystem::exists(path, error);
    refuse("\"" + path +
           (is_lost ? "\" does not exist, and the name does not end in " : "\" does not end in ") +
           mesh_extensions(use) +
           (is_lost                ? ". Check the name."
            : use == MeshUse::Read ? ". Convert the mesh to one of these."
                                   : ". Give a name that does."));
  }
  return *format;
}

MeshFile read_as(ByteReader& reader, const Format& format) {
  MeshFile file;
  format.read(reader, file);
  file.warnings = reader.warnings();
  return file;
}

/// Reads a mesh from content in memory.
MeshFile read_content(const std::string& content, const std::string& path, const Format& format,
                      const Execution& execution) {
  const std::size_t size = content.size();
  std::istringstream stream(content);
  ByteReader reader(stream, size, path, execution);
  return read_as(reader, format);
}

}  // namespace

// CGAL's read_polygon_soup (5.5) is not used. Of 28 small hostile files it allocated memory as two
// claimed (80 bytes: 3.8 GB and 16 to 31 s) and ended the program at two. It read a cut STL text as
// no faces and OBJ's vertex 0 as a vertex, and left out PLY's triangle strips. On a million faces
// it takes 5 to 7 times as long (OBJ 1.5 s, ours 0.3 s) and 1.3 to 2.5 times the memory. For 30
// scans and bodies that both read, the numbers of faces agree.
IndexedMesh read_mesh(const std::string& path, const Execution& execution) {
  return read_mesh_file(path, execution).mesh;
}

MeshFile read_mesh_file(const std::string& path, const Execution& execution) {
  const Format& format = format_of(path, MeshUse::Read);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  const bool is_pipe = std::filesystem::is_fifo(status);
  InputFile file(path);
  if (is_pipe) {
    // The size of a pipe is known only at its end.
    return read_content({std::istreambuf_iterator<char>(file), {}}, path, format, execution);
  }
  if (is_gzip(path)) {
    return read_content(gzip_content(path, execution), path, format, execution);
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) refuse_to_open(path, error.value());
  ByteReader reader(file, size, path, execution);
  return read_as(reader, format);
}

void read_pictures(MeshFile& file, const std::string& path, const Execution& execution) {
  if (file.attributes.texture.empty()) return;
  MeshTexture& texture = file.attributes.texture;
  texture.pictures =
      pictures_of(texture.names, file.material_libraries, path, file.warnings, execution);
}

bool is_mesh_format(const std::string& path, MeshUse use) {
  return known_format(path, use) != nullptr;
}

void check_mesh_format(const std::string& path, MeshUse use) { format_of(path, use); }

std::string mesh_extensions(MeshUse use) {
  std::vector<std::string> extensions;
  for (const Format& format : formats) {
    if (is_of(format, use)) extensions.emplace_back(format.extension);
  }
  return enumerated(extensions, " or ");
}

bool is_mesh_file(const std::string& path) {
  const Format* const format = known_format(path, MeshUse::Read);
  return format != nullptr && format->is_scan;
}

namespace {

bool is_single(const Format& format, PlyCoordinates coordinates) {
  return format.write == write_stl ||
         (format.write == write_ply && coordinates == PlyCoordinates::Float);
}

/// Refuses positions that no reader takes.
void check_positions(const IndexedMesh& mesh, const std::string& path, bool in_floats) {
  const double largest =
      in_floats ? double{std::numeric_limits<float>::max()} : std::numeric_limits<double>::max();
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (mesh.points[v].allFinite() && mesh.points[v].cwiseAbs().maxCoeff() <= largest) continue;
    refuse(in_quotes(path) + " cannot store vertex " + std::to_string(v) +
           ", counted from 0: a coordinate is not finite" +
           (in_floats ? " in single precision. Write doubles, or scale the mesh."
                      : ". Leave it out, with its faces."));
  }
}

}  // namespace

IndexedMesh as_written(IndexedMesh mesh, const std::string& path, PlyCoordinates coordinates) {
  const Format& format = format_of(path, MeshUse::Write);
  const bool is_short = format.write == write_abaqus;
  if (!is_single(format, coordinates) && !is_short) return mesh;
  for (Vector3& p : mesh.points) {
    for (double& coordinate : p) {
      // Volatile, because GCC 12 optimises the rounding to single precision away.
      volatile const auto single = static_cast<float>(coordinate);
      coordinate = is_short ? kept_by_abaqus(coordinate) : static_cast<double>(single);
    }
  }
  return mesh;
}

void write_mesh(const IndexedMesh& mesh, const std::string& path, PlyCoordinates coordinates) {
  const Format& format = format_of(path, MeshUse::Write);
  check_positions(mesh, path, is_single(format, coordinates));
  const bool is_stl = format.write == write_stl || format.write == write_stl_text;
  if (is_stl && mesh.triangles.empty()) {
    refuse("\"" + path + "\" would be empty: STL has only triangles, and the mesh has none.");
  }
  if (format.write == write_stl) {
    const std::size_t lost = fallen_together(mesh.points);
    const double step = single_precision_step(mesh);
    if (lost > 0 || step > coarse_step) {
      throw Error(
          ErrorCode::InputOutput,
          "\"" + path +
              "\" cannot store this mesh: binary STL keeps seven digits of a coordinate, which are "
              "steps of " +
              format_percent(step) + " of the mean edge" +
              (lost > 0 ? ", so that " + std::to_string(lost) + " vertices coincide with others"
                        : "") +
              ". Write PLY, OBJ or OFF, or move the mesh to the origin first.");
    }
  }
  write_file(path, [&](std::ostream& stream) {
    if (format.write == write_ply) {
      write_ply_with(stream, mesh, coordinates, MeshAttributes());
    } else {
      format.write(stream, mesh);
    }
  });
}

bool holds_attributes(const std::string& path) {
  const Format* const format = known_format(path, MeshUse::Write);
  return format != nullptr && format->write == write_ply;
}

void write_mesh(const IndexedMesh& mesh, const MeshAttributes& attributes,
                const std::string& path) {
  if (!holds_attributes(path)) return write_mesh(mesh, path);
  check_positions(mesh, path, false);
  for (const auto& [all, count] : {std::pair(&attributes.of_vertices, mesh.points.size()),
                                   std::pair(&attributes.of_faces, mesh.triangles.size())}) {
    for (const MeshAttribute& attribute : *all) {
      const std::string& name = attribute.name;
      if (name.empty() || std::any_of(name.begin(), name.end(), [](char c) {
            return static_cast<unsigned char>(c) <= ' ' || c == '\x7f';
          })) {
        refuse("The attribute " + in_quotes(name) +
               " does not have a name of PLY. Give one without blanks.");
      }
      if (name == "x" || name == "y" || name == "z" || name == "vertex_indices") {
        refuse("The attribute " + in_quotes(name) +
               " has a name that PLY uses for the mesh. Give another one.");
      }
      if (attribute.values.size() == count) continue;
      refuse("The attribute \"" + attribute.name + "\" has " +
             std::to_string(attribute.values.size()) + " values for " + std::to_string(count) +
             " vertices or faces. Give one each.");
    }
  }
  write_file(path, [&](std::ostream& stream) {
    write_ply_with(stream, mesh, PlyCoordinates::Double, attributes);
  });
}

}  // namespace wscvt
