// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/conforming_files.h"

#include <algorithm>
#include <map>
#include <utility>

#include "toolbox/exchange/tetrahedra_files.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

namespace {

std::string side_text(std::int32_t grain, const std::vector<Label>& labels) {
  return grain < 0 ? "-1" : std::to_string(labels[grain]);
}

/// Returns the voxels of labels, with one layer of background about them. The memory is 4 bytes per
/// voxel.
GrainVoxels read_grain_voxels(LabelVolume& volume, const std::vector<Label>& labels,
                              const Execution& execution) {
  const VoxelCounts& counts = volume.geometry().counts;
  GrainVoxels voxels({counts[0] + 2, counts[1] + 2, counts[2] + 2});
  Label last = 0;
  std::int32_t grain = -1;
  bool is_known = false;
  const auto read = [&](const std::vector<Label>& row, std::int32_t y, std::int32_t z) {
    for (std::int32_t x = 0; x < counts[0]; ++x) {
      const Label label = row[x];
      if (!is_known || label != last) {
        const auto found = std::lower_bound(labels.begin(), labels.end(), label);
        const bool is_grain = found != labels.end() && *found == label;
        grain = is_grain ? static_cast<std::int32_t>(found - labels.begin()) : -1;
        last = label;
        is_known = true;
      }
      voxels.grain[voxels.place(x + 1, y + 1, z + 1)] = grain;
    }
  };
  for_each_row(volume, execution, "Reading the volume", read);
  return voxels;
}

}  // namespace

std::vector<Label> taken_labels(const LabelGrains& grains) {
  std::vector<Label> labels;
  for (const LabelExtent& label : grains.labels()) {
    if (grains.state(label) == LabelState::Taken) labels.push_back(label.label);
  }
  if (labels.empty()) refuse(grains.none_taken());
  return labels;
}

ConformingGrains conform_labels(LabelVolume& volume, const std::vector<Label>& labels,
                                const ConformingOptions& options, const Execution& execution) {
  constexpr double reading = 0.05;
  GrainVoxels voxels = read_grain_voxels(volume, labels, execution.part(0.0, reading));
  // The layer of background about the voxels moves the lattice.
  VolumeGeometry geometry = volume.geometry();
  geometry.corner = geometry.point(Vector3(-1.0, -1.0, -1.0));
  return conform_grains(std::move(voxels), labels.size(), geometry, options,
                        execution.part(reading, 1.0), labels);
}

std::string walls_vtu(const ConformingGrains& grains, const std::vector<Label>& labels) {
  std::string corners;
  std::string inner;
  std::string outer;
  for (const WallTriangle& t : grains.triangles) {
    for (const std::int32_t corner : t.corners) corners += std::to_string(corner) + " ";
    corners += "\n";
    inner += side_text(t.inner, labels) + "\n";
    outer += side_text(t.outer, labels) + "\n";
  }
  constexpr int vtk_triangle = 5;
  return vtu_of_cells(grains.points, grains.triangles.size(), 3, vtk_triangle, corners,
                      "<CellData>\n" + vtk_data_array("Int64", "Name=\"inner\"", inner) +
                          vtk_data_array("Int64", "Name=\"outer\"", outer) + "</CellData>\n");
}

std::string walls_msh(const ConformingGrains& grains, const std::vector<Label>& labels) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> by_sides;
  std::vector<Triangle> triangles;
  for (const WallTriangle& t : grains.triangles) {
    by_sides[{t.outer, t.inner}].push_back(triangles.size());
    triangles.push_back(t.corners);
  }
  std::vector<MeshPart> surfaces;
  for (auto& [sides, members] : by_sides) {
    const auto& [outer, inner] = sides;
    const std::string name = outer < 0 ? "surface_" : "wall_" + side_text(outer, labels) + "_";
    surfaces.push_back({name + side_text(inner, labels), std::move(members), {inner, outer}});
  }
  std::vector<MeshPart> volumes;
  volumes.reserve(labels.size());
  for (const Label label : labels) volumes.push_back({"grain_" + std::to_string(label), {}});
  return msh_of_parts(grains.points, triangles, surfaces, {}, volumes);
}

