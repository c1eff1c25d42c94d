// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/open_table.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "wscvt/base/error.h"
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

}  // namespace wscvt
