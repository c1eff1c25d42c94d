// SPDX-License-Identifier: GPL-3.0-or-later
// The remesher without a display: one scan in, one remesh and its report out.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"
#include "wscvt/scan/mesh_io.h"
#include "wscvt/surface/harmonic_io.h"

namespace {

using wscvt::RemeshOptions;

int run(int argc, char** argv) {
  CLI::App app{"Remesh a dense scan of a grain to exactly N nodes (WSCVT)."};
  std::string input;
  std::string output;
  std::string json;
  std::string coefficients;
  int threads = 0;
  bool quiet = false;
  RemeshOptions options;
  app.add_option("input", input, "Scan: PLY, STL, OBJ or OFF")->required();
  app.add_option("output", output, "Remesh: PLY, STL, OBJ or OFF")->required();
  app.add_option("-n,--nodes", options.node_count, "Number of nodes, from 4")
      ->capture_default_str();
  const std::map<std::string, wscvt::Weighting> weightings = {
      {"constant", wscvt::Weighting::Constant},
      {"radial-distance", wscvt::Weighting::RadialDistance},
      {"curvature", wscvt::Weighting::Curvature},
      {"area", wscvt::Weighting::Area},
      {"error-adaptive", wscvt::Weighting::ErrorAdaptive}};
  app.add_option("-w,--weighting", options.weighting.kind, "What a node's cell size follows")
      ->transform(CLI::CheckedTransformer(weightings))
      ->default_str("radial-distance");
  const std::map<std::string, wscvt::RelaxationMetric> metrics = {
      {"sphere", wscvt::RelaxationMetric::Sphere}, {"surface", wscvt::RelaxationMetric::Surface}};
  app.add_option("-m,--metric", options.relaxation.metric, "Where cells are made centroidal")
      ->transform(CLI::CheckedTransformer(metrics))
      ->default_str("sphere");
  const std::map<std::string, wscvt::NodePlacement> placements = {
      {"fitted", wscvt::NodePlacement::FittedSurface},
      {"original", wscvt::NodePlacement::OriginalMesh},
      {"least-squares", wscvt::NodePlacement::LeastSquares}};
  app.add_option("-p,--placement", options.placement.kind,
                 "Nodes on the fitted series, on the scan, or where the triangles fit the scan")
      ->transform(CLI::CheckedTransformer(placements))
      ->default_str("fitted");
  app.add_option("-r,--refine", options.placement.refinement.rounds,
                 "Rounds of refinement towards the scan, 0 for none; needs least-squares")
      ->capture_default_str();
  const std::map<std::string, wscvt::ErrorMeasure> measures = {
      {"volume", wscvt::ErrorMeasure::Volume},
      {"area", wscvt::ErrorMeasure::Area},
      {"sphericity", wscvt::ErrorMeasure::Sphericity},
      {"inertia", wscvt::ErrorMeasure::Inertia},
      {"distance", wscvt::ErrorMeasure::Distance}};
  app.add_option("--target", options.target.percent,
                 "Find the smallest number of nodes with an error of at most this many %")
      ->check(CLI::PositiveNumber);
  app.add_option("--target-measure", options.target.measure, "Which error the target limits")
      ->transform(CLI::CheckedTransformer(measures))
      ->default_str("distance");
  app.add_option("--largest", options.target.largest_node_count,
                 "Largest number of nodes the target may take")
      ->capture_default_str();
  app.add_flag("--distances", options.measures.distances, "Measure the distances to the scan");
  const std::map<std::string, wscvt::Sampling> samplings = {
      {"weighted", wscvt::Sampling::Weighted},
      {"fibonacci", wscvt::Sampling::Fibonacci},
      {"equal-angle", wscvt::Sampling::EqualAngle},
      {"icosahedron", wscvt::Sampling::Icosahedron}};
  app.add_option("-s,--sampling", options.seeding.sampling, "How the nodes' directions are chosen")
      ->transform(CLI::CheckedTransformer(samplings))
      ->default_str("weighted");
  app.add_option("-d,--degree", options.surface.degree, "Degree of the harmonic series, 1 to 60")
      ->capture_default_str();
  app.add_option("-a,--alpha", options.weighting.curvature_alpha,
                 "Exponent of the curvature weighting, -3 to 3")
      ->capture_default_str();
  const std::map<std::string, wscvt::CurvatureSource> curvature_sources = {
      {"series", wscvt::CurvatureSource::Series}, {"quadrics", wscvt::CurvatureSource::QuadricFit}};
  app.add_option("--curvature-source", options.weighting.curvature_source,
                 "Curvature of the fitted series, or of quadrics fitted to the scan")
      ->transform(CLI::CheckedTransformer(curvature_sources))
      ->default_str("series");
  app.add_option("--adaptive-exponent", options.weighting.adaptive_exponent,
                 "Curvature exponent of the error-adaptive weighting, 0 to 1.5")
      ->capture_default_str();
  app.add_option("-i,--iterations", options.relaxation.maximum_iterations,
                 "Limit of the relaxation")
      ->capture_default_str();
  app.add_option("--tolerance", options.relaxation.displacement_tolerance,
                 "Relaxation stops below this rms displacement / cell size")
      ->capture_default_str();
  app.add_option("--fold-limit", options.surface.fold_limit,
                 "Largest solid angle of sheets beyond the first / 4 pi, 0 to 1")
      ->capture_default_str();
  app.add_option("--weld-tolerance", options.check.weld_tolerance,
                 "Points nearer than this share of the scan's size are one, 0 to 0.01")
      ->capture_default_str();
  app.add_option("--mend-limit", options.check.mended_area_limit,
                 "Largest share of the scan's area that may be mended, 0 to 1")
      ->capture_default_str();
  app.add_option("-t,--threads", threads, "Number of threads, 0 for all")->capture_default_str();
  app.add_option("-j,--json", json, "Write the report to this file as JSON");
  app.add_option("--coefficients", coefficients, "Write the fitted series to this file as JSON");
  app.add_flag("-q,--quiet", quiet, "No report on the standard output");
  CLI11_PARSE(app, argc, argv);

  const std::vector<std::pair<std::string, std::string>> files = {
      {"the scan", input},
      {"the remesh", output},
      {"the report", json},
      {"the coefficients", coefficients}};
  for (std::size_t i = 2; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!wscvt::same_file(files[i].second, files[k].second)) continue;
      throw wscvt::Error(wscvt::ErrorCode::InvalidInput,
                         "\"" + files[i].second + "\" is named for " + files[k].first +
                             " and for " + files[i].first + "; give two names.");
    }
  }

  const wscvt::RemeshResult result =
      wscvt::remesh(wscvt::read_mesh(input), options, wscvt::Execution(threads));
  wscvt::write_mesh(result.mesh, output);
  if (!json.empty()) wscvt::write_file(json, wscvt::report_json(result));
  if (!coefficients.empty()) {
    wscvt::write_harmonics(coefficients, wscvt::HarmonicSurface(result.coefficients));
  }
  if (!quiet) {
    for (const std::string& line : wscvt::report_lines(result)) std::puts(line.c_str());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
