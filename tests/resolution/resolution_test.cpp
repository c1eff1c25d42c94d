// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/resolution/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/seeds.h"
#include "support/segmented_scan.h"
#include "toolbox/resolution/descriptor_biases.h"
#include "toolbox/resolution/mesh_voxels.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

const Execution one_thread(1);

IndexedMesh ellipsoid(const Vector3& axes) {
  return mesh_of_surface(Ellipsoid(axes), 48, one_thread);
}

IndexedMesh checked(IndexedMesh mesh) {
  return check_mesh(std::move(mesh), MeshCheckOptions(), one_thread).mesh;
}

DetailedDescriptors described(const IndexedMesh& mesh) {
  return describe_shape_in_detail(mesh, DetailedOptions(), one_thread);
}

VoxelPose pose(int number) {
  const double turn = 0.7 + 1.1 * number;
  const Vector3 axis = Vector3(std::cos(turn), std::sin(2.0 * turn), 0.3).normalized();
  return {Eigen::Quaterniond(Eigen::AngleAxisd(turn, axis)),
          Vector3(1.1 + 0.1 * number, 1.9 - 0.1 * number, 1.5)};
}

std::int64_t count_of(const std::vector<VoxelStretch>& voxels) {
  std::int64_t count = 0;
  for (const VoxelStretch& one : voxels) count += one.end - one.begin;
  return count;
}

Resolution resolution_of(const std::vector<VoxelStretch>& voxels, double size) {
  const IndexedMesh seen = checked(surface_of_voxels(voxels, ResolutionOptions().smoothing, size));
  ResolutionOptions options;
  options.voxel_size = size;
  return measure_resolution(seen, described(seen), options, one_thread);
}

Resolution resolution_of(const IndexedMesh& body, double size, const VoxelPose& at) {
  return resolution_of(mesh_voxels(body, size, at), size);
}

const ResolvedValue& row_of(const Resolution& resolution, const std::string& key) {
  for (const ResolvedValue& row : resolution.rows) {
    if (row.key == key) return row;
  }
  throw std::logic_error("no row " + key);
}

TEST(MeshVoxels, AreThoseWhoseCentresAreInside) {
  const Vector3 axes(5.0, 4.0, 3.0);
  const IndexedMesh body = ellipsoid(axes);
  VoxelPose at;
  at.shift = Vector3(1.0, 1.0, 1.0);
  const double size = 0.37;
  const std::vector<VoxelStretch> voxels = mesh_voxels(body, size, at);
  std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> rows;
  for (const VoxelStretch& one : voxels) rows[{one.z, one.y}].push_back({one.begin, one.end});
  int differing = 0;
  for (int z = 0; z < 30; ++z) {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 30; ++x) {
        const Vector3 centre = size * (Vector3(x + 0.5, y + 0.5, z + 0.5) - at.shift) - axes;
        const double level = centre.cwiseQuotient(axes).norm();
        bool found = false;
        for (const auto& [begin, end] : rows[{z, y}]) found = found || (begin <= x && x < end);
        // The mesh is a polyhedron inside the ellipsoid, by at most an eighth of the square of its
        // edges, 1/40 of the radius.
        if (level > 1.0 || level < 0.997) differing += found == (level < 1.0) ? 0 : 1;
      }
    }
  }
  EXPECT_EQ(differing, 0);
}

TEST(MeshVoxels, HaveTheVolumeInEveryPose) {
  const IndexedMesh body = read_mesh(std::string(WSCVT_MESHES_DIR) + "/sand_5658.ply");
  const double volume = describe_shape(body, one_thread).volume;
  const double size = std::cbrt(volume) / 40.0;
  for (int k = 0; k < 8; ++k) {
    const double voxels = static_cast<double>(count_of(mesh_voxels(body, size, pose(k))));
    // 64,000 voxels, of which some 10,000 are at the surface: their rounding adds up as its root.
    EXPECT_NEAR(voxels * size * size * size / volume, 1.0, 3.0 * 100.0 / 64000.0) << k;
  }
}

// Two bodies in one row have the voxels of each.
TEST(MeshVoxels, LeaveGapsOpen) {
  const IndexedMesh one = ellipsoid(Vector3(1.0, 0.8, 0.6));
  IndexedMesh both = one;
  for (const Triangle& t : one.triangles) {
    const auto points = static_cast<std::int32_t>(one.points.size());
    both.triangles.push_back({t[0] + points, t[1] + points, t[2] + points});
  }
  for (const Vector3& point : one.points) both.points.push_back(point + Vector3(2.5, 0.0, 0.0));
  VoxelPose at;
  at.shift = Vector3(1.3, 1.4, 1.6);
  EXPECT_EQ(count_of(mesh_voxels(both, 0.1, at)), 2 * count_of(mesh_voxels(one, 0.1, at)));
}

