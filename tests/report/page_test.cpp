// SPDX-License-Identifier: GPL-3.0-or-later
// The report as a page, and its files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/page_tables.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/version.h"
#include "wscvt/remesh.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/html_document.h"
#include "wscvt/report/open_table.h"
#include "wscvt/report/report.h"

namespace wscvt {
namespace {

using test::count_of;
using test::holds;

TEST(HtmlDocument, WritesSignsOut) {
  HtmlDocument page("a < b & \"c\"");
  page.add_paragraph("<script>");
  page.add_rows({{"<th>"}, {"<td>"}});
  page.add_lines({"<pre>"});
  page.add_figures({{"<svg></svg>", "<caption>"}});
  const std::string text = page.text();
  EXPECT_TRUE(holds(text, "<title>a &lt; b &amp; &quot;c&quot;</title>"));
  for (const char* raw : {"<script>", "<caption>"}) {
    EXPECT_FALSE(holds(text, raw));
  }
  EXPECT_EQ(count_of(text, "<svg>"), 1U);
  EXPECT_EQ(count_of(text, "<div"), count_of(text, "</div>"));
}

TEST(Page, OfARemeshHasPicturesHistogramsOptionsAndTheSearch) {
  const IndexedMesh scan = test::transformed(test::sphere(4), Vector3(1.0, 0.8, 0.7).asDiagonal());
  RemeshOptions options;
  options.node_count = 100;
  options.degree = 6;
  options.measures.repaired_scan = true;
  const RemeshResult shown = remesh(scan, options, Execution(1));
  const std::string page = report_html(shown, {"<sand>.ply", "2026-11-21"}, Execution(1));
  EXPECT_TRUE(holds(page, "<title>Remesh of &lt;sand&gt;.ply with 100 nodes"));
  EXPECT_TRUE(holds(page, "Made from &lt;sand&gt;.ply by " + made_by() + " on 2026-11-21."));
  EXPECT_EQ(count_of(page, "<img"), 3U);
  EXPECT_EQ(count_of(page, "<svg"), 5U);  // four histograms and the scale of the colours
  EXPECT_EQ(count_of(page, "</figure>"), 7U);
  // One file: nothing is fetched, and no two parts have one name: the scale and the views' data.
  EXPECT_FALSE(holds(page, "http"));
  EXPECT_EQ(count_of(page, " id="), 2U);
  EXPECT_EQ(count_of(page, "\"place\":"), 3U);
  EXPECT_EQ(count_of(page, " data-view="), 3U);
  // Of two rules the later one counts.
  EXPECT_LT(page.rfind("color: #444"), page.find("prefers-color-scheme: dark"));
  EXPECT_FALSE(holds(page, ">nan"));
  EXPECT_FALSE(holds(page, "\"nan"));
  EXPECT_FALSE(holds(page, ">-0<"));
  EXPECT_TRUE(holds(page, "<td>--weighting=wscvt-d</td>"));
  EXPECT_TRUE(holds(page, "principal moments"));
  EXPECT_EQ(page, report_html(shown, {"<sand>.ply", "2026-11-21"}, Execution(2)));

  RemeshResult warned = shown;
  warned.warnings = {"The first of two sentences.", "The second of two sentences."};
  const std::string with_warnings = report_html(warned, {}, Execution(1));
  EXPECT_EQ(count_of(with_warnings, "The first of two sentences."), 1U);
  EXPECT_EQ(count_of(with_warnings, "The second of two sentences."), 1U);
  EXPECT_NE(with_warnings.find("Mass at unit density", with_warnings.find("<h2>Log")),
            std::string::npos)
      << "the log is cut";

  // Points alone are triangulated; of a formula there is nothing to compare with.
  RemeshOptions points = options;
  points.points = true;
  const RemeshResult cloud = remesh({scan.points, {}}, points, Execution(1));
  EXPECT_EQ(count_of(report_html(cloud, {}, Execution(1)), "<img"), 3U);
  RemeshResult without = shown;
  without.repaired_scan = {};
  const std::string alone = report_html(without, {}, Execution(1));
  EXPECT_EQ(count_of(alone, "<img"), 1U);
  EXPECT_EQ(count_of(alone, "<svg"), 3U);

  options.method = AsPublishedOptions();  // fitted nodes have no error of the volume
  options.target.percent = 3.0;
  options.target.measure = ErrorMeasure::Volume;
  const RemeshResult searched = remesh(scan, options, Execution(1));
  const std::string with_curve = report_html(searched, {}, Execution(1));
  EXPECT_EQ(count_of(with_curve, "<svg"), 6U);
  EXPECT_EQ(count_of(with_curve, "<circle"), searched.search->trials.size());
  std::vector<CurvePoint> points_of_curve;
  for (const NodeCountTrial& trial : searched.search->trials) {
    points_of_curve.push_back({static_cast<double>(trial.node_count), trial.error});
  }
  EXPECT_TRUE(holds(with_curve, logarithmic_figure("number of nodes", "volume error, %",
                                                   std::move(points_of_curve), 3.0)));

  for (const bool asked : {false, true}) {
    options.measures.distances = asked;
    RemeshResult result = searched;
    result.options = options;
    EXPECT_TRUE(holds(report_html(result, {}, Execution(1)),
                      asked ? "<td>--distances=true</td>" : "<td>--distances=false</td>"));
  }
}

TEST(Page, OfDescriptorsNamesTheGrains) {
  const CheckedMesh checked = check_mesh(test::sphere(3), MeshCheckOptions(), Execution(1));
  GrainMeasures measures;
  measures.grain = {"remesh.ply", checked, DetailedDescriptors()};
  const std::string alone = descriptor_html(measures, {"", "2026-11-21"}, Execution(1));
  EXPECT_EQ(count_of(alone, "<img"), 1U);
  EXPECT_EQ(count_of(alone, "<svg"), 3U);
  EXPECT_TRUE(holds(alone, "<title>Shape of remesh.ply<"));
  EXPECT_TRUE(holds(alone, "by " + made_by() + " on 2026-11-21."));
  measures.reference = {"<b>scan</b>", checked, DetailedDescriptors()};
  measures.distances.emplace();
  const std::string compared = descriptor_html(measures, {}, Execution(1));
  EXPECT_EQ(count_of(compared, "<img"), 3U);
  EXPECT_EQ(count_of(compared, "<svg"), 5U);
  EXPECT_TRUE(holds(compared, ">&lt;b&gt;scan&lt;/b&gt;</text>"));
  EXPECT_FALSE(holds(compared, "<b>"));
}

TEST(Reports, SayWhatTheyAreOfAndWhenTheyWereMade) {
  const ReportOrigin origin = {"scan.ply", "2026-11-21"};
  RemeshResult result;
  const auto json = nlohmann::json::parse(report_json(result, origin));
  EXPECT_EQ(json.at("source"), "scan.ply");
  EXPECT_EQ(json.at("date"), "2026-11-21");
  EXPECT_EQ(json.at("made_by"), std::string("wscvt ") + version());
  EXPECT_TRUE(nlohmann::json::parse(report_json(result)).at("date").is_null());
  EXPECT_EQ(nlohmann::json::parse(descriptor_json(GrainMeasures(), origin)).at("date"),
            "2026-11-21");
  EXPECT_EQ(origin_sentence(origin), "Made from scan.ply by " + made_by() + " on 2026-11-21.");
  EXPECT_EQ(origin_sentence({}), "Made by " + made_by() + ".");
}

class ReportFiles : public test::FileFolder {
 protected:
  std::string path(const std::string& name = "table.csv") const { return FileFolder::path(name); }
  std::string content(const std::string& name = "table.csv") const {
    return FileFolder::content(name);
  }
  void write(const std::string& text) const { file("table.csv", text); }
};

TEST_F(ReportFiles, TableGrowsByARowUnderItsHeader) {
  append_to_table(path(), "a,b\r\n1,2\r\n");
  append_to_table(path(), "a,b\r\n3,\"x\r\ny\"\r\n");
  append_to_table(path(), "a,b\r\n5,6\r\n");
  EXPECT_EQ(content(), "a,b\r\n1,2\r\n3,\"x\r\ny\"\r\n5,6\r\n");
  write("");
  append_to_table(path(), "a,b\r\n1,2\r\n");
  EXPECT_EQ(content(), "a,b\r\n1,2\r\n");
}

TEST_F(ReportFiles, TableSaysWhyItCannotBeWritten) {
  std::filesystem::create_directory(path("folder.csv"));
  std::filesystem::create_symlink(path("one.csv"), path("other.csv"));
  std::filesystem::create_symlink(path("other.csv"), path("one.csv"));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"folder.csv", "folder.csv\" is a folder"},
      {"not there/table.csv", "Check that the folder exists"},
      {"one.csv", "one.csv\" is a link to a missing file"}};
  for (const auto& [name, sentence] : cases) {
    const std::string table = path(name);
    for (const auto& call : {check_table, append_to_table}) {
      const std::string refusal =
          test::refusal(ErrorCode::InputOutput, [&] { call(table, "a,b\r\n3,4\r\n"); });
      EXPECT_TRUE(holds(refusal, sentence));
    }
  }
}

