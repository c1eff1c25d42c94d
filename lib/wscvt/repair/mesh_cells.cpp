// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/mesh_cells.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/sets.h"
#include "wscvt/repair/weld.h"

namespace wscvt {

namespace {

/// Cuts squares that two surfaces share along one diagonal: programs cut the two copies of a wall's
/// square from different corners on.
void align_diagonals(IndexedMesh& mesh, const Execution& execution) {
  const std::vector<std::int32_t> rings = edge_rings(mesh, execution);
  struct Square {
    std::array<std::int32_t, 4> corners;
    std::int32_t diagonal;
    bool operator<(const Square& other) const {
      return corners != other.corners ? corners < other.corners : diagonal < other.diagonal;
    }
  };
  std::vector<Square> squares;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const auto h = static_cast<std::int32_t>(k);
    const std::int32_t other = rings[k];
    if (other <= h || rings[index(other)] != h) continue;
    Square square{{origin_of(mesh.triangles, h), target_of(mesh.triangles, h),
                   origin_of(mesh.triangles, previous_half_edge(h)),
                   origin_of(mesh.triangles, previous_half_edge(other))},
                  h};
    std::sort(square.corners.begin(), square.corners.end());
    squares.push_back(square);
  }
  std::sort(squares.begin(), squares.end());
  for (std::size_t i = 0; i < squares.size();) {
    std::size_t end = i + 1;
    while (end < squares.size() && squares[end].corners == squares[i].corners) ++end;
    // A tetrahedron has six.
    if (end == i + 2) {
      const std::int32_t h = squares[i + 1].diagonal;
      const std::int32_t other = rings[index(h)];
      const std::int32_t p = origin_of(mesh.triangles, h);
      const std::int32_t q = target_of(mesh.triangles, h);
      const std::int32_t r = origin_of(mesh.triangles, previous_half_edge(h));
      const std::int32_t s = origin_of(mesh.triangles, previous_half_edge(other));
      const bool is_consistent = origin_of(mesh.triangles, other) == q;
      // Two of the three squares at the corner of a box share a face.
      const std::int32_t first = squares[i].diagonal;
      const std::int32_t a = origin_of(mesh.triangles, first);
      const auto is_of_first = [&](std::int32_t g) {
        return face_of(g) == face_of(first) || face_of(g) == face_of(rings[index(first)]);
      };
      if (is_consistent && !is_of_first(h) && !is_of_first(other) && a != p && a != q) {
        mesh.triangles[face_of(h)] = {p, s, r};
        mesh.triangles[face_of(other)] = {s, q, r};
      }
    }
    i = end;
  }
}

/// Copies faces of the mesh, each once.
void take_faces_once(const IndexedMesh& mesh, MeshCells& cells) {
  struct Copy {
    Triangle key;  // the vertices in ascending order
    std::int32_t face;
    bool is_even;  // permutation of the key
  };
  std::vector<Copy> copies;
  copies.reserve(mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    Triangle key = t;
    std::sort(key.begin(), key.end());
    const std::size_t first =
        static_cast<std::size_t>(std::find(t.begin(), t.end(), key[0]) - t.begin());
    copies.push_back({key, static_cast<std::int32_t>(f), t[following(first)] == key[1]});
  }
  std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) {
    return a.key != b.key ? a.key < b.key : a.face < b.face;
  });
  std::vector<std::pair<std::int32_t, std::int32_t>> taken;  // face, its reverse
  for (std::size_t first = 0; first < copies.size();) {
    std::int32_t reverse = -1;
    std::size_t last = first + 1;
    for (; last < copies.size() && copies[last].key == copies[first].key; ++last) {
      if (reverse < 0 && copies[last].is_even != copies[first].is_even) reverse = copies[last].face;
    }
    taken.emplace_back(copies[first].face, reverse);
    first = last;
  }
  std::sort(taken.begin(), taken.end());
  for (const auto& [face, reverse] : taken) {
    cells.faces.push_back(mesh.triangles[index(face)]);
    cells.source.push_back(face);
    cells.reverse.push_back(reverse);
  }
}

