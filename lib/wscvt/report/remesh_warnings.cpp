// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/remesh_warnings.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/text_format.h"
#include "wscvt/scan/closing_advice.h"

namespace wscvt {

namespace {

using Sentences = std::vector<std::string>;

/// Share of steep area above which points are taken to lie behind each other. The points of 22 real
/// scans, made a surface again: up to .039 where the remesh follows that surface (area within 2 %,
/// but for one of 4 %), .087 to .68 where it loses 3 to 50 % of its area.
constexpr double steep_points_limit = 0.06;

void warn_of_scan(const RemeshResult& result, Sentences& warnings) {
  const bool wraps = result.options.envelope.opening_percent > 0.0;
  const std::size_t faces = result.options.points ? result.input.input_faces : 0;
  const std::string unused =
      faces > 0 ? ", its " + std::to_string(faces) + " faces were not used" : std::string();
  if (result.options.points && !wraps) {
    warnings.push_back(
        "The scan was taken as points" + unused +
        ": volume, area and folds of the original are those of the surface that was made for them, "
        "with one radius in each direction, not those of the body. Check the result against it.");
    if (result.steep_share > steep_points_limit) {
      warnings.push_back(
          format_percent(result.steep_share) +
          " of the area of the surface made of the points is steep, as where some lie behind "
          "others: they have no one radius in each direction. " +
          surface_of_points_advice());
    }
  }
  if (wraps) {
    warnings.push_back("The scan was taken by its envelope" + unused +
                       ": volume, area and distances of the original are those "
                       "of the envelope, in which what is narrower than " +
                       format_percent(0.01 * result.options.envelope.opening_percent) +
                       " of the bounding box is filled. Check the result against the scan.");
  }
  const bool radial = result.parametrization == Parametrization::Radial;
  if (radial && result.folded_share > fold_warning_limit) {
    warnings.push_back(
        "The scan folds over itself: sheets beyond the first fill " +
        format_percent(result.folded_share) +
        " of the solid angle seen from its centre; there the outermost was taken. Check the "
        "result against the scan.");
  }
  const MeshCheckReport& input = result.input;
  const std::size_t bodies = input.components - input.inner_components;
  if (input.components > input.inner_components + 1) {
    warnings.push_back("The scan has " + std::to_string(bodies) +
                       " separate bodies; only the largest was remeshed.");
  }
  if (input.inner_components > 0) {
    warnings.push_back("The scan has " + std::to_string(input.inner_components) +
                       (input.inner_components == 1 ? " surface" : " surfaces") +
                       " inside its outer one, around " + format_percent(input.inner_volume_share) +
                       " of its volume; only the outer one was remeshed, as a body without pores.");
  }
  const double mended = input.flap_area_share + input.filled_area_share;
  if (mended > 0.0) {
    warnings.push_back("Holes and non-manifold edges of the scan were mended, which changed " +
                       format_percent(mended) + " of its area. Check the result against the scan.");
  }
  if (!result.handles.cut.empty()) {
    const std::size_t cut = result.handles.cut.size();
    std::string text = "The scan has " + std::to_string(cut) +
                       (cut == 1 ? " handle, which was" : " handles, which were") +
                       " cut and closed for its map to the sphere; that changed its volume by " +
                       format_percent(std::abs(result.handles.volume_change)) +
                       ". The log says where.";
    if (result.space.self_intersections > 0 || misses_the_scan(result)) {
      text += " " + envelope_of_flaws_advice();
    }
    warnings.push_back(text);
  } else if (result.input.genus > 0) {
    warnings.push_back("The scan has " + std::to_string(result.input.genus) +
                       (result.input.genus == 1 ? " hole" : " holes") +
                       " through it (genus), which the remesh closes.");
  }
}

void warn_of_fit(const RemeshResult& result, Sentences& warnings) {
  if (result.fit.degree < result.fit.requested_degree) {
    warnings.push_back("The harmonic degree was lowered from " +
                       std::to_string(result.fit.requested_degree) + " to " +
                       std::to_string(result.fit.degree) +
                       ", because above it the series is not positive everywhere: the grain is "
                       "long, flat or sharp.");
  }
  // Of nodes on the scan, or fitted to it, the series only decides the cells.
  if (result.options.placement.kind != NodePlacement::Series) return;
  const double misfit = result.fit.residual / result.input.equivalent_radius;
  if (misfit > residual_warning_limit) {
    warnings.push_back(
        "The fitted series misses the scan by " + format_percent(misfit) +
        " of the equivalent radius (rms). " +
        (result.fit.limit == DegreeLimit::None ? "Raise the harmonic degree, or place" : "Place") +
        " the nodes on the original mesh or by least squares, which follow the scan itself.");
  }
}

void warn_of_space(const RemeshResult& result, const RemeshOptions& asked, Sentences& warnings) {
  if (result.parametrization != Parametrization::Spherical) return;
  if (asked.relaxation.metric != result.options.relaxation.metric) {
    warnings.push_back(
        "The cells are those on the surface, because on the sphere the cells of a grain that is "
        "mapped whole say nothing; take the radial parametrization for cells on the sphere.");
  }
  const std::string nodes = std::to_string(result.mesh.points.size()) + " nodes";
  if (result.space.self_intersections > 0) {
    warnings.push_back(
        std::to_string(result.space.self_intersections) +
        (result.space.self_intersections == 1 ? " pair" : " pairs") +
        " of triangles of the remesh meet each other, because sheets of the grain come nearer to "
        "each other than " +
        nodes + " can follow.");
  }
  if (result.space.enough_nodes == 0) return;
  warnings.push_back(nodes + " are too few for this shape: on its surface they lose " +
                     format_percent(result.space.volume_loss) +
                     " of the volume, or their triangles meet" +
                     (result.space.enough_nodes > 0
                          ? "; " + std::to_string(result.space.enough_nodes) + " would do."
                          : "; so are twice to sixteen times as many, as far as tried."));
}

void warn_of_relaxation(const RemeshResult& result, Sentences& warnings) {
  if (result.options.seeding.sampling != Sampling::Weighted) {
    const auto nodes = static_cast<int>(result.mesh.points.size());
    if (nodes != result.options.node_count) {
      warnings.push_back("This sampling has no form with " +
                         std::to_string(result.options.node_count) + " nodes; the nearest, with " +
                         std::to_string(nodes) + ", was used.");
    }
  } else if (result.relaxation.outcome == RelaxationOutcome::Settled) {
    // Flat cells on a rough scan differ in area however many they are: no reason for a warning.
    if (result.options.relaxation.metric == RelaxationMetric::Surface) return;
    warnings.push_back(
        "The seeds no longer came nearer to their targets, with the cells' areas still spread by " +
        format_percent(result.relaxation.history.back().area_spread) +
        " about their targets; more nodes follow the surface more evenly.");
  } else if (result.relaxation.outcome == RelaxationOutcome::Stuck) {
    warnings.push_back(
        "The relaxation stopped after " + std::to_string(result.relaxation.iterations) +
        " iterations, because a further step would have torn the triangulation; the result keeps "
        "every promise but may be less even. Another start of the seeds may go further.");
  } else if (result.relaxation.outcome == RelaxationOutcome::IterationLimit &&
             result.relaxation.iterations < result.options.relaxation.maximum_iterations) {
    // Of a repair, whose limit is its own: five times as many made no difference on a rough scan.
    warnings.push_back(
        "The relaxation that gave more nodes to places where triangles had met did not come to "
        "rest "
        "within " +
        std::to_string(result.relaxation.iterations) +
        " iterations; triangles there are less even. More nodes follow such places better.");
  } else if (result.relaxation.outcome == RelaxationOutcome::IterationLimit) {
    warnings.push_back(
        "The relaxation stopped at its limit of " + std::to_string(result.relaxation.iterations) +
        " iterations before it converged; raise the limit for the last bit of evenness.");
  }
  if (result.relaxation.weight_scale < 1.0) {
    warnings.push_back("The differences between the weights were scaled by " +
                       format_number(result.relaxation.weight_scale, 3) +
                       ", because seeds would have lost their cells; " +
                       (result.options.weighting.kind == Weighting::Curvature
                            ? "lower the strength alpha of the curvature weighting."
                            : "ask for more nodes, or for another weighting."));
  }
}

std::string missed_by(double misfit, double area_off) {
  return "rms distance " + format_percent(misfit) + " of the equivalent radius, area " +
         (area_off < 0.0 ? "-" : "+") + format_percent(std::abs(area_off));
}

void warn_of_misfit(const RemeshResult& result, Sentences& warnings) {
  if (result.input.input_vertices == 0 || !misses_the_scan(result)) return;
  const double misfit = result.misfit / result.input.equivalent_radius;
  const double area_off = result.remesh.area / result.original.area - 1.0;
  std::string text = "The remesh misses the scan: " + missed_by(misfit, area_off) + ".";
  // The measure that is farthest over its limit decides which change helps most.
  const auto badness = [](double rms, double area) {
    return std::max(rms / misfit_warning_limit, std::abs(area) / area_warning_limit);
  };
  std::vector<TriedChange> better;
  for (const TriedChange& one : result.tried) {
    if (badness(one.misfit, one.area_off) < badness(misfit, area_off)) better.push_back(one);
  }
  std::stable_sort(better.begin(), better.end(), [&](const TriedChange& a, const TriedChange& b) {
    return badness(a.misfit, a.area_off) < badness(b.misfit, b.area_off);
  });
  // Two, since the nearest may cost nodes or evenness that one does not want to pay.
  constexpr std::size_t most_named = 2;
  for (std::size_t k = 0; k < std::min(most_named, better.size()); ++k) {
    text +=
        " With " + better[k].change + ": " + missed_by(better[k].misfit, better[k].area_off) + ".";
  }
  if (better.empty() && !result.tried.empty()) {
    text += " None of the changes tried brings it nearer.";
  }
  warnings.push_back(text);
}

/// A refinement promises its smallest angle, so one below it is said; a tenth of a degree is what
/// making the volume exact may cost, and no loss to anyone. Without refinement nothing is promised,
/// but triangles relaxed on the surface had angles above 20 degrees on each of 60 bodies, with 60
/// to 1000 nodes, and of 12 and less on three with limbs like an animal's, where nodes jam.
void warn_of_angles(const RemeshResult& result, Sentences& warnings) {
  constexpr double slack = 0.1;
  constexpr double jammed = 20.0;
  const RefinementOptions& refinement = result.options.placement.refinement;
  const bool is_even = result.options.seeding.sampling == Sampling::Weighted &&
                       result.options.relaxation.metric == RelaxationMetric::Surface;
  const double limit =
      refinement.rounds > 0 ? refinement.smallest_angle - slack : (is_even ? jammed : 0.0);
  const double smallest = result.quality.smallest_angle;
  if (smallest >= limit) return;
  warnings.push_back("The smallest angle is " + format_number(smallest, 3) + " degrees" +
                     (refinement.rounds > 0
                          ? ", below the " + format_number(refinement.smallest_angle) + " asked for"
                          : std::string()) +
                     ": at a thin or sharp place nodes had no room for better triangles. Another "
                     "number of nodes, or of rounds of refinement, gives other triangles there.");
}

void warn_of_search(const RemeshResult& result, Sentences& warnings) {
  if (result.search && !result.search->met) {
    warnings.push_back("No number of nodes up to " + std::to_string(result.search->node_count) +
                       " meets the error target of " +
                       format_percent(0.01 * result.options.target.percent) +
                       "; this is the result with that many. Allow more nodes, or a larger error.");
  }
}

}  // namespace

bool misses_the_scan(const RemeshResult& result) {
  // What contact nodes are fitted to is not the scan's shape.
  if (result.options.placement.kind == NodePlacement::Contact) return false;
  return result.misfit > misfit_warning_limit * result.input.equivalent_radius ||
         std::abs(result.remesh.area / result.original.area - 1.0) > area_warning_limit;
}

std::vector<std::string> remesh_warnings(const RemeshResult& result, const RemeshOptions& asked,
                                         const std::string& of_precision) {
  Sentences warnings;
  if (!of_precision.empty()) warnings.push_back(of_precision);
  warn_of_scan(result, warnings);
  warn_of_fit(result, warnings);
  warn_of_misfit(result, warnings);
  warn_of_space(result, asked, warnings);
  warn_of_relaxation(result, warnings);
  warn_of_angles(result, warnings);
  warn_of_search(result, warnings);
  return warnings;
}

}  // namespace wscvt
