// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

// All of these throw Error(InputOutput) when the file cannot be opened, read or written, and
// Error(InvalidInput), naming the file and the line, when what it holds is not such a surface:
// wrong syntax, a coefficient missing or given twice, a radius that is not real and positive
// everywhere.

/// Reads the text form of the NIST particle shape sets (VCCTL, THAMES): lines `n m Re Im`, the
/// coefficients of complex orthonormal harmonics with the Condon-Shortley phase, in any order.
/// Those with m < 0 follow from those with m > 0 and may be left out; where given they must agree
/// to 1e-6 of the largest. `degree` >= 0 cuts the series there, as the tables beside the sets do;
/// -1 keeps all.
HarmonicSurface read_complex_harmonics(const std::string& path, int degree = -1);

/// Reads what `write_harmonics` writes.
HarmonicSurface read_harmonics(const std::string& path);

/// Writes {"format": "wscvt-harmonics-1", "degree": L, "coefficients": [...]}: real orthonormal
/// harmonics as in spherical_harmonics.h, a_lm at place l^2 + l + m. Reading gives the same bits
/// back. Written whole or not at all, see write_file.
void write_harmonics(const std::string& path, const HarmonicSurface& surface);

}  // namespace wscvt
