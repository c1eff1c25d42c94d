// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/option.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

// Of a vector it would not be found from in here, where functions of its name hide it.
using wscvt::json_of;

/// Options under the names and with the values that one types. Whole numbers stay whole.
class OptionsToJson {
 public:
  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) {
    options_[std::string(option.key)] = value;
  }
  void operator()(const bool& value, const FlagOption& option) {
    options_[std::string(option.key)] = value;
  }
  template <class Enumeration>
  void operator()(const Enumeration& value) {
    options_[std::string(EnumerationTable<Enumeration>::key)] = key_of(value);
  }
  Json take() { return std::move(options_); }

 private:
  Json options_ = Json::object();
};

Json json_of(const MeshCheckReport& input) {
  return {{"vertices", input.input_vertices},
          {"faces", input.input_faces},
          {"lost_faces", input.lost_faces},
          {"welded_vertices", input.welded_vertices},
          {"weld_tolerance", input.weld_tolerance},
          {"unreferenced_vertices", input.unreferenced_vertices},
          {"degenerate_faces", input.degenerate_faces},
          {"sliver_faces", input.sliver_faces},
          {"duplicate_faces", input.duplicate_faces},
          {"duplicate_area_share", input.duplicate_area_share},
          {"folded_faces", input.folded_faces},
          {"folded_area_share", input.folded_area_share},
          {"non_manifold_edges", input.non_manifold_edges},
          {"flap_faces", input.flap_faces},
          {"flap_area_share", input.flap_area_share},
          {"filled_holes", input.filled_holes},
          {"filling_faces", input.filling_faces},
          {"filled_area_share", input.filled_area_share},
          {"reoriented_faces", input.reoriented_faces},
          {"split_vertices", input.split_vertices},
          {"components", input.components},
          {"inner_components", input.inner_components},
          {"inner_volume_share", input.inner_volume_share},
          {"dropped_faces", input.dropped_faces},
          {"dropped_volume_share", input.dropped_volume_share},
          {"used_vertices", input.vertices},
          {"used_faces", input.faces},
          {"genus", input.genus},
          {"centroid", json_of(input.centroid)},
          {"equivalent_radius", input.equivalent_radius}};
}

Json json_of(const HandleReport& handles) {
  Json cut = Json::array();
  for (const CutHandle& handle : handles.cut) {
    cut.push_back(
        {{"length", handle.length}, {"edges", handle.edges}, {"place", json_of(handle.place)}});
  }
  return {{"count", handles.cut.size()}, {"volume_change", handles.volume_change}, {"cut", cut}};
}

Json json_of(const SphereMapReport& map) {
  return {{"vertices", map.vertices},
          {"mean_angle_distortion", map.mean_angle_distortion},
          {"largest_angle_distortion", map.largest_angle_distortion},
          {"smallest_area_ratio", map.smallest_area_ratio},
          {"largest_area_ratio", map.largest_area_ratio}};
}

Json json_of(const SpaceNodesReport& space) {
  return {{"self_intersections", space.self_intersections},
          {"repairs", space.repairs},
          {"angle_weight", space.angle_weight},
          {"relocated_seeds", space.relocated_seeds},
          {"volume_loss_on_surface", space.volume_loss},
          {"enough_nodes", space.enough_nodes},
          {"mending_flips", space.mending.flips},
          {"mending_moves", space.mending.moves},
          {"mending_relocations", space.mending.relocations},
          {"mending_left", space.mending.left},
          {"fit_samples", space.fit.samples},
          {"fit_held_back", space.fit.held_back},
          {"fit_offset", space.fit.offset},
          {"evening_deviation_before", space.evening.deviation_before},
          {"evening_deviation_after", space.evening.deviation_after},
          {"evening_held_back", space.evening.held_back}};
}

Json json_of(const HarmonicFitReport& fit, double equivalent_radius) {
  return {{"requested_degree", fit.requested_degree},
          {"degree", fit.degree},
          {"degree_limited_by", key_of(fit.limit)},
          {"rays", fit.rays},
          {"residual", fit.residual},
          {"residual_percent_of_equivalent_radius", 100.0 * fit.residual / equivalent_radius},
          {"chord_error", fit.chord_error},
          {"smallest_radius", fit.smallest_radius}};
}

Json json_of(const RelaxationReport& relaxation) {
  Json displacement = Json::array();
  Json area_spread = Json::array();
  Json flips = Json::array();
  for (const RelaxationStep& step : relaxation.history) {
    displacement.push_back(step.displacement);
    area_spread.push_back(step.area_spread);
    flips.push_back(step.flips);
  }
  Json levels = Json::array();
  for (const RelaxationLevel& level : relaxation.coarser_levels) {
    levels.push_back({{"seeds", level.seeds},
                      {"iterations", level.iterations},
                      {"outcome", key_of(level.outcome)}});
  }
  Json report = {{"outcome", key_of(relaxation.outcome)},
                 {"iterations", relaxation.iterations},
                 {"displacement", nullptr},
                 {"area_spread", nullptr},
                 {"coarser_levels", std::move(levels)},
                 {"rebuilds", relaxation.rebuilds},
                 {"weight_scale", relaxation.weight_scale}};
  if (!relaxation.history.empty()) {
    report["displacement"] = relaxation.history.back().displacement;
    report["area_spread"] = relaxation.history.back().area_spread;
  }
  report["history"] = {{"displacement", std::move(displacement)},
                       {"area_spread", std::move(area_spread)},
                       {"flips", std::move(flips)}};
  return report;
}

