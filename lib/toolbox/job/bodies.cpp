// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/bodies.h"

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <unordered_set>
#include <utility>

#include "wscvt/base/box_grid.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/components.h"
#include "wscvt/repair/coordinates.h"
#include "wscvt/repair/mesh_cells.h"
#include "wscvt/repair/scan_advice.h"
#include "wscvt/repair/scan_options.h"
#include "wscvt/repair/stray_vertex.h"
#include "wscvt/repair/weld.h"

namespace wscvt {

namespace {

using FaceList = std::vector<std::int32_t>;

/// Copies faces with the vertices that they use.
class Extractor {
 public:
  explicit Extractor(const IndexedMesh& mesh)
      : mesh_(mesh), number_(mesh.points.size(), -1), user_(mesh.points.size(), -1) {}

  /// `turned`: for each of the faces whether it is turned round; empty: none.
  IndexedMesh extract(const FaceList& faces, const std::vector<char>& turned = {}) {
    IndexedMesh part;
    ++uses_;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      Triangle t = mesh_.triangles[faces[k]];
      if (!turned.empty() && turned[k] != 0) std::swap(t[1], t[2]);
      for (std::int32_t& v : t) {
        if (user_[v] != uses_) {
          user_[v] = uses_;
          number_[v] = static_cast<std::int32_t>(part.points.size());
          part.points.push_back(mesh_.points[v]);
        }
        v = number_[v];
      }
      part.triangles.push_back(t);
    }
    return part;
  }

 private:
  const IndexedMesh& mesh_;
  std::vector<std::int32_t> number_;
  std::vector<std::int32_t> user_;
  std::int32_t uses_ = 0;
};

/// Faces that are welded with each other and with no others.
struct Island {
  IndexedMesh mesh;
  FaceList source;  ///< their indices in the file
};

/// Replaces vertices and drops the faces with two equal corners.
void merge(const std::vector<std::int32_t>& first, Island& island) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < island.mesh.triangles.size(); ++f) {
    Triangle t = island.mesh.triangles[f];
    for (std::int32_t& v : t) {
      if (!first.empty()) v = first[v];
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    island.mesh.triangles[kept] = t;
    island.source[kept++] = island.source[f];
  }
  island.mesh.triangles.resize(kept);
  island.source.resize(kept);
}

/// Whether every edge has an even number of different faces.
bool is_closed(const Island& island, const Execution& execution) {
  if (island.mesh.triangles.empty()) return false;
  const std::vector<std::int32_t> rings = edge_rings(island.mesh, execution);
  std::vector<Triangle> others;
  for (std::size_t h = 0; h < rings.size(); ++h) {
    others.clear();
    bool is_first = true;
    std::size_t g = h;
    do {
      is_first = is_first && g >= h;
      Triangle key = island.mesh.triangles[g / 3];
      std::sort(key.begin(), key.end());
      if (std::find(others.begin(), others.end(), key) == others.end()) others.push_back(key);
      g = index(rings[g]);
    } while (is_first && g != h);
    if (is_first && others.size() % 2 != 0) return false;
  }
  return true;
}

/// Step 1 of split_bodies.
class IslandFinder {
 public:
  IslandFinder(const IndexedMesh& mesh, const std::vector<NamedFaces>& names,
               const Execution& execution)
      : mesh_(mesh), names_(names), execution_(execution), extractor_(mesh) {
    const Box box = box_of_faces(mesh);
    check_scan_size(box.sizes());
    diagonal_ = box.sizes().norm();
  }

  std::vector<Island> run() {
    FaceList all(mesh_.triangles.size());
    std::iota(all.begin(), all.end(), 0);
    descend(all, 0);
    return std::move(islands_);
  }

  /// Returns the surface of each name on both sides of walls: all faces with it on one side.
  /// Returns nothing if most of them are open, because the numbers mean something else.
  std::vector<Island> run_by_sides(const NamedFaces& sides) {
    std::vector<FaceList> lists(sides.names.size());
    for (std::size_t f = 0; f < sides.of_face.size() / 2; ++f) {
      for (const std::int32_t name : {sides.of_face[2 * f], sides.of_face[2 * f + 1]}) {
        if (name >= 0) lists[name].push_back(static_cast<std::int32_t>(f));
      }
    }
    std::size_t closed = 0;
    for (const FaceList& list : lists) {
      islands_.push_back(island_of(list));
      if (is_closed(islands_.back(), execution_)) ++closed;
    }
    if (2 * closed < islands_.size()) islands_.clear();
    return std::move(islands_);
  }

