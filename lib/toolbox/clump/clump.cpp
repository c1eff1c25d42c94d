// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/clump.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <functional>
#include <utility>

#include "toolbox/clump/first_contact.h"
#include "toolbox/clump/sphere.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/distances.h"
#include "wscvt/remesh/remesh_warnings.h"
#include "wscvt/remesh/repaired_scan.h"
#include "wscvt/repair/components.h"

namespace wscvt {

namespace {

MassError mass_error(const MassProperties& mass, const ShapeDescriptors& grain, double radius) {
  ShapeDescriptors value;
  value.inertia_tensor = mass.inertia_tensor;
  return {relative_error_percent(mass.volume, grain.volume),
          100.0 * (mass.centroid - grain.centroid).norm() / radius,
          inertia_error_percent(value, grain)};
}

/// Sums spheres, overlaps counted repeatedly.
MassProperties summed_mass(const std::vector<Sphere>& spheres) {
  MassProperties mass;
  for (const Sphere& sphere : spheres) {
    const double volume = 4.0 / 3.0 * pi * portable::pow(sphere.radius, 3);
    mass.volume += volume;
    mass.centroid += volume * sphere.centre;
  }
  mass.centroid /= mass.volume;
  for (const Sphere& sphere : spheres) {
    const double volume = 4.0 / 3.0 * pi * portable::pow(sphere.radius, 3);
    const Vector3 from = sphere.centre - mass.centroid;
    mass.inertia_tensor += volume * ((0.4 * sphere.radius * sphere.radius + from.squaredNorm()) *
                                         Eigen::Matrix3d::Identity() -
                                     from * from.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(mass.inertia_tensor,
                                                              Eigen::EigenvaluesOnly);
  mass.principal_moments = solver.eigenvalues();
  mass.principal_axes =
      principal_axes(mass.inertia_tensor, [&](const Eigen::Matrix<double, 3, 2>& axes) {
        AxisMoments moments;
        moments.volume = mass.volume;
        for (const Sphere& sphere : spheres) {
          const double square = sphere.radius * sphere.radius;
          const double volume = 4.0 / 3.0 * pi * square * sphere.radius;
          const Eigen::Array2d from = axes.transpose() * (sphere.centre - mass.centroid);
          // A ball's second moment about its centre is V r^2 / 5.
          moments.third += (volume * from * (from * from + 0.6 * square)).matrix();
        }
        return moments;
      });
  return mass;
}

double intersection_over_union(const IndexedMesh& grain, const std::vector<Sphere>& spheres,
                               const Execution& execution) {
  constexpr double points = 60000.0;
  Eigen::AlignedBox3d box = box_of(grain.points);
  for (const Sphere& sphere : spheres) {
    box.extend(sphere.centre + Vector3::Constant(sphere.radius));
    box.extend(sphere.centre - Vector3::Constant(sphere.radius));
  }
  const Vector3 low = box.min();
  const Vector3 size = box.sizes();
  const double step = portable::cbrt(size.prod() / points);
  std::array<std::vector<double>, 3> places;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double place = 0.5 * step;
    while (place < size[axis]) {
      places[axis].push_back(place);
      place += step;
    }
  }
  std::vector<Vector3> grid;
  for (const double x : places[0]) {
    for (const double y : places[1]) {
      for (const double z : places[2]) grid.push_back(low + Vector3(x, y, z));
    }
  }
  const std::vector<char> inside = are_inside(grain, grid, execution);
  std::size_t both = 0;
  std::size_t either = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const bool covered = std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& sphere) {
      return sphere.distance(grid[i]) < 0.0;
    });
    both += covered && inside[i] != 0 ? 1 : 0;
    either += covered || inside[i] != 0 ? 1 : 0;
  }
  return static_cast<double>(both) / static_cast<double>(either);
}

/// Returns the number of groups of connected spheres.
std::size_t group_count(const std::vector<Sphere>& spheres) {
  boost::disjoint_sets_with_storage<> linked(spheres.size());
  std::size_t groups = spheres.size();
  for (std::size_t a = 0; a < spheres.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (spheres[a].distance(spheres[b].centre) > spheres[b].radius) continue;
      if (linked.find_set(a) != linked.find_set(b)) --groups;
      linked.union_set(a, b);
    }
  }
  return groups;
}

/// Returns the error of first contact of spheres in the unit frame.
ContactError contact_of(const std::vector<Sphere>& spheres, const IndexedMesh& unit,
                        const Execution& execution) {
  double reach = 0.0;
  for (const Vector3& p : unit.points) reach = std::max(reach, p.norm());
  for (const Sphere& sphere : spheres) {
    reach = std::max(reach, sphere.centre.norm() + sphere.radius);
  }
  reach *= 1.2;
  return contact_error(ContactHeights(spheres, reach, execution).distances(execution),
                       ContactHeights(unit, reach, execution).distances(execution));
}

double contact_percent(const ContactError& contact) {
  return portable::hypot(contact.mean, contact.scatter);
}

/// Returns the error of spheres that the option names, as it is reported; in %.
double error_percent(ClumpError of, const IndexedMesh& unit, const ShapeDescriptors& shape,
                     const std::vector<Sphere>& spheres, const Execution& execution) {
  if (of == ClumpError::Volume) {
    return 100.0 * (1.0 - intersection_over_union(unit, spheres, execution));
  }
  if (of == ClumpError::Inertia) {
    const IndexedMesh surface = sphere_union_mesh(spheres, execution);
    return mass_error(mass_properties(describe_shape(surface, execution)), shape, 1.0)
        .inertia_percent;
  }
  return contact_percent(contact_of(spheres, unit, execution));
}