TEST_F(ReportFiles, TableRefusesAnotherHeaderAndLeavesTheFile) {
  for (const std::string other : {"a,c\r\n1,2\r\n", "a,b", "a,b\r\n1,2", "notes\n", "\n"}) {
    write(other);
    for (const auto& call : {check_table, append_to_table}) {
      try {
        call(path(), "a,b\r\n3,4\r\n");
        ADD_FAILURE() << "not refused: " << other;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_TRUE(holds(error.what(), "new file"));
      }
      EXPECT_EQ(content(), other);
    }
  }
  append_to_table(path("new.csv"), "a,b\r\n3,4\r\n");  // the advice
  EXPECT_EQ(content("new.csv"), "a,b\r\n3,4\r\n");
}

TEST_F(ReportFiles, ManyMayAppendToOneTable) {
  constexpr int writers = 8;
  constexpr int rows = 20;
  std::vector<std::thread> threads;
  for (int k = 0; k < writers; ++k) {
    threads.emplace_back([&] {
      for (int row = 0; row < rows; ++row) append_to_table(path(), "a,b\r\n3,4\r\n");
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(count_of(content(), "a,b\r\n"), 1U);
  EXPECT_EQ(count_of(content(), "3,4\r\n"), static_cast<std::size_t>(writers * rows));
  EXPECT_EQ(content().size(), 5U * (writers * rows + 1));
}

TEST_F(ReportFiles, FollowTheirEndings) {
  const IndexedMesh scan = test::sphere(3);
  RemeshOptions options;
  options.node_count = 50;
  options.degree = 2;
  options.measures.repaired_scan = true;
  const RemeshResult result = remesh(scan, options, Execution(1));
  const ReportOrigin origin = {"scan.ply", "2026-11-21"};
  for (const std::string name : {"r.html", "r.JSON", "r.csv"}) {
    EXPECT_EQ(shows_scan(path(name)), name == "r.html");
    check_remesh_report(path(name));
    write_report(path(name), result, origin, Execution(1));
  }
  EXPECT_EQ(content("r.html"), report_html(result, origin, Execution(1)));
  for (int time = 1; time <= 2; ++time) {
    if (time == 2) write_report(path("r.csv"), result, origin, Execution(1));
    EXPECT_EQ(content("r.JSON"), report_json(result, origin));
    EXPECT_EQ(count_of(content("r.csv"), "\r\n"), 1U + static_cast<std::size_t>(time));
  }
  // The rows of remeshes of any options stand in one table; those of descriptors in two others.
  EXPECT_ERROR(check_descriptor_report(path("r.csv"), false), InvalidInput);
  const CheckedMesh checked = check_mesh(scan, MeshCheckOptions(), Execution(1));
  GrainMeasures measures;
  measures.grain = {"a", checked, DetailedDescriptors()};
  for (const bool compared : {false, true}) {
    if (compared) {
      measures.reference = {"b", checked, DetailedDescriptors()};
      measures.distances.emplace();
    }
    const std::string name = compared ? "compared.csv" : "alone.csv";
    write_report(path(name), measures, origin, Execution(1));
    check_descriptor_report(path(name), compared);
    EXPECT_ERROR(check_descriptor_report(path(name), !compared), InvalidInput);
  }
  for (const std::string name : {"r.txt", "html", "r", ""}) {
    SCOPED_TRACE(name);
    EXPECT_ERROR(check_remesh_report(path(name)), InvalidInput);
  }
}

}  // namespace
}  // namespace wscvt
