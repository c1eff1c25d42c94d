// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/surface/harmonic_map.h"
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

/// What a file of `write_harmonics` or `write_harmonic_map` holds.
enum class HarmonicKind {
  Radial,  ///< one series, of the radius
  Map,     ///< three, of x, y and z over the map to the sphere
};

/// Which of the two a file holds; Radial where it has no "kind".
HarmonicKind read_harmonic_kind(const std::string& path);

/// Reads what `write_harmonics` writes. A file without "kind" is taken for a radial one.
HarmonicSurface read_harmonics(const std::string& path);

/// Writes {"format": "wscvt-harmonics-1", "kind": "radial", "degree": L, "coefficients": [...]}:
/// real orthonormal harmonics as in spherical_harmonics.h, a_lm at place l^2 + l + m. Reading gives
/// the same bits back. Written whole or not at all, see write_file.
void write_harmonics(const std::string& path, const HarmonicSurface& surface);

/// Reads what `write_harmonic_map` writes. Refuses series that enclose no volume or are turned
/// inside out.
HarmonicMap read_harmonic_map(const std::string& path);

/// As `write_harmonics`, with "kind": "map" and "coefficients": {"x": [...], "y": [...], "z":
/// [...]}.
void write_harmonic_map(const std::string& path, const HarmonicMap& map);

}  // namespace wscvt