// What was not asked for keeps its members, with null: tables of many reports need the same
// columns.

Json json_of(const RefinementReport& refinement) {
  Json distance = Json::array();
  Json moves = Json::array();
  Json flips = Json::array();
  Json relocations = Json::array();
  for (const RefinementStep& step : refinement.history) {
    distance.push_back(step.distance);
    moves.push_back(step.moves);
    flips.push_back(step.flips);
    relocations.push_back(step.relocations);
  }
  Json report = {{"rounds", refinement.history.size()},
                 {"converged", nullptr},
                 {"start_distance", nullptr},
                 {"distance", nullptr}};
  if (!refinement.history.empty()) {
    report["converged"] = refinement.converged;
    report["start_distance"] = refinement.start_distance;
    report["distance"] = refinement.history.back().distance;
  }
  report["history"] = {{"distance", std::move(distance)},
                       {"moves", std::move(moves)},
                       {"flips", std::move(flips)},
                       {"relocations", std::move(relocations)}};
  return report;
}

Json json_of(const std::optional<MeshDistances>& distances) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const OneSidedDistance none = {unknown, unknown, unknown};
  const MeshDistances shown = distances.value_or(MeshDistances{none, none, unknown, unknown});
  return {{"from_remesh", json_of(shown.to_reference)},
          {"from_original", json_of(shown.from_reference)},
          {"largest", shown.largest},
          {"root_mean_square", shown.root_mean_square}};
}

Json json_of(const std::optional<NodeCountSearch>& search) {
  Json report = {{"met", nullptr}, {"node_count", nullptr}, {"trials", Json::array()}};
  if (!search) return report;
  report["met"] = search->met;
  report["node_count"] = search->node_count;
  for (const NodeCountTrial& trial : search->trials) {
    report["trials"].push_back({{"node_count", trial.node_count}, {"error_percent", trial.error}});
  }
  return report;
}

Json json_of(const std::vector<TriedChange>& tried) {
  Json list = Json::array();
  for (const TriedChange& one : tried) {
    list.push_back({{"with", one.change},
                    {"misfit_percent_of_equivalent_radius", 100.0 * one.misfit},
                    {"area_error_percent", 100.0 * one.area_off}});
  }
  return list;
}

Json report_of(const RemeshResult& result, const ReportOrigin& origin) {
  const std::vector<DescriptorComparison> comparison =
      compare_descriptors(list_descriptors(result.original), list_descriptors(result.remesh));
  return {
      {"format", "wscvt-report"},
      {"version", 2},
      {"made_by", made_by()},
      {"source", told(origin.source)},
      {"date", told(origin.date)},
      {"options", json_of(result.options)},
      {"input", json_of(result.input)},
      {"handles", json_of(result.handles)},
      {"centre", json_of(result.centre)},
      {"folded_share", result.folded_share},
      {"steep_share", result.steep_share},
      {"parametrization", key_of(result.parametrization)},
      {"map", json_of(result.map)},
      {"map_degree", result.map_degree},
      {"space", json_of(result.space)},
      {"fit", json_of(result.fit, result.input.equivalent_radius)},
      {"relaxation", json_of(result.relaxation)},
      {"refinement", json_of(result.refinement)},
      {"search", json_of(result.search)},
      {"result",
       {{"vertices", result.mesh.points.size()}, {"faces", result.mesh.triangles.size()}}},
      {"quality",
       {{"original", json_of(result.original_quality)}, {"remesh", json_of(result.quality)}}},
      {"misfit",
       {{"root_mean_square", result.misfit},
        {"percent_of_equivalent_radius", 100.0 * result.misfit / result.input.equivalent_radius}}},
      {"tried", json_of(result.tried)},
      {"distances", json_of(result.distances)},
      {"descriptors", json_of(comparison, ComparisonNames())},
      {"descriptor_names", json_names_of(comparison)},
      {"mass",
       {{"original", json_of(mass_properties(result.original))},
        {"remesh", json_of(mass_properties(result.remesh))}}},
      {"warnings", result.warnings},
  };
}

}  // namespace

Json json_of(const RemeshOptions& options) {
  OptionsToJson visitor;
  for_each_option(options, visitor);
  return visitor.take();
}

std::string report_json(const RemeshResult& result, const ReportOrigin& origin) {
  return json_document(report_of(result, origin));
}

std::string report_csv(const RemeshResult& result, const ReportOrigin& origin) {
  return csv_of(report_of(result, origin));
}

}  // namespace wscvt
