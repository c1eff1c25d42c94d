// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Steps above this fraction of the mean edge are coarse. Rounding moves corners by up to half a
/// step, which turns the edges of a face by about a degree.
inline constexpr double coarse_step = 0.03;

/// Returns the mean edge length over faces spread evenly over the list, enough for two digits;
/// length. 0 without faces. All corners are valid.
double sampled_mean_edge(const IndexedMesh& mesh);

/// Returns the step of single precision at the largest coordinate of a corner, as a fraction of the
/// mean edge. 0 if this is not above 0 and finite. All corners are valid.
double single_precision_step(const IndexedMesh& mesh);

}  // namespace wscvt
