// SPDX-License-Identifier: GPL-3.0-or-later
// The filters that create grains and that measure them, in the real meshlabserver.
#include <gtest/gtest.h>

#include <QFile>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calls.h"
#include "programs.h"
#include "sample_meshes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt::host_test {
namespace {

using Values = std::map<std::string, std::string>;

/// Applies a script of the project with other values, to meshes that lie in `folder`.
Outcome run_script(const QString& original, const Values& values, const QStringList& meshes,
                   const QTemporaryDir& folder, const QStringList& more = {}) {
  const QString script = folder.filePath("script.mlx");
  write_script(values, script, original);
  QStringList arguments;
  for (const QString& mesh : meshes) arguments << "-i" << folder.filePath(mesh);
  arguments << "-s" << script << more;
  return run_meshlabserver(arguments, folder.path());
}

nlohmann::json read_json(const QString& path) {
  std::ifstream file(path.toStdString());
  return nlohmann::json::parse(file);
}

TEST(ServerCreates, AnEllipsoidWithItsVolume) {
  QTemporaryDir folder;
  const QString output = folder.filePath("grain.ply");
  const Outcome outcome = run_script(
      "create_superellipsoid.mlx",
      {{"Surface", "0"}, {"NodeCount", "400"}, {"Placement", "2"}, {"ReportFile", "report.json"}},
      {}, folder, {"-o", output});
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  ASSERT_FALSE(outcome.crashed);
  const IndexedMesh mesh = read_mesh(output.toStdString());
  ASSERT_EQ(mesh.points.size(), 400U);
  EXPECT_EQ(mesh.triangles.size(), 2U * 400U - 4U);
  const double volume = 4.0 * pi / 3.0 * 1.5 * 1.2 * 1.0;
  // Fitted nodes have the formula's volume; the coordinates are floats.
  EXPECT_NEAR(describe_shape(mesh, Execution()).volume / volume, 1.0, 1e-6);
  const nlohmann::json report = read_json(folder.filePath("report.json"));
  EXPECT_NEAR(report["descriptors"]["volume"]["scan"].get<double>() / volume, 1.0, 1e-6);
}

TEST(ServerCreates, ASuperellipsoidWithinItsBox) {
  QTemporaryDir folder;
  const QString output = folder.filePath("grain.ply");
  const Outcome outcome =
      run_script("create_superellipsoid.mlx", {{"NodeCount", "300"}}, {}, folder, {"-o", output});
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  ASSERT_FALSE(outcome.crashed);
  const IndexedMesh mesh = read_mesh(output.toStdString());
  ASSERT_EQ(mesh.points.size(), 300U);
  // Every node satisfies the equation, to what floats hold.
  for (const Vector3& p : mesh.points) {
    const double e1 = 0.7;
    const double e2 = 0.8;
    const double round =
        std::pow(std::abs(p.x() / 1.5), 2.0 / e2) + std::pow(std::abs(p.y() / 1.2), 2.0 / e2);
    const double value = std::pow(round, e2 / e1) + std::pow(std::abs(p.z()), 2.0 / e1);
    EXPECT_NEAR(value, 1.0, 1e-5);
  }
}

TEST(ServerCreates, TheGrainWhoseCoefficientsTheRemesherSaved) {
  QTemporaryDir folder;
  write_as_it_is(grain(), folder.filePath("scan.ply"));
  const Outcome saving = run_script(
      "wscvt_d.mlx",
      {{"NodeCount", "200"}, {"HarmonicDegree", "20"}, {"CoefficientsFile", "grain.json"}},
      {"scan.ply"}, folder);
  SCOPED_TRACE(saving.output.toStdString());
  const auto surface =
      std::get<HarmonicSurface>(read_harmonics(folder.filePath("grain.json").toStdString()));
  EXPECT_EQ(surface.degree(), 20);

  const QString output = folder.filePath("grain.ply");
  const Outcome outcome =
      run_script("create_superellipsoid.mlx",
                 {{"Surface", "2"}, {"CoefficientsFile", "grain.json"}, {"NodeCount", "250"}}, {},
                 folder, {"-o", output});
  SCOPED_TRACE(outcome.output.toStdString());
  const IndexedMesh mesh = read_mesh(output.toStdString());
  ASSERT_EQ(mesh.points.size(), 250U);
  std::vector<Vector3> directions;
  for (const Vector3& p : mesh.points) directions.push_back(p.normalized());
  const std::vector<double> radii = surface.radii(directions, Execution());
  // Nodes lie on the series, to what floats hold.
  for (std::size_t i = 0; i < radii.size(); ++i) {
    EXPECT_NEAR(mesh.points[i].norm(), radii[i], 1e-5);
  }
}

TEST(ServerCreates, ASphereFromTheTextFormCutAtDegreeZero) {
  QTemporaryDir folder;
  std::ofstream(folder.filePath("grain.dat").toStdString())
      << "0 0 " << 3.0 * std::sqrt(4.0 * pi) << " 0\n1 0 0.1 0\n1 1 0.2 0.3\n1 -1 -0.2 0.3\n";
  const QString output = folder.filePath("grain.ply");
  const Outcome outcome = run_script("create_superellipsoid.mlx",
                                     {{"Surface", "2"},
                                      {"CoefficientsFile", "grain.dat"},
                                      {"CoefficientDegree", "0"},
                                      {"NodeCount", "160"}},
                                     {}, folder, {"-o", output});
  SCOPED_TRACE(outcome.output.toStdString());
  const IndexedMesh mesh = read_mesh(output.toStdString());
  ASSERT_EQ(mesh.points.size(), 160U);
  for (const Vector3& p : mesh.points) EXPECT_NEAR(p.norm(), 3.0, 1e-4);
}

TEST(ServerDescribes, ALayer) {
  QTemporaryDir folder;
  write_as_it_is(sphere(), folder.filePath("ball.ply"));
  const Outcome outcome =
      run_script("descriptors.mlx", {{"ReportFile", "report.csv"}}, {"ball.ply"}, folder);
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  EXPECT_FALSE(outcome.crashed);
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* words : {"volume", "convexity", "Zingg", "Kong-Fonseca", "Krumbein", "roundness",
                            "Sku", "oriented box", "rodness", "Time, s"}) {
    EXPECT_TRUE(outcome.output.contains(words)) << words;
  }
  QFile report(folder.filePath("report.csv"));
  ASSERT_TRUE(report.open(QIODevice::ReadOnly));
  const QList<QByteArray> lines = report.readAll().split('\n');
  ASSERT_GE(lines.size(), 2);
  EXPECT_TRUE(lines[0].contains(",grain,descriptors.volume,descriptors.area,"));
  EXPECT_TRUE(lines[1].contains(",ball.ply,4."));
}

