// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/mesh_cells.h"

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// Sets that can be united.
class Sets {
 public:
  explicit Sets(std::size_t count)
      : parent_(count), rank_(count, 0), sets_(rank_.data(), parent_.data()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void unite(std::size_t a, std::size_t b) {
    sets_.union_set(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
  }

  /// Returns the number of the set of each item, in the order of their first items, and the number
  /// of sets.
  std::pair<std::vector<std::int32_t>, std::size_t> numbers() {
    std::vector<std::int32_t> number(parent_.size(), -1);
    std::vector<std::int32_t> of_root(parent_.size(), -1);
    std::int32_t count = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      std::int32_t& known = of_root[index(sets_.find_set(static_cast<std::int32_t>(i)))];
      if (known < 0) known = count++;
      number[i] = known;
    }
    return {std::move(number), static_cast<std::size_t>(count)};
  }

 private:
  std::vector<std::int32_t> parent_;
  std::vector<unsigned char> rank_;
  boost::disjoint_sets<unsigned char*, std::int32_t*> sets_;
};

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
    Vector3 low = points_[index(cells_.faces[0][0])];
    Vector3 high = low;
    for (const Triangle& t : cells_.faces) {
      for (const std::int32_t v : t) {
        low = low.cwiseMin(points_[index(v)]);
        high = high.cwiseMax(points_[index(v)]);
      }
    }
    rounding_ = 1e-11 * (high - low).norm();
  }

  MeshCells run() {
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
    cells_.list.resize(count);
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
    return std::move(cells_);
  }

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
    struct Turn {
      double angle;
      double error;
      std::int32_t half_edge;
    };
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
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const bool is_last = i + 1 == turns.size();
      const Turn& next = turns[is_last ? 0 : i + 1];
      const double gap = next.angle - turns[i].angle + (is_last ? 2.0 * pi : 0.0);
      if (!(gap > turns[i].error + next.error)) return false;
    }
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const Turn& next = turns[i + 1 == turns.size() ? 0 : i + 1];
      sides.unite(growing(turns[i].half_edge), shrinking(next.half_edge));
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
};

}  // namespace

MeshCells find_mesh_cells(const IndexedMesh& mesh, const Execution& execution) {
  return CellFinder(mesh, execution).run();
}

}  // namespace wscvt
