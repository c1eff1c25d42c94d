// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/option.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// The formula of a surface.
enum class SurfaceKind { Ellipsoid, Superellipsoid, Harmonics };

template <>
struct EnumerationTable<SurfaceKind> {
  static constexpr std::string_view key = "surface";
  static constexpr std::string_view subject = "surface";
  static constexpr Enumerator<SurfaceKind> rows[] = {
      {SurfaceKind::Ellipsoid, "ellipsoid", "ellipsoid", "of the three semi-axes"},
      {SurfaceKind::Superellipsoid, "superellipsoid", "superellipsoid",
       "of the semi-axes and the two exponents"},
      {SurfaceKind::Harmonics, "harmonics", "harmonics from a file", "of their coefficients"},
  };
};

/// A surface that the user gives exactly, by numbers or a file.
struct GrainSurface {
  SurfaceKind kind = SurfaceKind::Ellipsoid;
  Vector3 semi_axes = Vector3::Ones();  ///< length, 1e-6 to 1e6; not of Harmonics
  double polar_exponent = 1.0;          ///< of a Superellipsoid, 0.1 to 2; no unit
  double azimuthal_exponent = 1.0;      ///< of a Superellipsoid, 0.1 to 2; no unit
  std::string coefficients_file;        ///< of Harmonics: .dat, .sh or .json
  int coefficient_degree = -1;          ///< at which .dat and .sh are cut; -1 to 200, -1: all
};

/// Many programs store meshes in floats. In this range floats also have room for areas and volumes.
inline constexpr NumberOption<double> semi_axis_option = {"semi-axis", "semi-axis", 1e-6, 1e6};
inline constexpr NumberOption<int> coefficient_degree_option = {
    "coefficient-degree", "degree at which the series is cut",  -1, maximum_harmonic_degree,
    Ends::Both,           "of a .dat or .sh file; -1 keeps all"};

/// Throws Error(InvalidInput) if a number is out of range, or if Harmonics has no file or a file
/// with another extension.
void check_grain_surface(const GrainSurface& surface);

/// Returns the name of the surface for labels: Ellipsoid, Superellipsoid or the coefficients' file
/// name without folder and extension.
std::string surface_name(const GrainSurface& surface);

}  // namespace wscvt
