// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/edit_mesh.h"
#include "wscvt/nodes/fit_dial.h"
#include "wscvt/nodes/fit_samples.h"
#include "wscvt/nodes/triangle_hash.h"

namespace wscvt {

/// Stiffness of an edge as a spring at full evenness, in shares of a node's samples.
inline constexpr double spring_stiffness = 0.04;
/// Stiffness of a node towards the middle of its ring, the same.
inline constexpr double ring_stiffness = 0.13;
/// A sample at the root mean square distance counts 1 + this, one farther off more, up to
/// 1 + 9 times this: a cone's tip is not given up for the mean.
inline constexpr double robust_weight = 0.3;
inline constexpr double most_robust = 9.0;
/// A rest length is this share the mean edge about, else the mean edge of the mesh: local means
/// alone would let density drift, one mean for all would cost distance. Where a density is wanted
/// the fit may not even it out, and the wanted length counts for more.
inline constexpr double even_local_share = 0.9;
inline constexpr double weighted_local_share = 0.5;
/// A face looks as the scan does where its normal is within 60 degrees of its samples'.
inline constexpr double face_agreement = 0.5;

/// What holds in one round of the fit.
struct FitRound {
  double evenness = 1.0;         ///< weight of springs and rings
  double valence = 0.0;          ///< price of a degree's square off 6, in squares of the mean edge
  double price = 0.0;            ///< of a triangle of no angle
  double goal_cosine = 1.0;      ///< triangles sharper than this pay
  double sharpness_limit = 1.0;  ///< no step or flip makes a triangle sharper
  double early_sharpness = 1.0;  ///< the same limit in the rounds before the last
  double least_angle = 0.0;      ///< degrees, the same limit in the last rounds
  bool late = false;             ///< one of the last rounds, which make good what is sharp
};

/// A mesh that is fitted to samples of a scan. What changes the mesh keeps `of`, `sample_normals`,
/// `hash` and the samples' places in step.
struct FitState {
  EditMesh mesh;
  std::vector<FitSample> samples;
  FitDial dial;
  FitRound round;
  std::vector<std::vector<std::int32_t>> of;  ///< samples of each triangle
  std::vector<Vector3> sample_normals;        ///< sum of their normals
  std::vector<double> spacing;                ///< of nodes wanted at each node; empty: 1
  std::vector<double> ring_edges;             ///< mean edge about each node, as of the last step
  double edge = 0.0;                          ///< mean edge
  double mean_square = 0.0;                   ///< of the samples' distances
  TriangleHash hash;

  /// `near`: a node near each sample, on its sheet of the surface. From there on each is placed on
  /// the nearest triangle that looks as it does, or nearly so: a thin body has another sheet
  /// behind.
  FitState(EditMesh start, std::vector<FitSample> scan_samples,
           const std::vector<std::int32_t>& near, const FitDial& fit_dial,
           const Execution& execution);

  /// A node's samples, as a weight: sums over samples times this are sums over nodes.
  double share() const {
    return static_cast<double>(mesh.points.size()) / static_cast<double>(samples.size());
  }
  double spring() const { return spring_stiffness * round.evenness; }
  double ring() const { return ring_stiffness * round.evenness; }
  double ring_edge(std::int32_t v) const { return ring_edges.empty() ? edge : ring_edges[v]; }
  double node_spacing(std::int32_t v) const { return spacing.empty() ? 1.0 : spacing[v]; }
  double local_share() const { return spacing.empty() ? even_local_share : weighted_local_share; }
  /// Weight of a neighbour in the middle of a node's ring: inverse to their wanted distance, so
  /// that the middle is where the node stands between denser and sparser sides.
  double ring_weight(std::int32_t v, std::int32_t w) const {
    return spacing.empty() ? 1.0 : 2.0 / (spacing[v] + spacing[w]);
  }
  /// Weight of a sample by its distance.
  double weight(double squared_distance) const;
  /// What a sample costs: its squared distance, times one and a half weights beyond the first.
  double error(double squared_distance) const;
  /// How far a triangle is sharper than the goal: 0, or up to 1 for no angle; optionally with the
  /// gradient by its corners.
  double excess(const Vector3& a, const Vector3& b, const Vector3& c,
                std::array<Vector3, 3>* gradient = nullptr) const;
  double excess(std::size_t t) const;

  /// Walks every sample to the nearest triangle, and counts the mean square.
  void place_samples(const Execution& execution);
  /// Makes `of` and `sample_normals` anew.
  void list_samples();
  /// Deals samples anew to some triangles, which shall be all that they may lie in.
  void deal(const std::vector<std::int32_t>& pool, const std::vector<std::int32_t>& triangles);
  /// The samples of some triangles, taken from them.
  std::vector<std::int32_t> pool(const std::vector<std::int32_t>& triangles) const;
  /// Mean of the normals of the samples about each node, each by its nearness; zero without any.
  std::vector<Vector3> node_normals() const;
  /// Reads `spacing` off the samples, if one of them says other than 1.
  void read_spacing();
  /// Fills the hash with the triangles as they are.
  void build_hash() { hash.build(mesh, edge > 0.0 ? edge : mean_edge_length(mesh)); }

  Vector3 unit_normal(std::size_t t) const;
};

/// Unit normal of a triangle; zero without an area.
Vector3 unit_normal_of(const Vector3& a, const Vector3& b, const Vector3& c);

/// A node's ring: triangles and neighbours about it, counter-clockwise; neighbours j and j + 1 make
/// triangle j with the node.
struct NodeRing {
  std::vector<std::int32_t> nodes;
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> beyond;  ///< triangle across the edge opposite to the node
};
NodeRing ring_of(const EditMesh& mesh, std::int32_t v);

/// The least cosine between the normals of neighbours in a fan: its triangles about `centre`, over
/// the `ring`, with each other and with those beyond. An open fan has no triangle between the last
/// and the first.
double sharpest_turn(const FitState& state, const Vector3& centre, const std::vector<Vector3>& ring,
                     const std::vector<std::int32_t>& beyond, bool closed);

/// An edge turned further than this, 120 degrees, is folded: allowed only where the scan is as
/// sharp.
inline constexpr double folded = -0.5;

}  // namespace wscvt
