// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/byte_source.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/machine_refused.h"

namespace wscvt {

namespace {

/// Bytes that are fetched at once.
constexpr std::size_t block_size = std::size_t{1} << 20;

class FileBytes : public ByteSource {
 public:
  FileBytes(const std::string& path, std::uint64_t offset)
      : path_(path), buffer_(block_size), offset_(offset) {
    stream_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    errno = 0;
    stream_.open(path, std::ios::binary);
    if (!stream_.is_open()) refuse_to_open(path, errno);
    FileBytes::rewind();
  }

  std::size_t read(char* bytes, std::size_t count) override {
    stream_.read(bytes, static_cast<std::streamsize>(count));
    if (stream_.bad()) refuse_to_read(path_);
    return static_cast<std::size_t>(stream_.gcount());
  }

  void rewind() override {
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset_));
  }

 private:
  std::string path_;
  std::vector<char> buffer_;
  std::ifstream stream_;
  std::uint64_t offset_;
};

class InflatedBytes : public ByteSource {
 public:
  InflatedBytes(std::unique_ptr<ByteSource> packed, std::string path)
      : packed_(std::move(packed)), path_(std::move(path)), buffer_(block_size / 4) {
    constexpr int gzip_or_zlib = 32;  // told apart by their first bytes
    if (::inflateInit2(&stream_, MAX_WBITS + gzip_or_zlib) != Z_OK) throw std::bad_alloc();
  }
  InflatedBytes(const InflatedBytes&) = delete;
  InflatedBytes& operator=(const InflatedBytes&) = delete;
  ~InflatedBytes() override { ::inflateEnd(&stream_); }

  std::size_t read(char* bytes, std::size_t count) override {
    std::size_t filled = 0;
    while (filled < count) {
      if (stream_.avail_in == 0) {
        const std::size_t got = packed_->read(buffer_.data(), buffer_.size());
        if (got == 0) return filled;
        stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
        stream_.avail_in = static_cast<uInt>(got);
      }
      const auto wanted = static_cast<uInt>(std::min(count - filled, block_size));
      stream_.next_out = reinterpret_cast<Bytef*>(bytes + filled);
      stream_.avail_out = wanted;
      const int outcome = ::inflate(&stream_, Z_NO_FLUSH);
      filled += wanted - stream_.avail_out;
      if (outcome == Z_STREAM_END) {
        ::inflateReset(&stream_);
      } else if (outcome != Z_OK && outcome != Z_BUF_ERROR) {
        throw Error(ErrorCode::InputOutput, "\"" + path_ +
                                                "\" holds packed voxels that are damaged; copy the "
                                                "file again, or export it again.");
      }
    }
    return filled;
  }

  void rewind() override {
    packed_->rewind();
    ::inflateReset(&stream_);
    stream_.avail_in = 0;
  }

 private:
  std::unique_ptr<ByteSource> packed_;
  std::string path_;
  std::vector<char> buffer_;
  z_stream stream_{};
};

/// The six bits that each character stands for; -1 for those that stand for none.
constexpr std::array<signed char, 256> base64_values() {
  std::array<signed char, 256> values{};
  for (auto& value : values) value = -1;
  for (std::size_t k = 0; k < 26; ++k) {
    values['A' + k] = static_cast<signed char>(k);
    values['a' + k] = static_cast<signed char>(26 + k);
  }
  for (std::size_t k = 0; k < 10; ++k) values['0' + k] = static_cast<signed char>(52 + k);
  values['+'] = 62;
  values['/'] = 63;
  return values;
}

class Base64Bytes : public ByteSource {
 public:
  explicit Base64Bytes(std::unique_ptr<ByteSource> text)
      : text_(std::move(text)), buffer_(block_size / 4) {}

  std::size_t read(char* bytes, std::size_t count) override {
    static constexpr std::array<signed char, 256> values = base64_values();
    std::size_t filled = 0;
    while (filled < count) {
      if (next_ == made_.size()) {
        made_.clear();
        next_ = 0;
        if (has_ended_) return filled;
        // Four characters are three bytes; a text ends with fewer, and "=" in the others' place.
        std::array<int, 4> group{};
        std::size_t held = 0;
        std::size_t padding = 0;
        while (held + padding < 4) {
          const int c = next_character();
          if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
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
          made_ += static_cast<char>(word >> (24 - 8 * static_cast<int>(k)) & 0xff);
        }
        continue;
      }
      bytes[filled++] = made_[next_++];
    }
    return filled;
  }

  void rewind() override {
    text_->rewind();
    begin_ = end_ = 0;
    made_.clear();
    next_ = 0;
    has_ended_ = false;
  }

 private:
  /// -1 at the end.
  int next_character() {
    if (begin_ == end_) {
      begin_ = 0;
      end_ = text_->read(buffer_.data(), buffer_.size());
      if (end_ == 0) return -1;
    }
    return static_cast<unsigned char>(buffer_[begin_++]);
  }

  std::unique_ptr<ByteSource> text_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::string made_;
  std::size_t next_ = 0;
  bool has_ended_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> file_bytes(const std::string& path, std::uint64_t offset) {
  return std::make_unique<FileBytes>(path, offset);
}

std::unique_ptr<ByteSource> inflated_bytes(std::unique_ptr<ByteSource> packed, std::string path) {
  return std::make_unique<InflatedBytes>(std::move(packed), std::move(path));
}

std::unique_ptr<ByteSource> base64_bytes(std::unique_ptr<ByteSource> text) {
  return std::make_unique<Base64Bytes>(std::move(text));
}

std::uint64_t file_size(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) refuse_to_open(path, error.value());
  return size;
}

}  // namespace wscvt
