// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/form_axes.h"

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/optimal_bounding_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/scan/coordinates.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {

namespace {

constexpr const char* box_stage = "Turning the bounding box";

/// More points than this are thinned before the box is turned.
constexpr std::size_t maximum_points = 2000;
constexpr int thinning_directions = 2000;

/// The extreme points in directions spread over the sphere.
std::vector<Vector3> extreme_points(const std::vector<Vector3>& points,
                                    const Execution& execution) {
  std::vector<std::size_t> extremes;
  for (const Vector3& direction : fibonacci_lattice(thinning_directions)) {
    execution.report(0.0, box_stage);
    std::size_t farthest = 0;
    double reach = direction.dot(points[0]);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double value = direction.dot(points[i]);
      if (value > reach) {
        reach = value;
        farthest = i;
      }
    }
    extremes.push_back(farthest);
  }
  std::sort(extremes.begin(), extremes.end());
  extremes.erase(std::unique(extremes.begin(), extremes.end()), extremes.end());
  std::vector<Vector3> result;
  result.reserve(extremes.size());
  for (const std::size_t i : extremes) result.push_back(points[i]);
  return result;
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// CGAL's traits, which report as well with each turn that is tried: thousands of them in a second.
struct ReportingBoxTraits : CGAL::Oriented_bounding_box_traits_3<Kernel> {
  using Base = CGAL::Oriented_bounding_box_traits_3<Kernel>;

  // CGAL's code asks for a default, which it does not use.
  explicit ReportingBoxTraits(const Execution* to = nullptr) : execution(to) {}

  // CGAL's name.
  // NOLINTNEXTLINE(readability-identifier-naming)
  Matrix get_Q(const Matrix& m) const {
    execution->report(0.0, box_stage);
    return Base::get_Q(m);
  }

  const Execution* execution;
};

}  // namespace

FormAxes oriented_box_axes(const std::vector<Vector3>& points, const Execution& execution) {
  if (points.size() < 4) {
    throw Error(ErrorCode::InvalidInput, "A box about " + std::to_string(points.size()) +
                                             " points has no volume; give at least four points.");
  }
  // The exact numbers behind CGAL's predicates end the program at what is not a number.
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    throw Error(ErrorCode::InvalidInput, "Point " + std::to_string(i) +
                                             " has a coordinate that is not a finite number, so "
                                             "there is no box about it; remove it.");
  }
  check_scan_size(points);
  std::vector<Vector3> local(points);
  for (Vector3& p : local) p -= points.front();
  std::vector<Kernel::Point_3> candidates;
  for (const Vector3& p :
       local.size() > maximum_points ? extreme_points(local, execution) : local) {
    candidates.emplace_back(p.x(), p.y(), p.z());
  }
  CGAL::Aff_transformation_3<Kernel> turn;
  // CGAL's own default is one generator for the whole program, whose state other calls change. Its
  // convex hull gives the points in an order that goes by addresses, and with it the last digits
  // would change from call to call.
  CGAL::oriented_bounding_box(candidates, turn,
                              CGAL::parameters::random_seed(1U).use_convex_hull(false).geom_traits(
                                  ReportingBoxTraits(&execution)));

  std::array<double, 3> edges{};
  for (int k = 0; k < 3; ++k) {
    const Vector3 axis(turn.m(k, 0), turn.m(k, 1), turn.m(k, 2));
    double lowest = 0.0;  // the first point is the origin
    double highest = 0.0;
    for (const Vector3& p : local) {
      const double place = axis.dot(p);
      lowest = std::min(lowest, place);
      highest = std::max(highest, place);
    }
    edges[static_cast<std::size_t>(k)] = highest - lowest;
  }
  std::sort(edges.begin(), edges.end());
  return {edges[0], edges[1], edges[2]};
}

FormRatios form_ratios(const FormAxes& axes) {
  const double s = axes.shortest;
  const double i = axes.intermediate;
  const double l = axes.longest;
  FormRatios ratios;
  ratios.aspect_ratio = s / l;
  ratios.zingg_elongation = i / l;
  ratios.zingg_flatness = s / i;
  ratios.kong_fonseca_elongation = (l - i) / l;
  ratios.kong_fonseca_flatness = (i - s) / i;
  ratios.krumbein_sphericity = std::cbrt((i / l) * (s / l));
  return ratios;
}

}  // namespace wscvt
