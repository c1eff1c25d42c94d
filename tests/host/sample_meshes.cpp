// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_meshes.h"

#include <cmath>
#include <fstream>

#include "wscvt/base/numbers.h"

namespace wscvt::host_test {

namespace {

Vector3 grain_point(const Vector3& u) {
  const double bumps = 1.0 + 0.08 * std::sin(3.0 * u.x()) * std::cos(4.0 * u.y() + 1.0) +
                       0.05 * std::sin(5.0 * u.z());
  return bumps * Vector3(1.3 * u.x(), 1.0 * u.y(), 0.8 * u.z());
}

}  // namespace

IndexedMesh mapped_sphere(int rings, int segments,
                          const std::function<Vector3(const Vector3&)>& map) {
  IndexedMesh mesh;
  mesh.points.push_back(map(Vector3(0, 0, 1)));
  for (int i = 1; i <= rings; ++i) {
    const double theta = pi * i / (rings + 1);
    for (int j = 0; j < segments; ++j) {
      const double phi = 2.0 * pi * j / segments;
      mesh.points.push_back(map(Vector3(std::sin(theta) * std::cos(phi),
                                        std::sin(theta) * std::sin(phi), std::cos(theta))));
    }
  }
  mesh.points.push_back(map(Vector3(0, 0, -1)));
  const auto at = [&](int ring, int segment) { return 1 + ring * segments + segment % segments; };
  const int south = 1 + rings * segments;
  for (int j = 0; j < segments; ++j) {
    mesh.triangles.push_back({0, at(0, j), at(0, j + 1)});
    for (int i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, j), south, at(rings - 1, j + 1)});
  }
  return mesh;
}

IndexedMesh grain() { return mapped_sphere(31, 64, grain_point); }

IndexedMesh sphere() {
  return mapped_sphere(31, 64, [](const Vector3& u) { return u; });
}

IndexedMesh without_a_patch(std::size_t faces) {
  IndexedMesh mesh = grain();
  mesh.triangles.resize(mesh.triangles.size() - faces);
  return mesh;
}

IndexedMesh two_grains() {
  IndexedMesh mesh = grain();
  const IndexedMesh other = moved(grain(), Vector3(5, 0, 0));
  const auto offset = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const Triangle& t : other.triangles) {
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return mesh;
}

IndexedMesh with_non_manifold_edge() {
  IndexedMesh mesh = grain();
  // A closed tetrahedron outside, on the first edge of the first triangle.
  const std::int32_t a = mesh.triangles[0][0];
  const std::int32_t b = mesh.triangles[0][1];
  const auto c = static_cast<std::int32_t>(mesh.points.size());
  const std::int32_t d = c + 1;
  const Vector3 middle =
      0.5 * (mesh.points[static_cast<std::size_t>(a)] + mesh.points[static_cast<std::size_t>(b)]);
  mesh.points.push_back(1.3 * middle + Vector3(0.1, 0, 0));
  mesh.points.push_back(1.3 * middle - Vector3(0.1, 0, 0));
  for (const Triangle& t :
       {Triangle{a, b, c}, Triangle{b, a, d}, Triangle{a, c, d}, Triangle{b, d, c}}) {
    mesh.triangles.push_back(t);
  }
  return mesh;
}

IndexedMesh with_coordinate(double x) {
  IndexedMesh mesh = grain();
  mesh.points[100].x() = x;
  return mesh;
}

IndexedMesh flat_grain() {
  return mapped_sphere(31, 64, [](const Vector3& u) {
    Vector3 p = grain_point(u);
    p.z() = 0.0;
    return p;
  });
}

IndexedMesh band_with_one_side() {
  constexpr int around = 60;
  constexpr int across = 6;
  IndexedMesh mesh;
  for (int i = 0; i < around; ++i) {
    const double angle = 2.0 * pi * i / around;
    for (int j = 0; j <= across; ++j) {
      const double side = 1.2 * (static_cast<double>(j) / across - 0.5);
      const double radius = 2.0 + side * std::cos(0.5 * angle);
      mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                               side * std::sin(0.5 * angle));
    }
  }
  // After one round the sides have changed places.
  const auto vertex = [&](int i, int j) { return i < around ? i * (across + 1) + j : across - j; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

IndexedMesh bent_grain() {
  // A thin body bent round 200 degrees: its centroid lies in the bay, outside.
  return mapped_sphere(63, 32, [](const Vector3& u) {
    const double along = 100.0 * pi / 180.0 * u.z();
    const double radius = 1.0 + 0.25 * u.x();
    return Vector3(radius * std::cos(along), radius * std::sin(along), 0.25 * u.y());
  });
}

IndexedMesh scaled(IndexedMesh mesh, double factor) {
  for (Vector3& p : mesh.points) p *= factor;
  return mesh;
}

IndexedMesh moved(IndexedMesh mesh, const Vector3& by) {
  for (Vector3& p : mesh.points) p += by;
  return mesh;
}

void write_as_it_is(const IndexedMesh& mesh, const QString& path) {
  std::ofstream file(path.toStdString());
  file.precision(9);
  file << "ply\nformat ascii 1.0\nelement vertex " << mesh.points.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
       << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vector3& p : mesh.points) file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const Triangle& t : mesh.triangles) {
    file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }
}

QString sample(const QString& name) { return QStringLiteral(WSCVT_MESHES_DIR "/") + name; }

}  // namespace wscvt::host_test
