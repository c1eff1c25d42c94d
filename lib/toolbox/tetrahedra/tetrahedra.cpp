// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/tetrahedra/tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "toolbox/fragment/common_walls.h"
#include "toolbox/tetrahedra/gmsh_library.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

namespace {

/// The faces of a tetrahedron, outward, each opposite to the corner of its number.
constexpr std::array<std::array<std::size_t, 3>, 4> outer_faces = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

Triangle from_least(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Throws unless the faces of single tetrahedra are the surface, in its turn.
void check_surface(const TetrahedralMesh& mesh) {
  std::set<Triangle> open;
  bool is_kept = true;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    for (const auto& [a, b, c] : outer_faces) {
      if (open.erase(from_least({t[a], t[c], t[b]})) != 0) continue;
      is_kept = open.insert(from_least({t[a], t[b], t[c]})).second && is_kept;
    }
  }
  for (const Triangle& t : mesh.surface.triangles) {
    is_kept = open.erase(from_least(t)) != 0 && is_kept;
  }
  if (is_kept && open.empty()) return;
  throw Error(ErrorCode::NumericalFailure,
              "Gmsh's tetrahedra do not have the surface that was given. Use another number of "
              "nodes.");
}

void measure(TetrahedralMesh& mesh) {
  const std::vector<Vector3>& points = mesh.surface.points;
  std::set<std::array<std::int32_t, 2>> edges;
  double smallest = -1.0;  // cosines
  double largest = 1.0;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    std::array<Vector3, 4> normals;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& [a, b, c] = outer_faces[k];
      normals[k] = doubled_area_normal(points[t[a]], points[t[b]], points[t[c]]).normalized();
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double cosine = std::clamp(-normals[i].dot(normals[j]), -1.0, 1.0);
        smallest = std::max(smallest, cosine);
        largest = std::min(largest, cosine);
        edges.insert({std::min(t[i], t[j]), std::max(t[i], t[j])});
      }
    }
  }
  mesh.smallest_dihedral = portable::acos(smallest) * 180.0 / pi;
  mesh.largest_dihedral = portable::acos(largest) * 180.0 / pi;
  for (const auto& [a, b] : edges) {
    mesh.mean_edge += (points[a] - points[b]).norm() / static_cast<double>(edges.size());
  }
}

}  // namespace

void require_tetrahedra() { require_gmsh(); }

namespace {

/// Gmsh's tolerances are lengths, so it gets a grain of the size 1 about the origin. `size`: its
/// equivalent radius; length.
TetrahedralMesh fill_once(const IndexedMesh& surface, double edge, double size) {
  const Vector3 centre = surface.points.front();
  std::vector<double> coordinates;
  for (const Vector3& p : surface.points) {
    const Vector3 own = (p - centre) / size;
    coordinates.insert(coordinates.end(), own.data(), own.data() + 3);
  }
  std::vector<std::size_t> corners;
  for (const Triangle& t : surface.triangles) corners.insert(corners.end(), t.begin(), t.end());
  const GmshVolume volume = gmsh_volume(std::move(coordinates), std::move(corners), edge / size);
  TetrahedralMesh mesh;
  mesh.surface = surface;
  for (std::size_t i = surface.points.size(); i < volume.coordinates.size() / 3; ++i) {
    const double* const own = volume.coordinates.data() + 3 * i;
    mesh.surface.points.push_back(centre + size * Vector3(own[0], own[1], own[2]));
  }
  const std::vector<Vector3>& points = mesh.surface.points;
  for (std::size_t k = 0; k + 3 < volume.corners.size(); k += 4) {
    Tetrahedron t{};
    for (std::size_t c = 0; c < 4; ++c) t[c] = static_cast<std::int32_t>(volume.corners[k + c]);
    if (six_volumes(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]],
                    points[t[3]] - points[t[0]]) < 0.0) {
      std::swap(t[0], t[1]);
    }
    mesh.tetrahedra.push_back(t);
  }
  check_surface(mesh);
  measure(mesh);
  return mesh;
}

/// Regular tetrahedra are 6 sqrt(2) per edge cubed.
double expected_tetrahedra(double volume, double edge) {
  return 6.0 * std::sqrt(2.0) * volume / (edge * edge * edge);
}

}  // namespace

