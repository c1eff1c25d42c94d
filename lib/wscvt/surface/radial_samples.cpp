// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/radial_samples.h"

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/sphere/cube_map.h"
#include "wscvt/sphere/solid_angle.h"
#include "wscvt/surface/mesh_surface.h"

namespace wscvt {

namespace {

constexpr std::size_t radial_block = 8192;

/// Cells, 1.4 degrees across in the middle, in which a fold is looked for.
constexpr int fold_resolution = 64;

/// Relative distance by which the sheet in front must be farther out.
constexpr double hidden_tolerance = 1e-9;

/// Takes the weight of every vertex behind the outermost sheet.
void hide_vertices(const IndexedMesh& mesh, const std::vector<double>& angles,
                   const Execution& execution, RadialSamples& samples) {
  // A ray that meets more than one sheet passes through a face that looks back.
  const CubeMap cube(fold_resolution);
  std::vector<char> folded(cube.cells(), 0);
  for (std::size_t f = 0; f < angles.size(); ++f) {
    if (angles[f] >= 0.0) continue;
    const Triangle& t = mesh.triangles[f];
    const auto image = [&](std::int32_t corner) {
      return CubeMap::image(mesh.points[index(corner)]);
    };
    cube.visit_cells(image(t[0]), image(t[1]), image(t[2]),
                     [&](std::size_t cell) { folded[cell] = 1; });
  }
  const MeshSurface surface(mesh, Vector3::Zero(), 1.0, execution);
  execution.parallel_for(mesh.points.size(), radial_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double radius = mesh.points[i].norm();
      if (!(radius > 0.0) || !folded[cube.cell(samples.directions[i])]) continue;
      const double outermost = surface.outermost_hit(samples.directions[i]).radius;
      if (outermost > radius * (1.0 + hidden_tolerance)) samples.weights[i] = 0.0;
    }
  });
}

}  // namespace

RadialSamples radial_samples(const IndexedMesh& mesh, const Execution& execution) {
  if (mesh.triangles.empty()) {
    throw Error(ErrorCode::InvalidInput, "The mesh is empty; check it before sampling it.");
  }
  const std::size_t count = mesh.points.size();
  RadialSamples samples;
  samples.directions.resize(count);
  execution.parallel_for(count, radial_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) samples.directions[i] = mesh.points[i].normalized();
  });
  std::vector<double> angles(mesh.triangles.size());
  const SolidAngleSums sums = execution.parallel_sum(
      angles.size(), radial_block, SolidAngleSums(), [&](std::size_t begin, std::size_t end) {
        SolidAngleSums part;
        for (std::size_t f = begin; f < end; ++f) {
          const Triangle& t = mesh.triangles[f];
          angles[f] = solid_angle(samples.directions[index(t[0])], samples.directions[index(t[1])],
                                  samples.directions[index(t[2])]);
          part.add(angles[f]);
        }
        return part;
      });
  if (sums.folded_share() >= 1.0) return {};
  samples.weights.assign(count, 0.0);
  for (std::size_t f = 0; f < angles.size(); ++f) {
    if (!(angles[f] > 0.0)) continue;
    for (const std::int32_t v : mesh.triangles[f]) samples.weights[index(v)] += angles[f] / 3.0;
  }
  if (sums.backward > 0.0) hide_vertices(mesh, angles, execution, samples);

  samples.vertices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(mesh.points[i].squaredNorm() > 0.0 && samples.weights[i] > 0.0)) continue;
    const std::size_t kept = samples.vertices.size();
    samples.directions[kept] = samples.directions[i];
    samples.weights[kept] = samples.weights[i];
    samples.vertices.push_back(static_cast<std::int32_t>(i));
  }
  samples.directions.resize(samples.vertices.size());
  samples.weights.resize(samples.vertices.size());
  return samples;
}

}  // namespace wscvt
