// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/output_file.h"

#include <filesystem>
#include <fstream>
#include <locale>
#include <system_error>
#include <utility>

#include "wscvt/error.h"

namespace wscvt {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

/// Is gone at the end of its scope, unless it was renamed.
class PartialFile {
 public:
  explicit PartialFile(std::string path) : path_(std::move(path)) {}
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

void write_file(const std::string& path, const std::function<bool(std::ostream&)>& write) {
  const PartialFile partial(path + ".part");
  std::ofstream stream(partial.path(), std::ios::binary | std::ios::trunc);
  if (!stream) {
    fail(path, "cannot be written; check that the folder is there and can be written to.");
  }
  stream.imbue(std::locale::classic());
  const bool written = write(stream);
  stream.close();
  std::error_code error;
  if (written && stream) std::filesystem::rename(partial.path(), path, error);
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

}  // namespace wscvt
