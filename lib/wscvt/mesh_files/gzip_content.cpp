// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/gzip_content.h"

#include <zlib.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/machine_refused.h"

namespace wscvt {

bool is_gzip(const std::string& path) {
  std::array<char, 3> start{};
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), start.size()) && start[0] == '\x1f' && start[1] == '\x8b' &&
         start[2] == '\x08';
}

std::string gzip_content(const std::string& path, const Execution& execution) {
  errno = 0;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(::gzopen(path.c_str(), "rb"), ::gzclose);
  if (!file) refuse_to_open(path, errno);
  std::string content;
  std::vector<char> part(std::size_t{1} << 20);
  for (;;) {
    execution.report(0.0, "Unpacking");
    const int count = ::gzread(file.get(), part.data(), static_cast<unsigned>(part.size()));
    if (count > 0) content.append(part.data(), static_cast<std::size_t>(count));
    if (count == static_cast<int>(part.size())) continue;
    int error = Z_OK;
    ::gzerror(file.get(), &error);
    if (error == Z_MEM_ERROR) throw std::bad_alloc();
    if (error == Z_ERRNO) refuse_to_read(path);
    if (count >= 0 && error == Z_OK) return content;
    throw Error(ErrorCode::InputOutput,
                "\"" + path +
                    "\" is a gzip file that is cut or damaged. Copy it again, or export the mesh "
                    "again.");
  }
}

}  // namespace wscvt
