// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/byte_reader.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>
#include <limits>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

constexpr std::size_t bytes_at_once = std::size_t{1} << 18;

}  // namespace

ByteReader::ByteReader(std::istream& stream, std::uintmax_t size, std::string path,
                       Execution execution)
    : stream_(stream),
      path_(std::move(path)),
      buffer_(bytes_at_once),
      size_(size),
      unread_(size),
      execution_(std::move(execution)) {}

bool ByteReader::fill(std::size_t count) {
  if (count > remaining()) return false;
  execution_.report(1.0 - static_cast<double>(unread_) / static_cast<double>(size_), "Reading");
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (buffer_.size() < count) buffer_.resize(count);
  const std::size_t wanted =
      static_cast<std::size_t>(std::min<std::uintmax_t>(buffer_.size() - end_, unread_));
  stream_.read(buffer_.data() + end_, static_cast<std::streamsize>(wanted));
  const auto got = static_cast<std::size_t>(stream_.gcount());
  end_ += got;
  // The file ends here if it became shorter after its size was read.
  unread_ = got < wanted ? 0 : unread_ - got;
  return end_ >= count;
}

bool ByteReader::skip(std::uintmax_t count) {
  if (count > remaining()) return false;
  while (count > 0) {
    const auto part = static_cast<std::size_t>(std::min<std::uintmax_t>(count, bytes_at_once));
    if (next(part) == nullptr) return false;
    count -= part;
  }
  return true;
}

std::string_view ByteReader::peek(std::size_t count) {
  const auto wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(count, remaining()));
  if (end_ - begin_ < wanted) fill(wanted);
  return {buffer_.data() + begin_, std::min(wanted, end_ - begin_)};
}

std::optional<std::string_view> ByteReader::line() {
  if (line_number_ == 0) {
    if (peek(3) == "\xEF\xBB\xBF") skip(3);
    const std::string_view start = peek(bytes_at_once);
    const std::size_t first = start.find_first_of("\r\n");
    if (first != std::string_view::npos && start[first] == '\r' &&
        start.substr(first + 1, 1) != "\n") {
      line_end_ = '\r';
    }
  }
  if (remaining() == 0) return {};
  std::size_t searched = 0;
  for (;;) {
    const std::size_t held = end_ - begin_;
    const char* const bytes = buffer_.data() + begin_;
    if (held > searched) {
      if (const void* const found = std::memchr(bytes + searched, line_end_, held - searched)) {
        auto length = static_cast<std::size_t>(static_cast<const char*>(found) - bytes);
        begin_ += length + 1;
        if (length > 0 && bytes[length - 1] == '\r') --length;
        ++line_number_;
        return std::string_view(bytes, length);
      }
    }
    if (unread_ == 0) {  // the last line, without a line break
      begin_ = end_;
      ++line_number_;
      return std::string_view(bytes, held);
    }
    searched = held;
    // Doubles each time, so that a file of one line does not take longer than others.
    peek(std::max(bytes_at_once, 2 * held));
  }
}

std::optional<std::string_view> ByteReader::filled_line() {
  while (const std::optional<std::string_view> text = line()) {
    if (!TextFields(*text).next().empty()) return text;
  }
  return {};
}

void ByteReader::refuse(const std::string& what) const {
  throw Error(ErrorCode::InputOutput, "\"" + path_ + "\" " + what);
}

void ByteReader::refuse_line(const std::string& what) const {
  refuse("line " + std::to_string(line_number_) + " " + what);
}

void ByteReader::check_count(std::uintmax_t count, const char* more) const {
  constexpr auto most = static_cast<std::uintmax_t>(std::numeric_limits<std::int32_t>::max());
  if (count > most) refuse(std::string(more) + " than can be numbered. Reduce the scan first.");
}

void ByteReader::fail_field(std::string_view field, const std::string& due) const {
  fail_line("has " + in_quotes(field) + " instead of " + due);
}

bool is_gzip(const std::string& path) {
  std::array<char, 3> start{};
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), start.size()) && start[0] == '\x1f' && start[1] == '\x8b' &&
         start[2] == '\x08';
}

std::string gzip_content(const std::string& path, const Execution& execution) {
  errno = 0;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(::gzopen(path.c_str(), "rb"), ::gzclose);
  if (!file) refuse_to_open(path, errno);
  // A mesh shrinks to a tenth, seldom to a fiftieth; what shrinks more is made to fill the memory.
  constexpr std::uintmax_t most_times = 100;
  constexpr std::uintmax_t always_unpacked = std::uintmax_t{64} << 20;
  std::error_code unknown;
  const std::uintmax_t packed = std::filesystem::file_size(path, unknown);
  const std::uintmax_t most = always_unpacked + (unknown ? 0 : most_times * packed);
  std::string content;
  std::vector<char> part(std::size_t{1} << 20);
  for (;;) {
    execution.report(0.0, "Unpacking");
    const int count = ::gzread(file.get(), part.data(), static_cast<unsigned>(part.size()));
    if (count > 0) content.append(part.data(), static_cast<std::size_t>(count));
    if (content.size() > most) {
      throw Error(ErrorCode::InputOutput,
                  "\"" + path + "\" unpacks to more than " + std::to_string(most >> 20) +
                      " MB, a hundred times its size, which no mesh does. If it is one, unpack it "
                      "with gunzip first.");
    }
    if (count == static_cast<int>(part.size())) continue;
    int error = Z_OK;
    ::gzerror(file.get(), &error);
    if (error == Z_MEM_ERROR) throw std::bad_alloc();
    if (error == Z_ERRNO) refuse_to_read(path);
    if (count >= 0 && error == Z_OK) return content;
    throw Error(ErrorCode::InputOutput,
                "\"" + path +
                    "\" is a gzip file that is cut or damaged. Copy it again, or export the mesh "
                    "again.");
  }
}

}  // namespace wscvt
