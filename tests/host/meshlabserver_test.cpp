// SPDX-License-Identifier: GPL-3.0-or-later
// The real meshlabserver, on a virtual display, from a stage folder with the plugin.
#include <gtest/gtest.h>

#include <QFile>
#include <QRegularExpression>

#include "calls.h"
#include "programs.h"
#include "sample_meshes.h"
#include "wscvt/report/remesh_options.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt::host_test {
namespace {

/// The exit code of meshlabserver when a filter returns false.
constexpr int refused = 255;

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
  for (const char* words : {"volume", "area", "aspect", "sphericity", "error", "seconds"}) {
    EXPECT_TRUE(outcome.output.contains(words, Qt::CaseInsensitive)) << words;
  }
}

INSTANTIATE_TEST_SUITE_P(, ServerScripts,
                         ::testing::Values("constant.mlx", "wscvt_d.mlx", "wscvt_c.mlx", "area.mlx",
                                           "error_adaptive.mlx"),
                         [](const auto& test) {
                           return QString(test.param).remove(".mlx").toStdString();
                         });

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
  EXPECT_EQ(outcome.exit_code, refused);
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
    EXPECT_EQ(outcome.exit_code, refused);
    EXPECT_FALSE(QFile::exists(output));
    EXPECT_TRUE(outcome.output.contains("NodeCount is missing"));
  }
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