  std::size_t merged() const { return merged_; }
  double distance() const { return distance_; }

 private:
  /// Levels are the names, then the file's vertices, then the whole.
  void descend(const FaceList& faces, std::size_t level) {
    if (level > names_.size()) return add_whole(faces);
    const std::vector<FaceList> parts =
        level < names_.size() ? by_name(faces, names_[level]) : by_vertices(faces);
    if (parts.size() < 2) return descend(faces, level + 1);
    FaceList rest;
    std::vector<const FaceList*> closed;
    std::vector<Island> islands;
    for (const FaceList& part : parts) {
      Island island = island_of(part);
      if (!is_closed(island, execution_)) {
        rest.insert(rest.end(), part.begin(), part.end());
        continue;
      }
      closed.push_back(&part);
      if (level == names_.size()) islands.push_back(std::move(island));
    }
    std::sort(rest.begin(), rest.end());
    if (!rest.empty() && !closed.empty() && is_torn(faces, rest)) {
      return descend(faces, level + 1);
    }
    for (std::size_t k = 0; k < closed.size(); ++k) {
      if (level < names_.size()) {
        descend(*closed[k], level + 1);
      } else {
        islands_.push_back(std::move(islands[k]));
      }
    }
    if (!rest.empty()) descend(rest, level + 1);
  }

  /// Whether the rest is open along the closed parts, because walls are there once, with the name
  /// of one side.
  bool is_torn(const FaceList& faces, const FaceList& rest) {
    const Island whole = island_of(faces);
    const std::vector<std::int32_t> rings = edge_rings(whole.mesh, execution_);
    std::size_t open = 0;
    std::size_t torn = 0;
    for (std::size_t h = 0; h < rings.size(); ++h) {
      std::size_t of_rest = 0;
      std::size_t all = 0;
      bool is_first = true;
      std::size_t g = h;
      do {
        is_first = is_first && g >= h;
        const std::int32_t source = whole.source[g / 3];
        of_rest += std::binary_search(rest.begin(), rest.end(), source) ? 1U : 0U;
        ++all;
        g = index(rings[g]);
      } while (is_first && g != h);
      if (!is_first || of_rest % 2 == 0) continue;
      ++open;
      if (all > of_rest) ++torn;
    }
    return 2 * torn > open;
  }

  static std::vector<FaceList> by_name(const FaceList& faces, const NamedFaces& names) {
    std::vector<FaceList> parts(names.names.size() + 1);  // the last without a name
    for (const std::int32_t f : faces) {
      const std::int32_t name = names.of_face[f];
      (name < 0 ? parts.back() : parts[name]).push_back(f);
    }
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                               [](const FaceList& part) { return part.empty(); }),
                parts.end());
    return parts;
  }

  /// Returns nothing for a format without indices, whose faces have their own corners.
  std::vector<FaceList> by_vertices(const FaceList& faces) {
    IndexedMesh part = extractor_.extract(faces);
    constexpr std::size_t fewest_faces = 4;  // of a closed surface
    // Edges would tell bodies that share a vertex apart; the next step does.
    boost::disjoint_sets_with_storage<> linked(part.points.size());
    for (const Triangle& t : part.triangles) {
      linked.union_set(index(t[0]), index(t[1]));
      linked.union_set(index(t[0]), index(t[2]));
    }
    std::vector<std::int32_t> number(part.points.size(), -1);
    std::vector<FaceList> parts;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      std::int32_t& known = number[linked.find_set(index(part.triangles[k][0]))];
      if (known < 0) {
        known = static_cast<std::int32_t>(parts.size());
        parts.emplace_back();
      }
      parts[known].push_back(faces[k]);
    }
    if (parts.size() * fewest_faces > faces.size()) parts.clear();
    return parts;
  }

  Island island_of(const FaceList& faces) {
    Island island{extractor_.extract(faces), faces};
    const double tolerance = MeshCheckOptions().weld_tolerance * diagonal_;
    const Box box = box_of_faces(island.mesh);
    merge(find_equal_points(island.mesh.points, box, tolerance, execution_).first, island);
    return island;
  }

  void add_whole(const FaceList& faces) {
    Island island = island_of(faces);
    if (island.mesh.triangles.empty()) return;
    const SeamWeld seams =
        find_seams(island.mesh, edge_rings(island.mesh, execution_), diagonal_, execution_);
    if (seams.weld.welded > 0) {
      merge(seams.weld.first, island);
      merged_ += seams.weld.welded;
      distance_ = std::max(distance_, seams.distance);
    }
    islands_.push_back(std::move(island));
  }

  const IndexedMesh& mesh_;
  const std::vector<NamedFaces>& names_;
  const Execution& execution_;
  Extractor extractor_;
  double diagonal_ = 0.0;
  std::vector<Island> islands_;
  std::size_t merged_ = 0;
  double distance_ = 0.0;
};

