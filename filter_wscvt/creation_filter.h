// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "node_parameters.h"
#include "parameters.h"
#include "wscvt/remesh.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt::filter {

/// The menu text. Saved scripts refer to it: it never changes.
std::string creation_name();

std::string creation_help();

ParameterList creation_parameters();

/// Which surface is made into a mesh.
enum class GrainSurface { Ellipsoid, Superellipsoid, Harmonics };

}  // namespace wscvt::filter

template <>
struct wscvt::EnumerationTable<wscvt::filter::GrainSurface> {
  using Surface = wscvt::filter::GrainSurface;
  static constexpr std::string_view key = "surface";
  static constexpr std::string_view subject = "surface";
  static constexpr Enumerator<Surface> rows[] = {
      {Surface::Ellipsoid, "ellipsoid", "ellipsoid", "of the three semi-axes"},
      {Surface::Superellipsoid, "superellipsoid", "superellipsoid",
       "of the semi-axes and the two exponents"},
      {Surface::Harmonics, "harmonics", "harmonics from a file", "of the coefficients in it"},
  };
};

namespace wscvt::filter {

struct CreationSettings {
  GrainSurface surface = GrainSurface::Ellipsoid;
  Vector3 semi_axes = Vector3::Ones();  ///< length
  double polar_exponent = 1.0;
  double azimuthal_exponent = 1.0;
  std::string coefficients_file;
  int coefficient_degree = -1;  ///< the text form is cut there; -1: all
  RemeshOptions options;
  ResultSettings result;
};

/// Throws Error(InvalidInput) for values that do not fit and file names with other extensions.
CreationSettings read_creation_settings(const ParameterValues& values);

/// Whether the coefficients are those of a harmonic map. Reads their file. Throws the same.
bool holds_map(const CreationSettings& settings);

/// The surface, not of a harmonic map; reads the file of its coefficients. Throws Error:
/// InputOutput, InvalidInput.
std::unique_ptr<const RadialSurface> make_surface(const CreationSettings& settings);

/// Name of the surface for labels: Ellipsoid, Superellipsoid or the coefficients' file.
std::string surface_name(const CreationSettings& settings);

}  // namespace wscvt::filter
