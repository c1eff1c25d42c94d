// SPDX-License-Identifier: GPL-3.0-or-later
// What voxels do to the descriptors of bodies whose true descriptors are known. Writes a row for
// each descriptor, body, number of voxels across and pose. resolution_study.py reads it.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "support/segmented_scan.h"
#include "toolbox/resolution/mesh_voxels.h"
#include "toolbox/resolution/resolution.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {

namespace {

using Numbers = std::mt19937_64;

double uniform(Numbers& numbers, double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(numbers() >> 11U), -53);
}

Vector3 direction(Numbers& numbers) {
  const double z = uniform(numbers, -1.0, 1.0);
  const double turn = uniform(numbers, 0.0, 2.0 * pi);
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

/// A stretched polyhedron with rounded edges, times waves on its surface: one of an endless family
/// of bodies, from pebbles to rough shards.
IndexedMesh grown_body(std::uint64_t seed) {
  Numbers numbers(seed);
  IndexedMesh mesh = mesh_of_surface(Ellipsoid(Vector3::Ones()), 64, Execution(1));
  const auto faces = static_cast<int>(uniform(numbers, 8.0, 40.0));
  std::vector<Vector3> normals;
  std::vector<double> distances;
  for (int k = 0; k < faces; ++k) {
    normals.push_back(direction(numbers));
    distances.push_back(uniform(numbers, 0.8, 1.2));
  }
  const double sharpness = std::exp(uniform(numbers, std::log(4.0), std::log(40.0)));
  const Vector3 axes(1.0, uniform(numbers, 0.6, 1.0), uniform(numbers, 0.4, 0.9));
  const double height = uniform(numbers, 0.0, 0.06);
  const double decay = uniform(numbers, 0.8, 2.0);
  struct Wave {
    Vector3 vector;
    double phase;
    double height;
  };
  std::vector<Wave> waves;
  double sum = 0.0;
  for (int k = 0; k < 150; ++k) {
    const double length = std::exp(uniform(numbers, std::log(3.0), std::log(50.0)));
    waves.push_back(
        {length * direction(numbers), uniform(numbers, 0.0, 2.0 * pi), std::pow(length, -decay)});
    sum += 0.5 * waves.back().height * waves.back().height;
  }
  for (Vector3& point : mesh.points) {
    const Vector3 u = point.normalized();
    double norm = 0.05;  // keeps the radius finite where no face is near
    for (std::size_t k = 0; k < normals.size(); ++k) {
      norm += std::pow(std::max(normals[k].dot(u), 0.0) / distances[k], sharpness);
    }
    double wave = 0.0;
    for (const Wave& one : waves) wave += one.height * std::cos(one.vector.dot(u) + one.phase);
    point = (std::pow(norm, -1.0 / sharpness) * (1.0 + height * wave / std::sqrt(sum)) * u)
                .cwiseProduct(axes);
  }
  return mesh;
}

IndexedMesh read_body(const std::string& file) {
  if (ending_of(file) == ".dat") {
    return mesh_of_surface(read_complex_harmonics(file), 64, Execution(1));
  }
  return check_mesh(read_mesh_file(file, Execution(1)).mesh, MeshCheckOptions(), Execution(1)).mesh;
}

struct Body {
  std::string name;
  IndexedMesh mesh;
};

Eigen::Quaterniond turn_of(Numbers& numbers) {
  const Vector3 axis = direction(numbers);
  return Eigen::Quaterniond(Eigen::AngleAxisd(uniform(numbers, 0.0, 2.0 * pi), axis));
}

/// Returns the rows of a body, voxelised so that the sphere of equal volume is `across` voxels
/// wide.
std::string rows_of(const Body& body, const DetailedDescriptors& truth, double across, int pose,
                    const test::Scan& scan) {
  Numbers numbers(static_cast<std::uint64_t>(1000.0 * across) + static_cast<std::uint64_t>(pose));
  VoxelPose at{turn_of(numbers), Vector3::Zero()};
  for (int k = 0; k < 3; ++k) at.shift[k] = 1.0 + uniform(numbers, 0.0, 1.0);
  const double size = truth.equivalent_diameter / across;
  const Execution one_thread(1);
  const std::vector<VoxelStretch> voxels =
      scan.blur > 0.0 ? test::segmented_voxels(body.mesh, size, at, scan, numbers)
                      : mesh_voxels(body.mesh, size, at);
  const IndexedMesh seen =
      check_mesh(surface_of_voxels(voxels, ResolutionOptions().smoothing, size), MeshCheckOptions(),
                 one_thread)
          .mesh;
  const DetailedDescriptors measured =
      describe_shape_in_detail(seen, DetailedOptions(), one_thread);
  ResolutionOptions options;
  options.voxel_size = size;
  const Resolution resolution = measure_resolution(seen, measured, options, one_thread);
  std::map<std::string, double> true_values;
  for (const DescriptorValue& row : list_descriptors(truth)) true_values[row.key] = row.value;
  std::string text;
  for (const ResolvedValue& row : resolution.rows) {
    char line[300];
    std::snprintf(line, sizeof line, "%s,%.6g,%d,%s,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g\n",
                  body.name.c_str(), across, pose, row.key.c_str(), true_values[row.key], row.value,
                  row.again, row.scatter, row.corrected, row.low, row.high);
    text += line;
  }
  return text;
}

void run(const std::vector<std::string>& files, int grown, int poses, int threads,
         const std::vector<double>& given, double voxel, const test::Scan& scan) {
  std::vector<Body> bodies;
  for (int k = 0; k < grown; ++k) {
    bodies.push_back({"grown_" + std::to_string(k), grown_body(static_cast<std::uint64_t>(k))});
  }
  for (const std::string& file : files) {
    bodies.push_back({file.substr(file.find_last_of('/') + 1), read_body(file)});
  }
  std::cout << "body,across,pose,key,truth,value,again,scatter,corrected,low,high\n";
  for (const Body& body : bodies) {
    const DetailedDescriptors truth =
        describe_shape_in_detail(body.mesh, DetailedOptions(), Execution(threads));
    const std::vector<double> across =
        voxel > 0.0 ? std::vector<double>{truth.equivalent_diameter / voxel} : given;
    const std::size_t count = across.size() * static_cast<std::size_t>(poses);
    std::vector<std::string> rows(count);
    Execution(threads).parallel_for(count, 1, [&](std::size_t begin, std::size_t) {
      const int pose = static_cast<int>(begin) % poses;
      try {
        rows[begin] =
            rows_of(body, truth, across[begin / static_cast<std::size_t>(poses)], pose, scan);
      } catch (const Error& error) {
        std::cerr << body.name << ": " << error.what() << '\n';
      }
    });
    for (const std::string& row : rows) std::cout << row;
    std::cout.flush();
  }
}

}  // namespace

}  // namespace wscvt

int main(int count, char** words) {
  CLI::App app("What voxels do to descriptors");
  std::vector<std::string> files;
  std::vector<double> across = {10, 15, 20, 30, 40};
  double voxel = 0.0;
  int grown = 0;
  int poses = 8;
  int threads = 2;
  wscvt::test::Scan scan;
  app.add_option("files", files, "Meshes, or spherical harmonics (.dat)");
  app.add_option("--grown", grown, "Number of grown bodies");
  app.add_option("--poses", poses, "Poses of a body");
  app.add_option("--across", across, "Numbers of voxels across");
  app.add_option("--blur", scan.blur, "Blur of a scan that is segmented, voxels; 0: exact labels");
  app.add_option("--noise", scan.noise, "Noise of the scan over the step from void to grain");
  app.add_option("--voxel", voxel, "Instead: size of a voxel in the unit of the bodies");
  app.add_option("--threads", threads, "Threads");
  CLI11_PARSE(app, count, words);
  try {
    wscvt::run(files, grown, poses, threads, across, voxel, scan);
  } catch (const wscvt::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
