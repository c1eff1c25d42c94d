// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/distance_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

namespace {

/// Cells between the surface's box and the edge of the grid: room for interpolation and gradients.
constexpr double margin = 4.0;

template <class Value>
void append(std::string& text, Value value) {
  std::array<unsigned char, sizeof(Value)> bytes{};
  boost::endian::endian_store<Value, sizeof(Value), boost::endian::order::little>(bytes.data(),
                                                                                  value);
  text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

using Box = Eigen::AlignedBox3d;

Box checked_box(const IndexedMesh& mesh) {
  if (mesh.triangles.empty()) {
    refuse("The mesh has no faces, so there is no inside. Give a closed triangle mesh.");
  }
  return box_of_faces(mesh);
}

/// First and last multiple of the spacing along an axis.
struct Span {
  double first;
  double last;
};

Span span_of(const Box& box, int axis, const GridOptions& options) {
  return {std::floor(box.min()[axis] / options.spacing) - margin,
          std::ceil(box.max()[axis] / options.spacing) + margin};
}

double point_count(const Box& box, const GridOptions& options) {
  double points = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Span span = span_of(box, axis, options);
    points *= span.last - span.first + 1.0;
  }
  return points;
}

/// Returns the spacing, or a larger one if the grid would have too many points.
double affordable_spacing(const Box& box, GridOptions options) {
  for (double points = point_count(box, options); !(points <= most_grid_points);
       points = point_count(box, options)) {
    // Exact for bodies with three long axes; others need a few more steps.
    options.spacing *= std::max(1.001, std::min(1e6, portable::cbrt(points / most_grid_points)));
  }
  return options.spacing;
}

void refuse_grid(const Box& box, const GridOptions& options) {
  refuse("A spacing (" + mention(grid_spacing_option) + ") of " + format_number(options.spacing) +
         " needs a grid of " + format_number(point_count(box, options) / 1e6, 3) +
         " million points, more than " + format_number(most_grid_points / 1e6) + " million. Give " +
         format_number(1.01 * affordable_spacing(box, options), 3) + " or more, or 0.");
}

double default_spacing(const IndexedMesh& mesh, const Execution& execution) {
  const Box box = checked_box(mesh);
  const double volume = volume_of(mesh, execution);
  if (!(volume > 0.0)) {
    refuse(
        "The mesh encloses no positive volume, so there is no inside. Give a closed mesh "
        "whose faces look outward.");
  }
  return affordable_spacing(box, {portable::cbrt(6.0 * volume / pi) / 50.0});
}

/// Returns a grid about the mesh, without values.
DistanceGrid empty_grid(const IndexedMesh& mesh, GridOptions options, const Execution& execution) {
  const Box box = checked_box(mesh);
  options.spacing = grid_spacing(mesh, options, execution);
  // A remesh may extend a little farther than the scan in check_grid.
  if (!(point_count(box, options) <= 1.1 * most_grid_points)) refuse_grid(box, options);
  DistanceGrid grid;
  grid.spacing = options.spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const Span span = span_of(box, axis, options);
    grid.origin[axis] = span.first * grid.spacing;
    grid.counts[static_cast<std::size_t>(axis)] =
        static_cast<std::size_t>(span.last - span.first) + 1;
  }
  grid.values.resize(grid.counts[0] * grid.counts[1] * grid.counts[2]);
  return grid;
}

}  // namespace

double grid_spacing(const IndexedMesh& closed, const GridOptions& options,
                    const Execution& execution) {
  return options.spacing > 0.0 ? options.spacing : default_spacing(closed, execution);
}

void check_grid(const IndexedMesh& closed, const GridOptions& options) {
  const Box box = checked_box(closed);
  if (options.spacing > 0.0 && !(point_count(box, options) <= most_grid_points)) {
    refuse_grid(box, options);
  }
}

