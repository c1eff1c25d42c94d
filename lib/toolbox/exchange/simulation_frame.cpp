// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "toolbox/exchange/simulation_options.h"
#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

void check_frame_options(const FrameOptions& options) {
  require_valid(options.frame);
  require_in_range(options.scale, scale_option);
  require_in_range(options.size, size_option);
  if (options.size > 0.0 && options.scale != 1.0) {
    throw Error(ErrorCode::InvalidInput,
                "There is an equivalent diameter of " + format_typed(options.size) +
                    " and a scale factor of " + format_typed(options.scale) +
                    ", but each of them sets the size. Give one of them.");
  }
}

SimulationFrame simulation_frame(const ShapeDescriptors& grain, const FrameOptions& options) {
  check_frame_options(options);
  SimulationFrame frame;
  frame.scale = options.scale;
  if (options.size > 0.0) frame.scale = options.size / std::cbrt(6.0 * grain.volume / pi);
  if (options.frame != Frame::Input) frame.origin = grain.centroid;
  if (options.frame == Frame::Principal) frame.axes = grain.principal_axes;
  return frame;
}

IndexedMesh in_frame(IndexedMesh mesh, const SimulationFrame& frame) {
  for (Vector3& p : mesh.points) p = frame.point(p);
  return mesh;
}

MassProperties in_frame(const MassProperties& mass, const SimulationFrame& frame) {
  const double s = frame.scale;
  const Eigen::Matrix3d turn = frame.axes.toRotationMatrix();
  MassProperties result;
  result.volume = s * s * s * mass.volume;
  result.centroid = frame.point(mass.centroid);
  result.inertia_tensor = std::pow(s, 5) * (turn.transpose() * mass.inertia_tensor * turn);
  result.principal_moments = std::pow(s, 5) * mass.principal_moments;
  result.principal_axes = frame.axes.conjugate() * mass.principal_axes;
  return result;
}

}  // namespace wscvt
