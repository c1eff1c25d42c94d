// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/voxel_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <boost/endian/conversion.hpp>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

/// Bytes per read.
constexpr std::size_t block_size = std::size_t{1} << 20;

/// With a larger buffer than InputFile's.
class FileBytes : public ByteSource {
 public:
  FileBytes(const std::string& path, std::uint64_t offset) : path_(path), buffer_(block_size) {
    stream_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    errno = 0;
    stream_.open(path, std::ios::binary);
    if (!stream_.is_open()) refuse_to_open(path, errno);
    stream_.seekg(static_cast<std::streamoff>(offset));
  }

  std::size_t read(char* bytes, std::size_t count) override {
    stream_.read(bytes, static_cast<std::streamsize>(count));
    if (stream_.bad()) refuse_to_read(path_);
    return static_cast<std::size_t>(stream_.gcount());
  }

  void skip(std::uint64_t count) override {
    // Skips within the buffer, which seeking would discard.
    if (count < block_size) {
      stream_.ignore(static_cast<std::streamsize>(count));
    } else {
      stream_.seekg(static_cast<std::streamoff>(count), std::ios::cur);
    }
  }

 private:
  std::string path_;
  std::vector<char> buffer_;
  std::ifstream stream_;
};

/// Consecutive streams of gzip or zlib, which zlib distinguishes by their first bytes.
class InflatedBytes : public ByteSource {
 public:
  InflatedBytes(std::unique_ptr<ByteSource> packed, std::string path)
      : packed_(std::move(packed)), path_(std::move(path)), buffer_(block_size / 4) {
    constexpr int gzip_or_zlib = 32;
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
        stream_.avail_in = static_cast<unsigned>(got);
      }
      const auto wanted = static_cast<unsigned>(std::min(count - filled, block_size));
      stream_.next_out = reinterpret_cast<Bytef*>(bytes + filled);
      stream_.avail_out = wanted;
      const int outcome = ::inflate(&stream_, Z_NO_FLUSH);
      filled += wanted - stream_.avail_out;
      if (outcome == Z_STREAM_END) {
        ::inflateReset(&stream_);
      } else if (outcome != Z_OK && outcome != Z_BUF_ERROR) {
        refuse_volume(path_,
                      "holds packed voxels that are damaged. Copy the file again, or export it "
                      "again.");
      }
    }
    return filled;
  }

 private:
  std::unique_ptr<ByteSource> packed_;
  std::string path_;
  std::vector<char> buffer_;
  z_stream stream_ = {};
};

class BytesOfNumbers : public MadeBytes {
 public:
  BytesOfNumbers(std::unique_ptr<ByteSource> text, std::string path)
      : text_(std::move(text)), path_(std::move(path)) {}

 private:
  static bool is_between(int c) { return c == ',' || is_blank(static_cast<char>(c)); }

  bool make(std::vector<char>& made) override {
    while (is_between(text_.peek())) text_.next();
    std::string field;
    constexpr std::size_t longest = 100;
    for (int c = text_.peek(); c >= 0 && c != '<' && !is_between(c) && field.size() < longest;
         c = text_.peek()) {
      field += static_cast<char>(text_.next());
    }
    if (field.empty()) return false;
    const std::optional<double> number = number_in(field);
    if (!number || field.size() == longest) {
      refuse_volume(path_, "has " + in_quotes(field) + " instead of a voxel. Export it again.");
    }
    made.resize(sizeof(double));
    boost::endian::endian_store<double, sizeof(double), boost::endian::order::little>(
        reinterpret_cast<unsigned char*>(made.data()), *number);
    return true;
  }

  Characters text_;
  std::string path_;
};

class PickedBytes : public ByteSource {
 public:
  PickedBytes(std::unique_ptr<ByteSource> bytes, std::uint64_t block, std::uint64_t count,
              std::uint64_t place)
      : bytes_(std::move(bytes)), block_(block), count_(count), place_(place) {}

  std::size_t read(char* bytes, std::size_t count) override {
    std::size_t filled = 0;
    while (filled < count) {
      if (left_ == 0) {
        bytes_->skip(block_ * (is_first_ ? place_ : count_ - 1));
        is_first_ = false;
        left_ = block_;
      }
      const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(left_, count - filled));
      const std::size_t got = bytes_->read(bytes + filled, wanted);
      filled += got;
      left_ -= got;
      if (got < wanted) break;
    }
    return filled;
  }

 private:
  std::unique_ptr<ByteSource> bytes_;
  std::uint64_t block_;
  std::uint64_t count_;
  std::uint64_t place_;
  std::uint64_t left_ = 0;  ///< in the block
  bool is_first_ = true;
};

class JoinedBytes : public ByteSource {
 public:
  JoinedBytes(std::vector<std::string> paths, std::uint64_t part, OpenFile open)
      : paths_(std::move(paths)), part_(part), open_(std::move(open)) {}

  std::size_t read(char* bytes, std::size_t count) override {
    std::size_t filled = 0;
    while (filled < count) {
      if (left_ == 0) {
        if (next_ == paths_.size()) break;
        bytes_ = open_(paths_[next_++]);
        left_ = part_;
      }
      const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(left_, count - filled));
      const std::size_t got = bytes_->read(bytes + filled, wanted);
      if (got < wanted) {
        refuse_volume(paths_[next_ - 1], "has fewer voxels than its part, " +
                                             std::to_string(part_) +
                                             " bytes. Copy it again, or export it again.");
      }
      filled += got;
      left_ -= got;
    }
    return filled;
  }

 private:
  std::vector<std::string> paths_;
  std::uint64_t part_;
  OpenFile open_;
  std::unique_ptr<ByteSource> bytes_;
  std::size_t next_ = 0;
  std::uint64_t left_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> file_bytes(const std::string& path, std::uint64_t offset) {
  return std::make_unique<FileBytes>(path, offset);
}

std::unique_ptr<ByteSource> inflated_bytes(std::unique_ptr<ByteSource> packed, std::string path) {
  return std::make_unique<InflatedBytes>(std::move(packed), std::move(path));
}

std::unique_ptr<ByteSource> bytes_of_numbers(std::unique_ptr<ByteSource> text, std::string path) {
  return std::make_unique<BytesOfNumbers>(std::move(text), std::move(path));
}

std::unique_ptr<ByteSource> picked_bytes(std::unique_ptr<ByteSource> bytes, std::uint64_t block,
                                         std::uint64_t count, std::uint64_t place) {
  return std::make_unique<PickedBytes>(std::move(bytes), block, count, place);
}

std::unique_ptr<ByteSource> joined_bytes(std::vector<std::string> paths, std::uint64_t part,
                                         OpenFile open) {
  return std::make_unique<JoinedBytes>(std::move(paths), part, std::move(open));
}

std::uint64_t file_size(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) refuse_to_open(path, error.default_error_condition().value());
  return size;
}

}  // namespace wscvt