class CellFinder {
 public:
  CellFinder(const IndexedMesh& mesh, const Execution& execution) : points_(mesh.points) {
    IndexedMesh aligned = mesh;
    align_diagonals(aligned, execution);
    take_faces_once(aligned, cells_);
    IndexedMesh once;
    once.points.resize(mesh.points.size());
    once.triangles = cells_.faces;
    rings_ = edge_rings(once, execution);
    const Box box = box_of_faces(mesh);
    rounding_ = 1e-11 * box.sizes().norm();
    is_oriented_ = find_orientation(box.min());
  }

  /// `fold`: see are_bodies. `pairs_all`: also where no faces lie on each other.
  void run(double fold, bool pairs_all) {
    fold_ = fold;
    pairs_all_ = pairs_all;
    Sets sides(2 * cells_.faces.size());
    Sets pieces(cells_.faces.size());
    std::vector<std::int32_t> left_out;
    for (std::size_t h = 0; h < rings_.size(); ++h) {
      if (!is_first(h)) continue;
      const std::vector<std::int32_t> edge = faces_on(static_cast<std::int32_t>(h));
      for (const std::int32_t g : edge) pieces.unite(face_of(g), h / 3);
      if (!unite_about(edge, sides)) left_out.push_back(static_cast<std::int32_t>(h));
    }
    std::size_t count = 0;
    std::tie(cells_.of_side, count) = sides.numbers();
    cells_.list.assign(count, MeshCell());
    std::tie(piece_of_, cells_.pieces) = pieces.numbers();
    cells_.unclear.assign(cells_.pieces, -1);
    cells_.lying.assign(cells_.pieces, -1);
    cells_.has_single_walls.assign(cells_.pieces, 0);
    measure();
    for (const std::int32_t h : left_out) {
      std::int32_t& lying = cells_.lying[index(piece_of_[face_of(h)])];
      if (lying < 0) lying = h;
      check_closed(h);
    }
    find_solids();
  }

  /// Notes faces with one region on both sides: they lie on others, because no surface is open.
  void doubt() {
    for (std::size_t f = 0; f < cells_.faces.size(); ++f) {
      std::int32_t& lying = cells_.lying[index(piece_of_[f])];
      if (cells_.before(f) == cells_.behind(f) && lying < 0) {
        lying = static_cast<std::int32_t>(3 * f);
      }
    }
  }

  /// Whether no face has the outside on the side of its body, as far as the faces tell that side.
  bool keeps_bodies() const {
    for (std::size_t f = 0; f < cells_.faces.size() && is_oriented_; ++f) {
      const std::int32_t body = looks_inward_ ? cells_.before(f) : cells_.behind(f);
      if (cells_.reverse[f] < 0 && cells_.list[index(body)].is_outside) return false;
    }
    return true;
  }

  MeshCells take() { return std::move(cells_); }

 private:
  /// Whether a half-edge is the first of its ring.
  bool is_first(std::size_t h) const {
    for (std::size_t g = index(rings_[h]); g != h; g = index(rings_[g])) {
      if (g < h) return false;
    }
    return true;
  }

  std::vector<std::int32_t> faces_on(std::int32_t first) const {
    std::vector<std::int32_t> edge;
    std::int32_t h = first;
    do {
      edge.push_back(h);
      h = rings_[index(h)];
    } while (h != first);
    return edge;
  }

  /// Whether a face runs from the edge's lower to its higher vertex.
  bool is_forward(std::int32_t h) const {
    return origin_of(cells_.faces, h) < target_of(cells_.faces, h);
  }

  /// The side of a face that looks to growing angles about the edge, and the other.
  std::size_t growing(std::int32_t h) const { return 2 * face_of(h) + (is_forward(h) ? 0 : 1); }
  std::size_t shrinking(std::int32_t h) const { return 2 * face_of(h) + (is_forward(h) ? 1 : 0); }

