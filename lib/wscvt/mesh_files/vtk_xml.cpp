// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's library has 100 MB, and an XML parser would be one more to link for a few tags.
#include "wscvt/mesh_files/vtk_xml.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct XmlTag {
  std::string name;  ///< with its slash if it ends an element
  XmlAttributes attributes;
  bool is_whole = false;
};

/// Of a word or a value.
constexpr std::size_t most_characters = std::size_t{1} << 20;

/// Whether an element contains arrays. Other elements may be inside an array.
bool is_section(const std::string& name) {
  constexpr std::string_view sections[] = {"Points",    "Verts",    "Lines",     "Strips", "Polys",
                                           "PointData", "CellData", "FieldData", "Cells"};
  return std::find(std::begin(sections), std::end(sections), name) != std::end(sections);
}

void skip_blanks_and(char other, Characters& text) {
  while (is_blank(static_cast<char>(text.peek())) || text.peek() == other) text.next();
}

std::string next_word(Characters& text) {
  std::string word;
  for (int c = text.peek(); c >= 0 && !is_blank(static_cast<char>(c)) && c != '>' && c != '=' &&
                            (c != '/' || word.empty()) && word.size() < most_characters;
       c = text.peek()) {
    word += static_cast<char>(text.next());
  }
  return word;
}

/// Returns a value with the characters that XML replaces.
std::string unescaped(std::string value) {
  constexpr std::pair<std::string_view, char> names[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
  for (std::size_t at = value.find('&'); at < value.size(); at = value.find('&', at + 1)) {
    for (const auto& [name, character] : names) {
      if (value.compare(at, name.size(), name) == 0) value.replace(at, name.size(), 1, character);
    }
  }
  return value;
}

/// Returns the tag after its "<".
XmlTag read_tag(Characters& text) {
  XmlTag tag;
  tag.name = next_word(text);
  for (;;) {
    skip_blanks_and('/', text);
    if (text.peek() == '>') break;
    const std::string key = next_word(text);
    skip_blanks_and('=', text);
    const int quote = text.next();
    if (quote != '"' && quote != '\'') return tag;
    std::string value;
    for (int c = text.next(); c != quote; c = text.next()) {
      if (c < 0 || value.size() == most_characters) return tag;
      value += static_cast<char>(c);
    }
    tag.attributes[key] = unescaped(value);
  }
  text.next();
  tag.is_whole = true;
  return tag;
}

/// Returns the next tag; nothing at the end of the text.
std::optional<XmlTag> next_tag(Characters& text) {
  while (text.skip_past('<')) {
    if (text.peek() == '!') {  // a comment, which may contain tags
      for (int c = 0, dashes = 0; c >= 0 && (c != '>' || dashes < 2);) {
        dashes = c == '-' ? dashes + 1 : 0;
        c = text.next();
      }
    } else if (text.peek() != '?') {
      return read_tag(text);
    }
  }
  return {};
}

/// Six-bit values of the characters; -1 for other characters.
constexpr std::array<signed char, 256> base64_values() {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<signed char, 256> values{};
  for (auto& value : values) value = -1;
  signed char value = 0;
  for (const char digit : digits) values[static_cast<unsigned char>(digit)] = value++;
  return values;
}

class Base64Bytes : public MadeBytes {
 public:
  explicit Base64Bytes(std::unique_ptr<ByteSource> text) : text_(std::move(text)) {}

 private:
  bool make(std::vector<char>& made) override {
    constexpr std::size_t at_once = 4096;
    while (!has_ended_ && made.size() < at_once) make_three(made);
    return !made.empty();
  }

  /// Four characters are three bytes; the last group of a text may be shorter, padded with "=".
  void make_three(std::vector<char>& made) {
    static constexpr std::array<signed char, 256> values = base64_values();
    std::array<int, 4> group{};
    std::size_t held = 0;
    std::size_t padding = 0;
    while (held + padding < 4) {
      const int c = text_.next();
      if (is_blank(static_cast<char>(c))) continue;
      const int value = c < 0 ? -1 : values[static_cast<std::size_t>(c)];
      if (c == '=') {
        ++padding;
      } else if (value >= 0 && padding == 0) {
        group[held++] = value;
      } else {
        has_ended_ = true;
        break;
      }
    }
    const int word = group[0] << 18 | group[1] << 12 | group[2] << 6 | group[3];
    for (std::size_t k = 1; k < held; ++k) {
      made.push_back(static_cast<char>(word >> (24 - 8 * static_cast<int>(k)) & 0xff));
    }
  }

  Characters text_;
  bool has_ended_ = false;
};

bool unpack_zlib(const std::vector<char>& packed, std::vector<char>& made) {
  uLongf size = made.size();
  return ::uncompress(reinterpret_cast<Bytef*>(made.data()), &size,
                      reinterpret_cast<const Bytef*>(packed.data()),
                      static_cast<uLong>(packed.size())) == Z_OK &&
         size == made.size();
}

/// Sizes of a block, packed and unpacked.
using BlockSizes = std::pair<std::uint64_t, std::uint64_t>;

class UnpackedBytes : public MadeBytes {
 public:
  UnpackedBytes(std::unique_ptr<ByteSource> bytes, VtkPacking packing,
                std::vector<BlockSizes> blocks)
      : bytes_(std::move(bytes)), packing_(std::move(packing)), blocks_(std::move(blocks)) {}

 private:
  /// Unpacks a block.
  bool make(std::vector<char>& made) override {
    if (next_block_ == blocks_.size()) return false;
    const auto [packed, unpacked] = blocks_[next_block_++];
    packed_.resize(packed);
    if (bytes_->read(packed_.data(), packed) < packed) packing_.refuse(packing_.cut);
    made.resize(unpacked);
    if (!packing_.unpack(packed_, made)) packing_.refuse(packing_.damaged);
    return true;
  }

  std::unique_ptr<ByteSource> bytes_;
  VtkPacking packing_;
  std::vector<BlockSizes> blocks_;
  std::size_t next_block_ = 0;
  std::vector<char> packed_;
};

}  // namespace

