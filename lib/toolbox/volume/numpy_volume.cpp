// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy's arrays (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html), single
// or in the zip file of savez. The header is a line of Python, for which Debian has no library
// except Python itself; minizip reads the zip file.
#ifdef WSCVT_HAS_PACKERS
#include <unzip.h>
#endif

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "toolbox/volume/open_volume.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct NumpyHeader {
  std::string type;  ///< "<u2"
  bool is_fortran = false;
  std::vector<std::int64_t> counts;
};

/// Returns the value of 'key': in a dictionary of Python, without white space.
std::string value_in(const std::string& text, const std::string& key, const std::string& path) {
  const std::size_t place = text.find("'" + key + "':");
  if (place == std::string::npos) {
    refuse_volume(path, "has a NumPy header without " + in_quotes(key) + ". Save it again.");
  }
  return text.substr(place + key.size() + 3);
}

NumpyHeader numpy_header_of(const std::string& head, const std::string& path) {
  std::string text;
  for (const char c : head) {
    if (c != ' ' && c != '\n') text += c == '"' ? '\'' : c;
  }
  NumpyHeader header;
  const std::string type = value_in(text, "descr", path);
  if (type.empty() || type.front() != '\'' || type.find('\'', 1) == std::string::npos) {
    refuse_volume(path, "has an array of records. Save one field of it.");
  }
  header.type = type.substr(1, type.find('\'', 1) - 1);
  const std::string order = value_in(text, "fortran_order", path);
  header.is_fortran = order.rfind("True", 0) == 0;
  if (!header.is_fortran && order.rfind("False", 0) != 0) {
    refuse_volume(path, "has a NumPy header whose order is neither True nor False.");
  }
  const std::string shape = value_in(text, "shape", path);
  const std::size_t end = shape.find(')');
  if (shape.empty() || shape.front() != '(' || end == std::string::npos) {
    refuse_volume(path, "has a NumPy header without a shape. Save it again.");
  }
  for (std::size_t begin = 1; begin < end;) {
    const std::size_t comma = std::min(shape.find(',', begin), end);
    const std::optional<std::int64_t> count =
        whole_number_in(std::string_view(shape).substr(begin, comma - begin));
    if (!count || *count < 1) {
      refuse_volume(path, "has a NumPy header whose shape is not of whole numbers above 0.");
    }
    header.counts.push_back(*count);
    begin = comma + 1;
  }
  return header;
}

/// Reads the header, so that `bytes` continue with the voxels. Adds the size of the header to
/// `offset`.
NumpyHeader read_header(ByteSource& bytes, std::uint64_t& offset, const std::string& path) {
  std::array<unsigned char, 12> head{};
  const auto read = [&](std::size_t begin, std::size_t count) {
    if (bytes.read(reinterpret_cast<char*>(head.data()) + begin, count) < count) {
      refuse_volume(path, "is not a NumPy array. Save it again.");
    }
  };
  read(0, 8);
  if (std::memcmp(head.data(), "\x93NUMPY", 6) != 0 || head[6] < 1 || head[6] > 3) {
    refuse_volume(path, "is not a NumPy array. Save it again.");
  }
  const std::size_t length_bytes = head[6] == 1 ? 2 : 4;
  read(8, length_bytes);
  std::size_t length = 0;
  for (std::size_t k = length_bytes; k-- > 0;) length = length << 8 | head[8 + k];
  constexpr std::size_t longest = 1 << 20;
  if (length > longest) refuse_volume(path, "has a NumPy header of a megabyte. Save it again.");
  std::string text(length, '\0');
  if (bytes.read(text.data(), length) < length) {
    refuse_volume(path, "ends within its NumPy header. Copy it again.");
  }
  offset = 8 + length_bytes + length;
  return numpy_header_of(text, path);
}

/// Reads a type, such as "<u2", "|b1", ">f8".
VoxelType numpy_type_of(const std::string& text, const std::string& path) {
  const bool has_order = !text.empty() && std::strchr("<>|=", text.front()) != nullptr;
  const std::string kind = text.substr(has_order ? 1 : 0);
  const bool is_whole = kind.size() == 2 && (kind[0] == 'u' || kind[0] == 'i') &&
                        std::string_view("1248").find(kind[1]) != std::string_view::npos;
  const bool is_float = kind == "f4" || kind == "f8";
  if (!is_whole && !is_float && kind != "b1") {
    refuse_volume(path, "has voxels of NumPy's type " + in_quotes(text) +
                            ", which cannot be read. Save labels as uint16 or uint32, grey values "
                            "as float32.");
  }
  return {kind[1] - '0', is_float || kind[0] == 'i', is_float, has_order && text.front() == '>'};
}

#ifdef WSCVT_HAS_PACKERS
/// A member of a zip file.
class ZipBytes : public ByteSource {
 public:
  ZipBytes(std::string path, std::string member)
      : path_(std::move(path)), member_(std::move(member)) {
    zip_ = unzOpen64(path_.c_str());
    if (zip_ == nullptr || unzLocateFile(zip_, member_.c_str(), 1) != UNZ_OK ||
        unzOpenCurrentFile(zip_) != UNZ_OK) {
      close();
      refuse_volume(path_, "cannot be unpacked. Copy it again, or save it again.");
    }
  }
  ZipBytes(const ZipBytes&) = delete;
  ZipBytes& operator=(const ZipBytes&) = delete;
  ~ZipBytes() override { close(); }

