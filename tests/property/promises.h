// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "property/choices.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/remesh.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/new_surface.h"
#include "wscvt/report/report.h"
#include "wscvt/surface/self_intersections.h"

/// What the library promises for every input, as checks that name what is broken; an empty sentence
/// means that all is kept. The property tests and the fuzz targets share them.
namespace wscvt::test {

/// Closed, oriented, connected, one fan of faces at each vertex, every vertex used.
inline std::string broken_surface(const IndexedMesh& mesh) {
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> face_of;  // by directed edge
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] < 0 || t[k] >= count) return "an index out of range";
      if (t[k] == t[(k + 1) % 3]) return "a face with two equal corners";
      if (!face_of.emplace(std::make_pair(t[k], t[(k + 1) % 3]), f).second) {
        return "an edge that two faces run along in the same way";
      }
    }
  }
  for (const auto& [edge, face] : face_of) {
    if (face_of.count({edge.second, edge.first}) == 0) return "an open edge";
  }
  std::vector<std::size_t> corners(mesh.points.size(), 0);
  std::vector<std::pair<std::int32_t, std::int32_t>> start(mesh.points.size());
  for (const auto& [edge, face] : face_of) {
    ++corners[static_cast<std::size_t>(edge.first)];
    start[static_cast<std::size_t>(edge.first)] = edge;
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (corners[v] == 0) return "an unused vertex";
    std::size_t met = 0;
    auto edge = start[v];
    do {  // to the third vertex of the face on the left
      const Triangle& t = mesh.triangles[face_of.at(edge)];
      std::size_t k = 0;
      while (t[k] != edge.first) ++k;
      edge.second = t[(k + 2) % 3];
      ++met;
    } while (edge != start[v] && met <= corners[v]);
    if (met != corners[v]) return "a vertex with several fans";
  }
  std::vector<char> seen(mesh.triangles.size(), 0);
  std::vector<std::size_t> stack = {0};
  std::size_t reached = 0;
  seen[0] = 1;
  while (!stack.empty()) {
    const Triangle t = mesh.triangles[stack.back()];
    stack.pop_back();
    ++reached;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = face_of.at({t[(k + 1) % 3], t[k]});
      if (seen[next] == 0) stack.push_back(next);
      seen[next] = 1;
    }
  }
  return reached == seen.size() ? "" : "several parts";
}

inline bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// A refusal has a code that fits and a sentence.
inline std::string broken_refusal(const Error& error) {
  const std::string sentence = error.what();
  if (error.code() == ErrorCode::InputOutput || error.code() == ErrorCode::Cancelled) {
    return "a refusal with the wrong code: " + sentence;
  }
  if (sentence.size() < 30 || sentence.back() != '.' ||
      std::isupper(static_cast<unsigned char>(sentence.front())) == 0) {
    return "a refusal without a sentence: " + sentence;
  }
  return "";
}

inline std::string broken_check(const IndexedMesh& input, const MeshCheckOptions& options) {
  try {
    const CheckedMesh checked = check_mesh(input, options, Execution(1));
    const std::string broken = broken_surface(checked.mesh);
    if (!broken.empty()) return "checked mesh: " + broken;
    const MeshCheckReport& report = checked.report;
    for (const Vector3& p : checked.mesh.points) {
      if (!p.allFinite()) return "checked mesh: a coordinate that is not finite";
    }
    if (!all_finite({report.volume, report.area, report.equivalent_radius, report.centroid.x(),
                     report.centroid.y(), report.centroid.z(), report.duplicate_area_fraction,
                     report.back_to_back_area_fraction, report.flap_area_fraction,
                     report.filled_area_fraction, report.inner_volume_fraction,
                     report.dropped_volume_fraction}) ||
        !(report.volume > 0.0 && report.area > 0.0) || report.genus < 0) {
      return "a measure in the report of the check";
    }
    if (report.vertices != checked.mesh.points.size() ||
        report.faces != checked.mesh.triangles.size() ||
        report.faces + report.lost_faces + report.degenerate_faces + report.duplicate_faces +
                report.back_to_back_faces + report.flap_faces + report.dropped_faces <
            report.input_faces) {
      return "the counts in the report of the check";
    }
    if (report.flap_area_fraction + report.filled_area_fraction >
        0.01 * options.repaired_area_limit_percent) {
      return "more mended than the limit";
    }
    const CheckedMesh two = check_mesh(input, options, Execution(2));
    if (two.mesh.points != checked.mesh.points || two.mesh.triangles != checked.mesh.triangles) {
      return "two threads check differently from one";
    }
  } catch (const Error& error) {
    return broken_refusal(error);
  }
  return "";
}

