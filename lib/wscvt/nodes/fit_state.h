// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/edit_mesh.h"
#include "wscvt/surface/triangle_hash.h"
#include "wscvt/surface/triangle_place.h"

namespace wscvt {

/// All settings of the fit that depend on the wanted mean edge ratio, from even triangles to a
/// close surface. Found by measuring six grains at 1000 nodes.
struct FitDial {
  double ratio = 0.0;  ///< wanted mean ratio of longest to shortest edge
  int samples_a_node = 0;
  int rounds = 0;
  int late_rounds = 0;            ///< the last rounds, which keep the least angle
  double least_angle = 0.0;       ///< degrees, kept by the late rounds
  double early_angle = 0.0;       ///< kept by the earlier rounds
  double start_evenness = 0.0;    ///< evenness that the first rounds lead to
  double lead_rounds = 0.0;       ///< number of rounds that lead there
  int heats = 1;                  ///< number of such leads, one after the other
  double first_steering = 0.0;    ///< round from which the ratio controls the evenness
  double ratio_slope = 0.0;       ///< fall of the ratio as the evenness grows by a factor e
  double plain_springs = 1.0;     ///< fraction of the springs that pull edges to their rest lengths
  double triangle_springs = 0.0;  ///< of springs between a triangle's edges
  double spring_stiffness = 0.0;  ///< of an edge at full evenness, in weights of a node's samples
  double ring_stiffness = 0.0;    ///< of a node towards the middle of its ring, in the same unit
  double local_share = 0.0;       ///< weight of the surrounding mean edge in a rest length, against
                                  ///< the mesh's mean edge
  double rim_reach = 0.0;         ///< of a rim's nodes beyond their samples, in mean edges
  double damping = 0.0;           ///< of steps
  bool polishes = false;          ///< whether single nodes are moved after a round
};

/// `ratio` in [least_edge_ratio, most_edge_ratio], which is not checked. `weighted`: whether a
/// density is wanted.
FitDial fit_dial(double ratio, bool weighted = false);

/// A point of the scan to which a mesh is fitted, and its nearest point on the mesh.
struct FitSample {
  Vector3 point;
  Vector3 normal;         ///< the scan's, outward, unit
  double spacing = 1.0;   ///< wanted distance of nodes here / distance of even nodes
  std::int32_t face = 0;  ///< the triangle with the nearest point
  TrianglePlace place;    ///< of that point
};

/// Returns `count` points of the scan, evenly distributed: one in each of `count` equal areas, in
/// the order of its faces. Normals are interpolated between the vertices, which smooths the noise
/// of a scan. `normals`: at the vertices, outward, unit; empty: those of vertex_normals. If a face
/// is as large as the cell of a node, its own normal is used instead; `cell`
/// is the area per node. The sample's `face` is the nearest vertex of its face; the caller replaces
/// it. Deterministic.
std::vector<FitSample> draw_fit_samples(const IndexedMesh& scan,
                                        const std::vector<Vector3>& normals, std::size_t count,
                                        double cell);

/// A sample at the root mean square distance counts 1 + this, a more distant sample up to 1 + 9
/// times this, so that a cone's tip is not lost to the mean.
inline constexpr double robust_weight = 0.3;
inline constexpr double most_robust = 9.0;
/// A face agrees with the scan if its normal is within 60 degrees of its samples'.
inline constexpr double face_agreement = 0.5;

/// Settings of one round of the fit.
struct FitRound {
  double evenness = 1.0;         ///< weight of springs and rings
  double valence = 0.0;          ///< weight of (degree - 6)^2, in squares of the mean edge
  double price = 0.0;            ///< of a triangle with an angle of 0
  double goal_cosine = 1.0;      ///< triangles sharper than this have a cost
  double sharpness_limit = 1.0;  ///< no step or flip makes a triangle sharper
  double early_sharpness = 1.0;  ///< the same limit in the rounds before the last
  double least_angle = 0.0;      ///< degrees, the limit in the last rounds
  bool late = false;             ///< one of the last rounds, which repair sharp triangles
  bool checks_pairs = true;      ///< whether the move of all nodes looks for intersections
};

/// A mesh that is fitted to samples of a scan. Functions that change the mesh also update `of`,
/// `sample_normals`, `hash` and the samples' places.
struct FitState {
  EditMesh mesh;
  std::vector<FitSample> samples;
  FitDial dial;
  FitRound round;
  std::vector<std::vector<std::int32_t>> of;  ///< samples of each triangle
  std::vector<Vector3> sample_normals;        ///< sum of their normals
  std::vector<double> spacing;                ///< wanted at each node; empty: 1
  std::vector<double> ring_edges;             ///< mean edge about each node, at the last step
  /// Mean normal of the samples about each node at the last list_samples, weighted by nearness;
  /// zero without samples.
  std::vector<Vector3> about;
  double edge = 0.0;         ///< mean edge
  double mean_square = 0.0;  ///< of the samples' distances
  TriangleHash hash;
  bool had_pairs = false;  ///< whether any triangles intersected at the last look

  /// `near`: a node near each sample, on its sheet of the surface. From there, each sample is
  /// placed on the nearest triangle that faces about as it does, because a thin body has another
  /// sheet behind.
  FitState(EditMesh start, std::vector<FitSample> scan_samples,
           const std::vector<std::int32_t>& near, const FitDial& fit_dial,
           const Execution& execution);

