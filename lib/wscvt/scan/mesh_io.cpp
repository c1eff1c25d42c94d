// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/mesh_io.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <boost/endian/conversion.hpp>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"

namespace wscvt {

namespace {

using LibraryPoint = CGAL::Simple_cartesian<double>::Point_3;
using Polygon = boost::container::small_vector<int, 4>;

enum class Format { Ply, Stl, Obj, Off };

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

Format format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::map<std::string, Format> formats{
      {".ply", Format::Ply}, {".stl", Format::Stl}, {".obj", Format::Obj}, {".off", Format::Off}};
  const auto found = formats.find(extension);
  if (found == formats.end()) {
    fail(path, "does not end in .ply, .stl, .obj or .off; convert the mesh to one of these.");
  }
  return found->second;
}

/// Adds the fan of a polygon; false when an index is out of range. Fewer than three corners enclose
/// nothing and are passed over.
template <class Index>
bool add_fan(const Index* corners, std::size_t count, std::size_t vertices, IndexedMesh& mesh) {
  for (std::size_t i = 0; i < count; ++i) {
    if (static_cast<std::uint32_t>(corners[i]) >= vertices) return false;
  }
  for (std::size_t i = 2; i < count; ++i) {
    mesh.triangles.push_back({static_cast<std::int32_t>(corners[0]),
                              static_cast<std::int32_t>(corners[i - 1]),
                              static_cast<std::int32_t>(corners[i])});
  }
  return true;
}

constexpr const char* bad_index = "has a face that names a vertex the file does not hold.";
constexpr const char* cut_short =
    "ends early, has something other than a number where one is due, or is not what its header "
    "says; "
    "export it again from the program it came from.";

/// Bytes of a file in order, through one buffer that a record never straddles.
class ByteReader {
 public:
  ByteReader(std::istream& stream, const std::string& path) : stream_(stream), path_(path) {
    buffer_.resize(std::size_t{1} << 18);
  }

  /// The next `count` bytes (count <= 128 KiB); valid until the next call.
  const char* next(std::size_t count) {
    if (end_ - begin_ < count) {
      std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
      end_ -= begin_;
      begin_ = 0;
      stream_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
      end_ += static_cast<std::size_t>(stream_.gcount());
      if (end_ < count) fail(path_, cut_short);
    }
    const char* const bytes = buffer_.data() + begin_;
    begin_ += count;
    return bytes;
  }

