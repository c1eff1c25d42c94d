// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// What the library asks of the operating system, mostly about files, where the C++ library has no
/// answer. The sources of this header, one for POSIX and one for Windows, contain all such calls of
/// the core and of the toolbox. Names of files are UTF-8. This header is not public.
namespace wscvt::system_files {

/// What is at a path.
struct FileState {
  bool is_folder = false;
  bool is_regular = false;  ///< no folder, pipe or device
  bool is_writable = false;
  std::uint64_t names = 1;   ///< hard links
  std::uint64_t device = 0;  ///< with the number, equal for all names of one file
  std::uint64_t number = 0;
  std::uint32_t mode = 0;  ///< as chmod takes it; 0 on Windows, as the two below
  std::uint32_t user = 0;
  std::uint32_t group = 0;
};

/// Follows symbolic links. Returns nothing if there is no file.
std::optional<FileState> file_state(const std::filesystem::path& path);

enum class Creation {
  Done,
  NameTaken,
  Refused,
};

/// Makes an empty file, and never takes one that is there.
Creation create_file(const std::filesystem::path& path);

/// Gives a new file the owner and mode of an old file. Returns false if that is not allowed.
bool take_over(const FileState& old_file, const std::filesystem::path& new_file);

/// Returns the descriptor for /dev/stdout and similar paths; nothing for other paths. The path is
/// absolute, and its links are followed.
std::optional<int> descriptor_of(const std::filesystem::path& path);

/// Whether a descriptor is open for writing.
bool accepts_output(int descriptor);

/// Writes to a descriptor, which stays open. Returns false if it accepts no more, or if a signal
/// interrupts the wait.
bool write_to(int descriptor, const std::string& content);

/// Writes to a pipe or a device. Returns false as the function above, and if it cannot be opened.
bool write_to(const std::filesystem::path& path, const std::string& content);

enum class Opening {
  Done,
  Locked,  ///< by another process
  Refused,
};

/// An open file that is locked against those who lock it too.
class LockedFile {
 public:
  LockedFile() = default;
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;
  ~LockedFile();

  /// Opens a file for reading, and for appending if `appends`: then it is made if it is missing.
  /// Waits for the lock if `waits`. If the file system has no locks, the file is open without one.
  Opening open(const std::string& path, bool appends, bool waits);

  /// In bytes; nothing on an error.
  std::optional<std::size_t> size() const;

  /// Reads up to `size` bytes at `from`; nothing on an error.
  std::optional<std::string> read(std::size_t from, std::size_t size) const;

  /// Writes at the end. Returns false if not all was written.
  bool append(const std::string& bytes) const;

  /// Leaves the first `size` bytes. Returns false on an error.
  bool cut(std::size_t size) const;

 private:
  int descriptor_ = -1;
};

/// Returns the existing files that match a pattern with *, ? and [...], sorted by bytes. No star
/// matches the point at the beginning of a name.
std::vector<std::string> matching_files(const std::string& pattern);

/// Returns freed memory to the system, if the C library keeps it.
void return_free_memory();

}  // namespace wscvt::system_files
