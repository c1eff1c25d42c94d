// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the program: what their helps promise, and that each does what the library does.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "grains/bent_grain.h"
#include "program_run.h"
#include "support/coded_bytes.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/made_volume.h"
#include "support/test_shapes.h"
#include "toolbox/resolution/mesh_voxels.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/report/report.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::holds;

class Commands : public test::ProgramRun {
 protected:
  void SetUp() override {
    ProgramRun::SetUp();
    write_mesh(test::transformed(test::sphere(3), Vector3(1.0, 0.8, 0.7).asDiagonal()),
               path("scan.ply"));
  }
  /// As the help names them.
  std::vector<std::string> commands() const {
    const std::string help = run("--help").output;
    std::vector<std::string> names;
    std::istringstream lines(help.substr(std::min(help.find("\nCommands:\n"), help.size())));
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    while (std::getline(lines, line) && !line.empty()) {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    EXPECT_GE(names.size(), 9U) << help;
    return names;
  }
  /// Of a report in JSON; `arguments` writes report.json.
  Json report_of(const std::string& arguments) const {
    const Outcome outcome = run(arguments + " -q --report report.json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return outcome.exit_code == 0 ? Json::parse(content("report.json")) : Json();
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(Commands, RemeshAndBatchCarryColoursAndLabelsInPly) {
  const IndexedMesh scan = read_mesh(path("scan.ply"));
  MeshAttributes own;
  own.of_vertices = {{"red", ScalarType::Uint8, {}}};
  own.of_faces = {{"label", ScalarType::Int32, {}}};
  for (const Vector3& p : scan.points) own.of_vertices[0].values.push_back(128.0 + 90.0 * p.y());
  for (const Triangle& t : scan.triangles) {
    own.of_faces[0].values.push_back(scan.points[t[0]].x() > 0.0 ? 41.0 : 7.0);
  }
  fs::create_directory(path("scans"));
  write_mesh(scan, own, path("scans/coloured.ply"));
  // A frame turns the remesh after it took its colours.
  ASSERT_EQ(run("remesh scans/coloured.ply remesh.ply -n 200 -q").exit_code, 0);
  ASSERT_EQ(run("remesh scans/coloured.ply turned.ply -n 200 -q --frame principal").exit_code, 0);
  ASSERT_EQ(run("batch scans -o out -n 200 -q").exit_code, 0);
  const MeshFile remesh = read_mesh_file(path("remesh.ply"));
  ASSERT_EQ(remesh.attributes.of_vertices.size(), 1U);
  ASSERT_EQ(remesh.attributes.of_faces.size(), 1U);
  for (std::size_t i = 0; i < remesh.mesh.points.size(); ++i) {
    // Rounded once in each file; the nearest point lies within the misfit, some hundredths.
    EXPECT_NEAR(remesh.attributes.of_vertices[0].values[i],
                128.0 + 90.0 * remesh.mesh.points[i].y(), 1.0 + 90.0 * 0.05);
  }
  for (std::size_t t = 0; t < remesh.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = remesh.mesh.triangles[t];
    const auto& p = remesh.mesh.points;
    const double x = (p[a] + p[b] + p[c]).x() / 3.0;
    // A vertex of a scan's face is within its edge, .15.
    if (std::abs(x) < 0.2) continue;
    EXPECT_EQ(remesh.attributes.of_faces[0].values[t], x > 0.0 ? 41.0 : 7.0);
  }
  for (const char* same : {"turned.ply", "out/coloured.ply"}) {
    const MeshFile other = read_mesh_file(path(same));
    ASSERT_EQ(other.attributes.of_vertices.size(), 1U) << same;
    EXPECT_EQ(other.attributes.of_vertices[0].values, remesh.attributes.of_vertices[0].values);
    EXPECT_EQ(other.attributes.of_faces[0].values, remesh.attributes.of_faces[0].values);
  }
}

TEST_F(Commands, RemeshAndBatchTakeColoursFromThePictureOfAnObj) {
  const IndexedMesh scan = read_mesh(path("scan.ply"));
  std::ostringstream obj;
  obj << "mtllib stone.mtl\nusemtl stone\n";
  for (const Vector3& p : scan.points) {
    obj << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << "\nvt " << 0.5 + 0.21 * p.x() << ' '
        << 0.5 + 0.17 * p.y() << '\n';
  }
  for (const auto& [a, b, c] : scan.triangles) {
    obj << "f " << a + 1 << '/' << a + 1 << ' ' << b + 1 << '/' << b + 1 << ' ' << c + 1 << '/'
        << c + 1 << '\n';
  }
  std::vector<std::uint8_t> colours;
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 60; ++column) {
      colours.push_back(static_cast<std::uint8_t>(3 + 4 * column));
      colours.push_back(static_cast<std::uint8_t>(5 * row));
      colours.push_back(static_cast<std::uint8_t>(row + 2 * column));
    }
  }
  fs::create_directory(path("scans"));
  std::ofstream(folder_ / "scans/stone.obj") << obj.str();
  std::ofstream(folder_ / "scans/stone.mtl") << "newmtl stone\nmap_Kd stone.tga\n";
  const Outcome missing = run("remesh scans/stone.obj plain.ply -n 200");
  EXPECT_EQ(missing.exit_code, 0);
  EXPECT_TRUE(read_mesh_file(path("plain.ply")).attributes.empty());
  std::ofstream(folder_ / "scans/stone.tga", std::ios::binary)
      << test::tga_picture(60, 48, colours);
  const Outcome done = run("remesh scans/stone.obj remesh.ply -n 200");
  if (done.errors.find("libstb-dev") != std::string::npos) GTEST_SKIP();
  EXPECT_TRUE(holds(missing.errors, "stone.tga"));
  EXPECT_FALSE(holds(done.errors, "stone.tga"));
  ASSERT_EQ(run("batch scans -o out -n 200 -q").exit_code, 0);
  for (const char* name : {"remesh.ply", "out/stone.ply"}) {
    const MeshFile remesh = read_mesh_file(path(name));
    ASSERT_EQ(remesh.attributes.of_vertices.size(), 3U) << name;
    for (std::size_t i = 0; i < remesh.mesh.points.size(); ++i) {
      const Vector3& p = remesh.mesh.points[i];
      const double column = 60.0 * (0.5 + 0.21 * p.x()) - 0.5;
      const double row = 48.0 * (0.5 - 0.17 * p.y()) - 0.5;
      // The nearest point lies within the misfit, some hundredths.
      const std::array<double, 3> expected = {3.0 + 4.0 * column, 5.0 * row, row + 2.0 * column};
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(remesh.attributes.of_vertices[k].values[i], expected[k], 3.0) << name;
      }
    }
  }
}

TEST_F(Commands, HelpOfEachFitsOnAScreenWithExamplesAndExitCodes) {
  std::vector<std::string> all = commands();
  all.emplace_back("");
  for (const std::string& command : all) {
    SCOPED_TRACE(command);
    const Outcome help = run(command + " --help");
    EXPECT_EQ(help.exit_code, 0);
    const std::vector<std::string> lines = lines_of(help.output);
    EXPECT_LE(lines.size(), 45U) << help.output;
    for (const std::string& line : lines) EXPECT_LE(line.size(), 100U) << line;
    EXPECT_TRUE(holds(help.output, "Exit codes: 0 done"));
    const auto examples = std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.rfind("  wscvt " + command, 0) == 0;
    });
    EXPECT_GE(examples, 2);
    EXPECT_FALSE(holds(help.output, "x)\n")) << "a word of the parser";
  }
}

