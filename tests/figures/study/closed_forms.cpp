// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "figures/study/paper_study.h"
#include "support/test_shapes.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt::study {

namespace {

using test::pi;
using Values = std::vector<std::pair<std::string, double>>;

struct Body {
  std::string name;
  IndexedMesh mesh;
  Values values;  ///< by the keys of list_descriptors
};

/// Meshes of curved bodies have 20 * 4^6 faces.
constexpr int subdivisions = 6;
/// Points of the midpoint rules for integrals without a formula.
constexpr int steps = 200000;

void append_axes(Values& values, const std::string& suffix, double s, double i, double l) {
  values.insert(values.end(), {{"axis_s_" + suffix, s},
                               {"axis_i_" + suffix, i},
                               {"axis_l_" + suffix, l},
                               {"aspect_ratio_" + suffix, s / l},
                               {"zingg_elongation_" + suffix, i / l},
                               {"zingg_flatness_" + suffix, s / i},
                               {"kong_fonseca_elongation_" + suffix, (l - i) / l},
                               {"kong_fonseca_flatness_" + suffix, (i - s) / i},
                               {"krumbein_sphericity_" + suffix, std::cbrt(i * s / (l * l))}});
}

void append_solid(Values& values, double volume, double area, double inscribed) {
  values.insert(values.end(), {{"volume", volume},
                               {"area", area},
                               {"equivalent_diameter", std::cbrt(6.0 * volume / pi)},
                               {"sphericity_wadell", std::cbrt(36.0 * pi * volume * volume) / area},
                               {"convexity", 1.0},
                               {"inscribed_radius", inscribed}});
}

void append_orientation(Values& values, double f1, double f2, double f3) {
  values.insert(values.end(), {{"orientation_f1", f1},
                               {"orientation_f2", f2},
                               {"orientation_f3", f3},
                               {"compactness", f3 / f1},
                               {"flakiness", (f1 - f2) / f1},
                               {"rodness", (f2 - f3) / f1}});
}

Body sphere() {
  Values values;
  append_solid(values, 4.0 * pi / 3.0, 4.0 * pi, 1.0);
  append_axes(values, "inertia", 2.0, 2.0, 2.0);
  append_axes(values, "box", 2.0, 2.0, 2.0);
  append_orientation(values, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0);
  for (const char* key : {"sa", "sq", "sdq_invariant", "sdq_printed"}) {
    values.emplace_back(key, 0.0);
  }
  values.emplace_back("roundness_wadell", 1.0);
  return {"sphere", test::sphere(subdivisions), std::move(values)};
}

/// Area of an ellipsoid with semi-axes c < b < a (Legendre's formula).
double ellipsoid_area(double c, double b, double a) {
  const double angle = std::acos(c / a);
  const double modulus = std::sqrt(a * a * (b * b - c * c) / (b * b * (a * a - c * c)));
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  return 2.0 * pi * c * c + 2.0 * pi * a * b / sine *
                                (std::ellint_2(modulus, angle) * sine * sine +
                                 std::ellint_1(modulus, angle) * cosine * cosine);
}

/// Mean radius of curvature by turn (wadell_roundness) over the ellipsoid's points that are
/// corners, over the radius of its inscribed sphere; by its own parameters and the textbook
/// curvatures: with h = 1 / |x / a^2|, K = h^4 / (a b c)^2 and H = h^3 (a^2 + b^2 + c^2 - |x|^2) /
/// (2 (a b c)^2).
double ellipsoid_roundness(const Vector3& axes) {
  constexpr int side = 1000;
  const double inscribed = axes.minCoeff();
  const double product = axes.prod();
  double corners = 0.0;
  double turn = 0.0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double t = (i + 0.5) * pi / side;
      const double p = (j + 0.5) * 2.0 * pi / side;
      const Vector3 u(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
      const Vector3 x = axes.cwiseProduct(u);
      const double h = 1.0 / u.cwiseQuotient(axes).norm();
      const double gauss = std::pow(h, 4) / (product * product);
      const double mean =
          std::pow(h, 3) * (axes.squaredNorm() - x.squaredNorm()) / (2.0 * product * product);
      const double k = mean + std::sqrt(std::max(0.0, mean * mean - gauss));
      if (k * inscribed <= 1.05) continue;
      corners += product / h * std::sin(t);
      turn += product / h * std::sin(t) * k;
    }
  }
  return corners / (turn * inscribed);
}

Body ellipsoid() {
  const Vector3 axes(1.0, 1.5, 2.0);
  Values values;
  append_solid(values, 4.0 * pi / 3.0 * axes.prod(), ellipsoid_area(axes[0], axes[1], axes[2]),
               axes[0]);
  append_axes(values, "inertia", 2.0 * axes[0], 2.0 * axes[1], 2.0 * axes[2]);
  append_axes(values, "box", 2.0 * axes[0], 2.0 * axes[1], 2.0 * axes[2]);
  values.emplace_back("roundness_wadell", ellipsoid_roundness(axes));
  return {
      "ellipsoid 1 : 1.5 : 2",
      test::transformed(test::scaled(test::sphere(subdivisions), axes), test::random_rotation(4)),
      std::move(values)};
}

