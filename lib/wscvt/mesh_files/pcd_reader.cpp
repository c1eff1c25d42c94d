// SPDX-License-Identifier: GPL-3.0-or-later
// https://pointclouds.org/documentation/tutorials/pcd_file_format.html. PCL is not used, because
// its file library needs VTK.
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct Field {
  std::string name;
  char type = 'F';
  std::size_t size = 4;
  std::size_t count = 1;
};

double number_at(const Field& field, const char* bytes) {
  Stored type = field.size == 4 ? Stored::Float32 : Stored::Float64;
  if (field.type != 'F') {
    type = field.size == 1   ? Stored::Int8
           : field.size == 2 ? Stored::Int16
           : field.size == 4 ? Stored::Int32
                             : Stored::Int64;
  }
  // The unsigned types follow the signed ones.
  if (field.type == 'U') type = static_cast<Stored>(static_cast<int>(type) + 1);
  return load_as<double>(type, boost::endian::order::little, bytes);
}

/// Unpacks Marc Lehmann's LZF, as PCL uses it. A byte b below 32 means that b + 1 bytes follow.
/// Other bytes give the length and distance of a copy. Returns an empty text if the data are
/// damaged.
std::string unpacked(std::string_view packed, std::size_t size) {
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  const auto next = [&]() -> std::size_t {
    return at < packed.size() ? static_cast<unsigned char>(packed[at++]) : 0;
  };
  while (at < packed.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - at || length > size - out.size()) return "";
      out.append(packed.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) length += next();
    length += 2;
    const std::size_t back = ((control & 31U) << 8 | next()) + 1;
    if (back > out.size() || length > size - out.size()) return "";
    // Copies byte by byte, because the source may overlap the destination.
    for (std::size_t k = 0; k < length; ++k) out.push_back(out[out.size() - back]);
  }
  return out.size() == size ? out : "";
}

class PcdReader {
 public:
  explicit PcdReader(ByteReader& reader) : reader_(reader) {}

  IndexedMesh read() {
    const std::string form = read_header();
    if (form == "ascii") {
      read_text();
    } else if (form == "binary") {
      read_records();
    } else if (form == "binary_compressed") {
      read_columns();
    } else {
      reader_.refuse_line("has data as " + in_quotes(form) +
                          ". Save it as ascii, binary or binary_compressed.");
    }
    if (left_out_ > 0) {
      reader_.warn("has " + std::to_string(left_out_) + " of " + std::to_string(points_) +
                   " points without finite coordinates. They were left out.");
    }
    if (mesh_.points.empty()) reader_.fail("holds no points");
    return std::move(mesh_);
  }