/// The surface of a body or of a void.
struct Part {
  IndexedMesh mesh;  ///< outward
  Box box;
  double volume = 0.0;  ///< if closed, else 0
  std::size_t boundary_edges = 0;
  FaceList source;                        ///< its faces in the file
  std::size_t piece = 0;                  ///< parts of a piece do not contain each other
  bool is_void = false;                   ///< an even number of surfaces lies outside
  bool is_always_solid = false;           ///< its piece has walls between bodies
  bool was_inward = false;                ///< in the file
  std::int32_t side_name = -1;            ///< of this side of its walls; -1: they have none
  std::vector<std::size_t> holders = {};  ///< closed parts that contain it
};

/// The outer surface of several cells.
struct Outside {
  IndexedMesh mesh;  ///< outward
  double volume = 0.0;
};

/// Step 2 of split_bodies.
class PartFinder {
 public:
  explicit PartFinder(const Execution& execution) : execution_(execution) {}

  /// `side_name`: see Part.
  void add(const Island& island, std::int32_t side_name = -1) {
    side_name_ = side_name;
    const Components components =
        find_components(island.mesh, edge_rings(island.mesh, execution_), execution_);
    std::vector<FaceList> faces(components.list.size());
    for (std::size_t f = 0; f < island.mesh.triangles.size(); ++f) {
      faces[components.of_face[f]].push_back(static_cast<std::int32_t>(f));
    }
    Extractor extractor(island.mesh);
    for (std::size_t c = 0; c < faces.size(); ++c) {
      const Component& component = components.list[c];
      if (component.non_manifold_edges > 0) {
        const Island piece{extractor.extract(faces[c]), sources_of(faces[c], island.source)};
        if (add_cells(piece)) continue;
      }
      Part part;
      part.boundary_edges = component.boundary_edges;
      const bool is_closed = component.boundary_edges == 0 && component.orientable &&
                             component.non_manifold_edges == 0;
      if (is_closed) part.volume = std::abs(component.volume);
      part.was_inward = is_closed && component.volume < 0.0;
      std::vector<char> turned;
      for (const std::int32_t f : faces[c]) {
        turned.push_back(static_cast<char>((components.turned[f] != 0) != part.was_inward));
      }
      part.mesh = extractor.extract(faces[c], turned);
      part.source = sources_of(faces[c], island.source);
      add_part(std::move(part));
      ++pieces;
    }
  }

  std::vector<Part> parts;
  std::map<std::size_t, Outside> outsides;  ///< of pieces whose parts are not their outside
  std::size_t pieces = 0;
  std::size_t left_out = 0;  ///< faces that enclose nothing
  std::size_t maybe_voids = 0;
  std::size_t inclusions = 0;  ///< bodies in a body, by their names; counted by assemble

 private:
  static FaceList sources_of(const FaceList& faces, const FaceList& source) {
    FaceList result;
    for (const std::int32_t f : faces) result.push_back(source[f]);
    return result;
  }

  void add_part(Part part) {
    part.box = box_of_faces(part.mesh);
    part.piece = pieces;
    part.side_name = side_name_;
    parts.push_back(std::move(part));
  }

  [[noreturn]] static void refuse_unclear(const IndexedMesh& mesh, const MeshCells& cells,
                                          std::int32_t h) {
    const Vector3& p = mesh.points[origin_of(cells.faces, h)];
    refuse(
        "At (" + format_number(p.x()) + ", " + format_number(p.y()) + ", " + format_number(p.z()) +
        ") more than two faces meet in an edge, and some of them lie on each other. So the bodies "
        "that touch there cannot be told apart. Export each body as an object or a file of its "
        "own, or the surfaces as .vtp with their labels.");
  }