/// The envelope of anything is a surface about a volume, or refused.
inline std::string broken_envelope(const IndexedMesh& input, double opening_percent) {
  try {
    const ShrinkWrapOptions options = {opening_percent};
    const IndexedMesh shrink_wrap = shrink_wrap_of(input, options, Execution(1));
    const std::string broken = broken_surface(shrink_wrap);
    // Of bodies apart from each other there is one envelope each.
    if (!broken.empty() && broken != "several parts") return "envelope: " + broken;
    for (const Vector3& p : shrink_wrap.points) {
      if (!p.allFinite()) return "envelope: a coordinate that is not finite";
    }
    const IndexedMesh again = shrink_wrap_of(input, options, Execution(2));
    if (again.points != shrink_wrap.points || again.triangles != shrink_wrap.triangles) {
      return "the same envelope twice differs";
    }
  } catch (const Error& error) {
    return broken_refusal(error);
  }
  return "";
}

/// Any options of the check within their ranges.
inline MeshCheckOptions random_check_options(Choices& choices) {
  MeshCheckOptions options;
  options.repaired_area_limit_percent = choices.one_in(2) ? 100.0 : choices.real(0.0, 100.0);
  options.weld_tolerance = choices.one_in(2) ? 1e-12 : choices.real(0.0, 0.01);
  options.dropped_volume_limit = 0.99;
  return options;
}

inline AsPublishedOptions random_published_options(Choices& choices) {
  AsPublishedOptions o;
  if (choices.one_in(4)) o.sampling = static_cast<Sampling>(choices.whole(0, 3));
  o.weighting = static_cast<Weighting>(choices.whole(0, 3));
  o.curvature_alpha = choices.one_in(2) ? 1.0 : choices.real(-3.0, 3.0);
  o.placement = static_cast<PublishedPlacement>(choices.whole(0, 1));
  o.max_overhang_percent = choices.one_in(2) ? 5.0 : choices.real(0.0, 99.0);
  return o;
}

inline OnScanOptions random_scan_options(Choices& choices) {
  OnScanOptions o;
  o.weighting = static_cast<CellWeighting>(choices.whole(0, 2));
  o.curvature_alpha = choices.one_in(2) ? 1.0 : choices.real(-3.0, 3.0);
  o.placement = static_cast<ScanPlacement>(choices.whole(0, 2));
  if (choices.one_in(2)) o.contact_radius = choices.real(0.1, 6.0);
  if (choices.one_in(2)) o.edge_ratio = choices.real(1.08, 1.6);
  o.handles.action = static_cast<HandleAction>(choices.whole(0, 2));
  if (choices.one_in(4)) o.handles.length_limit = choices.real(0.0, 3.0);
  return o;
}

/// Any options within their ranges.
inline RemeshOptions random_options(Choices& choices) {
  RemeshOptions o;
  o.node_count = choices.one_in(4) ? choices.whole(4, 14) : choices.whole(4, 300);
  bool any_count = true;
  if (choices.one_in(3)) {
    const AsPublishedOptions published = random_published_options(choices);
    any_count =
        published.sampling == Sampling::Weighted || published.sampling == Sampling::Fibonacci;
    o.method = published;
  } else {
    o.method = random_scan_options(choices);
  }
  o.degree = choices.whole(1, 30);
  o.measures.distances = choices.one_in(8);
  o.measures.node_curvatures = choices.one_in(2);
  o.points = choices.one_in(16);
  o.max_repaired_area_percent = choices.one_in(2) ? 5.0 : choices.real(0.0, 100.0);
  if (choices.one_in(16) && any_count) {
    o.target.percent = std::pow(10.0, choices.real(-1.0, 2.0));
    o.target.measure = static_cast<ErrorMeasure>(choices.whole(0, 3));
    o.target.largest_node_count = choices.whole(4, 200);
  }
  return o;
}

