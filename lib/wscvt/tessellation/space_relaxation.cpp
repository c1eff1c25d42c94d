// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/space_relaxation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/tessellation/power_cells.h"
#include "wscvt/tessellation/step_control.h"

namespace wscvt {

namespace {

constexpr std::size_t site_block = 512;

/// A shift takes its site at most this far towards the far edge of its ring: two neighbours that
/// move at the same time do not meet.
constexpr double largest_share_of_ring = 0.45;

/// Flat cells on a rough scan differ in area by up to a tenth however long they are relaxed. The
/// relaxation ends at this share of its tolerance: going on to a hundredth lowered the mean edge
/// ratio of such scans from 1.133 to 1.123, for ten times the iterations.
constexpr double settled_share = 0.5;

/// Calls visit(second, third) for the corners of every triangle about a vertex, counter-clockwise.
template <class Visit>
void visit_ring(const SphereTriangulation& triangulation, std::int32_t vertex, const Visit& visit) {
  const std::int32_t start = triangulation.first_half_edge()[vertex];
  visit_outgoing(triangulation.opposite(), start, [&](std::int32_t h) {
    visit(triangulation.origin(SphereTriangulation::next(h)),
          triangulation.origin(SphereTriangulation::previous(h)));
  });
}

/// det(a, b, c) of every triangle's seeds.
std::vector<double> determinants(const SphereTriangulation& triangulation,
                                 const std::vector<Vector3>& seeds, const Execution& execution) {
  const std::vector<Triangle>& triangles = triangulation.triangles();
  std::vector<double> result(triangles.size());
  execution.parallel_for(result.size(), site_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = triangles[t];
      result[t] = six_volumes(seeds[a], seeds[b], seeds[c]);
    }
  });
  return result;
}

class Relaxation {
 public:
  Relaxation(const SphereSurface& surface, const SiteDensity& density, const Execution& execution)
      : surface_(surface), density_(density), execution_(execution) {}

  SpaceTessellation run(std::vector<Vector3> seeds, SphereTriangulation triangulation,
                        const RelaxationOptions& options) {
    seeds_ = std::move(seeds);
    triangulation_.emplace(std::move(triangulation));
    places_.assign(seeds_.size(), MeshPlace());
    report_ = RelaxationReport();
    iterate(options);
    return {std::move(seeds_), std::move(positions_), *std::move(triangulation_),
            std::move(cells_.areas), std::move(report_)};
  }

