// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef _WIN32

#include <fcntl.h>
#include <glob.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "wscvt/base/system_files.h"

namespace wscvt::system_files {

namespace {

bool write_all(int descriptor, const std::string& content, bool goes_on_after_signal) {
  std::size_t written = 0;
  while (written < content.size()) {
    const ssize_t count = ::write(descriptor, content.data() + written, content.size() - written);
    if (count < 0 && errno == EINTR && goes_on_after_signal) continue;
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

bool write_and_close(int descriptor, const std::string& content) {
  if (descriptor < 0) return false;
  const bool good = write_all(descriptor, content, false);
  return ::close(descriptor) == 0 && good;
}

}  // namespace

std::optional<FileState> file_state(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return {};
  FileState state;
  state.is_folder = S_ISDIR(found.st_mode);
  state.is_regular = S_ISREG(found.st_mode);
  state.is_writable = ::access(path.c_str(), W_OK) == 0;
  state.names = static_cast<std::uint64_t>(found.st_nlink);
  state.device = static_cast<std::uint64_t>(found.st_dev);
  state.number = static_cast<std::uint64_t>(found.st_ino);
  state.mode = found.st_mode & 07777U;
  state.user = found.st_uid;
  state.group = found.st_gid;
  return state;
}

Creation create_file(const std::filesystem::path& path) {
  std::FILE* const created = std::fopen(path.c_str(), "wbx");
  if (created == nullptr) return errno == EEXIST ? Creation::NameTaken : Creation::Refused;
  std::fclose(created);
  return Creation::Done;
}

bool take_over(const FileState& old_file, const std::filesystem::path& new_file) {
  struct stat created {};
  if (::stat(new_file.c_str(), &created) != 0) return false;
  const bool owned = (created.st_uid == old_file.user && created.st_gid == old_file.group) ||
                     ::chown(new_file.c_str(), old_file.user, old_file.group) == 0;
  return owned && ::chmod(new_file.c_str(), static_cast<mode_t>(old_file.mode)) == 0;
}

std::optional<int> descriptor_of(const std::filesystem::path& path) {
  const std::string folder = path.parent_path().string();
  const std::string name = path.filename().string();
  if (folder != "/dev/fd" && folder != "/proc/self/fd") return {};
  if (name.empty() || name.size() > 6 || name.find_first_not_of("0123456789") != std::string::npos)
    return {};
  return std::atoi(name.c_str());
}

bool accepts_output(int descriptor) {
  const int mode = ::fcntl(descriptor, F_GETFL);
  return mode != -1 && (mode & O_ACCMODE) != O_RDONLY;
}

bool write_to(int descriptor, const std::string& content) {
  // Closing reports what a file system noticed after the writing.
  return write_and_close(::dup(descriptor), content);
}

bool write_to(const std::filesystem::path& path, const std::string& content) {
  return write_and_close(::open(path.c_str(), O_WRONLY | O_NOCTTY), content);
}

LockedFile::~LockedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Opening LockedFile::open(const std::string& path, bool appends, bool waits) {
  const int flags = appends ? O_RDWR | O_CREAT | O_APPEND : O_RDONLY;
  descriptor_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor_ < 0) return Opening::Refused;
  const bool is_locked = ::flock(descriptor_, LOCK_EX | (waits ? 0 : LOCK_NB)) == 0;
  return !is_locked && errno == EWOULDBLOCK ? Opening::Locked : Opening::Done;
}

std::optional<std::size_t> LockedFile::size() const {
  struct stat state {};
  if (::fstat(descriptor_, &state) != 0) return {};
  return static_cast<std::size_t>(state.st_size);
}

std::optional<std::string> LockedFile::read(std::size_t from, std::size_t size) const {
  std::string bytes(size, '\0');
  std::size_t have = 0;
  while (have < size) {
    const ssize_t count =
        ::pread(descriptor_, bytes.data() + have, size - have, static_cast<off_t>(from + have));
    if (count < 0) return {};
    if (count == 0) break;
    have += static_cast<std::size_t>(count);
  }
  bytes.resize(have);
  return bytes;
}

bool LockedFile::append(const std::string& bytes) const {
  return write_all(descriptor_, bytes, true);
}

bool LockedFile::cut(std::size_t size) const {
  return ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0;
}

std::vector<std::string> matching_files(const std::string& pattern) {
  std::vector<std::string> files;
  glob_t found{};
  // glob sorts by bytes, because the program's locale is the classic one.
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) {
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  ::globfree(&found);
  return files;
}

void return_free_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace wscvt::system_files

#endif
