// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/option.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

/// What the allowed error of a clump is an error of.
enum class ClumpError {
  Distance,  ///< rms distance from scan to clump
  Volume,    ///< volume that is only in one of grain and clump
  Inertia,   ///< inertia of the union
  Contact,   ///< distance at first contact
};

template <>
struct EnumerationTable<ClumpError> {
  static constexpr std::string_view key = "error-measure";
  static constexpr std::string_view subject = "error of a clump";
  static constexpr Enumerator<ClumpError> rows[] = {
      {ClumpError::Distance, "distance", "distance",
       "rms distance from scan to clump, in % of the equivalent radius"},
      {ClumpError::Volume, "volume", "volume",
       "volume that is in one of grain and clump, in % of the volume that is in any of them"},
      {ClumpError::Inertia, "inertia", "inertia",
       "inertia of the union of the spheres, in % of the grain's"},
      {ClumpError::Contact, "contact", "first contact",
       "rms error of the distance at first contact of two clumps, in % of the equivalent radius"},
  };
};

/// Options of the clump of a grain: overlapping spheres that move as one body.
struct ClumpOptions {
  int sphere_count = 20;  ///< K; not used with an allowed error
  /// Allowed error, in %, of what error_measure names. The clump gets the fewest spheres that meet
  /// it, to within a tenth of their number. 0: sphere_count spheres.
  double max_error_percent = 0.0;
  ClumpError error_measure = ClumpError::Distance;
  int most_spheres = 200;  ///< limit of the search for the allowed error
  /// Smallest radius of a sphere, in % of the equivalent radius. The time step depends on it.
  double smallest_radius_percent = 0.0;
  bool inside = false;  ///< every sphere is inside the scan
  bool points = false;  ///< as RemeshOptions::points
  ShrinkWrapOptions shrink_wrap;
  double max_repaired_area_percent = MeshCheckOptions().repaired_area_limit_percent;
};

inline constexpr NumberOption<int> sphere_count_option = {"count",    "number of spheres", 1, 1000,
                                                          Ends::Both, "of the clump"};
inline constexpr NumberOption<double> clump_error_option = {
    "max-error",
    "allowed error",
    0.0,
    100.0,
    Ends::NotMaximum,
    "use the fewest spheres with at most this error, in %; 0: use the given number of spheres"};
inline constexpr NumberOption<int> most_spheres_option = {"max-spheres",
                                                          "max. number of spheres",
                                                          1,
                                                          1000,
                                                          Ends::Both,
                                                          "in the search for the allowed error"};
inline constexpr NumberOption<double> smallest_radius_option = {
    "smallest-radius", "smallest radius of a sphere",  0.0, 100.0,
    Ends::Both,        "in % of the equivalent radius"};
inline constexpr FlagOption inside_option = {"inside", "keep every sphere inside",
                                             "the scan; it touches the scan from within"};

/// Calls `visitor` for every option, as for_each_option of a remesh. The scan's options (points,
/// shrink-wrap, repairs) have the names of a remesh's options.
template <class Options, class Visitor>
void for_each_clump_option(Options& options, Visitor& visitor) {
  visitor(options.sphere_count, sphere_count_option);
  visitor(options.max_error_percent, clump_error_option);
  visitor(options.error_measure);
  visitor(options.smallest_radius_percent, smallest_radius_option);
  visitor(options.inside, inside_option);
  visitor(options.points, points_option);
  visitor(options.shrink_wrap.opening_percent, shrink_wrap_option);
  visitor(options.max_repaired_area_percent, repaired_area_limit_option);
}

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_clump_options(const ClumpOptions& options);

}  // namespace wscvt
