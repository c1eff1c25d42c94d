// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/open_table.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/system_files.h"

namespace wscvt {

namespace {

[[noreturn]] void fail_table(const std::string& path, const std::string& what) {
  throw MachineRefused("\"" + path + "\" " + what);
}

}  // namespace

OpenTable::OpenTable(std::string path, TableUse use)
    : path_(std::move(path)), file_(std::make_unique<system_files::LockedFile>()) {
  using system_files::Opening;
  const Opening opening = file_->open(path_, use != TableUse::Read, use != TableUse::AppendAlone);
  if (opening == Opening::Refused) {
    fail_table(path_, "cannot be opened. Check that it is a file and yours.");
  }
  if (opening == Opening::Locked) {
    fail_table(path_, "is being written by another batch. Wait for it, or give another folder.");
  }
}

OpenTable::~OpenTable() = default;

std::size_t OpenTable::size() const {
  const auto size = file_->size();
  if (!size) fail_table(path_, "cannot be read. Check the disk.");
  return *size;
}

std::string OpenTable::read(std::size_t from, std::size_t size) const {
  auto bytes = file_->read(from, size);
  if (!bytes) fail_table(path_, "cannot be read. Check the disk.");
  return std::move(*bytes);
}

void OpenTable::append(const std::string& bytes) const {
  const std::size_t before = size();
  if (file_->append(bytes)) return;
  const bool restored = file_->cut(before);
  std::error_code ignored;
  if (before == 0) std::filesystem::remove(path_, ignored);
  fail_table(
      path_,
      restored
          ? "could not be written completely and was left unchanged. Check the space on the disk."
          : "now ends within a row. Remove its last line and check the disk.");
}

void OpenTable::cut(std::size_t size) const {
  if (file_->cut(size)) return;
  fail_table(path_, "ends within a row that cannot be removed. Check the owner of the file.");
}

namespace {

constexpr const char* line_end = "\r\n";
constexpr std::size_t line_end_size = 2;

/// Returns the index of the row's first byte.
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
    refuse("\"" + path +
           "\" is not a table with this report's columns. Give the name of a new file.");
  }
  if (table.read(size - line_end_size, line_end_size) != line_end) {
    refuse("\"" + path +
           "\" ends within a row. Give the name of a new file, or end its last line with CR LF.");
  }
}

/// Pipes and devices have no header that could be read.
bool is_stream(const std::string& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

}  // namespace

void append_to_table(const std::string& path, const std::string& header_and_row) {
  if (is_stream(path)) return write_file(path, header_and_row);
  check_writable(path);  // its messages explain folders and links
  const OpenTable table(path, TableUse::Append);
  require_header(path, table, header_and_row);
  table.append(table.size() == 0 ? header_and_row : header_and_row.substr(row_of(header_and_row)));
}

void check_table(const std::string& path, const std::string& header_and_row) {
  check_writable(path);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;
  require_header(path, OpenTable(path, TableUse::Read), header_and_row);
}

}  // namespace wscvt
