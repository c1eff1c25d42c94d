// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/output_file.h"

#include <filesystem>
#include <fstream>
#include <locale>
#include <optional>
#include <sstream>
#include <system_error>

#include "wscvt/base/error.h"
#include "wscvt/base/system_files.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;
using system_files::Creation;
using system_files::FileState;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw MachineRefused("\"" + path + "\" " + what);
}

[[noreturn]] void fail_half_written(const std::string& path) {
  fail(path,
       "could not be written completely and was left unchanged. Check the space on the disk, the "
       "limit of file sizes (ulimit -f), and that no folder has this name.");
}

/// Returns the name of a file while it is written. Names have at most 255 bytes, so a longer one
/// loses its end, by whole characters.
std::string partial_name(const std::string& target) {
  constexpr std::size_t longest = 248;  // leaves room for ".part" and a number
  const fs::path path(target);
  std::string name = path.filename().string();
  if (name.size() > longest) {
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0U) == 0x80U) --end;
    name.resize(end);
  }
  return (path.parent_path() / name).string() + ".part";
}

constexpr const char* check_the_folder =
    "cannot be written. Check that the folder exists and is writable.";

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
    target.descriptor = system_files::descriptor_of(target.path);
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
      const Creation creation = system_files::create_file(name);
      if (creation == Creation::Done) path_ = name;
      if (creation == Creation::Refused) break;
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

/// Writes to pipes, devices and open descriptors, which a renamed file cannot replace.
void write_through(const std::string& path, const Target& target,
                   const std::function<void(std::ostream&)>& write) {
  std::ostringstream content;
  content.imbue(std::locale::classic());
  write(content);
  const bool good =
      content && (target.descriptor ? system_files::write_to(*target.descriptor, content.str())
                                    : system_files::write_to(target.path, content.str()));
  if (!good) fail(path, "cannot be written. The program that reads it may have stopped.");
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
std::optional<FileState> check_target(const std::string& path, const Target& target) {
  if (target.is_circle) {
    fail(path, "is a link to a missing file. Remove it or give another name.");
  }
  const std::optional<FileState> there = system_files::file_state(target.path);
  if (there && there->is_folder) {
    fail(path, "is a folder and cannot be written. Check the name and add a file name.");
  }
  if (there && !there->is_writable) {
    fail(path, "cannot be written. Check its owner and its permissions.");
  }
  return there;
}

}  // namespace

void write_file(const std::string& path, const std::function<void(std::ostream&)>& write) {
  const Target target = follow(path);
  if (target.descriptor) return write_through(path, target, write);
  const std::optional<FileState> there = check_target(path, target);
  if (there && !there->is_regular) return write_through(path, target, write);

  PartialFile partial(target.path.string());
  std::ofstream stream;
  if (!partial.path().empty()) stream.open(partial.path(), std::ios::binary | std::ios::trunc);
  if (!stream.is_open()) fail(path, check_the_folder);
  stream.imbue(std::locale::classic());
  write(stream);
  stream.close();
  if (!stream) fail_half_written(path);
  if (there && (there->names > 1 || !system_files::take_over(*there, partial.path()))) {
    return copy_into(path, target.path.string(), partial);
  }
  std::error_code error;
  fs::rename(partial.path(), target.path, error);
  if (error) fail_half_written(path);
}

void write_file(const std::string& path, const std::string& content) {
  write_file(path, [&](std::ostream& stream) { stream << content; });
}

void remove_partial_file(const std::string& path) {
  std::error_code ignored;
  fs::remove(partial_name(follow(path).path.string()), ignored);
}

void check_writable(const std::string& path) {
  const Target target = follow(path);
  if (target.descriptor) {
    if (!system_files::accepts_output(*target.descriptor)) {
      fail(path, "is closed or read-only. Open it for writing.");
    }
    return;
  }
  const std::optional<FileState> there = check_target(path, target);
  if (there && !there->is_regular) return;
  // Makes and removes a file, the only test for rights, quotas and read-only disks.
  const PartialFile partial(target.path.string());
  if (partial.path().empty()) fail(path, check_the_folder);
}

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  const Target target_a = follow(a);
  const Target target_b = follow(b);
  if (target_a.descriptor || target_b.descriptor) return false;
  const std::optional<FileState> there_a = system_files::file_state(target_a.path);
  const std::optional<FileState> there_b = system_files::file_state(target_b.path);
  if (there_a.has_value() != there_b.has_value()) return false;
  if (there_a) {
    return there_a->is_regular && there_a->device == there_b->device &&
           there_a->number == there_b->number;
  }
  const auto canonical = [](const fs::path& path) {
    std::error_code error;
    const fs::path result = fs::weakly_canonical(path, error);
    return error ? path : result;
  };
  return canonical(target_a.path) == canonical(target_b.path);
}

}  // namespace wscvt