 private:
  std::istream& stream_;
  const std::string& path_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

template <class Value>
Value little_endian(const char* bytes) {
  return boost::endian::endian_load<Value, sizeof(Value), boost::endian::order::little>(
      reinterpret_cast<const unsigned char*>(bytes));
}

/// Bytes of a scalar PLY type; 0 when there is no such type.
std::size_t ply_type_size(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{
      {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
      {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
      {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

/// Layout of the common binary PLY file: fixed-size vertices with x, y, z of one floating type,
/// then faces with one list of 32-bit indices with a one-byte count among fixed-size properties.
struct PlyLayout {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t vertex_size = 0;
  std::size_t coordinate_size = 0;
  std::array<std::size_t, 3> offsets{};
  std::size_t before_list = 0;
  std::size_t after_list = 0;
};

/// Reads the header and leaves the stream after it; nothing when the layout is another one.
std::optional<PlyLayout> common_ply_layout(std::istream& stream) {
  PlyLayout layout;
  std::string line;
  int element = 0;  // 1: vertices, 2: faces
  int coordinates = 0;
  bool binary = false;
  bool list = false;
  if (!std::getline(stream, line) || line.substr(0, 3) != "ply") return {};
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string word;
    words >> word;
    if (word == "end_header") {
      if (!binary || element != 2 || coordinates != 3 || !list) return {};
      return layout;
    }
    if (word == "format") {
      words >> word;
      binary = word == "binary_little_endian";
    } else if (word == "element") {
      std::size_t count = 0;
      words >> word >> count;
      ++element;
      if (!words || element > 2 || word != (element == 1 ? "vertex" : "face")) return {};
      (element == 1 ? layout.vertices : layout.faces) = count;
    } else if (word == "property") {
      std::string type;
      std::string name;
      words >> type;
      if (type == "list") {
        std::string count_type;
        words >> count_type >> type >> name;
        if (element != 2 || list || ply_type_size(count_type) != 1 || ply_type_size(type) != 4 ||
            type[0] == 'f' || (name != "vertex_indices" && name != "vertex_index")) {
          return {};
        }
        list = true;
        continue;
      }
      words >> name;
      const std::size_t size = ply_type_size(type);
      if (size == 0 || element == 0) return {};
      if (element == 2) {
        (list ? layout.after_list : layout.before_list) += size;
        continue;
      }
      if (name == "x" || name == "y" || name == "z") {
        const bool floating = type[0] == 'f' || type[0] == 'd';
        if (!floating || (coordinates > 0 && size != layout.coordinate_size)) return {};
        layout.coordinate_size = size;
        layout.offsets[static_cast<std::size_t>(name[0] - 'x')] = layout.vertex_size;
        ++coordinates;
      }
      layout.vertex_size += size;
    }
  }
  return {};
}

/// The library reads PLY number by number, a third of the time of a whole run on a million
/// vertices; the common binary layout is therefore read in blocks here.
IndexedMesh read_ply_blocks(std::istream& stream, const PlyLayout& layout,
                            const std::string& path) {
  IndexedMesh mesh;
  ByteReader reader(stream, path);
  mesh.points.reserve(layout.vertices);
  for (std::size_t i = 0; i < layout.vertices; ++i) {
    const char* const bytes = reader.next(layout.vertex_size);
    Vector3 point;
    for (int k = 0; k < 3; ++k) {
      const char* const number = bytes + layout.offsets[static_cast<std::size_t>(k)];
      point[k] = layout.coordinate_size == 4 ? static_cast<double>(little_endian<float>(number))
                                             : little_endian<double>(number);
    }
    mesh.points.push_back(point);
  }
  mesh.triangles.reserve(layout.faces);
  std::array<std::uint32_t, 255> corners{};
  for (std::size_t f = 0; f < layout.faces; ++f) {
    const auto count =
        static_cast<unsigned char>(reader.next(layout.before_list + 1)[layout.before_list]);
    const char* const bytes = reader.next(std::size_t{4} * count + layout.after_list);
    for (std::size_t i = 0; i < count; ++i)
      corners[i] = little_endian<std::uint32_t>(bytes + 4 * i);
    if (!add_fan(corners.data(), count, layout.vertices, mesh)) fail(path, bad_index);
  }
  return mesh;
}

/// Number of triangles of a binary STL file, told from a text one by its size; nothing for text.
std::optional<std::uint32_t> binary_stl_triangles(std::istream& stream, std::uintmax_t file_size) {
  std::array<char, 84> header{};
  if (!stream.read(header.data(), header.size())) return {};
  const auto count = little_endian<std::uint32_t>(header.data() + 80);
  if (file_size != 84 + std::uintmax_t{50} * count) return {};
  return count;
}

IndexedMesh read_stl_blocks(std::istream& stream, std::uint32_t triangles,
                            const std::string& path) {
  if (triangles > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max()) / 3) {
    fail(path, "has more triangles than can be numbered; reduce the scan first.");
  }
  IndexedMesh mesh;
  ByteReader reader(stream, path);
  mesh.points.reserve(std::size_t{3} * triangles);
  mesh.triangles.reserve(triangles);
  for (std::uint32_t f = 0; f < triangles; ++f) {
    const char* const bytes = reader.next(50) + 12;  // after the normal
    for (std::size_t i = 0; i < 3; ++i) {
      const char* const corner = bytes + 12 * i;
      mesh.points.emplace_back(little_endian<float>(corner), little_endian<float>(corner + 4),
                               little_endian<float>(corner + 8));
    }
    const auto first = static_cast<std::int32_t>(3 * f);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

IndexedMesh read_with_library(std::istream& stream, Format format, const std::string& path) {
  std::vector<LibraryPoint> points;
  std::vector<Polygon> polygons;
  const auto silent = CGAL::parameters::verbose(false);  // not every default is
  bool good = false;
  try {
    switch (format) {
      case Format::Ply:
        good = CGAL::IO::read_PLY(stream, points, polygons, silent);
        break;
      case Format::Stl:
        // The library takes a text that breaks off early for an empty file.
        good = CGAL::IO::read_STL(stream, points, polygons, silent) && !polygons.empty();
        break;
      case Format::Obj:
        // The library calls a file without faces bad; that is for the mesh check to say.
        good = CGAL::IO::read_OBJ(stream, points, polygons, silent) ||
               (stream.eof() && polygons.empty());
        break;
      case Format::Off:
        good = CGAL::IO::read_OFF(stream, points, polygons, silent);
        break;
    }
  } catch (const std::exception&) {
    good = false;  // the library's own checks, where they are switched on
  }
  if (!good) fail(path, cut_short);

  IndexedMesh mesh;
  mesh.points.reserve(points.size());
  for (const LibraryPoint& p : points) mesh.points.emplace_back(p.x(), p.y(), p.z());
  mesh.triangles.reserve(polygons.size());
  for (const Polygon& polygon : polygons) {
    if (!add_fan(polygon.data(), polygon.size(), points.size(), mesh)) fail(path, bad_index);
  }
  return mesh;
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

IndexedMesh read_mesh(const std::string& path) {
  const Format format = format_of(path);
  std::ifstream stream(path, std::ios::binary);
  stream.imbue(std::locale::classic());
  std::error_code error;
  const std::uintmax_t file_size = std::filesystem::file_size(path, error);
  if (!stream || error) fail(path, "cannot be opened; check that the file is there and readable.");

  if (format == Format::Ply) {
    const std::optional<PlyLayout> layout = common_ply_layout(stream);
    // Every vertex and face takes at least a byte: a header that promises more is not believed.
    if (layout && (layout->vertices > file_size || layout->faces > file_size))
      fail(path, cut_short);
    if (layout) return read_ply_blocks(stream, *layout, path);
  } else if (format == Format::Stl) {
    const std::optional<std::uint32_t> triangles = binary_stl_triangles(stream, file_size);
    if (triangles) return read_stl_blocks(stream, *triangles, path);
  }
  stream.clear();
  stream.seekg(0);
  return read_with_library(stream, format, path);
}

void write_mesh(const IndexedMesh& mesh, const std::string& path, PlyCoordinates coordinates) {
  const Format format = format_of(path);
  write_file(path,
             [&](std::ostream& stream) { return write_as(stream, format, mesh, coordinates); });
}

}  // namespace wscvt
