// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/open_table.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "wscvt/base/error.h"

// Streams of the standard library can neither lock nor truncate a file.
namespace wscvt {

namespace {

[[noreturn]] void fail_table(const std::string& path, const std::string& what) {
  throw MachineRefused("\"" + path + "\" " + what);
}

}  // namespace

OpenTable::OpenTable(std::string path, TableUse use) : path_(std::move(path)) {
  const int flags = use == TableUse::Read ? O_RDONLY : O_RDWR | O_CREAT | O_APPEND;
  descriptor_ = ::open(path_.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail_table(path_, "cannot be opened. Check that it is a file and yours.");
  const bool waits = use != TableUse::AppendAlone;
  if (::flock(descriptor_, LOCK_EX | (waits ? 0 : LOCK_NB)) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    fail_table(path_, "is being written by another batch. Wait for it, or give another folder.");
  }
}

OpenTable::~OpenTable() { ::close(descriptor_); }

std::size_t OpenTable::size() const {
  struct stat state {};
  if (::fstat(descriptor_, &state) != 0) fail_table(path_, "cannot be read. Check the disk.");
  return static_cast<std::size_t>(state.st_size);
}

std::string OpenTable::read(std::size_t from, std::size_t size) const {
  std::string bytes(size, '\0');
  std::size_t have = 0;
  while (have < size) {
    const ssize_t count =
        ::pread(descriptor_, bytes.data() + have, size - have, static_cast<off_t>(from + have));
    if (count < 0) fail_table(path_, "cannot be read. Check the disk.");
    if (count == 0) break;
    have += static_cast<std::size_t>(count);
  }
  bytes.resize(have);
  return bytes;
}

void OpenTable::append(const std::string& bytes) const {
  const std::size_t before = size();
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  if (written == bytes.size()) return;
  const bool restored = ::ftruncate(descriptor_, static_cast<off_t>(before)) == 0;
  if (before == 0) ::unlink(path_.c_str());
  fail_table(
      path_,
      restored
          ? "could not be written completely and was left unchanged. Check the space on the disk."
          : "now ends within a row. Remove its last line and check the disk.");
}

void OpenTable::cut(std::size_t size) const {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) == 0) return;
  fail_table(path_, "ends within a row that cannot be removed. Check the owner of the file.");
}

}  // namespace wscvt
