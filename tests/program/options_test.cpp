// SPDX-License-Identifier: GPL-3.0-or-later
// Every option of the program: it reaches the remesh, refuses what it must, and takes back what a
// report prints.
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "program_run.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt {
namespace {

using Json = nlohmann::ordered_json;
using test::holds;

/// An option of a remesh: a value other than the default, and one that is refused with words in the
/// sentence. What else the value needs to be accepted stands in `with`.
struct OptionCase {
  std::string key;
  Json value;
  std::string refused;
  std::string words;
  std::string with = {};
};

constexpr const char* published = "--method=as-published";

const std::vector<OptionCase>& option_cases() {
  static const std::vector<OptionCase> cases = {
      {"nodes", 61, "3", "from 4 to 1000000"},
      {"method", "as-published", "paper", "on-scan or as-published"},
      {"max-error", 30.0, "-1", "from 0 to 100"},
      {"error-measure", "area", "4", "inertia"},
      {"sampling", "fibonacci", "fibonaci", "equal-angle", published},
      {"weighting", "wscvt-c", "error-adaptive", "wscvt-d with --edge-ratio 1.4"},
      {"alpha", -0.5, "3.5", "from -3 to 3"},
      {"degree", 5, "61", "from 0 to 60"},
      {"max-overhang", 1.5, "100", "from 0 to 99", published},
      {"points", true, "perhaps", "points"},
      {"shrink-wrap", 25.0, "51", "from 0 to 50"},
      {"contact-radius", 1.2, "0", "above 0 and at most 100"},
      {"placement", "on-surface", "off", "fitted, on-surface or contact-fit"},
      {"edge-ratio", 1.25, "1", "from 1.08 to 1.6"},
      {"distances", true, "perhaps", "distances"},
      {"max-repaired-area", 12.5, "101", "from 0 to 100"},
      {"max-handle-loop", 0.25, "-1", "0 or more"},
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
  std::set<std::string> tested = {"help",        "help-all", "threads",    "coefficients",
                                  "quiet",       "report",   "node-table", "sdf",
                                  "frame",       "verbose",  "size",       "scale",
                                  "sdf-spacing", "output",   "tetrahedra", "edge-length"};
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
  // A stranger reads all of them: 36 at most.
  EXPECT_LE(in_help.size(), 36U);
}

TEST_F(ProgramOptions, ReachTheRemeshUnderTheirNames) {
  const Json on_scan = report_of("").at("options");
  const Json as_published = report_of(published).at("options");
  ASSERT_EQ(on_scan.size(), option_cases().size() + 1);
  EXPECT_TRUE(on_scan.at("handles").is_null()) << "an option of the library";
  for (const OptionCase& one : option_cases()) {
    SCOPED_TRACE(one.key);
    const Json& defaults = one.with == published || one.key == "method" ? as_published : on_scan;
    if (one.key != "method") {
      ASSERT_NE(defaults.at(one.key), one.value) << "is the default already";
    }
    const Json report = report_of(one.with + " --" + one.key + "=" + typed(one.value));
    ASSERT_TRUE(report.contains("options"));
    const Json& options = report.at("options");
    EXPECT_EQ(options.at(one.key), one.value);
    for (const auto& [key, value] : defaults.items()) {
      // A search ends with a number of nodes of its own.
      if (key == one.key || (one.key == "max-error" && key == "nodes")) continue;
      EXPECT_EQ(options.at(key), value) << key;
    }
  }
}

TEST_F(ProgramOptions, OfTheOtherMethodAreRefusedWithItsName) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"--edge-ratio 1.2 --method as-published", "method on-scan"},
      {"--method as-published --max-handle-loop 0", "method on-scan"},
      {"--sampling fibonacci", "method as-published"},
      {"--max-overhang 10", "method as-published"},
      {"--weighting area", "method as-published"},
      {"--placement sh-surface", "method as-published"},
      {"-p contact-fit --method as-published", "method on-scan"}};
  for (const auto& [arguments, words] : cases) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = run("scan.ply remesh.ply " + arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(holds(outcome.errors, words));
    EXPECT_FALSE(exists("remesh.ply"));
  }
}

TEST_F(ProgramOptions, RefuseWhatIsNotTheirsWithTheChoicesAndBeginNothing) {
  for (const OptionCase& one : option_cases()) {
    SCOPED_TRACE(one.key);
    const Outcome outcome =
        run("scan.ply remesh.ply " + one.with + " --" + one.key + "=" + one.refused);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(holds(outcome.errors, one.words));
    EXPECT_EQ(outcome.output, "");
    EXPECT_FALSE(exists("remesh.ply"));
  }
}

