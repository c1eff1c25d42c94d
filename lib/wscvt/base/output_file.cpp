// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/output_file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <locale>
#include <system_error>
#include <utility>

#include "wscvt/base/error.h"

namespace wscvt {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

/// A new empty file beside the target; gone at the end of its scope, unless it was renamed.
class PartialFile {
 public:
  explicit PartialFile(const std::string& target) {
    // Never a file that was there: it may be somebody's.
    for (int attempt = 0; attempt < 100 && path_.empty(); ++attempt) {
      const std::string name = target + ".part" + (attempt == 0 ? "" : std::to_string(attempt));
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
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }

  /// Empty when none could be made.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

void write_file(const std::string& path, const std::function<bool(std::ostream&)>& write) {
  std::error_code error;
  std::string target = path;
  if (std::filesystem::is_symlink(path, error)) {
    target = std::filesystem::weakly_canonical(path, error).string();
    if (error) fail(path, "is a link that leads nowhere; remove it or give another name.");
  }
  const PartialFile partial(target);
  std::ofstream stream;
  if (!partial.path().empty()) stream.open(partial.path(), std::ios::binary | std::ios::trunc);
  if (!stream.is_open()) {
    fail(path, "cannot be written; check that the folder is there and can be written to.");
  }
  stream.imbue(std::locale::classic());
  const bool written = write(stream);
  stream.close();
  error.clear();
  if (written && stream) std::filesystem::rename(partial.path(), target, error);
  if (!written || !stream || error) {
    fail(path,
         "could not be written whole and was left as it was; check the space on the disk and that "
         "no folder has this name.");
  }
}

void write_file(const std::string& path, const std::string& content) {
  write_file(path, [&](std::ostream& stream) {
    stream << content;
    return true;
  });
}

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  // A relative name of no file stays relative in weakly_canonical.
  const auto canonical = [](const std::string& path) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error);
    const std::filesystem::path result = std::filesystem::weakly_canonical(absolute, error);
    return error ? absolute : result;
  };
  return canonical(a) == canonical(b);
}

}  // namespace wscvt
