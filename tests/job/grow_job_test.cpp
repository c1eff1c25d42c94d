// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grow_job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/random_sample.h"
#include "support/test_shapes.h"
#include "toolbox/sample/grown_mesh.h"
#include "toolbox/sample/nearest_grain.h"
#include "wscvt/base/convex_hull.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/overhangs.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Row = test::CsvRow;

constexpr int grown_degree = 4;
constexpr std::size_t real_grains = 9;

const SampleGrids& grown_grids() {
  static const SampleGrids the_grids(grown_degree);
  return the_grids;
}

const std::vector<SampleGrain>& real_sample() {
  static const std::vector<SampleGrain> the_sample =
      test::random_sample(static_cast<int>(real_grains), grown_grids(), 31);
  return the_sample;
}

/// The sphericity, the ratios of the inertia ellipsoid and the convexity of a mesh.
std::vector<double> shape_of(const IndexedMesh& mesh) {
  const ShapeDescriptors shape = describe_shape(mesh, Execution(1));
  const Vector3& axes = shape.inertia_semi_axes;
  const double hull = volume_of(convex_hull(mesh.points, Execution(1)), Execution(1));
  return {std::cbrt(36.0 * test::pi * shape.volume * shape.volume) / shape.area, axes[1] / axes[2],
          axes[0] / axes[1], shape.volume / hull};
}

/// The largest difference of the distribution functions of two samples.
double kolmogorov(const std::vector<double>& a, const std::vector<double>& b) {
  const auto share = [](const std::vector<double>& values, double limit) {
    const auto below =
        std::count_if(values.begin(), values.end(), [&](double value) { return value <= limit; });
    return static_cast<double>(below) / static_cast<double>(values.size());
  };
  double largest = 0.0;
  for (const std::vector<double>* both : {&a, &b}) {
    for (const double x : *both) largest = std::max(largest, std::abs(share(a, x) - share(b, x)));
  }
  return largest;
}

/// Returns the first number behind a text in the lines.
double number_behind(const std::vector<std::string>& lines, const std::string& text) {
  for (const std::string& line : lines) {
    const std::size_t found = line.find(text);
    if (found != std::string::npos) return std::strtod(line.c_str() + found + text.size(), nullptr);
  }
  ADD_FAILURE() << text;
  return 0.0;
}

class GrownGrains : public test::FileFolder {
 protected:
  GrowJob job_of(int grains) const {
    GrowJob job;
    job.folder = path("out");
    job.grains = grains;
    job.nodes = 60;
    job.degree = grown_degree;
    job.options.seed = 3;
    return job;
  }

  static RealGrains real() {
    RealGrains result{real_sample(), {}, 2};
    for (std::size_t k = 0; k < real_grains; ++k) {
      result.files.push_back("real/g" + std::to_string(k) + ".json");
    }
    return result;
  }

  std::vector<Row> rows() const { return test::csv_rows(content("out/grown.csv")); }
};

