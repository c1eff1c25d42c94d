// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_filter.h"

#include <algorithm>

#include "report_file.h"
#include "wscvt/base/option.h"

namespace wscvt::filter {

std::string remesh_name() { return "Remeshing: Weighted Spherical Centroidal Voronoi"; }

std::string remesh_help() {
  // Three lines: in 2020.09, whose dialog does not scroll, a longer text pushes Apply off the
  // screen.
  return "A mesh of <b>exactly the number of nodes asked for</b>. It repairs small faults of the "
         "scan "
         "and refuses large ones. See: <i>Wu F., Huang L., Lai Z.</i>, 2022, doi "
         "10.6052/j.issn.1000-4750.2022.07.0614";
}

ParameterList remesh_parameters() {
  const RemeshOptions defaults;
  return {
      node_count_parameter(),
      option_parameter(
          "ErrorTarget", defaults.target.percent, error_target_option, "Error target (%)",
          "Above 0: looks for the smallest number of nodes whose error is at most this. 0: the "
          "number of nodes counts. It looks from the number of nodes given up to " +
              typed_text(defaults.target.largest_node_count) +
              ", or that number if it is larger; the log says what each number tried cost. Takes "
              "about ten times as long."),
      table_parameter("TargetMeasure", defaults.target.measure, "Error target is of the",
                      "Which error the target limits, each in % of the original's own."),
      table_parameter("Method", defaults.method, "Method",
                      "What the nodes are fitted to: the scan, or a harmonic series of it."),
      sampling_parameter(),
      weighting_parameter(),
      option_parameter(
          "HarmonicDegree", defaults.surface.degree, harmonic_degree_option, "Harmonic degree",
          "Degree of the spherical-harmonic series fitted to the surface; on the spherical map "
          "WSCVT-C alone takes its curvature from one. 0: follows the grain, the log says how; as "
          "published, and on the spherical map, then means 20."),
      curvature_alpha_parameter(),
      table_parameter("CurvatureSource", defaults.weighting.curvature_source, "Curvature from",
                      "Where WSCVT-C takes the surface's curvature from."),
      table_parameter(
          "Placement", defaults.placement.kind, "Place nodes",
          "Where the nodes are put; only least squares encloses exactly the scan's volume."),
      option_parameter("RefinementRounds", defaults.placement.refinement.rounds,
                       refinement_rounds_option, "Rounds of refinement",
                       "Rounds of moving nodes, flipping edges and relocating nodes after least "
                       "squares. 100 suffice; 0 keeps the nodes evenly spaced."),
      option_parameter("SmallestAngle", defaults.placement.refinement.smallest_angle,
                       refinement_angle_option, "Smallest angle of a refinement",
                       "In degrees. Refinement leaves no triangle a smaller one; smaller is closer "
                       "to the scan and less even."),
      table_parameter(
          "Parametrization", defaults.surface.parametrization, "Map to the sphere",
          "How the scan is laid over the sphere; Auto chooses, and the log says which."),
      option_parameter(
          "FoldLimit", defaults.surface.fold_limit_percent, fold_limit_option, "Fold limit (%)",
          "Largest solid angle that folds may fill, in % of the whole sphere; above it the filter "
          "refuses. Where the surface folds, a ray from the centroid meets more than one sheet; "
          "all sheets beyond the first count. Folds are bridged by their outermost sheet. The "
          "spherical map has no such limit."),
      option_parameter(
          "MendLimit", defaults.check.mended_area_limit_percent, mended_area_limit_option,
          "Mend limit (%)",
          "Largest share of the scan's area that mending may change, in %; above it the filter "
          "refuses. Holes are filled, and flaps and walls where more than two faces meet in an "
          "edge are dropped."),
      flag_parameter(
          "Points", defaults.points, "Take points only",
          "Checked: a surface is made of the points; faces are not used. It has one radius in each "
          "direction from their centre, and folds go unseen. Unchecked: a layer without faces is "
          "refused."),
      metric_parameter(),
      seed_start_parameter(),
      random_seed_parameter(),
      maximum_iterations_parameter(),
      option_parameter("Threads", 0, threads_option, "Threads",
                       "How many threads the remesher takes; 0 takes all. They change no result."),
      flag_parameter(
          "NewLayer", true, "Result as a new layer",
          "Unchecked: the result replaces the scan, which cannot be undone. Checked: it becomes a "
          "new, current layer."),
      flag_parameter("Distances", defaults.measures.distances, "Measure distances",
                     "Largest, rms and mean distance to the original, both ways. For log and "
                     "report; takes about a second."),
      table_parameter("Quality", RemeshSettings().result.quality, "Vertex quality",
                      "What each vertex of the result holds as its quality."),
      colour_by_quality_parameter(),
      report_file_parameter(),
      output_file_parameter(
          "CoefficientsFile", {".json"}, "Save coefficients to",
          "A .json file for the coefficients of the fitted harmonic series, or nothing. The filter "
          "that creates grains reads it. They are of the radius or, on the spherical map, of x, y "
          "and z, about the volume centroid and in units of the mesh. A name without a folder "
          "lands beside the scan."),
  };
}

RemeshSettings read_remesh_settings(const ParameterValues& values) {
  const CheckedValues checked(remesh_parameters(), values);
  RemeshSettings settings;
  RemeshOptions& options = settings.options;
  options = read_node_options(checked);
  options.method = checked.choice<Method>("Method");
  options.target.percent = checked.real("ErrorTarget");
  options.target.measure = checked.choice<ErrorMeasure>("TargetMeasure");
  options.target.largest_node_count =
      std::max(options.target.largest_node_count, options.node_count);
  options.surface.degree = checked.whole("HarmonicDegree");
  options.weighting.curvature_source = checked.choice<CurvatureSource>("CurvatureSource");
  options.placement.kind = checked.choice<NodePlacement>("Placement");
  options.placement.refinement.rounds = checked.whole("RefinementRounds");
  options.placement.refinement.smallest_angle = checked.real("SmallestAngle");
  options.surface.parametrization = checked.choice<Parametrization>("Parametrization");
  options.surface.fold_limit_percent = checked.real("FoldLimit");
  options.check.mended_area_limit_percent = checked.real("MendLimit");
  options.points = checked.flag("Points");
  options.measures.distances = checked.flag("Distances");
  settings.threads = checked.whole("Threads");
  settings.new_layer = checked.flag("NewLayer");
  settings.result.quality = checked.choice<VertexQuality>("Quality");
  request_quality(options, settings.result.quality);
  settings.result.colour_by_quality = checked.flag("ColorByQuality");
  settings.result.report_file = checked.text("ReportFile");
  check_remesh_report_file(settings.result.report_file);
  settings.coefficients_file = checked.text("CoefficientsFile");
  options.measures.coefficients = !settings.coefficients_file.empty();
  check_output_file(settings.coefficients_file, {".json"}, "CoefficientsFile");
  check_different_files(settings.result.report_file, "ReportFile", settings.coefficients_file,
                        "CoefficientsFile");
  return settings;
}

}  // namespace wscvt::filter
