// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string_view>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

// Options of files for a simulation: frame, size and distance grid.

/// Frame of the files for a simulation.
enum class Frame {
  Input,      ///< the scan's
  Centred,    ///< the scan's, about the grain's volume centroid
  Principal,  ///< the grain's principal axes, about its volume centroid
};

template <>
struct EnumerationTable<Frame> {
  static constexpr std::string_view key = "frame";
  static constexpr std::string_view subject = "frame of the output";
  static constexpr Enumerator<Frame> rows[] = {
      {Frame::Input, "input", "the scan's"},
      {Frame::Centred, "centred", "the scan's axes about the grain's centroid"},
      {Frame::Principal, "principal", "the grain's principal axes about its centroid",
       "the grain's principal axes about its centroid, the longest along x; the inertia tensor is "
       "diagonal"},
  };
};

/// Frame and size in which a grain is written.
struct FrameOptions {
  Frame frame = Frame::Input;
  /// Factor of all lengths; > 0.
  double scale = 1.0;
  /// Equivalent diameter of the written grain; 0: `scale` sets the size.
  double size = 0.0;
};

inline constexpr NumberOption<double> scale_option = {"scale",
                                                      "scale factor",
                                                      0.0,
                                                      std::numeric_limits<double>::infinity(),
                                                      Ends::NotMinimum,
                                                      "multiplies all lengths of the output"};
inline constexpr NumberOption<double> size_option = {
    "size",     "equivalent diameter",
    0.0,        std::numeric_limits<double>::infinity(),
    Ends::Both, "of the output, instead of a scale factor; 0: not used"};

/// Throws Error(InvalidInput) for options out of range, and for a size together with a scale.
void check_frame_options(const FrameOptions& options);

/// Transformation from the scan's coordinates to the written coordinates.
struct SimulationFrame {
  Vector3 origin = Vector3::Zero();  ///< of the frame, in the scan's coordinates
  Eigen::Quaterniond axes =
      Eigen::Quaterniond::Identity();  ///< rotates the frame's axes into the scan's
  double scale = 1.0;                  ///< length written / length of the scan

  Vector3 point(const Vector3& p) const { return scale * (axes.conjugate() * (p - origin)); }
};

/// Returns the frame of a grain. It is computed from the scan, so that remeshes with any number of
/// nodes share it. Throws as check_frame_options.
SimulationFrame simulation_frame(const ShapeDescriptors& grain, const FrameOptions& options);

/// Returns the mesh or the mass properties in the frame.
IndexedMesh in_frame(IndexedMesh mesh, const SimulationFrame& frame);
MassProperties in_frame(const MassProperties& mass, const SimulationFrame& frame);

/// Resolution of a distance grid.
struct GridOptions {
  /// Length, >= 0; 0: a fiftieth of the equivalent diameter, or more to keep the grid to 20 million
  /// points.
  double spacing = 0.0;
};

inline constexpr NumberOption<double> grid_spacing_option = {
    "sdf-spacing",
    "spacing of the distance grid",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::Both,
    "in the unit of the output. 0: a fiftieth of the equivalent diameter, or more to keep the grid "
    "to 20 million points"};
/// Surface to which the distances of a grid are measured. The program's grids are of the scan.
enum class GridSurface { Scan, Remesh };

template <>
struct EnumerationTable<GridSurface> {
  static constexpr std::string_view key = "surface";
  static constexpr std::string_view subject = "surface of the distance grid";
  static constexpr Enumerator<GridSurface> rows[] = {
      {GridSurface::Scan, "scan", "the repaired scan"},
      {GridSurface::Remesh, "remesh", "the remesh"},
  };
};

/// Options of a remesh and its files for a simulation.
struct SimulationOptions {
  FrameOptions frame;
  GridSurface surface = GridSurface::Scan;
  GridOptions grid;
};

/// Throws Error(InvalidInput) for options out of range or in conflict.
void check_simulation_options(const SimulationOptions& options);

}  // namespace wscvt