Body box() {
  const Vector3 edges(1.0, 1.5, 2.0);
  const Vector3 faces(edges[1] * edges[2], edges[2] * edges[0], edges[0] * edges[1]);
  Values values;
  append_solid(values, edges.prod(), 2.0 * faces.sum(), 0.5 * edges[0]);
  // Equal second moments: e^2 / 12 of the box is a^2 / 5 of the ellipsoid.
  const double moments = std::sqrt(5.0 / 3.0);
  append_axes(values, "inertia", moments * edges[0], moments * edges[1], moments * edges[2]);
  append_axes(values, "box", edges[0], edges[1], edges[2]);
  append_orientation(values, faces[0] / faces.sum(), faces[1] / faces.sum(),
                     faces[2] / faces.sum());
  return {"box 1 : 1.5 : 2",
          test::transformed(test::box(edges[0], edges[1], edges[2]), test::random_rotation(9)),
          std::move(values)};
}

/// Area of r(z), z the cosine of the polar angle, with its derivative: 2 pi integral
/// r (r^2 + (1 - z^2) r'^2)^(1/2) dz.
template <class Radius, class Slope>
double zonal_area(const Radius& radius, const Slope& slope) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double z = -1.0 + (2.0 * i + 1.0) / steps;
    const double r = radius(z);
    const double s = slope(z);
    sum += r * std::sqrt(r * r + (1.0 - z * z) * s * s);
  }
  return 2.0 * pi * 2.0 * sum / steps;
}

template <class Radius>
IndexedMesh zonal_mesh(const Radius& radius) {
  IndexedMesh mesh = test::sphere(subdivisions);
  for (Vector3& p : mesh.points) p *= radius(p.z());
  return mesh;
}

/// The unit sphere plus a zonal harmonic of waves of 0.13 radii, far below the cut-off length of
/// roughness: the heights are the harmonic.
Body waves() {
  constexpr int l = 48;
  constexpr double height = 0.003;
  const double scale = height * std::sqrt((2 * l + 1) / (4.0 * pi));
  const auto radius = [&](double z) { return 1.0 + scale * std::legendre(l, z); };
  const auto slope = [&](double z) {
    return scale * l * (z * std::legendre(l, z) - std::legendre(l - 1, z)) / (z * z - 1.0);
  };
  double sa = 0.0;
  double third = 0.0;
  double fourth = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double y = radius(-1.0 + (2.0 * i + 1.0) / steps) - 1.0;
    sa += std::abs(y) / steps;
    third += y * y * y / steps;
    fourth += y * y * y * y / steps;
  }
  const double sq = height / std::sqrt(4.0 * pi);
  return {"sphere with waves of degree 48",
          test::transformed(zonal_mesh(radius), test::random_rotation(5)),
          {{"sa", sa},
           {"sq", sq},
           {"ssk", third / std::pow(sq, 3)},
           {"sku", fourth / std::pow(sq, 4)},
           {"sdq_invariant", height * std::sqrt(l * (l + 1) / zonal_area(radius, slope))}}};
}

/// r = 1 + a z^2, upright: eq. 17's integral is pi^2 a^2.
Body upright() {
  constexpr double a = 0.2;
  const auto radius = [](double z) { return 1.0 + a * z * z; };
  const double area = zonal_area(radius, [](double z) { return 2.0 * a * z; });
  return {"r = 1 + 0.2 z^2",
          zonal_mesh(radius),
          {{"area", area}, {"sdq_printed", pi * a / std::sqrt(area)}}};
}

struct Worst {
  std::string label;
  double relative = -1.0;  ///< -1: no body with a value other than 0
  std::string body;
  double absolute = -1.0;  ///< -1: no body with the value 0
};

}  // namespace

ClosedFormErrors closed_form_errors(const Execution& execution) {
  ClosedFormErrors result;
  result.all = {{"body", "descriptor", "formula", "measured", "error_percent"}};
  result.worst = {{"descriptor", "worst error %", "on", "worst where it is 0"}};
  std::vector<std::string> order;
  std::map<std::string, Worst> worst;
  for (const Body& body : {sphere(), ellipsoid(), box(), waves(), upright()}) {
    const auto rows =
        list_descriptors(describe_shape_in_detail(body.mesh, DetailedOptions(), execution));
    for (const DescriptorValue& row : rows) {
      if (worst.try_emplace(row.key, Worst{row.label, -1.0, "", -1.0}).second) {
        order.push_back(row.key);
      }
      const auto known = std::find_if(body.values.begin(), body.values.end(),
                                      [&](const auto& value) { return value.first == row.key; });
      if (known == body.values.end()) continue;
      const double formula = known->second;
      Worst& of = worst[row.key];
      std::string error;
      // Formulas such as (l - i) / l are 0 but for rounding.
      if (std::abs(formula) < 1e-12) {
        of.absolute = std::max(of.absolute, std::abs(row.value));
      } else {
        const double percent = relative_error_percent(row.value, formula);
        error = format_exact(percent);
        if (std::abs(percent) > of.relative) {
          of.relative = std::abs(percent);
          of.body = body.name;
        }
      }
      result.all.push_back(
          {body.name, row.key, format_exact(formula), format_exact(row.value), error});
    }
  }
  for (const std::string& key : order) {
    const Worst& of = worst[key];
    result.worst.push_back({of.label, of.relative < 0.0 ? "-" : format_number(of.relative, 2),
                            of.relative < 0.0 ? "-" : of.body,
                            of.absolute < 0.0 ? "-" : format_number(of.absolute, 2)});
  }
  return result;
}

}  // namespace wscvt::study
