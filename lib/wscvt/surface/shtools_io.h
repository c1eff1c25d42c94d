// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

// Files of SHTOOLS and pyshtools: rows `l, m, C, S` for m >= 0, with commas or blanks. The radius
// is the sum of (C cos(m phi) + S sin(m phi)) P_lm(cos theta). The harmonics are SHTOOLS' default:
// real, normalized so that their mean square over the sphere is 1 ("4pi"), without the
// Condon-Shortley phase (csphase 1). The file does not contain its normalization. Convert others
// first by pyshtools: coeffs.convert(normalization="4pi", csphase=1). Our a_l,m = (-1)^m sqrt(4 pi)
// C, a_l,-m = (-1)^m sqrt(4 pi) S (M. Wieczorek, M. Meschede, 2018, "SHTools: tools for working
// with spherical harmonics").

/// Reads such a file. `degree` and errors as in read_complex_harmonics.
HarmonicSurface read_shtools(const std::string& path, int degree = -1);

/// Writes such a file, with all digits of each number. Writes it completely or not at all, see
/// write_file.
void write_shtools(const std::string& path, const HarmonicSurface& surface);

}  // namespace wscvt