TEST(MeshVoxels, RefuseWhatIsTooLongOrTooThin) {
  const IndexedMesh body = ellipsoid(Vector3::Ones());
  test::expect_error(ErrorCode::InvalidInput, [&] { mesh_voxels(body, 1e-5, {}); });
  test::expect_error(ErrorCode::InvalidInput,
                     [&] { surface_of_voxels(mesh_voxels(body, 100.0, {}), 20, 100.0); });
}

TEST(MeshVoxels, AreFoundAgainInTheirSurface) {
  const IndexedMesh body = read_mesh(std::string(WSCVT_MESHES_DIR) + "/elongated_rough_8000.ply");
  const double diameter = described(body).equivalent_diameter;
  for (const int across : {10, 14, 20, 40}) {
    SCOPED_TRACE(across);
    const double size = diameter / across;
    const std::vector<VoxelStretch> voxels = mesh_voxels(body, size, pose(across));
    IndexedMesh surface = surface_of_voxels(voxels, 20, size);
    for (Vector3& point : surface.points) point += size * Vector3(31.3, -7.9, 0.48);
    const auto again = voxels_of_surface(surface, 20, size);
    ASSERT_TRUE(again);
    ASSERT_EQ(again->size(), voxels.size());
    for (std::size_t k = 0; k < voxels.size(); ++k) {
      const VoxelStretch& one = voxels[k];
      const VoxelStretch& other = (*again)[k];
      EXPECT_EQ(other.z - one.z, again->front().z - voxels.front().z);
      EXPECT_EQ(other.y - one.y, again->front().y - voxels.front().y);
      EXPECT_EQ(other.begin - one.begin, again->front().begin - voxels.front().begin);
      EXPECT_EQ(other.end - other.begin, one.end - one.begin);
    }
    EXPECT_FALSE(voxels_of_surface(surface, 20, 1.1 * size));
    EXPECT_FALSE(voxels_of_surface(surface, 20, 0.5 * size));
    EXPECT_FALSE(voxels_of_surface(surface_of_voxels(voxels, 10, size), 20, size));
    EXPECT_FALSE(voxels_of_surface(body, 20, size));
    for (Vector3& point : surface.points) point = pose(2).turn * point;
    EXPECT_FALSE(voxels_of_surface(surface, 20, size));
  }
}

/// A body, and its descriptors without voxels.
struct TrueBody {
  explicit TrueBody(IndexedMesh body) : mesh(std::move(body)) {
    const DetailedDescriptors truth = described(mesh);
    diameter = truth.equivalent_diameter;
    for (const DescriptorValue& row : list_descriptors(truth)) values[row.key] = row.value;
  }

  IndexedMesh mesh;
  double diameter = 0.0;
  std::map<std::string, double> values;
};

/// Bodies of which none was used for the biases.
const std::map<std::string, TrueBody>& bodies() {
  static const std::map<std::string, TrueBody> all = [] {
    std::map<std::string, TrueBody> made;
    made.emplace("ellipsoid", ellipsoid(Vector3(1.0, 0.8, 0.6)));
    for (const char* name : {"angular_6000", "elongated_rough_8000", "sand_7228"}) {
      made.emplace(name, checked(read_mesh(std::string(WSCVT_MESHES_DIR) + "/" + name + ".ply")));
    }
    return made;
  }();
  return all;
}

/// Counts of each descriptor's intervals, and of those that cover the true value.
struct Intervals {
  void add(const ResolvedValue& row, double truth) {
    ++resolved[row.key];
    if (row.low <= truth && truth <= row.high) ++covered[row.key];
  }
  void expect_covered() const {
    for (const auto& [key, count] : resolved) {
      const auto hits = covered.find(key);
      EXPECT_GE(hits == covered.end() ? 0 : hits->second, 0.9 * count) << key << " of " << count;
    }
  }

  std::map<std::string, int> resolved;
  std::map<std::string, int> covered;
};

