// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>
#include <istream>
#include <string>

namespace wscvt {

/// What a file that is not there means to its reader.
enum class MissingFile { IsRefused, IsEmpty };

/// A file or a pipe that is read as a binary stream. Where the system refuses to read on, every
/// function of std::istream throws MachineRefused. So the end that is read is the file's end.
class InputFile : public std::istream {
 public:
  /// Throws as refuse_to_open, and Error(InputOutput) for a folder or a device, such as /dev/zero,
  /// which has no end. If a missing file is empty, the stream of one is at its end.
  explicit InputFile(const std::string& path, MissingFile missing = MissingFile::IsRefused);

 private:
  class Buffer : public std::filebuf {
   public:
    explicit Buffer(std::string path);
    bool open_for(MissingFile missing);

   private:
    int_type underflow() override;
    std::streamsize xsgetn(char* bytes, std::streamsize count) override;

    std::string path_;
  };

  Buffer buffer_;
};

/// Returns the bytes of a file; none if it is not there. Throws as InputFile.
std::string file_content(const std::string& path);

}  // namespace wscvt
