// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "wscvt/base/error.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw MachineRefused("\"" + path + "\" " + what);
}

[[noreturn]] void fail_half_written(const std::string& path) {
  fail(path,
       "could not be written completely and was left unchanged. Check the space on the disk, the "
       "limit of file sizes (ulimit -f), and that no folder has this name.");
}

/// Returns the name of a file while it is written. Names have at most 255 bytes, so a longer one
/// loses its end.
std::string partial_name(const std::string& target) {
  constexpr std::size_t longest = 248;  // leaves room for ".part" and a number
  const fs::path path(target);
  return (path.parent_path() / path.filename().string().substr(0, longest)).string() + ".part";
}

constexpr const char* check_the_folder =
    "cannot be written. Check that the folder exists and is writable.";

/// Returns the descriptor for /dev/stdout and similar paths; nothing for other paths.
std::optional<int> descriptor_of(const fs::path& path) {
  const std::string folder = path.parent_path().string();
  const std::string name = path.filename().string();
  if (folder != "/dev/fd" && folder != "/proc/self/fd") return {};
  if (name.empty() || name.size() > 6 || name.find_first_not_of("0123456789") != std::string::npos)
    return {};
  return std::atoi(name.c_str());
}

/// The target of a path.
struct Target {
  fs::path path;                  ///< the file itself; it need not exist
  std::optional<int> descriptor;  ///< of this process, used instead of the path
  bool is_circle = false;         ///< the links form a circle
};

/// Follows the symbolic links of the last name, also to a missing file; std::filesystem does not.
Target follow(const std::string& path) {
  constexpr int most_links = 40;  // the system's limit
  std::error_code error;
  Target target;
  target.path = fs::absolute(path, error).lexically_normal();
  for (int links = 0;; ++links) {
    target.descriptor = descriptor_of(target.path);
    if (target.descriptor || !fs::is_symlink(target.path, error)) return target;
    target.is_circle = links == most_links;
    if (target.is_circle) return target;
    const fs::path next = fs::read_symlink(target.path, error);
    if (error) return target;
    // Not normalised: "linked folder/.." is not the folder that contains the link.
    target.path = next.is_absolute() ? next : target.path.parent_path() / next;
  }
}

/// A new empty file beside the target. Removed at the end of its scope, unless it was renamed.
class PartialFile {
 public:
  explicit PartialFile(const std::string& target) {
    // Never uses an existing file, because it may belong to someone.
    for (int attempt = 0; attempt < 100 && path_.empty(); ++attempt) {
      const std::string name = partial_name(target) + (attempt == 0 ? "" : std::to_string(attempt));
      if (std::FILE* created = std::fopen(name.c_str(), "wbx")) {
        std::fclose(created);
        path_ = name;
      } else if (errno != EEXIST) {
        break;
      }
    }
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
  }

  /// Empty if no file could be made.
  const std::string& path() const { return path_; }

  /// Does not remove the file at the end.
  void keep() { path_.clear(); }

 private:
  std::string path_;
};

