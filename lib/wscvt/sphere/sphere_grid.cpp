// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/sphere_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

namespace {

/// Minimum number of points per partial grid of `spread`, and maximum number of such grids. The
/// sums must not depend on the threads, and every grid costs memory.
constexpr std::size_t points_per_slab = 65536;
constexpr std::size_t maximum_slabs = 8;

/// Computes the inverse tangent on [0, 1] to 2e-16 by Cephes' rational approximation (Moshier 1992)
/// on [-0.21, 0.66]. Faster than std::atan2, and equal bits with every C library.
inline double arc_tangent_of_ratio(double smaller, double larger) {
  const bool upper = smaller > 0.66 * larger;
  const double numerator = upper ? smaller - larger : smaller;
  const double denominator = upper ? smaller + larger : larger;
  const double t = numerator / denominator;
  const double z = t * t;
  double p = -8.750608600031904122785e-1;
  p = p * z - 1.615753718733365076637e1;
  p = p * z - 7.500855792314704667340e1;
  p = p * z - 1.228866684490136173410e2;
  p = p * z - 6.485021904942025371773e1;
  double q = z + 2.485846490142306297962e1;
  q = q * z + 1.650270098316988542046e2;
  q = q * z + 4.328810604912902668951e2;
  q = q * z + 4.853903996359136964868e2;
  q = q * z + 1.945506571482613964425e2;
  return (upper ? 0.25 * pi : 0.0) + (t + t * (z * p / q));
}

/// Returns atan2(y, x) in [0, 2 pi). The smallest positive number prevents 0/0.
inline double azimuth_of(double y, double x) {
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  const double larger = std::max(std::max(ax, ay), 1e-300);
  double angle = arc_tangent_of_ratio(std::min(ax, ay), larger);
  angle = ay > ax ? 0.5 * pi - angle : angle;
  angle = x < 0.0 ? pi - angle : angle;
  return y < 0.0 ? 2.0 * pi - angle : angle;
}

/// Computes the Lagrange weights of the nodes 1 - stencil/2 ... stencil/2 at t in [0, 1].
template <int stencil>
inline void lagrange_weights(double t, double (&weights)[stencil]);

template <>
inline void lagrange_weights<4>(double t, double (&weights)[4]) {
  const double a = t + 1.0;
  const double c = t - 1.0;
  const double d = t - 2.0;
  weights[0] = t * c * d * (-1.0 / 6.0);
  weights[1] = a * c * d * (1.0 / 2.0);
  weights[2] = a * t * d * (-1.0 / 2.0);
  weights[3] = a * t * c * (1.0 / 6.0);
}

template <>
inline void lagrange_weights<6>(double t, double (&weights)[6]) {
  const double a = t + 2.0;
  const double b = t + 1.0;
  const double d = t - 1.0;
  const double e = t - 2.0;
  const double f = t - 3.0;
  const double ab = a * b;
  const double ef = e * f;
  const double td = t * d;
  weights[0] = b * td * ef * (-1.0 / 120.0);
  weights[1] = a * td * ef * (1.0 / 24.0);
  weights[2] = ab * d * ef * (-1.0 / 12.0);
  weights[3] = ab * t * ef * (1.0 / 12.0);
  weights[4] = ab * td * f * (-1.0 / 24.0);
  weights[5] = ab * td * e * (1.0 / 120.0);
}

/// The start of a stencil and the weights of its nodes.
template <int stencil>
struct Stencil {
  std::size_t start;
  double row[stencil];
  double column[stencil];
};

template <int stencil>
inline Stencil<stencil> make_stencil(const Vector3& u, int rows, std::size_t stride) {
  Stencil<stencil> result;
  const double sine = std::sqrt(u.x() * u.x() + u.y() * u.y());
  const double s = azimuth_of(sine, u.z()) * (rows / pi) - 0.5;
  const double phi = azimuth_of(u.y(), u.x()) * (rows / pi);
  // Rows are half a step off the poles. The clamps are for rounding and directions not of unit
  // length.
  const int j = std::clamp(static_cast<int>(s + 1.0) - 1, -1, rows - 1);
  const int k = std::clamp(static_cast<int>(phi), 0, 2 * rows - 1);
  lagrange_weights<stencil>(s - j, result.row);
  lagrange_weights<stencil>(phi - k, result.column);
  // The halo is stencil/2 wide, and the stencil starts stencil/2 - 1 nodes before (j, k).
  result.start = static_cast<std::size_t>(j + 1) * stride + static_cast<std::size_t>(k + 1);
  return result;
}

template <int stencil>
void interpolate_stencils(const double* nodes, int rows, std::size_t stride,
                          const Vector3* directions, std::size_t count, double* values) {
  for (std::size_t i = 0; i < count; ++i) {
    const Stencil<stencil> at = make_stencil<stencil>(directions[i], rows, stride);
    const double* node = nodes + at.start;
    double sum = 0.0;
    for (int a = 0; a < stencil; ++a) {
      double row_sum = 0.0;
      for (int b = 0; b < stencil; ++b) row_sum += at.column[b] * node[b];
      sum += at.row[a] * row_sum;
      node += stride;
    }
    values[i] = sum;
  }
}

template <int stencil>
void spread_stencils(double* nodes, int rows, std::size_t stride, const Vector3* directions,
                     std::size_t count, const double* values) {
  for (std::size_t i = 0; i < count; ++i) {
    const Stencil<stencil> at = make_stencil<stencil>(directions[i], rows, stride);
    double* node = nodes + at.start;
    for (int a = 0; a < stencil; ++a) {
      for (int b = 0; b < stencil; ++b) node[b] += at.row[a] * at.column[b] * values[i];
      node += stride;
    }
  }
}

}  // namespace

