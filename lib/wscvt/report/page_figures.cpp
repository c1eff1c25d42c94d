// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/page_figures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/mesh_view.h"
#include "wscvt/report/picture.h"
#include "wscvt/report/turning_view.h"

namespace wscvt {

namespace {

/// Reported before each step. A step with a million vertices takes tenths of a second.
constexpr const char* page_stage = "Drawing the page";
constexpr std::size_t histogram_bins = 60;
constexpr const char* reference_colour = "#6e6e6e";
constexpr const char* shown_colour = "#0a58b4";
/// Edges of more triangles would hide the surface.
constexpr std::size_t most_faces_with_edges = 30000;
/// Pictures are drawn at twice the size and halved, to smooth their edges.
constexpr int drawn_pixels = 840;
/// Sample points of the distance histogram: 200 for a bin of 1 %.
constexpr std::size_t distance_samples = 20000;

/// The distance that 98 of 100 samples stay below. Single spikes would leave no colour for the
/// rest. Never 0.
double usual_distance(const std::vector<double>& distances) {
  std::vector<double> sizes;
  sizes.reserve(distances.size());
  for (const double d : distances) sizes.push_back(std::abs(d));
  const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 98 / 100);
  std::nth_element(sizes.begin(), place, sizes.end());
  return std::max(*place, 1e-300);
}

Histogram histogram_of(const std::vector<double>& values, double half_width) {
  Histogram histogram{-half_width, half_width, std::vector<std::size_t>(histogram_bins, 0)};
  for (const double value : values) {
    const double share = (value + half_width) / (2.0 * half_width);
    const double bin = std::clamp(std::floor(share * histogram_bins), 0.0, histogram_bins - 1.0);
    ++histogram.counts[static_cast<std::size_t>(bin)];
  }
  return histogram;
}

/// The k-th picture of a page, which turns.
Figure picture_figure(const Picture& picture, std::size_t k, const std::string& caption,
                      const std::string& below = "") {
  return {turning_picture(image_element(halved(picture), caption), k) + below, caption};
}

std::string size_text(const ShownMesh& shown) {
  return shown.name + ": " + std::to_string(shown.mesh.points.size()) + " vertices, " +
         std::to_string(shown.mesh.triangles.size()) + " faces";
}

void add_triangle_histograms(std::vector<Figure>& figures,
                             const std::optional<ShownMesh>& reference, const ShownMesh& shown,
                             const Execution& execution) {
  std::vector<NamedHistogram> lengths;
  std::vector<NamedHistogram> ratios;
  std::vector<NamedHistogram> angles;
  const auto add = [&](const ShownMesh& mesh, const std::string& colour) {
    execution.report(0.0, page_stage);
    QualityHistograms histograms = quality_histograms(mesh.mesh, histogram_bins);
    lengths.push_back({mesh.name, colour, std::move(histograms.relative_edge_length)});
    ratios.push_back({mesh.name, colour, std::move(histograms.edge_ratio)});
    angles.push_back({mesh.name, colour, std::move(histograms.angle)});
  };
  if (reference) add(*reference, reference_colour);
  add(shown, shown_colour);
  const std::string last_bin = " Values beyond the right end are counted in the last bin.";
  figures.push_back({histogram_figure("edge length / mean edge length", "edges", lengths),
                     "How even the edges are." + last_bin});
  figures.push_back({histogram_figure("longest / shortest edge of a triangle", "triangles", ratios),
                     "How even the triangles are. 1 is best." + last_bin});
  figures.push_back({histogram_figure("angle, degrees", "angles", angles),
                     "Angles of the triangles. 60 is best."});
}

}  // namespace

PageFigures page_figures(const std::optional<ShownMesh>& reference, const ShownMesh& shown,
                         const Execution& execution, const std::vector<Vector3>& samples) {
  PageFigures figures;
  execution.report(0.0, page_stage);
  // The view contains both meshes: a coarse remesh with the scan's volume extends far beyond the
  // scan.
  std::vector<const IndexedMesh*> both = {&shown.mesh};
  if (reference) both.push_back(&reference->mesh);
  const MeshView view = view_of(both, drawn_pixels);
  if (reference) {
    execution.report(0.0, page_stage);
    figures.pictures.push_back(
        picture_figure(draw(reference->mesh, look_at(reference->mesh, view), view, false, {}), 0,
                       size_text(*reference)));
  }
  execution.report(0.0, page_stage);
  const SeenMesh seen = look_at(shown.mesh, view);
  const bool with_edges =
      shown.parts.empty() && shown.mesh.triangles.size() <= most_faces_with_edges;
  figures.pictures.push_back(
      picture_figure(draw(shown.mesh, seen, view, with_edges, {}, shown.parts),
                     figures.pictures.size(), size_text(shown)));
  add_triangle_histograms(figures.distributions, reference, shown, execution);
  if (!reference) {
    figures.views = turning_views({{shown.mesh, with_edges, {}, 0.0, shown.parts}}, view);
    return figures;
  }

  const MeshDistance surface(reference->mesh, execution);
  const std::vector<double> distances = surface.signed_distances(
      samples.empty() ? area_uniform_samples(shown.mesh, distance_samples) : samples, execution);
  const double usual = usual_distance(distances);
  const auto distances_at = [&](const std::vector<Vector3>& points) {
    return surface.signed_distances(points, execution);
  };
  const auto colour_of = [&](const std::vector<Vector3>& points) {
    std::vector<Colour> colours;
    colours.reserve(points.size());
    for (const double d : distances_at(points)) colours.push_back(diverging_colour(d / usual));
    return colours;
  };
  figures.pictures.push_back(
      picture_figure(draw(shown.mesh, seen, view, false, colour_of), figures.pictures.size(),
                     "Distance of " + shown.name + " to " + reference->name +
                         ": red outside, blue inside, in the mesh's unit of length. 2 % of the "
                         "surface is beyond the ends of the scale.",
                     colour_scale(usual)));
  figures.distributions.push_back(
      {histogram_figure("signed distance to " + reference->name + ", length", "surface",
                        {{shown.name, shown_colour, histogram_of(distances, 1.5 * usual)}}),
       "How far " + shown.name + " lies outside (positive) and inside of " + reference->name +
           ", by area. Values beyond the ends are counted in the end bins."});
  figures.views = turning_views({{reference->mesh, false, {}, 0.0},
                                 {shown.mesh, with_edges, {}, 0.0, shown.parts},
                                 {shown.mesh, false, distances_at, usual}},
                                view);
  return figures;
}

}  // namespace wscvt