std::string value_of(const XmlAttributes& attributes, const std::string& key,
                     const std::string& fallback) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? fallback : found->second;
}

VtkXml read_vtk_xml(std::unique_ptr<ByteSource> source) {
  Characters text(std::move(source));
  VtkXml xml;
  std::string section;
  std::uint64_t appendix = 0;
  bool is_base64 = true;
  while (const std::optional<XmlTag> tag = next_tag(text)) {
    const bool is_first = !xml.is_whole;
    xml.is_whole = tag->is_whole && (!is_first || tag->name == "VTKFile");
    if (!xml.is_whole) break;
    if (tag->name == "VTKFile") {
      xml.file = tag->attributes;
    } else if (tag->name == "ImageData") {
      xml.image = tag->attributes;
    } else if (tag->name == "Piece") {
      xml.pieces.push_back({tag->attributes, {}});
    } else if (tag->name == "DataArray" && !xml.pieces.empty()) {
      const std::string name = section == "Points" ? "" : value_of(tag->attributes, "Name");
      xml.pieces.back().arrays.push_back({section, name, tag->attributes, text.offset(), true});
    } else if (tag->name == "AppendedData") {
      skip_blanks_and(' ', text);
      if (text.next() == '_') appendix = text.offset();
      is_base64 = value_of(tag->attributes, "encoding", "base64") != "raw";
      break;
    } else if (is_section(tag->name)) {
      section = tag->name;
    }
  }
  for (XmlPiece& piece : xml.pieces) {
    for (XmlArray& array : piece.arrays) {
      if (value_of(array.attributes, "format") != "appended") continue;
      const auto offset = whole_number_in(value_of(array.attributes, "offset", "0"));
      const bool has_data = appendix > 0 && offset && *offset >= 0;
      array.data = has_data ? appendix + static_cast<std::uint64_t>(*offset) : 0;
      array.is_base64 = is_base64;
    }
  }
  return xml;
}

boost::endian::order order_of(const XmlAttributes& file) {
  return value_of(file, "byte_order", "LittleEndian") == "BigEndian" ? boost::endian::order::big
                                                                     : boost::endian::order::little;
}

VtkPacking::VtkPacking(const XmlAttributes& file,
                       std::function<void(const std::string&)> throw_error, UnpackBlock unpack_lz4)
    : order(order_of(file)),
      has_long_lengths(value_of(file, "header_type", "UInt32") == "UInt64"),
      refuse(std::move(throw_error)) {
  const std::string packer = value_of(file, "compressor");
  if (packer == "vtkZLibDataCompressor") {
    unpack = unpack_zlib;
  } else if (packer == "vtkLZ4DataCompressor" && unpack_lz4 != nullptr) {
    unpack = unpack_lz4;
  } else if (!packer.empty()) {
    refuse("is packed by " + in_quotes(packer) + ". Save it plain, or by ZLib" +
           (unpack_lz4 == nullptr ? "." : " or LZ4."));
  }
}

std::unique_ptr<ByteSource> vtk_array_bytes(std::unique_ptr<ByteSource> stored, std::uint64_t left,
                                            bool is_base64, const VtkPacking& packing,
                                            std::uint64_t& size) {
  if (is_base64) {
    stored = std::make_unique<Base64Bytes>(std::move(stored));
    left = left / 4 * 3 + 3;
  }
  const Stored type = packing.has_long_lengths ? Stored::Uint64 : Stored::Uint32;
  const auto next_length = [&] {
    std::array<char, 8> bytes{};
    if (stored->read(bytes.data(), size_of(type)) < size_of(type)) packing.refuse(packing.cut);
    return load_as<std::uint64_t>(type, packing.order, bytes.data());
  };
  size = next_length();
  if (packing.unpack == nullptr) {
    if (size > left) packing.refuse(packing.cut);
    return stored;
  }
  const std::uint64_t count = std::exchange(size, 0);
  const std::uint64_t full = next_length();
  const std::uint64_t last = next_length();
  std::vector<BlockSizes> blocks;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::uint64_t packed = next_length();
    const std::uint64_t unpacked = k + 1 == count && last != 0 ? last : full;
    // No compression reaches more.
    constexpr std::uint64_t most_packed = 1100;
    constexpr std::uint64_t most_block = std::uint64_t{1} << 30;
    if (packed > std::min(left, most_block) || unpacked == 0 ||
        unpacked > std::min(most_block, packed * most_packed)) {
      packing.refuse(packing.cut);
    }
    left -= packed;
    size += unpacked;
    blocks.emplace_back(packed, unpacked);
  }
  return std::make_unique<UnpackedBytes>(std::move(stored), packing, std::move(blocks));
}

}  // namespace wscvt
