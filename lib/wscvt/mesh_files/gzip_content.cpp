// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/gzip_content.h"

#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>
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
  // A mesh shrinks to a tenth, seldom to a fiftieth; what shrinks more is made to fill the memory.
  constexpr std::uintmax_t most_times = 100;
  constexpr std::uintmax_t always_unpacked = std::uintmax_t{64} << 20;
  std::error_code unknown;
  const std::uintmax_t packed = std::filesystem::file_size(path, unknown);
  const std::uintmax_t most = always_unpacked + (unknown ? 0 : most_times * packed);
  std::string content;
  std::vector<char> part(std::size_t{1} << 20);
  for (;;) {
    execution.report(0.0, "Unpacking");
    const int count = ::gzread(file.get(), part.data(), static_cast<unsigned>(part.size()));
    if (count > 0) content.append(part.data(), static_cast<std::size_t>(count));
    if (content.size() > most) {
      throw Error(ErrorCode::InputOutput,
                  "\"" + path + "\" unpacks to more than " + std::to_string(most >> 20) +
                      " MB, a hundred times its size, which no mesh does. If it is one, unpack it "
                      "with gunzip first.");
    }
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