TEST(Resolution, IntervalsCoverAndCorrectedValuesAreCloser) {
  const std::vector<std::string> keys = {
      "area",     "sphericity_wadell", "convexity", "zingg_elongation_inertia", "roundness_wadell",
      "feret_min"};
  Intervals intervals;
  std::map<std::string, double> raw;
  std::map<std::string, double> left;
  for (const auto& [name, body] : bodies()) {
    for (const int across : {10, 15, 20, 30, 40}) {
      const int poses = across < 30 ? 4 : 40 / across;  // the larger take the time
      for (int k = 0; k < poses; ++k) {
        const Resolution found = resolution_of(body.mesh, body.diameter / across, pose(k));
        EXPECT_NEAR(found.voxels_across, across, 0.03 * across);
        for (const std::string& key : keys) {
          const ResolvedValue& row = row_of(found, key);
          if (!row.is_resolved()) continue;
          const double truth = body.values.at(key);
          intervals.add(row, truth);
          if (across < 20) continue;
          raw[key] += std::abs(row.value / truth - 1.0);
          left[key] += std::abs(row.corrected / truth - 1.0);
        }
      }
    }
  }
  EXPECT_EQ(intervals.resolved["area"], 4 * (3 * 4 + 1 + 1));
  intervals.expect_covered();
  // Of the bodies of the study the correction leaves half of area, sphericity and roundness, and
  // .56 of convexity. Of these four it leaves .64, .60, .90 and .97.
  const std::map<std::string, double> most = {
      {"area", 0.7}, {"sphericity_wadell", 0.7}, {"convexity", 1.0}, {"roundness_wadell", 1.0}};
  for (const auto& [key, share] : most) {
    EXPECT_LT(left[key], share * raw[key]) << key;
  }
}

TEST(Resolution, IntervalsCoverSegmentedScans) {
  std::mt19937_64 numbers(test::announced(55));
  const std::vector<std::string> keys = {"area",          "sphericity_wadell", "convexity",
                                         "sdq_invariant", "roundness_wadell",  "feret_max"};
  Intervals intervals;
  int scans = 0;
  for (const auto& [name, body] : bodies()) {
    for (const int across : {15, 20, 30}) {
      for (const double blur : {0.7, 1.0}) {
        SCOPED_TRACE(name + ", " + std::to_string(across) + " voxels, blur " +
                     std::to_string(blur));
        const double size = body.diameter / across;
        const Resolution found = resolution_of(
            test::segmented_voxels(body.mesh, size, pose(scans), {blur, 0.1}, numbers), size);
        EXPECT_NEAR(found.voxels_across, across, 0.05 * across);
        ++scans;
        for (const std::string& key : keys) {
          const ResolvedValue& row = row_of(found, key);
          if (!row.is_resolved()) {
            EXPECT_LT(across, 16) << key;
            continue;
          }
          intervals.add(row, body.values.at(key));
        }
      }
    }
  }
  for (const std::string& key : keys) {
    EXPECT_GE(3 * intervals.resolved[key], 2 * scans) << key << ": all but those of 15 voxels";
  }
  intervals.expect_covered();
}

TEST(Resolution, RoundnessOfFewVoxelsAndRoughnessAreNotResolved) {
  const IndexedMesh body = ellipsoid(Vector3(1.0, 0.8, 0.6));
  const double diameter = described(body).equivalent_diameter;
  const Resolution few = resolution_of(body, diameter / 12.0, pose(0));
  EXPECT_FALSE(row_of(few, "roundness_wadell").is_resolved());
  EXPECT_FALSE(row_of(few, "sq").is_resolved());
  EXPECT_TRUE(row_of(few, "area").is_resolved());
  const std::string sentence = resolution_sentence(few);
  EXPECT_TRUE(test::holds(sentence, "Not resolved: roundness, Sq."));
  EXPECT_TRUE(test::holds(sentence, "12 voxels across"));
}

// The measured parts of an interval (descriptor_biases.h), put together as their comments say.
TEST(Resolution, IntervalsAreMadeOfChangeScatterAndVoxels) {
  const IndexedMesh body = ellipsoid(Vector3(1.0, 0.8, 0.6));
  const Resolution found = resolution_of(body, described(body).equivalent_diameter / 16.0, pose(1));
  std::size_t scattered = 0;
  for (const ResolvedValue& row : found.rows) {
    if (!row.is_resolved()) continue;
    const DescriptorBias& bias = *bias_of(row.key);
    const double change = std::abs(row.value - row.again);
    if (row.key == "area") {
      EXPECT_NEAR(row.scatter, change * 10.0 / found.voxels_across, 1e-9 * row.value);
    }
    const double below = bias.share * change + bias.scatters * row.scatter +
                         bias.rest * std::abs(row.value) / found.voxels_across;
    if (bias.scatters * row.scatter > 1e-3 * below) ++scattered;
    const double rounding = 1e-9 * std::abs(row.value);
    if (row.low > 0.0) {
      EXPECT_NEAR(row.corrected - row.low, below, rounding) << row.key;
    }
    if (row.high < bias.most && row.corrected > 0.0) {
      EXPECT_NEAR(row.high - row.corrected, bias.above * below, rounding) << row.key;
    }
  }
  EXPECT_GT(scattered, 3U);
}

