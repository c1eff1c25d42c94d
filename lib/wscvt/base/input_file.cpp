// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/input_file.h"

#include <cerrno>
#include <filesystem>
#include <iterator>
#include <utility>

#include "wscvt/base/machine_refused.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

/// Does nothing for a file, a pipe, or a name without a file.
void refuse_device(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status) || fs::is_regular_file(status) || fs::is_fifo(status)) {
    return;
  }
  throw Error(ErrorCode::InputOutput,
              "\"" + path + "\" is a folder or a device. Give the name of a file.");
}

/// Calls `read`. A file buffer throws where the system refuses to read.
template <class Read>
auto read_or_refuse(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const std::ios_base::failure&) {
    refuse_to_read(path);
  }
}

}  // namespace

InputFile::Buffer::Buffer(std::string path) : path_(std::move(path)) {}

bool InputFile::Buffer::open_for(MissingFile missing) {
  refuse_device(path_);
  errno = 0;
  if (open(path_, std::ios::in | std::ios::binary) != nullptr) return true;
  const bool is_missing = errno == ENOENT || errno == ENOTDIR;
  if (missing == MissingFile::IsRefused || !is_missing) refuse_to_open(path_, errno);
  return false;
}

InputFile::Buffer::int_type InputFile::Buffer::underflow() {
  return read_or_refuse(path_, [this] { return std::filebuf::underflow(); });
}

std::streamsize InputFile::Buffer::xsgetn(char* bytes, std::streamsize count) {
  return read_or_refuse(path_, [&] { return std::filebuf::xsgetn(bytes, count); });
}

InputFile::InputFile(const std::string& path, MissingFile missing)
    : std::istream(nullptr), buffer_(path) {
  rdbuf(&buffer_);
  // A stream keeps what its buffer throws to itself otherwise.
  exceptions(std::ios::badbit);
  if (!buffer_.open_for(missing)) setstate(std::ios::eofbit | std::ios::failbit);
}

std::string file_content(const std::string& path) {
  InputFile file(path, MissingFile::IsEmpty);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace wscvt