// A stranger has to learn all of them.
TEST_F(Commands, AreFewAndHaveFewOptions) {
  EXPECT_LE(commands().size(), 11U);
  std::set<std::string> options;
  for (const std::string& command : commands()) {
    for (const std::string& line : lines_of(run(command + " --help-all").output)) {
      std::smatch found;
      if (std::regex_search(line, found, std::regex("^  (-[a-z],)?--([a-z-]+)"))) {
        options.insert(found[2]);
      }
    }
  }
  options.erase("help");
  options.erase("help-all");
  EXPECT_GT(options.size(), 50U);
  EXPECT_LE(options.size(), 60U);
}

TEST_F(Commands, EachHasAManualPageOfItsHelp) {
  ASSERT_EQ(run("--man-pages pages").exit_code, 0);
  for (const std::string& command : commands()) {
    SCOPED_TRACE(command);
    const std::string page = content("pages/wscvt-" + command + ".1");
    ASSERT_EQ(page.rfind(".TH \"WSCVT", 0), 0U);
    for (const char* part : {"SYNOPSIS", "OPTIONS", "EXAMPLES", "EXIT STATUS"}) {
      EXPECT_TRUE(holds(page, ".SH \"" + std::string(part) + "\"\n")) << part;
    }
    // Every call of the examples is a line that is kept as it is.
    for (const std::string& line : lines_of(run(command + " --help").output)) {
      if (line.rfind("  wscvt ", 0) != 0) continue;
      const std::string call = std::regex_replace(line, std::regex("-"), "\\-");
      EXPECT_TRUE(holds(page, "\n" + call + "\n")) << call;
    }
  }
  const std::string page = content("pages/wscvt-remesh.1");
  EXPECT_TRUE(holds(page, "\\-w,\\-\\-weighting"));
  EXPECT_TRUE(holds(page, ".RS\n.TP\n\\fBwscvt\\-c\\fR\n"));
  EXPECT_TRUE(holds(page, " Default: 1.1 (on\\-scan)\n"));
  EXPECT_TRUE(holds(content("pages/wscvt.1"), "\\fBwscvt\\-remesh\\fR(1)"));
  EXPECT_EQ(run("--man-pages /proc/none").exit_code, 1);
}

