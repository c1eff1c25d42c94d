// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/remesh_warnings.h"

#include <cmath>

#include "wscvt/base/text_format.h"
#include "wscvt/repair/scan_advice.h"

namespace wscvt {

namespace {

using Sentences = std::vector<Sentence>;

/// Fraction of steep area above which points are assumed to lie behind each other. A surface was
/// made of the points of 22 real scans: the fraction is up to .039 if the remesh follows this
/// surface (area within 2 %, but for one of 4 %), .087 to .68 if it loses 3 to 50 % of its area.
constexpr double steep_points_limit = 0.06;

void warn_of_scan(const RemeshResult& result, Sentences& warnings) {
  const bool wraps = result.options.shrink_wrap.opening_percent > 0.0;
  const std::size_t faces = result.options.points ? result.input.input_faces : 0;
  const std::string unused =
      faces > 0 ? ", its " + std::to_string(faces) + " faces were not used" : std::string();
  if (result.options.points && !wraps) {
    warnings.push_back(
        "The scan was read as points" + unused +
        ". Volume and area of the scan are measured on a star-shaped surface built through the "
        "points. Overhangs of the body are lost. Check the result against the body.");
    if (result.steep_area_fraction > steep_points_limit) {
      warnings.push_back(
          format_percent(result.steep_area_fraction) +
          " of the area of the surface through the points is inclined more than 75 degrees to the "
          "radius. Some points probably lie behind others, as in an overhang. " +
          surface_of_points_advice());
    }
  }
  if (wraps) {
    warnings.push_back(
        "The scan was replaced by its shrink-wrap" + unused +
        ". Volume, area and distances are measured against the shrink-wrap. It closes gaps up "
        "to " +
        format_percent(0.01 * result.options.shrink_wrap.opening_percent) +
        " of the bounding-box diagonal. Check the result against the scan.");
  }
  const MeshCheckReport& input = result.input;
  if (input.has_voxel_steps) warnings.push_back(voxel_steps_advice("The scan"));
  append_repair_warnings(input, "remeshed", warnings);
}

void warn_of_handles(const RemeshResult& result, Sentences& warnings) {
  const OnScanReport* report = on_scan_report(result);
  if (report == nullptr) {
    if (result.input.genus == 0) return;
    warnings.push_back("The scan has " + format_count(result.input.genus, "handle") +
                       " (tunnels through the grain). The published method closes them.");
    return;
  }
  const HandleReport& handles = report->handles;
  if (!handles.cut.empty()) {
    const std::size_t cut = handles.cut.size();
    warnings.push_back(format_count(cut, "handle") + " of the scan " + (cut == 1 ? "was" : "were") +
                       " cut. This changed its volume by " +
                       format_percent(std::abs(handles.volume_change)) + ". The log says where.");
  }
  if (handles.kept > 0) {
    warnings.push_back("The grain has " + format_count(handles.kept, "handle") +
                       " (tunnels through it).");
  }
}

void warn_of_self_intersections(const RemeshResult& result, Sentences& warnings) {
  const OnScanReport* report = on_scan_report(result);
  if (report == nullptr) return;
  const std::string nodes = std::to_string(result.mesh.points.size()) + " nodes";
  const std::size_t pairs = report->nodes.self_intersections;
  if (pairs == 0) return;
  Sentence text = format_count(pairs, "pair") + " of triangles of the remesh intersect. ";
  const std::size_t of_scan = report->nodes.scan_self_intersections;
  if (of_scan > 0) {
    text += "The scan has " + std::to_string(of_scan) + " such pairs itself. ";
    text += result.clean_wrap_percent > 0.0
                ? "Its shrink-wrap was tried with as many nodes and has none: use " +
                      mention(shrink_wrap_option, result.clean_wrap_percent) +
                      ", and check the result against the scan."
                : Sentence("Repair the scan first.");
  } else {
    text += "Parts of the grain are closer together than " + nodes + " can follow. ";
    text += report->enough_nodes > 0 ? "Use " + std::to_string(report->enough_nodes) +
                                           " nodes: with this number no triangles intersect."
                                     : "Use more nodes.";
  }
  warnings.push_back(text);
}

void warn_of_fit(const RemeshResult& result, Sentences& warnings) {
  const AsPublishedReport* report = as_published_report(result);
  if (report == nullptr) return;
  if (report->overhang_fraction > overhang_warning_limit) {
    warnings.push_back(
        "Overhangs of the grain cover " + format_percent(report->overhang_fraction) +
        " of the sphere. The remesh has only the outermost surface there. Check the result "
        "against the scan.");
  }
  const HarmonicFitReport& fit = report->fit;
  if (fit.degree < fit.requested_degree) {
    warnings.push_back("The degree of the SH series was lowered from " +
                       std::to_string(fit.requested_degree) + " to " + std::to_string(fit.degree) +
                       ". At higher degrees the radius is not positive everywhere, because the "
                       "grain is long, flat or sharp.");
  }
  const auto& options = std::get<AsPublishedOptions>(result.options.method);
  // For nodes on the scan, the series only decides the cells.
  if (options.placement != PublishedPlacement::Series) return;
  const double residual = fit.residual / result.input.equivalent_radius;
  if (residual > residual_warning_limit && !result.input.has_voxel_steps) {
    warnings.push_back(
        "The SH surface is " + format_percent(residual) +
        " of the equivalent radius (rms) away from the scan. " +
        (fit.limit == DegreeLimit::None ? "Raise " + mention(harmonic_degree_option) + ", or use "
                                        : Sentence("Use ")) +
        mention(PublishedPlacement::Surface) + " or " + mention(Method::OnScan) + ".");
  }
}

void warn_of_relaxation(const RemeshResult& result, Sentences& warnings) {
  const AsPublishedReport* report = as_published_report(result);
  if (report == nullptr) return;
  const auto& options = std::get<AsPublishedOptions>(result.options.method);
  const RelaxationReport& relaxation = report->relaxation;
  if (options.sampling != Sampling::Weighted) {
    const auto nodes = static_cast<int>(result.mesh.points.size());
    if (nodes != result.options.node_count) {
      warnings.push_back("The sampling " + key_of(options.sampling) + " does not exist with " +
                         std::to_string(result.options.node_count) +
                         " nodes. The nearest possible number, " + std::to_string(nodes) +
                         ", was used.");
    }
  } else if (relaxation.outcome == RelaxationOutcome::Settled) {
    warnings.push_back("The relaxation stopped improving. The cell areas still vary by " +
                       format_percent(relaxation.history.back().area_spread) +
                       " around their targets. More nodes give more even cells.");
  } else if (relaxation.outcome == RelaxationOutcome::Stuck) {
    warnings.push_back("The relaxation stopped after " + std::to_string(relaxation.iterations) +
                       " iterations, because even a short further step could not be triangulated. "
                       "The mesh is valid but may be less even.");
  } else if (relaxation.outcome == RelaxationOutcome::IterationLimit) {
    warnings.push_back("The relaxation stopped at its limit of " +
                       std::to_string(relaxation.iterations) +
                       " iterations before it converged. The mesh is valid but may be less even.");
  }
  if (relaxation.weight_scale < 1.0) {
    warnings.push_back("The differences between the weights were multiplied by " +
                       format_number(relaxation.weight_scale, 3) +
                       ", because seeds would have lost their cells. " +
                       (options.weighting == Weighting::Curvature
                            ? "Lower " + mention(curvature_alpha_option) + "."
                            : Sentence("Use more nodes, or another weighting.")));
  }
}

/// Returns what brings a remesh with these options closer to the scan.
Sentence closer_by(const RemeshOptions& options) {
  const auto* on_scan = std::get_if<OnScanOptions>(&options.method);
  if (on_scan == nullptr) return "Use more nodes, or " + mention(Method::OnScan) + ".";
  if (on_scan->placement != ScanPlacement::Fitted) {
    return "Use more nodes, or " + mention(ScanPlacement::Fitted) + ", which keeps the volume.";
  }
  // With 40 and 100 nodes on six real grains the rms distance became 0.36 to 0.67 of what it was at
  // 1.105, near the default, 0.5 in the mean; with 1000 nodes on six others 0.53.
  constexpr double closer_edge_ratio = 1.4;
  if (on_scan->edge_ratio >= closer_edge_ratio) return "Use more nodes.";
  return "Use more nodes, or " + mention(edge_ratio_option, closer_edge_ratio) +
         ": with as many nodes, it usually halves the rms distance.";
}

bool is_contact_fit(const RemeshResult& result) {
  const auto* on_scan = std::get_if<OnScanOptions>(&result.options.method);
  return on_scan != nullptr && on_scan->placement == ScanPlacement::ContactFit;
}

std::string signed_percent(double share) {
  return (share < 0.0 ? "-" : "+") + format_percent(std::abs(share));
}

void warn_of_distance(const RemeshResult& result, Sentences& warnings) {
  if (!is_inaccurate(result)) return;
  Sentence text = "The remesh is not accurate: rms distance " +
                  format_percent(result.rms_distance / result.input.equivalent_radius) +
                  " of the equivalent radius, largest " +
                  format_percent(result.largest_distance / result.input.equivalent_radius) +
                  ", area error " + signed_percent(result.remesh.area / result.scan.area - 1.0);
  if (is_contact_fit(result)) {
    text += ", volume error " + signed_percent(result.remesh.volume / result.scan.volume - 1.0);
  }
  text += ". ";
  text += closer_by(result.options);
  warnings.push_back(text);
}

/// Warns of nodes that have nothing to follow.
void warn_of_detail(const RemeshResult& result, Sentences& warnings) {
  const std::size_t vertices = result.input.input_vertices;
  if (vertices == 0 || result.options.points || result.mesh.points.size() <= vertices) return;
  warnings.push_back("The scan has " + std::to_string(vertices) + " vertices, fewer than the " +
                     std::to_string(result.mesh.points.size()) +
                     " nodes. It has no such detail: nodes between its vertices only follow its "
                     "flat faces.");
}

Sentence other_body_sentence(const RemeshResult& result) {
  const double area = result.remesh.area / result.scan.area - 1.0;
  if (as_published_report(result) == nullptr || std::abs(area) <= other_body_limit) return "";
  return "The remesh is another body: its area is " + format_percent(std::abs(area)) +
         (area < 0.0 ? " smaller" : " larger") +
         " than the scan's. The published method does not suit long, flat or sharp grains. Use " +
         mention(Method::OnScan) + ".";
}

/// Warns of angles below 20 degrees. On the scan, ordinary grains have angles above 35 degrees.
void warn_of_angles(const RemeshResult& result, Sentences& warnings) {
  constexpr double jammed = 20.0;
  if (on_scan_report(result) == nullptr) return;
  const double smallest = result.quality.smallest_angle;
  if (smallest >= jammed) return;
  Sentence text = "The smallest angle is " + format_number(smallest, 3) + " degrees: ";
  text += is_contact_fit(result)
              ? "the contact fit moves nodes off their even places. If angles count, use " +
                    mention(ScanPlacement::Fitted) + "."
              : Sentence(
                    "a thin or sharp part of the grain has no room for better triangles. Try "
                    "another number of nodes.");
  warnings.push_back(text);
}

void warn_of_search(const RemeshResult& result, Sentences& warnings) {
  if (result.search && !result.search->met) {
    warnings.push_back(
        "No number of nodes up to " + std::to_string(result.search->node_count) +
        " has an error of at most " + format_percent(0.01 * result.options.target.percent) +
        ". This is the result with that number. Give a larger " + mention(node_count_option) +
        ", or a larger " + mention(error_target_option) + ".");
  }
}

}  // namespace

bool is_inaccurate(const RemeshResult& result) {
  if (result.input.has_voxel_steps) return false;
  const bool is_off = is_contact_fit(result);
  const double times = is_off ? 2.0 : 1.0;
  const double unit = times * result.input.equivalent_radius;
  const auto error = [](double value, double of_scan) { return std::abs(value / of_scan - 1.0); };
  return result.rms_distance > distance_warning_limit * unit ||
         result.largest_distance > largest_warning_limit * unit ||
         error(result.remesh.area, result.scan.area) > times * area_warning_limit ||
         (is_off && error(result.remesh.volume, result.scan.volume) > contact_volume_limit);
}

void append_repair_warnings(const MeshCheckReport& input, const std::string& done,
                            std::vector<Sentence>& warnings) {
  const std::size_t bodies = input.components - input.inner_components;
  if (input.components > input.inner_components + 1) {
    warnings.push_back("The scan has " + std::to_string(bodies) +
                       " separate bodies. Only the largest was " + done + ".");
  }
  if (input.inner_components > 0) {
    warnings.push_back(
        "The scan has " + format_count(input.inner_components, "surface") +
        " inside its outer one, around " + format_percent(input.inner_volume_fraction) +
        " of its volume. Only the outer one was " + done + ", as a body without pores.");
  }
  if (input.stray_distance > 0.0) {
    warnings.push_back(stray_vertex_sentence(input) + " Check that it belongs to the scan.");
  }
  if (input.merged_corners > 0) {
    warnings.push_back(merged_warning(input.merged_corners, input.merged_distance));
  }
  const double mended = input.flap_area_fraction + input.filled_area_fraction;
  if (mended > 0.0) {
    warnings.push_back("Holes and non-manifold edges of the scan were repaired. This changed " +
                       format_percent(mended) + " of its area. Check the result against the scan.");
  }
}

std::vector<Sentence> scan_warnings(const RemeshResult& result) {
  Sentences warnings;
  warn_of_scan(result, warnings);
  warn_of_handles(result, warnings);
  return warnings;
}

std::vector<Sentence> remesh_warnings(const RemeshResult& result, const std::string& of_precision) {
  Sentences warnings = scan_warnings(result);
  if (!of_precision.empty()) warnings.insert(warnings.begin(), of_precision);
  const Sentence other_body = other_body_sentence(result);
  if (!other_body.empty()) warnings.insert(warnings.begin(), other_body);
  warn_of_detail(result, warnings);
  warn_of_fit(result, warnings);
  warn_of_distance(result, warnings);
  warn_of_self_intersections(result, warnings);
  warn_of_relaxation(result, warnings);
  warn_of_angles(result, warnings);
  warn_of_search(result, warnings);
  return warnings;
}

}  // namespace wscvt
