// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/surface/ball_curvature.h"

namespace wscvt {

namespace {

/// Balls smaller than this many mean edges measure the facets.
constexpr double edges_per_ball = 2.5;

/// Patch radius / ball radius. With patches the time does not grow on dense scans. Their size
/// widens the ball by a few per cent.
constexpr double patch_share = 0.125;

constexpr std::size_t most_places = 5000;

/// Curvature times inscribed radius above which a point is a corner: a sphere has none.
constexpr double corner_curvature = 1.05;

/// Corners on a smaller fraction of the area are noise.
constexpr double smallest_corner_share = 0.01;

/// The second ball's radius / the first's, and the largest factor of the correction.
constexpr double wider = 1.5;
constexpr double largest_correction = 0.7;

/// The smallest resolved radius / the ball's radius.
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

/// The places where curvature is measured, and their areas.
struct Places {
  std::vector<BallCentre> centres;
  std::vector<double> areas;

  void add(const SurfacePatches& patches, std::int32_t patch, double area) {
    if (!centres.empty() && centres.back().patch == patch) {
      areas.back() += area;
      return;
    }
    centres.push_back({patches.patches[index(patch)].centre, patch});
    areas.push_back(area);
  }
};

/// Returns all patches, or at most `count` places: a random one in each of `count` consecutive
/// parts of equal area. Random, because regular steps may all be in one row of a regular mesh.
Places places_of(const SurfacePatches& patches, std::size_t count) {
  const auto all = static_cast<std::int32_t>(patches.patches.size());
  Places places;
  if (patches.patches.size() <= count) {
    for (std::int32_t i = 0; i < all; ++i) places.add(patches, i, patches.patches[index(i)].area);
    return places;
  }
  double area = 0.0;
  for (const SurfacePatch& patch : patches.patches) area += patch.area;
  const double part = area / static_cast<double>(count);
  std::mt19937 random(1U);
  const auto somewhere = [&] {
    return part * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  double before = 0.0;  // area of the patches before the next
  double next = somewhere();
  std::size_t taken = 0;
  for (std::int32_t i = 0; i < all; ++i) {
    before += patches.patches[index(i)].area;
    while (taken < count && (next <= before || i + 1 == all)) {
      places.add(patches, i, part);
      next = static_cast<double>(++taken) * part + somewhere();
    }
  }
  return places;
}

/// Returns V; 1 if there are no corners.
double corner_roundness(const std::vector<double>& areas,
                        const std::vector<PrincipalCurvatures>& curvatures,
                        double inscribed_radius) {
  double area = 0.0;
  double corner_area = 0.0;
  double turn = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    area += areas[i];
    if (!(curvatures[i].maximum * inscribed_radius > corner_curvature)) continue;
    corner_area += areas[i];
    turn += areas[i] * curvatures[i].maximum;
  }
  const bool has_corners = corner_area / area >= smallest_corner_share;
  return has_corners ? corner_area / (inscribed_radius * turn) : 1.0;
}

}  // namespace

Roundness wadell_roundness(const IndexedMesh& mesh, double inscribed_radius, double ball,
                           const Execution& execution) {
  if (!(inscribed_radius > 0.0) || !(ball > 0.0)) {
    refuse(
        "The radius of the inscribed sphere or of the balls is not positive, so corners cannot be "
        "detected. Give the largest inscribed sphere of the same body and balls of about a fifth "
        "of it.");
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
  const Places places = places_of(patches, most_places);
  const std::vector<std::vector<PrincipalCurvatures>> curvatures =
      ball_curvatures(patches, places.centres, {radius, wider * radius}, execution);
  const double narrow = corner_roundness(places.areas, curvatures[0], inscribed_radius);
  const double wide = corner_roundness(places.areas, curvatures[1], inscribed_radius);
  // V grows linearly with the radius.
  const double correction = (wide - narrow) / (wider - 1.0);
  const double most = largest_correction * radius / inscribed_radius * (1.0 - narrow);
  result.roundness = narrow - std::clamp(correction, 0.0, std::max(most, 0.0));
  return result;
}

}  // namespace wscvt
