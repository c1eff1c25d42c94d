// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/repair/scan_options.h"

namespace wscvt {

// Advice in errors and warnings about scans with openings. Tests follow it.

/// Thrown if a scan is refused but its shrink-wrap may be usable.
class WrappableScan : public Error {
 public:
  /// `opening_percent`: the smallest opening that is worth a trial, in % of the bounding box's
  /// diagonal.
  WrappableScan(ErrorCode code, const std::string& sentence, double opening_percent)
      : Error(code, sentence), opening_percent_(opening_percent) {}

  double opening_percent() const noexcept { return opening_percent_; }

 private:
  double opening_percent_;
};

/// The smallest and the largest opening that are tried. Smaller openings take seconds. With larger
/// openings a wrap does not follow its scan.
inline constexpr double finest_tried_percent = 5.0;
inline constexpr double coarsest_tried_percent = 20.0;

/// Returns a sentence on a shrink-wrap that was tried.
std::string tried_wrap_advice(double opening_percent);

/// Returns the menu path and settings of the MeshLab filter that closes openings.
std::string where_meshlab_closes();

/// Returns a sentence for points that do not have exactly one radius in each direction.
std::string surface_of_points_advice();

/// Returns a sentence on corners of open edges that were merged (see find_seams in weld.h);
/// `distance` in the mesh's length.
std::string merged_warning(std::size_t corners, double distance);

/// Returns a sentence on the stray vertex of a scan.
std::string stray_vertex_sentence(const MeshCheckReport& report);

}  // namespace wscvt
