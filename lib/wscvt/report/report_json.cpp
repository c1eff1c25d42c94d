// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/option.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report_addition.h"

namespace wscvt {

namespace {

// Functions of this name in here would hide the overload for vectors.
using wscvt::json_of;

Json json_of(const MeshCheckReport& input) {
  return {{"vertices", input.input_vertices},
          {"faces", input.input_faces},
          {"lost_faces", input.lost_faces},
          {"welded_vertices", input.welded_vertices},
          {"weld_tolerance", input.weld_tolerance},
          {"merged_corners", input.merged_corners},
          {"merged_distance", input.merged_distance},
          {"unreferenced_vertices", input.unreferenced_vertices},
          {"degenerate_faces", input.degenerate_faces},
          {"sliver_faces", input.sliver_faces},
          {"duplicate_faces", input.duplicate_faces},
          {"duplicate_area_fraction", input.duplicate_area_fraction},
          {"back_to_back_faces", input.back_to_back_faces},
          {"back_to_back_area_fraction", input.back_to_back_area_fraction},
          {"non_manifold_edges", input.non_manifold_edges},
          {"flap_faces", input.flap_faces},
          {"flap_area_fraction", input.flap_area_fraction},
          {"filled_holes", input.filled_holes},
          {"filling_faces", input.filling_faces},
          {"filled_area_fraction", input.filled_area_fraction},
          {"reoriented_faces", input.reoriented_faces},
          {"split_vertices", input.split_vertices},
          {"components", input.components},
          {"inner_components", input.inner_components},
          {"inner_volume_fraction", input.inner_volume_fraction},
          {"dropped_faces", input.dropped_faces},
          {"dropped_volume_fraction", input.dropped_volume_fraction},
          {"used_vertices", input.vertices},
          {"used_faces", input.faces},
          {"genus", input.genus},
          {"centroid", json_of(input.centroid)},
          {"equivalent_radius", input.equivalent_radius},
          {"voxel_steps", input.has_voxel_steps}};
}

Json json_of(const CutHandle& handle) {
  return {{"loop", handle.length}, {"edges", handle.edges}, {"place", json_of(handle.place)}};
}

Json json_of(const HandleReport& handles) {
  Json cut = Json::array();
  for (const CutHandle& handle : handles.cut) cut.push_back(json_of(handle));
  return {{"count", handles.cut.size()},
          {"kept", handles.kept},
          {"volume_change", handles.volume_change},
          {"cut", cut}};
}

Json json_of(const OnScanReport& report) {
  const ScanNodesReport& nodes = report.nodes;
  return {{"handles", json_of(report.handles)},
          {"genus", nodes.genus},
          {"split_vertices", nodes.split_vertices},
          {"coarsened_vertices", nodes.proxy_vertices},
          {"equalization_steps", nodes.equalization_steps},
          {"equalization_flips", nodes.equalization_flips},
          {"fit_rounds", nodes.fit_rounds},
          {"fit_flips", nodes.fit_flips},
          {"fit_relocations", nodes.relocations},
          {"volume_offset", nodes.volume_offset},
          {"mean_edge_ratio", nodes.mean_edge_ratio},
          {"removed_intersections", nodes.repaired_intersections},
          {"self_intersections", nodes.self_intersections}};
}

Json json_of(const HarmonicFitReport& fit, double equivalent_radius) {
  return {{"requested_degree", fit.requested_degree},
          {"degree", fit.degree},
          {"degree_limited_by", key_of(fit.limit)},
          {"rays", fit.rays},
          {"residual", fit.residual},
          {"residual_percent_of_equivalent_radius", 100.0 * fit.residual / equivalent_radius},
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

Json json_of(const AsPublishedReport& report, double equivalent_radius) {
  return {{"overhang_fraction", report.overhang_fraction},
          {"fit", json_of(report.fit, equivalent_radius)},
          {"relaxation", json_of(report.relaxation)}};
}

/// Members without values: all reports of a table need equal columns.
Json nulled(const Json& json) {
  if (json.is_array()) return Json::array();
  if (!json.is_object()) return nullptr;
  Json result = Json::object();
  for (const auto& [key, value] : json.items()) result[key] = nulled(value);
  return result;
}

// Results that were not requested keep their members, with null.

Json json_of(const std::optional<MeshDistances>& distances) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const OneSidedDistance none = {unknown, unknown, unknown};
  const MeshDistances shown = distances.value_or(MeshDistances{none, none, unknown, unknown});
  return {{"from_remesh", json_of(shown.to_reference)},
          {"from_scan", json_of(shown.from_reference)},
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

Json report_of(const RemeshResult& result, const ReportOrigin& origin) {
  const OnScanReport* on_scan = on_scan_report(result);
  const AsPublishedReport* published = as_published_report(result);
  const std::vector<DescriptorComparison> comparison =
      compare_descriptors(list_descriptors(result.scan), list_descriptors(result.remesh));
  return {
      {"format", "wscvt-report"},
      {"version", 3},
      {"made_by", made_by()},
      {"source", told(origin.source)},
      {"date", told(origin.date)},
      {"options", json_of(result.options)},
      {"input", json_of(result.input)},
      {"centre", json_of(result.centre)},
      {"steep_area_fraction", result.steep_area_fraction},
      {"on_scan", on_scan != nullptr ? json_of(*on_scan) : nulled(json_of(OnScanReport()))},
      {"as_published", published != nullptr ? json_of(*published, result.input.equivalent_radius)
                                            : nulled(json_of(AsPublishedReport(), 1.0))},
      {"node_count_search", json_of(result.search)},
      {"result",
       {{"vertices", result.mesh.points.size()}, {"faces", result.mesh.triangles.size()}}},
      {"quality", {{"scan", json_of(result.scan_quality)}, {"remesh", json_of(result.quality)}}},
      {"rms_distance",
       {{"two_sided", result.rms_distance},
        {"percent_of_equivalent_radius",
         100.0 * result.rms_distance / result.input.equivalent_radius}}},
      {"largest_distance",
       {{"two_sided", result.largest_distance},
        {"percent_of_equivalent_radius",
         100.0 * result.largest_distance / result.input.equivalent_radius}}},
      {"distances", json_of(result.distances)},
      {"descriptors", json_of(comparison, ComparisonNames())},
      {"descriptor_names", json_names_of(comparison)},
      {"mass",
       {{"scan", json_of(mass_properties(result.scan))},
        {"remesh", json_of(mass_properties(result.remesh))}}},
      {"warnings", report_warnings(result)},
  };
}

}  // namespace

Json json_of(const RemeshOptions& options) {
  // All keys of both methods, in one order. Keys of the other method stay null.
  const RemeshOptions on_scan;
  const AsPublishedOptions published;
  OptionsJson keys;
  for_each_option(on_scan, keys);
  for_each_method_option(published, keys);
  Json json = nulled(keys.take());
  OptionsJson values;
  const RemeshOptions given = as_given(options);
  for_each_option(given, values);
  json.update(values.take());
  return json;
}

std::string report_json(const RemeshResult& result, const ReportOrigin& origin,
                        const std::vector<ReportAddition>& additions) {
  Json report = report_of(result, origin);
  for (const ReportAddition& addition : additions) {
    for (const auto& [key, count] : addition.counts) report[addition.key][key] = count;
    for (const auto& [key, value] : addition.values) report[addition.key][key] = value;
  }
  return json_document(report);
}

std::string report_json(const RemeshResult& result, const ReportOrigin& origin) {
  return report_json(result, origin, {});
}

std::string report_csv(const RemeshResult& result, const ReportOrigin& origin) {
  return csv_of(report_of(result, origin));
}

}  // namespace wscvt