TEST_F(GrownGrains, HaveTheNumbersOfTheirMeshesAndTheLogHasTheirMeans) {
  const GrowJob job = job_of(6);
  check_job(job);
  const MadeSample grown = grow_grains(job, real(), grown_grids(), {1});
  EXPECT_EQ(grown.end.done, 6U);
  const std::vector<Row> table = rows();
  ASSERT_EQ(table.size(), 6U);
  const GrainGrower grower(real_sample(), grown_grids(), job.options);
  const GrainSearch search(real_sample());
  const GrownMeshes meshes(job.nodes, Execution(1));
  std::vector<std::vector<double>> shapes(4);
  std::vector<double> nearest, collage;
  std::size_t redrawn = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const Row& row = table[k];
    const std::string name = "grown-0000" + std::to_string(k + 1);
    EXPECT_EQ(row.at("grain"), name);
    EXPECT_EQ(row.at("file"), name + ".ply");
    const IndexedMesh mesh = read_mesh(path("out/" + name + ".ply"));
    EXPECT_EQ(mesh.points.size(), 60U);
    const double volume = volume_of(mesh, Execution(1));
    EXPECT_NEAR(std::stod(row.at("volume [length^3]")) / volume, 1.0, 1e-5);
    EXPECT_NEAR(std::stod(row.at("equivalent_diameter [length]")),
                std::cbrt(6.0 / test::pi * volume), 1e-5);
    const std::vector<double> shape = shape_of(mesh);
    const char* columns[] = {"sphericity", "inertia_elongation", "inertia_flatness", "convexity"};
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(std::stod(row.at(columns[j])), shape[j], 1e-5) << columns[j];
      shapes[j].push_back(std::stod(row.at(columns[j])));
    }
    EXPECT_EQ(row.at("overhang [%]"), "0");
    const GrownGrain grain = grow_body(grower, meshes, k).grain;
    std::string donors;
    for (const std::size_t donor : grain.donors) donors += "g" + std::to_string(donor) + ".json;";
    EXPECT_EQ(row.at("donors") + ";", donors);
    const NearestGrain near = search.nearest(grain.radial);
    EXPECT_EQ(row.at("nearest_grain"), "g" + std::to_string(near.grain) + ".json");
    nearest.push_back(100.0 * near.distance);
    EXPECT_NEAR(std::stod(row.at("nearest_distance [%]")), nearest.back(), 1e-9);
    collage.push_back(100.0 * grain.collage);
    EXPECT_NEAR(std::stod(row.at("collage [%]")), collage.back(), 1e-9);
    EXPECT_EQ(row.at("redraws"), std::to_string(grain.redraws));
    if (grain.redraws > 0) ++redrawn;
  }
  EXPECT_EQ(
      grown.lines[0].rfind(
          "6 virtual grains of 9 real ones (2 left out), 3 donors each, degree 4, seed 3.", 0),
      0U)
      << grown.lines[0];
  for (const std::string& line : grown.lines) {
    EXPECT_FALSE(test::holds(line, "Overhang")) << "none has any";
  }
  EXPECT_EQ(number_behind(grown.lines, "intersected itself: "), static_cast<double>(redrawn));
  EXPECT_NEAR(number_behind(grown.lines, "distance to the sample ("),
              1.36 * std::sqrt(1.0 / 9.0 + 1.0 / 6.0), 0.005);
  std::vector<std::vector<double>> of_sample(4);
  for (const SampleGrain& grain : real_sample()) {
    const std::vector<double> shape = shape_of(meshes.mesh(grain.radial, 1.0, grain.radial_offset));
    for (std::size_t j = 0; j < 4; ++j) of_sample[j].push_back(shape[j]);
  }
  const char* labels[] = {"  sphericity", "  I/L of inertia", "  S/I of inertia", "  convexity"};
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_NEAR(number_behind(grown.lines, labels[j]), kolmogorov(shapes[j], of_sample[j]), 0.006)
        << labels[j];
  }
  std::sort(nearest.begin(), nearest.end());
  EXPECT_NEAR(number_behind(grown.lines, "median "), nearest[3], 0.005 * nearest[3]);
  EXPECT_NEAR(number_behind(grown.lines, "smallest "), nearest[0], 0.005 * nearest[0]);
  const double usual = 100.0 * search.usual_distance(Execution(1));
  EXPECT_NEAR(number_behind(grown.lines, "between real grains: "), usual, 0.005 * usual);
  double sum = 0.0;
  for (const double one : collage) sum += one;
  EXPECT_NEAR(number_behind(grown.lines, "follow one donor: "), sum / 6.0, 0.005 * sum);
}

TEST_F(GrownGrains, WithOverhangsHaveThoseOfTheirMeshes) {
  const SampleGrids grids(6);
  const std::vector<SampleGrain> sample = test::bent_sample(grids);
  GrowJob job = job_of(4);
  job.nodes = 200;
  job.degree = 6;
  RealGrains bent{sample, {}, 0};
  for (std::size_t k = 0; k < sample.size(); ++k) bent.files.push_back(std::to_string(k) + ".ply");
  const MadeSample grown = grow_grains(job, std::move(bent), grids, {1});
  // In %.
  const auto overhang = [](const IndexedMesh& mesh) {
    const Vector3 centre = describe_shape(mesh, Execution(1)).centroid;
    return 100.0 * overhang_solid_angle(mesh, centre, Execution(1));
  };
  double sum = 0.0;
  for (const Row& row : rows()) {
    const double found = std::stod(row.at("overhang [%]"));
    EXPECT_NEAR(found, overhang(read_mesh(path("out/" + row.at("file")))), 1e-3);
    sum += found;
  }
  EXPECT_GT(sum, 1.0);
  EXPECT_NEAR(number_behind(grown.lines, "Overhang fraction, mean: "), sum / 4.0, 0.002 * sum);
  double real = 0.0;
  const GrownMeshes meshes(job.nodes, Execution(1));
  for (const SampleGrain& grain : sample) {
    real += overhang(meshes.mesh(grain.radial, 1.0, grain.radial_offset));
  }
  real /= static_cast<double>(sample.size());
  EXPECT_NEAR(number_behind(grown.lines, "in the sample "), real, 0.006 * real);
}

