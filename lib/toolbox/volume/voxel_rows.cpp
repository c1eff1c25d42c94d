// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/voxel_rows.h"

#include <algorithm>
#include <array>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <type_traits>
#include <utility>

#include "toolbox/volume/byte_order_check.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

std::string place_text(std::size_t x, const RowPlace& place) {
  return " at the voxel (" + std::to_string(x) + ", " + std::to_string(place.y) + ", " +
         std::to_string(place.z) + "), counted from 0";
}

/// Refuses a number below 0 that is not the background.
[[noreturn]] void refuse_negative(const std::string& value, std::size_t x, const RowPlace& place,
                                  const LabelCoding& coding) {
  const bool can_be_background = !(coding.background < 0.0);
  refuse_volume(place.path,
                "holds " + value + place_text(x, place) + ". Labels are whole numbers from 0 on. " +
                    (can_be_background ? "If it is the space between the grains, give " +
                                             mention("background", value) + "."
                                       : Sentence("Change it to the background in the volume.")));
}

[[noreturn]] void refuse_fraction(double value, std::size_t x, const RowPlace& place) {
  if (!std::isfinite(value)) {
    refuse_volume(place.path,
                  "holds infinity" + place_text(x, place) +
                      ". Labels are whole numbers. Change it to the background, such as "
                      "0, in the volume.");
  }
  const std::string number = format_number(value, 10);
  refuse_volume(place.path, "holds " + number + place_text(x, place) +
                                ". Labels are whole numbers. If these are grey values, label the "
                                "grains by wscvt segment.");
}

template <class Value, boost::endian::order Order>
void load_grey_row(const char* bytes, std::int64_t offset, std::vector<Label>& row) {
  constexpr double most = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto value = static_cast<double>(load<Value, Order>(bytes + i * sizeof(Value))) +
                       static_cast<double>(offset);
    row[i] = grey_code(static_cast<float>(std::clamp(value, -most, most)));
  }
}

/// Returns the label of a whole number that needs more than a copy.
Label label_of(std::int64_t value, bool is_large, std::size_t x, const RowPlace& place,
               LabelCoding& coding) {
  // Numbers of 64 bits without a sign may be large and look negative.
  const bool is_background = !is_large && static_cast<double>(value) == coding.background;
  if (is_background) {
    return coding.numbers.empty() ? background_label(coding.background) : Label{0};
  }
  if (value < 0 && !is_large) refuse_negative(std::to_string(value), x, place, coding);
  const auto number = static_cast<std::uint64_t>(value);
  if (coding.finds_numbers) return coding.numbers.emplace(number, Label{0}).first->second;
  if (!coding.numbers.empty()) {
    const auto found = coding.numbers.find(number);
    if (found != coding.numbers.end()) return found->second;
    refuse_volume(place.path, "was changed while it was read. Run the command again.");
  }
  if (number > std::numeric_limits<Label>::max()) {
    throw LargeNumber(ErrorCode::InputOutput, "\"" + place.path + "\" holds " +
                                                  std::to_string(number) + place_text(x, place) +
                                                  ". A label has at most 32 bits. Number the "
                                                  "labels anew.");
  }
  return static_cast<Label>(number);
}

template <class Value>
Label label_of_float(Value value, std::size_t x, const RowPlace& place, LabelCoding& coding) {
  if (std::isnan(value)) return background_label(coding.background);
  if (!std::isfinite(value) || value != std::floor(value)) {
    refuse_fraction(static_cast<double>(value), x, place);
  }
  if (static_cast<double>(value) == coding.background) return background_label(coding.background);
  const std::string number = format_number(static_cast<double>(value), 17);
  if (value < Value{0}) refuse_negative(number, x, place, coding);
  refuse_volume(place.path, "holds " + number + place_text(x, place) +
                                ". Labels have at most 32 bits. Save them as whole numbers of 64 "
                                "bits, which are numbered anew.");
}

