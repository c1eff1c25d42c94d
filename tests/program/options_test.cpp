// SPDX-License-Identifier: GPL-3.0-or-later
// Every option of the program: it reaches the remesh, refuses what it must, and takes back what a
// report prints.
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "program_run.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/report/remesh_options.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt {
namespace {

using Json = nlohmann::ordered_json;

/// An option of a remesh: a value other than the default, and one that is refused with words in the
/// sentence. What else the value needs to be accepted stands in `with`.
struct OptionCase {
  std::string key;
  Json value;
  std::string refused;
  std::string words;
  std::string with = {};
};

const std::vector<OptionCase>& option_cases() {
  static const std::vector<OptionCase> cases = {
      {"nodes", 61, "3", "from 4 to 1000000"},
      {"method", "as-published", "paper", "on-scan or as-published"},
      {"target", 30.0, "-1", "from 0 to 100"},
      {"target-measure", "area", "4", "inertia"},
      {"largest", 500, "3", "from 4 to"},
      {"sampling", "fibonacci", "Fibonacci", "equal-angle"},
      {"weighting", "constant", "1", "radial-distance"},
      {"alpha", -0.5, "3.5", "from -3 to 3"},
      {"curvature-source", "quadrics", "scan", "series or quadrics"},
      {"adaptive-exponent", 0.25, "1.6", "from 0 to 1.5"},
      {"degree", 4, "61", "from 0 to 60"},
      {"fold-limit", 1.5, "100", "from 0 to 99"},
      {"points", true, "perhaps", "points"},
      {"envelope", 25.0, "51", "from 0 to 50"},
      {"parametrization", "radial", "cubic", "auto, radial or spherical"},
      {"contact-radius", 1.2, "0", "above 0 and 100"},
      {"refuse-self-intersections", true, "perhaps", "refuse-self-intersections"},
      {"metric", "sphere", "plane", "sphere or surface"},
      {"placement", "scan", "fitted", "series, scan, least-squares or contact"},
      {"refine", 1, "1001", "from 0 to 1000"},
      {"refine-angle", 20.0, "41", "from 0 to 40"},
      {"refine-tolerance", 0.01, "1", "from 0 to below 1"},
      {"seed-start", "random", "2", "warped-lattice"},
      {"seed", 18446744073709551615U, "-1", "0 or more"},
      {"iterations", 3, "-1", "from 0 to 100000"},
      {"tolerance", 0.01, "0", "above 0"},
      {"area-tolerance", 0.5, "nan", "above 0"},
      {"acceleration", false, "perhaps", "acceleration"},
      {"over-relaxation", 1.1, "2", "above 0 and below 2"},
      {"coarsest-seeds", 30, "3", "4 to 1000000"},
      {"coarsest-tolerance", 0.001, "0", "above 0"},
      {"middle-tolerance", 0.002, "-1", "above 0"},
      {"distances", true, "perhaps", "distances"},
      {"advice", false, "perhaps", "advice"},
      {"distance-samples", 500, "0", "from 1 to 100000000"},
      {"weld-tolerance", 1e-9, "0.02", "from 0 to 0.01"},
      {"mend-limit", 12.5, "101", "from 0 to 100"},
      {"dropped-volume", 0.5, "1", "above 0 and below 1"},
      {"handle-length", 0.25, "-1", "0 or more"},
      {"handles", 7, "-1", "from 0 to 1000000"},
  };
  return cases;
}

class ProgramOptions : public test::ProgramRun {
 protected:
  void SetUp() override {
    ProgramRun::SetUp();
    write_mesh(test::transformed(test::sphere(3), Vector3(1.0, 0.8, 0.7).asDiagonal()),
               path("scan.ply"));
  }

