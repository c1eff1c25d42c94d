// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

// Files of SHTOOLS and pyshtools: rows `l, m, C, S`, or with blanks in place of the commas, of
// m >= 0, the radius being the sum of (C cos(m phi) + S sin(m phi)) P_lm(cos theta). What SHTOOLS
// writes unless told otherwise: real harmonics, normalized so that their mean square over the
// sphere is 1 ("4pi"), without the Condon-Shortley phase (csphase 1). Rows do not tell their
// normalization: others are converted by pyshtools, coeffs.convert(normalization="4pi", csphase=1),
// before. Our a_l,m = (-1)^m sqrt(4 pi) C, a_l,-m = (-1)^m sqrt(4 pi) S (M. Wieczorek, M. Meschede,
// 2018, "SHTools: tools for working with spherical harmonics").

/// Reads such a file; `degree` as read_complex_harmonics, and throws as it does.
HarmonicSurface read_shtools(const std::string& path, int degree = -1);

/// Writes one, each number with all its digits. Written whole or not at all, see write_file.
void write_shtools(const std::string& path, const HarmonicSurface& surface);

}  // namespace wscvt