/// Returns what the allowed error is held against, in %, and its name.
std::pair<double, std::string> allowed_error(const ClumpResult& result) {
  switch (result.options.error_measure) {
    case ClumpError::Volume:
      return {100.0 * (1.0 - result.intersection_over_union),
              "volume that is only in one of grain and clump is "};
    case ClumpError::Inertia:
      return {result.united.error.inertia_percent, "error of the inertia is "};
    case ClumpError::Contact:
      return {contact_percent(result.contact), "error of first contact is "};
    case ClumpError::Distance:
      break;
  }
  return {100.0 * result.rms_distance / result.equivalent_radius, "rms distance is "};
}

void add_warnings(ClumpResult& result) {
  append_repair_warnings(result.input, "made a clump", result.warnings);
  const ClumpOptions& options = result.options;
  const auto [error, name] = allowed_error(result);
  const std::string count = format_count(result.spheres.size(), "sphere");
  if (options.max_error_percent > 0.0 && error > options.max_error_percent) {
    result.warnings.push_back(
        "With " + count + " the " + name + format_number(error, 3) + " %, more than the allowed " +
        format_typed(options.max_error_percent) + " %. Allow more spheres, or a larger error.");
  } else if (options.max_error_percent == 0.0 &&
             result.spheres.size() < static_cast<std::size_t>(options.sphere_count)) {
    result.warnings.push_back("Only " + count + " of the smallest radius " +
                              (result.spheres.size() == 1 ? "fits" : "fit") + " inside.");
  }
  constexpr double least_shared = 0.5;
  if (result.intersection_over_union < least_shared) {
    result.warnings.push_back(
        "Scan and clump have only " + format_percent(result.intersection_over_union) +
        " of the volume of both in common (intersection over union). Give more spheres: flat and "
        "long grains need many.");
  }
  const std::size_t groups = group_count(result.spheres);
  if (groups > 1) {
    result.warnings.push_back(
        "The spheres are in " + std::to_string(groups) +
        " groups that do not touch each other. Give more spheres, or leave out " +
        mention("inside") + ", if they must be connected.");
  }
}

/// Measures the errors of the spheres in the unit frame.
void measure(const IndexedMesh& unit, const std::vector<Sphere>& spheres, const UnitFrame& frame,
             ClumpResult& result, const Execution& execution) {
  constexpr std::size_t samples = 20000;
  const UnionDistance distance =
      union_distance(area_uniform_samples(unit, samples), spheres, execution);
  result.rms_distance = frame.radius * distance.root_mean_square;
  result.largest_distance = frame.radius * distance.largest;
  execution.report(0.3, "Measuring the clump");
  result.intersection_over_union = intersection_over_union(unit, spheres, execution);
  execution.report(0.5, "Measuring the clump");
  result.contact = contact_of(spheres, unit, execution);
}

}  // namespace

void check_clump_options(const ClumpOptions& options) {
  require_in_range(options.sphere_count, sphere_count_option);
  require_in_range(options.max_error_percent, clump_error_option);
  require_valid(options.error_measure);
  require_in_range(options.most_spheres, most_spheres_option);
  require_in_range(options.smallest_radius_percent, smallest_radius_option);
  require_in_range(options.max_repaired_area_percent, repaired_area_limit_option);
  check_shrink_wrap_options(options.shrink_wrap);
}

ClumpResult make_clump(IndexedMesh scan, const ClumpOptions& options, const Execution& execution) {
  check_clump_options(options);
  RemeshOptions repairs;
  repairs.points = options.points;
  repairs.shrink_wrap = options.shrink_wrap;
  repairs.max_repaired_area_percent = options.max_repaired_area_percent;
  RepairedScan repaired = repair_scan(std::move(scan), repairs, execution.part(0.0, 0.15));
  ClumpResult result;
  result.options = options;
  result.input = repaired.checked.report;
  result.repaired_scan = std::move(repaired.checked.mesh);
  result.scan = describe_shape(result.repaired_scan, execution);
  result.equivalent_radius = equivalent_radius(result.scan.volume);
  for (const std::string& warning : {repaired.precision_warning, repaired.crossing_warning}) {
    if (!warning.empty()) result.warnings.push_back(warning);
  }

  const UnitFrame frame(result.scan);
  const IndexedMesh unit = frame.to_unit(result.repaired_scan);
  std::function<double(const std::vector<Sphere>&)> error;
  if (options.error_measure != ClumpError::Distance) {
    error = [&, shape = describe_shape(unit, execution)](const std::vector<Sphere>& spheres) {
      return error_percent(options.error_measure, unit, shape, spheres, execution.part(0.8, 0.8));
    };
  }
  FittedSpheres fitted = fit_spheres(unit, options, execution.part(0.15, 0.8), error);
  measure(unit, fitted.spheres, frame, result, execution.part(0.8, 1.0));
  // Rounding must not push a sphere outside that touches the surface from within.
  const double shrink = options.inside ? 1.0 - 1e-9 : 1.0;
  for (const Sphere& sphere : fitted.spheres) {
    result.spheres.push_back({frame.to_scan(sphere.centre), shrink * frame.radius * sphere.radius});
  }
  for (const ClumpStage& stage : fitted.stages) {
    result.stages.push_back({stage.spheres, frame.radius * stage.rms_distance});
  }
  result.surface = sphere_union_mesh(result.spheres, execution);
  result.united.mass = mass_properties(describe_shape(result.surface, execution));
  result.summed.mass = summed_mass(result.spheres);
  for (SphereMass* const mass : {&result.united, &result.summed}) {
    mass->error = mass_error(mass->mass, result.scan, result.equivalent_radius);
  }
  add_warnings(result);
  return result;
}

}  // namespace wscvt