SphereGrid::SphereGrid(int rows, int stencil) : rows_(rows), stencil_(stencil), halo_(stencil / 2) {
  if (rows < 8 || (stencil != 4 && stencil != 6)) {
    refuse("A grid of the sphere needs 8 rows or more and a stencil of 4 or 6, not " +
           std::to_string(rows) + " and " + std::to_string(stencil) + ".");
  }
  nodes_.assign(static_cast<std::size_t>(rows_ + 2 * halo_) * stride(), 0.0);
}

SphereGrid::SphereGrid(int rows, int stencil, const std::vector<double>& values)
    : SphereGrid(rows, stencil) {
  const std::size_t count = static_cast<std::size_t>(rows_) * columns();
  if (values.size() != count) {
    refuse("A grid of the sphere with " + std::to_string(rows_) + " rows needs " +
           std::to_string(count) + " values, not " + std::to_string(values.size()) + ".");
  }
  for (int row = 0; row < rows_; ++row) {
    const double* begin = values.data() + static_cast<std::size_t>(row) * columns();
    std::copy(begin, begin + columns(), nodes_.data() + offset(row, 0));
  }
  fill_halo();
}

std::size_t SphereGrid::columns() const { return 2 * static_cast<std::size_t>(rows_); }

std::size_t SphereGrid::stride() const { return columns() + 2 * static_cast<std::size_t>(halo_); }

std::size_t SphereGrid::offset(int row, int column) const {
  return static_cast<std::size_t>(row + halo_) * stride() +
         static_cast<std::size_t>(column + halo_);
}

std::vector<double> SphereGrid::row_cosines(int rows) {
  std::vector<double> cosines(static_cast<std::size_t>(rows));
  for (int j = 0; j < rows; ++j)
    cosines[static_cast<std::size_t>(j)] = portable::cos((j + 0.5) * pi / rows);
  return cosines;
}

std::vector<double> SphereGrid::row_sines(int rows) {
  std::vector<double> sines(static_cast<std::size_t>(rows));
  for (int j = 0; j < rows; ++j)
    sines[static_cast<std::size_t>(j)] = portable::sin((j + 0.5) * pi / rows);
  return sines;
}