std::string walls_csv(const ConformingGrains& grains, const std::vector<Label>& labels) {
  std::string text =
      csv_record({"first", "second", "area", "x", "y", "z", "nx", "ny", "nz", "triangles"});
  for (const CommonWall& wall : grains.walls) {
    std::vector<std::string> fields = {side_text(wall.first, labels),
                                       side_text(wall.second, labels), format_exact(wall.area)};
    for (const Vector3& v : {wall.centre, wall.normal}) {
      for (const double x : v) fields.push_back(format_exact(x));
    }
    fields.push_back(std::to_string(wall.triangles));
    text += csv_record(fields);
  }
  return text;
}

std::string conforming_csv(const ConformingGrains& grains, const std::vector<Label>& labels,
                           const std::vector<std::string>& files) {
  std::string text = csv_record({"grain", "nodes", "triangles", "voxels", "gained", "voxel_volume",
                                 "volume", "contacts", "pieces", "left_out", "file"});
  for (std::size_t g = 0; g < grains.grains.size(); ++g) {
    const ConformingGrain& grain = grains.grains[g];
    text += csv_record({std::to_string(labels[g]), std::to_string(grain.nodes),
                        std::to_string(grain.triangles), std::to_string(grain.voxels),
                        std::to_string(grain.gained), format_exact(grain.voxel_volume),
                        format_exact(grain.volume), std::to_string(grain.contacts),
                        std::to_string(grain.pieces), std::to_string(grain.left_out), files[g]});
  }
  return text;
}

namespace {

std::string distance_text(const ConformingGrains& grains) {
  return "rms " + format_percent(grains.rms_distance) + " of the equivalent radius, largest " +
         format_percent(grains.largest_distance);
}

}  // namespace

std::vector<std::string> conforming_lines(const ConformingGrains& grains) {
  std::int64_t voxels = 0;
  for (const ConformingGrain& grain : grains.grains) voxels += grain.voxels;
  constexpr double short_share = 0.2;
  std::string edges = "Edges: mean " + format_number(grains.mean_edge) + ", standard deviation " +
                      format_percent(grains.edge_variation) + " of it";
  if (grains.shortest_edge < short_share * grains.mean_edge) {
    edges += ", shortest " + format_number(grains.shortest_edge);
  }
  edges +=
      ". Smallest angle of a triangle: " + format_number(grains.smallest_angle, 3) + " degrees";
  std::vector<std::string> lines = {
      format_count(grains.grains.size(), voxels > 0 ? "grain" : "fragment") + " with " +
          format_count(grains.walls.size(), "common wall") + ": " +
          std::to_string(grains.points.size()) + " nodes, " +
          std::to_string(grains.triangles.size()) + " triangles",
      edges};
  if (voxels > 0) {
    const double share = static_cast<double>(grains.gained_voxels) / static_cast<double>(voxels);
    lines.push_back("Gaps a voxel wide: " + std::to_string(grains.gained_voxels) + " voxels, " +
                    format_percent(share) + " of the grains, went to the grains beside them");
    if (grains.walls_across + grains.lost_walls > 0)
      lines.push_back(
          "Walls between labels that do not touch: " + std::to_string(grains.walls_across) +
          ". Labels that touch without a wall: " + format_count(grains.lost_walls, "pair"));
  }
  const std::string error = format_error(100.0 * grains.volume_error);
  lines.push_back("Volumes: " +
                  (error == "exact" ? error : "exact within " + error.substr(1) + " %"));
  lines.push_back("Intersecting pairs of triangles: " + std::to_string(grains.intersections));
  if (grains.largest_distance > 0.0) {
    lines.push_back("Distance to the grain's surface: " + distance_text(grains));
  }
  return lines;
}

