// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"

namespace wscvt {

namespace {

using Json = nlohmann::ordered_json;

// ---- words

const char* name_of(Weighting weighting) {
  switch (weighting) {
    case Weighting::Constant:
      return "constant";
    case Weighting::RadialDistance:
      return "radial distance (WSCVT-D)";
    case Weighting::Curvature:
      return "curvature (WSCVT-C)";
    case Weighting::Area:
      return "area";
    case Weighting::ErrorAdaptive:
      return "error-adaptive";
  }
  return "unknown";
}

const char* name_of(CurvatureSource source) {
  switch (source) {
    case CurvatureSource::Series:
      return "series";
    case CurvatureSource::QuadricFit:
      return "quadric fit";
  }
  return "unknown";
}

const char* name_of(NodePlacement placement) {
  switch (placement) {
    case NodePlacement::FittedSurface:
      return "fitted surface";
    case NodePlacement::OriginalMesh:
      return "original mesh";
    case NodePlacement::LeastSquares:
      return "least squares";
  }
  return "unknown";
}

const char* name_of(ErrorMeasure measure) {
  switch (measure) {
    case ErrorMeasure::Volume:
      return "volume";
    case ErrorMeasure::Area:
      return "area";
    case ErrorMeasure::Sphericity:
      return "sphericity";
    case ErrorMeasure::Inertia:
      return "inertia";
    case ErrorMeasure::Distance:
      return "rms distance";
  }
  return "unknown";
}

const char* name_of(SeedStart start) {
  switch (start) {
    case SeedStart::Multilevel:
      return "multilevel";
    case SeedStart::WarpedLattice:
      return "warped lattice";
    case SeedStart::Random:
      return "random";
  }
  return "unknown";
}

const char* name_of(Sampling sampling) {
  switch (sampling) {
    case Sampling::Weighted:
      return "weighted";
    case Sampling::Fibonacci:
      return "Fibonacci lattice";
    case Sampling::EqualAngle:
      return "equal-angle grid";
    case Sampling::Icosahedron:
      return "subdivided icosahedron";
  }
  return "unknown";
}

const char* name_of(RelaxationMetric metric) {
  switch (metric) {
    case RelaxationMetric::Sphere:
      return "sphere";
    case RelaxationMetric::Surface:
      return "surface";
  }
  return "unknown";
}

const char* name_of(RelaxationOutcome outcome) {
  switch (outcome) {
    case RelaxationOutcome::Converged:
      return "converged";
    case RelaxationOutcome::Settled:
      return "settled";
    case RelaxationOutcome::Stuck:
      return "stuck";
    case RelaxationOutcome::IterationLimit:
      return "iteration limit";
  }
  return "unknown";
}

const char* name_of(DegreeLimit limit) {
  switch (limit) {
    case DegreeLimit::None:
      return "nothing";
    case DegreeLimit::Radius:
      return "radius";
  }
  return "unknown";
}

// ---- text

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

constexpr std::size_t topic_width = 12;

std::string line(const std::string& topic, const std::string& text) {
  std::string result = topic;
  result.resize(std::max(topic_width, result.size() + 1), ' ');
  return result + text;
}

std::vector<std::string> repairs(const MeshCheckReport& input) {
  std::vector<std::string> parts;
  const auto add = [&parts](std::size_t count, const char* one, const char* many,
                            const char* what) {
    if (count > 0) parts.push_back(counted(count, one, many) + " " + what);
  };
  add(input.welded_vertices, "equal vertex", "equal vertices", "merged");
  add(input.unreferenced_vertices, "unused vertex", "unused vertices", "dropped");
  add(input.degenerate_faces, "degenerate face", "degenerate faces", "dropped");
  add(input.duplicate_faces, "duplicate face", "duplicate faces", "dropped");
  add(input.reoriented_faces, "face", "faces", "turned outward");
  add(input.split_vertices, "vertex", "vertices", "added where the surface touched itself");
  add(input.sliver_faces, "face", "faces", "of no area kept");
  if (input.input_faces == 0) parts.emplace_back("points triangulated");
  if (input.components > 1) {
    parts.push_back(counted(input.components - 1, "smaller component", "smaller components") +
                    " dropped (" + counted(input.dropped_faces, "face", "faces") + ", " +
                    format_number(100.0 * input.dropped_volume_share, 3) + " % of the volume)");
  }
  return parts;
}

void append_input(const RemeshResult& result, std::vector<std::string>& lines) {
  const MeshCheckReport& input = result.input;
  if (input.input_vertices == 0) {
    lines.push_back(line("Input", "surface from a formula or coefficients, equivalent radius " +
                                      format_number(input.equivalent_radius, 6)));
    return;
  }
  lines.push_back(line("Input", counted(input.input_vertices, "vertex", "vertices") + ", " +
                                    counted(input.input_faces, "face", "faces")));
  const std::vector<std::string> done = repairs(input);
  lines.push_back(line("Repairs", done.empty() ? "none needed" : joined(done)));
  lines.push_back(line("Used", counted(input.vertices, "vertex", "vertices") + ", " +
                                   counted(input.faces, "face", "faces") + ", closed, genus " +
                                   std::to_string(input.genus) + ", equivalent radius " +
                                   format_number(input.equivalent_radius)));
  lines.push_back(line("Fold", format_percent(result.folded_share) +
                                   " of the solid angle in sheets beyond the first (limit " +
                                   format_percent(result.options.surface.fold_limit) + ")"));
}

void append_fit(const RemeshResult& result, std::vector<std::string>& lines) {
  if (result.fit.rays == 0) return;
  const HarmonicFitReport& fit = result.fit;
  std::string text = "spherical harmonics of degree " + std::to_string(fit.degree);
  if (fit.degree < fit.requested_degree) {
    text += " (lowered from " + std::to_string(fit.requested_degree) +
            ": above it the series is not positive everywhere)";
  }
  text += ", residual " + format_number(fit.residual, 3);
  const double radius = result.input.equivalent_radius;
  if (radius > 0.0) {
    text += " (" + format_number(100.0 * fit.residual / radius, 3) + " % of the equivalent radius)";
  }
  lines.push_back(line("Fit", text));
}

void append_relaxation(const RemeshResult& result, std::vector<std::string>& lines) {
  const RemeshOptions& options = result.options;
  if (options.seeding.sampling != Sampling::Weighted) {
    lines.push_back(
        line("Sampling", name_of(options.seeding.sampling) + std::string(", not relaxed")));
    return;
  }
  std::string seeds = name_of(options.seeding.start);
  if (options.seeding.start == SeedStart::Random) {
    seeds += " start, seed " + std::to_string(options.seeding.random_seed);
  }
  std::string weighting = name_of(options.weighting.kind);
  if (options.weighting.kind == Weighting::Curvature) {
    weighting += ", alpha " + format_number(options.weighting.curvature_alpha, 3) +
                 ", curvature from the " + name_of(options.weighting.curvature_source);
  }
  if (options.weighting.kind == Weighting::ErrorAdaptive) {
    weighting += ", curvature exponent " + format_number(options.weighting.adaptive_exponent, 3);
  }
  lines.push_back(line("Weighting", weighting + "; seeds: " + seeds));

  const RelaxationReport& relaxation = result.relaxation;
  const auto iterations = static_cast<std::size_t>(std::max(relaxation.iterations, 0));
  std::string text = (relaxation.outcome == RelaxationOutcome::IterationLimit
                          ? "not converged: stopped at the limit of "
                          : name_of(relaxation.outcome) + std::string(" after ")) +
                     counted(iterations, "iteration", "iterations");
  for (auto level = relaxation.coarser_levels.rbegin(); level != relaxation.coarser_levels.rend();
       ++level) {
    text += (level == relaxation.coarser_levels.rbegin() ? " (after " : ", ") +
            std::to_string(level->iterations) + " with " + std::to_string(level->seeds) + " seeds";
  }
  if (!relaxation.coarser_levels.empty()) text += ")";
  if (!relaxation.history.empty()) {
    const RelaxationStep& last = relaxation.history.back();
    text += ", displacement " + format_number(last.displacement, 2) + " h (tolerance " +
            format_number(options.relaxation.displacement_tolerance, 2) + "), cell area spread " +
            format_number(last.area_spread, 2) + " (tolerance " +
            format_number(options.relaxation.area_tolerance, 2) + ")";
  }
  lines.push_back(line("Relaxation", text));
}

void append_search(const RemeshResult& result, std::vector<std::string>& lines) {
  if (!result.search) return;
  const ErrorTarget& target = result.options.target;
  std::string text = std::string(name_of(target.measure)) + " error of at most " +
                     format_number(target.percent, 3) + " %: ";
  text += result.search->met ? "met by " : "not met, not even by ";
  text += std::to_string(result.search->node_count) + " nodes. Tried";
  for (const NodeCountTrial& trial : result.search->trials) {
    text += (&trial == &result.search->trials.front() ? " " : ", ") +
            std::to_string(trial.node_count) + ": " +
            (std::isfinite(trial.error) ? format_number(trial.error, 3) + " %" : "not possible");
  }
  lines.push_back(line("Target", text));
}

void append_refinement(const RemeshResult& result, std::vector<std::string>& lines) {
  const RefinementReport& refinement = result.refinement;
  if (refinement.history.empty()) return;
  int flips = 0;
  int relocations = 0;
  for (const RefinementStep& step : refinement.history) {
    flips += step.flips;
    relocations += step.relocations;
  }
  std::string text =
      (refinement.converged ? "converged after " : "not converged: stopped at the limit of ") +
      counted(refinement.history.size(), "round", "rounds") + ", rms distance from " +
      format_number(refinement.start_distance, 3) + " to " +
      format_number(refinement.history.back().distance, 3) + ", " +
      counted(static_cast<std::size_t>(flips), "edge", "edges") + " flipped, " +
      counted(static_cast<std::size_t>(relocations), "node", "nodes") + " taken elsewhere";
  lines.push_back(line("Refinement", text));
}

void append_distances(const RemeshResult& result, std::vector<std::string>& lines) {
  if (!result.distances) return;
  const auto row = [&](const char* label, double to, double from, double both) {
    return std::vector<std::string>{
        label, format_number(to, 4), format_number(from, 4), format_number(both, 4),
        format_number(100.0 * both / result.input.equivalent_radius, 4)};
  };
  const OneSidedDistance& to = result.distances->to_reference;
  const OneSidedDistance& from = result.distances->from_reference;
  const std::vector<std::vector<std::string>> rows = {
      {"Distance", "from remesh", "from original", "two-sided", "% of equivalent radius"},
      row("  largest (Hausdorff)", to.maximum, from.maximum, result.distances->hausdorff),
      row("  root mean square", to.root_mean_square, from.root_mean_square,
          result.distances->root_mean_square),
      row("  mean", to.mean, from.mean, std::max(to.mean, from.mean)),
  };
  for (std::string& text : aligned_lines(rows)) lines.push_back(std::move(text));
}

void append_quality(const RemeshResult& result, std::vector<std::string>& lines) {
  const MeshQuality& a = result.original_quality;
  const MeshQuality& b = result.quality;
  const auto row = [](const char* label, double before, double after) {
    return std::vector<std::string>{label, format_number(before, 4), format_number(after, 4)};
  };
  const std::vector<std::vector<std::string>> rows = {
      {"Quality", "original", "remesh"},
      row("  edge length, mean", a.edge_length.mean, b.edge_length.mean),
      row("  edge length, deviation", a.edge_length.standard_deviation,
          b.edge_length.standard_deviation),
      row("  edge length, deviation / mean", a.edge_variation, b.edge_variation),
      row("  edge ratio of the triangles, mean", a.edge_ratio.mean, b.edge_ratio.mean),
      row("  edge ratio of the triangles, deviation", a.edge_ratio.standard_deviation,
          b.edge_ratio.standard_deviation),
      row("  edge ratio of the triangles, largest", a.edge_ratio.maximum, b.edge_ratio.maximum),
      row("  smallest angle, degrees", a.smallest_angle, b.smallest_angle),
      row("  smallest angle of the triangles, mean", a.mean_smallest_angle, b.mean_smallest_angle),
      row("  vertices with six neighbours, %", 100.0 * a.valence_six_share,
          100.0 * b.valence_six_share),
  };
  for (std::string& text : aligned_lines(rows)) lines.push_back(std::move(text));
}

std::vector<DescriptorComparison> comparison(const RemeshResult& result) {
  return compare_descriptors(list_descriptors(result.original), list_descriptors(result.remesh));
}

// ---- JSON

Json json_of(const Vector3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json json_of(const Statistics& s) {
  return {{"mean", s.mean},
          {"standard_deviation", s.standard_deviation},
          {"minimum", s.minimum},
          {"maximum", s.maximum}};
}

Json json_of(const MeshQuality& q) {
  return {{"edge_length", json_of(q.edge_length)},
          {"edge_variation", q.edge_variation},
          {"edge_ratio", json_of(q.edge_ratio)},
          {"smallest_angle_degrees", q.smallest_angle},
          {"mean_smallest_angle_degrees", q.mean_smallest_angle},
          {"valence_six_share", q.valence_six_share}};
}

Json json_of(const RemeshOptions& o) {
  return {{"node_count", o.node_count},
          {"weighting", name_of(o.weighting.kind)},
          {"curvature_alpha", o.weighting.curvature_alpha},
          {"adaptive_exponent", o.weighting.adaptive_exponent},
          {"curvature_source", name_of(o.weighting.curvature_source)},
          {"degree", o.surface.degree},
          {"sampling", name_of(o.seeding.sampling)},
          {"placement", name_of(o.placement.kind)},
          {"error_target",
           {{"measure", name_of(o.target.measure)},
            {"percent", o.target.percent},
            {"largest_node_count", o.target.largest_node_count}}},
          {"refinement",
           {{"rounds", o.placement.refinement.rounds},
            {"smallest_angle_degrees", o.placement.refinement.smallest_angle},
            {"tolerance", o.placement.refinement.tolerance}}},
          {"fold_limit", o.surface.fold_limit},
          {"seed_start", name_of(o.seeding.start)},
          {"random_seed", o.seeding.random_seed},
          {"relaxation",
           {{"maximum_iterations", o.relaxation.maximum_iterations},
            {"displacement_tolerance", o.relaxation.displacement_tolerance},
            {"area_tolerance", o.relaxation.area_tolerance},
            {"acceleration", o.relaxation.acceleration},
            {"over_relaxation", o.relaxation.over_relaxation},
            {"metric", name_of(o.relaxation.metric)}}},
          {"levels",
           {{"coarsest_seeds", o.levels.coarsest_seeds},
            {"coarsest_tolerance", o.levels.coarsest_tolerance},
            {"middle_tolerance", o.levels.middle_tolerance}}},
          {"distances", o.measures.distances},
          {"distance_samples", o.measures.distance_sampling.samples},
          {"check", {{"dropped_volume_limit", o.check.dropped_volume_limit}}}};
}

Json json_of(const MeshCheckReport& i) {
  return {{"vertices", i.input_vertices},
          {"faces", i.input_faces},
          {"welded_vertices", i.welded_vertices},
          {"unreferenced_vertices", i.unreferenced_vertices},
          {"degenerate_faces", i.degenerate_faces},
          {"sliver_faces", i.sliver_faces},
          {"duplicate_faces", i.duplicate_faces},
          {"reoriented_faces", i.reoriented_faces},
          {"split_vertices", i.split_vertices},
          {"components", i.components},
          {"dropped_faces", i.dropped_faces},
          {"dropped_volume_share", i.dropped_volume_share},
          {"used_vertices", i.vertices},
          {"used_faces", i.faces},
          {"genus", i.genus},
          {"centroid", json_of(i.centroid)},
          {"equivalent_radius", i.equivalent_radius}};
}

Json json_of(const HarmonicFitReport& f, double equivalent_radius) {
  return {{"requested_degree", f.requested_degree},
          {"degree", f.degree},
          {"degree_limited_by", name_of(f.limit)},
          {"rays", f.rays},
          {"residual", f.residual},
          {"residual_percent_of_equivalent_radius", 100.0 * f.residual / equivalent_radius},
          {"smallest_radius", f.smallest_radius}};
}

Json json_of(const RelaxationReport& r) {
  Json displacement = Json::array();
  Json area_spread = Json::array();
  Json flips = Json::array();
  for (const RelaxationStep& step : r.history) {
    displacement.push_back(step.displacement);
    area_spread.push_back(step.area_spread);
    flips.push_back(step.flips);
  }
  Json levels = Json::array();
  for (const RelaxationLevel& level : r.coarser_levels) {
    levels.push_back({{"seeds", level.seeds},
                      {"iterations", level.iterations},
                      {"outcome", name_of(level.outcome)}});
  }
  return {{"outcome", name_of(r.outcome)},
          {"iterations", r.iterations},
          {"coarser_levels", std::move(levels)},
          {"rebuilds", r.rebuilds},
          {"weight_scale", r.weight_scale},
          {"history",
           {{"displacement", std::move(displacement)},
            {"area_spread", std::move(area_spread)},
            {"flips", std::move(flips)}}}};
}

Json json_of(const RefinementReport& r) {
  Json distance = Json::array();
  Json moves = Json::array();
  Json flips = Json::array();
  Json relocations = Json::array();
  for (const RefinementStep& step : r.history) {
    distance.push_back(step.distance);
    moves.push_back(step.moves);
    flips.push_back(step.flips);
    relocations.push_back(step.relocations);
  }
  return {{"converged", r.converged},
          {"start_distance", r.start_distance},
          {"history",
           {{"distance", std::move(distance)},
            {"moves", std::move(moves)},
            {"flips", std::move(flips)},
            {"relocations", std::move(relocations)}}}};
}

Json json_of(const OneSidedDistance& d) {
  return {{"maximum", d.maximum}, {"root_mean_square", d.root_mean_square}, {"mean", d.mean}};
}

Json json_of(const MeshDistances& d) {
  return {{"from_remesh", json_of(d.to_reference)},
          {"from_original", json_of(d.from_reference)},
          {"hausdorff", d.hausdorff},
          {"root_mean_square", d.root_mean_square}};
}

Json json_of(const NodeCountSearch& s) {
  Json trials = Json::array();
  for (const NodeCountTrial& trial : s.trials) {
    trials.push_back({{"node_count", trial.node_count}, {"error_percent", trial.error}});
  }
  return {{"met", s.met}, {"node_count", s.node_count}, {"trials", std::move(trials)}};
}

// ---- CSV

/// The columns of a CSV report, names and values side by side.
class Record {
 public:
  void add(const std::string& name, const std::string& value) {
    names_.push_back(name);
    values_.push_back(value);
  }
  void add(const std::string& name, double value) { add(name, format_exact(value)); }
  void add_count(const std::string& name, std::size_t value) { add(name, std::to_string(value)); }

  void add(const std::string& prefix, const MeshQuality& q) {
    add(prefix + "_edge_length_mean", q.edge_length.mean);
    add(prefix + "_edge_length_standard_deviation", q.edge_length.standard_deviation);
    add(prefix + "_edge_variation", q.edge_variation);
    add(prefix + "_edge_ratio_mean", q.edge_ratio.mean);
    add(prefix + "_edge_ratio_standard_deviation", q.edge_ratio.standard_deviation);
    add(prefix + "_edge_ratio_maximum", q.edge_ratio.maximum);
    add(prefix + "_smallest_angle_degrees", q.smallest_angle);
    add(prefix + "_mean_smallest_angle_degrees", q.mean_smallest_angle);
    add(prefix + "_valence_six_share", q.valence_six_share);
  }

  std::string text() const { return csv_record(names_) + csv_record(values_); }

 private:
  std::vector<std::string> names_;
  std::vector<std::string> values_;
};

}  // namespace

std::vector<std::string> report_lines(const RemeshResult& result) {
  std::vector<std::string> lines;
  append_input(result, lines);
  append_fit(result, lines);
  append_search(result, lines);
  append_relaxation(result, lines);
  append_refinement(result, lines);
  lines.push_back(line("Result", counted(result.mesh.points.size(), "node", "nodes") + ", " +
                                     counted(result.mesh.triangles.size(), "face", "faces") +
                                     (result.options.placement.kind == NodePlacement::LeastSquares
                                          ? ", nodes fitted by "
                                          : ", nodes on the ") +
                                     name_of(result.options.placement.kind)));
  append_distances(result, lines);
  append_quality(result, lines);
  for (std::string& text : table_lines(comparison(result), ComparisonNames())) {
    lines.push_back(std::move(text));
  }
  for (const std::string& warning : result.warnings) lines.push_back(line("Warning", warning));
  return lines;
}

std::string report_json(const RemeshResult& result) {
  Json report = {
      {"format", "wscvt-report"},
      {"version", 1},
      {"options", json_of(result.options)},
      {"input", json_of(result.input)},
      {"centre", json_of(result.centre)},
      {"folded_share", result.folded_share},
      {"fit", json_of(result.fit, result.input.equivalent_radius)},
      {"relaxation", json_of(result.relaxation)},
      {"result",
       {{"vertices", result.mesh.points.size()}, {"faces", result.mesh.triangles.size()}}},
      {"quality",
       {{"original", json_of(result.original_quality)}, {"remesh", json_of(result.quality)}}},
      {"descriptors", Json::parse(table_json(comparison(result), ComparisonNames()))},
      {"warnings", result.warnings},
  };
  if (!result.refinement.history.empty()) report["refinement"] = json_of(result.refinement);
  if (result.distances) report["distances"] = json_of(*result.distances);
  if (result.search) report["search"] = json_of(*result.search);
  // Warnings are the caller's too to add to, and may quote bytes that are not UTF-8.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_csv(const RemeshResult& result) {
  const RemeshOptions& options = result.options;
  Record record;
  record.add_count("nodes", result.mesh.points.size());
  record.add_count("faces", result.mesh.triangles.size());
  record.add("sampling", name_of(options.seeding.sampling));
  record.add("weighting", name_of(options.weighting.kind));
  record.add("curvature_alpha", options.weighting.curvature_alpha);
  record.add("adaptive_exponent", options.weighting.adaptive_exponent);
  record.add("curvature_source", name_of(options.weighting.curvature_source));
  record.add("placement", name_of(options.placement.kind));
  record.add("metric", name_of(options.relaxation.metric));
  record.add("refinement_rounds", std::to_string(options.placement.refinement.rounds));
  record.add("error_target_measure", name_of(options.target.measure));
  record.add("error_target_percent", options.target.percent);
  record.add("error_target_met", !result.search ? "" : result.search->met ? "true" : "false");
  record.add("fold_limit", options.surface.fold_limit);
  record.add("maximum_iterations", std::to_string(options.relaxation.maximum_iterations));
  record.add("seed_start", name_of(options.seeding.start));
  record.add("random_seed", std::to_string(options.seeding.random_seed));
  record.add_count("input_vertices", result.input.input_vertices);
  record.add_count("input_faces", result.input.input_faces);
  record.add_count("welded_vertices", result.input.welded_vertices);
  record.add_count("unreferenced_vertices", result.input.unreferenced_vertices);
  record.add_count("degenerate_faces", result.input.degenerate_faces);
  record.add_count("sliver_faces", result.input.sliver_faces);
  record.add_count("duplicate_faces", result.input.duplicate_faces);
  record.add_count("reoriented_faces", result.input.reoriented_faces);
  record.add_count("split_vertices", result.input.split_vertices);
  record.add_count("components", result.input.components);
  record.add_count("dropped_faces", result.input.dropped_faces);
  record.add("dropped_volume_share", result.input.dropped_volume_share);
  record.add_count("used_vertices", result.input.vertices);
  record.add_count("used_faces", result.input.faces);
  record.add("equivalent_radius", result.input.equivalent_radius);
  record.add("folded_share", result.folded_share);
  record.add("requested_degree", std::to_string(result.fit.requested_degree));
  record.add("degree", std::to_string(result.fit.degree));
  record.add("residual", result.fit.residual);
  record.add("outcome", name_of(result.relaxation.outcome));
  record.add("iterations", std::to_string(result.relaxation.iterations));
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  record.add("rms_distance", result.distances ? result.distances->root_mean_square : unknown);
  record.add("hausdorff_distance", result.distances ? result.distances->hausdorff : unknown);
  record.add("original", result.original_quality);
  record.add("remesh", result.quality);
  for (const DescriptorComparison& row : comparison(result)) {
    record.add(row.key + "_original", row.reference);
    record.add(row.key + "_remesh", row.value);
    record.add(row.key + "_error_percent", row.error_percent);
  }
  std::string warnings;
  for (const std::string& warning : result.warnings) {
    warnings += (warnings.empty() ? "" : " ") + warning;
  }
  record.add("warnings", warnings);
  return record.text();
}

}  // namespace wscvt