TetrahedralMesh tetrahedra_in(const IndexedMesh& surface, double edge, const Execution& execution) {
  require_in_range(edge, tetrahedra_edge_option);
  const double volume = volume_of(surface, execution);
  if (!(volume > 0.0)) refuse("The surface encloses no volume. Give a closed outward mesh.");
  execution.report(0.0, "Filling with tetrahedra");
  const double size = equivalent_radius(volume);
  const double surface_edge = mean_edge_of(surface);
  const double wanted = edge > 0.0 ? edge : surface_edge;
  const double expected = expected_tetrahedra(volume, wanted);
  if (expected > most_tetrahedra) {
    refuse("Edges of " + format_number(wanted) + " need about " + format_number(expected / 1e6, 3) +
           " million tetrahedra, more than " + format_number(most_tetrahedra / 1e6) +
           " million. Give a larger " + mention(tetrahedra_edge_option) + ".");
  }
  TetrahedralMesh best;
  try {
    best = fill_once(surface, wanted, size);
  } catch (const Error&) {
    const std::size_t pairs = self_intersections(surface, execution).size();
    if (pairs == 0) throw;
    throw Error(ErrorCode::NumericalFailure,
                format_count(pairs, "pair") +
                    " of triangles of the surface intersect, and no tetrahedra fill such a "
                    "surface. Of a remesh, a warning says what to use instead.");
  }
  // Beside short edges of the surface flat tetrahedra reach to the next inner points, and in some
  // places Gmsh finds no better ones. With other inner points most of them vanish.
  for (const double share : {0.9, 0.8, 0.7}) {
    const double shorter = share * std::min(wanted, surface_edge);
    if (best.smallest_dihedral >= least_dihedral) break;
    if (expected_tetrahedra(volume, shorter) > most_tetrahedra) break;
    execution.report(0.0, "Filling with tetrahedra");
    try {
      TetrahedralMesh other = fill_once(surface, shorter, size);
      if (other.smallest_dihedral > best.smallest_dihedral) best = std::move(other);
    } catch (const Error&) {
      break;
    }
  }
  return best;
}

namespace {

/// Numbers points by their bits.
class PointNumbers {
 public:
  explicit PointNumbers(std::vector<Vector3>& points) : points_(points) {}

  std::int32_t of(const Vector3& p) {
    const auto [at, is_new] = numbers_.emplace(std::array<double, 3>{p.x(), p.y(), p.z()},
                                               static_cast<std::int32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return at->second;
  }

 private:
  std::vector<Vector3>& points_;
  std::map<std::array<double, 3>, std::int32_t> numbers_;
};

}  // namespace

TetrahedralMesh tetrahedra_in(const std::vector<IndexedMesh>& bodies, const std::string& kind,
                              const std::vector<std::string>& names, double edge,
                              const Execution& execution) {
  TetrahedralMesh all;
  all.kind = kind;
  all.names = names;
  std::vector<TetrahedralMesh> filled;
  std::vector<std::vector<std::int32_t>> numbers(bodies.size());
  PointNumbers surface_points(all.surface.points);
  std::map<Triangle, std::size_t> triangle_of;  // by sorted corners
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto share = [&](std::size_t k) {
      return static_cast<double>(k) / static_cast<double>(bodies.size());
    };
    try {
      filled.push_back(tetrahedra_in(bodies[b], edge, execution.part(share(b), share(b + 1))));
    } catch (const Error& error) {
      if (error.code() == ErrorCode::Cancelled) throw;
      throw Error(error.code(), "The " + kind + " " + names[b] + ": " + error.what());
    }
    all.body_dihedrals.push_back(filled[b].smallest_dihedral);
    for (const Vector3& p : bodies[b].points) numbers[b].push_back(surface_points.of(p));
    for (const Triangle& t : bodies[b].triangles) {
      const Triangle corners = {numbers[b][t[0]], numbers[b][t[1]], numbers[b][t[2]]};
      Triangle sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      const auto [at, is_new] = triangle_of.emplace(sorted, all.sides.size());
      if (is_new) {
        all.surface.triangles.push_back(corners);
        all.sides.push_back({static_cast<std::int32_t>(b), -1});
      } else {
        all.sides[at->second][1] = static_cast<std::int32_t>(b);
      }
    }
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::vector<Vector3>& points = filled[b].surface.points;
    for (std::size_t i = numbers[b].size(); i < points.size(); ++i) {
      numbers[b].push_back(static_cast<std::int32_t>(all.surface.points.size()));
      all.surface.points.push_back(points[i]);
    }
    for (const Tetrahedron& t : filled[b].tetrahedra) {
      all.tetrahedra.push_back(
          {numbers[b][t[0]], numbers[b][t[1]], numbers[b][t[2]], numbers[b][t[3]]});
      all.bodies.push_back(static_cast<std::int32_t>(b));
    }
  }
  measure(all);
  return all;
}

std::string tetrahedra_line(const TetrahedralMesh& mesh) {
  std::string flattest;
  std::string below;
  if (!mesh.names.empty()) {
    const std::vector<double>& angles = mesh.body_dihedrals;
    const auto smallest = std::min_element(angles.begin(), angles.end()) - angles.begin();
    flattest = " (" + mesh.kind + " " + mesh.names[smallest] + ")";
    const auto count = std::count_if(angles.begin(), angles.end(),
                                     [](double angle) { return angle < least_dihedral; });
    below = ", below " + format_number(least_dihedral, 3) + " in " + std::to_string(count) +
            " of " + std::to_string(angles.size()) + " " + mesh.kind + "s";
  }
  return "Tetrahedra: " + std::to_string(mesh.tetrahedra.size()) + " of " +
         std::to_string(mesh.surface.points.size()) + " points, dihedral angles " +
         format_number(mesh.smallest_dihedral, 3) + flattest + " to " +
         format_number(mesh.largest_dihedral, 4) + " degrees" + below + ", mean edge " +
         format_number(mesh.mean_edge, 3);
}

}  // namespace wscvt