  /// Unites the sides that bound the same region at an edge. Returns false if it could not.
  bool unite_about(const std::vector<std::int32_t>& edge, Sets& sides) const {
    if (edge.size() < 3) {
      sides.unite(growing(edge.front()), shrinking(edge.back()));
      sides.unite(growing(edge.back()), shrinking(edge.front()));
      return true;
    }
    const std::int32_t a = origin_of(cells_.faces, edge[0]);
    const std::int32_t b = target_of(cells_.faces, edge[0]);
    const Vector3& low = points_[index(std::min(a, b))];
    const Vector3 axis = (points_[index(std::max(a, b))] - low).normalized();
    const Vector3 x = axis.unitOrthogonal();
    const Vector3 y = axis.cross(x);
    std::vector<Turn> turns;
    for (const std::int32_t h : edge) {
      const Vector3 d = points_[index(origin_of(cells_.faces, previous_half_edge(h)))] - low;
      const double height = portable::hypot(d.dot(x), d.dot(y));
      if (!(height > 0.0)) return false;
      turns.push_back({portable::atan2(d.dot(y), d.dot(x)), rounding_ / height, h});
    }
    std::sort(turns.begin(), turns.end(), [](const Turn& s, const Turn& t) {
      return s.angle != t.angle ? s.angle < t.angle : s.half_edge < t.half_edge;
    });
    bool is_clear = true;
    bool has_folds = false;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const double gap = gap_behind(turns, i);
      is_clear = is_clear && gap > turns[i].error + next_of(turns, i).error;
      has_folds = has_folds || gap < fold_;
    }
    if (is_oriented_ && (has_folds || pairs_all_) && unite_bodies(turns, sides)) return true;
    if (!is_clear) return false;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      sides.unite(growing(turns[i].half_edge), shrinking(next_of(turns, i).half_edge));
    }
    return true;
  }

  /// A face on an edge, at its angle about it.
  struct Turn {
    double angle;
    double error;
    std::int32_t half_edge;
  };

  static const Turn& next_of(const std::vector<Turn>& turns, std::size_t i) {
    return turns[i + 1 == turns.size() ? 0 : i + 1];
  }

  static double gap_behind(const std::vector<Turn>& turns, std::size_t i) {
    return next_of(turns, i).angle - turns[i].angle + (i + 1 == turns.size() ? 2.0 * pi : 0.0);
  }

  /// A body at an edge, from the face where it begins to the one where it ends.
  struct Wedge {
    std::int32_t begin;
    std::int32_t end;
    double angle;  // of the face where it begins
    double width;  // 0 to 2 pi
  };

  static double overlap(const Wedge& a, const Wedge& b) {
    const double apart = b.angle < a.angle ? b.angle - a.angle + 2.0 * pi : b.angle - a.angle;
    return std::clamp(a.width - apart, 0.0, b.width) +
           std::clamp(apart + b.width - 2.0 * pi, 0.0, a.width);
  }

  /// Whether faces of one body do not lie on each other but for `fold_`, and bodies hardly overlap.
  bool are_bodies(const std::vector<Wedge>& wedges) const {
    for (std::size_t i = 0; i < wedges.size(); ++i) {
      if (!(std::min(wedges[i].width, 2.0 * pi - wedges[i].width) >= fold_)) return false;
      for (std::size_t k = 0; k < i; ++k) {
        const double least = std::min(wedges[i].width, wedges[k].width);
        if (overlap(wedges[i], wedges[k]) > 0.4 * least) return false;
      }
    }
    return true;
  }

  /// Pairs the faces on an edge of surfaces that look outward: each body has two. Returns nothing
  /// if there is no such way.
  std::vector<Wedge> bodies_at(const std::vector<Turn>& turns) const {
    std::vector<Turn> begins;
    std::vector<Turn> ends;
    for (const Turn& turn : turns) {
      const bool is_begin = is_forward(turn.half_edge) == looks_inward_;
      if (is_wall(turn.half_edge) || is_begin) begins.push_back(turn);
      if (is_wall(turn.half_edge) || !is_begin) ends.push_back(turn);
    }
    constexpr std::size_t most_bodies = 6;
    if (begins.size() > most_bodies) return {};
    std::vector<std::size_t> order(ends.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<Wedge> best;
    double least = std::numeric_limits<double>::infinity();
    do {
      std::vector<Wedge> wedges;
      double sum = 0.0;
      for (std::size_t k = 0; k < begins.size(); ++k) {
        const Turn& end = ends[order[k]];
        const double width = end.angle - begins[k].angle;
        wedges.push_back({begins[k].half_edge, end.half_edge, begins[k].angle,
                          width < 0.0 ? width + 2.0 * pi : width});
        sum += wedges.back().width;
      }
      if (!(sum < least) || !are_bodies(wedges)) continue;
      least = sum;
      best = std::move(wedges);
    } while (std::next_permutation(order.begin(), order.end()));
    std::sort(best.begin(), best.end(), [](const Wedge& a, const Wedge& b) {
      const auto middle = [](const Wedge& w) {
        const double angle = w.angle + 0.5 * w.width;
        return angle > pi ? angle - 2.0 * pi : angle;
      };
      return middle(a) < middle(b);
    });
    return best;
  }

  /// Whether two bodies share a face.
  bool is_wall(std::int32_t h) const { return cells_.reverse[face_of(h)] >= 0; }

  /// Unites the sides of each body on an edge, and those of the gaps between. Returns false if the
  /// faces do not tell the bodies.
  bool unite_bodies(const std::vector<Turn>& turns, Sets& sides) const {
    const std::vector<Wedge> bodies = bodies_at(turns);
    const auto next = [&](std::size_t k) { return bodies[k + 1 == bodies.size() ? 0 : k + 1]; };
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const std::int32_t begin = next(k).begin;
      if (bodies[k].end != begin && (is_wall(bodies[k].end) || is_wall(begin))) return false;
    }
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const std::int32_t begin = next(k).begin;
      sides.unite(growing(bodies[k].begin), shrinking(bodies[k].end));
      if (bodies[k].end != begin) sides.unite(growing(bodies[k].end), shrinking(begin));
    }
    return !bodies.empty();
  }

  /// Returns whether the faces on each edge look to both directions equally often, as those of
  /// closed surfaces that all look outward, or inward.
  bool find_orientation(const Vector3& origin) {
    double volume = 0.0;
    for (std::size_t f = 0; f < cells_.faces.size(); ++f) {
      const Triangle& t = cells_.faces[f];
      if (cells_.reverse[f] >= 0) continue;
      volume += six_volumes(points_[index(t[0])] - origin, points_[index(t[1])] - origin,
                            points_[index(t[2])] - origin);
    }
    looks_inward_ = volume < 0.0;
    for (std::size_t h = 0; h < rings_.size(); ++h) {
      if (!is_first(h)) continue;
      int sum = 0;
      for (const std::int32_t g : faces_on(static_cast<std::int32_t>(h))) {
        if (cells_.reverse[face_of(g)] < 0) sum += is_forward(g) ? 1 : -1;
      }
      if (sum != 0) return false;
    }
    return true;
  }

  /// Measures each piece about a point of its own, so that one far from the origin keeps its
  /// digits, and finds its outside.
  void measure() {
    std::vector<std::int32_t> origin(cells_.pieces, -1);
    for (std::size_t f = 0; f < cells_.faces.size(); ++f) {
      const Triangle& t = cells_.faces[f];
      std::int32_t& first = origin[index(piece_of_[f])];
      if (first < 0) first = t[0];
      const Vector3& o = points_[index(first)];
      const double volume = six_volumes(points_[index(t[0])] - o, points_[index(t[1])] - o,
                                        points_[index(t[2])] - o) /
                            6.0;
      for (const std::int32_t c : {cells_.before(f), cells_.behind(f)}) {
        cells_.list[index(c)].piece = piece_of_[f];
      }
      cells_.list[index(cells_.behind(f))].volume += volume;
      cells_.list[index(cells_.before(f))].volume -= volume;
    }
    outside_.assign(cells_.pieces, -1);
    for (std::size_t c = 0; c < cells_.list.size(); ++c) {
      std::int32_t& known = outside_[index(cells_.list[c].piece)];
      if (known < 0 || cells_.list[c].volume < cells_.list[index(known)].volume) {
        known = static_cast<std::int32_t>(c);
      }
    }
    for (const std::int32_t c : outside_) cells_.list[index(c)].is_outside = true;
  }

  /// Notes an edge that was left out if the regions are not closed without it.
  void check_closed(std::int32_t h) {
    std::vector<std::pair<std::int32_t, int>> ends;  // cell, direction of the face as seen from it
    for (const std::int32_t g : faces_on(h)) {
      const int way = is_forward(g) ? 1 : -1;
      ends.emplace_back(cells_.behind(face_of(g)), way);
      ends.emplace_back(cells_.before(face_of(g)), -way);
    }
    std::sort(ends.begin(), ends.end());
    int sum = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      sum += ends[i].second;
      if (i + 1 < ends.size() && ends[i + 1].first == ends[i].first) continue;
      std::int32_t& unclear = cells_.unclear[index(piece_of_[face_of(h)])];
      if (sum != 0 && unclear < 0) unclear = h;
      sum = 0;
    }
  }

  /// Counts the surfaces between each cell and the outside.
  void find_solids() {
    struct Neighbour {
      std::int32_t cell;
      bool odd;
    };
    std::vector<std::vector<Neighbour>> neighbours(cells_.list.size());
    std::vector<char> all_double(cells_.pieces, 1);
    std::vector<char> looks_out(cells_.list.size(), 0);
    for (std::size_t f = 0; f < cells_.faces.size(); ++f) {
      const std::int32_t a = cells_.before(f);
      const std::int32_t b = cells_.behind(f);
      if (a == b) continue;
      const bool odd = cells_.reverse[f] < 0;
      neighbours[index(a)].push_back({b, odd});
      neighbours[index(b)].push_back({a, odd});
      looks_out[index(b)] = 1;
      if (!odd) looks_out[index(a)] = 1;
      if (odd) all_double[index(piece_of_[f])] = 0;
    }
    std::vector<std::int8_t> parity(cells_.list.size(), -1);  // a char has no sign on Arm
    for (const std::int32_t outside : outside_) {
      bool is_consistent = true;
      std::vector<std::int32_t> found = {outside};
      parity[index(outside)] = 0;
      for (std::size_t k = 0; k < found.size(); ++k) {
        const std::int8_t own = parity[index(found[k])];
        for (const Neighbour& next : neighbours[index(found[k])]) {
          const std::int8_t due = next.odd ? static_cast<std::int8_t>(1 - own) : own;
          std::int8_t& known = parity[index(next.cell)];
          if (known < 0) found.push_back(next.cell);
          if (known < 0) known = due;
          is_consistent = is_consistent && known == due;
        }
      }
      const bool all = !is_consistent || all_double[index(cells_.list[index(outside)].piece)] != 0;
      for (std::size_t k = 1; k < found.size(); ++k) {
        MeshCell& cell = cells_.list[index(found[k])];
        cell.is_solid = all || parity[index(found[k])] == 1;
        if (!is_consistent) cells_.has_single_walls[index(cell.piece)] = 1;
        cell.may_be_void = !is_consistent && looks_out[index(found[k])] == 0;
      }
    }
  }

  const std::vector<Vector3>& points_;
  MeshCells cells_;
  std::vector<std::int32_t> rings_;
  std::vector<std::int32_t> piece_of_;  // of every face
  std::vector<std::int32_t> outside_;   // of every piece
  double rounding_ = 0.0;               // of positions, length
  double fold_ = 0.0;                   // see are_bodies, radians
  bool pairs_all_ = false;
  bool is_oriented_ = false;  // see find_orientation
  bool looks_inward_ = false;
};

}  // namespace

MeshCells find_mesh_cells(const IndexedMesh& mesh, const Execution& execution) {
  // Radians: of faces in single precision, and of walls of several corners, each cut by itself.
  constexpr double rounded = 1e-3;
  constexpr double crossing = 0.35;
  CellFinder finder(mesh, execution);
  finder.run(rounded, false);
  if (!finder.keeps_bodies()) finder.run(crossing, true);
  if (!finder.keeps_bodies()) {
    finder.run(0.0, false);
    finder.doubt();
  }
  return finder.take();
}

}  // namespace wscvt
