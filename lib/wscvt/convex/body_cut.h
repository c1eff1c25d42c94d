// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A plane: the points p with normal . p = offset.
struct CutPlane {
  Vector3 normal = Vector3::UnitX();  ///< unit
  double offset = 0.0;
};

struct SolidCut;

/// A solid that planes cut. Its faces are planar, of any number of corners and with holes, so that
/// a cut changes only the faces it crosses. Edges and faces are matched by their numbers, never by
/// coordinates: rounding moves points, and cannot open the solid.
class CutSolid {
 public:
  using Edge = std::array<std::int32_t, 2>;

  /// Of a closed outward mesh. Throws Error(InvalidInput) if a triangle has no neighbour.
  explicit CutSolid(const IndexedMesh& mesh);

  const std::vector<Vector3>& points() const { return points_; }
  double volume() const { return volume_; }  ///< length^3

  /// The connected pieces on both sides of a plane. Points nearer to it than `on_plane` (length)
  /// count as below. Pieces smaller than 1e-12 of the solid are left out. Deterministic.
  SolidCut cut(const CutPlane& plane, double on_plane) const;

  /// Edges that the solid bends inward at, with the outward normals of their two faces.
  struct ReflexEdge {
    Edge edge{};
    Vector3 first;
    Vector3 second;
  };
  std::vector<ReflexEdge> reflex_edges() const;

 private:
  /// Directed edges, counter-clockwise seen from outside; those about a hole clockwise.
  struct Face {
    Vector3 normal = Vector3::Zero();  ///< unit; zero of a face without area
    std::size_t first = 0;             ///< of its edges
    std::size_t last = 0;              ///< one behind the last
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
