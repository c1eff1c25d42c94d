// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// What rounding did to a body. Its errors are taken from 5,000 points spread evenly over the mesh
/// and from the mesh's vertices, to the rounded surface.
struct Rounding {
  double radius = 0.0;           ///< of the sphere; length. 0: not rounded
  double radius_percent = 0.0;   ///< of the equivalent radius
  double rms_percent = 0.0;      ///< rms distance, % of the equivalent radius
  double largest_percent = 0.0;  ///< largest distance, % of the equivalent radius
  double volume_percent = 0.0;   ///< of the rounded body against the mesh, to first order; %
};

/// A shape file (.shp) and its error.
struct RockableShape {
  std::string text;
  Rounding rounding;
};

/// Makes a shape of Rockable, which exaDEM reads too: corners, edges and faces of a body rounded by
/// a sphere, with its box, volume and moments. No test runs Rockable, because Debian does not have
/// it; lib/examples/engines/README.md says with which version packings were made by hand.
///
/// The corners are drawn in so that the faces of the rounded body lie in the faces of the mesh. Its
/// edges and corners are rounded off. Engines find a contact only if the overlap is smaller than
/// the spheres, so the radius is the largest of 5, 4, 3, 2, 1, 0.5, 0.2 and 0.1 % of the equivalent
/// radius with an rms distance of at most 0.1 % of it; if none has that, the smallest.
///
/// The shape has the name of the file. `mesh` is closed and outward; it may have several bodies, as
/// convex parts are. Throws Error(InvalidInput) unless `mass` is given in the principal frame about
/// the centroid, because the format has three moments and no axes.
RockableShape rockable_shape(const std::string& path, const IndexedMesh& mesh,
                             const MassProperties& mass);

/// Writes the shape. Returns its rounding. Throws as rockable_shape and write_file do.
Rounding write_rockable_shape(const std::string& path, const IndexedMesh& mesh,
                              const MassProperties& mass);

/// Returns a line for a log about bodies that were rounded; no line without such bodies.
std::vector<std::string> rounding_lines(const std::vector<Rounding>& bodies);

}  // namespace wscvt
