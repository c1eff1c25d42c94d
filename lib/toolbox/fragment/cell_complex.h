// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "toolbox/convex/face_cut.h"
#include "toolbox/fragment/fragment_options.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Generator of a cell: the points p whose |p - point|^2 - weight is the smallest of all sites.
/// Without weights these are Voronoi cells, with weights power cells.
struct CellSite {
  Vector3 point = Vector3::Zero();  ///< length
  double weight = 0.0;              ///< length^2
};

/// A solid divided into the cells of sites. Two cells share one face, with the same points: each
/// site is inserted into all cells at once, and a point has one distance to its site, whatever
/// cells it belongs to. Rounding moves points but can neither open a cell nor part two walls.
class CellComplex {
 public:
  /// A planar face of a cell, or the wall between two.
  struct Face {
    FaceEdges edges;                   ///< counter-clockwise seen from outside of `front`
    Vector3 normal = Vector3::Zero();  ///< unit, out of `front`; zero of a face without area
    std::int32_t front = 0;            ///< its cell
    std::int32_t back = -1;            ///< the other cell; -1: a face of the solid's surface
    bool is_wall() const { return back >= 0; }
  };

  /// Divides a closed outward mesh whose edges have two triangles each. A cell may be empty if the
  /// sites have weights. Throws Error(InvalidInput) for a mesh that is not closed and for equal
  /// sites, Error(Cancelled).
  CellComplex(const IndexedMesh& solid, const std::vector<CellSite>& sites,
              const Execution& execution);

  std::size_t cell_count() const { return cells_.size(); }
  const std::vector<Vector3>& points() const { return points_; }
  const std::vector<Face>& faces() const { return faces_; }

  std::vector<double> volumes() const;  ///< of the cells, length^3

  /// What join_pieces moved.
  struct Moved {
    std::size_t pieces = 0;
    double volume = 0.0;  ///< length^3
  };

  /// Makes each cell one piece. A cell of a solid with dents may have several pieces. The largest
  /// stays the cell, and each other joins the neighbour with which it shares the largest wall.
  Moved join_pieces();

 private:
  struct Cell {
    CellSite site;
    std::vector<std::size_t> faces;
    double radius = 0.0;  ///< largest distance of a corner from the site
  };
  /// The insertion of one site.
  struct Insertion;

  double distance(const CellSite& site, std::int32_t point) const {
    return (points_[point] - site.point).squaredNorm() - site.weight;
  }
  void insert(const CellSite& site);
  void cut_face(std::size_t f, Insertion& insertion);
  void list_face(std::size_t f);  ///< in its cells
  void add_face(Face face);
  void renew_faces(std::int32_t number);

  std::vector<Vector3> points_;
  std::vector<double> distances_;  ///< of the points, see CellSite, to their cells' sites
  std::vector<Face> faces_;        ///< without edges: removed
  std::vector<Cell> cells_;
  double on_plane_ = 0.0;  ///< length^2; differences of distances up to this count as none
};

/// Returns about `count` points evenly in a closed mesh: on lines along z, whose distance is the
/// points' own. Deterministic.
std::vector<Vector3> points_in(const IndexedMesh& mesh, double volume, std::size_t count);

/// Places the sites of the fragments' cells by Lloyd's steps on points_in: each site moves to the
/// centroid of its cell (Du, Faber and Gunzburger 1999, "Centroidal Voronoi tessellations", SIAM
/// Rev. 41, 637-676). Works in the grain's principal frame, so the sites turn with the grain. With
/// `volumes` the cells are power cells, whose weights grow where the volume is too small; with
/// `near` the points count as (d + r / 5)^-5, d their distance from the nearest of `near` and r
/// the equivalent radius, which makes the size of a cell proportional to d + r / 5 (Gersho's
/// conjecture). `shape` is of the mesh, which is closed and outward. The result does not depend on
/// the number of threads. Throws Error(NumericalFailure) for a mesh too thin for the points.
std::vector<CellSite> fragment_sites(const IndexedMesh& mesh, const ShapeDescriptors& shape,
                                     const FragmentOptions& options, const Execution& execution);

/// Returns a number that only the edge between two points has, in either direction.
inline std::uint64_t undirected_key(std::int32_t a, std::int32_t b) {
  return a < b ? edge_key(a, b) : edge_key(b, a);
}

/// Divides a planar face, an outer loop and its holes, into triangles of its own points, turned as
/// the face. Each edge of the face belongs to one triangle and each other edge to two, also if
/// rounding makes the loops cross. Cuts off the corner with the best triangle first. `taken` are
/// the edges of all faces (see undirected_key). New edges are none of them and are added, so that
/// two faces of a body never share one.
std::vector<Triangle> face_triangles(const std::vector<Vector3>& points, const FaceEdges& edges,
                                     const Vector3& normal,
                                     std::unordered_set<std::uint64_t>& taken);

}  // namespace wscvt