  static std::string typed(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  }
  /// Of what is given twice the later counts.
  Json report_of(const std::string& arguments) const {
    const Outcome outcome =
        run("scan.ply remesh.ply -q -n 60 -d 6 --report report.json " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return outcome.exit_code == 0 ? Json::parse(content("report.json")) : Json();
  }
};

TEST_F(ProgramOptions, AllOfTheHelpAreTestedHere) {
  std::set<std::string> tested = {
      "help",        "help-all",        "threads",     "coefficients", "overwrite",
      "quiet",       "no-acceleration", "no-advice",   "report",       "node-table",
      "sdf",         "frame",           "size",        "scale",        "input-unit",
      "output-unit", "sdf-surface",     "sdf-spacing", "sdf-margin"};
  for (const OptionCase& one : option_cases()) tested.insert(one.key);
  const Outcome help = run("remesh --help-all");
  EXPECT_EQ(help.exit_code, 0);
  std::set<std::string> in_help;
  std::istringstream lines(help.output);
  const std::regex name("--([a-z-]+)");
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  -", 0) != 0) continue;
    const std::string names = line.substr(0, line.find(' ', 2));
    for (std::sregex_iterator found(names.begin(), names.end(), name), end; found != end; ++found) {
      in_help.insert((*found)[1]);
    }
  }
  EXPECT_EQ(in_help, tested);
}

TEST_F(ProgramOptions, ReachTheRemeshUnderTheirNames) {
  const Json defaults = report_of("").at("options");
  ASSERT_EQ(defaults.size(), option_cases().size());
  for (const OptionCase& one : option_cases()) {
    SCOPED_TRACE(one.key);
    ASSERT_NE(defaults.at(one.key), one.value) << "is the default already";
    const Json report = report_of(one.with + " --" + one.key + "=" + typed(one.value));
    ASSERT_TRUE(report.contains("options"));
    const Json& options = report.at("options");
    EXPECT_EQ(options.at(one.key), one.value);
    for (const auto& [key, value] : defaults.items()) {
      if (key == one.key || one.with.find(key) != std::string::npos) continue;
      // The published method decides on these.
      if (one.key == "method" &&
          (key == "parametrization" || key == "metric" || key == "placement"))
        continue;
      // Samplings that are not relaxed are cut into cells on the sphere.
      if (one.key == "sampling" && key == "metric") continue;
      // A search for an error target ends with a number of nodes of its own, and needs distances.
      if (one.key == "target" && (key == "nodes" || key == "distances" || key == "metric"))
        continue;
      EXPECT_EQ(options.at(key), value) << key;
    }
  }
}

TEST_F(ProgramOptions, RefuseWhatIsNotTheirsWithTheChoicesAndBeginNothing) {
  for (const OptionCase& one : option_cases()) {
    SCOPED_TRACE(one.key);
    const Outcome outcome = run("scan.ply remesh.ply --" + one.key + "=" + one.refused);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.errors.find(one.words), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    EXPECT_FALSE(exists("remesh.ply"));
  }
}

TEST_F(ProgramOptions, TakeBackWhatAReportPrints) {
  std::string unusual;
  for (const OptionCase& one : option_cases()) {
    // Those of a search, and of a placement that goes with no refinement.
    if (one.key == "target" || one.key == "placement" || one.key == "sampling") continue;
    unusual += " " + one.with + " --" + one.key + "=" + typed(one.value);
  }
  Json first = report_of(unusual);
  const std::string mesh = content("remesh.ply");
  ASSERT_FALSE(mesh.empty());
  std::string arguments;
  for (const auto& [key, value] : first.at("options").items()) {
    arguments += " --" + key + "=" + typed(value);
  }
  const Outcome again = run("scan.ply again.ply -q --report again.json" + arguments);
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(content("again.ply"), mesh);
  Json second = Json::parse(content("again.json"));
  for (Json* report : {&first, &second}) report->erase("date");  // midnight comes
  EXPECT_EQ(second, first);
}

TEST_F(ProgramOptions, HelpHasNoNumbersOfEnumerators) {
  const std::string help = run("remesh --help-all").output;
  EXPECT_EQ(help.find("->"), std::string::npos);
  const auto names_all = [&](const auto& rows) {
    for (const auto& row : rows) {
      EXPECT_NE(help.find("\n                              " + std::string(row.key) + ": "),
                std::string::npos)
          << row.key;
    }
  };
  names_all(enumerators<Weighting>());
  names_all(enumerators<NodePlacement>());
  names_all(enumerators<SeedStart>());
}

TEST_F(ProgramOptions, LettersStandForNames) {
  const Json report = report_of("-n 62 -w area -m surface -p least-squares -r 1 -d 5 -a 0.5 -i 7");
  const Json& options = report.at("options");
  EXPECT_EQ(options.at("nodes"), 62);
  EXPECT_EQ(options.at("weighting"), "area");
  EXPECT_EQ(options.at("metric"), "surface");
  EXPECT_EQ(options.at("placement"), "least-squares");
  EXPECT_EQ(options.at("refine"), 1);
  EXPECT_EQ(options.at("degree"), 5);
  EXPECT_EQ(options.at("alpha"), 0.5);
  EXPECT_EQ(options.at("iterations"), 7);
  EXPECT_EQ(report_of("-s icosahedron").at("options").at("sampling"), "icosahedron");
  EXPECT_EQ(report_of("--no-acceleration").at("options").at("acceleration"), false);
}

TEST_F(ProgramOptions, QuietThreadsAndCoefficientsDoAsTheySay) {
  const Outcome loud = run("scan.ply loud.ply -n 60 -d 6 -t 1");
  EXPECT_EQ(loud.exit_code, 0) << loud.errors;
  EXPECT_NE(loud.output.find("60 nodes"), std::string::npos);
  const Outcome quiet =
      run("scan.ply quiet.ply -n 60 -d 6 --quiet --threads=2 --coefficients=c.json");
  EXPECT_EQ(quiet.exit_code, 0) << quiet.errors;
  EXPECT_EQ(quiet.output, "");
  EXPECT_EQ(content("quiet.ply"), content("loud.ply"));
  EXPECT_EQ(Json::parse(content("c.json")).at("coefficients").size(), 7U * 7U);
  EXPECT_EQ(run("scan.ply bad.ply -t many").exit_code, 2);
  EXPECT_EQ(run("scan.ply bad.ply -t -1").exit_code, 2);
  EXPECT_FALSE(exists("bad.ply"));
}

TEST_F(ProgramOptions, FilesForASimulationLieInOneFrame) {
  // The scan has the axes 1, 0.8 and 0.7; as a remesh of volume 1 in its principal frame.
  const Outcome outcome =
      run("remesh scan.ply framed.ply -q -n 60 -d 6 --frame principal --size 2 --sdf-spacing 0.2 "
          "--sdf-margin 2 --sdf-surface remesh --node-table nodes.csv --node-table nodes.vtp "
          "--node-table grain.shp --sdf grid.npy --sdf grid.vti --sdf grid.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const ShapeDescriptors framed = describe_shape(read_mesh(path("framed.ply")), Execution(1));
  EXPECT_NEAR(framed.volume, 4.0 / 3.0 * test::pi, 1e-9);
  EXPECT_LT(framed.centroid.norm(), 0.02);
  const Json description = Json::parse(content("grid.npy.json"));
  EXPECT_EQ(description.at("spacing"), 0.2);
  EXPECT_EQ(description.at("surface"), "remesh");
  EXPECT_EQ(description.at("frame").at("name"), "principal");
  for (const char* name : {"nodes.csv", "nodes.vtp", "grain.shp", "grid.vti", "grid.json"}) {
    EXPECT_NE(content(name), "") << name;
  }
  // The same grain told in other units.
  ASSERT_EQ(run("remesh scan.ply mm.ply -q -n 60 -d 6 --input-unit m --output-unit mm").exit_code,
            0);
  ASSERT_EQ(run("remesh scan.ply plain.ply -q -n 60 -d 6").exit_code, 0);
  ASSERT_EQ(run("remesh scan.ply large.ply -q -n 60 -d 6 --scale 1000").exit_code, 0);
  EXPECT_EQ(content("mm.ply"), content("large.ply"));
  const Vector3 plain = read_mesh(path("plain.ply")).points[7];
  EXPECT_LT((read_mesh(path("mm.ply")).points[7] - 1000.0 * plain).norm(), 1e-9);
}

TEST_F(ProgramOptions, RefuseFilesForASimulationBeforeTheWork) {
  for (const char* wrong :
       {"--node-table nodes.txt", "--sdf grid.csv", "--node-table grain.shp", "--frame middle",
        "--scale 0", "--size -1", "--input-unit mile", "--sdf-margin 0", "--size 1 --scale 2",
        "--node-table a.csv --node-table a.csv", "--sdf a.npy --report a.npy.json"}) {
    SCOPED_TRACE(wrong);
    const Outcome outcome = run(std::string("remesh scan.ply bad.ply -n 60 ") + wrong);
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.errors, "");
    EXPECT_FALSE(exists("bad.ply"));
  }
}

}  // namespace
}  // namespace wscvt
