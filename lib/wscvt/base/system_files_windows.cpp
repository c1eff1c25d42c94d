// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef _WIN32

#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
// The header above comes first.
#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <string_view>

#include "wscvt/base/system_files.h"

namespace wscvt::system_files {

namespace fs = std::filesystem;

namespace {

/// An open file may be renamed and removed, as on other systems.
constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

int descriptor_for(HANDLE handle, int flags) {
  if (handle == INVALID_HANDLE_VALUE) return -1;
  const int descriptor = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), flags);
  if (descriptor < 0) ::CloseHandle(handle);
  return descriptor;
}

HANDLE handle_of(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

/// One call takes no more than an int counts.
unsigned part_of(std::size_t size) {
  return static_cast<unsigned>(std::min<std::size_t>(size, std::size_t{1} << 30U));
}

/// The byte far behind every table whose lock stands for the file's. A lock of Windows keeps others
/// from the bytes themselves, which may be read here.
OVERLAPPED lock_place() {
  OVERLAPPED place{};
  place.OffsetHigh = 0x7fffffff;
  return place;
}

/// Whether a name fits to a pattern, which has no separators.
bool fits(std::string_view name, std::string_view pattern) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() == '*') {
    for (std::size_t taken = 0; taken <= name.size(); ++taken) {
      if (fits(name.substr(taken), pattern.substr(1))) return true;
    }
    return false;
  }
  if (name.empty()) return false;
  const std::size_t end = pattern.front() == '[' ? pattern.find(']', 2) : std::string_view::npos;
  if (end == std::string_view::npos) {
    return (pattern.front() == '?' || pattern.front() == name.front()) &&
           fits(name.substr(1), pattern.substr(1));
  }
  std::string_view set = pattern.substr(1, end - 1);
  const bool excludes = set.front() == '!' || set.front() == '^';
  if (excludes) set.remove_prefix(1);
  bool is_in = false;
  while (!set.empty()) {
    const bool is_range = set.size() >= 3 && set[1] == '-';
    is_in = is_in ||
            (is_range ? set[0] <= name.front() && name.front() <= set[2] : set[0] == name.front());
    set.remove_prefix(is_range ? 3 : 1);
  }
  return is_in != excludes && fits(name.substr(1), pattern.substr(end + 1));
}

bool is_pattern(const std::string& name) { return name.find_first_of("*?[") != std::string::npos; }

}  // namespace

