// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/mesh_io.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <boost/endian/conversion.hpp>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/file_name.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/output_file.h"
#include "wscvt/scan/byte_reader.h"
#include "wscvt/scan/obj_reader.h"
#include "wscvt/scan/off_reader.h"
#include "wscvt/scan/ply_reader.h"
#include "wscvt/scan/stl_reader.h"

namespace wscvt {

namespace {

using LibraryPoint = CGAL::Simple_cartesian<double>::Point_3;

enum class Format { Ply, Stl, Obj, Off };

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

std::optional<Format> known_format(const std::string& path) {
  static const std::map<std::string, Format> formats{
      {".ply", Format::Ply}, {".stl", Format::Stl}, {".obj", Format::Obj}, {".off", Format::Off}};
  const auto found = formats.find(ending_of(path));
  return found == formats.end() ? std::nullopt : std::optional(found->second);
}

Format format_of(const std::string& path) {
  const std::optional<Format> format = known_format(path);
  if (!format) {
    refuse("\"" + path +
           "\" does not end in .ply, .stl, .obj or .off; convert the mesh to one of these.");
  }
  return *format;
}

template <class Number>
void write_points(std::ostream& stream, const std::vector<Vector3>& points) {
  std::array<unsigned char, 3 * sizeof(Number)> vertex{};
  for (const Vector3& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      boost::endian::endian_store<Number, sizeof(Number), boost::endian::order::little>(
          vertex.data() + sizeof(Number) * k, static_cast<Number>(p[static_cast<Eigen::Index>(k)]));
    }
    stream.write(reinterpret_cast<const char*>(vertex.data()), vertex.size());
  }
}

void write_ply(std::ostream& stream, const IndexedMesh& mesh, PlyCoordinates coordinates) {
  const std::string type = coordinates == PlyCoordinates::Double ? "double" : "float";
  stream << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.points.size();
  for (const char* name : {" x", " y", " z"}) stream << "\nproperty " << type << name;
  stream << "\nelement face " << mesh.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
  if (coordinates == PlyCoordinates::Double) {
    write_points<double>(stream, mesh.points);
  } else {
    write_points<float>(stream, mesh.points);
  }
  std::array<unsigned char, 13> face{3};
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      boost::endian::store_little_s32(face.data() + 1 + 4 * k, t[k]);
    }
    stream.write(reinterpret_cast<const char*>(face.data()), face.size());
  }
}

IndexedMesh mesh_as(ByteReader& reader, Format format) {
  switch (format) {
    case Format::Ply:
      return read_ply(reader);
    case Format::Stl:
      return read_stl(reader);
    case Format::Obj:
      return read_obj(reader);
    case Format::Off:
      break;
  }
  return read_off(reader);
}

MeshFile read_as(ByteReader& reader, Format format) {
  IndexedMesh mesh = mesh_as(reader, format);
  return {std::move(mesh), reader.warnings()};
}

/// Number of points that single precision puts where another, different one is.
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

bool write_as(std::ostream& stream, Format format, const IndexedMesh& mesh,
              PlyCoordinates coordinates) {
  if (format == Format::Ply) {
    write_ply(stream, mesh, coordinates);
    return true;
  }
  std::vector<LibraryPoint> points;
  points.reserve(mesh.points.size());
  for (const Vector3& p : mesh.points) points.emplace_back(p.x(), p.y(), p.z());
  const auto digits = CGAL::parameters::stream_precision(17);
  switch (format) {
    case Format::Stl:
      CGAL::IO::set_binary_mode(stream);
      return CGAL::IO::write_STL(stream, points, mesh.triangles);
    case Format::Obj:
      stream.precision(17);  // the library forgets the parameter here
      return CGAL::IO::write_OBJ(stream, points, mesh.triangles);
    case Format::Off:
      return CGAL::IO::write_OFF(stream, points, mesh.triangles, digits);
    case Format::Ply:
      break;
  }
  return false;
}

}  // namespace

// Why not CGAL's read_polygon_soup (5.5): of 28 small hostile files it took memory for what two
// claimed (80 bytes: 3.8 GB and 16 to 31 s), ended the program at two, read an STL text that is cut
// off as no faces and OBJ's vertex 0 as a vertex, and left out PLY's triangle strips. On a million
// faces it takes 5 to 7 times as long (OBJ 1.5 s, ours .3 s) and 1.3 to 2.5 times the memory. Where
// both read a file, 30 scans and bodies, they read as many faces.
IndexedMesh read_mesh(const std::string& path, const Execution& execution) {
  return read_mesh_file(path, execution).mesh;
}

MeshFile read_mesh_file(const std::string& path, const Execution& execution) {
  const Format format = format_of(path);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  const bool is_pipe = std::filesystem::is_fifo(status);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) && !is_pipe) {
    fail(path, "is a folder or a device; give the name of a file.");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse_to_open(path, errno);
  if (is_pipe) {
    // How much a pipe holds is known at its end.
    std::stringstream content;
    content.exceptions(std::ios::badbit);  // or memory that is refused would be the pipe's end
    content << file.rdbuf();
    ByteReader reader(content, content.str().size(), path, execution);
    return read_as(reader, format);
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) refuse_to_open(path, error.value());
  ByteReader reader(file, size, path, execution);
  return read_as(reader, format);
}

bool is_mesh_file(const std::string& path) { return known_format(path).has_value(); }

void check_mesh_format(const std::string& path) { format_of(path); }

void write_mesh(const IndexedMesh& mesh, const std::string& path, PlyCoordinates coordinates) {
  const Format format = format_of(path);
  const std::size_t lost = format == Format::Stl ? fallen_together(mesh.points) : 0;
  if (lost > 0) {
    fail(path, "cannot hold this mesh: STL keeps seven digits of a coordinate, in which " +
                   std::to_string(lost) +
                   " vertices fall together with others; write PLY, OBJ or OFF, or move the mesh "
                   "to the origin first.");
  }
  write_file(path,
             [&](std::ostream& stream) { return write_as(stream, format, mesh, coordinates); });
}

}  // namespace wscvt