/// The reports hold no "nan" or "inf" where a number belongs, and can be parsed.
inline std::string broken_report(const RemeshResult& result) {
  for (const std::string& line : report_lines(result)) {
    for (const char* word : {"nan", "inf"}) {
      for (std::size_t at = 0; (at = line.find(word, at)) != std::string::npos; ++at) {
        const auto letter = [&](std::size_t i) {
          return i < line.size() && std::isalpha(static_cast<unsigned char>(line[i])) != 0;
        };
        if (!(at > 0 && letter(at - 1)) && !letter(at + 3)) return "the log: " + line;
      }
    }
  }
  if (nlohmann::json::parse(report_json(result), nullptr, false).is_discarded()) return "the JSON";
  const std::string csv = report_csv(result);
  std::vector<std::size_t> fields = {1};
  bool quoted = false;
  for (const char c : csv) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ',') ++fields.back();
    if (c == '\n') fields.push_back(1);
  }
  return fields.size() == 3 && fields[0] == fields[1] ? "" : "the rows of the CSV";
}

/// What the report says of a mesh, measured by plain sums over its triangles.
inline std::string broken_measures(const RemeshResult& result) {
  const Vector3 about = result.mesh.points.front();
  const auto point = [&](std::int32_t v) -> Vector3 {
    return result.mesh.points[static_cast<std::size_t>(v)] - about;
  };
  double volume = 0.0;
  double area = 0.0;
  double ratios = 0.0;
  double angle = 180.0;
  for (const auto& [a, b, c] : result.mesh.triangles) {
    volume += point(a).dot(point(b).cross(point(c))) / 6.0;
    area += 0.5 * (point(b) - point(a)).cross(point(c) - point(a)).norm();
    const double l[] = {(point(b) - point(c)).norm(), (point(c) - point(a)).norm(),
                        (point(a) - point(b)).norm()};
    ratios += *std::max_element(l, l + 3) / *std::min_element(l, l + 3);
    for (int k = 0; k < 3; ++k) {
      const double p = l[(k + 1) % 3];
      const double q = l[(k + 2) % 3];
      const double cosine = (p * p + q * q - l[k] * l[k]) / (2.0 * p * q);
      angle = std::min(angle, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / 3.14159265358979);
    }
  }
  ratios /= static_cast<double>(result.mesh.triangles.size());
  const auto off = [](double value, double other) {
    return !(std::abs(value / other - 1.0) < 1e-6);
  };
  if (off(result.remesh.volume, volume)) return "the volume in the report";
  if (off(result.remesh.area, area)) return "the area in the report";
  if (off(result.quality.edge_ratio.mean, ratios)) return "the edge ratio in the report";
  // A cosine near 1 has half the digits of its angle.
  if (!(std::abs(result.quality.smallest_angle - angle) < 1e-3)) return "the smallest angle";
  const OnScanReport* report = on_scan_report(result);
  if (report == nullptr) return "";
  const std::size_t pairs = self_intersections(result.mesh).size();
  if (report->nodes.self_intersections != pairs) {
    return std::to_string(pairs) + " pairs that meet, where the report has " +
           std::to_string(report->nodes.self_intersections);
  }
  return "";
}

