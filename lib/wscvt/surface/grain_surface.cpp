// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/grain_surface.h"

#include <filesystem>

#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/surface/quadric_surface.h"

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
  refuse("The coefficients file is \"" + surface.coefficients_file +
         "\". Give a file whose name ends in .dat, .sh or .json.");
}

std::string surface_name(const GrainSurface& surface) {
  return surface.kind == SurfaceKind::Harmonics
             ? std::filesystem::path(surface.coefficients_file).stem().string()
             : capitalised(label_of(surface.kind));
}

}  // namespace wscvt
