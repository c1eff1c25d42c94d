// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Sorts directions into the cells of a cube: six faces of resolution^2 squares. Planes through the
/// centre cut the faces in straight lines.
class CubeMap {
 public:
  /// `resolution` >= 1; this is not checked.
  explicit CubeMap(int resolution) : resolution_(resolution) {}

  /// Returns the resolution for about two triangles of an even mesh per cell. About five triangles
  /// then touch a cell, and a walk from a cell's own triangle takes a few steps.
  static int resolution_for(std::size_t triangles) {
    return std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles) / 12.0)), 1, 4096);
  }

  std::size_t cells() const {
    return 6 * static_cast<std::size_t>(resolution_) * static_cast<std::size_t>(resolution_);
  }

  /// Returns the cell of a direction. The length is arbitrary, but not zero.
  std::size_t cell(const Vector3& direction) const {
    int axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    const double depth = std::abs(direction[axis]);
    return cell(face_of(axis, direction[axis] < 0.0), coordinate(direction[(axis + 1) % 3] / depth),
                coordinate(direction[(axis + 2) % 3] / depth));
  }

  /// The image of a point on the cube. A vertex of several triangles needs only one.
  struct Image {
    Vector3 point;
    int face = -1;   ///< -1 on and beside the cube's edges
    double s = 0.0;  ///< on the face, in [-1, 1]
    double t = 0.0;
  };
  static Image image(const Vector3& point) {
    Image image;
    image.point = point;
    int axis = 0;
    const double depth = point.cwiseAbs().maxCoeff(&axis);
    const double s = point[(axis + 1) % 3];
    const double t = point[(axis + 2) % 3];
    const double inside = depth * (1.0 - margin);
    if (std::abs(s) < inside && std::abs(t) < inside) {
      image.face = face_of(axis, point[axis] < 0.0);
      image.s = s / depth;
      image.t = t / depth;
    }
    return image;
  }

  /// Calls visit(cell) for all cells in which the triangle a, b, c is seen from the origin, and
  /// some more: all cells of the rectangle about its image on each face of the cube. Visits the
  /// cells of each face in ascending order, each cell once.
  template <class Visit>
  void visit_cells(const Image& a, const Image& b, const Image& c, const Visit& visit) const {
    visit_rectangles(a, b, c, [&](int face, const Rectangle& rectangle) {
      const CellRange range = cells_of(rectangle);
      for (int row = range.first_row; row <= range.last_row; ++row) {
        for (int column = range.first_column; column <= range.last_column; ++column) {
          visit(cell(face, row, column));
        }
      }
    });
  }

  /// Returns the number of cells that visit_cells visits, without visiting them.
  std::size_t count_cells(const Image& a, const Image& b, const Image& c) const {
    std::size_t count = 0;
    visit_rectangles(a, b, c, [&](int, const Rectangle& rectangle) {
      const CellRange range = cells_of(rectangle);
      count += static_cast<std::size_t>(range.last_row - range.first_row + 1) *
               static_cast<std::size_t>(range.last_column - range.first_column + 1);
    });
    return count;
  }

 private:
  /// Images are enlarged by this much against rounding; the side of the cube is 2.
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

  static int face_of(int axis, bool negative) { return 2 * axis + (negative ? 1 : 0); }

  /// Calls visit(face, rectangle) for the triangle's image on every face of the cube that shows it.
  template <class Visit>
  static void visit_rectangles(const Image& a, const Image& b, const Image& c, const Visit& visit) {
    if (a.face >= 0 && a.face == b.face && a.face == c.face) {
      Rectangle rectangle;
      for (const Image* corner : {&a, &b, &c}) rectangle.add(corner->s, corner->t);
      visit(a.face, rectangle);
      return;
    }
    for (int face = 0; face < 6; ++face) {
      const Rectangle part = clipped({&a.point, &b.point, &c.point}, face / 2, face % 2 != 0);
      if (!part.empty()) visit(face, part);
    }
  }

  int coordinate(double s) const {
    const double scaled = 0.5 * (s + 1.0) * resolution_;
    return std::clamp(static_cast<int>(scaled), 0, resolution_ - 1);
  }

  std::size_t cell(int face, int row, int column) const {
    const auto n = static_cast<std::size_t>(resolution_);
    return (static_cast<std::size_t>(face) * n + static_cast<std::size_t>(row)) * n +
           static_cast<std::size_t>(column);
  }

  struct CellRange {
    int first_row;
    int last_row;
    int first_column;
    int last_column;
  };

  CellRange cells_of(const Rectangle& rectangle) const {
    return {coordinate(rectangle.low[0] - margin), coordinate(rectangle.high[0] + margin),
            coordinate(rectangle.low[1] - margin), coordinate(rectangle.high[1] + margin)};
  }

  /// Returns a rectangle about the image of the triangle's part in front of one face of the cube.
  static Rectangle clipped(const std::array<const Vector3*, 3>& corners, int axis, bool negative) {
    struct Polygon {
      std::array<Vector3, 8> points;
      std::size_t count = 0;
    };
    Polygon polygon;
    bool ahead = true;
    for (const Vector3* corner : corners) {
      Vector3 p((*corner)[(axis + 1) % 3], (*corner)[(axis + 2) % 3], (*corner)[axis]);
      if (negative) p.z() = -p.z();
      ahead = ahead && p.z() > 0.0;
      polygon.points[polygon.count++] = p;
    }
    if (ahead) {
      // The face's plane shows the whole triangle, as for most triangles across an edge of the
      // cube. The part of its rectangle on the face then contains the triangle's part there.
      Rectangle whole;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector3& p = polygon.points[i];
        whole.add(p.x() / p.z(), p.y() / p.z());
      }
      for (std::size_t k = 0; k < 2; ++k) {
        if (whole.low[k] > 1.0 + margin || whole.high[k] < -1.0 - margin) return Rectangle();
        whole.low[k] = std::clamp(whole.low[k], -1.0, 1.0);
        whole.high[k] = std::clamp(whole.high[k], -1.0, 1.0);
      }
      return whole;
    }
    // Otherwise the four planes through the origin and the face's edges cut the triangle.
    const auto height = [](int plane, const Vector3& p) {
      const double side = plane % 2 == 0 ? p[plane / 2] : -p[plane / 2];
      return p.z() * (1.0 + margin) - side;
    };
    // Most faces of the cube do not show the triangle, and one of their planes already proves it.
    for (int plane = 0; plane < 4; ++plane) {
      if (height(plane, polygon.points[0]) < 0.0 && height(plane, polygon.points[1]) < 0.0 &&
          height(plane, polygon.points[2]) < 0.0) {
        return Rectangle();
      }
    }
    for (int plane = 0; plane < 4; ++plane) {
      Polygon kept;
      for (std::size_t i = 0; i < polygon.count; ++i) {
        const Vector3& p = polygon.points[i];
        const Vector3& q = polygon.points[(i + 1) % polygon.count];
        const double hp = height(plane, p);
        const double hq = height(plane, q);
        if (hp >= 0.0) kept.points[kept.count++] = p;
        if ((hp < 0.0) != (hq < 0.0)) kept.points[kept.count++] = p + hp / (hp - hq) * (q - p);
      }
      polygon = kept;
    }
    Rectangle rectangle;
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const Vector3& p = polygon.points[i];
      if (p.z() > 0.0) {
        rectangle.add(p.x() / p.z(), p.y() / p.z());
      } else {  // the origin itself
        rectangle.add(-1.0, -1.0);
        rectangle.add(1.0, 1.0);
      }
    }
    return rectangle;
  }

  int resolution_;
};

}  // namespace wscvt