  std::size_t read(char* bytes, std::size_t count) override {
    std::size_t filled = 0;
    while (filled < count) {
      constexpr std::size_t most = 1 << 20;
      const int got = unzReadCurrentFile(zip_, bytes + filled,
                                         static_cast<unsigned>(std::min(count - filled, most)));
      if (got == UNZ_PARAMERROR) break;  // closed after the last byte
      if (got < 0) refuse_damaged();
      if (got == 0) break;
      filled += static_cast<std::size_t>(got);
      // The checksum is tested after the last byte.
      if (unzeof(zip_) == 1 && unzCloseCurrentFile(zip_) == UNZ_CRCERROR) refuse_damaged();
    }
    return filled;
  }

 private:
  [[noreturn]] void refuse_damaged() const {
    refuse_volume(path_, "is damaged in " + in_quotes(member_) + ". Copy it again.");
  }

  void close() {
    if (zip_ == nullptr) return;
    unzCloseCurrentFile(zip_);
    unzClose(zip_);
  }

  std::string path_;
  std::string member_;
  unzFile zip_ = nullptr;
};

/// Returns the members of a zip file that are arrays, with their stated sizes in bytes.
std::vector<std::pair<std::string, std::uint64_t>> members_of(const std::string& path) {
  const unzFile zip = unzOpen64(path.c_str());
  if (zip == nullptr)
    refuse_volume(path, "is not a zip file, as a .npz file must be. Save it again.");
  std::vector<std::pair<std::string, std::uint64_t>> members;
  for (int state = unzGoToFirstFile(zip); state == UNZ_OK; state = unzGoToNextFile(zip)) {
    unz_file_info64 info{};
    std::array<char, 1024> name{};
    if (unzGetCurrentFileInfo64(zip, &info, name.data(), name.size() - 1, nullptr, 0, nullptr, 0) !=
        UNZ_OK) {
      break;
    }
    members.emplace_back(name.data(), info.uncompressed_size);
  }
  unzClose(zip);
  return members;
}
#endif

ShapedVolume shaped(const NumpyHeader& header, const VolumeChoice& choice,
                    const std::string& path) {
  ArrayShape shape;
  shape.counts = header.counts;
  if (header.is_fortran) {
    // The first dimension is the fastest; the order z, y, x of the dimensions stays.
    if (header.counts.size() != 3) {
      refuse_volume(path, "holds an array in Fortran's order of " +
                              std::to_string(header.counts.size()) +
                              " dimensions. Save only one volume.");
    }
    shape.counts = {header.counts[2], header.counts[1], header.counts[0]};
    shape.roles = {0, 1, 2};
  }
  return volume_of_shape(shape, choice, path);
}

}  // namespace

std::unique_ptr<LabelVolume> open_npy(const std::string& path, const VolumeChoice& choice) {
  refuse_array_choice(choice, path);
  VoxelData data;
  data.paths = {path};
  const NumpyHeader header = read_header(*file_bytes(path, 0), data.offset, path);
  const ShapedVolume volume = shaped(header, choice, path);
  data.picks = volume.picks;
  return volume_of_files(volume.geometry, numpy_type_of(header.type, path), data);
}

std::unique_ptr<LabelVolume> volume_of_array(const VolumeArray& array, const VolumeChoice& choice,
                                             const std::string& name) {
  const ShapedVolume volume = shaped({array.type, false, array.counts}, choice, name);
  const VoxelType type = numpy_type_of(array.type, name);
  auto size = static_cast<std::size_t>(type.bytes);
  for (const std::int64_t count : array.counts) size *= static_cast<std::size_t>(count);
  const std::string_view bytes(static_cast<const char*>(array.numbers), size);
  return volume_of_bytes(
      volume.geometry, type, volume.picks, [bytes] { return std::make_unique<MemoryBytes>(bytes); },
      name);
}

#ifdef WSCVT_HAS_PACKERS
std::unique_ptr<LabelVolume> open_npz(const std::string& path, const VolumeChoice& choice) {
  const auto members = members_of(path);
  std::vector<std::string> names;
  for (const auto& [name, size] : members) {
    const bool is_array = name.size() > 4 && name.compare(name.size() - 4, 4, ".npy") == 0;
    names.push_back(is_array ? name.substr(0, name.size() - 4) : name);
  }
  if (names.empty()) refuse_volume(path, "has no array. Save it again.");
  const auto& [member, size] = members[chosen_array(names, choice, path)];
  std::uint64_t offset = 0;
  ZipBytes head(path, member);
  const NumpyHeader header = read_header(head, offset, path);
  const ShapedVolume volume = shaped(header, choice, path);
  const VoxelType type = numpy_type_of(header.type, path);
  const std::uint64_t wanted = stored_bytes(volume.geometry.counts, type, volume.picks);
  check_voxel_bytes(wanted, size - std::min(size, offset), Packing::None, path);
  check_voxel_bytes(wanted, file_size(path), Packing::Deflate, path);
  return volume_of_bytes(
      volume.geometry, type, volume.picks,
      [path, name = member, offset] {
        auto bytes = std::make_unique<ZipBytes>(path, name);
        bytes->skip(offset);
        return bytes;
      },
      path);
}
#else
std::unique_ptr<LabelVolume> open_npz(const std::string& path, const VolumeChoice&) {
  refuse_without(path, "minizip", "libminizip-dev");
}
#endif

}  // namespace wscvt