TEST_F(GrownGrains, HaveEachPartOfAGivenSizeCurveOnce) {
  GrowJob job = job_of(5);
  job.sizes = GivenSizes({2.0, 3.0, 7.0}, {0.0, 30.0, 100.0});
  job.format = "json";
  grow_grains(job, real(), grown_grids(), {1});
  std::vector<double> diameters;
  for (const Row& row : rows()) {
    diameters.push_back(std::stod(row.at("equivalent_diameter [length]")));
    const HarmonicShape shape = read_harmonics(path("out/" + row.at("file")));
    const double volume = volume_of(
        mesh_of_surface(std::get<HarmonicSurface>(shape), 24, Execution(1)), Execution(1));
    EXPECT_NEAR(std::stod(row.at("volume [length^3]")) / volume, 1.0, 0.01);
    EXPECT_NEAR(std::pow(diameters.back(), 3) * test::pi / 6.0 / volume, 1.0, 0.01);
  }
  std::sort(diameters.begin(), diameters.end());
  ASSERT_EQ(diameters.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(diameters[k], job.sizes->diameter(0.2 * (static_cast<double>(k) + 0.5)), 1e-9);
  }
  // The meshes have these sizes too.
  job.format = "ply";
  grow_grains(job, real(), grown_grids(), {1});
  for (const Row& row : rows()) {
    EXPECT_NEAR(volume_of(read_mesh(path("out/" + row.at("file"))), Execution(1)) /
                    std::stod(row.at("volume [length^3]")),
                1.0, 1e-5);
  }
}

TEST_F(GrownGrains, GoOnOnlyWithTheSameOptions) {
  const std::vector<std::function<void(GrowJob&)>> changes = {
      [](GrowJob&) {},
      [](GrowJob& job) { job.format = "stl"; },
      [](GrowJob& job) { job.nodes = 61; },
      [](GrowJob& job) { job.options.seed = 4; },
      [](GrowJob& job) {
        job.sizes = GivenSizes({2.0, 3.0}, {0.0, 100.0});
      },
      [](GrowJob& job) {
        job.sizes = GivenSizes({2.0, 4.0}, {0.0, 100.0});
      }};
  // In a part without grains only the call is written.
  Shard shard{1, 2};
  if (is_of(shard, "grown-00001")) shard.index = 2;
  const std::string call = "out/call-" + std::to_string(shard.index) + "-of-2.json";
  std::set<std::string> calls;
  for (const auto& change : changes) {
    fs::remove_all(path("out"));
    GrowJob job = job_of(1);
    change(job);
    job.shard = shard;
    EXPECT_TRUE(grow_grains(job, real(), grown_grids(), {1}).lines.empty());
    EXPECT_TRUE(calls.insert(content(call)).second) << content(call);
  }
  // Scans that were replaced by others of the same names.
  fs::remove_all(path("out"));
  RealGrains replaced = real();
  replaced.grains[4].radius *= 1.5;
  GrowJob job = job_of(1);
  job.shard = shard;
  grow_grains(job, replaced, grown_grids(), {1});
  EXPECT_TRUE(calls.insert(content(call)).second) << content(call);
}

TEST_F(GrownGrains, ReplaceNoRealGrain) {
  GrowJob job = job_of(3);
  job.format = "json";
  fs::create_directories(path("out"));
  const std::string real = file("out/grown-00003.json", "a real grain");
  EXPECT_ERROR(require_scans_kept(job, {file("out/other.json", ""), real}), InvalidInput);
  job.format = "ply";
  EXPECT_NO_THROW(require_scans_kept(job, {real}));
  job.format = "xyzzy";
  EXPECT_ERROR(check_job(job), InvalidInput);
  job = job_of(3);
  job.degree = 2;
  EXPECT_ERROR(check_job(job), InvalidInput);
}

}  // namespace
}  // namespace wscvt
