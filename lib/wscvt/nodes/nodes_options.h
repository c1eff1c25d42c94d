// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "wscvt/base/option.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

// How the nodes are put in their places, how many they are, and how that went.

/// How nodes are brought nearer to the scan, after Hoppe et al. 1993, "Mesh optimization": moves,
/// flips and relocations (see node_refinement.h).
struct RefinementOptions {
  int rounds = 0;  ///< at most so many, up to 1000; 0: nothing is done
  /// No triangle is left a smaller one by more than a thousandth of a degree, but for a few that
  /// guards hold (see node_refinement.h), of which a warning tells; degrees, 0 to 40. Rms of
  /// meshes/sand_7228.ply with 1000 error-adaptive nodes at 15.5, 25, 30, 35, 40: .164, .171, .177,
  /// .188, .210 % of R, at mean edge ratios of 1.86, 1.69, 1.60, 1.49, 1.40; the collapse of
  /// Lindstrom and Turk has .192, and angles down to 0.
  double smallest_angle = 30.0;
  double tolerance = 2e-3;  ///< stop when a round gains less than this share, in [0, 1)
};

inline constexpr NumberOption<int> refinement_rounds_option = {
    "refine",   "number of refinement rounds",
    0,          1000,
    Ends::Both, "moving nodes and flipping edges towards the scan, for least squares and contact"};
inline constexpr NumberOption<double> refinement_angle_option = {
    "refine-angle", "smallest angle that the refinement leaves, in degrees", 0.0, 40.0};
inline constexpr NumberOption<double> refinement_tolerance_option = {
    "refine-tolerance", "share below which the gain of a refinement round is the last", 0.0, 1.0,
    Ends::NotMaximum};

/// One line of the refinement's history.
struct RefinementStep {
  /// The distance after the round, see refine_nodes; length.
  double distance = 0.0;
  int moves = 0;        ///< nodes moved
  int flips = 0;        ///< edges flipped
  int relocations = 0;  ///< nodes taken from where they help least to where they help most
};

/// How a refinement went.
struct RefinementReport {
  /// The last round's moves, flips and relocations lowered the square root of the sum that is
  /// lowered by less than the tolerance, as a share of it.
  bool converged = false;
  double start_distance = 0.0;  ///< as RefinementStep::distance, before the first round; length
  std::vector<RefinementStep> history;
};

/// Throws Error(InvalidInput) for options out of range.
void check_refinement_options(const RefinementOptions& options);

/// Where the nodes are put along their directions.
enum class NodePlacement {
  Series,        ///< on the fitted series
  Scan,          ///< on the scan itself, by rays
  LeastSquares,  ///< off it, so that the triangles fit the scan best and the volume is the scan's
  Contact,       ///< off it, so that contacts by the deepest node are where the scan's own would be
};

template <>
struct EnumerationTable<NodePlacement> {
  static constexpr std::string_view key = "placement";
  static constexpr std::string_view subject = "placement of the nodes";
  static constexpr Enumerator<NodePlacement> rows[] = {
      {NodePlacement::Series, "series", "series",
       "on the fitted surface, which is free of scanning noise"},
      {NodePlacement::Scan, "scan", "scan",
       "on the scan itself, with its noise, where rays from the centroid leave it"},
      {NodePlacement::LeastSquares, "least-squares", "least squares (volume exact)",
       "off the surface, so that the triangles fit the scan best and enclose exactly its volume"},
      {NodePlacement::Contact, "contact", "contact of the deepest node",
       "off the surface, so that contacts which the deepest node decides come neither late nor "
       "early in the mean; the volume is not the scan's"},
  };
};

/// How the nodes are placed.
struct PlacementOptions {
  NodePlacement kind = NodePlacement::LeastSquares;
  RefinementOptions refinement;  ///< of the nodes towards the scan, on any map; needs is_fitted
  /// Of the balls that nodes placed by Contact are fitted to touch, equivalent radii, in (0, 100];
  /// see fit_to_contacts. At these the mean error of a first contact is least, measured in
  /// tests/study: 0.4 for nodes against the surface of another grain, 1.3 where the nodes of both
  /// are looked at and the deepest decides, 5 for flat walls.
  double contact_radius = 0.4;
  /// Refuse a result in which triangles meet, which a radial one never has.
  bool refuse_self_intersections = false;
};

inline constexpr NumberOption<double> contact_radius_option = {
    "contact-radius",
    "radius of the balls that contact nodes are fitted to",
    0.0,
    100.0,
    Ends::NotMinimum,
    "in equivalent radii; 0.4 for nodes against another grain's surface, 1.3 where the nodes of "
    "both "
    "grains are looked at, 5 for flat walls"};
inline constexpr FlagOption refuse_self_intersections_option = {
    "refuse-self-intersections", "refusal of self-intersections",
    "(triangles that meet) in a remesh, instead of a warning"};

