// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "figures/study/paper_study.h"
#include "support/test_shapes.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt::study {

namespace {

constexpr std::array<int, 6> node_counts = {100, 200, 300, 500, 1000, 2000};
constexpr std::size_t measure_count = 5;
constexpr std::array<const char*, measure_count> measure_names = {"volume", "area", "aspect_ratio",
                                                                  "sphericity", "sdq"};
using Measures = std::array<double, measure_count>;

Measures measures(const ShapeDescriptors& d) {
  return {d.volume, d.area, d.aspect_ratio, d.sphericity, d.sdq};
}

/// Volume to Sdq by quadrature; the aspect ratio from a mesh of 40,962 points, whose chords leave
/// ratios as they are.
Measures measures(const RadialSurface& surface, const Execution& execution) {
  constexpr int polar_nodes = 128;
  constexpr int frequency = 64;
  const SurfaceIntegrals integrals = integrate(surface, polar_nodes, execution);
  const IndexedMesh dense = mesh_of_surface(surface, frequency, execution);
  return {integrals.volume, integrals.area, describe_shape(dense, execution).aspect_ratio,
          std::cbrt(36.0 * test::pi * integrals.volume * integrals.volume) / integrals.area,
          std::sqrt(integrals.gradient_square / integrals.area)};
}

/// What the paper prints for its WSCVT-D (figure 8), in %; empty where it prints nothing.
std::string printed_error(const Method& method, int node_count, std::size_t measure) {
  struct Printed {
    int node_count;
    std::array<const char*, 4> errors;  // volume, area, aspect ratio, sphericity
  };
  static constexpr std::array<Printed, 4> printed = {{{100, {"6.59", "7.89", "3.48", "3.74"}},
                                                      {500, {"1.35", "3.19", "0.88", "2.36"}},
                                                      {1000, {"0.66", "2.31", "0.55", "1.91"}},
                                                      {2000, {"0.34", "1.81", "0.71", "1.67"}}}};
  if (method.name != wscvt_d.name || measure >= 4) return "";
  for (const Printed& row : printed) {
    if (row.node_count == node_count) return row.errors[measure];
  }
  return "";
}

/// How far "far" is, in equivalent radii.
constexpr double far_radius = 1.25;

double far_share(const std::vector<double>& radii, double limit) {
  const auto far = std::count_if(radii.begin(), radii.end(), [=](double r) { return r > limit; });
  return static_cast<double>(far) / static_cast<double>(radii.size());
}

double far_area_share(const IndexedMesh& mesh, const Vector3& centre, double limit) {
  double area = 0.0;
  double far = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = mesh.points[t[0]];
    const Vector3& b = mesh.points[t[1]];
    const Vector3& c = mesh.points[t[2]];
    const double part = (b - a).cross(c - a).norm();
    area += part;
    if (((a + b + c) / 3.0 - centre).norm() > limit) far += part;
  }
  return far / area;
}

struct Sums {
  Measures value{};
  Measures scan{};
  Measures fitted{};
  Measures from_scan{};
  Measures from_fitted{};
  Measures largest{};
};

}  // namespace

RemeshOptions paper_options(const Method& method, int node_count) {
  AsPublishedOptions published;
  published.sampling = method.sampling;
  published.weighting = method.weighting;
  RemeshOptions options;
  options.method = published;
  options.node_count = node_count;
  return options;
}

SamplingErrors sampling_errors(const std::vector<Scan>& scans, int poses,
                               const Execution& execution) {
  SamplingErrors result;
  result.errors = {{"grain", "sampling", "nodes", "measure", "scan", "fitted", "remesh",
                    "error_percent", "error_from_fitted_percent", "paper_percent",
                    "largest_error_percent"}};
  result.roughness = {{"grain", "sdq_scan", "sdq_fitted", "sdq_printed_least", "sdq_printed_most",
                       "printed_range_percent"}};
  result.far_nodes = {{"grain"}};
  const std::vector<Method> methods = {wscvt_d, wscvt_c, constant, fibonacci};
  for (const Method& method : methods) result.far_nodes[0].push_back(method.name);
  result.far_nodes[0].push_back("scan's area");
  for (const Scan& scan : scans) {
    std::vector<std::string> far_nodes = {scan.name};
    std::vector<Sums> sums(methods.size() * node_counts.size());
    double least = 0.0;
    double most = 0.0;
    for (int pose = 0; pose < poses; ++pose) {
      const IndexedMesh turned =
          pose == 0 ? scan.mesh
                    : test::transformed(scan.mesh,
                                        test::random_rotation(static_cast<std::uint64_t>(pose)));
      Measures fitted{};
      for (std::size_t k = 0; k < sums.size(); ++k) {
        const RemeshResult remeshed = remesh(
            turned,
            paper_options(methods[k / node_counts.size()], node_counts[k % node_counts.size()]),
            execution);
        if (k == 0) {
          const HarmonicSurface surface(remeshed.coefficients.radius);
          fitted = measures(surface, execution);
          const double printed = printed_sdq(surface, 200, execution);
          least = pose == 0 ? printed : std::min(least, printed);
          most = std::max(most, printed);
        }
        const double far_limit = far_radius * remeshed.input.equivalent_radius;
        if (pose == 0 && node_counts[k % node_counts.size()] == node_counts.back()) {
          far_nodes.push_back(
              format_number(100.0 * far_share(remeshed.radial_distances, far_limit), 3));
          if (k + 1 == sums.size()) {
            far_nodes.push_back(
                format_number(100.0 * far_area_share(scan.mesh, remeshed.centre, far_limit), 3));
          }
        }
        const Measures value = measures(remeshed.remesh);
        const Measures original = measures(remeshed.scan);
        for (std::size_t m = 0; m < measure_count; ++m) {
          const double error = std::abs(relative_error_percent(value[m], original[m]));
          sums[k].value[m] += value[m] / poses;
          sums[k].scan[m] += original[m] / poses;
          sums[k].fitted[m] += fitted[m] / poses;
          sums[k].from_scan[m] += error / poses;
          sums[k].from_fitted[m] += std::abs(relative_error_percent(value[m], fitted[m])) / poses;
          sums[k].largest[m] = std::max(sums[k].largest[m], error);
        }
      }
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const Method& method = methods[k / node_counts.size()];
      const int nodes = node_counts[k % node_counts.size()];
      for (std::size_t m = 0; m < measure_count; ++m) {
        result.errors.push_back(
            {scan.name, method.name, std::to_string(nodes), measure_names[m],
             format_number(sums[k].scan[m]), format_number(sums[k].fitted[m]),
             format_number(sums[k].value[m]), format_number(sums[k].from_scan[m], 3),
             format_number(sums[k].from_fitted[m], 3), printed_error(method, nodes, m),
             format_number(sums[k].largest[m], 3)});
      }
    }
    result.far_nodes.push_back(std::move(far_nodes));
    const std::size_t sdq = measure_count - 1;
    result.roughness.push_back({scan.name, format_number(sums[0].scan[sdq], 4),
                                format_number(sums[0].fitted[sdq], 4), format_number(least, 4),
                                format_number(most, 4),
                                format_number(100.0 * (most / least - 1.0), 3)});
  }
  return result;
}

}  // namespace wscvt::study