template <class Value, boost::endian::order Order>
void load_row(const char* bytes, LabelCoding& coding, std::vector<Label>& row,
              const RowPlace& place) {
  const bool is_copied = coding.offset == 0 && !coding.finds_numbers && coding.numbers.empty();
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Value value = load<Value, Order>(bytes + i * sizeof(Value));
    if constexpr (std::is_floating_point_v<Value>) {
      constexpr Value end = 4294967296.0;
      const bool is_label = value >= Value{0} && value < end && value == std::floor(value);
      row[i] = is_label ? static_cast<Label>(value) : label_of_float(value, i, place, coding);
    } else {
      constexpr bool is_always_label =
          !std::numeric_limits<Value>::is_signed && sizeof(Value) <= sizeof(Label);
      constexpr auto most = std::numeric_limits<Label>::max();
      bool is_label = is_copied;
      if constexpr (!is_always_label) {
        is_label = is_label && value >= Value{0} && static_cast<std::uint64_t>(value) <= most;
      }
      if (is_label) {
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): it is not negative
        row[i] = static_cast<Label>(value);
        continue;
      }
      const bool is_large = !std::numeric_limits<Value>::is_signed && sizeof(Value) > 4 &&
                            static_cast<std::uint64_t>(value) >> 63U != 0;
      row[i] =
          label_of(static_cast<std::int64_t>(value) + coding.offset, is_large, i, place, coding);
    }
  }
}

template <boost::endian::order Order>
void load_row(const char* bytes, const VoxelType& type, LabelCoding& coding,
              std::vector<Label>& row, const RowPlace& place) {
  visit_number_type(type, [&](auto number) {
    if (coding.as_grey) return load_grey_row<decltype(number), Order>(bytes, coding.offset, row);
    load_row<decltype(number), Order>(bytes, coding, row, place);
  });
}

class VolumeOfBytes : public LabelVolume {
 public:
  VolumeOfBytes(const VolumeGeometry& geometry, const VoxelType& type, std::vector<BlockPick> picks,
                OpenBytes open, std::string path)
      : LabelVolume(geometry),
        type_(type),
        order_(type, geometry.counts),
        picks_(std::move(picks)),
        open_(std::move(open)),
        path_(std::move(path)) {
    begin();
  }

  const std::vector<Label>& next_row() override {
    if (!coding().as_grey && !coding().no_labels.empty()) {
      throw Error(ErrorCode::InputOutput, coding().no_labels);
    }
    is_at_begin_ = false;
    // Allocated here, after the checks that detect a false count in a packed file.
    const auto count = static_cast<std::size_t>(geometry().counts[0]);
    row_.resize(count);
    packed_.resize(count * static_cast<std::size_t>(type_.bytes));
    if (bytes_->read(packed_.data(), packed_.size()) < packed_.size()) {
      refuse_volume(path_,
                    "ends before its last voxel. Copy it again, or export "
                    "it again.");
    }
    const std::int64_t rows = geometry().counts[1];
    order_.look_at(packed_.data(), next_);
    try {
      labels_of(packed_.data(), type_, coding(), row_, {path_, next_ % rows, next_ / rows});
    } catch (const Error&) {
      order_.take(packed_.data());
      order_.refuse_swapped(path_);
      throw;
    }
    ++next_;
    if (next_ == rows * geometry().counts[2]) order_.finish(*this, coding().as_grey, path_);
    return row_;
  }

  void rewind() override {
    if (!is_at_begin_) begin();
  }

 private:
  void begin() {
    bytes_ = open_();
    for (const BlockPick& pick : picks_) {
      bytes_ = picked_bytes(std::move(bytes_), static_cast<std::uint64_t>(pick.block * type_.bytes),
                            static_cast<std::uint64_t>(pick.count),
                            static_cast<std::uint64_t>(pick.place));
    }
    next_ = 0;
    is_at_begin_ = true;
  }

  VoxelType type_;
  ByteOrderCheck order_;
  std::vector<BlockPick> picks_;
  OpenBytes open_;
  std::string path_;
  std::unique_ptr<ByteSource> bytes_;
  std::vector<char> packed_;
  std::vector<Label> row_;
  std::int64_t next_ = 0;  ///< row
  bool is_at_begin_ = true;
};

/// Whether bytes begin as gzip or zlib streams do.
bool begins_packed(const std::string& path, std::uint64_t offset) {
  std::array<unsigned char, 2> head{};
  if (file_bytes(path, offset)->read(reinterpret_cast<char*>(head.data()), 2) < 2) return false;
  const bool is_gzip = head[0] == 0x1f && head[1] == 0x8b;
  return is_gzip || (head[0] == 0x78 && (head[0] * 256 + head[1]) % 31 == 0);
}

}  // namespace

void labels_of(const char* bytes, const VoxelType& type, LabelCoding& coding,
               std::vector<Label>& row, const RowPlace& place) {
  if (type.big_endian) {
    load_row<boost::endian::order::big>(bytes, type, coding, row, place);
  } else {
    load_row<boost::endian::order::little>(bytes, type, coding, row, place);
  }
}