std::vector<Vector3> SphereGrid::directions(int rows) {
  const std::vector<double> cosines = row_cosines(rows);
  const std::vector<double> sines = row_sines(rows);
  std::vector<Eigen::Vector2d> circle;
  circle.reserve(2 * static_cast<std::size_t>(rows));
  for (int k = 0; k < 2 * rows; ++k) {
    circle.emplace_back(portable::cos(k * pi / rows), portable::sin(k * pi / rows));
  }
  std::vector<Vector3> result;
  result.reserve(cosines.size() * circle.size());
  for (std::size_t j = 0; j < cosines.size(); ++j) {
    for (const Eigen::Vector2d& p : circle) {
      result.emplace_back(sines[j] * p.x(), sines[j] * p.y(), cosines[j]);
    }
  }
  return result;
}

std::vector<double> SphereGrid::values() const {
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(rows_) * columns());
  for (int row = 0; row < rows_; ++row) {
    const double* begin = nodes_.data() + offset(row, 0);
    result.insert(result.end(), begin, begin + columns());
  }
  return result;
}

namespace {

/// Calls visit(halo row, halo column, row, column) for every node of the halo and the grid node
/// that it copies.
template <class Visit>
void for_each_halo_node(int rows, int halo, const Visit& visit) {
  const int columns = 2 * rows;
  for (int row = -halo; row < rows + halo; ++row) {
    const bool beyond_pole = row < 0 || row >= rows;
    const int source_row = row < 0 ? -1 - row : row >= rows ? 2 * rows - 1 - row : row;
    for (int column = -halo; column < columns + halo; ++column) {
      if (!beyond_pole && column == 0) column = columns;
      const int turned = column + columns + (beyond_pole ? rows : 0);
      visit(row, column, source_row, turned % columns);
    }
  }
}

}  // namespace

void SphereGrid::fill_halo() {
  for_each_halo_node(rows_, halo_, [&](int row, int column, int source_row, int source_column) {
    nodes_[offset(row, column)] = nodes_[offset(source_row, source_column)];
  });
}

void SphereGrid::fold_halo() {
  for_each_halo_node(rows_, halo_, [&](int row, int column, int source_row, int source_column) {
    nodes_[offset(source_row, source_column)] += nodes_[offset(row, column)];
  });
  fill_halo();
}

void SphereGrid::interpolate(const Vector3* directions, std::size_t count, double* values) const {
  const auto function = stencil_ == 4 ? interpolate_stencils<4> : interpolate_stencils<6>;
  function(nodes_.data(), rows_, stride(), directions, count, values);
}

void SphereGrid::spread_block(const Vector3* directions, std::size_t count, const double* values) {
  const auto function = stencil_ == 4 ? spread_stencils<4> : spread_stencils<6>;
  function(nodes_.data(), rows_, stride(), directions, count, values);
}

SphereGrid SphereGrid::spread(int rows, int stencil, const std::vector<Vector3>& directions,
                              const PointValueFunction& point_values, const Execution& execution) {
  SphereGrid result(rows, stencil);
  const std::size_t count = directions.size();
  const std::size_t slabs =
      std::clamp((count + points_per_slab - 1) / points_per_slab, std::size_t{1}, maximum_slabs);
  std::vector<SphereGrid> partial(slabs - 1, result);
  const std::size_t slab_size = (count + slabs - 1) / slabs;
  execution.parallel_for(count, slab_size, [&](std::size_t begin, std::size_t end) {
    SphereGrid& grid = begin == 0 ? result : partial[begin / slab_size - 1];
    constexpr std::size_t block = 1024;
    std::vector<double> values(block);
    for (std::size_t first = begin; first < end; first += block) {
      const std::size_t last = std::min(first + block, end);
      point_values(first, last, values.data());
      grid.spread_block(directions.data() + first, last - first, values.data());
    }
  });
  execution.parallel_for(result.nodes_.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (const SphereGrid& grid : partial) {
      for (std::size_t i = begin; i < end; ++i) result.nodes_[i] += grid.nodes_[i];
    }
  });
  result.fold_halo();
  return result;
}

}  // namespace wscvt