  /// Adds the regions of a piece. Returns false if it encloses nothing.
  bool add_cells(const Island& piece) {
    const MeshCells cells = find_mesh_cells(piece.mesh, execution_);
    if (cells.unclear.front() >= 0) refuse_unclear(piece.mesh, cells, cells.unclear.front());
    IndexedMesh once;
    once.points = piece.mesh.points;
    once.triangles = cells.faces;
    Extractor extractor(once);
    std::size_t outside = 0;
    while (!cells.list[outside].is_outside) ++outside;
    const double volume = -cells.list[outside].volume;
    // Regions as small as rounding makes them.
    const double smallest = 1e-12 * volume;
    const bool is_double = std::all_of(cells.reverse.begin(), cells.reverse.end(),
                                       [](std::int32_t reverse) { return reverse >= 0; });
    std::size_t found = 0;
    for (std::size_t c = 0; c < cells.list.size(); ++c) {
      const MeshCell& cell = cells.list[c];
      if (cell.is_outside || !(cell.volume > smallest)) continue;
      Part part = part_of(static_cast<std::int32_t>(c), cells, piece.source, extractor);
      part.volume = cell.volume;
      part.is_void = !cell.is_solid;
      part.is_always_solid = is_double || cells.has_single_walls.front() != 0;
      if (cell.may_be_void) ++maybe_voids;
      add_part(std::move(part));
      ++found;
    }
    if (found == 0 && cells.lying.front() >= 0) {
      refuse_unclear(piece.mesh, cells, cells.lying.front());
    }
    if (found == 0) return false;
    Part around = part_of(static_cast<std::int32_t>(outside), cells, piece.source, extractor);
    for (Triangle& t : around.mesh.triangles) std::swap(t[1], t[2]);
    outsides[pieces] = {std::move(around.mesh), volume};
    add_rest(cells, piece, extractor);
    ++pieces;
    return true;
  }

  /// Returns the surface of a cell, with its normals out of it.
  static Part part_of(std::int32_t cell, const MeshCells& cells, const FaceList& source,
                      Extractor& extractor) {
    FaceList faces;
    Part part;
    std::vector<char> turned;
    std::size_t inward = 0;
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
      const bool looks_in = cells.before(f) == cell;
      if (looks_in == (cells.behind(f) == cell)) continue;
      const bool has_own = looks_in && cells.reverse[f] >= 0;
      faces.push_back(static_cast<std::int32_t>(f));
      turned.push_back(static_cast<char>(looks_in));
      if (looks_in && !has_own) ++inward;
      part.source.push_back(source[has_own ? cells.reverse[f] : cells.source[f]]);
    }
    part.was_inward = inward == faces.size();
    part.mesh = extractor.extract(faces, turned);
    return part;
  }

  /// Adds the faces with the outside on both sides, or counts them if they are few.
  void add_rest(const MeshCells& cells, const Island& piece, Extractor& extractor) {
    // As the limit of the repaired area. Where faces lie on each other they may be a body's.
    const std::int32_t lying = cells.lying.front();
    const double largest_share = lying < 0 ? 0.05 : 0.001;
    FaceList faces;
    double area = 0.0;
    double rest = 0.0;
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
      const double own = triangle_area(piece.mesh, cells.faces[f]);
      area += own;
      if (cells.before(f) != cells.behind(f)) continue;
      rest += own;
      faces.push_back(static_cast<std::int32_t>(f));
    }
    if (faces.empty()) return;
    if (rest <= largest_share * area) {
      left_out += faces.size();
      return;
    }
    if (lying >= 0) refuse_unclear(piece.mesh, cells, lying);
    Part part;
    part.mesh = extractor.extract(faces);
    for (const std::int32_t f : faces) {
      part.source.push_back(piece.source[cells.source[f]]);
    }
    const std::vector<std::int32_t> rings = edge_rings(part.mesh, execution_);
    for (std::size_t h = 0; h < rings.size(); ++h) {
      if (index(rings[h]) == h) ++part.boundary_edges;
    }
    add_part(std::move(part));
  }

  const Execution& execution_;
  std::int32_t side_name_ = -1;
};

/// Returns a hash of the positions of a face's corners, in any order.
std::uint64_t place_of(const IndexedMesh& mesh, const Triangle& t) {
  std::array<std::uint64_t, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double coordinate : mesh.points[t[k]]) {
      const double value = coordinate + 0.0;  // -0 is 0
      std::uint64_t bits = 0;
      static_assert(sizeof bits == sizeof value);
      std::copy_n(reinterpret_cast<const unsigned char*>(&value), sizeof value,
                  reinterpret_cast<unsigned char*>(&bits));
      corners[k] = (corners[k] ^ bits) * 0x9E3779B97F4A7C15U;
      corners[k] ^= corners[k] >> 29U;
    }
  }
  return corners[0] + corners[1] + corners[2];
}

std::unordered_set<std::uint64_t> places_of(const IndexedMesh& mesh) {
  std::unordered_set<std::uint64_t> places;
  for (const Triangle& t : mesh.triangles) places.insert(place_of(mesh, t));
  return places;
}

