// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_file.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

#include "descriptor_filter.h"
#include "remesh_report.h"
#include "sample_meshes.h"
#include "wscvt/base/error.h"
#include "wscvt/report/report.h"

namespace wscvt::host_test {
namespace {

using filter::ReportFormat;

std::string content_of(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll().toStdString() : "cannot be read";
}

TEST(ReportFile, FormatFollowsFromTheExtension) {
  EXPECT_EQ(filter::report_format(""), ReportFormat::None);
  EXPECT_EQ(filter::report_format("a/b.html"), ReportFormat::Html);
  EXPECT_EQ(filter::report_format("b.c.JSON"), ReportFormat::Json);
  EXPECT_EQ(filter::report_format("b.Csv"), ReportFormat::Csv);
  EXPECT_THROW(filter::report_format("b.txt"), Error);
  EXPECT_THROW(filter::report_format("csv"), Error);
}

TEST(ReportFile, HoldsTheLibrarysReportOrAPageWithTwoFigures) {
  const IndexedMesh scan = grain();
  RemeshOptions options;
  options.node_count = 100;
  const RemeshResult result = remesh(scan, options);
  QTemporaryDir folder;
  const auto written = [&](const QString& name, const IndexedMesh& original) {
    const QString path = folder.filePath(name);
    filter::write_report(result, original, path.toStdString());
    return content_of(path);
  };
  EXPECT_EQ(written("report.json", scan), report_json(result));
  EXPECT_EQ(written("report.csv", scan), report_csv(result));
  for (const IndexedMesh& original : {scan, IndexedMesh{scan.points, {}}, IndexedMesh()}) {
    const QString page = QString::fromStdString(written("report.html", original));
    EXPECT_TRUE(page.startsWith("<!DOCTYPE html>"));
    EXPECT_TRUE(page.endsWith("</html>\n"));
    EXPECT_EQ(page.count("<svg"), 2);
    EXPECT_EQ(page.count("</svg>"), 2);
    EXPECT_FALSE(page.contains("<?xml"));
    EXPECT_TRUE(page.contains("<td>volume</td>"));
    EXPECT_EQ(page.contains(">original</text>"), !original.points.empty());
  }
}

TEST(ReportFile, OfDescriptorsNamesTheLayersInItsFigures) {
  // Measured is nothing here: the figures show the meshes.
  const CheckedMesh checked = check_mesh(grain(), MeshCheckOptions(), Execution());
  GrainMeasures result;
  result.grain = {"remeshed.ply", checked, DetailedDescriptors()};
  QTemporaryDir folder;
  const QString path = folder.filePath("shape.html");
  for (const bool compared : {false, true}) {
    if (compared) result.reference = {"<b>scan</b>", checked, DetailedDescriptors()};
    filter::write_report(result, path.toStdString());
    const QString page = QString::fromStdString(content_of(path));
    EXPECT_EQ(page.count("<svg"), 2);
    EXPECT_TRUE(page.contains(">remeshed.ply</text>"));
    EXPECT_EQ(page.contains(">&lt;b&gt;scan&lt;/b&gt;</text>"), compared);
  }
}

}  // namespace
}  // namespace wscvt::host_test