 private:
  /// Returns the word after DATA.
  std::string read_header() {
    std::optional<std::size_t> points;
    std::size_t width = 0;
    std::size_t height = 1;
    while (const std::optional<std::string_view> line = reader_.filled_line()) {
      TextFields words(*line);
      const std::string key = lower_case(words.next());
      if (key.front() == '#') continue;
      if (key == "fields") {
        fields_.clear();
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
          fields_.emplace_back();
          fields_.back().name = lower_case(word);
        }
      } else if (key == "size") {
        for (Field& field : fields_) field.size = number(words.next(), 8);
      } else if (key == "type") {
        for (Field& field : fields_) field.type = (std::string(words.next()) + "?")[0];
      } else if (key == "count") {
        for (Field& field : fields_) field.count = number(words.next(), 1000000);
      } else if (key == "width") {
        width = number(words.next(), most_points);
      } else if (key == "height") {
        height = number(words.next(), most_points);
      } else if (key == "points") {
        points = number(words.next(), most_points);
      } else if (key == "data") {
        std::string form = lower_case(words.next());
        points_ =
            points.value_or(width > most_points / (height + 1) ? most_points : width * height);
        check_fields();
        return form;
      } else if (key != "version" && key != "viewpoint") {
        reader_.fail_field(key, "a part of a PCD header");
      }
    }
    reader_.fail("has no line DATA, which ends the header of a PCD file");
  }

  std::size_t number(std::string_view word, std::size_t most) {
    const std::optional<std::int64_t> value = whole_number_in(word);
    if (!value || *value < 0 || static_cast<std::uint64_t>(*value) > most) {
      reader_.fail_field(word, "a number from 0 to " + std::to_string(most));
    }
    return static_cast<std::size_t>(*value);
  }

  void check_fields() {
    std::array<int, 3> found{};
    std::size_t columns = 0;
    for (const Field& field : fields_) {
      const bool is_known =
          (field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8) &&
          (field.type == 'I' || field.type == 'U' || (field.type == 'F' && field.size >= 4));
      if (!is_known) {
        reader_.fail("has a field " + in_quotes(field.name) + " of type " +
                     in_quotes(std::string(1, field.type)) + " with " + std::to_string(field.size) +
                     " bytes, which no PCD file has");
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (field.name != std::string(1, "xyz"[axis]) || field.count != 1) continue;
        ++found[axis];
        columns_[axis] = columns;
        offsets_[axis] = record_;
        types_[axis] = field;
      }
      columns += field.count;
      record_ += field.count * field.size;
    }
    if (found != std::array<int, 3>{1, 1, 1}) reader_.fail("has no fields x, y and z, each once");
  }

  void add(const Vector3& point) {
    if (point.allFinite()) {
      mesh_.points.push_back(point);
    } else {
      ++left_out_;
    }
  }

  [[noreturn]] void fail_cut() {
    reader_.fail("announces " + std::to_string(points_) +
                 " points but does not have them. It was cut off");
  }

  void read_text() {
    for (std::size_t i = 0; i < points_; ++i) {
      const std::optional<std::string_view> line = reader_.filled_line();
      if (!line) fail_cut();
      TextFields words(*line);
      Vector3 point = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
      std::size_t column = 0;
      for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++column) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (column != columns_[axis]) continue;
          const std::optional<double> value = number_in(word);
          if (!value) reader_.fail_field(word, "a coordinate");
          point[static_cast<Eigen::Index>(axis)] = *value;
        }
      }
      if (column <= columns_[0] || column <= columns_[1] || column <= columns_[2]) {
        reader_.fail_line("ends before the coordinates of a point");
      }
      add(point);
    }
  }

  void read_records() {
    if (points_ > reader_.remaining() / record_) fail_cut();
    for (std::size_t i = 0; i < points_; ++i) {
      const char* const bytes = reader_.next(record_);
      if (bytes == nullptr) fail_cut();
      const auto at = [&](std::size_t axis) {
        return number_at(types_[axis], bytes + offsets_[axis]);
      };
      add({at(0), at(1), at(2)});
    }
  }

  /// Reads packed data: all values of a field together.
  void read_columns() {
    using boost::endian::order;
    const char* const sizes = reader_.next(8);
    if (sizes == nullptr) fail_cut();
    const std::size_t packed = load<std::uint32_t, order::little>(sizes);
    const std::size_t size = load<std::uint32_t, order::little>(sizes + 4);
    const char* const bytes = reader_.next(packed);
    // Three bytes encode at most 264.
    constexpr std::size_t most_packed = 90;
    if (bytes == nullptr || size / most_packed > packed || points_ > size / record_ ||
        points_ * record_ != size) {
      fail_cut();
    }
    const std::string data = unpacked({bytes, packed}, size);
    if (data.empty()) reader_.fail("holds packed points that are damaged");
    for (std::size_t i = 0; i < points_; ++i) {
      const auto at = [&](std::size_t axis) {
        const Field& type = types_[axis];
        return number_at(type, data.data() + points_ * offsets_[axis] + i * type.size);
      };
      add({at(0), at(1), at(2)});
    }
  }

  static constexpr auto most_points =
      static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

  ByteReader& reader_;
  std::vector<Field> fields_;
  std::size_t points_ = 0;
  std::size_t record_ = 0;  ///< bytes of a point
  std::array<std::size_t, 3> columns_{};
  std::array<std::size_t, 3> offsets_{};  ///< offset of x, y, z in a point, bytes
  std::array<Field, 3> types_;
  std::size_t left_out_ = 0;
  IndexedMesh mesh_;
};

}  // namespace

void read_pcd(ByteReader& reader, MeshFile& file) { file.mesh = PcdReader(reader).read(); }

}  // namespace wscvt