  /// Returns 1 / (samples per node): sums over samples times this are sums over nodes.
  double share() const {
    return static_cast<double>(mesh.points.size()) / static_cast<double>(samples.size());
  }
  double spring() const { return dial.spring_stiffness * round.evenness; }
  double ring() const { return dial.ring_stiffness * round.evenness; }
  double ring_edge(std::int32_t v) const { return ring_edges.empty() ? edge : ring_edges[v]; }
  double node_spacing(std::int32_t v) const { return spacing.empty() ? 1.0 : spacing[v]; }
  /// Returns the weight of a neighbour in the middle of a node's ring: inverse to their wanted
  /// distance, so that the middle lies right between denser and sparser sides.
  double ring_weight(std::int32_t v, std::int32_t w) const {
    return spacing.empty() ? 1.0 : 2.0 / (spacing[v] + spacing[w]);
  }
  /// Returns the weight of a sample by its distance.
  double weight(double squared_distance) const {
    return 1.0 + robust_weight * std::min(squared_distance / mean_square, most_robust);
  }
  /// Returns the cost of a sample: its squared distance, times 1 plus half of the extra weight.
  double error(double squared_distance) const;
  /// Returns how much a triangle is sharper than the goal, from 0 to 1 for an angle of 0;
  /// optionally the gradient by its corners.
  double excess(const Vector3& a, const Vector3& b, const Vector3& c,
                std::array<Vector3, 3>* gradient = nullptr) const;
  double excess(std::size_t t) const;

  /// Walks every sample to the nearest triangle of its sheet, and updates the mean square and the
  /// lists. A sample that comes to a triangle which faces against it goes to the nearest one that
  /// does not.
  void place_samples(const Execution& execution);
  /// Rebuilds `of`, `sample_normals` and `about`, and `spacing` if any sample has another than 1.
  void list_samples();
  /// Assigns samples to the nearest of some triangles; they must not lie in others. `places`: for
  /// the triangles about a node, in order, the one that each sample is probably in.
  void deal(const std::vector<std::int32_t>& pool, const std::vector<std::int32_t>& triangles,
            const std::vector<std::int32_t>& places = {});
  /// Returns the samples of some triangles.
  std::vector<std::int32_t> pool(const std::vector<std::int32_t>& triangles) const;
  /// Computes `spacing` from the samples.
  void read_spacing();
  /// Rebuilds the hash from the current triangles.
  void build_hash() { hash.build(mesh, edge > 0.0 ? edge : mean_edge_length(mesh)); }

  Vector3 unit_normal(std::size_t t) const;
  std::vector<Vector3> unit_normals() const;  ///< of all triangles
};

/// Returns the unit normal of a triangle; zero if it has no area.
Vector3 unit_normal_of(const Vector3& a, const Vector3& b, const Vector3& c);

/// A node's ring: the triangles and neighbours around it, counter-clockwise. Neighbours j and j + 1
/// form triangle j with the node.
struct NodeRing {
  std::vector<std::int32_t> nodes;
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> beyond;  ///< triangle across the edge opposite to the node
};
NodeRing ring_of(const EditMesh& mesh, std::int32_t v);

/// Returns the smallest cosine between normals of neighbours in a fan: its triangles about `centre`
/// over the `ring`, with each other and with the triangles beyond. An open fan has no triangle
/// between the last and the first.
double sharpest_turn(const FitState& state, const Vector3& centre, const std::vector<Vector3>& ring,
                     const std::vector<std::int32_t>& beyond, bool closed);

/// Edges with a larger angle between their normals, 120 degrees, are folded: allowed only if the
/// scan is as sharp.
inline constexpr double folded = -0.5;

/// The triangles about one node, in the mesh or wanted there, with the samples they would have.
/// Used to compute the node's cost at a position, and to find a better position.
struct FitFan : NodeRing {
  std::int32_t node = -1;  ///< of the mesh; -1 if the mesh does not have it yet
  Vector3 centre = Vector3::Zero();
  std::vector<Vector3> ring;          ///< positions of `nodes`
  std::vector<std::int32_t> samples;  ///< in the triangles of the fan
  std::vector<std::int32_t> places;   ///< triangle of each sample at the last look-up, or -1
  Vector3 looked_at = Vector3::Constant(1e300);  ///< position of the node at the last look-up
  std::vector<Vector3> normals;                  ///< sum of the samples' in each triangle there
  std::vector<int> counts;                       ///< samples in each triangle there
  double nearest = 1e300;                        ///< squared distance of the nearest sample there
  double rest = 0.0;                             ///< length of the spokes
  double spring = 0.0;                           ///< their stiffness
  double pull = 0.0;                             ///< of the node towards the middle of the ring
};

/// The equations for a fan's step, before they are solved.
struct FanEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Vector3 right = Vector3::Zero();
  /// Returns the damped step, at most `most` long.
  Vector3 step(double most) const;
};

/// Returns the fan's cost with its node at `at`: errors of samples, small angles, springs;
/// optionally with the equations of a step from there.
double fan_energy(const FitState& state, FitFan& fan, const Vector3& at,
                  FanEquations* equations = nullptr);

/// Returns whether every triangle of the fan faces as its samples do and keeps the angle of the
/// round, and the node has a sample near. A triangle with few samples is compared with the samples
/// about its corners (`state.about`).
bool fan_is_fine(const FitState& state, FitFan& fan, const Vector3& at);

/// Returns the cosine of the fan's smallest angle with its node at `at`.
double fan_sharpness(const FitFan& fan, const Vector3& at);

/// Returns the fan of a node in the mesh.
FitFan fan_of(const FitState& state, std::int32_t v);

}  // namespace wscvt
