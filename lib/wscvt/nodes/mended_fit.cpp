// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/mended_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/pi.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/orientation.h"

namespace wscvt {

namespace {

double smallest_angle_cosine(const IndexedMesh& mesh) {
  double largest = -1.0;
  for (const Triangle& t : mesh.triangles) {
    largest = std::max(
        largest, largest_corner_cosine(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
  }
  return largest;
}

bool looks_outward(const IndexedMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return counter_clockwise(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
  });
}

}  // namespace

bool has_mended(const TriangleMendingReport& report) {
  return report.flips + report.moves + report.relocations > 0;
}

NormalFit fit_mended(const MappedSurface& surface, const MeshDistance* to_scan,
                     const SpaceTessellation& tessellation, const MendedTriangles& mended,
                     double volume, const Execution& execution) {
  const NormalFitOptions options;
  const std::vector<Triangle>& before = tessellation.triangulation.triangles();
  std::vector<FitSample> samples =
      deal_out(mapped_samples(surface, to_scan,
                              std::max(options.samples, 10 * tessellation.seeds.size()), execution),
               tessellation.positions, tessellation.seeds, before, execution);
  if (has_mended(mended.report)) samples = deal_on(samples, before, mended.mesh, mended.relocated);
  return fit_along_normals(mended.mesh, samples, volume, options, execution);
}

std::optional<MendedNodes> mend_radial_nodes(const IndexedMesh& scan, const IndexedMesh& fitted,
                                             const SpaceTessellation& tessellation, double volume,
                                             const Execution& execution) {
  const TriangleMendingOptions mending;
  const double before = smallest_angle_cosine(fitted);
  if (before <= std::cos(mending.smallest_angle * pi / 180.0)) return std::nullopt;
  IndexedMesh directions = scan;
  for (Vector3& p : directions.points) p.normalize();
  if (!looks_outward(directions)) return std::nullopt;
  const MappedSurface surface(scan, std::move(directions.points), execution);
  // What looks outward everywhere from one point meets itself nowhere.
  constexpr std::size_t meeting = 0;
  const MendedTriangles mended = mend_triangles(
      {tessellation.positions, tessellation.triangulation.triangles()},
      surface.locate(tessellation.seeds, execution), surface, mending, execution, meeting);
  MendedNodes nodes;
  NormalFit fit = fit_mended(surface, nullptr, tessellation, mended, volume, execution);
  nodes.mesh = {std::move(fit.positions), mended.mesh.triangles};
  nodes.mending = mended.report;
  nodes.fit = fit.report;
  if (!(smallest_angle_cosine(nodes.mesh) < before) || !looks_outward(nodes.mesh)) {
    return std::nullopt;
  }
  return nodes;
}

}  // namespace wscvt