 private:
  void evaluate() {
    const std::size_t count = seeds_.size();
    positions_.resize(count);
    wanted_.resize(density_ ? count : 0);
    execution_.parallel_for(count, site_block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        positions_[i] = surface_.position_near(seeds_[i], places_[i]);
        if (density_) wanted_[i] = density_(seeds_[i], places_[i]);
      }
    });
    const auto repair = triangulation_->restore_surface_delaunay(seeds_, positions_, execution_,
                                                                 smallest_seed_determinant);
    // A centroidal tessellation of density rho has rho^(1/2) cells per area.
    squares_ = wanted_;
    for (double& density : squares_) density *= density;
    compute_power_cells(*triangulation_, positions_, {}, squares_, CellGeometry::Surface,
                        execution_, cells_);
    measure(repair.flips);
  }

  void measure(int flips) {
    const auto count = static_cast<double>(seeds_.size());
    double area = 0.0;
    double share = 0.0;
    double squared_shift = 0.0;
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      area += cells_.areas[i];
      share += wanted_.empty() ? 1.0 : 1.0 / wanted_[i];
      squared_shift += (cells_.centroids[i] - positions_[i]).squaredNorm();
    }
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      const double target = area / (wanted_.empty() ? count : wanted_[i] * share);
      const double ratio = cells_.areas[i] / target;
      sum += ratio;
      squares += ratio * ratio;
    }
    const double mean = sum / count;
    step_.area_spread = std::sqrt(std::max(0.0, squares / count - mean * mean));
    step_.displacement = std::sqrt(squared_shift / area);
    step_.flips = flips;
  }

  /// Where a site's seed goes when the site goes `factor` times the way to its centroid.
  Vector3 stepped(std::int32_t site, double factor) const {
    const Vector3& origin = positions_[site];
    const Vector3 shift = factor * (cells_.centroids[site] - origin);
    Vector3 normal = Vector3::Zero();
    visit_ring(*triangulation_, site, [&](std::int32_t j, std::int32_t k) {
      normal += doubled_area_normal(origin, positions_[j], positions_[k]);
    });
    normal.normalize();
    // The triangle of the ring into which the shift points: the one in which the smaller of its two
    // coordinates is largest. In the ring's plane, seen along the normal.
    double best = -std::numeric_limits<double>::infinity();
    std::array<double, 2> shares{0.0, 0.0};
    std::array<std::int32_t, 2> towards{site, site};
    visit_ring(*triangulation_, site, [&](std::int32_t j, std::int32_t k) {
      const Vector3 to_j = positions_[j] - origin;
      const Vector3 to_k = positions_[k] - origin;
      const double area = to_j.cross(to_k).dot(normal);
      if (!(area > 0.0)) return;
      const double share_j = shift.cross(to_k).dot(normal) / area;
      const double share_k = to_j.cross(shift).dot(normal) / area;
      const double smaller = std::min(share_j, share_k);
      if (!(smaller > best)) return;
      best = smaller;
      shares = {share_j, share_k};
      towards = {j, k};
    });
    for (double& share : shares) share = std::max(0.0, share);
    const double total = shares[0] + shares[1];
    if (total > largest_share_of_ring) {
      for (double& share : shares) share *= largest_share_of_ring / total;
    }
    return ((1.0 - shares[0] - shares[1]) * seeds_[site] + shares[0] * seeds_[towards[0]] +
            shares[1] * seeds_[towards[1]])
        .normalized();
  }

  /// Whether a triangle may change its determinant: one below the limit, as a start may have, must
  /// not fall further.
  static bool stands(double determinant, double before) {
    return determinant > std::min(smallest_seed_determinant, before) && determinant > 0.0;
  }

  bool all_stand(const std::vector<Vector3>& moved) const {
    const std::vector<double> before = determinants(*triangulation_, seeds_, execution_);
    const std::vector<double> after = determinants(*triangulation_, moved, execution_);
    for (std::size_t t = 0; t < after.size(); ++t) {
      if (!stands(after[t], before[t])) return false;
    }
    return true;
  }

  /// One site after the other, in their order, each by halves until its ring stands.
  void move_singly(const std::vector<Vector3>& wanted) {
    constexpr int halvings = 5;
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      double share = 1.0;
      for (int attempt = 0; attempt < halvings; ++attempt, share *= 0.5) {
        const Vector3 seed = ((1.0 - share) * seeds_[i] + share * wanted[i]).normalized();
        bool ring_stands = true;
        visit_ring(*triangulation_, static_cast<std::int32_t>(i),
                   [&](std::int32_t j, std::int32_t k) {
                     const Vector3 side = seeds_[j].cross(seeds_[k]);
                     ring_stands = ring_stands && stands(seed.dot(side), seeds_[i].dot(side));
                   });
        if (!ring_stands) continue;
        seeds_[i] = seed;
        break;
      }
    }
  }

  void iterate(const RelaxationOptions& options) {
    const std::size_t count = seeds_.size();
    evaluate();
    std::vector<Vector3> arrived = seeds_;      // where the last plain step ended
    std::vector<Vector3> earlier = positions_;  // the sites one evaluation ago
    std::vector<Vector3> plain_step(count);
    std::vector<Vector3> moved(count);
    Momentum momentum;
    double factor = options.over_relaxation;
    bool plain = false;
    CycleWatch watch;
    StallWatch stall;
    while (true) {
      report_.history.push_back(step_);
      if (const auto outcome = outcome_at(step_, options, report_.iterations, settled_share)) {
        report_.outcome = *outcome;
        break;
      }
      if (stall.stalled_at(step_.displacement)) {
        report_.outcome = RelaxationOutcome::Settled;
        break;
      }
      if (!plain && watch.cycling_at(step_.displacement)) {
        plain = true;
        factor = std::min(1.0, factor);
      }
      ++report_.iterations;
      execution_.report(static_cast<double>(report_.iterations) / (report_.iterations + 50.0),
                        "Relaxing the seeds");
      const double uphill =
          execution_.parallel_sum(count, site_block, 0.0, [&](std::size_t begin, std::size_t end) {
            double part = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
              plain_step[i] = stepped(static_cast<std::int32_t>(i), factor);
              part -= (cells_.centroids[i] - positions_[i]).dot(positions_[i] - earlier[i]);
            }
            return part;
          });
      const double carry = options.acceleration && !plain ? momentum.carry(uphill > 0.0) : 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        moved[i] = (plain_step[i] + carry * (plain_step[i] - arrived[i])).normalized();
      }
      if (all_stand(moved)) {
        seeds_.swap(moved);
      } else {
        move_singly(moved);
      }
      earlier = positions_;
      arrived.swap(plain_step);
      evaluate();
    }
  }

  const SphereSurface& surface_;
  const SiteDensity& density_;
  const Execution& execution_;
  std::vector<Vector3> seeds_, positions_;
  std::vector<MeshPlace> places_;
  std::optional<SphereTriangulation> triangulation_;
  std::vector<double> wanted_, squares_;  // of the seeds per area, and of the cells
  PowerCells cells_;
  RelaxationStep step_;
  RelaxationReport report_;
};

