// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/coefficients_file.h"

#include "wscvt/base/error.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

void write_coefficients(const std::string& path, const RemeshResult& result) {
  if (!result.coefficients.empty()) {
    write_harmonics(path, HarmonicSurface(result.coefficients));
  } else if (!result.map_coefficients[0].empty()) {
    write_harmonic_map(path, HarmonicMap(result.map_coefficients));
  } else {
    throw Error(ErrorCode::InvalidInput,
                "The result holds no coefficients; ask for them before remeshing.");
  }
}

}  // namespace wscvt
