// SPDX-License-Identifier: GPL-3.0-or-later
// The real meshlabserver, on a virtual display, from a stage folder with the plugin.
#include <gtest/gtest.h>

#include <QFile>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "calls.h"
#include "grains/bent_grain.h"
#include "programs.h"
#include "sample_meshes.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::host_test {
namespace {

class ServerScripts : public ::testing::TestWithParam<const char*> {};

TEST_P(ServerScripts, GiveTheExactCountAndTheTable) {
  const QString scan = sample("sand_7228.ply");
  ASSERT_TRUE(QFile::exists(scan)) << scan.toStdString();
  QTemporaryDir folder;
  const QString output = folder.filePath("remeshed.ply");
  const Outcome outcome = run_meshlabserver(
      {"-i", scan, "-s", script_path(GetParam()), "-o", output, "-m", "vq"}, folder.path());
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  ASSERT_FALSE(outcome.crashed);
  // meshlabserver ends with 0 when it could not save, so the file itself is looked at.
  const IndexedMesh mesh = read_mesh(output.toStdString());
  EXPECT_EQ(mesh.points.size(), 1000U);
  EXPECT_EQ(mesh.triangles.size(), 2U * 1000U - 4U);
  for (const char* words : {"volume", "area", "aspect", "sphericity", "error", "time, s"}) {
    EXPECT_TRUE(outcome.output.contains(words, Qt::CaseInsensitive)) << words;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ServerScripts, ::testing::Values("constant.mlx", "wscvt_d.mlx", "wscvt_c.mlx", "area.mlx"),
    [](const auto& test) { return QString(test.param).remove(".mlx").toStdString(); });

TEST(Server, InPlaceReplacesTheMesh) {
  QTemporaryDir folder;
  const QString input = folder.filePath("grain.ply");
  write_as_it_is(grain(), input);
  const QString script = folder.filePath("script.mlx");
  write_script({{"NewLayer", "false"}, {"NodeCount", "321"}, {"ColorByQuality", "true"}}, script);
  const QString output = folder.filePath("remeshed.ply");
  // -l 0: the first layer, which is the scan's own.
  const Outcome outcome = run_meshlabserver(
      {"-i", input, "-s", script, "-o", output, "-l", "0", "-m", "vc"}, folder.path());
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  ASSERT_FALSE(outcome.crashed);
  EXPECT_EQ(read_mesh(output.toStdString()).points.size(), 321U);
}

TEST(Server, WritesAReportAsAPageThatNamesTheLayer) {
  QTemporaryDir folder;
  const QString input = folder.filePath("grain.ply");
  write_as_it_is(grain(), input);
  const QString script = folder.filePath("script.mlx");
  const QString report = folder.filePath("report.html");
  write_script({{"NodeCount", "150"}, {"ReportFile", report.toStdString()}}, script);
  const Outcome outcome = run_meshlabserver({"-i", input, "-s", script}, folder.path());
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  ASSERT_FALSE(outcome.crashed);
  QFile file(report);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const QString page = QString::fromUtf8(file.readAll());
  EXPECT_TRUE(page.startsWith("<!DOCTYPE html>"));
  EXPECT_TRUE(page.endsWith("</html>\n"));
  EXPECT_EQ(page.count("<img"), 3);
  EXPECT_TRUE(page.contains("<title>Remesh of grain.ply with 150 nodes</title>"));
  EXPECT_TRUE(page.contains(QRegularExpression(" on \\d{4}-\\d\\d-\\d\\d\\.")));
  EXPECT_TRUE(page.contains("<td>volume, length^3</td>"));
}

TEST(Server, TwoRunsGiveTheSameBytes) {
  QTemporaryDir folder;
  const QString input = folder.filePath("grain.ply");
  write_as_it_is(grain(), input);
  QByteArray contents[2];
  for (int run = 0; run < 2; ++run) {
    const QString output = folder.filePath(QString("run_%1.ply").arg(run));
    run_meshlabserver({"-i", input, "-s", script_path("area.mlx"), "-o", output, "-m", "vq"},
                      folder.path());
    QFile file(output);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    contents[run] = file.readAll();
  }
  EXPECT_FALSE(contents[0].isEmpty());
  EXPECT_TRUE(contents[0] == contents[1]);
}

/// Loads the call's mesh, if it has one, and applies the filter to it with the call's parameters.
Outcome run_call(const Call& call, const QTemporaryDir& folder, const QString& output) {
  QStringList arguments;
  if (call.mesh) {
    const QString input = folder.filePath("input.ply");
    write_as_it_is(*call.mesh, input);
    arguments << "-i" << input;
  }
  const QString script = folder.filePath("script.mlx");
  write_script(call.parameters, script);
  arguments << "-s" << script << "-o" << output;
  return run_meshlabserver(arguments, folder.path());
}

class ServerRefuses : public ::testing::TestWithParam<Call> {};

TEST_P(ServerRefuses, WithASentenceInTheLog) {
  const Call& call = GetParam();
  QTemporaryDir folder;
  const QString output = folder.filePath("remeshed.ply");
  const Outcome outcome = run_call(call, folder, output);
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  EXPECT_FALSE(outcome.crashed);
  EXPECT_EQ(outcome.exit_code, exit_code_of_refusal);
  EXPECT_FALSE(QFile::exists(output));
  for (const std::string& word : call.words) {
    EXPECT_TRUE(outcome.output.contains(QString::fromStdString(word), Qt::CaseInsensitive)) << word;
  }
}

INSTANTIATE_TEST_SUITE_P(, ServerRefuses, ::testing::ValuesIn(refused_calls()),
                         [](const auto& test) { return test.param.name; });

TEST(Server, RefusesANodeCountThatCannotBeRead) {
  for (const char* const value : {"abc", "200.7", "99999999999"}) {
    SCOPED_TRACE(value);
    QTemporaryDir folder;
    const QString output = folder.filePath("remeshed.ply");
    const Outcome outcome = run_call({"", grain(), {{"NodeCount", value}}, {}}, folder, output);
    SCOPED_TRACE(outcome.output.toStdString());
    ASSERT_TRUE(outcome.ended);
    EXPECT_FALSE(outcome.crashed);
    EXPECT_EQ(outcome.exit_code, exit_code_of_refusal);
    EXPECT_FALSE(QFile::exists(output));
    EXPECT_TRUE(outcome.output.contains("NodeCount is missing"));
  }
}

TEST(Server, WritesNothingWhenAnotherNumberCannotBeRead) {
  // This MeshLab drops what it cannot read and ends itself by an assertion before the filter is
  // asked; the default is not what was asked for.
  const std::pair<const char*, const char*> garbled[] = {{"HarmonicDegree", "abc"},
                                                         {"ErrorTarget", "1,5"},
                                                         {"FoldLimit", ""},
                                                         {"CurvatureAlpha", "one"},
                                                         {"EdgeRatio", "0x2"}};
  for (const auto& [name, value] : garbled) {
    SCOPED_TRACE(std::string(name) + " = " + value);
    QTemporaryDir folder;
    const QString output = folder.filePath("remeshed.ply");
    const Outcome outcome = run_call({"", grain(), {{name, value}}, {}}, folder, output);
    ASSERT_TRUE(outcome.ended);
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_FALSE(QFile::exists(output));
  }
}

/// A refusal, and what MeshLab does when its advice is followed.
struct Advice {
  std::string name;
  Call refused;   ///< with words of the advice
  QString steps;  ///< filters of MeshLab to apply first, as a script holds them
  std::map<std::string, std::string> parameters;  ///< of the remesher, the second time
};

void PrintTo(const Advice& advice, std::ostream* out) { *out << advice.name; }

/// "Uniform Mesh Resampling" of the distance to the mesh, whichever side it is on.
QString resampled_at_a_distance(double cell, double offset) {
  return QStringLiteral(
             " <filter name=\"Uniform Mesh Resampling\">\n"
             "  <Param name=\"CellSize\" type=\"RichAbsPerc\" value=\"%1\" min=\"0\" max=\"9\"/>\n"
             "  <Param name=\"Offset\" type=\"RichAbsPerc\" value=\"%2\" min=\"-9\" max=\"9\"/>\n"
             "  <Param name=\"mergeCloseVert\" type=\"RichBool\" value=\"true\"/>\n"
             "  <Param name=\"discretize\" type=\"RichBool\" value=\"false\"/>\n"
             "  <Param name=\"multisample\" type=\"RichBool\" value=\"false\"/>\n"
             "  <Param name=\"absDist\" type=\"RichBool\" value=\"true\"/>\n"
             " </filter>\n")
      .arg(cell)
      .arg(offset);
}

/// A ball drilled through along z by holes of radius 0.06, 0.2 apart.
IndexedMesh porous_ball() {
  return test::body_of_depth([](const Vector3& p) {
    const double x = p.x() - 0.2 * std::round(p.x() / 0.2);
    const double y = p.y() - 0.2 * std::round(p.y() / 0.2);
    return std::min(test::ball(p), std::hypot(x, y) - 0.06);
  });
}

std::vector<Advice> all_advice() {
  const IndexedMesh points{sphere().points, {}};
  const std::string resample =
      "Filters > Remeshing, Simplification and Reconstruction > Uniform Mesh Resampling with "
      "Absolute Distance checked and an Offset";
  return {
      {"SplitTheBodies",
       {"", two_grains(), {}, {"Filters > Mesh Layer > Split in Connected Components"}},
       " <filter name=\"Split in Connected Components\"/>\n",
       {}},
      // The band leaves an opening of radius 1.4.
      {"ResampleTheBand",
       {"", band_with_one_side(), {}, {resample}},
       resampled_at_a_distance(0.1, 1.7),
       {}},
      {"ResampleThePores",
       {"", porous_ball(), {}, {resample}},
       resampled_at_a_distance(0.03, 0.08),
       {}},
      // A hole .4 wide, too small for the usual limit.
      {"ResampleTheHole",
       {"", without_a_patch(192), {{"MendLimit", "0.5"}}, {resample}},
       resampled_at_a_distance(0.05, 0.3),
       {{"MendLimit", "0.5"}}},
      {"RaiseTheMendLimit",
       {"", without_a_patch(), {}, {"Raise \"Max. repaired area (%)\""}},
       "",
       {{"MendLimit", "100"}}},
      {"TakeThePoints",
       {"", points, {}, {"\"Rebuild the surface from the points\""}},
       "",
       {{"Points", "true"}}},
      {"TakeTheMethodOnTheScan",
       {"", bent_grain(), {{"Method", "1"}}, {"Use \"Method: On the scan\""}},
       "",
       {{"Method", "0"}}},
      {"FitToTheScan",
       {"",
        grain(),
        {{"ErrorTarget", "0.5"}, {"Method", "1"}, {"HarmonicDegree", "2"}},
        {"use \"Method: On the scan\""}},
       "",
       {{"ErrorTarget", "0.5"}, {"Method", "0"}, {"HarmonicDegree", "2"}}},
  };
}

/// Remeshes what other filters make of the input of a call before. `then` are filters for the
/// result.
Outcome run_after(const QString& steps, const std::map<std::string, std::string>& parameters,
                  const QTemporaryDir& folder, const QString& output, const QString& then = {}) {
  const QString script = folder.filePath("script.mlx");
  write_script(parameters, script);
  QFile file(script);
  EXPECT_TRUE(file.open(QIODevice::ReadWrite));
  QString text = QString::fromUtf8(file.readAll());
  text.insert(text.indexOf("</FilterScript>"), then);
  text.insert(text.indexOf(" <filter"), steps);
  file.seek(0);
  file.write(text.toUtf8());
  file.close();
  return run_meshlabserver({"-i", folder.filePath("input.ply"), "-s", script, "-o", output},
                           folder.path());
}

class ServerAdvises : public ::testing::TestWithParam<Advice> {};

TEST_P(ServerAdvises, WhatLeadsToARemesh) {
  const Advice& advice = GetParam();
  QTemporaryDir folder;
  const QString output = folder.filePath("remeshed.ply");
  const Outcome refusal = run_call(advice.refused, folder, output);
  EXPECT_EQ(refusal.exit_code, exit_code_of_refusal);
  EXPECT_FALSE(QFile::exists(output));
  for (const std::string& word : advice.refused.words) {
    EXPECT_TRUE(refusal.output.contains(QString::fromStdString(word)))
        << word << "\n"
        << refusal.output.toStdString();
  }

  const Outcome outcome = run_after(advice.steps, advice.parameters, folder, output);
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(QFile::exists(output));
  const std::size_t nodes = read_mesh(output.toStdString()).points.size();
  if (advice.parameters.count("ErrorTarget") > 0) {
    EXPECT_GE(nodes, 4U);  // it finds a number of its own
  } else {
    EXPECT_EQ(nodes, 1000U);
  }
}

INSTANTIATE_TEST_SUITE_P(, ServerAdvises, ::testing::ValuesIn(all_advice()),
                         [](const auto& test) { return test.param.name; });

TEST(Server, AdvisesToFreezeTheTransformBeforeTheMeshIsSaved) {
  QTemporaryDir folder;
  write_as_it_is(grain(), folder.filePath("input.ply"));
  // meshlabserver wants every parameter, in their order.
  QString scaled_along_z = " <filter name=\"Matrix: Set from translation/rotation/scale\">\n";
  const auto add = [&](const char* name, const char* type, const char* value) {
    scaled_along_z +=
        QString("  <Param name=\"%1\" type=\"%2\" value=\"%3\"/>\n").arg(name, type, value);
  };
  for (const char* name :
       {"translationX", "translationY", "translationZ", "rotationX", "rotationY", "rotationZ"}) {
    add(name, "RichFloat", "0");
  }
  for (const char* name : {"scaleX", "scaleY"}) add(name, "RichFloat", "1");
  add("scaleZ", "RichFloat", "3");
  for (const char* name : {"compose", "Freeze", "allLayers"}) add(name, "RichBool", "false");
  scaled_along_z += " </filter>\n";
  const QString output = folder.filePath("remeshed.ply");
  const Outcome outcome = run_after(scaled_along_z, {}, folder, output,
                                    " <filter name=\"Matrix: Freeze Current Matrix\"/>\n");
  SCOPED_TRACE(outcome.output.toStdString());
  EXPECT_TRUE(outcome.output.contains("apply Matrix: Freeze Current Matrix before you save"));
  ASSERT_TRUE(QFile::exists(output));
  const IndexedMesh mesh = read_mesh(output.toStdString());
  const double volume = 3.0 * describe_shape(grain(), Execution(1)).volume;
  EXPECT_NEAR(describe_shape(mesh, Execution(1)).volume / volume, 1.0, 1e-6);
  // What the filter was asked for by default, of what is shown.
  EXPECT_NEAR(measure_quality(mesh).edge_ratio.mean, 1.1, 0.01);
}

TEST(Server, AdvisesASurfaceOfPointsThatLieBehindOthers) {
  // A grain's points, and strays inside it as scanners leave them.
  IndexedMesh cloud{test::lumpy(5).points, {}};
  const double volume = describe_shape(test::lumpy(5), Execution(1)).volume;
  for (const Vector3& p : test::lumpy(2).points) cloud.points.push_back(0.5 * p);
  QTemporaryDir folder;
  const QString output = folder.filePath("remeshed.ply");
  const Outcome warned =
      run_call({"", cloud, {{"Points", "true"}, {"NodeCount", "100"}}, {}}, folder, output);
  EXPECT_TRUE(warned.output.contains(
      "Filters > Normals, Curvatures and Orientation > Compute normals for point sets and then "
      "Filters > Remeshing, Simplification and Reconstruction > Surface Reconstruction: Screened "
      "Poisson"))
      << warned.output.toStdString();
  ASSERT_TRUE(QFile::remove(output));
  const QString steps =
      " <filter name=\"Compute normals for point sets\">\n"
      "  <Param name=\"K\" type=\"RichInt\" value=\"10\"/>\n"
      "  <Param name=\"smoothIter\" type=\"RichInt\" value=\"0\"/>\n"
      "  <Param name=\"flipFlag\" type=\"RichBool\" value=\"false\"/>\n"
      "  <Param name=\"viewPos\" type=\"RichPoint3f\" x=\"0\" y=\"0\" z=\"0\"/>\n"
      " </filter>\n"
      " <filter name=\"Surface Reconstruction: Screened Poisson\">\n"
      "  <Param name=\"visibleLayer\" type=\"RichBool\" value=\"false\"/>\n"
      "  <Param name=\"depth\" type=\"RichInt\" value=\"7\"/>\n"
      "  <Param name=\"fullDepth\" type=\"RichInt\" value=\"5\"/>\n"
      "  <Param name=\"cgDepth\" type=\"RichInt\" value=\"0\"/>\n"
      "  <Param name=\"scale\" type=\"RichFloat\" value=\"1.1\"/>\n"
      "  <Param name=\"samplesPerNode\" type=\"RichFloat\" value=\"1.5\"/>\n"
      "  <Param name=\"pointWeight\" type=\"RichFloat\" value=\"4\"/>\n"
      "  <Param name=\"iters\" type=\"RichInt\" value=\"8\"/>\n"
      "  <Param name=\"confidence\" type=\"RichBool\" value=\"false\"/>\n"
      "  <Param name=\"preClean\" type=\"RichBool\" value=\"true\"/>\n"
      " </filter>\n";
  const Outcome outcome = run_after(steps, {}, folder, output);
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(QFile::exists(output));
  const IndexedMesh remeshed = read_mesh(output.toStdString());
  EXPECT_EQ(remeshed.points.size(), 1000U);
  EXPECT_FALSE(outcome.output.contains("one radius in each direction"));
  // Least squares keep the volume of the surface that was made, which rounds a little.
  EXPECT_NEAR(describe_shape(remeshed, Execution(1)).volume / volume, 1.0, 0.02);
}

class ServerCopesWith : public ::testing::TestWithParam<Call> {};

TEST_P(ServerCopesWith, AnUnusualCall) {
  const Call& call = GetParam();
  QTemporaryDir folder;
  const QString output = folder.filePath("remeshed.ply");
  const Outcome outcome = run_call(call, folder, output);
  SCOPED_TRACE(outcome.output.toStdString());
  ASSERT_TRUE(outcome.ended);
  ASSERT_FALSE(outcome.crashed);
  const auto asked = call.parameters.find("NodeCount");
  const auto nodes = static_cast<std::size_t>(
      asked == call.parameters.end() ? RemeshOptions().node_count : std::stoi(asked->second));
  const IndexedMesh mesh = read_mesh(output.toStdString());
  EXPECT_EQ(mesh.points.size(), nodes);
  EXPECT_EQ(mesh.triangles.size(), 2 * nodes - 4);
}

INSTANTIATE_TEST_SUITE_P(, ServerCopesWith, ::testing::ValuesIn(extreme_calls()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace wscvt::host_test