DistanceGrid distance_grid(const IndexedMesh& closed, const GridOptions& options,
                           const Execution& execution) {
  require_in_range(options.spacing, grid_spacing_option);
  constexpr const char* stage = "Measuring the grid of distances";
  execution.report(0.0, stage);
  DistanceGrid grid = empty_grid(closed, options, execution);
  const MeshDistance surface(closed, execution);
  const std::size_t row = grid.counts[2];
  // One layer at a time, so that the work can be cancelled.
  for (std::size_t i = 0; i < grid.counts[0]; ++i) {
    execution.report(static_cast<double>(i) / static_cast<double>(grid.counts[0]), stage);
    execution.parallel_for_each(grid.counts[1], 1, [&](std::size_t j) {
      double* const values = &grid.values[(i * grid.counts[1] + j) * row];
      for (std::size_t k = 0; k < row; ++k) {
        const Vector3 step(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        const Vector3 point = grid.origin + grid.spacing * step;
        const double distance = surface.distance(point);
        // If the surface crosses the edge to the previous point, both distances sum to at most
        // the edge. If they sum to more, both points are on one side.
        const bool same_side =
            k > 0 && std::abs(values[k - 1]) + distance > (1.0 + 1e-9) * grid.spacing;
        const bool inside = same_side ? values[k - 1] < 0.0 : surface.contains(point);
        values[k] = inside ? -distance : distance;
      }
    });
  }
  execution.report(1.0, stage);
  return grid;
}

std::string grid_npy(const DistanceGrid& grid) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(grid.counts[0]) + ", " + std::to_string(grid.counts[1]) +
                       ", " + std::to_string(grid.counts[2]) + "), }";
  // Magic, version and length are ten bytes, a line end closes the header, and the numbers begin at
  // a multiple of 64.
  constexpr std::size_t before = 10;
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += '\1';
  bytes += '\0';
  bytes += static_cast<char>(header.size() % 256);
  bytes += static_cast<char>(header.size() / 256);
  bytes += header;
  bytes.reserve(bytes.size() + 8 * grid.values.size());
  for (const double value : grid.values) append(bytes, value);
  return bytes;
}

std::string grid_vti(const DistanceGrid& grid) {
  const auto& [nx, ny, nz] = grid.counts;
  const std::string extent = "0 " + std::to_string(nx - 1) + " 0 " + std::to_string(ny - 1) +
                             " 0 " + std::to_string(nz - 1);
  const std::string spacing = format_exact(grid.spacing);
  std::string bytes =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<ImageData WholeExtent=\"" +
      extent + "\" Origin=\"" + format_exact(grid.origin.x()) + " " +
      format_exact(grid.origin.y()) + " " + format_exact(grid.origin.z()) + "\" Spacing=\"" +
      spacing + " " + spacing + " " + spacing + "\">\n<Piece Extent=\"" + extent +
      "\">\n<PointData Scalars=\"distance\">\n<DataArray type=\"Float64\" Name=\"distance\" "
      "format=\"appended\" offset=\"0\"/>\n</PointData>\n</Piece>\n</ImageData>\n"
      "<AppendedData encoding=\"raw\">\n_";
  append(bytes, std::uint64_t{8 * grid.values.size()});
  bytes.reserve(bytes.size() + 8 * grid.values.size() + 40);
  // x runs fastest in VTK.
  for (std::size_t k = 0; k < nz; ++k) {
    for (std::size_t j = 0; j < ny; ++j) {
      for (std::size_t i = 0; i < nx; ++i) append(bytes, grid.values[(i * ny + j) * nz + k]);
    }
  }
  return bytes + "\n</AppendedData>\n</VTKFile>\n";
}

std::string grid_netdem(const DistanceGrid& grid) {
  const auto& [nx, ny, nz] = grid.counts;
  nlohmann::ordered_json table = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < nx; ++i) {
    nlohmann::ordered_json layer = nlohmann::ordered_json::array();
    for (std::size_t j = 0; j < ny; ++j) {
      nlohmann::ordered_json row = nlohmann::ordered_json::array();
      for (std::size_t k = 0; k < nz; ++k) row.push_back(-grid.values[(i * ny + j) * nz + k]);
      layer.push_back(std::move(row));
    }
    table.push_back(std::move(layer));
  }
  const nlohmann::ordered_json document = {
      {"corner", {grid.origin.x(), grid.origin.y(), grid.origin.z()}},
      {"spacing", grid.spacing},
      {"dim", {nx, ny, nz}},
      {"signed_distance_table", std::move(table)}};
  return document.dump() + "\n";
}

}  // namespace wscvt
