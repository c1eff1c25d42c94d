// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "toolbox/convex/face_cut.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A plane: the points p with normal . p = offset.
struct CutPlane {
  Vector3 normal = Vector3::UnitX();  ///< unit
  double offset = 0.0;
};

struct SolidCut;

/// A solid that planes cut. Its faces are planar, with any number of corners and with holes, so a
/// cut changes only the faces it crosses. Edges and faces are matched by numbers, never by
/// coordinates, so rounding moves points but cannot open the solid.
class CutSolid {
 public:
  using Edge = FaceEdge;

  /// Reads a closed outward mesh. Throws Error(InvalidInput) if a triangle has no neighbour.
  explicit CutSolid(const IndexedMesh& mesh);

  const std::vector<Vector3>& points() const { return points_; }
  double volume() const { return volume_; }  ///< length^3

  /// Returns the connected pieces on both sides of a plane. Points nearer to it than `on_plane`
  /// (length) count as below. Omits pieces smaller than 1e-12 of the solid. Deterministic.
  SolidCut cut(const CutPlane& plane, double on_plane) const;

  /// An edge at which the solid bends inward, with the outward normals of its two faces.
  struct ReflexEdge {
    Edge edge{};
    Vector3 first;
    Vector3 second;
  };
  std::vector<ReflexEdge> reflex_edges() const;

 private:
  /// Directed edges, counter-clockwise seen from outside; clockwise about a hole.
  struct Face {
    Vector3 normal = Vector3::Zero();  ///< unit; zero of a face without area
    std::size_t first = 0;             ///< of its edges
    std::size_t last = 0;              ///< one after the last
    bool is_cap = false;               ///< may have more than one loop
  };
  struct Side;

  CutSolid() = default;
  static void append_pieces(const std::vector<Vector3>& points, const Side& side,
                            double least_volume, std::vector<CutSolid>& pieces);

  std::vector<Vector3> points_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  double volume_ = 0.0;
};

/// Pieces above and below a plane, the largest first.
struct SolidCut {
  std::vector<CutSolid> above;
  std::vector<CutSolid> below;
};

}  // namespace wscvt