TEST_F(Commands, AnOutputIsTheLastWordOrNamed) {
  ASSERT_EQ(run("scan.ply one.ply -q -n 40").exit_code, 0);
  ASSERT_EQ(run("-o two.ply -n 40 -q scan.ply").exit_code, 0);
  EXPECT_FALSE(content("one.ply").empty());
  EXPECT_EQ(content("two.ply"), content("one.ply"));
  EXPECT_EQ(run("create ellipsoid -o made.ply -q -n 40").exit_code, 0);
  EXPECT_TRUE(exists("made.ply"));
  EXPECT_EQ(run("extract scan.ply -o bodies -q").exit_code, 0);
  EXPECT_TRUE(exists("bodies/1.ply"));
  // All take -o, except the one that only writes reports.
  for (const std::string& command : commands()) {
    EXPECT_EQ(run(command + " --help").output.find("-o,--output") != std::string::npos,
              command != "sample")
        << command;
  }
}

TEST_F(Commands, EndWithTheCodesOfTheirHelps) {
  EXPECT_EQ(run("scan.ply one.ply -q -n 40").exit_code, 0);
  EXPECT_EQ(run("none.ply one.ply").exit_code, 1);
  EXPECT_EQ(run("scan.ply one.ply -n 3").exit_code, 2);
  std::ofstream(folder_ / "torn.ply") << "ply\n";
  EXPECT_EQ(run("batch scan.ply torn.ply -o out -q -n 40").exit_code, 3);
  test::MadeVolume volume({30, 20, 20});
  volume.fill_ball(1, {8, 10, 10}, 6.0);
  volume.fill_ball(1, {22, 10, 10}, 5.0);
  test::write_bytes(folder_ / "pieces.nrrd", test::nrrd(volume, "spacings: 1 1 1\n"));
  EXPECT_EQ(run("extract pieces.nrrd grains -q").exit_code, 3);
  for (const auto& [command, may_be_three] :
       std::vector<std::pair<std::string, bool>>{{"batch", true},
                                                 {"clump", true},
                                                 {"extract", true},
                                                 {"remesh", false},
                                                 {"describe", false},
                                                 {"create", false}}) {
    EXPECT_EQ(run(command + " --help").output.find("; 3 done, but some") != std::string::npos,
              may_be_three)
        << command;
  }
}