void check_colours_equal(const char* colours, std::size_t size, const std::string& path) {
  const bool are_equal = std::memcmp(colours, colours + size, size) == 0 &&
                         std::memcmp(colours, colours + 2 * size, size) == 0;
  if (!are_equal) refuse_colours(path);
}

void refuse_colours(const std::string& path) {
  refuse_volume(path,
                "is a picture in colours. A colour is no label: one channel would mix the grains. "
                "Export the labels themselves, as grey numbers of 8, 16 or 32 bits.");
}

VoxelCounts voxel_counts(const std::array<std::int64_t, 3>& counts, const std::string& path) {
  constexpr std::int64_t most = 1000000;
  VoxelCounts result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (counts[axis] < 1 || counts[axis] > most) {
      refuse_volume(path,
                    "gives " + std::to_string(counts[axis]) +
                        " voxels along an axis, but 1 to 1000000 are possible. Export it again.");
    }
    result[axis] = static_cast<std::int32_t>(counts[axis]);
  }
  return result;
}

std::uint64_t stored_bytes(const VoxelCounts& counts, const VoxelType& type,
                           const std::vector<BlockPick>& picks) {
  auto bytes = static_cast<std::uint64_t>(type.bytes);
  for (const std::int32_t count : counts) bytes *= static_cast<std::uint64_t>(count);
  for (const BlockPick& pick : picks) bytes *= static_cast<std::uint64_t>(pick.count);
  return bytes;
}

void check_voxel_bytes(std::uint64_t wanted, std::uint64_t left, Packing packing,
                       const std::string& path) {
  std::uint64_t least = wanted;
  if (packing == Packing::Deflate) least = wanted / 1100;  // at best one byte for 1032
  if (packing == Packing::Text) least = wanted / sizeof(double) * 2 - 1;  // a digit and a blank
  if (least <= left) return;
  refuse_volume(path, "holds " + std::to_string(left) + " bytes of voxels, but its size needs " +
                          std::to_string(wanted) + ". Copy it again, or export it again.");
}

std::unique_ptr<LabelVolume> volume_of_bytes(const VolumeGeometry& geometry, const VoxelType& type,
                                             const std::vector<BlockPick>& picks, OpenBytes open,
                                             const std::string& path) {
  return std::make_unique<VolumeOfBytes>(geometry, type, picks, std::move(open), path);
}

std::unique_ptr<LabelVolume> volume_of_files(const VolumeGeometry& geometry, VoxelType type,
                                             const VoxelData& data) {
  Packing packing = data.packing;
  if (packing == Packing::Text) type = {sizeof(double), true, true, false};
  const std::uint64_t wanted = stored_bytes(geometry.counts, type, data.picks);
  const std::uint64_t part = wanted / data.paths.size();
  if (part * data.paths.size() != wanted) {
    refuse_volume(
        data.paths.front(),
        "is one of " + std::to_string(data.paths.size()) +
            " files, but the slices cannot be divided evenly among them. Correct the list.");
  }
  std::string note;
  std::vector<std::uint64_t> offsets;
  for (const std::string& path : data.paths) {
    const std::uint64_t size = file_size(path);
    const std::uint64_t offset = data.at_end ? size - std::min(size, part) : data.offset;
    const std::uint64_t left = size - std::min(size, offset);
    // ITK and others have written packed voxels without declaring it.
    if (packing == Packing::None && left < part && begins_packed(path, offset)) {
      packing = Packing::Deflate;
    }
    check_voxel_bytes(part, left, packing, path);
    if (packing == Packing::None && left > part && !data.has_more) {
      const std::string more = "holds " + std::to_string(left) +
                               " bytes of voxels, but its size needs " + std::to_string(part);
      if (left / 2 >= part) {
        refuse_volume(path, more + ". Correct its size or the type of its voxels.");
      }
      if (note.empty()) note = "\"" + path + "\" " + more + ". The rest was left out.";
    }
    offsets.push_back(offset);
  }
  const auto open = [packing](const std::string& path, std::uint64_t offset) {
    std::unique_ptr<ByteSource> bytes = file_bytes(path, offset);
    if (packing == Packing::Deflate) return inflated_bytes(std::move(bytes), path);
    if (packing == Packing::Text) return bytes_of_numbers(std::move(bytes), path);
    return bytes;
  };
  std::unique_ptr<LabelVolume> volume = volume_of_bytes(
      geometry, type, data.picks,
      [open, part, paths = data.paths, offset = offsets.front()] {
        if (paths.size() == 1) return open(paths.front(), offset);
        return joined_bytes(paths, part,
                            [=](const std::string& path) { return open(path, offset); });
      },
      data.paths.front());
  if (!note.empty()) volume->add_note(note);
  return volume;
}