inline std::string broken_result(const RemeshResult& result, const RemeshOptions& options) {
  const IndexedMesh& mesh = result.mesh;
  const std::size_t nodes = mesh.points.size();
  const auto* published = std::get_if<AsPublishedOptions>(&options.method);
  const bool any_count = published == nullptr || published->sampling == Sampling::Weighted ||
                         published->sampling == Sampling::Fibonacci;
  if (any_count && options.target.percent == 0.0 &&
      nodes != static_cast<std::size_t>(options.node_count)) {
    return "the number of nodes, " + std::to_string(nodes);
  }
  const OnScanReport* on_scan = on_scan_report(result);
  const std::size_t handles =
      on_scan == nullptr ? 0 : static_cast<std::size_t>(on_scan->handles.kept);
  if (mesh.triangles.size() != 2 * nodes - 4 + 4 * handles) return "the number of faces";
  const std::string broken = broken_surface(mesh);
  if (!broken.empty()) return "remesh: " + broken;
  for (const Vector3& p : mesh.points) {
    if (!p.allFinite()) return "a coordinate that is not finite";
  }
  for (const std::vector<double>* values : {&result.radial_distances, &result.cell_areas,
                                            &result.curvatures, &result.vertex_distances}) {
    if (!all_finite(*values)) return "a value of a node that is not finite";
    if (!values->empty() && values->size() != nodes) return "the number of values of the nodes";
  }
  // A million radii away the positions of the nodes have ten digits left; faces among 300 nodes
  // are larger than that. Farther out rounding may turn a thin face over.
  if (result.centre.norm() < 1e6 * result.input.equivalent_radius) {
    const bool star_shaped = published != nullptr;
    for (const Triangle& t : star_shaped ? mesh.triangles : std::vector<Triangle>()) {
      const Vector3 a = mesh.points[static_cast<std::size_t>(t[0])] - result.centre;
      const Vector3 b = mesh.points[static_cast<std::size_t>(t[1])] - result.centre;
      const Vector3 c = mesh.points[static_cast<std::size_t>(t[2])] - result.centre;
      if (!(a.normalized().dot(b.normalized().cross(c.normalized())) > 0.0)) {
        return "a face inverted or flat seen from the centre, " +
               format_number(a.normalized().dot(b.normalized().cross(c.normalized())));
      }
    }
    const auto* placed = std::get_if<OnScanOptions>(&options.method);
    if (placed != nullptr && placed->placement == ScanPlacement::Fitted) {
      const double off = std::abs(result.remesh.volume / result.scan.volume - 1.0);
      if (!(off < 1e-9)) return "the volume of fitted nodes, off by " + format_number(off);
    }
    const std::string mistaken = broken_measures(result);
    if (!mistaken.empty()) return mistaken;
  }
  if (options.target.percent > 0.0) {
    if (!result.search) return "no record of the search";
    if (result.search->met &&
        !(error_percent(result, options.target.measure) <= options.target.percent)) {
      return "a target said to be met that is not";
    }
  }
  return broken_report(result);
}

/// The shrink-wrap that a result recommends has no intersecting triangles, with as many nodes.
inline std::string broken_advice(const IndexedMesh& scan, RemeshOptions options,
                                 const RemeshResult& result) {
  if (result.clean_wrap_percent == 0.0) return "";
  options.node_count = static_cast<int>(result.mesh.points.size());
  options.target = {};
  options.shrink_wrap.opening_percent = result.clean_wrap_percent;
  try {
    const RemeshResult wrapped = remesh(scan, options, Execution(1));
    const std::size_t pairs = on_scan_report(wrapped)->nodes.self_intersections;
    return pairs == 0 ? "" : "the shrink-wrap that is recommended, with pairs that meet";
  } catch (const Error& error) {
    return std::string("the shrink-wrap that is recommended: ") + error.what();
  }
}

/// Remeshes and looks at every promise; with `twice` on two and three threads as well.
inline std::string broken_remesh(const IndexedMesh& scan, const RemeshOptions& options,
                                 bool twice) {
  double last = 0.0;
  bool monotone = true;
  const Execution execution(1, [&](double fraction, const std::string&) {
    monotone = monotone && fraction >= last && fraction <= 1.0;
    last = fraction;
    return true;
  });
  try {
    const RemeshResult result = remesh(scan, options, execution);
    if (!monotone || last != 1.0) return "the progress";
    std::string broken = broken_result(result, options);
    if (broken.empty()) broken = broken_advice(scan, options, result);
    if (!broken.empty() || !twice) return broken;
    for (const int threads : {2, 3}) {
      const RemeshResult other = remesh(scan, options, Execution(threads));
      if (other.mesh.points != result.mesh.points ||
          other.mesh.triangles != result.mesh.triangles) {
        return std::to_string(threads) + " threads remesh differently from one";
      }
    }
  } catch (const Error& error) {
    return broken_refusal(error);
  }
  return "";
}

}  // namespace wscvt::test
