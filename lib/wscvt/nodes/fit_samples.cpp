// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/fit_samples.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/plastic_sequence.h"
#include "wscvt/base/smooth_step.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// Between these face areas, in a node's cell, a face's own normal replaces the normals of its
/// vertices.
constexpr double fine_face = 0.25;
constexpr double coarse_face = 1.0;

Vector3 normal_of(const IndexedMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return doubled_area_normal(mesh.points[a], mesh.points[b], mesh.points[c]);
}

double face_normal_share(double area, double cell) {
  return smooth_step((area / cell - fine_face) / (coarse_face - fine_face));
}

FitSample sample_in_face(const SampledScan& scan, std::size_t t, const Eigen::Vector2d& random,
                         double cell) {
  const Triangle& corners = scan.mesh.triangles[t];
  const double root = std::sqrt(random.x());
  const Vector3 w(1.0 - root, root * (1.0 - random.y()), root * random.y());
  FitSample sample;
  sample.point.setZero();
  sample.normal.setZero();
  int nearest = 0;
  for (int k = 0; k < 3; ++k) {
    sample.point += w[k] * scan.mesh.points[corners[k]];
    sample.normal += w[k] * scan.normals[corners[k]];
    if (w[k] > w[nearest]) nearest = k;
  }
  const Vector3 face_normal = normal_of(scan.mesh, t);
  const double doubled_area = face_normal.norm();
  const double share = face_normal_share(0.5 * doubled_area, cell);
  const double length = sample.normal.norm();
  // If the vertices' normals cancel, the face's own is used.
  if (length < 1e-6 || share == 1.0) {
    sample.normal = face_normal / doubled_area;
  } else {
    sample.normal = (1.0 - share) / length * sample.normal + share / doubled_area * face_normal;
    sample.normal.normalize();
  }
  sample.face = corners[nearest];
  return sample;
}

}  // namespace

std::vector<FitSample> draw_fit_samples(const SampledScan& scan, std::size_t count, double cell) {
  constexpr double golden = 0.61803398874989485;  // its multiples modulo 1 are evenly distributed
  const std::size_t faces = scan.mesh.triangles.size();
  std::vector<double> doubled_areas(faces);
  double total = 0.0;
  for (std::size_t t = 0; t < faces; ++t) {
    doubled_areas[t] = normal_of(scan.mesh, t).norm();
    total += doubled_areas[t];
  }
  std::vector<FitSample> samples;
  samples.reserve(count);
  std::size_t t = 0;
  double up_to = doubled_areas.empty() ? 0.0 : doubled_areas[0];
  for (std::size_t i = 0; i < count; ++i) {
    const double jitter =
        golden * static_cast<double>(i) - std::floor(golden * static_cast<double>(i));
    const double wanted = (static_cast<double>(i) + jitter) / static_cast<double>(count) * total;
    while (t + 1 < faces && (up_to < wanted || doubled_areas[t] == 0.0))
      up_to += doubled_areas[++t];
    samples.push_back(sample_in_face(scan, t, plastic_point(i), cell));
  }
  return samples;
}

}  // namespace wscvt