/// Puts `extra` seeds into the middles of the triangles that are largest in space, one by one.
void insert_seeds(const SphereSurface& surface, int extra, std::vector<Vector3>& seeds,
                  std::vector<Triangle>& triangles) {
  if (extra <= 0) return;
  const auto position = [&](std::int32_t v) {
    MeshPlace place;
    return surface.position_near(seeds[v], place);
  };
  const auto area = [&](const Triangle& t) {
    return doubled_area_normal(position(t[0]), position(t[1]), position(t[2])).norm();
  };
  std::vector<double> areas;
  areas.reserve(triangles.size());
  for (const Triangle& t : triangles) areas.push_back(area(t));
  for (; extra > 0; --extra) {
    const auto largest =
        static_cast<std::size_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
    const auto [a, b, c] = triangles[largest];
    const auto v = static_cast<std::int32_t>(seeds.size());
    seeds.push_back((seeds[a] + seeds[b] + seeds[c]).normalized());
    triangles[largest] = {a, b, v};
    triangles.push_back({b, c, v});
    triangles.push_back({c, a, v});
    areas[largest] = area(triangles[largest]);
    areas.push_back(area(triangles[triangles.size() - 2]));
    areas.push_back(area(triangles.back()));
  }
}

/// Cuts every edge where the surface is as far from both its ends, and every triangle in four.
void subdivide(const SphereSurface& surface, const SpaceTessellation& coarse,
               const Execution& execution, std::vector<Vector3>& seeds,
               std::vector<Triangle>& triangles) {
  const SphereTriangulation& triangulation = coarse.triangulation;
  std::vector<std::int32_t> middle(triangulation.opposite().size());
  std::vector<std::int32_t> cut;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(middle.size()); ++h) {
    const std::int32_t other = triangulation.opposite()[h];
    if (h < other) {
      middle[h] = static_cast<std::int32_t>(coarse.seeds.size() + cut.size());
      cut.push_back(h);
    } else {
      middle[h] = middle[other];
    }
  }
  seeds = coarse.seeds;
  seeds.resize(coarse.seeds.size() + cut.size());
  execution.parallel_for(cut.size(), site_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::int32_t a = triangulation.origin(cut[i]);
      const std::int32_t b = triangulation.origin(triangulation.opposite()[cut[i]]);
      seeds[coarse.seeds.size() + i] = halfway_seed(surface, coarse.seeds[a], coarse.seeds[b]);
    }
  });
  triangles.clear();
  triangles.reserve(4 * triangulation.triangles().size());
  for (std::size_t t = 0; t < triangulation.triangles().size(); ++t) {
    const auto [a, b, c] = triangulation.triangles()[t];
    const std::int32_t ab = middle[3 * t];
    const std::int32_t bc = middle[3 * t + 1];
    const std::int32_t ca = middle[3 * t + 2];
    triangles.push_back({a, ab, ca});
    triangles.push_back({ab, b, bc});
    triangles.push_back({ca, bc, c});
    triangles.push_back({ab, bc, ca});
  }
}

}  // namespace

Vector3 halfway_seed(const SphereSurface& surface, const Vector3& a, const Vector3& b) {
  constexpr int bisections = 6;
  const auto at = [&](double share) {
    return Vector3(((1.0 - share) * a + share * b).normalized());
  };
  MeshPlace place;
  const Vector3 position_of_a = surface.position_near(a, place);
  MeshPlace place_of_b = place;
  const Vector3 position_of_b = surface.position_near(b, place_of_b);
  // Not nearer to an end: see smallest_seed_determinant.
  double low = 0.1;
  double high = 0.9;
  for (int k = 0; k < bisections; ++k) {
    const double share = 0.5 * (low + high);
    const Vector3 x = surface.position_near(at(share), place);
    const bool nearer_a = (x - position_of_a).squaredNorm() < (x - position_of_b).squaredNorm();
    (nearer_a ? low : high) = share;
  }
  return at(0.5 * (low + high));
}

