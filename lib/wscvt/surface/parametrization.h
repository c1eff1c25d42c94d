// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "wscvt/base/option.h"

namespace wscvt {

/// How the grain's surface is laid over the sphere.
enum class Parametrization {
  Auto,       ///< radial where nothing folds and steep_share is at most steep_share_limit, else
              ///< spherical; for nodes on the series radial up to the fold limit
  Radial,     ///< one radius a direction: the published method, for star-shaped grains
  Spherical,  ///< a bijective map of the scan, for any closed surface of genus 0
};

template <>
struct EnumerationTable<Parametrization> {
  static constexpr std::string_view key = "parametrization";
  static constexpr std::string_view subject = "parametrization";
  static constexpr Enumerator<Parametrization> rows[] = {
      {Parametrization::Auto, "auto", "auto",
       "radial where nothing folds and hardly any flank is steep, seen from the centroid, and "
       "spherical elsewhere; the log says which"},
      {Parametrization::Radial, "radial", "radial",
       "one radius in each direction, the published method, for star-shaped grains"},
      {Parametrization::Spherical, "spherical", "spherical",
       "any closed body without handles, hooks and shells too; nodes are relaxed in space, on the "
       "scan itself"},
  };
};

/// A flank is steep where the surface's normal turns from the radius by more than this, in degrees.
inline constexpr double steep_flank_angle = 75.0;

/// Auto takes the radial map up to this share. Gentle grains have none (the project's samples, as
/// rough as they are, and ellipsoids up to 7.5 : 1, whose steepest flank has the tangent
/// (a^2 - b^2) / (2 a b)); the least rough scans of crushed rock, soil grains and stone tools
/// tried have 0.006, others up to 0.08, and bodies with undercuts 0.1 and more.
inline constexpr double steep_share_limit = 0.005;

}  // namespace wscvt