bool are_equal_volumes(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(a, b); }

/// Drops closed parts that are there before. Returns their number.
std::size_t drop_copies(PartFinder& found) {
  std::vector<Part>& parts = found.parts;
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts[a].volume < parts[b].volume; });
  std::vector<char> dropped(parts.size(), 0);
  const auto is_copy = [&](const Part& a, const Part& b) {
    if (a.volume == 0.0 || a.mesh.triangles.size() != b.mesh.triangles.size() ||
        a.was_inward != b.was_inward || a.is_void || b.is_void || a.piece == b.piece ||
        a.side_name != b.side_name ||
        !((a.box.min() - b.box.min()).norm() <= 1e-9 * a.box.sizes().norm())) {
      return false;
    }
    const std::unordered_set<std::uint64_t> places = places_of(a.mesh);
    return std::all_of(b.mesh.triangles.begin(), b.mesh.triangles.end(),
                       [&](const Triangle& t) { return places.count(place_of(b.mesh, t)) > 0; });
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (dropped[order[i]] != 0) continue;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (!are_equal_volumes(parts[order[i]].volume, parts[order[j]].volume)) break;
      if (dropped[order[j]] == 0 && is_copy(parts[order[i]], parts[order[j]]))
        dropped[order[j]] = 1;
    }
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (dropped[k] == 0 && kept++ != k) parts[kept - 1] = std::move(parts[k]);
  }
  const std::size_t count = parts.size() - kept;
  parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(kept), parts.end());
  return count;
}

/// Appends the centres of some faces spread over `inner`, because parts that intersect contain only
/// some of each other's faces. Leaves out faces that both parts have, because their centres are
/// neither inside nor outside; there is none if both have all.
void append_centres(const Part& inner, const std::unordered_set<std::uint64_t>& outer,
                    std::vector<Vector3>& points) {
  constexpr std::size_t most_asked = 16;
  FaceList own;
  for (std::size_t f = 0; f < inner.mesh.triangles.size(); ++f) {
    if (outer.count(place_of(inner.mesh, inner.mesh.triangles[f])) > 0) continue;
    own.push_back(static_cast<std::int32_t>(f));
  }
  const std::size_t asked = std::min(own.size(), most_asked);
  for (std::size_t k = 0; k < asked; ++k) {
    const auto [a, b, c] = corners_of(inner.mesh, own[k * own.size() / asked]);
    points.emplace_back((a + b + c) / 3.0);
  }
}

/// The points of a part, among those of several that are asked at once.
struct AskedPart {
  std::size_t part;
  std::size_t begin;
  std::size_t end;
  std::size_t inside = 0;  ///< number of these points inside of a mesh

  std::size_t count() const { return end - begin; }
};

void count_inside(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                  std::vector<AskedPart>& asked, const Execution& execution) {
  if (asked.empty()) return;
  const std::vector<char> inside = are_inside(mesh, points, execution);
  for (AskedPart& one : asked) {
    const auto first = inside.begin();
    one.inside =
        static_cast<std::size_t>(std::count(first + static_cast<std::ptrdiff_t>(one.begin),
                                            first + static_cast<std::ptrdiff_t>(one.end), 1));
  }
}

BoxGrid grid_of(const std::vector<Part>& parts) {
  std::vector<BoxGrid::Box> boxes;
  boxes.reserve(parts.size());
  for (const Part& part : parts) boxes.push_back(part.box);
  return BoxGrid(std::move(boxes));
}

/// Finds for every closed part the parts that contain it. Surfaces with different names on their
/// side of walls do not: each has all walls of its body.
void find_holders(std::vector<Part>& parts, const Execution& execution) {
  const BoxGrid grid = grid_of(parts);
  std::vector<std::int32_t> near;
  for (std::size_t outer = 0; outer < parts.size(); ++outer) {
    execution.report(static_cast<double>(outer) / static_cast<double>(parts.size()),
                     "Splitting the mesh");
    const Part& holder = parts[outer];
    if (holder.volume == 0.0) continue;
    std::vector<AskedPart> asked;
    std::vector<Vector3> points;
    std::unordered_set<std::uint64_t> places;
    grid.find(holder.box, near);
    for (const std::int32_t number : near) {
      const std::size_t inner = index(number);
      const Part& part = parts[inner];
      if (part.piece == holder.piece || part.volume == 0.0 || !holder.box.contains(part.box) ||
          part.side_name != holder.side_name) {
        continue;
      }
      // What fills a pore is inside it, though it is as large.
      const bool is_equal = are_equal_volumes(part.volume, holder.volume);
      if (is_equal ? !(holder.was_inward && !part.was_inward) : part.volume > holder.volume) {
        continue;
      }
      if (places.empty()) places = places_of(holder.mesh);
      const std::size_t begin = points.size();
      append_centres(part, places, points);
      asked.push_back({inner, begin, points.size()});
    }
    count_inside(holder.mesh, points, asked, execution);
    for (const AskedPart& one : asked) {
      if (one.inside == one.count()) parts[one.part].holders.push_back(outer);
    }
  }
}

