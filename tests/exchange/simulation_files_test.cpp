// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/simulation_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "toolbox/exchange/distance_grid.h"
#include "toolbox/exchange/simulation_options.h"
#include "wscvt/base/error.h"
#include "wscvt/remesh.h"

namespace wscvt {
namespace {

class SimulationFiles : public test::FileFolder {
 protected:
  static void SetUpTestSuite() {
    scan = new IndexedMesh(test::transformed(test::scaled(test::lumpy(4), {1.0, 1.4, 0.7}),
                                             test::random_rotation(5), {10, 20, 30}));
    RemeshOptions remesh_options;
    remesh_options.node_count = 120;
    remesh_options.measures.repaired_scan = true;
    result = new RemeshResult(remesh(*scan, remesh_options, Execution(2)));
  }
  static void TearDownTestSuite() {
    delete scan;
    delete result;
  }
  void SetUp() override {
    FileFolder::SetUp();
    options.frame.frame = Frame::Principal;
    options.frame.size = 0.1;
    options.grid.spacing = 0.01;
  }

  /// What a remesh of a formula gives, or one that was not asked for the scan.
  static RemeshResult without_scan() {
    RemeshResult copy = *result;
    copy.repaired_scan = {};
    return copy;
  }

  static IndexedMesh* scan;
  static RemeshResult* result;
  SimulationOptions options;
};

IndexedMesh* SimulationFiles::scan = nullptr;
RemeshResult* SimulationFiles::result = nullptr;

// Engine by engine one grain: what the files say of it is the same body in the same place.
TEST_F(SimulationFiles, NodesLieWhereTheGridIsZero) {
  options.surface = GridSurface::Remesh;
  write_nodes(path("nodes.csv"), *result, options);
  write_distance_grid(path("grid.npy"), *result, options, {}, Execution(2));
  const auto description = nlohmann::json::parse(content("grid.npy.json"));
  const double spacing = description.at("spacing").get<double>();
  EXPECT_EQ(spacing, 0.01);
  const auto count = [&](const char* axis) {
    return description.at("counts").at(axis).get<std::size_t>();
  };
  const std::string npy = content("grid.npy");
  const std::size_t numbers = 8 * count("x") * count("y") * count("z");
  ASSERT_GT(npy.size(), numbers);
  const auto value = [&](std::size_t i, std::size_t j, std::size_t k) {
    double number = 0.0;
    const std::size_t place = (i * count("y") + j) * count("z") + k;
    std::memcpy(&number, &npy[npy.size() - numbers + 8 * place], sizeof number);
    return number;
  };
  const auto records = test::csv_records(content("nodes.csv"));
  ASSERT_EQ(records.size(), 121U);
  for (std::size_t r = 1; r < records.size(); ++r) {
    std::array<std::size_t, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) {
      const char* axis = k == 0 ? "x" : k == 1 ? "y" : "z";
      const double from = description.at("origin").at(axis).get<double>();
      cell[k] = static_cast<std::size_t>((std::stod(records[r][k]) - from) / spacing);
    }
    // A node lies within a cell of each of its corners.
    EXPECT_LE(std::abs(value(cell[0], cell[1], cell[2])), std::sqrt(3.0) * spacing);
    EXPECT_LE(std::abs(value(cell[0] + 1, cell[1] + 1, cell[2] + 1)), std::sqrt(3.0) * spacing);
  }
}

TEST_F(SimulationFiles, DescriptionHoldsTheMassOfTheScanInTheFrame) {
  write_distance_grid(path("grid.npy"), *result, options, {"sand.ply", ""}, Execution(2));
  const auto description = nlohmann::json::parse(content("grid.npy.json"));
  EXPECT_EQ(description.at("source"), "sand.ply");
  EXPECT_EQ(description.at("frame").at("name"), "principal");
  const auto& mass = description.at("mass");
  EXPECT_NEAR(mass.at("volume").get<double>(), test::pi / 6.0 * 1e-3, 1e-12);
  const double least = mass.at("principal_moments").at("least").get<double>();
  EXPECT_NEAR(mass.at("inertia_tensor").at("xx").get<double>() / least, 1.0, 1e-9);
  EXPECT_NEAR(mass.at("inertia_tensor").at("xy").get<double>() / least, 0.0, 1e-9);
  EXPECT_NEAR(mass.at("principal_axes").at("w").get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(mass.at("centroid").at("y").get<double>(), 0.0, 1e-12);
}

TEST_F(SimulationFiles, AllLieInTheFrameOfTheScan) {
  const SimulationFrame frame = simulation_frame(result->scan, options.frame);
  write_nodes(path("nodes.csv"), *result, options);
  const auto records = test::csv_records(content("nodes.csv"));
  ASSERT_EQ(records.size(), 121U);
  for (std::size_t r = 1; r < records.size(); ++r) {
    const Vector3 exact = frame.point(result->mesh.points[r - 1]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(std::stod(records[r][k]), exact[static_cast<Eigen::Index>(k)], 1e-12);
    }
  }
  write_distance_grid(path("grid.npy"), *result, options, {}, Execution(2));
  const auto told = nlohmann::json::parse(content("grid.npy.json")).at("frame");
  const auto& axes = told.at("axes_in_scan");
  const auto number = [](const nlohmann::json& of, const char* name) {
    return of.at(name).get<double>();
  };
  const Eigen::Quaterniond turn(number(axes, "w"), number(axes, "x"), number(axes, "y"),
                                number(axes, "z"));
  EXPECT_LT(turn.angularDistance(frame.axes), 1e-7);
  EXPECT_EQ(told.at("scale"), frame.scale);
  const auto& origin = told.at("origin_in_scan");
  EXPECT_EQ(Vector3(number(origin, "x"), number(origin, "y"), number(origin, "z")), frame.origin);
}

TEST_F(SimulationFiles, GridIsOfTheScanUnlessTheRemeshIsAsked) {
  write_distance_grid(path("scan.npy"), *result, options, {}, Execution(2));
  options.surface = GridSurface::Remesh;
  write_distance_grid(path("remesh.npy"), without_scan(), options, {}, Execution(2));
  EXPECT_NE(content("scan.npy"), content("remesh.npy"));
  const SimulationFrame frame = simulation_frame(result->scan, options.frame);
  EXPECT_EQ(content("scan.npy"),
            grid_npy(distance_grid(in_frame(*scan, frame), options.grid, Execution(2))));
}

TEST_F(SimulationFiles, FollowTheirEndings) {
  write_nodes(path("nodes.VTP"), *result, options);
  EXPECT_TRUE(test::holds(content("nodes.VTP"), "PolyData"));
  write_nodes(path("a grain.shp"), *result, options);
  EXPECT_TRUE(test::holds(content("a grain.shp"), "name a_grain\n"));
  write_distance_grid(path("grid.vti"), *result, options, {}, Execution(2));
  EXPECT_TRUE(test::holds(content("grid.vti"), "ImageData"));
  write_distance_grid(path("grid.json"), *result, options, {}, Execution(2));
  EXPECT_TRUE(nlohmann::json::parse(content("grid.json")).contains("signed_distance_table"));
  EXPECT_EQ(grid_description_path("grid.vti"), "");
  EXPECT_EQ(grid_description_path("grid.NPY"), "grid.NPY.json");
}

TEST_F(SimulationFiles, OptionsOutOfRangeAreToldBeforehand) {
  EXPECT_NO_THROW(check_simulation_options(options));
  EXPECT_NO_THROW(check_simulation_options({}));
  const auto expect_refused = [](auto&& change) {
    SimulationOptions changed;
    change(changed);
    EXPECT_ERROR(check_simulation_options(changed), InvalidInput);
  };
  const double nan = std::nan("");
  for (const double spacing : {-0.01, nan}) {
    expect_refused([&](SimulationOptions& changed) { changed.grid.spacing = spacing; });
  }
  for (const double scale : {0.0, -1.0, nan}) {
    expect_refused([&](SimulationOptions& changed) { changed.frame.scale = scale; });
  }
  for (const double size : {-1.0, nan}) {
    expect_refused([&](SimulationOptions& changed) { changed.frame.size = size; });
  }
  expect_refused([](SimulationOptions& changed) { changed.frame.frame = Frame{100}; });
  expect_refused([](SimulationOptions& changed) { changed.surface = GridSurface{100}; });
}

TEST_F(SimulationFiles, RefuseWhatTheyCannotWrite) {
  EXPECT_ERROR(write_nodes(path("nodes.txt"), *result, options), InvalidInput);
  EXPECT_ERROR(write_distance_grid(path("grid.csv"), *result, options, {}, Execution(1)),
               InvalidInput);
  EXPECT_ERROR(write_distance_grid(path("grid.npy"), without_scan(), options, {}, Execution(1)),
               InvalidInput);
  options.frame.frame = Frame::Centred;
  EXPECT_ERROR(write_nodes(path("nodes.shp"), *result, options), InvalidInput);
  options.grid.spacing = -1.0;
  EXPECT_ERROR(check_simulation_options(options), InvalidInput);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace

namespace {

/// Without symmetry, so that it has one principal frame.
IndexedMesh body() {
  IndexedMesh mesh = test::scaled(test::lumpy(4), {1.0, 1.4, 0.7});
  for (Vector3& p : mesh.points) p.y() *= 1.0 + 0.15 * p.y();
  return mesh;
}

ShapeDescriptors describe(const IndexedMesh& mesh) { return describe_shape(mesh, Execution(1)); }

double largest_gap(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double gap = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) gap = std::max(gap, (a[i] - b[i]).norm());
  return gap;
}

TEST(SimulationFrame, InputIsWhatItWas) {
  const IndexedMesh mesh = body();
  const IndexedMesh same = in_frame(mesh, simulation_frame(describe(mesh), FrameOptions()));
  EXPECT_EQ(same.points, mesh.points);
  EXPECT_EQ(same.triangles, mesh.triangles);
}

TEST(SimulationFrame, CentredHasTheCentroidAtTheOriginAndKeepsTheAxes) {
  const IndexedMesh mesh = test::transformed(body(), Eigen::Matrix3d::Identity(), {5, 6, -7});
  FrameOptions options;
  options.frame = Frame::Centred;
  const IndexedMesh centred = in_frame(mesh, simulation_frame(describe(mesh), options));
  EXPECT_LT(describe(centred).centroid.norm(), 1e-12);
  EXPECT_LT((centred.points[9] - centred.points[4] - (mesh.points[9] - mesh.points[4])).norm(),
            1e-12);
}

TEST(SimulationFrame, PrincipalIsTheSameInEveryPoseAndDiagonal) {
  FrameOptions options;
  options.frame = Frame::Principal;
  const IndexedMesh upright = body();
  const IndexedMesh first = in_frame(upright, simulation_frame(describe(upright), options));
  const MassProperties mass = mass_properties(describe(first));
  EXPECT_LT((mass.inertia_tensor - Eigen::Matrix3d(mass.principal_moments.asDiagonal())).norm(),
            1e-12);
  EXPECT_LT(mass.principal_axes.angularDistance(Eigen::Quaterniond::Identity()), 1e-7);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const IndexedMesh turned =
        test::transformed(upright, test::random_rotation(seed), {-3, 0.1, 20});
    const IndexedMesh second = in_frame(turned, simulation_frame(describe(turned), options));
    EXPECT_LT(largest_gap(first.points, second.points), 1e-9);
  }
}

TEST(SimulationFrame, ScaleAndSize) {
  const IndexedMesh mesh = body();
  const ShapeDescriptors grain = describe(mesh);
  FrameOptions options;
  options.scale = 3.0;
  EXPECT_EQ(simulation_frame(grain, options).scale, 3.0);
  EXPECT_NEAR(describe(in_frame(mesh, simulation_frame(grain, options))).volume,
              27.0 * grain.volume, 1e-12 * grain.volume);
  options.scale = 1.0;
  options.size = 0.1;
  const ShapeDescriptors sized = describe(in_frame(mesh, simulation_frame(grain, options)));
  EXPECT_NEAR(sized.volume, test::pi / 6.0 * 1e-3, 1e-15);
}

TEST(SimulationFrame, MassGoesWithTheMesh) {
  const IndexedMesh mesh = test::transformed(body(), test::random_rotation(4), {1, 2, 3});
  for (const Frame frame : {Frame::Input, Frame::Centred, Frame::Principal}) {
    FrameOptions options;
    options.frame = frame;
    options.scale = 0.3;
    const SimulationFrame to = simulation_frame(describe(mesh), options);
    const MassProperties told = in_frame(mass_properties(describe(mesh)), to);
    const MassProperties measured = mass_properties(describe(in_frame(mesh, to)));
    EXPECT_NEAR(told.volume / measured.volume, 1.0, 1e-12);
    EXPECT_LT((told.centroid - measured.centroid).norm(), 1e-12);
    EXPECT_LT((told.inertia_tensor - measured.inertia_tensor).norm(),
              1e-10 * told.inertia_tensor.norm());
    EXPECT_LT((told.principal_moments - measured.principal_moments).norm(),
              1e-10 * told.inertia_tensor.norm());
    EXPECT_LT(told.principal_axes.angularDistance(measured.principal_axes), 1e-7);
  }
}

TEST(SimulationFrame, RefusesWhatMakesNoSense) {
  const ShapeDescriptors grain = describe(body());
  FrameOptions options;
  options.scale = 0.0;
  EXPECT_ERROR(simulation_frame(grain, options), InvalidInput);
  options.scale = 2.0;
  options.size = 1.0;
  EXPECT_ERROR(simulation_frame(grain, options), InvalidInput);
  options.scale = 1.0;
  options.size = -1.0;
  EXPECT_ERROR(simulation_frame(grain, options), InvalidInput);
}

}  // namespace
}  // namespace wscvt
