// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/error.h"

namespace wscvt {

// What refusals and warnings about scans with openings advise; tests follow it.

/// A scan is refused as it is, and its shrink-wrap may do.
class WrappableScan : public Error {
 public:
  /// `opening_percent`: the finest opening that is worth a trial, in % of the bounding box's
  /// diagonal.
  WrappableScan(ErrorCode code, const std::string& sentence, double opening_percent)
      : Error(code, sentence), opening_percent_(opening_percent) {}

  double opening_percent() const noexcept { return opening_percent_; }

 private:
  double opening_percent_;
};

/// The finest opening that is tried: finer ones take seconds. And the coarsest, beyond which a wrap
/// follows its scan no more.
inline constexpr double finest_tried_percent = 5.0;
inline constexpr double coarsest_tried_percent = 20.0;

/// A sentence on a shrink-wrap that was tried.
std::string tried_wrap_advice(double opening_percent);

/// Where MeshLab closes openings: a filter by its menu and with its settings.
std::string where_meshlab_closes();

/// A sentence for points that have no one radius in each direction.
std::string surface_of_points_advice();

}  // namespace wscvt
