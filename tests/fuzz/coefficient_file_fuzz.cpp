// SPDX-License-Identifier: GPL-3.0-or-later
// Files that claim to hold coefficients. The first byte is j for JSON, else 'a' + 1 + the degree at
// which the text form is cut.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz/promise.h"
#include "wscvt/base/error.h"
#include "wscvt/surface/harmonic_surface.h"

namespace {

using namespace wscvt;

/// A file of this process, gone at the end of its scope.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& content) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() { std::remove(path_.c_str()); }

  const std::string& path() const { return path_; }

 private:
  std::string path_ = (std::filesystem::temp_directory_path() /
                       ("wscvt_fuzz_" + std::to_string(getpid()) + ".json"))
                          .string();
};

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const ScratchFile file(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  try {
    if (data[0] == 'j') {
      const HarmonicShape shape = read_harmonics(file.path());
      const auto* const surface = std::get_if<HarmonicSurface>(&shape);
      if (surface == nullptr) return 0;
      write_harmonics(file.path(), *surface);
      promise(std::get<HarmonicSurface>(read_harmonics(file.path())).coefficients() ==
                  surface->coefficients(),
              "coefficients do not read back");
    } else {
      const HarmonicSurface surface =
          read_complex_harmonics(file.path(), static_cast<int>(data[0]) % 32 - 2);
      for (const double c : surface.coefficients()) {
        promise(std::isfinite(c), "a coefficient is not finite");
      }
    }
  } catch (const Error& error) {
    promise(error.code() == ErrorCode::InputOutput || error.code() == ErrorCode::InvalidInput,
            error.what());
  }
  return 0;
}