// Seen again by voxels of the same size, a body is about the same: numbers of the volume come back,
// and none leaves the range of its descriptor.
TEST(Resolution, SeenAgainIsSeenAsBefore) {
  const IndexedMesh body = read_mesh(std::string(WSCVT_MESHES_DIR) + "/angular_6000.ply");
  const Resolution found = resolution_of(body, described(body).equivalent_diameter / 20.0, pose(2));
  for (const char* key : {"volume", "equivalent_diameter", "axis_s_inertia", "axis_i_inertia",
                          "axis_l_inertia", "feret_max", "convexity"}) {
    const ResolvedValue& row = row_of(found, key);
    EXPECT_NEAR(row.again / row.value, 1.0, 0.05) << key;
    EXPECT_LT(row.scatter, 0.02 * row.value) << key;
  }
  std::size_t resolved = 0;
  for (const ResolvedValue& row : found.rows) {
    if (!row.is_resolved()) continue;
    ++resolved;
    EXPECT_GE(row.low, 0.0) << row.key;
    EXPECT_LE(row.high, bias_of(row.key)->most) << row.key;
  }
  EXPECT_GT(resolved, 10U);
}

// The lengths of the detailed descriptors are those of the grain's own.
TEST(Resolution, IsMeasuredWithTheLengthsOfTheCall) {
  const double size = 0.05;
  const IndexedMesh body = checked(
      surface_of_voxels(mesh_voxels(ellipsoid(Vector3(1.0, 0.8, 0.6)), size, pose(1)), 20, size));
  ResolutionOptions options;
  options.voxel_size = size;
  options.details.roundness_ball = 0.5;
  options.details.roughness_cutoff = 0.8;
  const DetailedDescriptors wide = describe_shape_in_detail(body, options.details, one_thread);
  const Resolution found = measure_resolution(body, wide, options, one_thread);
  const Resolution usual =
      resolution_of(mesh_voxels(ellipsoid(Vector3(1.0, 0.8, 0.6)), size, pose(1)), size);
  for (const char* key : {"roundness_wadell", "sq"}) {
    const ResolvedValue& row = row_of(found, key);
    EXPECT_NE(row.value, row_of(usual, key).value) << key;
    // Nearer to itself than to the number with other lengths.
    EXPECT_LT(std::abs(row.again - row.value), std::abs(row.again - row_of(usual, key).again))
        << key << " " << row.value << " " << row.again << " " << row_of(usual, key).again;
  }
}

TEST(Resolution, KeepsTheValuesAndTheirOrder) {
  const IndexedMesh body = checked(
      surface_of_voxels(mesh_voxels(ellipsoid(Vector3(1.0, 0.8, 0.6)), 0.1, pose(1)), 20, 0.1));
  const DetailedDescriptors descriptors = described(body);
  ResolutionOptions options;
  options.voxel_size = 0.1;
  const Resolution found = measure_resolution(body, descriptors, options, one_thread);
  const Resolution again = measure_resolution(body, descriptors, options, Execution(3));
  const std::vector<DescriptorValue> rows = list_descriptors(descriptors);
  ASSERT_EQ(found.rows.size(), rows.size());
  EXPECT_TRUE(row_of(found, "area").is_resolved());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(found.rows[k].key, rows[k].key);
    if (std::isfinite(rows[k].value)) {
      EXPECT_EQ(found.rows[k].value, rows[k].value);
    }
    if (!found.rows[k].is_resolved()) continue;
    EXPECT_EQ(found.rows[k].corrected, again.rows[k].corrected);
    EXPECT_LE(found.rows[k].low, found.rows[k].corrected);
    EXPECT_GE(found.rows[k].high, found.rows[k].corrected);
  }
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    options.voxel_size = size;
    test::expect_error(ErrorCode::InvalidInput,
                       [&] { measure_resolution(body, descriptors, options, one_thread); });
  }
  // Not the voxels of this mesh, and thinner than a voxel: nothing is resolved or refused.
  for (const double other : {0.07, 50.0}) {
    options.voxel_size = other;
    const Resolution none = measure_resolution(body, descriptors, options, one_thread);
    EXPECT_EQ(resolution_sentence(none).find("Nothing is resolved"), 0U);
    for (const ResolvedValue& row : none.rows) EXPECT_FALSE(row.is_resolved()) << row.key;
  }
}

}  // namespace
}  // namespace wscvt
