// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/nodes/scan_nodes_options.h"
#include "wscvt/remesh/error_target.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/repair/scan_options.h"
#include "wscvt/surface/surface_options.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

/// Report of the method OnScan.
struct OnScanReport {
  HandleReport handles;  ///< lengths and places of the input
  ScanNodesReport nodes;
  /// Larger number of nodes without intersecting pairs, if pairs are left and the scan has none; 0
  /// if none was found.
  int enough_nodes = 0;
};

/// Report of the method AsPublished.
struct AsPublishedReport {
  double overhang_fraction = 0.0;  ///< of the scan, see overhang_solid_angle; 0 for a formula
  HarmonicFitReport fit;           ///< of the SH series; empty for a formula
  RelaxationReport relaxation;
};

/// A remesh and the reports of its stages, all in the input's units and coordinates.
struct RemeshResult {
  IndexedMesh mesh;  ///< exactly N points, closed, outward (to_mesh: OpenMesh)
  /// Colours and numbers of the scan, carried to the mesh (see carried_attributes); of a half-edge
  /// mesh.
  MeshAttributes attributes;
  std::vector<Vector3> directions;       ///< unit, from `centre` to each vertex
  std::vector<double> radial_distances;  ///< |vertex - centre|, length
  std::vector<double> curvatures;  ///< largest absolute principal curvature, 1/length; if asked for
  /// Surface area of each node's cell, length^2: on the scan its Voronoi cell on the remesh, as
  /// published its flat power cell (see PowerCells), projected to the surface. On the scan the sum
  /// is the remesh's area; as published it is smaller than the surface, by 2 / N of it on a sphere.
  /// Node tables have the area that a node stands for, a third of its triangles (vertex_areas).
  std::vector<double> cell_areas;
  /// Signed distance from the scan to each node, positive outside of it, length; if asked for.
  std::vector<double> vertex_distances;
  Vector3 centre = Vector3::Zero();  ///< of a scan its volume centroid; of a formula the origin
  /// The scan as it was remeshed: repaired, with its handles, with a surface if it was points, and
  /// shrink-wrapped if asked for. Only if asked for, and not of a surface from a formula.
  IndexedMesh repaired_scan;
  MeshCheckReport input;  ///< repairs of the scan, and its measures
  /// Fraction of area inclined more than 75 degrees to the radius, of a surface made of points;
  /// else 0.
  double steep_area_fraction = 0.0;
  std::variant<OnScanReport, AsPublishedReport> method;
  /// As published of a scan; on the scan what `measures.series` returned.
  SeriesCoefficients coefficients;
  /// Rms and largest distance between scan and remesh, the larger of both ways; length. Those of
  /// `distances`, or of sampled_distances with 5,000 samples.
  double rms_distance = 0.0;
  double largest_distance = 0.0;
  /// Opening, in % of the bounding box' diagonal, of a shrink-wrap of the scan as it was given (of
  /// the repaired scan above 500,000 faces) that was remeshed with these options without
  /// intersecting triangles, if the scan and the result have such; else 0.
  double clean_wrap_percent = 0.0;
  std::optional<MeshDistances> distances;  ///< between remesh and scan; if asked for
  std::optional<NodeCountSearch> search;   ///< the error of each N tried, %; with an error target
  MeshQuality scan_quality;                ///< of the repaired scan
  MeshQuality quality;                     ///< of the remesh
  ShapeDescriptors scan;                   ///< of the repaired scan
  ShapeDescriptors remesh;
  RemeshOptions options;           ///< as used
  std::vector<Sentence> warnings;  ///< sentences for the user
};

/// Return the report of the method, or nullptr if the other method was used.
inline const OnScanReport* on_scan_report(const RemeshResult& result) {
  return std::get_if<OnScanReport>(&result.method);
}
inline const AsPublishedReport* as_published_report(const RemeshResult& result) {
  return std::get_if<AsPublishedReport>(&result.method);
}

/// Returns a result's error by a measure, in %, >= 0. Throws Error(InvalidInput) for Distance if
/// the result contains no distances.
double error_percent(const RemeshResult& result, ErrorMeasure measure);

/// Writes the coefficients of a result by write_harmonics or write_harmonic_map. On the scan,
/// `measures.series` must have been set. Throws Error: InvalidInput for a result without
/// coefficients, and the errors of both functions.
void write_coefficients(const std::string& path, const RemeshResult& result);

}  // namespace wscvt
