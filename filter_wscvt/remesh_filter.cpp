// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_filter.h"

#include <algorithm>

#include "report_file.h"

namespace wscvt::filter {

std::string remesh_name() { return "Remeshing: Weighted Spherical Centroidal Voronoi"; }

std::string remesh_help() {
  return "Turns a closed scan of a grain into a mesh of <b>exactly the number of nodes asked "
         "for</b>, by a weighted Voronoi tessellation of the sphere. It repairs small faults and "
         "says so; it refuses, changing nothing, what needs much mending or is folded too much. "
         "See: <i>Wu F., Huang L., Lai Z.</i>, Engineering Mechanics, 2022, doi "
         "10.6052/j.issn.1000-4750.2022.07.0614";
}

ParameterList remesh_parameters() {
  const RemeshOptions defaults;
  return {
      node_count_parameter(),
      real_parameter(
          "ErrorTarget", defaults.target.percent, 0, 100, "Error target (%)",
          "0: the number of nodes counts. Above, up to 100: the smallest number of "
          "nodes whose error is at most this many % is looked for, from the number of "
          "nodes given and up to 20000, or that number if it is larger; the log says what "
          "each number tried cost. Takes about ten times as long."),
      choice_parameter("TargetMeasure", static_cast<int>(defaults.target.measure),
                       {"Volume", "Area", "Sphericity", "Inertia", "RMS distance"},
                       "Error target is of the",
                       "Which error the target limits, each in % of the original's own: volume, "
                       "area, Wadell's sphericity, the inertia tensor, or the two-sided rms "
                       "distance, which is in % of the equivalent radius."),
      sampling_parameter(),
      weighting_parameter(),
      integer_parameter(
          "HarmonicDegree", defaults.surface.degree, 1, 60, "Harmonic degree",
          "Degree of the spherical-harmonic series fitted to the surface, 1 to 60. 20 suits "
          "most grains, 30 rough ones; lower smooths. Lowered, with a line in the log, when the "
          "mesh has too few points to carry it."),
      curvature_alpha_parameter(),
      choice_parameter(
          "CurvatureSource", static_cast<int>(defaults.weighting.curvature_source),
          {"Harmonic series", "Quadrics on the scan"}, "Curvature from",
          "Where WSCVT-C takes the curvature from. Harmonic series: exact derivatives "
          "of the fitted surface. Quadrics on the scan: a quadric fitted around each "
          "vertex of the scan over two rings, as in the paper; follows its noise too."),
      choice_parameter(
          "Placement", static_cast<int>(defaults.placement.kind),
          {"Fitted surface", "Original mesh", "Least squares (volume exact)"}, "Place nodes",
          "Fitted surface: on the harmonic series, which is free of scanning noise. Original "
          "mesh: on the scan itself, with its noise, where rays from the centroid leave it. Least "
          "squares: off the surface, so that the triangles fit the scan best and enclose exactly "
          "its volume."),
      integer_parameter("RefinementRounds", defaults.placement.refinement.rounds, 0, 1000,
                        "Rounds of refinement",
                        "After a least-squares placement, 0 to 1000: at most so many rounds of "
                        "moving nodes, flipping edges and taking nodes to where they help most, "
                        "all towards the scan. 100 suffice; 0 keeps the nodes evenly spaced."),
      real_parameter(
          "FoldLimit", 100.0 * defaults.surface.fold_limit, 0, 99, "Fold limit (%)",
          "Where the surface folds, a ray from the centroid meets more than one sheet. Largest "
          "solid "
          "angle that all sheets beyond the first may fill together, in % of the whole sphere, 0 "
          "to "
          "99. Folds are bridged by their outermost sheet; above the limit the filter refuses."),
      real_parameter(
          "MendLimit", 100.0 * defaults.check.mended_area_limit, 0, 100, "Mend limit (%)",
          "Holes are filled, and flaps and walls where more than two faces meet in an edge are "
          "dropped. Largest share of the scan's area that this may change, in %, 0 to 100; above "
          "it the filter refuses."),
      metric_parameter(),
      seed_start_parameter(),
      random_seed_parameter(),
      maximum_iterations_parameter(),
      flag_parameter(
          "NewLayer", true, "Result as a new layer",
          "Checked: the scan is kept and the result becomes a new, current layer. Unchecked: the "
          "result replaces the scan, which cannot be undone."),
      flag_parameter("Distances", defaults.measures.distances, "Measure distances",
                     "Measures the one- and two-sided Hausdorff, rms and mean distance between "
                     "result and original, for the log and the report; takes about a second."),
      choice_parameter(
          "Quality", 0, quality_names(), "Vertex quality",
          "What the vertex quality of the result holds. Radial distance: from the centroid, in "
          "units of the mesh. Curvature: the largest absolute principal curvature, 1/unit. Cell "
          "area: surface area of the node's cell, unit^2. Distance to the original: from each node "
          "to the scan, in units of the mesh."),
      colour_by_quality_parameter(),
      report_file_parameter(),
      output_file_parameter(
          "CoefficientsFile", {".json"}, "Save coefficients to",
          "A .json file for the coefficients of the fitted harmonic series, about the volume "
          "centroid and in units of the mesh, or nothing. A name without a folder lands beside the "
          "scan. The filter that creates grains reads it."),
  };
}

RemeshSettings read_remesh_settings(const ParameterValues& values) {
  const CheckedValues checked(remesh_parameters(), values);
  RemeshSettings settings;
  RemeshOptions& options = settings.options;
  options = read_node_options(checked);
  options.target.percent = checked.real("ErrorTarget");
  options.target.measure = checked.choice<ErrorMeasure>("TargetMeasure");
  options.target.largest_node_count =
      std::max(options.target.largest_node_count, options.node_count);
  options.surface.degree = checked.whole("HarmonicDegree");
  options.weighting.curvature_source = checked.choice<CurvatureSource>("CurvatureSource");
  options.placement.kind = checked.choice<NodePlacement>("Placement");
  options.placement.refinement.rounds = checked.whole("RefinementRounds");
  options.surface.fold_limit = checked.real("FoldLimit") / 100.0;
  options.check.mended_area_limit = checked.real("MendLimit") / 100.0;
  options.measures.distances = checked.flag("Distances");
  settings.new_layer = checked.flag("NewLayer");
  settings.result.quality = checked.choice<VertexQuality>("Quality");
  request_quality(options, settings.result.quality);
  settings.result.colour_by_quality = checked.flag("ColorByQuality");
  settings.result.report_file = checked.text("ReportFile");
  check_report_file(settings.result.report_file);
  settings.coefficients_file = checked.text("CoefficientsFile");
  check_output_file(settings.coefficients_file, {".json"}, "CoefficientsFile");
  check_different_files(settings.result.report_file, "ReportFile", settings.coefficients_file,
                        "CoefficientsFile");
  return settings;
}

}  // namespace wscvt::filter