/// Appends points a little below some faces spread over a surface, about an edge deep.
void append_depths(const IndexedMesh& mesh, std::vector<Vector3>& points) {
  constexpr std::size_t most_asked = 16;
  const std::size_t faces = mesh.triangles.size();
  const std::size_t asked = std::min(faces, most_asked);
  for (std::size_t k = 0; k < asked; ++k) {
    const auto [a, b, c] = corners_of(mesh, k * faces / asked);
    const Vector3 normal = doubled_area_normal(a, b, c);
    const double doubled_area = normal.norm();
    if (!(doubled_area > 0.0)) continue;
    points.emplace_back((a + b + c) / 3.0 - normal / std::sqrt(2.0 * doubled_area));
  }
}

/// Puts what fills a pore inside it, though both intersect: their surfaces were made one by one.
void fill_pores(std::vector<Part>& parts, const Execution& execution) {
  const auto contains = [](const std::vector<std::size_t>& list, std::size_t one) {
    return std::find(list.begin(), list.end(), one) != list.end();
  };
  const BoxGrid grid = grid_of(parts);
  std::vector<std::int32_t> near;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Part& pore = parts[p];
    if (pore.volume == 0.0 || !pore.was_inward || pore.holders.empty()) continue;
    std::vector<AskedPart> asked;
    std::vector<Vector3> points;
    grid.find(pore.box, near);
    for (const std::int32_t number : near) {
      const std::size_t q = index(number);
      const Part& part = parts[q];
      if (part.volume == 0.0 || part.was_inward || part.piece == pore.piece ||
          part.side_name != pore.side_name || contains(part.holders, p) ||
          std::none_of(pore.holders.begin(), pore.holders.end(),
                       [&](std::size_t h) { return h != q && contains(part.holders, h); })) {
        continue;
      }
      const std::size_t begin = points.size();
      append_depths(part.mesh, points);
      asked.push_back({q, begin, points.size()});
    }
    count_inside(pore.mesh, points, asked, execution);
    for (const AskedPart& one : asked) {
      if (2 * one.inside <= one.count()) continue;
      parts[one.part].holders.push_back(p);
      pore.holders.erase(std::remove(pore.holders.begin(), pore.holders.end(), one.part),
                         pore.holders.end());
    }
  }
}

/// Adds a surface as a pore, turned inward.
void add_pore(const IndexedMesh& pore, double volume, MeshBody& body) {
  const auto first = static_cast<std::int32_t>(body.mesh.points.size());
  body.mesh.points.insert(body.mesh.points.end(), pore.points.begin(), pore.points.end());
  for (const Triangle& t : pore.triangles) {
    body.mesh.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
  }
  ++body.pores;
  body.pore_volume += volume;
}

/// Returns the name that all faces of a list have, else -1.
std::int32_t only_name(const NamedFaces& level, const FaceList& faces) {
  const std::int32_t name = level.of_face[faces.front()];
  const bool has_one = name >= 0 && std::all_of(faces.begin(), faces.end(), [&](std::int32_t f) {
                         return level.of_face[f] == name;
                       });
  return has_one ? name : -1;
}

/// Whether names tell two parts apart.
bool have_own_names(const std::vector<NamedFaces>& names, const Part& a, const Part& b) {
  return std::any_of(names.begin(), names.end(), [&](const NamedFaces& level) {
    const std::int32_t name = only_name(level, a.source);
    const std::int32_t other = only_name(level, b.source);
    return name >= 0 && other >= 0 && name != other;
  });
}

/// Names bodies by the coarsest names that tell them apart, else by the coarsest.
void name_bodies(const std::vector<NamedFaces>& names, const std::vector<FaceList>& sources,
                 std::vector<MeshBody>& bodies) {
  for (const NamedFaces& level : names) {
    std::vector<std::int32_t> own(bodies.size(), -1);
    std::vector<std::size_t> users(level.names.size(), 0);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      own[k] = only_name(level, sources[k]);
      if (own[k] >= 0) ++users[own[k]];
    }
    std::map<std::string, std::size_t> namesakes;
    for (const MeshBody& body : bodies) ++namesakes[body.name];
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      if (own[k] < 0) continue;
      const bool is_better = users[own[k]] == 1 && namesakes[bodies[k].name] > 1;
      if (bodies[k].name.empty() || is_better) bodies[k].name = level.names[own[k]];
    }
  }
}