TEST(ServerDescribes, TheErrorsAgainstASecondLayer) {
  QTemporaryDir folder;
  write_as_it_is(sphere(), folder.filePath("ball.ply"));
  write_as_it_is(scaled(sphere(), 1.1), folder.filePath("larger.ply"));
  const Outcome outcome =
      run_script("descriptors.mlx", {{"ReferenceLayer", "ball.ply"}, {"ReportFile", "report.json"}},
                 {"ball.ply", "larger.ply"}, folder);
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  ASSERT_FALSE(outcome.crashed);
  const nlohmann::json report = read_json(folder.filePath("report.json"));
  EXPECT_EQ(report["grain"], "larger.ply");
  EXPECT_EQ(report["reference"], "ball.ply");
  const auto error = [&](const char* key) {
    return report["descriptors"][key]["error_percent"].get<double>();
  };
  // The coordinates are floats.
  EXPECT_NEAR(error("volume"), 100.0 * (1.1 * 1.1 * 1.1 - 1.0), 1e-3);
  EXPECT_NEAR(error("area"), 100.0 * (1.1 * 1.1 - 1.0), 1e-3);
  EXPECT_NEAR(error("sphericity_wadell"), 0.0, 1e-3);
  // Vertices lie 0.1 apart, the middles of faces no more.
  EXPECT_NEAR(report["distances"]["largest_distance"].get<double>(), 0.1, 0.002);
}

struct BadCall {
  std::string name;
  QString script;
  Values values;
  bool with_mesh = false;
  std::vector<std::string> words;
};

void PrintTo(const BadCall& call, std::ostream* out) { *out << call.name; }

