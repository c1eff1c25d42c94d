// SPDX-License-Identifier: GPL-3.0-or-later
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/reader_parts.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t record_size = 50;

/// Returns the number of the next triangle's first corner.
std::int32_t next_index(const ByteReader& reader, const IndexedMesh& mesh) {
  reader.check_count(mesh.points.size() + 3, "has more triangles");
  return static_cast<std::int32_t>(mesh.points.size());
}

IndexedMesh read_binary(ByteReader& reader) {
  using boost::endian::order;
  const std::string_view header = reader.peek(header_size);
  if (header.size() < header_size) reader.fail("is too short for an STL file");
  const std::size_t triangles = load<std::uint32_t, order::little>(header.data() + 80);
  const std::uintmax_t expected = header_size + std::uintmax_t{record_size} * triangles;
  const std::uintmax_t held = (reader.remaining() - header_size) / record_size;
  if (expected > reader.remaining()) {
    reader.fail("is not text and announces " + std::to_string(triangles) +
                " triangles, but holds " + std::to_string(held) +
                ". It is not an STL file or was cut off");
  }
  // Some programs leave bytes after the last triangle, a line break or zeros. If there is room for
  // a triangle, the count is wrong.
  if (held > triangles) {
    reader.fail("is not text and announces " + std::to_string(triangles) +
                " triangles, but holds " + std::to_string(held) + ". It is not an STL file");
  }
  if (triangles == 0) reader.fail("holds no triangles");
  if (reader.remaining() > expected) {
    const std::uintmax_t more = reader.remaining() - expected;
    reader.warn("has " + format_count(more, "byte") +
                " behind its last triangle. They were left out. If triangles are missing, export "
                "it again from the program it came from.");
  }
  reader.skip(header_size);
  IndexedMesh mesh;
  mesh.points.reserve(3 * triangles);
  mesh.triangles.reserve(triangles);
  for (std::size_t f = 0; f < triangles; ++f) {
    const char* bytes = reader.next(record_size);
    if (bytes == nullptr) {
      reader.fail("ends within triangle " + std::to_string(f) + " of " + std::to_string(triangles));
    }
    const std::int32_t first = next_index(reader, mesh);
    for (std::size_t i = 1; i <= 3; ++i) {  // 0 is the normal
      const char* const corner = bytes + 12 * i;
      mesh.points.emplace_back(load<float, order::little>(corner),
                               load<float, order::little>(corner + 4),
                               load<float, order::little>(corner + 8));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Reads the words of a text STL file; line breaks separate words as blanks do.
class TextReader {
 public:
  TextReader(ByteReader& reader, FaceNames& solids) : reader_(reader), solids_(solids) {}

  IndexedMesh read() {
    IndexedMesh mesh;
    do {  // a file may have several solids
      expect("solid");
      solids_.begin_new(std::string(trimmed(fields_.rest())));  // may have any words
      fields_ = TextFields("");
      for (std::string word = next_word(); word != "endsolid"; word = next_word()) {
        if (word != "facet") fail(word, "\"facet\" or \"endsolid\"");
        read_facet(mesh);
      }
      fields_ = TextFields("");
    } while (has_more());
    if (mesh.triangles.empty()) reader_.fail("holds no triangles");
    return mesh;
  }

 private:
  void read_facet(IndexedMesh& mesh) {
    // Ignores the file's normal, because the normal follows from the corners.
    std::string word = next_word();
    for (int k = 0; word != "outer"; ++k) {
      if (k > 4) fail(word, "\"outer loop\"");
      word = next_word();
    }
    expect("loop");
    const std::int32_t first = next_index(reader_, mesh);
    for (int i = 0; i < 3; ++i) {
      expect("vertex");
      Vector3 point;
      for (double& coordinate : point) {
        word = next_word();
        const std::optional<double> value = number_in(word);
        if (!value) fail(word, "a coordinate");
        coordinate = *value;
      }
      mesh.points.push_back(point);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    solids_.add_to(mesh.triangles.size());
    expect("endloop");
    expect("endfacet");
  }

  void expect(const std::string& due) {
    const std::string word = next_word();
    if (word != due) fail(word, in_quotes(due));
  }

  /// Returns the next word in lower case; empty at the end of the file.
  std::string next_word() {
    if (!has_more()) return "";
    return lower_case(std::exchange(word_, std::string_view()));
  }

  bool has_more() {
    while (word_.empty()) {
      word_ = fields_.next();
      if (!word_.empty()) break;
      const std::optional<std::string_view> line = reader_.line();
      if (!line) return false;
      fields_ = TextFields(*line);
    }
    return true;
  }

  [[noreturn]] void fail(const std::string& word, const std::string& due) {
    if (word.empty()) reader_.fail("ends before " + due + ". It was cut off");
    reader_.fail_field(word, due);
  }

  ByteReader& reader_;
  FaceNames& solids_;
  TextFields fields_{""};
  std::string_view word_;
};

/// Checks the size, or bytes that no text has, because a binary header may also begin with "solid".
bool is_binary(ByteReader& reader) {
  const std::string_view header = reader.peek(header_size);
  if (header.size() == header_size) {
    const auto triangles = load<std::uint32_t, boost::endian::order::little>(header.data() + 80);
    if (reader.remaining() == header_size + std::uintmax_t{record_size} * triangles) return true;
  }
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of a text that Windows' editor saved
  const bool is_marked = header.substr(0, mark.size()) == mark;
  const std::string_view text = header.substr(is_marked ? mark.size() : 0);
  return lower_case(TextFields(text).next()) != "solid" ||
         header.find('\0') != std::string_view::npos;
}

}  // namespace

void read_stl(ByteReader& reader, MeshFile& file) {
  FaceNames solids;
  file.mesh = is_binary(reader) ? read_binary(reader) : TextReader(reader, solids).read();
  solids.append_to(file.named_faces);
}

}  // namespace wscvt
