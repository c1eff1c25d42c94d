// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_filter.h"

#include <algorithm>

#include "report_file.h"
#include "wscvt/base/threads_option.h"

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
          "0: the number of nodes counts. Above: the smallest number of nodes whose error is at "
          "most this many % is looked for, from the number of nodes given and up to " +
              typed_text(defaults.target.largest_node_count) +
              ", or that number if it is larger; the log says what each number tried cost. Takes "
              "about ten times as long."),
      table_parameter("TargetMeasure", defaults.target.measure, "Error target is of the",
                      "Which error the target limits, each in % of the original's own."),
      table_parameter("Method", defaults.method, "Method", "What the nodes are fitted to."),
      sampling_parameter(),
      weighting_parameter(),
      option_parameter(
          "HarmonicDegree", defaults.surface.degree, harmonic_degree_option, "Harmonic degree",
          "Degree of the spherical-harmonic series fitted to the surface, on the radial map only. "
          "0: follows the grain, the log says how; as published then means 20."),
      curvature_alpha_parameter(),
      table_parameter("CurvatureSource", defaults.weighting.curvature_source, "Curvature from",
                      "Where WSCVT-C takes the curvature from."),
      table_parameter("Placement", defaults.placement.kind, "Place nodes",
                      "Where the nodes are put along their directions."),
      option_parameter("RefinementRounds", defaults.placement.refinement.rounds,
                       refinement_rounds_option, "Rounds of refinement",
                       "After a placement by least squares: at most so many rounds of moving "
                       "nodes, flipping edges and taking nodes to where they help most, all "
                       "towards the scan. 100 suffice; 0 keeps the nodes evenly spaced."),
      option_parameter("SmallestAngle", defaults.placement.refinement.smallest_angle,
                       refinement_angle_option, "Smallest angle of a refinement",
                       "In degrees. Refinement gives no triangle a smaller one; smaller is closer "
                       "to the scan and less even."),
      table_parameter("Parametrization", defaults.surface.parametrization, "Map to the sphere",
                      "How the scan is laid over the sphere."),
      option_parameter(
          "FoldLimit", defaults.surface.fold_limit_percent, fold_limit_option, "Fold limit (%)",
          "Where the surface folds, a ray from the centroid meets more than one sheet. Largest "
          "solid angle that all sheets beyond the first may fill together, in % of the whole "
          "sphere. Folds are bridged by their outermost sheet; above the limit the filter "
          "refuses. The spherical map has no such limit."),
      option_parameter(
          "MendLimit", defaults.check.mended_area_limit_percent, mended_area_limit_option,
          "Mend limit (%)",
          "Holes are filled, and flaps and walls where more than two faces meet in an edge are "
          "dropped. Largest share of the scan's area that this may change, in %; above it the "
          "filter refuses."),
      flag_parameter(
          "Points", defaults.points, "Take points only",
          "Checked: the points of the layer are taken and a surface is made of them, with one "
          "radius in each direction from their centre; faces are not used, and folds go unseen. "
          "Unchecked: a layer without faces is refused."),
      metric_parameter(),
      seed_start_parameter(),
      random_seed_parameter(),
      maximum_iterations_parameter(),
      option_parameter("Threads", 0, threads_option, "Threads",
                       "How many threads the remesher takes; 0 takes all. They change no result."),
      flag_parameter(
          "NewLayer", true, "Result as a new layer",
          "Checked: the scan is kept and the result becomes a new, current layer. Unchecked: the "
          "result replaces the scan, which cannot be undone."),
      flag_parameter("Distances", defaults.measures.distances, "Measure distances",
                     "Measures the one- and two-sided largest, rms and mean distance between "
                     "result and original, for the log and the report; takes about a second."),
      table_parameter("Quality", RemeshSettings().result.quality, "Vertex quality",
                      "What each vertex of the result holds."),
      colour_by_quality_parameter(),
      report_file_parameter(),
      output_file_parameter(
          "CoefficientsFile", {".json"}, "Save coefficients to",
          "A .json file for the coefficients of the fitted harmonic series, of the radius or, on "
          "the spherical map, of x, y and z, about the volume "
          "centroid and in units of the mesh, or nothing. A name without a folder lands beside the "
          "scan. The filter that creates grains reads it."),
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