TEST_F(Commands, ExamplesOfTheHelpsWork) {
  ASSERT_EQ(run("scan.ply first.ply -q -n 100 -d 6 --coefficients grain.json").exit_code, 0);
  fs::create_directory(folder_ / "scans");
  for (const char* name : {"scans/a.ply", "scans/b.stl", "scans/c.ply"}) {
    write_mesh(read_mesh(path("scan.ply")), path(name));
  }
  std::ofstream(folder_ / "more.txt") << "first.ply\n";
  for (const char* name : {"grain.ply", "grain.stl", "remesh.ply", "sample.stl"}) {
    write_mesh(read_mesh(path("first.ply")), path(name));
  }
  test::MadeVolume volume({30, 30, 30});
  volume.fill_ball(1, {15, 15, 15}, 10.0);
  test::MadeVolume labels = volume;
  labels.fill_ball(2, {24, 24, 15}, 4.5);
  test::write_bytes(folder_ / "labels.nrrd", test::nrrd(labels, "spacings: 1 1 1\n"));
  test::write_bytes(folder_ / "labels.tif", test::tiff(labels, 0, 30));
  for (std::uint32_t& value : labels.labels) value = value == 0 ? 0 : 1;
  test::write_bytes(folder_ / "scan.tif", test::tiff(labels, 0, 30));
  test::write_bytes(folder_ / "mask.tif", test::tiff(volume, 0, 30));
  fs::create_directory(folder_ / "slices");
  for (int z = 0; z < 30; ++z) {
    test::write_bytes(folder_ / "slices" / (std::to_string(z) + ".tif"), test::tiff(volume, z, 1));
  }
  std::ofstream(folder_ / "clump.csv") << "x,y,z,r\n0,0,0,1\n0.9,0.3,0.2,0.7\n";
  std::ofstream(folder_ / "sieve.csv") << "1,0\n2,100\n";
  std::ofstream(folder_ / "supplier.csv") << "grain,feret_min,convexity\na,2,0.9\nb,3,0.8\n";
  for (const std::string& command : commands()) {
    // It takes a sample of hundreds of grains: templates_test.cpp and grow_test.cpp run it on less.
    if (command == "grow") continue;
    for (const std::string& line : lines_of(run(command + " --help").output)) {
      const std::string program = "  wscvt ";
      if (line.rfind(program, 0) != 0) continue;
      SCOPED_TRACE(line);
      const Outcome outcome = run(line.substr(program.size()));
      EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    }
  }
  for (const char* made : {"remesh.html", "table.csv", "grain.html", "grains.csv", "rod.stl"}) {
    EXPECT_TRUE(exists(made)) << made;
  }
}

TEST_F(Commands, RemeshIsWhatACallWithoutOneMeans) {
  ASSERT_EQ(run("scan.ply old.ply -q -n 60").exit_code, 0);
  ASSERT_EQ(run("-n 60 scan.ply first.ply -q").exit_code, 0);
  ASSERT_EQ(run("remesh scan.ply new.ply -q -n 60").exit_code, 0);
  EXPECT_FALSE(content("new.ply").empty());
  EXPECT_EQ(content("new.ply"), content("old.ply"));
  EXPECT_EQ(content("new.ply"), content("first.ply"));
}

TEST_F(Commands, ReportsTheIntersectionsOfTheFile) {
  // A plate thinner than a float's step where it lies, .0039.
  const Vector3 far = Vector3::Constant(std::ldexp(1.0, 15));
  write_mesh(test::transformed(test::subdivided(test::box(2.0, 1.7, 0.0008), 5),
                               test::random_rotation(4), far),
             path("far.ply"));
  IndexedMesh written;
  const auto expect_told = [&](const std::string& file, const std::string& arguments) {
    const std::size_t pairs = report_of("far.ply " + file + arguments + " -n 300")
                                  .at("on_scan")
                                  .at("self_intersections")
                                  .get<std::size_t>();
    const IndexedMesh read = read_mesh(path(file));
    if (written.points.empty()) written = read;
    // STL has each corner for itself: the triangles of the first file at the corners of this one.
    for (std::size_t f = 0; f < written.triangles.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        written.points[index(written.triangles[f][k])] = read.points[index(read.triangles[f][k])];
      }
    }
    EXPECT_EQ(self_intersections(written).size(), pairs) << file;
    return pairs;
  };
  const std::size_t kept = expect_told("remesh.ply", "");
  const std::size_t rounded = expect_told("remesh.stl", "");
  EXPECT_GT(rounded, kept);
  EXPECT_LT(expect_told("near.stl", " --frame centred --scale 1000"), rounded);
  fs::create_directory(folder_ / "far");
  fs::rename(folder_ / "far.ply", folder_ / "far" / "far.ply");
  ASSERT_EQ(run("batch far -o out -q -n 300 --format stl").exit_code, 0);
  EXPECT_TRUE(holds(content("out/grains.csv"), std::to_string(rounded) + " pairs of triangles"));
}