class ServerRefusesToo : public ::testing::TestWithParam<BadCall> {};

TEST_P(ServerRefusesToo, WithASentenceInTheLog) {
  const BadCall& call = GetParam();
  QTemporaryDir folder;
  std::ofstream(folder.filePath("nonsense.dat").toStdString()) << "these are no coefficients\n";
  QStringList meshes;
  if (call.with_mesh) {
    write_as_it_is(grain(), folder.filePath("grain.ply"));
    meshes << "grain.ply";
  }
  const Outcome outcome = run_script(call.script, call.values, meshes, folder);
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  EXPECT_FALSE(outcome.crashed);
  EXPECT_EQ(outcome.exit_code, exit_code_of_refusal);
  for (const std::string& word : call.words) {
    EXPECT_TRUE(outcome.output.contains(QString::fromStdString(word), Qt::CaseInsensitive)) << word;
  }
}

/// Measures the call's mesh, if it has one, with the call's parameters.
class ServerRefusesToMeasure : public ::testing::TestWithParam<Call> {};

TEST_P(ServerRefusesToMeasure, WithASentenceInTheLogAndNoReport) {
  const Call& call = GetParam();
  QTemporaryDir folder;
  QStringList meshes;
  if (call.mesh) {
    write_as_it_is(*call.mesh, folder.filePath("body.ply"));
    meshes << "body.ply";
  }
  Values values = call.parameters;
  values["ReportFile"] = "report.json";
  const Outcome outcome = run_script("descriptors.mlx", values, meshes, folder);
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  EXPECT_FALSE(outcome.crashed);
  EXPECT_EQ(outcome.exit_code, exit_code_of_refusal);
  EXPECT_FALSE(QFile::exists(folder.filePath("report.json")));
  for (const std::string& word : call.words) {
    EXPECT_TRUE(outcome.output.contains(QString::fromStdString(word), Qt::CaseInsensitive)) << word;
  }
}

INSTANTIATE_TEST_SUITE_P(, ServerRefusesToMeasure, ::testing::ValuesIn(unmeasurable_calls()),
                         [](const auto& test) { return test.param.name; });

const QString create = "create_superellipsoid.mlx";
const QString describe = "descriptors.mlx";

INSTANTIATE_TEST_SUITE_P(
    , ServerRefusesToo,
    ::testing::Values(
        BadCall{"ExponentTooSmall", create, {{"PolarExponent", "0.05"}}, false, {"PolarExponent"}},
        BadCall{
            "ExponentTooLarge", create, {{"AzimuthalExponent", "2.5"}}, false, {"2.5", "0.1 to 2"}},
        BadCall{"SemiAxisZero", create, {{"SemiAxisY", "0"}}, false, {"SemiAxisY"}},
        BadCall{"SurfaceOutOfRange", create, {{"Surface", "3"}}, false, {"Superellipsoid"}},
        BadCall{"NoCoefficients", create, {{"Surface", "2"}}, false, {"CoefficientsFile", ".dat"}},
        BadCall{"CoefficientsOfUnknownKind",
                create,
                {{"Surface", "2"}, {"CoefficientsFile", "grain.txt"}},
                false,
                {"grain.txt", ".json"}},
        BadCall{"CoefficientsNotThere",
                create,
                {{"Surface", "2"}, {"CoefficientsFile", "missing.json"}},
                false,
                {"missing.json"}},
        BadCall{"CoefficientsNonsense",
                create,
                {{"Surface", "2"}, {"CoefficientsFile", "nonsense.dat"}},
                false,
                {"nonsense.dat"}},
        BadCall{"CreationReportOfUnknownKind", create, {{"ReportFile", "r.doc"}}, false, {".html"}},
        BadCall{"NoMesh", describe, {}, false, {"no mesh"}},
        BadCall{
            "UnknownLayer", describe, {{"ReferenceLayer", "scan"}}, true, {"'scan'", "grain.ply"}},
        BadCall{"ReportOfUnknownKind", describe, {{"ReportFile", "r.xml"}}, true, {".csv"}},
        BadCall{"BallOutOfRange", describe, {{"RoundnessBall", "1.5"}}, true, {"0.05 to 1"}}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace wscvt::host_test
