// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/roundness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/surface/ball_curvature.h"

namespace wscvt {

namespace {

/// Balls smaller than this many mean edges read the facets.
constexpr double edges_per_ball = 2.5;

/// Patches of this share of the ball's radius: the search takes the same time on dense scans, and
/// their own size widens the ball by a few per cent.
constexpr double patch_share = 0.125;

constexpr std::size_t most_places = 10000;

/// Curvature times inscribed radius above which a point is a corner: a sphere has none.
constexpr double corner_curvature = 1.05;

/// Corners on a smaller share of the area are noise.
constexpr double smallest_corner_share = 0.01;

/// The second ball's radius over the first's, and the slope's factor for no ball at all.
constexpr double wider = 1.5;
constexpr double largest_correction = 0.7;

/// The smallest radius that is told apart, over the ball's.
constexpr double resolved_share = 0.25;

double mean_edge(const IndexedMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum += (mesh.points[index(t[following(k)])] - mesh.points[index(t[k])]).norm();
    }
  }
  return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

/// `count` of the patches, or all: the beginning of a random permutation, since every so many-th
/// may all lie in one row of a regular mesh.
std::vector<BallCentre> places_of(const SurfacePatches& patches, std::size_t count) {
  std::vector<std::int32_t> order(patches.patches.size());
  std::iota(order.begin(), order.end(), 0);
  const std::size_t kept = std::min(count, order.size());
  if (kept < order.size()) {
    std::mt19937 random(1U);
    for (std::size_t i = 0; i < kept; ++i) {
      std::swap(order[i], order[i + random() % (order.size() - i)]);
    }
    // In the mesh's order, in which neighbours are near in memory.
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept));
  }
  std::vector<BallCentre> places;
  places.reserve(kept);
  for (std::size_t i = 0; i < kept; ++i) {
    places.push_back({patches.patches[index(order[i])].centre, order[i]});
  }
  return places;
}

struct Corners {
  double value = 1.0;  ///< V
  double area_share = 0.0;
};

Corners corners_in(const SurfacePatches& patches, const std::vector<BallCentre>& places,
                   double ball_radius, double inscribed_radius, const Execution& execution) {
  const std::vector<PrincipalCurvatures> curvatures =
      ball_curvatures(patches, places, ball_radius, execution);
  double area = 0.0;
  double corner_area = 0.0;
  double turn = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double of_patch = patches.patches[index(places[i].patch)].area;
    area += of_patch;
    if (!(curvatures[i].maximum * inscribed_radius > corner_curvature)) continue;
    corner_area += of_patch;
    turn += of_patch * curvatures[i].maximum;
  }
  Corners corners;
  corners.area_share = corner_area / area;
  if (corners.area_share >= smallest_corner_share) {
    corners.value = corner_area / (inscribed_radius * turn);
  }
  return corners;
}

}  // namespace

Roundness wadell_roundness(const IndexedMesh& mesh, double inscribed_radius, double ball,
                           const Execution& execution) {
  if (!(inscribed_radius > 0.0) || !(ball > 0.0)) {
    throw Error(
        ErrorCode::InvalidInput,
        "The radius of the inscribed sphere or of the balls is not positive, so corners cannot be "
        "told from the rest; give the largest inscribed sphere of the same body and balls of about "
        "a fifth of it.");
  }
  const double radius = std::max(ball * inscribed_radius, edges_per_ball * mean_edge(mesh));
  Roundness result;
  result.ball_radius = radius;
  result.smallest_radius = resolved_share * radius / inscribed_radius;
  if (!(radius <= inscribed_radius)) {
    result.roundness = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  const SurfacePatches patches = surface_patches(mesh, patch_share * radius);
  const std::vector<BallCentre> places = places_of(patches, most_places);
  const Corners narrow =
      corners_in(patches, places, radius, inscribed_radius, execution.part(0.0, 0.3));
  const Corners wide =
      corners_in(patches, places, wider * radius, inscribed_radius, execution.part(0.3, 1.0));
  // V grows by the same for each part of the radius.
  const double correction = (wide.value - narrow.value) / (wider - 1.0);
  const double most = largest_correction * radius / inscribed_radius * (1.0 - narrow.value);
  result.roundness = narrow.value - std::clamp(correction, 0.0, std::max(most, 0.0));
  result.corner_area_share = narrow.area_share;
  return result;
}

}  // namespace wscvt
