// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Directions sorted into the cells of a cube: six faces of resolution^2 squares, on which every
/// plane through the centre cuts a straight line.
class CubeMap {
 public:
  /// `resolution` >= 1, which is not checked.
  explicit CubeMap(int resolution) : resolution_(resolution) {}

  std::size_t cells() const {
    return 6 * static_cast<std::size_t>(resolution_) * static_cast<std::size_t>(resolution_);
  }

  /// The cell of a direction; its length does not matter, zero must not be.
  std::size_t cell(const Vector3& direction) const {
    int axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    const double depth = std::abs(direction[axis]);
    return cell(axis, direction[axis] < 0.0, coordinate(direction[(axis + 1) % 3] / depth),
                coordinate(direction[(axis + 2) % 3] / depth));
  }

  /// Calls visit(cell) for a set of cells that holds every direction in which the triangle a, b, c
  /// is seen from the origin, and some more: those of the rectangle about its image on each face of
  /// the cube. Cells come in ascending order on each face, none twice.
  template <class Visit>
  void visit_cells(const Vector3& a, const Vector3& b, const Vector3& c, const Visit& visit) const {
    visit_images(a, b, c, [&](int axis, bool negative, const Rectangle& image) {
      const CellRange range = cells_of(image);
      for (int row = range.first_row; row <= range.last_row; ++row) {
        for (int column = range.first_column; column <= range.last_column; ++column) {
          visit(cell(axis, negative, row, column));
        }
      }
    });
  }

  /// How many cells visit_cells visits, without going through them.
  std::size_t count_cells(const Vector3& a, const Vector3& b, const Vector3& c) const {
    std::size_t count = 0;
    visit_images(a, b, c, [&](int, bool, const Rectangle& image) {
      const CellRange range = cells_of(image);
      count += static_cast<std::size_t>(range.last_row - range.first_row + 1) *
               static_cast<std::size_t>(range.last_column - range.first_column + 1);
    });
    return count;
  }

 private:
  /// By how much images are made larger, against rounding; the side of the cube is 2.
  static constexpr double margin = 1e-9;

  struct Rectangle {
    std::array<double, 2> low{2.0, 2.0};
    std::array<double, 2> high{-2.0, -2.0};

    bool empty() const { return low[0] > high[0]; }
    void add(double s, double t) {
      low = {std::min(low[0], s), std::min(low[1], t)};
      high = {std::max(high[0], s), std::max(high[1], t)};
    }
  };

  /// Calls visit(axis, negative, rectangle) for the image of the triangle on every face of the cube
  /// that it is seen on.
  template <class Visit>
  void visit_images(const Vector3& a, const Vector3& b, const Vector3& c,
                    const Visit& visit) const {
    const std::array<const Vector3*, 3> corners{&a, &b, &c};
    int axis = 0;
    a.cwiseAbs().maxCoeff(&axis);
    const bool negative = a[axis] < 0.0;
    Rectangle image;
    bool on_one_face = true;
    for (const Vector3* corner : corners) {
      const double depth = negative ? -(*corner)[axis] : (*corner)[axis];
      const double inside = depth * (1.0 - margin);
      const double s = (*corner)[(axis + 1) % 3];
      const double t = (*corner)[(axis + 2) % 3];
      if (!(std::abs(s) < inside && std::abs(t) < inside)) {
        on_one_face = false;
        break;
      }
      image.add(s / depth, t / depth);
    }
    if (on_one_face) {
      visit(axis, negative, image);
      return;
    }
    for (int face = 0; face < 6; ++face) {
      const Rectangle part = clipped(corners, face / 2, face % 2 != 0);
      if (!part.empty()) visit(face / 2, face % 2 != 0, part);
    }
  }

  int coordinate(double s) const {
    const double scaled = 0.5 * (s + 1.0) * resolution_;
    return std::clamp(static_cast<int>(scaled), 0, resolution_ - 1);
  }

  std::size_t cell(int axis, bool negative, int row, int column) const {
    const auto n = static_cast<std::size_t>(resolution_);
    const int face_index = 2 * axis + (negative ? 1 : 0);
    const auto face = static_cast<std::size_t>(face_index);
    return (face * n + static_cast<std::size_t>(row)) * n + static_cast<std::size_t>(column);
  }

  struct CellRange {
    int first_row;
    int last_row;
    int first_column;
    int last_column;
  };

  CellRange cells_of(const Rectangle& image) const {
    return {coordinate(image.low[0] - margin), coordinate(image.high[0] + margin),
            coordinate(image.low[1] - margin), coordinate(image.high[1] + margin)};
  }

  /// Image of the part of a triangle in front of one face of the cube: cut by the four planes
  /// through the origin and the face's edges.
  static Rectangle clipped(const std::array<const Vector3*, 3>& corners, int axis, bool negative) {
    struct Polygon {
      std::array<Vector3, 8> points;
      std::size_t count = 0;
    };
    Polygon polygon;
    for (const Vector3* corner : corners) {
      Vector3 p((*corner)[(axis + 1) % 3], (*corner)[(axis + 2) % 3], (*corner)[axis]);
      if (negative) p.z() = -p.z();
      polygon.points[polygon.count++] = p;
    }
    for (int plane = 0; plane < 4; ++plane) {
      const auto height = [&](const Vector3& p) {
        const double side = plane % 2 == 0 ? p[plane / 2] : -p[plane / 2];
        return p.z() * (1.0 + margin) - side;
      };
      Polygon kept;
      for (std::size_t i = 0; i < polygon.count; ++i) {
        const Vector3& p = polygon.points[i];
        const Vector3& q = polygon.points[(i + 1) % polygon.count];
        const double hp = height(p);
        const double hq = height(q);
        if (hp >= 0.0) kept.points[kept.count++] = p;
        if ((hp < 0.0) != (hq < 0.0)) kept.points[kept.count++] = p + hp / (hp - hq) * (q - p);
      }
      polygon = kept;
    }
    Rectangle image;
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const Vector3& p = polygon.points[i];
      if (p.z() > 0.0) {
        image.add(p.x() / p.z(), p.y() / p.z());
      } else {  // the origin itself
        image.add(-1.0, -1.0);
        image.add(1.0, 1.0);
      }
    }
    return image;
  }

  int resolution_;
};

}  // namespace wscvt