TEST_F(Commands, AMisspeltOneIsNamedWithTheChoices) {
  const Outcome outcome = run("remehs scan.ply new.ply");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(holds(outcome.errors, "\"remehs\". Give remesh, "));
  EXPECT_EQ(run("").exit_code, 2);
  for (const std::string& command : commands()) {
    SCOPED_TRACE(command);
    EXPECT_EQ(run(command).exit_code, 2);
    const Outcome unknown = run(command + " scan.ply scan.ply --nodse 5");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_EQ(unknown.output, "");
  }
  EXPECT_FALSE(exists("new.ply"));
}

TEST_F(Commands, DescribeMeasuresAsTheLibraryDoes) {
  const Json report = report_of("describe scan.ply --report table.csv --report page.html");
  DetailedOptions options;
  const NamedMesh grain = {"scan.ply", read_mesh(path("scan.ply"))};
  const GrainMeasures measures = measure_grain(grain, {}, options, Execution());
  Json expected = Json::parse(descriptor_json(measures, {"scan.ply", ""}));
  Json made = report;
  expected.erase("date");
  made.erase("date");
  EXPECT_EQ(made, expected);
  EXPECT_EQ(test::csv_records(content("table.csv")).size(), 2U);
  EXPECT_TRUE(holds(content("page.html"), "<svg"));

  const Outcome loud = run("describe scan.ply --roundness-ball 0.4 --roughness-cutoff 0.9 -v");
  EXPECT_EQ(loud.exit_code, 0) << loud.errors;
  options.roundness_ball = 0.4;
  options.roughness_cutoff = 0.9;
  std::string text;
  for (const std::string& line : descriptor_lines(measure_grain(grain, {}, options, Execution()))) {
    text += line + "\n";
  }
  EXPECT_EQ(loud.output.substr(0, loud.output.find("Time ")), text);
  const Outcome refused = run("describe scan.ply --roundness-ball 0");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(holds(refused.errors, "ball of roundness"));
}

TEST_F(Commands, DescribeWarnsOfWhatItsLogHas) {
  write_mesh(test::bent_grain_mesh(test::bent_grain("hook"), 2500), path("hook.ply"));
  for (const std::string call : {"describe hook.ply", "describe hook.ply scan.ply"}) {
    const Outcome brief = run(call);
    EXPECT_EQ(brief.exit_code, 0) << brief.errors;
    EXPECT_FALSE(holds(brief.output + brief.errors, "Sdq")) << brief.errors;
    const Outcome whole = run(call + " -v");
    EXPECT_TRUE(holds(whole.output, "Sdq"));
    EXPECT_TRUE(holds(whole.errors, "Sdq")) << whole.errors;
  }
}