namespace {

/// Returns the names of the bodies that `is_meant` holds.
template <class IsMeant>
std::string names_of(const ConformingGrains& grains, const std::vector<std::string>& names,
                     const IsMeant& is_meant) {
  constexpr std::size_t most_named = 10;
  std::string list;
  std::size_t count = 0;
  for (std::size_t g = 0; g < names.size(); ++g) {
    if (!is_meant(grains.grains[g]) || ++count > most_named) continue;
    list += (list.empty() ? "" : ", ") + names[g];
  }
  return count > most_named ? list + " and " + std::to_string(count - most_named) + " more" : list;
}

/// `kind`: of the bodies, such as "grain". `names`: theirs.
std::vector<Sentence> warnings_of(const ConformingGrains& grains, const std::string& kind,
                                  const std::vector<std::string>& names, const Sentence& remedy) {
  constexpr double least_angle = 5.0;   // degrees
  constexpr double most_error = 0.001;  // of a volume
  std::vector<Sentence> warnings;
  const std::string fallen = names_of(grains, names, [](const ConformingGrain& grain) {
    constexpr std::int64_t part = 20;
    return grain.fallen_off * part > grain.voxels + grain.fallen_off;
  });
  if (!fallen.empty()) {
    warnings.push_back(
        "More than 5 % fell off the " + kind + "s " + fallen +
        ": they hang together by parts a voxel thick, which went to the grains "
        "about these. The largest piece was used. Extracted without common walls, they stay "
        "whole.");
  }
  if (grains.volume_error > most_error) {
    warnings.push_back("The volumes of the " + kind + "s err by up to " +
                       format_percent(grains.volume_error) +
                       ", because their triangles are too large to be parted otherwise. Give a "
                       "smaller " +
                       mention(edge_length_option) + remedy);
  }
  if (grains.is_inaccurate) {
    warnings.push_back("The fragments do not follow the grain's surface: they are off by " +
                       distance_text(grains) + ". Give a smaller " + mention(edge_length_option) +
                       remedy);
  }
  if (grains.intersections > 0) {
    warnings.push_back(
        std::to_string(grains.intersections) +
        " pairs of triangles intersect, in thin parts of the " + kind + "s " +
        names_of(grains, names, [](const ConformingGrain& grain) { return grain.intersects; }) +
        ". Give a smaller " + mention(edge_length_option) + remedy);
  }
  if (grains.flattest >= 0 && grains.smallest_angle < least_angle) {
    warnings.push_back("The smallest angle of a triangle is " +
                       format_number(grains.smallest_angle, 3) + " degrees, at " + kind + " " +
                       names[grains.flattest] +
                       ". Tetrahedra there are as flat, and simulations with them become slow or "
                       "inaccurate. Give another " +
                       mention(edge_length_option) + remedy);
  }
  return warnings;
}

}  // namespace

double left_out(const ConformingGrains& grains) {
  std::int64_t left_out = 0;
  std::int64_t all = 0;
  for (const ConformingGrain& grain : grains.grains) {
    left_out += grain.left_out;
    all += grain.left_out + grain.voxels - grain.gained - grain.pore_voxels;
  }
  return static_cast<double>(left_out) / static_cast<double>(all);
}

std::vector<Sentence> conforming_warnings(const ConformingGrains& grains,
                                          const std::vector<Label>& labels) {
  std::vector<std::string> names;
  names.reserve(labels.size());
  for (const Label label : labels) names.push_back(std::to_string(label));
  return warnings_of(grains, "grain", names, ", or segment the volume with less noise.");
}

std::vector<Sentence> conforming_warnings(const ConformingGrains& fragments) {
  std::vector<std::string> names;
  for (std::size_t k = 1; k <= fragments.grains.size(); ++k) names.push_back(std::to_string(k));
  return warnings_of(fragments, "fragment", names, " or more nodes.");
}

}  // namespace wscvt
