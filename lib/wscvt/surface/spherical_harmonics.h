// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

/// Returns the values of all harmonics up to `degree` for `count` unit vectors: (degree + 1)^2
/// values per direction, in the order of `harmonic_index`. Throws Error(InvalidInput) if the degree
/// is not in [0, maximum_harmonic_degree].
std::vector<double> harmonic_values(int degree, const Vector3* directions, std::size_t count);

/// Computes sqrt(2 - delta_m0) P_lm(cos theta) for l = m ... degree on a set of latitudes,
/// latitudes innermost: values[(l - m) * count + j]. `sines[j]` = sin theta_j >= 0 is a separate
/// argument because it keeps its digits near the poles. Throws Error(InvalidInput) if the degree is
/// not in [0, maximum_harmonic_degree] or m is not in [0, degree].
void associated_legendre(int degree, int m, const double* cosines, const double* sines,
                         std::size_t count, double* values);

}  // namespace wscvt
