// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/grain_surface.h"

#include <filesystem>

#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/surface/shtools_io.h"

namespace wscvt {

void check_grain_surface(const GrainSurface& surface) {
  require_valid(surface.kind);
  for (int axis = 0; axis < 3; ++axis) require_in_range(surface.semi_axes[axis], semi_axis_option);
  require_in_range(surface.polar_exponent, polar_exponent_option);
  require_in_range(surface.azimuthal_exponent, azimuthal_exponent_option);
  require_in_range(surface.coefficient_degree, coefficient_degree_option);
  if (surface.kind != SurfaceKind::Harmonics) return;
  const std::string ending = ending_of(surface.coefficients_file);
  if (ending == ".dat" || ending == ".json" || ending == ".sh") return;
  throw Error(ErrorCode::InvalidInput,
              "The coefficients file is \"" + surface.coefficients_file +
                  "\". Give a file whose name ends in .dat, .sh or .json.");
}

bool holds_map(const GrainSurface& surface) {
  return surface.kind == SurfaceKind::Harmonics &&
         ending_of(surface.coefficients_file) == ".json" &&
         read_harmonic_kind(surface.coefficients_file) == HarmonicKind::Map;
}

std::unique_ptr<const RadialSurface> make_surface(const GrainSurface& surface) {
  check_grain_surface(surface);
  switch (surface.kind) {
    case SurfaceKind::Ellipsoid:
      break;
    case SurfaceKind::Superellipsoid:
      return std::make_unique<Superellipsoid>(surface.semi_axes, surface.polar_exponent,
                                              surface.azimuthal_exponent);
    case SurfaceKind::Harmonics: {
      const std::string& file = surface.coefficients_file;
      const std::string ending = ending_of(file);
      if (ending == ".json") return std::make_unique<HarmonicSurface>(read_harmonics(file));
      return std::make_unique<HarmonicSurface>(
          ending == ".sh" ? read_shtools(file, surface.coefficient_degree)
                          : read_complex_harmonics(file, surface.coefficient_degree));
    }
  }
  return std::make_unique<Ellipsoid>(surface.semi_axes);
}

std::string surface_name(const GrainSurface& surface) {
  return surface.kind == SurfaceKind::Harmonics
             ? std::filesystem::path(surface.coefficients_file).stem().string()
             : capitalised(label_of(surface.kind));
}

}  // namespace wscvt