/// Writes to an open descriptor. Returns false if it accepts no more, or if a signal interrupts the
/// wait.
bool write_all(int descriptor, const std::string& content) {
  std::size_t written = 0;
  while (written < content.size()) {
    const ssize_t count = ::write(descriptor, content.data() + written, content.size() - written);
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

/// Writes to pipes, devices and open descriptors, which a renamed file cannot replace.
void write_through(const std::string& path, const Target& target,
                   const std::function<bool(std::ostream&)>& write) {
  std::ostringstream content;
  content.imbue(std::locale::classic());
  const bool made = write(content);
  const int descriptor = target.descriptor ? ::dup(*target.descriptor)
                                           : ::open(target.path.c_str(), O_WRONLY | O_NOCTTY);
  bool good = made && content && descriptor >= 0 && write_all(descriptor, content.str());
  if (descriptor >= 0) good = ::close(descriptor) == 0 && good;
  if (!good) fail(path, "cannot be written. The program that reads it may have stopped.");
}

/// Gives the new file the owner and mode of the old file. Returns false if that is not allowed.
bool take_over(const struct stat& old_file, const std::string& path) {
  struct stat created {};
  if (::stat(path.c_str(), &created) != 0) return false;
  const bool owned = (created.st_uid == old_file.st_uid && created.st_gid == old_file.st_gid) ||
                     ::chown(path.c_str(), old_file.st_uid, old_file.st_gid) == 0;
  return owned && ::chmod(path.c_str(), old_file.st_mode & 07777U) == 0;
}

/// Copies a complete new file into an old file, which keeps its owner, mode and links.
void copy_into(const std::string& path, const std::string& target, PartialFile& partial) {
  std::ifstream from(partial.path(), std::ios::binary);
  std::ofstream to(target, std::ios::binary | std::ios::trunc);
  if (!from || !to) fail_half_written(path);
  if (from.peek() != std::ifstream::traits_type::eof()) to << from.rdbuf();
  to.close();
  if (to) return;
  const std::string kept = partial.path();
  partial.keep();
  fail(path, "could not be written completely. Its new content is in \"" + kept + "\".");
}

/// Throws if the target cannot be written. Returns the status of an existing target.
std::optional<struct stat> check_target(const std::string& path, const Target& target) {
  if (target.is_circle) {
    fail(path, "is a link to a missing file. Remove it or give another name.");
  }
  struct stat there {};
  if (::stat(target.path.c_str(), &there) != 0) return {};
  if (S_ISDIR(there.st_mode)) {
    fail(path, "is a folder and cannot be written. Check the name and add a file name.");
  }
  if (::access(target.path.c_str(), W_OK) != 0) {
    fail(path, "cannot be written. Check its owner and its permissions.");
  }
  return there;
}

bool is_file(const struct stat& there) { return S_ISREG(there.st_mode); }

}  // namespace

void write_file(const std::string& path, const std::function<bool(std::ostream&)>& write) {
  const Target target = follow(path);
  if (target.descriptor) return write_through(path, target, write);
  const std::optional<struct stat> there = check_target(path, target);
  if (there && !is_file(*there)) return write_through(path, target, write);

  PartialFile partial(target.path.string());
  std::ofstream stream;
  if (!partial.path().empty()) stream.open(partial.path(), std::ios::binary | std::ios::trunc);
  if (!stream.is_open()) fail(path, check_the_folder);
  stream.imbue(std::locale::classic());
  const bool written = write(stream);
  stream.close();
  if (!written || !stream) fail_half_written(path);
  if (there && (there->st_nlink > 1 || !take_over(*there, partial.path()))) {
    return copy_into(path, target.path.string(), partial);
  }
  std::error_code error;
  fs::rename(partial.path(), target.path, error);
  if (error) fail_half_written(path);
}

void write_file(const std::string& path, const std::string& content) {
  write_file(path, [&](std::ostream& stream) {
    stream << content;
    return true;
  });
}

void remove_partial_file(const std::string& path) {
  std::error_code ignored;
  fs::remove(partial_name(follow(path).path.string()), ignored);
}

void check_writable(const std::string& path) {
  const Target target = follow(path);
  if (target.descriptor) {
    const int mode = ::fcntl(*target.descriptor, F_GETFL);
    if (mode == -1 || (mode & O_ACCMODE) == O_RDONLY) {
      fail(path, "is closed or read-only. Open it for writing.");
    }
    return;
  }
  const std::optional<struct stat> there = check_target(path, target);
  if (there && !is_file(*there)) return;
  // Makes and removes a file, the only test for rights, quotas and read-only disks.
  const PartialFile partial(target.path.string());
  if (partial.path().empty()) fail(path, check_the_folder);
}

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  const Target target_a = follow(a);
  const Target target_b = follow(b);
  if (target_a.descriptor || target_b.descriptor) return false;
  struct stat there_a {};
  struct stat there_b {};
  const bool is_a = ::stat(target_a.path.c_str(), &there_a) == 0;
  const bool is_b = ::stat(target_b.path.c_str(), &there_b) == 0;
  if (is_a != is_b) return false;
  if (is_a) {
    return is_file(there_a) && there_a.st_dev == there_b.st_dev && there_a.st_ino == there_b.st_ino;
  }
  const auto canonical = [](const fs::path& path) {
    std::error_code error;
    const fs::path result = fs::weakly_canonical(path, error);
    return error ? path : result;
  };
  return canonical(target_a.path) == canonical(target_b.path);
}

}  // namespace wscvt