/// Whether nodes leave the surface to fit it.
inline bool is_fitted(NodePlacement placement) {
  return placement == NodePlacement::LeastSquares || placement == NodePlacement::Contact;
}

/// Throws Error(InvalidInput) for options out of range, and for a refinement of nodes that are to
/// stay on a surface.
void check_placement_options(const PlacementOptions& options);

/// By what a remesh's error is told; each in % of the scan's own.
enum class ErrorMeasure {
  Volume,      ///< of the volume
  Area,        ///< of the area
  Sphericity,  ///< of Wadell's sphericity
  Inertia,     ///< inertia_error_percent
  Distance,    ///< two-sided rms distance, in % of the equivalent radius
};

template <>
struct EnumerationTable<ErrorMeasure> {
  static constexpr std::string_view key = "target-measure";
  static constexpr std::string_view subject = "measure of the error target";
  static constexpr Enumerator<ErrorMeasure> rows[] = {
      {ErrorMeasure::Volume, "volume", "volume"},
      {ErrorMeasure::Area, "area", "area"},
      {ErrorMeasure::Sphericity, "sphericity", "sphericity", "Wadell's"},
      {ErrorMeasure::Inertia, "inertia", "inertia", "the inertia tensor"},
      {ErrorMeasure::Distance, "distance", "RMS distance",
       "two-sided, in % of the equivalent radius"},
  };
};

/// Node count by error: the smallest N that meets it is looked for (see smallest_node_count).
struct ErrorTarget {
  ErrorMeasure measure = ErrorMeasure::Distance;
  double percent = 0.0;            ///< 0 to 100; 0: none, N is the options' node_count
  int largest_node_count = 20000;  ///< the search goes no further; 4 to 1000000
};

inline constexpr NumberOption<double> error_target_option = {
    "target",   "error target in %",
    0.0,        100.0,
    Ends::Both, "the smallest number of nodes with at most this error is looked for; 0: none"};
inline constexpr NumberOption<int> largest_node_count_option = {"largest",
                                                                "largest number of nodes to try",
                                                                node_count_option.minimum,
                                                                node_count_option.maximum,
                                                                Ends::Both,
                                                                "with an error target"};

/// One number of nodes that was tried.
struct NodeCountTrial {
  int node_count = 0;
  double error = 0.0;  ///< >= 0, any unit
};

/// What a search found.
struct NodeCountSearch {
  bool met = false;  ///< the target was reached within the limits
  int node_count =
      0;  ///< smallest count found to meet the target; the largest allowed if none does
  std::vector<NodeCountTrial> trials;  ///< in the order made
};

/// How nodes were fitted along their normals.
struct NormalFitReport {
  std::size_t samples = 0;  ///< of the scan, that the triangles were fitted to; 0: no such fit
  int held_back = 0;        ///< nodes that went less than the whole step, for a guard
  double offset = 0.0;      ///< along all normals, that made the volume exact; length
};

/// How edges were evened (edge_evening.h).
struct EdgeEveningReport {
  /// Standard deviation of the edges' length / wanted length; 0 before: edges were not evened.
  double deviation_before = 0.0;
  double deviation_after = 0.0;
  int held_back = 0;  ///< nodes that went less than the whole way, for triangles that would meet
};

/// What mending of triangles did (triangle_mending.h).
struct TriangleMendingReport {
  int flips = 0;        ///< of edges
  int moves = 0;        ///< of nodes along the surface
  int relocations = 0;  ///< of nodes, from where they crowd to where they are sparse
  int left = 0;         ///< triangles that still have a smaller angle than asked for
};

/// What became of nodes on a mapped surface; of those on the radial map, mending and fit alone.
struct SpaceNodesReport {
  std::size_t self_intersections = 0;  ///< pairs of triangles of the mesh that meet, exactly
  int repairs = 0;                     ///< relaxations with more nodes where triangles had met
  /// Above 0: the nodes stand on a map of their own, in which angles count so much beside areas
  /// (SphereMapOptions), because they had jammed on the grain's.
  double angle_weight = 0.0;
  int relocated_seeds = 0;   ///< from limbs in which they crowded to others, before a relaxation
  double volume_loss = 0.0;  ///< of the nodes on the surface, as a share of the grain's volume
  /// Above 0: the nodes asked for are too few for the shape (they lose more than a quarter of its
  /// volume, or their triangles meet), and so many would do; too_many_nodes where none of the
  /// numbers tried does.
  int enough_nodes = 0;
  TriangleMendingReport mending;  ///< of triangles that the sphere had jammed
  NormalFitReport fit;            ///< of a least-squares placement
  EdgeEveningReport evening;      ///< of fitted nodes
};

/// No number of nodes tried would do: twice that asked for and so on, up to sixteen times or
/// 20,000.
inline constexpr int too_many_nodes = -1;

}  // namespace wscvt