TEST_F(Commands, DescribeTellsWhatTheVoxelsDidIfTheirSizeIsGiven) {
  const IndexedMesh scan = read_mesh(path("scan.ply"));
  const double edge =
      describe_shape_in_detail(scan, DetailedOptions(), Execution()).equivalent_diameter / 25.0;
  const std::string size = format_exact(edge);
  write_mesh(surface_of_voxels(mesh_voxels(scan, edge, {}), 20, edge), path("voxels.ply"));
  const Json plain = report_of("describe voxels.ply");
  const Json report = report_of("describe voxels.ply --voxel-size " + size +
                                " --report table.csv --report page.html");
  EXPECT_FALSE(plain.contains("resolution"));
  EXPECT_EQ(report["descriptors"], plain["descriptors"]);
  const Json& resolution = report["resolution"];
  EXPECT_NEAR(resolution["voxels_across"].get<double>(), 25.0, 0.2);
  const Json& area = resolution["area"];
  EXPECT_LT(area["low"].get<double>(), area["corrected"].get<double>());
  EXPECT_LT(area["corrected"].get<double>(), area["high"].get<double>());
  EXPECT_NE(area["corrected"], report["descriptors"]["area"]);
  EXPECT_TRUE(resolution["sq"]["corrected"].is_null());
  EXPECT_EQ(run("describe voxels.ply -q --voxel-size " + size + " --report table.csv").exit_code,
            0);
  const auto records = test::csv_records(content("table.csv"));
  ASSERT_EQ(records.size(), 3U);  // a second row fits below the first
  EXPECT_EQ(records[1], records[2]);
  EXPECT_EQ(run("describe voxels.ply -q --report table.csv").exit_code, 2);  // other columns
  EXPECT_TRUE(holds(content("page.html"), "<th>corrected</th>"));
  const Outcome loud = run("describe voxels.ply --voxel-size " + size);
  EXPECT_TRUE(holds(loud.output, "25 voxels across"));
  EXPECT_TRUE(holds(loud.output, "Not resolved: Sq."));
  EXPECT_EQ(run("describe voxels.ply --voxel-size 0").exit_code, 2);
  const Outcome other = run("describe scan.ply --voxel-size " + size);
  EXPECT_TRUE(holds(other.output, "Nothing is resolved: the mesh does not show"));
}

TEST_F(Commands, DescribeMeasuresAgainstTheReference) {
  ASSERT_EQ(run("scan.ply remesh.ply -q -n 60").exit_code, 0);
  const Json report = report_of("describe remesh.ply scan.ply --report table.csv");
  const GrainMeasures measures = measure_grain({"remesh.ply", read_mesh(path("remesh.ply"))},
                                               NamedMesh{"scan.ply", read_mesh(path("scan.ply"))},
                                               DetailedOptions(), Execution());
  Json expected = Json::parse(descriptor_json(measures, {"remesh.ply", ""}));
  Json made = report;
  expected.erase("date");
  made.erase("date");
  EXPECT_EQ(made, expected);
  EXPECT_GT(measures.distances->largest, 0.0);
  // A table of grains without a reference has other columns, and no input is written over.
  ASSERT_EQ(run("describe scan.ply -q --report single.csv").exit_code, 0);
  EXPECT_EQ(run("describe remesh.ply scan.ply --report single.csv").exit_code, 2);
  fs::create_symlink("scan.ply", folder_ / "link.json");
  const Outcome over = run("describe remesh.ply scan.ply --report link.json");
  EXPECT_EQ(over.exit_code, 2);
  EXPECT_TRUE(holds(over.errors, "the reference itself"));
}

TEST_F(Commands, CreateMakesTheSurfaceOfItsFormula) {
  const Json ellipsoid =
      report_of("create ellipsoid grain.ply --semi-axes 1 0.8 0.6 -n 200 -p fitted --report t.csv");
  const Json& volume = ellipsoid.at("descriptors").at("volume");
  EXPECT_NEAR(volume.at("scan").get<double>(), 4.0 / 3.0 * pi * 0.48, 1e-9);
  EXPECT_NEAR(volume.at("remesh").get<double>(), 4.0 / 3.0 * pi * 0.48, 1e-9);
  EXPECT_EQ(ellipsoid.at("source"), "Ellipsoid");
  // On the surface unless told otherwise.
  ASSERT_EQ(run("create ellipsoid on.off --semi-axes 1 0.8 0.6 -n 200 -q").exit_code, 0);
  const IndexedMesh on = read_mesh(path("on.off"));
  ASSERT_EQ(on.points.size(), 200U);
  for (const Vector3& p : on.points) {
    EXPECT_NEAR(p.cwiseQuotient(Vector3(1.0, 0.8, 0.6)).norm(), 1.0, 1e-12);
  }
  const auto volume_of = [&](const std::string& arguments) {
    return report_of("create " + arguments + " any.ply -n 100")
        .at("descriptors")
        .at("volume")
        .at("scan")
        .get<double>();
  };
  const double block = volume_of("superellipsoid --semi-axes 1 1 1 --exponents 0.3 0.3");
  EXPECT_GT(block, 6.0);
  // By Barr's formula, 2 a b c e n B(e / 2 + 1, e) B(n / 2, n / 2) with the exponents e and n.
  const auto exact = [](double polar, double azimuthal) {
    const auto beta = [](double a, double b) {
      return std::tgamma(a) * std::tgamma(b) / std::tgamma(a + b);
    };
    return 2.0 * polar * azimuthal * beta(0.5 * polar + 1.0, polar) *
           beta(0.5 * azimuthal, 0.5 * azimuthal);
  };
  EXPECT_NEAR(block, exact(0.3, 0.3), 2e-3);
  EXPECT_NEAR(volume_of("superellipsoid --exponents 0.5 1"), exact(0.5, 1.0), 2e-3);
  EXPECT_NEAR(volume_of("superellipsoid --exponents 1 0.5"), exact(1.0, 0.5), 2e-3);
  EXPECT_NEAR(volume_of("superellipsoid --semi-axes 2 2 2"), 8.0 * 4.0 / 3.0 * pi, 1e-6);
}

