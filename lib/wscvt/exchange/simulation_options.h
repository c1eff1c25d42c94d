// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string_view>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

// How a grain is written for a simulation: in which frame and size, and with which grid of
// distances.

/// Frame of the files for a simulation.
enum class Frame {
  Input,      ///< the scan's
  Centred,    ///< the scan's, about the grain's volume centroid
  Principal,  ///< the grain's principal axes, about its volume centroid
};

template <>
struct EnumerationTable<Frame> {
  static constexpr std::string_view key = "frame";
  static constexpr std::string_view subject = "frame of what is written";
  static constexpr Enumerator<Frame> rows[] = {
      {Frame::Input, "input", "the scan's"},
      {Frame::Centred, "centred", "the scan's axes about the grain's centroid"},
      {Frame::Principal, "principal", "the grain's principal axes about its centroid",
       "the grain's principal axes about its centroid, the longest along x, in which its tensor of "
       "inertia is diagonal"},
  };
};

/// In which frame and size a grain is written.
struct FrameOptions {
  Frame frame = Frame::Input;
  /// Factor of all lengths; > 0.
  double scale = 1.0;
  /// Equivalent diameter that the grain is brought to; 0: as it is scaled.
  double size = 0.0;
};

inline constexpr NumberOption<double> scale_option = {
    "scale",
    "factor of lengths",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::NotMinimum,
    "what is written is so many times as large as the scan"};
inline constexpr NumberOption<double> size_option = {
    "size",     "equivalent diameter",
    0.0,        std::numeric_limits<double>::infinity(),
    Ends::Both, "that the grain is written with, in place of a scale; 0 leaves it"};

/// Throws Error(InvalidInput) for options out of range, and for a size beside a scale.
void check_frame_options(const FrameOptions& options);

/// From the scan's coordinates to those that are written.
struct SimulationFrame {
  Vector3 origin = Vector3::Zero();  ///< of the frame, in the scan's coordinates
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();  ///< turns the frame's into the scan's
  double scale = 1.0;  ///< length written / length of the scan

  Vector3 point(const Vector3& p) const { return scale * (axes.conjugate() * (p - origin)); }
  Vector3 direction(const Vector3& v) const { return axes.conjugate() * v; }
};

/// The frame of a grain: of the scan, so that remeshes with any number of nodes share it. Throws as
/// check_frame_options.
SimulationFrame simulation_frame(const ShapeDescriptors& grain, const FrameOptions& options);

/// The mesh, and what a simulation asks of the body, in the frame.
IndexedMesh in_frame(IndexedMesh mesh, const SimulationFrame& frame);
MassProperties in_frame(const MassProperties& mass, const SimulationFrame& frame);

/// Resolution and extent of a grid.
struct GridOptions {
  /// Length, >= 0; 0: a fiftieth of the equivalent diameter, or as much more as a grid of 20
  /// million points takes.
  double spacing = 0.0;
};

inline constexpr NumberOption<double> grid_spacing_option = {
    "sdf-spacing",
    "spacing of the grid of distances",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::Both,
    "in the unit written; 0 takes a fiftieth of the equivalent diameter, or more where that is a "
    "grid of more than 20 million points"};
/// Whose surface the distances of a grid are to.
enum class GridSurface { Scan, Remesh };

template <>
struct EnumerationTable<GridSurface> {
  static constexpr std::string_view key = "sdf-surface";
  static constexpr std::string_view subject = "surface of the grid of distances";
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

/// Throws Error(InvalidInput) for options out of range or at odds with each other.
void check_simulation_options(const SimulationOptions& options);

}  // namespace wscvt