TEST_F(ProgramOptions, WithoutAnEffectAreTold) {
  const std::string call = "scan.ply remesh.ply -q -n 60 -d 6 ";
  for (const auto& [option, needed, used] :
       {std::tuple("--alpha=2", "--weighting=wscvt-c", "-w wscvt-c"),
        {"--contact-radius=1.3", "--placement=contact-fit", "-p contact-fit"},
        {"--error-measure=area", "--max-error", "--max-error 30"}}) {
    SCOPED_TRACE(option);
    const std::string name = std::string(option).substr(0, std::string(option).find('='));
    const Outcome idle = run(call + option);
    EXPECT_EQ(idle.exit_code, 0);
    EXPECT_TRUE(holds(idle.errors, "Warning: " + name + " has no effect without " + needed + "."));
    const Outcome works = run(call + option + " " + used);
    EXPECT_EQ(works.exit_code, 0);
    EXPECT_FALSE(holds(works.errors, "no effect"));
  }
  for (const auto& [option, needed] :
       {std::pair("--sdf-spacing", "0.2"), {"--edge-length", "0.2"}}) {
    const Outcome outcome = run(call + option + " " + needed);
    EXPECT_EQ(outcome.exit_code, 2);
    const std::string file = std::string(option) == "--edge-length" ? "--tetrahedra" : "--sdf";
    EXPECT_TRUE(holds(outcome.errors, std::string(option) + " requires " + file));
  }
}

TEST_F(ProgramOptions, WithAnAllowedErrorTheNumberOfNodesIsTheLimit) {
  const Outcome missed = run("scan.ply missed.ply -d 6 --max-error 0.001 -n 80");
  EXPECT_EQ(missed.exit_code, 0);
  EXPECT_TRUE(holds(missed.errors, "No number of nodes up to 80 has"));
  EXPECT_TRUE(holds(missed.errors, "a larger --nodes, or a larger --max-error"));
  EXPECT_EQ(read_mesh(path("missed.ply")).points.size(), 80U);
  ASSERT_EQ(run("scan.ply met.ply -q -d 6 -n 1500 --max-error 5").exit_code, 0);
  EXPECT_LT(read_mesh(path("met.ply")).points.size(), 200U);
  // A report has the limit, given or not. A call with it makes the same search.
  const auto report_with = [&](const std::string& nodes) {
    EXPECT_EQ(run("scan.ply r.ply -q -d 6 --max-error 5 --report r.json " + nodes).exit_code, 0);
    return Json::parse(content("r.json"));
  };
  for (const auto& [nodes, limit] : std::vector<std::pair<std::string, int>>{
           {"-n 1500", 1500}, {"-n 80", 80}, {"", ErrorTarget().largest_node_count}}) {
    const Json report = report_with(nodes);
    EXPECT_EQ(report.at("options").at("nodes"), limit);
    const Json again = report_with("-n " + std::to_string(limit));
    EXPECT_EQ(again.at("options"), report.at("options"));
    EXPECT_EQ(again.at("node_count_search"), report.at("node_count_search"));
  }
  // The help tells what holds without a number.
  const std::string help = run("remesh --help").output;
  const std::string words = "at most this number, or " +
                            std::to_string(ErrorTarget().largest_node_count) + " if none is given";
  EXPECT_TRUE(holds(std::regex_replace(help, std::regex("\\s+"), " "), words)) << help;
}