SiteDensity site_density(const MappedSurface& surface, const std::vector<double>& values) {
  check_densities(surface.mesh(), values);
  if (values.empty()) return {};
  return [&surface, &values](const Vector3& /*direction*/, const MeshPlace& place) {
    return value_at(surface.mesh(), values, place);
  };
}

std::vector<Vector3> surviving_seeds(const MappedSurface& surface,
                                     const std::vector<std::int32_t>& collapse_order, int count) {
  if (count < 4) {
    throw Error(ErrorCode::InvalidInput,
                "A tessellation needs at least 4 seeds, not " + std::to_string(count) + ".");
  }
  std::vector<Vector3> seeds;
  const std::size_t kept = std::min(collapse_order.size(), static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < kept; ++i) {
    seeds.push_back(surface.directions()[collapse_order[i]]);
  }
  if (kept < static_cast<std::size_t>(count)) {
    std::vector<Triangle> triangles = surface.mesh().triangles;
    seeds = surface.directions();
    insert_seeds(surface, count - static_cast<int>(seeds.size()), seeds, triangles);
  }
  // A handful of vertices need not surround the sphere's centre.
  if (!SphereTriangulation::try_build(seeds)) return fibonacci_lattice(count);
  return seeds;
}

SpaceTessellation relax_in_space(std::vector<Vector3> seeds, SphereTriangulation triangulation,
                                 const SphereSurface& surface, const SiteDensity& density,
                                 const RelaxationOptions& options, const Execution& execution) {
  check_relaxation_options(options);
  if (seeds.size() != triangulation.vertex_count()) {
    throw Error(ErrorCode::InvalidInput,
                "The triangulation has " + std::to_string(triangulation.vertex_count()) +
                    " vertices, but there are " + std::to_string(seeds.size()) +
                    " seeds; give one each.");
  }
  return Relaxation(surface, density, execution)
      .run(std::move(seeds), std::move(triangulation), options);
}

SpaceTessellation relax_in_space(std::vector<Vector3> start, int count,
                                 const SphereSurface& surface, const SiteDensity& density,
                                 const RelaxationOptions& options, const MultilevelOptions& levels,
                                 const Execution& execution) {
  check_relaxation_options(options);
  check_multilevel_options(levels);
  const std::vector<int> sizes = level_sizes(count, levels.coarsest_seeds);
  if (static_cast<int>(start.size()) != sizes.front()) {
    throw Error(ErrorCode::InvalidInput, "The coarsest level has " + std::to_string(start.size()) +
                                             " seeds instead of " + std::to_string(sizes.front()) +
                                             ".");
  }
  // Progress by the number of seeds to be moved, of which the last level has three quarters.
  double done = 0.0;
  const double all = std::accumulate(sizes.begin(), sizes.end(), 0.0);
  const auto relax_level = [&](std::size_t level, std::vector<Vector3> seeds,
                               SphereTriangulation triangulation) {
    const double begin = done;
    done += sizes[level];
    const Execution part = execution.part(begin / all, done / all);
    return Relaxation(surface, density, part)
        .run(std::move(seeds), std::move(triangulation),
             level_options(options, levels, level + 1 == sizes.size(), false));
  };
  SphereTriangulation coarsest(start);
  SpaceTessellation result = relax_level(0, std::move(start), std::move(coarsest));
  std::vector<RelaxationLevel> coarser;
  for (std::size_t level = 1; level < sizes.size(); ++level) {
    coarser.push_back({sizes[level - 1], result.report.iterations, result.report.outcome});
    std::vector<Vector3> seeds;
    std::vector<Triangle> triangles;
    subdivide(surface, result, execution, seeds, triangles);
    insert_seeds(surface, sizes[level] - static_cast<int>(seeds.size()), seeds, triangles);
    SphereTriangulation triangulation(seeds, std::move(triangles), execution);
    result = relax_level(level, std::move(seeds), std::move(triangulation));
  }
  result.report.coarser_levels = std::move(coarser);
  return result;
}

}  // namespace wscvt