/// Step 3 of split_bodies.
std::vector<MeshBody> assemble(PartFinder& found, const std::vector<NamedFaces>& names,
                               const NamedFaces& sides) {
  std::vector<Part>& parts = found.parts;
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // What contains comes before what is contained.
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return parts[a].holders.size() < parts[b].holders.size();
  });
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> place(parts.size(), 0);
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  std::vector<char> solid(parts.size(), 0);
  std::vector<std::size_t> container(parts.size(), none);
  for (const std::size_t p : order) {
    Part& part = parts[p];
    for (const std::size_t holder : part.holders) {
      if (container[p] == none || place[holder] > place[container[p]]) container[p] = holder;
    }
    const bool is_in_solid = container[p] != none && solid[container[p]] != 0;
    // A surface with a name of its own that looks out of its body is an inclusion, not a pore.
    const bool is_inclusion = is_in_solid && !part.was_inward && !part.is_void &&
                              part.side_name < 0 &&
                              have_own_names(names, part, parts[container[p]]);
    if (is_inclusion) ++found.inclusions;
    solid[p] =
        static_cast<char>(part.is_always_solid || is_inclusion || is_in_solid == part.is_void);
  }
  std::vector<MeshBody> bodies;
  std::vector<FaceList> sources;
  std::vector<std::size_t> of_part(parts.size(), none);
  std::vector<std::size_t> by_face(parts.size());
  std::iota(by_face.begin(), by_face.end(), std::size_t{0});
  const auto first_face = [&](std::size_t p) {
    return *std::min_element(parts[p].source.begin(), parts[p].source.end());
  };
  std::stable_sort(by_face.begin(), by_face.end(),
                   [&](std::size_t a, std::size_t b) { return first_face(a) < first_face(b); });
  for (const std::size_t p : by_face) {
    if (solid[p] == 0) continue;
    of_part[p] = bodies.size();
    MeshBody body;
    body.volume = parts[p].volume;
    body.boundary_edges = parts[p].boundary_edges;
    body.mesh = parts[p].mesh;
    if (parts[p].side_name >= 0) body.name = sides.names[parts[p].side_name];
    bodies.push_back(std::move(body));
    sources.push_back(parts[p].source);
  }
  std::vector<char> is_added(found.pieces, 0);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Part& part = parts[p];
    if (container[p] == none || solid[container[p]] == 0 || is_added[part.piece] != 0) continue;
    is_added[part.piece] = 1;
    MeshBody& body = bodies[of_part[container[p]]];
    const auto outside = found.outsides.find(part.piece);
    if (outside == found.outsides.end()) {
      add_pore(part.mesh, part.volume, body);
    } else {
      add_pore(outside->second.mesh, outside->second.volume, body);
    }
  }
  name_bodies(names, sources, bodies);
  return bodies;
}

/// Returns a warning on bodies inside of each other in part; empty: there are none. Asks points an
/// edge below their surfaces: walls that were smoothed one by one cross a little.
std::string overlap_warning(const std::vector<MeshBody>& bodies, const Execution& execution) {
  constexpr std::size_t fewest = 2;
  std::vector<BoxGrid::Box> boxes;
  std::vector<std::vector<Vector3>> depths(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    boxes.push_back(box_of_faces(bodies[k].mesh));
    if (!bodies[k].is_closed()) continue;
    std::vector<Vector3> points;
    append_depths(bodies[k].mesh, points);
    // A thin body is less than an edge deep.
    const std::vector<char> inside = are_inside(bodies[k].mesh, points, execution);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (inside[i] != 0) depths[k].push_back(points[i]);
    }
  }
  const BoxGrid grid(boxes);
  std::vector<std::int32_t> near;
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t outer = 0; outer < bodies.size(); ++outer) {
    execution.report(1.0, "Splitting the mesh");
    if (!bodies[outer].is_closed()) continue;
    std::vector<AskedPart> asked;
    std::vector<Vector3> points;
    grid.find(boxes[outer], near);
    for (const std::int32_t number : near) {
      const std::size_t inner = index(number);
      if (inner == outer || depths[inner].empty()) continue;
      const std::size_t begin = points.size();
      points.insert(points.end(), depths[inner].begin(), depths[inner].end());
      asked.push_back({inner, begin, points.size()});
    }
    count_inside(bodies[outer].mesh, points, asked, execution);
    for (const AskedPart& one : asked) {
      if (one.inside >= fewest) pairs.insert(std::minmax(outer, one.part));
    }
  }
  if (pairs.empty()) return "";
  const auto& [first, second] = *pairs.begin();
  return "Bodies " + std::to_string(first + 1) + " and " + std::to_string(second + 1) + " overlap" +
         (pairs.size() == 1
              ? ""
              : ", and " + format_count(pairs.size() - 1, "other pair", "other pairs")) +
         ". What they have in common counts in both. Check that none is there twice.";
}