TEST_F(ProgramOptions, TakeBackWhatAReportPrints) {
  std::string unusual;
  for (const OptionCase& one : option_cases()) {
    // Those of a search, and of the other method.
    if (one.key == "max-error" || one.key == "method" || !one.with.empty()) continue;
    unusual += " --" + one.key + "=" + typed(one.value);
  }
  Json first = report_of(unusual);
  const std::string mesh = content("remesh.ply");
  ASSERT_FALSE(mesh.empty());
  std::string arguments;
  for (const auto& [key, value] : first.at("options").items()) {
    if (!value.is_null()) arguments += " --" + key + "=" + typed(value);
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
  EXPECT_FALSE(holds(help, "->"));
  const auto names_all = [&](const auto& rows) {
    for (const auto& row : rows) {
      EXPECT_TRUE(holds(help, "\n                              " + std::string(row.key) + ": "))
          << row.key;
    }
  };
  names_all(enumerators<Weighting>());
  names_all(enumerators<CellWeighting>());
  names_all(enumerators<ScanPlacement>());
  names_all(enumerators<PublishedPlacement>());
}

TEST_F(ProgramOptions, LettersStandForNames) {
  const Json options = report_of("-n 62 -w wscvt-c -p fitted -e 1.2 -d 5 -a 0.5").at("options");
  EXPECT_EQ(options.at("nodes"), 62);
  EXPECT_EQ(options.at("weighting"), "wscvt-c");
  EXPECT_EQ(options.at("placement"), "fitted");
  EXPECT_EQ(options.at("edge-ratio"), 1.2);
  EXPECT_EQ(options.at("degree"), 5);
  EXPECT_EQ(options.at("alpha"), 0.5);
  EXPECT_EQ(report_of("--method as-published -s icosahedron").at("options").at("sampling"),
            "icosahedron");
  EXPECT_EQ(report_of("--weighting WSCVT-C").at("options").at("weighting"), "wscvt-c");
  EXPECT_EQ(report_of("--method As-Published -w WSCVT-D").at("options").at("weighting"), "wscvt-d");
}

TEST_F(ProgramOptions, QuietThreadsAndCoefficientsDoAsTheySay) {
  const Outcome loud = run("scan.ply loud.ply -n 60 -d 6 -t 1");
  EXPECT_EQ(loud.exit_code, 0) << loud.errors;
  EXPECT_TRUE(holds(loud.output, "60 nodes"));
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
          "--node-table nodes.csv --node-table nodes.vtp "
          "--node-table grain.shp --sdf grid.npy --sdf grid.vti --sdf grid.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const ShapeDescriptors framed = describe_shape(read_mesh(path("framed.ply")), Execution(1));
  EXPECT_NEAR(framed.volume, 4.0 / 3.0 * test::pi, 1e-9);
  EXPECT_LT(framed.centroid.norm(), 0.02);
  const Json description = Json::parse(content("grid.npy.json"));
  EXPECT_EQ(description.at("spacing"), 0.2);
  EXPECT_EQ(description.at("surface"), "scan");
  EXPECT_EQ(description.at("frame").at("name"), "principal");
  for (const char* name : {"nodes.csv", "nodes.vtp", "grain.shp", "grid.vti", "grid.json"}) {
    EXPECT_NE(content(name), "") << name;
  }
  // Scaled, every length is so many times as large.
  ASSERT_EQ(run("remesh scan.ply plain.ply -q -n 60 -d 6").exit_code, 0);
  ASSERT_EQ(run("remesh scan.ply large.ply -q -n 60 -d 6 --scale 1000").exit_code, 0);
  const Vector3 plain = read_mesh(path("plain.ply")).points[7];
  EXPECT_LT((read_mesh(path("large.ply")).points[7] - 1000.0 * plain).norm(), 1e-9);
}

TEST_F(ProgramOptions, TetrahedraAreWrittenInEachFormAndLeaveTheRemeshAsItIs) {
  ASSERT_EQ(run("remesh scan.ply plain.ply -q -n 60 -d 6").exit_code, 0);
  const Outcome filled =
      run("remesh scan.ply filled.ply -n 60 -d 6 --tetrahedra body.vtu --tetrahedra body.msh "
          "--tetrahedra body.inp --edge-length 0.5");
  ASSERT_EQ(filled.exit_code, 0) << filled.errors;
  EXPECT_TRUE(holds(filled.output, "etrahedra"));
  EXPECT_EQ(content("filled.ply"), content("plain.ply"));
  EXPECT_TRUE(holds(content("body.inp"), "C3D4"));
  EXPECT_TRUE(holds(content("body.vtu"), "UnstructuredGrid"));
  EXPECT_TRUE(holds(content("body.msh"), "$Elements"));
  EXPECT_EQ(run("remesh scan.ply bad.ply -n 60 --tetrahedra body.stl").exit_code, 2);
  EXPECT_EQ(run("remesh scan.ply bad.ply -n 60 --tetrahedra b.vtu --edge-length -1").exit_code, 2);
  EXPECT_FALSE(exists("bad.ply"));
}

TEST_F(ProgramOptions, AGridThatIsTooLargeIsRefusedBeforeTheRemesh) {
  // A million nodes would take long. Diameter 2, so that 0.001 takes 2000 points along an axis.
  for (const std::string frame : {"", " --frame principal", " --frame centred"}) {
    const Outcome outcome =
        run("remesh scan.ply bad.ply -n 1000000 --size 2 --sdf grid.npy "
            "--sdf-spacing 0.001" +
            frame);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(holds(outcome.errors, "(--sdf-spacing) of 0.001 needs a grid of "));
    EXPECT_FALSE(exists("bad.ply") || exists("grid.npy"));
  }
  // What is wrong with the scan comes first.
  std::ofstream(folder_ / "none.ply") << "no mesh";
  const Outcome outcome = run("remesh none.ply bad.ply --sdf grid.npy --sdf-spacing 1e-9");
  EXPECT_EQ(outcome.exit_code, 1);
}

TEST_F(ProgramOptions, RefuseFilesForASimulationBeforeTheWork) {
  for (const char* wrong :
       {"--node-table nodes.txt", "--sdf grid.csv", "--node-table grain.shp", "--frame middle",
        "--scale 0", "--size -1", "--size 1 --scale 2", "--node-table a.csv --node-table a.csv",
        "--sdf a.npy --report a.npy.json"}) {
    SCOPED_TRACE(wrong);
    const Outcome outcome = run(std::string("remesh scan.ply bad.ply -n 60 ") + wrong);
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.errors, "");
    EXPECT_FALSE(exists("bad.ply"));
  }
}

