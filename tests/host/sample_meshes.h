// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <functional>
#include <string>

#include "wscvt/base/mesh.h"

namespace wscvt::host_test {

/// Closed outward mesh of x(u) = map(u) over a latitude-longitude net of the unit sphere.
IndexedMesh mapped_sphere(int rings, int segments,
                          const std::function<Vector3(const Vector3&)>& map);

/// A smooth bumpy ellipsoid of about 2,000 vertices, star-shaped, equal-volume radius near 1.
IndexedMesh grain();

IndexedMesh sphere();                                   ///< radius 1, about 2,000 vertices
IndexedMesh without_a_patch(std::size_t faces = 1200);  ///< grain() without its last faces
IndexedMesh two_grains();                               ///< two equal bodies side by side
IndexedMesh with_non_manifold_edge();   ///< grain() and a small body that share one edge
IndexedMesh with_coordinate(double x);  ///< grain() with one coordinate set to x
IndexedMesh flat_grain();               ///< grain() pressed into a plane: no volume
IndexedMesh band_with_one_side();       ///< a Moebius band about a circle of radius 2
IndexedMesh bent_grain();               ///< a banana whose rays from the centroid meet it again

IndexedMesh scaled(IndexedMesh mesh, double factor);
IndexedMesh moved(IndexedMesh mesh, const Vector3& by);

/// Writes a mesh as it is, whatever is wrong with it, as ASCII PLY.
void write_as_it_is(const IndexedMesh& mesh, const QString& path);

/// A sample from meshes/, by file name.
QString sample(const QString& name);

}  // namespace wscvt::host_test