/// Drops faces without a finite position, and their names.
void keep_usable(IndexedMesh& mesh, std::vector<NamedFaces>& names) {
  std::vector<char> kept;
  for (const Triangle& t : mesh.triangles) {
    kept.push_back(std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
      return v >= 0 && index(v) < mesh.points.size() && mesh.points[v].allFinite();
    }));
  }
  keep_usable_faces(mesh);
  // Bodies of other sizes never lie as far. All others would be welded into one place.
  constexpr double farthest = 1e6;
  refuse_stray_vertex(find_stray_vertex(mesh), farthest);
  for (NamedFaces& level : names) {
    const std::size_t width = level.of_face.size() == 2 * kept.size() ? 2 : 1;
    std::size_t count = 0;
    for (std::size_t k = 0; k < width * kept.size(); ++k) {
      if (kept[k / width] != 0) level.of_face[count++] = level.of_face[k];
    }
    level.of_face.resize(count);
  }
}

/// Takes the first names of both sides of walls out of the names, and drops others of this kind.
NamedFaces take_sides(std::vector<NamedFaces>& names, std::size_t faces) {
  const auto first = std::stable_partition(
      names.begin(), names.end(),
      [&](const NamedFaces& level) { return level.of_face.size() != 2 * faces; });
  NamedFaces sides;
  if (first != names.end()) sides = std::move(*first);
  names.erase(first, names.end());
  return sides;
}

}  // namespace

MeshBodies split_bodies(IndexedMesh mesh, std::vector<NamedFaces> names,
                        const Execution& execution) {
  keep_usable(mesh, names);
  const NamedFaces sides = take_sides(names, mesh.triangles.size());
  IslandFinder finder(mesh, names, execution);
  PartFinder found(execution);
  {
    std::vector<Island> islands = finder.run_by_sides(sides);
    const bool have_sides = !islands.empty();
    if (!have_sides) islands = finder.run();
    for (std::size_t k = 0; k < islands.size(); ++k) {
      if (islands[k].mesh.triangles.empty()) continue;
      found.add(islands[k], have_sides ? static_cast<std::int32_t>(k) : -1);
      islands[k] = Island();
    }
  }
  if (found.parts.empty()) {
    refuse(
        "All faces of the mesh have two corners in one place, so it has no body. Load closed "
        "surfaces.");
  }
  MeshBodies result;
  if (finder.merged() > 0)
    result.warnings.push_back(merged_warning(finder.merged(), finder.distance()));
  const std::size_t copies = drop_copies(found);
  find_holders(found.parts, execution);
  fill_pores(found.parts, execution);
  result.list = assemble(found, names, sides);
  const std::string overlap = overlap_warning(result.list, execution);
  if (!overlap.empty()) result.warnings.push_back(overlap);
  if (copies > 0) {
    result.warnings.push_back(format_count(copies, "body is", "bodies are") +
                              " there more than once. Copies were left out.");
  }
  if (found.left_out > 0) {
    result.warnings.push_back(format_count(found.left_out,
                                           "face hangs on a body and encloses nothing. It was",
                                           "faces hang on bodies and enclose nothing. They were") +
                              " left out.");
  }
  if (found.inclusions > 0) {
    result.warnings.push_back(
        (found.inclusions == 1
             ? std::string("1 body lies in another: its surface has a name of its own")
             : std::to_string(found.inclusions) +
                   " bodies lie in others: their surfaces have names of their own") +
        " and faces that look outward. The body around has a pore there. If it is only a pore, "
        "leave out the body in it.");
  }
  if (found.maybe_voids > 0) {
    result.warnings.push_back("All faces of " +
                              format_count(found.maybe_voids, "body look", "bodies look") +
                              " into it, and it touches others on all sides. If it is a void "
                              "between them, leave it out.");
  }
  return result;
}

}  // namespace wscvt