std::optional<FileState> file_state(const fs::path& path) {
  // Folders open with this flag only.
  const HANDLE handle = ::CreateFileW(path.c_str(), FILE_READ_ATTRIBUTES, shared, nullptr,
                                      OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return {};
  FileState state;
  state.is_writable = true;
  BY_HANDLE_FILE_INFORMATION found{};
  if (::GetFileType(handle) == FILE_TYPE_DISK &&
      ::GetFileInformationByHandle(handle, &found) != 0) {
    state.is_folder = (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    state.is_regular = !state.is_folder;
    state.is_writable = (found.dwFileAttributes & FILE_ATTRIBUTE_READONLY) == 0;
    state.names = found.nNumberOfLinks;
    state.device = found.dwVolumeSerialNumber;
    state.number = std::uint64_t{found.nFileIndexHigh} << 32U | found.nFileIndexLow;
  }
  ::CloseHandle(handle);
  return state;
}

Creation create_file(const fs::path& path) {
  const HANDLE handle = ::CreateFileW(path.c_str(), GENERIC_WRITE, shared, nullptr, CREATE_NEW,
                                      FILE_ATTRIBUTE_NORMAL, nullptr);
  if (handle == INVALID_HANDLE_VALUE) {
    const DWORD error = ::GetLastError();
    const bool is_taken = error == ERROR_FILE_EXISTS || error == ERROR_ALREADY_EXISTS;
    return is_taken ? Creation::NameTaken : Creation::Refused;
  }
  ::CloseHandle(handle);
  return Creation::Done;
}

// A new file has the rights of its folder, as files of Windows do.
bool take_over(const FileState& /*old_file*/, const fs::path& /*new_file*/) { return true; }

std::optional<int> descriptor_of(const fs::path& path) {
  // An absolute path has the letter of a drive.
  const std::string name = path.relative_path().generic_string();
  if (name == "dev/stdout") return 1;
  if (name == "dev/stderr") return 2;
  return {};
}

bool accepts_output(int descriptor) {
  // Windows does not tell what an open one is for. Writing tells it.
  return ::_get_osfhandle(descriptor) >= 0;
}

bool write_to(int descriptor, const std::string& content) {
  std::size_t written = 0;
  while (written < content.size()) {
    // A console takes no more than some thousand bytes at a time.
    const std::size_t left = content.size() - written;
    const bool is_console = ::_isatty(descriptor) != 0;
    const unsigned part =
        is_console ? static_cast<unsigned>(std::min<std::size_t>(left, 8192)) : part_of(left);
    const int count = ::_write(descriptor, content.data() + written, part);
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

bool write_to(const fs::path& path, const std::string& content) {
  const int descriptor = ::_wopen(path.c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT);
  if (descriptor < 0) return false;
  const bool good = write_to(descriptor, content);
  return ::_close(descriptor) == 0 && good;
}

LockedFile::~LockedFile() {
  if (descriptor_ >= 0) ::_close(descriptor_);
}

Opening LockedFile::open(const std::string& path, bool appends, bool waits) {
  const DWORD rights = appends ? GENERIC_READ | GENERIC_WRITE : GENERIC_READ;
  const HANDLE handle =
      ::CreateFileW(fs::u8path(path).c_str(), rights, shared, nullptr,
                    appends ? OPEN_ALWAYS : OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  descriptor_ = descriptor_for(handle, appends ? _O_APPEND | _O_BINARY : _O_RDONLY | _O_BINARY);
  if (descriptor_ < 0) return Opening::Refused;
  OVERLAPPED place = lock_place();
  const DWORD how = LOCKFILE_EXCLUSIVE_LOCK | (waits ? 0U : LOCKFILE_FAIL_IMMEDIATELY);
  if (::LockFileEx(handle, how, 0, 1, 0, &place) != 0) return Opening::Done;
  const DWORD error = ::GetLastError();
  const bool is_locked = error == ERROR_LOCK_VIOLATION || error == ERROR_IO_PENDING;
  return is_locked ? Opening::Locked : Opening::Done;
}

std::optional<std::size_t> LockedFile::size() const {
  LARGE_INTEGER size{};
  if (::GetFileSizeEx(handle_of(descriptor_), &size) == 0) return {};
  return static_cast<std::size_t>(size.QuadPart);
}

std::optional<std::string> LockedFile::read(std::size_t from, std::size_t size) const {
  if (::_lseeki64(descriptor_, static_cast<__int64>(from), SEEK_SET) < 0) return {};
  std::string bytes(size, '\0');
  std::size_t have = 0;
  while (have < size) {
    const int count = ::_read(descriptor_, bytes.data() + have, part_of(size - have));
    if (count < 0) return {};
    if (count == 0) break;
    have += static_cast<std::size_t>(count);
  }
  bytes.resize(have);
  return bytes;
}

bool LockedFile::append(const std::string& bytes) const {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const int count =
        ::_write(descriptor_, bytes.data() + written, part_of(bytes.size() - written));
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

bool LockedFile::cut(std::size_t size) const {
  return ::_chsize_s(descriptor_, static_cast<__int64>(size)) == 0;
}

std::vector<std::string> matching_files(const std::string& pattern) {
  // The parts of the pattern, from the left; what was found so far, in front of each.
  const fs::path whole = fs::u8path(pattern);
  std::vector<fs::path> found = {whole.root_path()};
  for (const fs::path& part : whole.relative_path()) {
    const std::string wanted = part.u8string();
    std::vector<fs::path> next;
    for (const fs::path& folder : found) {
      std::error_code error;
      if (!is_pattern(wanted)) {
        if (fs::exists(folder / part, error)) next.push_back(folder / part);
        continue;
      }
      const fs::path listed = folder.empty() ? fs::path(".") : folder;
      for (const fs::directory_entry& entry : fs::directory_iterator(listed, error)) {
        const std::string name = entry.path().filename().u8string();
        const bool is_hidden = name.front() == '.' && wanted.front() != '.';
        if (!is_hidden && fits(name, wanted)) next.push_back(folder / entry.path().filename());
      }
    }
    found = std::move(next);
  }
  std::vector<std::string> files;
  // As on other systems, because tables have these names.
  for (const fs::path& path : found) files.push_back(path.generic_u8string());
  std::sort(files.begin(), files.end());
  return files;
}

void return_free_memory() {}

}  // namespace wscvt::system_files

#endif
