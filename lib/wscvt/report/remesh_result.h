// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/report/remesh_options.h"
#include "wscvt/scan/scan_options.h"
#include "wscvt/surface/surface_options.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

/// What another setting would have given.
struct TriedChange {
  std::string change;     ///< in words that complete "with"
  double misfit = 0.0;    ///< rms distance from the scan to that remesh / equivalent radius
  double area_off = 0.0;  ///< its area / the scan's - 1
};

/// A remesh and the reports of its stages, all in the input's units and coordinates.
struct RemeshResult {
  IndexedMesh
      mesh;  ///< exactly N points and 2 N - 4 triangles, closed, outward (to_mesh: OpenMesh)
  std::vector<Vector3> directions;       ///< unit, from `centre` to each vertex
  std::vector<double> radial_distances;  ///< |vertex - centre|, length
  std::vector<double> curvatures;  ///< largest absolute principal curvature, 1/length; if asked for
  /// Surface area of each node's cell, or, where nodes were mended, refined or fitted to contacts,
  /// a third of its triangles'; length^2
  std::vector<double> cell_areas;
  std::vector<double> vertex_distances;  ///< from each node to the scan, length; if asked for
  Vector3 centre = Vector3::Zero();      ///< of a scan its volume centroid; of a formula the origin
  /// The scan as it was taken: with a surface where it is points, by its envelope where one is
  /// asked for, checked and mended, with its handles; if asked for, and not of a surface from a
  /// formula.
  IndexedMesh used_scan;
  MeshCheckReport input;      ///< what of the scan was mended, and its measures
  HandleReport handles;       ///< cut for a spherical map, lengths and places of the input
  double folded_share = 0.0;  ///< see folded_solid_angle
  Parametrization parametrization = Parametrization::Radial;  ///< the one taken: not Auto
  double steep_share = 0.0;  ///< of the scan, by which Auto decides; see steep_share
  SphereMapReport map;       ///< of a Spherical one
  SpaceNodesReport space;    ///< of a Spherical one; of a Radial one mending and fit alone
  HarmonicFitReport fit;     ///< of the series; of a Radial one
  std::vector<double>
      coefficients;  ///< of the fitted series about `centre`, length; of a Radial one
  /// Of series of x, y and z about `centre` (see HarmonicMap), length; of a Spherical one, if asked
  /// for.
  std::array<std::vector<double>, 3> map_coefficients;
  int map_degree = 0;  ///< of these series, where the weighting or the user read them; else 0
  RelaxationReport relaxation;
  RefinementReport refinement;  ///< of no rounds where none were asked for
  /// Rms distance from the scan to the remesh; length. Over the samples of `distances`, or over
  /// 10,000 points of the scan where those were not asked for.
  double misfit = 0.0;
  std::vector<TriedChange> tried;  ///< where the remesh misses the scan; see misses_the_scan
  std::optional<MeshDistances> distances;  ///< between remesh and scan; if asked for
  std::optional<NodeCountSearch> search;   ///< what each N tried cost, in %; with an error target
  MeshQuality original_quality;            ///< of the scan as it was mended
  MeshQuality quality;                     ///< of the remesh
  ShapeDescriptors original;               ///< of the scan as it was mended
  ShapeDescriptors remesh;
  RemeshOptions options;              ///< as used
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// A result's error by a measure, in %, >= 0. Throws Error(InvalidInput) for Distance when the
/// result holds no distances.
double error_percent(const RemeshResult& result, ErrorMeasure measure);

/// Writes the coefficients of a result as write_harmonics or write_harmonic_map does, whichever map
/// it has. A Spherical result needs `measures.coefficients`. Throws Error: InvalidInput for a
/// result without coefficients, and what those throw.
void write_coefficients(const std::string& path, const RemeshResult& result);

}  // namespace wscvt
