// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "wscvt/base/option.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// Formula of a surface.
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

/// A surface that is known exactly, by what a user says of it.
struct GrainSurface {
  SurfaceKind kind = SurfaceKind::Ellipsoid;
  Vector3 semi_axes = Vector3::Ones();  ///< length, 1e-6 to 1e6; not of Harmonics
  double polar_exponent = 1.0;          ///< of a Superellipsoid, 0.1 to 2; no unit
  double azimuthal_exponent = 1.0;      ///< of a Superellipsoid, 0.1 to 2; no unit
  std::string coefficients_file;        ///< of Harmonics: .dat, .sh or .json
  int coefficient_degree = -1;  ///< of .dat and .sh, which are cut there; -1 to 200, -1: all
};

/// What floats, which many programs' meshes are made of, hold with room for areas and volumes.
inline constexpr NumberOption<double> semi_axis_option = {"semi-axis", "semi-axis", 1e-6, 1e6};
inline constexpr NumberOption<int> coefficient_degree_option = {
    "coefficient-degree", "degree at which the series is cut",  -1, maximum_harmonic_degree,
    Ends::Both,           "of a .dat or .sh file; -1 keeps all"};

/// Throws Error(InvalidInput) for numbers out of range and Harmonics without a file or with one of
/// another ending.
void check_grain_surface(const GrainSurface& surface);

/// Whether the coefficients are those of a harmonic map. Reads their file. Throws as
/// read_harmonics.
bool holds_map(const GrainSurface& surface);

/// The surface, not of a harmonic map; reads the file of its coefficients. Throws Error:
/// InputOutput, InvalidInput.
std::unique_ptr<const RadialSurface> make_surface(const GrainSurface& surface);

/// Name of the surface for labels: Ellipsoid, Superellipsoid or the coefficients' file without
/// folder and ending.
std::string surface_name(const GrainSurface& surface);

}  // namespace wscvt