TEST_F(Commands, CreateReadsCoefficientsOfSeriesAndMaps) {
  ASSERT_EQ(run("scan.ply remesh.ply -q -n 60 -d 6 --coefficients series.json").exit_code, 0);
  // A grain that rays from its centroid do not see whole has a map.
  const IndexedMesh hook = test::bent_grain_mesh(test::bent_grain("hook"), 2500);
  write_mesh(hook, path("hook.ply"));
  ASSERT_EQ(run("hook.ply remesh.ply -q -n 60 --coefficients map.json").exit_code, 0);
  // The same series for SHTOOLS, which has none of x, y and z.
  ASSERT_EQ(run("scan.ply remesh.ply -q -n 60 -d 6 --coefficients series.sh").exit_code, 0);
  EXPECT_EQ(run("hook.ply remesh.ply -q -n 60 --coefficients map.sh").exit_code, 1);
  const auto created = [&](const std::string& file) {
    EXPECT_EQ(run("create " + file + " grain.ply -q -n 150").exit_code, 0);
    return describe_shape(read_mesh(path("grain.ply")), Execution(1)).volume;
  };
  EXPECT_NEAR(created("series.sh") / created("series.json"), 1.0, 1e-12);
  const double volume_of_hook = describe_shape(hook, Execution(1)).volume;
  for (const auto& [file, volume] :
       {std::make_pair(std::string("series.json"), 4.0 / 3.0 * pi * 0.56),
        std::make_pair(std::string("map.json"), volume_of_hook)}) {
    const Json report = report_of("create " + file + " grain.ply -n 150");
    EXPECT_EQ(read_mesh(path("grain.ply")).points.size(), 150U);
    EXPECT_NEAR(report.at("descriptors").at("volume").at("scan").get<double>() / volume, 1.0, 0.05);
    EXPECT_EQ(report.at("source"), file.substr(0, file.find('.')));
  }
  {
    std::ofstream text(folder_ / "text.dat");
    text << "0 0 10.0 0.0\n1 0 0.1 0\n1 1 0 0\n1 -1 0 0\n2 0 0.5 0\n2 1 0 0\n2 2 0 0\n";
  }
  const Json all = report_of("create text.dat grain.ply -n 60");
  const Json cut = report_of("create text.dat grain.ply -n 60 --degree 0");
  EXPECT_NE(all.at("descriptors").at("area"), cut.at("descriptors").at("area"));
}

TEST_F(Commands, CreateRefusesWhatIsNoSurface) {
  expect_refused("create",
                 {{"cube grain.ply", 2, "ellipsoid, superellipsoid, or a file"},
                  {"ellipsoid grain.ply --semi-axes 1 0 1", 2, "semi-axis is \"0\""},
                  {"ellipsoid grain.ply --semi-axes 1 1", 2, "--semi-axes"},
                  {"superellipsoid grain.ply --exponents 3 1", 2, "from 0.1 to 2"},
                  {"ellipsoid grain.ply --points", 2, "--points"},
                  {"harmonics grain.ply", 2, ".dat, .sh or .json"},
                  {"no.json grain.ply", 1, "no.json"},
                  {"no.txt grain.ply", 2, ".dat, .sh or .json"},
                  {"ellipsoid grain.xyz", 2, ".ply"}},
                 {"grain.ply"});
}

}  // namespace
}  // namespace wscvt
