// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/remesh/prepared_grain.h"
#include "wscvt/remesh/remesh_warnings.h"
#include "wscvt/remesh/repaired_scan.h"
#include "wscvt/remesh/target_search.h"
#include "wscvt/repair/scan_advice.h"
#include "wscvt/surface/grain_surface.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

namespace {

/// A star-shaped surface in another unit of length.
class ScaledSurface : public RadialSurface {
 public:
  /// Lengths are lengths of `surface` / unit; unit > 0. The surface must outlive this.
  ScaledSurface(const RadialSurface& surface, double unit) : surface_(surface), unit_(unit) {}

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override {
    surface_.evaluate(directions, count, derivatives, jets);
    for (std::size_t i = 0; i < count; ++i) {
      jets[i].radius /= unit_;
      jets[i].gradient /= unit_;
      jets[i].hessian /= unit_;
    }
  }

 private:
  const RadialSurface& surface_;
  double unit_;
};

RemeshResult remesh_to_options(const PreparedGrain& grain, const RemeshOptions& options,
                               const Execution& execution) {
  return searches(options) ? remesh_to_target(grain, options, execution)
                           : remesh_prepared(grain, options, options.node_count, execution);
}

/// Also tells of intersecting triangles of the scan, unless those of the remesh tell of them.
void set_warnings(const RepairedScan& repaired, RemeshResult& result) {
  result.warnings = remesh_warnings(result, repaired.precision_warning);
  const OnScanReport* on_scan = on_scan_report(result);
  const bool is_told = on_scan != nullptr && on_scan->nodes.scan_self_intersections > 0;
  if (repaired.crossing_warning.empty() || is_told) return;
  result.warnings.push_back(repaired.crossing_warning);
}

/// A scan with more faces is not kept as it was given, because the copy would take memory. Then the
/// repaired scan is wrapped.
constexpr std::size_t most_kept_faces = 500'000;

/// Returns an opening whose shrink-wrap of a scan has no intersecting triangles if it is remeshed
/// with these options; 0 if neither tried one has.
double clean_wrap(const IndexedMesh& scan, RemeshOptions options, int node_count,
                  const Execution& execution) {
  options.node_count = node_count;
  options.target = {};
  const auto written = options.measures.written;
  options.measures = {};
  options.measures.written = written;
  for (const double percent : {2.0, usual_opening_percent}) {
    options.shrink_wrap.opening_percent = percent;
    try {
      const RemeshResult wrapped = remesh(scan, options, execution);
      if (on_scan_report(wrapped)->nodes.self_intersections == 0) return percent;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::Cancelled) throw;
    }
  }
  return 0.0;
}

}  // namespace

RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options, const Execution& execution) {
  check_options(options);
  // The advice must hold for what was given: with the digits of the repaired scan, moved to the
  // origin, other triangles may intersect.
  const bool may_advise = options.shrink_wrap.opening_percent == 0.0 &&
                          std::get_if<OnScanOptions>(&options.method) != nullptr;
  const bool is_kept = may_advise && scan.triangles.size() <= most_kept_faces;
  const IndexedMesh given = is_kept ? scan : IndexedMesh();
  RepairedScan repaired = repair_scan(std::move(scan), options, execution.part(0.0, 0.1));
  PreparedGrain grain;
  grain.steep_area_fraction = repaired.steep_area_fraction;
  IndexedMesh kept = options.measures.repaired_scan ? repaired.checked.mesh : IndexedMesh();
  prepare(std::move(repaired.checked), options, execution.part(0.1, 0.3), grain);
  RemeshResult result = remesh_to_options(grain, options, execution.part(0.3, 1.0));
  const OnScanReport* on_scan = on_scan_report(result);
  if (may_advise && on_scan != nullptr && on_scan->nodes.scan_self_intersections > 0) {
    result.clean_wrap_percent =
        clean_wrap(is_kept ? given : grain.scan.mesh, options,
                   static_cast<int>(result.mesh.points.size()), execution.part(1.0, 1.0));
  }
  set_warnings(repaired, result);
  result.repaired_scan = std::move(kept);
  execution.report(1.0, "Done");
  return result;
}

std::vector<RemeshResult> remesh_levels(IndexedMesh scan, RemeshOptions options,
                                        const std::vector<int>& node_counts,
                                        const Execution& execution) {
  if (node_counts.empty()) refuse("No number of nodes is given. Give one or more.");
  if (searches(options)) {
    refuse("An error target needs a single number of nodes. Leave it out.");
  }
  for (const int count : node_counts) {
    options.node_count = count;
    check_options(options);
  }
  options.node_count = *std::max_element(node_counts.begin(), node_counts.end());
  RepairedScan repaired = repair_scan(std::move(scan), options, execution.part(0.0, 0.1));
  PreparedGrain grain;
  grain.steep_area_fraction = repaired.steep_area_fraction;
  IndexedMesh kept = options.measures.repaired_scan ? repaired.checked.mesh : IndexedMesh();
  prepare(std::move(repaired.checked), options, execution.part(0.1, 0.3), grain);
  std::vector<RemeshResult> results;
  const double share = 0.7 / static_cast<double>(node_counts.size());
  for (const int count : node_counts) {
    const double begin = 0.3 + share * static_cast<double>(results.size());
    results.push_back(remesh_prepared(grain, options, count, execution.part(begin, begin + share)));
    set_warnings(repaired, results.back());
  }
  results.front().repaired_scan = std::move(kept);
  return results;
}

RemeshResult remesh(const RadialSurface& surface, const RemeshOptions& options,
                    const Execution& execution) {
  check_options(options);
  const SurfaceIntegrals integrals = integrate(surface, execution.part(0.0, 0.1));
  const double unit = equivalent_radius(integrals.volume);
  const ScaledSurface scaled(surface, unit);
  PreparedGrain grain;
  prepare(scaled, integrals, unit, options, execution.part(0.1, 0.4), grain);
  RemeshResult result = remesh_to_options(grain, options, execution.part(0.4, 1.0));
  result.warnings = remesh_warnings(result, "");
  execution.report(1.0, "Done");
  return result;
}

RemeshResult remesh(const HarmonicMap& map, const RemeshOptions& options,
                    const Execution& execution) {
  constexpr int frequency = 64;
  return remesh(mesh_of_surface(map, frequency, execution), options, execution);
}

RemeshResult remesh(const GrainSurface& surface, const RemeshOptions& options,
                    const Execution& execution) {
  check_grain_surface(surface);
  const Vector3& axes = surface.semi_axes;
  switch (surface.kind) {
    case SurfaceKind::Ellipsoid:
      break;
    case SurfaceKind::Superellipsoid:
      return remesh(Superellipsoid(axes, surface.polar_exponent, surface.azimuthal_exponent),
                    options, execution);
    case SurfaceKind::Harmonics:
      return std::visit([&](const auto& shape) { return remesh(shape, options, execution); },
                        read_coefficients(surface.coefficients_file, surface.coefficient_degree));
  }
  return remesh(Ellipsoid(axes), options, execution);
}

}  // namespace wscvt
