// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/csv_table.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"

namespace wscvt {

namespace {

constexpr const char* line_end = "\r\n";
constexpr std::size_t line_end_size = 2;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

/// A file that is open, and nobody else's to append to until its end of scope.
class OpenTable {
 public:
  OpenTable(const std::string& path, int flags)
      : path_(path), descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) fail(path, "cannot be opened; check that it is a file and yours.");
    // Where files cannot be locked, rows of one process at a time are whole all the same.
    ::flock(descriptor_, LOCK_EX);
  }
  OpenTable(const OpenTable&) = delete;
  OpenTable& operator=(const OpenTable&) = delete;
  ~OpenTable() { ::close(descriptor_); }

  std::size_t size() const {
    struct stat state {};
    if (::fstat(descriptor_, &state) != 0) fail(path_, "cannot be read; check the disk.");
    return static_cast<std::size_t>(state.st_size);
  }

  /// As much as there is of it.
  std::string read(std::size_t from, std::size_t size) const {
    std::string bytes(size, '\0');
    std::size_t have = 0;
    while (have < size) {
      const ssize_t count =
          ::pread(descriptor_, bytes.data() + have, size - have, static_cast<off_t>(from + have));
      if (count < 0) fail(path_, "cannot be read; check the disk.");
      if (count == 0) break;
      have += static_cast<std::size_t>(count);
    }
    bytes.resize(have);
    return bytes;
  }

  /// At the end, or nothing of it.
  void append(const std::string& bytes) const {
    const std::size_t before = size();
    std::size_t written = 0;
    while (written < bytes.size()) {
      const ssize_t count = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
      if (count <= 0) break;
      written += static_cast<std::size_t>(count);
    }
    if (written == bytes.size()) return;
    const bool restored = ::ftruncate(descriptor_, static_cast<off_t>(before)) == 0;
    if (before == 0) ::unlink(path_.c_str());
    fail(path_, restored ? "could not be written whole and was left as it was; check the space on "
                           "the disk."
                         : "took a part of a row only; remove its last line and check the disk.");
  }

 private:
  std::string path_;
  int descriptor_;
};

/// Where the row begins.
std::size_t row_of(const std::string& header_and_row) {
  return header_and_row.find(line_end) + line_end_size;
}

/// Throws unless the table is empty or rows like this one may follow it.
void require_header(const std::string& path, const OpenTable& table,
                    const std::string& header_and_row) {
  const std::size_t size = table.size();
  if (size == 0) return;
  const std::string header = header_and_row.substr(0, row_of(header_and_row));
  if (table.read(0, header.size()) != header) {
    throw Error(
        ErrorCode::InvalidInput,
        "\"" + path + "\" is no table with this report's columns; give the name of a new file.");
  }
  if (table.read(size - line_end_size, line_end_size) != line_end) {
    throw Error(ErrorCode::InvalidInput,
                "\"" + path +
                    "\" ends within a row; give the name of a new file, or end its last line with "
                    "CR LF.");
  }
}

/// Pipes and devices have no header to look at.
bool is_stream(const std::string& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

}  // namespace

void append_to_table(const std::string& path, const std::string& header_and_row) {
  if (is_stream(path)) return write_file(path, header_and_row);
  check_writable(path);  // with its sentences about folders and links
  const OpenTable table(path, O_RDWR | O_CREAT | O_APPEND);
  require_header(path, table, header_and_row);
  table.append(table.size() == 0 ? header_and_row : header_and_row.substr(row_of(header_and_row)));
}

void check_table(const std::string& path, const std::string& header_and_row) {
  check_writable(path);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;
  require_header(path, OpenTable(path, O_RDONLY), header_and_row);
}

}  // namespace wscvt