class Completion : public test::ProgramRun {
 protected:
  void SetUp() override {
    ProgramRun::SetUp();
    const Outcome script = run("--completion");
    ASSERT_EQ(script.exit_code, 0) << script.errors;
    std::ofstream(folder_ / "wscvt.bash") << script.output;
  }
  /// Of the last of the words, which may be empty.
  std::set<std::string> completed(const std::string& words) const {
    std::ofstream(folder_ / "complete.sh")
        << "set -u\n. ./wscvt.bash\nCOMP_WORDS=(" << words
        << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_wscvt\n"
           "for one in \"${COMPREPLY[@]}\"; do echo \"$one\"; done >completed.txt\n";
    EXPECT_EQ(std::system(("cd '" + folder_.string() + "' && bash complete.sh").c_str()), 0);
    std::istringstream lines(content("completed.txt"));
    std::set<std::string> result;
    for (std::string line; std::getline(lines, line);) result.insert(line);
    return result;
  }
};

using Words = std::set<std::string>;

TEST_F(Completion, KnowsCommandsOptionsAndChoices) {
  EXPECT_EQ(completed("wscvt c"), (Words{"clump", "convex", "create"}));
  EXPECT_EQ(completed("wscvt --v"), Words{"--version"});
  EXPECT_EQ(completed("wscvt remesh a.ply --max-"),
            (Words{"--max-error", "--max-handle-loop", "--max-overhang", "--max-repaired-area"}));
  EXPECT_EQ(completed("wscvt a.ply b.ply --edge-r"), Words{"--edge-ratio"});
  EXPECT_EQ(completed("wscvt batch --sha"), Words{"--shard"});
  EXPECT_EQ(completed("wscvt describe a.ply --ref"), Words());
  Words weightings;
  for (const auto& row : enumerators<CellWeighting>()) weightings.emplace(row.key);
  for (const auto& row : enumerators<Weighting>()) weightings.emplace(row.key);
  EXPECT_EQ(completed("wscvt remesh --weighting ''"), weightings);
  // Both methods' values: those of the method on the scan are other ones.
  Words placements;
  for (const auto& row : enumerators<ScanPlacement>()) placements.emplace(row.key);
  for (const auto& row : enumerators<PublishedPlacement>()) placements.emplace(row.key);
  EXPECT_EQ(completed("wscvt remesh --placement ''"), placements);
  EXPECT_EQ(completed("wscvt a.ply b.ply -w wscvt-c"), Words{"wscvt-c"});
  EXPECT_EQ(completed("wscvt remesh --weighting = wscvt-c"), Words{"wscvt-c"});
  EXPECT_EQ(completed("wscvt remesh scan"), Words()) << "files are bash's own";
  EXPECT_EQ(completed("wscvt remesh --js"), Words()) << "that name is of old scripts";
}

TEST_F(Completion, TellsCommandsApart) {
  EXPECT_EQ(completed("wscvt he"), Words{"help"});
  EXPECT_EQ(completed("wscvt help cr"), Words{"create"});
  EXPECT_EQ(completed("wscvt remesh --frame ''"), (Words{"input", "centred", "principal"}));
  EXPECT_EQ(completed("wscvt extract --smoothing ''"), Words()) << "a number";
  EXPECT_EQ(completed("wscvt create s"), Words{"superellipsoid"});
  EXPECT_EQ(completed("wscvt remesh s"), Words());
  EXPECT_EQ(completed("wscvt extract --out"), Words{"--output"});
}

}  // namespace

}  // namespace wscvt