std::string voxel_file_beside(const std::string& header, const std::string& name) {
  // A NUL would cut the name, which would be another file.
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
    refuse_volume(header, "names the file " + in_quotes(name) +
                              " for its voxels, which contains control characters. Correct it.");
  }
  if (name.empty()) {
    refuse_volume(header, "names no file of voxels. Export it again.");
  }
  const std::filesystem::path path(name);
  return path.is_absolute()
             ? name
             : (std::filesystem::path(header).parent_path() / path).lexically_normal().string();
}

std::vector<std::string> voxel_files_beside(const std::string& header, const std::string& named,
                                            const std::vector<std::string>& list,
                                            std::optional<std::array<std::int64_t, 3>> numbers) {
  if (lower_case(named).rfind("list", 0) == 0) {
    if (list.empty()) refuse_volume(header, "has an empty list of files. Export it again.");
    std::vector<std::string> files;
    for (const std::string& name : list) files.push_back(voxel_file_beside(header, name));
    return files;
  }
  if (named.find('%') == std::string::npos) return {voxel_file_beside(header, named)};
  TextFields fields(named);
  const std::string pattern(fields.next());
  const bool may_be_left_out = numbers.has_value();
  auto [first, last, step] = numbers.value_or(std::array<std::int64_t, 3>{});
  const std::int64_t count = last - first;
  bool has_last = false;
  for (std::int64_t* const number : {&first, &last, &step}) {
    const std::string_view field = fields.next();
    if (field.empty() && may_be_left_out) break;
    const std::optional<std::int64_t> value = whole_number_in(field);
    if (!value) {
      refuse_volume(header,
                    "has " + in_quotes(named) +
                        " as its files. Write a pattern, and its first number, last and step.");
    }
    *number = *value;
    has_last = has_last || number == &last;
  }
  if (may_be_left_out && !has_last) last = first + count;
  const auto refuse_pattern = [&](const std::string& why) {
    refuse_volume(header, "names its files by the pattern " + in_quotes(pattern) + ", " + why +
                              ". Write it as name_%03d.raw FIRST LAST STEP.");
  };
  const std::size_t percent = pattern.find('%');
  std::size_t end = percent + 1;
  while (end < pattern.size() && pattern[end] >= '0' && pattern[end] <= '9') ++end;
  const std::string digits = pattern.substr(percent + 1, end - percent - 1);
  const bool is_whole = end < pattern.size() &&
                        (pattern[end] == 'd' || pattern[end] == 'i' || pattern[end] == 'u') &&
                        digits.size() <= 2 && pattern.find('%', end) == std::string::npos;
  if (!is_whole) refuse_pattern("which has not one whole number");
  constexpr std::int64_t most = 1000000;  // as voxel_counts
  if (first < 0 || last < 0 || step == 0 || (last - first) / step < 0 ||
      (last - first) / step >= most) {
    refuse_pattern("whose numbers make no list");
  }
  const bool has_zeros = !digits.empty() && digits.front() == '0';
  const std::size_t width = digits.empty() ? 0 : std::stoul(digits);
  std::vector<std::string> files;
  for (std::int64_t k = 0; k <= (last - first) / step; ++k) {
    std::string number = std::to_string(first + k * step);
    if (number.size() < width) number.insert(0, width - number.size(), has_zeros ? '0' : ' ');
    files.push_back(
        voxel_file_beside(header, pattern.substr(0, percent) + number + pattern.substr(end + 1)));
  }
  return files;
}

void check_dimensions(std::int64_t said, std::size_t sizes, const std::string& header) {
  if (sizes == 0) refuse_volume(header, "does not say how large it is. Export it again.");
  if (said != static_cast<std::int64_t>(sizes)) {
    refuse_volume(header, "says that it has " + std::to_string(said) +
                              " dimensions, but has sizes of " + std::to_string(sizes) +
                              ". Export it again.");
  }
  if (sizes == 2) {
    refuse_volume(header,
                  "has two dimensions: it is one image, but grains need a stack of images.");
  }
}

}  // namespace wscvt
