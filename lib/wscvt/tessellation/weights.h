// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// What a seed weighs, and so how large its cell becomes.
enum class Weighting {
  Constant,        ///< equal solid angles
  RadialDistance,  ///< WSCVT-D, eq. 10 as printed: w = S / (N pi r^2)
  Curvature,       ///< WSCVT-C, eqs. 11 to 14: more nodes where curvature is high
  Area,            ///< equal surface areas: w = S / (3.118 N g), g = dA/dOmega
  /// Nodes where flat triangles err most: node density g k^(2/3). Curvatures below 0.3 of their
  /// median count as that, so that flat faces keep nodes enough to be seen as flat.
  ErrorAdaptive,
};

template <>
struct EnumerationTable<Weighting> {
  static constexpr std::string_view key = "weighting";
  static constexpr std::string_view subject = "weighting";
  static constexpr Enumerator<Weighting> rows[] = {
      {Weighting::Constant, "constant", "constant", "equal solid angles"},
      {Weighting::RadialDistance, "radial-distance", "WSCVT-D (radial distance)",
       "smaller solid angles far from the centroid, so even triangles"},
      {Weighting::Curvature, "curvature", "WSCVT-C (curvature)",
       "more nodes where the surface bends"},
      {Weighting::Area, "area", "area", "equal surface areas"},
      {Weighting::ErrorAdaptive, "error-adaptive", "error-adaptive",
       "nodes where flat triangles err most"},
  };
};

/// A relaxed cell's solid angle is this times its seed's weight, plus a constant that is the same
/// for all seeds: 2 / (5 / (9 sqrt 3)) from the second moment of the regular hexagon.
inline constexpr double cell_area_per_weight = 3.118;

/// Smallest cell, as a share of the mean one, that this law is trusted with: none is wanted
/// smaller.
inline constexpr double smallest_cell_share = 0.05;

/// What the relaxation asks about seeds wherever they stand. One value a seed, in their order.
class SeedModel {
 public:
  virtual ~SeedModel() = default;

  /// Power weights in steradian for as many seeds as are given; left empty when all are equal.
  virtual void weights(const std::vector<Vector3>& seeds, const Execution& execution,
                       std::vector<double>& result) const = 0;

  /// Radii of the surface.
  virtual void radii(const std::vector<Vector3>& seeds, const Execution& execution,
                     std::vector<double>& result) const = 0;

  /// Wanted number of seeds per surface area, any common scale; left empty when it is constant.
  virtual void surface_densities(const std::vector<Vector3>& seeds, const Execution& execution,
                                 std::vector<double>& result) const = 0;
};

/// Which curvature the curvature weighting reads.
enum class CurvatureSource {
  Series,      ///< analytic, from the fitted series
  QuadricFit,  ///< the paper's local quadric fit on the scan (2-ring)
};

template <>
struct EnumerationTable<CurvatureSource> {
  static constexpr std::string_view key = "curvature-source";
  static constexpr std::string_view subject = "source of the curvature";
  static constexpr Enumerator<CurvatureSource> rows[] = {
      {CurvatureSource::Series, "series", "harmonic series",
       "exact derivatives of the fitted surface"},
      {CurvatureSource::QuadricFit, "quadrics", "quadrics on the scan",
       "a quadric fitted around each vertex of the scan over two rings, as in the paper"},
  };
};

struct WeightingOptions {
  Weighting kind = Weighting::RadialDistance;
  double curvature_alpha = 1.0;          ///< alpha of eq. 11
  double adaptive_exponent = 2.0 / 3.0;  ///< of the curvature in ErrorAdaptive
  CurvatureSource curvature_source = CurvatureSource::Series;  ///< a formula has its own only
};

inline constexpr NumberOption<double> curvature_alpha_option = {
    "alpha",    "strength alpha of the curvature weighting",
    -3.0,       3.0,
    Ends::Both, "0 ignores curvature, larger gathers more nodes where the surface bends"};
inline constexpr NumberOption<double> adaptive_exponent_option = {
    "adaptive-exponent",
    "exponent of the curvature in the error-adaptive weighting",
    0.0,
    1.5,
    Ends::Both,
    "0 gives equal areas"};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_weighting_options(const WeightingOptions& options);

/// Mean and standard deviation of a field over seeds.
struct FieldDeviation {
  double mean = 0.0;
  double deviation = 0.0;
};

/// The weightings above for a given surface.
///
/// Radius, area element and curvature are tabulated once, so a seed's weight costs a look-up and
/// not a series. Curvature is the root mean square over caps of 0.6 h, h = sqrt(4 pi / N): detail
/// finer than the cells cannot be followed by them and keeps the iteration from settling.
class SurfaceSeedModel : public SeedModel {
 public:
  /// For `node_count` >= 4 seeds. `samples` replace the surface's own curvature when given. Throws
  /// Error(InvalidInput) for options out of range.
  SurfaceSeedModel(const RadialSurface& surface, const WeightingOptions& options, int node_count,
                   const CurvatureSamples* samples, const Execution& execution);

  void weights(const std::vector<Vector3>& seeds, const Execution& execution,
               std::vector<double>& result) const override;
  void radii(const std::vector<Vector3>& seeds, const Execution& execution,
             std::vector<double>& result) const override;
  void surface_densities(const std::vector<Vector3>& seeds, const Execution& execution,
                         std::vector<double>& result) const override;

  /// Wanted number of seeds per steradian, for the start; its integral over the sphere is N. At
  /// most 1 / smallest_cell_share of the mean.
  std::vector<double> number_densities(const std::vector<Vector3>& directions,
                                       const Execution& execution) const;

 private:
  double weight_from(double field, double count, const FieldDeviation& over_seeds) const;
  void look_up_field(const std::vector<Vector3>& seeds, const Execution& execution,
                     std::vector<double>& result) const;
  void look_up(const SphereGrid& grid, const std::vector<Vector3>& seeds,
               const Execution& execution, std::vector<double>& result) const;

  WeightingOptions options_;
  int node_count_;
  std::optional<SphereGrid> radius_;
  std::optional<SphereGrid> area_element_;
  /// Logarithm of 1 / curvature (WSCVT-C) or of the wanted density (ErrorAdaptive).
  std::optional<SphereGrid> field_;
  double area_ = 0.0;      ///< S, of the surface
  double total_ = 0.0;     ///< integral of the wanted density (ErrorAdaptive)
  FieldDeviation wanted_;  ///< of the field over the wanted density (WSCVT-C)
  double offset_ = 0.0;    ///< C in "cell area = 3.118 w + C"
};

}  // namespace wscvt
