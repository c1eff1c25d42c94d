// SPDX-License-Identifier: GPL-3.0-or-later
// The program on a whole sample.
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "program_run.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Records = std::vector<std::vector<std::string>>;
using test::holds;

class Batch : public test::ProgramRun {
 protected:
  static constexpr const char* options_ = " -q -n 60 -d 6 --describe remesh ";
  static constexpr const char* remesh_options_ = " -q -n 60 -d 6 ";

  /// Scans of different bodies, scans/a.ply, scans/b.ply, ...
  void write_scans(int count) const {
    fs::create_directory(folder_ / "scans");
    for (int k = 0; k < count; ++k) {
      const Vector3 axes(1.0, 0.9 - 0.02 * k, 0.7);
      write_mesh(test::transformed(test::sphere(3), axes.asDiagonal()), path(scan(k)));
    }
  }
  static std::string scan(int k) {
    return "scans/" + std::string(1, static_cast<char>('a' + k)) + ".ply";
  }

  /// A folder of many names of the first scan.
  void write_links(const std::string& name, int count) const {
    fs::create_directory(folder_ / name);
    for (int k = 0; k < count; ++k) {
      fs::create_symlink(folder_ / scan(0), folder_ / name / (std::to_string(k) + ".ply"));
    }
  }

  Records records(const std::string& name) const { return test::csv_records(content(name)); }

  std::vector<std::string> column(const std::string& table, const std::string& name) const {
    const Records all = records(table);
    std::size_t place = 0;
    while (place < all.at(0).size() && all[0][place] != name) ++place;
    std::vector<std::string> values;
    for (std::size_t k = 1; k < all.size(); ++k) values.push_back(all[k].at(place));
    return values;
  }

  /// Starts the program without waiting for it.
  pid_t start(const std::vector<std::string>& words) const {
    std::vector<char*> argv = {const_cast<char*>("wscvt")};
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    std::signal(SIGINT, SIG_DFL);
    if (chdir(folder_.c_str()) != 0) _exit(99);
    if (std::freopen("said.txt", "w", stderr) == nullptr) _exit(97);
    execv(WSCVT_PROGRAM, argv.data());
    _exit(98);
  }

  void wait_for_rows(const std::string& table, std::size_t lines) const {
    for (int tries = 0; tries < 3000; ++tries) {
      const std::string text = exists(table) ? content(table) : "";
      if (static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) >= lines) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "no " << lines << " lines in " << table;
  }
};

TEST_F(Batch, HasTheSameBytesAtAnyNumberOfThreadsInTheOrderOfTheInputs) {
  write_scans(6);
  std::ofstream(folder_ / "scans/broken.ply") << "no mesh";
  for (const std::string threads : {"1", "2", "5"}) {
    const Outcome outcome = run("batch scans -o out" + threads + options_ + "-t " + threads);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
    EXPECT_TRUE(holds(outcome.errors, "Failed: scans/broken.ply: "));
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(content("out" + threads + "/grains.csv"), content("out1/grains.csv"));
    EXPECT_EQ(content("out" + threads + "/shape.csv"), content("out1/shape.csv"));
    EXPECT_EQ(content("out" + threads + "/summary.json"), content("out1/summary.json"));
    EXPECT_EQ(content("out" + threads + "/e.ply"), content("out1/e.ply"));
  }
  EXPECT_EQ(column("out1/grains.csv", "grain"),
            (std::vector<std::string>{scan(0), scan(1), "scans/broken.ply", scan(2), scan(3),
                                      scan(4), scan(5)}));
  EXPECT_EQ(column("out1/grains.csv", "status"),
            (std::vector<std::string>{"done", "done", "failed", "done", "done", "done", "done"}));
  EXPECT_TRUE(holds(column("out1/grains.csv", "error")[2], "PLY"));
  EXPECT_FALSE(exists("out1/broken.ply"));

  // A row and a mesh are what the grain alone would have given.
  ASSERT_EQ(run("remesh " + scan(4) + " alone.ply --report alone.csv" + remesh_options_).exit_code,
            0);
  EXPECT_EQ(content("alone.ply"), content("out1/e.ply"));
  const Records alone = records("alone.csv");
  for (std::size_t k = 0; k < alone[0].size(); ++k) {
    if (alone[0][k] == "date") continue;
    EXPECT_EQ(column("out1/grains.csv", alone[0][k])[5], alone[1][k]) << alone[0][k];
  }
}

TEST_F(Batch, SumsUpTheSample) {
  write_scans(5);
  const Outcome outcome = run("batch scans -o out -n 60 -d 6 --describe none");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.rfind("5 grains: 5 remeshed, ", 0), 0U) << outcome.output;
  EXPECT_EQ(outcome.errors, "") << "progress went into a file";
  const Json summary = Json::parse(content("out/summary.json"));
  EXPECT_EQ(summary.at("grains"), 5);
  EXPECT_EQ(summary.at("failed"), 0);
  const Json& elongation = summary.at("distributions").at("elongation");
  EXPECT_NEAR(elongation.at("minimum").get<double>(), 0.82, 0.01);
  EXPECT_NEAR(elongation.at("median").get<double>(), 0.86, 0.01);
  EXPECT_NEAR(elongation.at("maximum").get<double>(), 0.90, 0.01);
  EXPECT_NEAR(summary.at("distributions").at("volume_error").at("maximum").get<double>(), 0.0,
              1e-9);
  const std::string page = content("out/summary.html");
  for (const char* text : {"A sample of 5 grains", "equivalent radius", "<svg", "sphericity"}) {
    EXPECT_TRUE(holds(page, text));
  }
}

TEST_F(Batch, GoesOnWhereItWasKilled) {
  write_scans(8);
  ASSERT_EQ(run(std::string("batch scans -o whole") + options_).exit_code, 0);
  // The fifth grain is a pipe that gives nothing: the batch waits there, and is killed.
  const std::string kept = content(scan(4));
  for (const int signal : {SIGKILL, SIGTERM}) {
    SCOPED_TRACE(signal);
    const std::string out = "out" + std::to_string(signal);
    const std::string table = out + "/grains.csv";
    fs::remove(folder_ / scan(4));
    ASSERT_EQ(mkfifo(path(scan(4)).c_str(), 0600), 0);
    const pid_t child = start({"batch", "scans", "-o", out, "-q", "-n", "60", "-d", "6", "-t", "2",
                               "--describe", "remesh"});
    wait_for_rows(table, 5);
    if (signal == SIGTERM) {
      ASSERT_EQ(kill(child, signal), 0);
      std::ofstream(folder_ / scan(4), std::ios::binary) << kept;  // what the reader waits for
    } else {
      ASSERT_EQ(kill(child, signal), 0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    if (signal == SIGTERM) {
      ASSERT_TRUE(WIFEXITED(status));
      EXPECT_EQ(WEXITSTATUS(status), 128 + SIGTERM);
      EXPECT_TRUE(holds(content("said.txt"), "Cancelled after 4 of 8 grains"));
    }
    fs::remove(folder_ / scan(4));
    std::ofstream(folder_ / scan(4), std::ios::binary) << kept;
    EXPECT_EQ(column(table, "grain").size(), 4U);
    EXPECT_FALSE(exists(out + "/summary.json"));
    // A row that was cut is made again; those before it are not, or this one would fail.
    fs::resize_file(folder_ / table, content(table).size() - 100);
    std::ofstream(folder_ / (out + "/d.ply.part")) << "half a mesh";
    const std::string first = content(scan(0));
    const fs::file_time_type time = fs::last_write_time(folder_ / scan(0));
    std::ofstream(folder_ / scan(0)) << "gone";
    fs::last_write_time(folder_ / scan(0), time);  // a newer scan would be remeshed again
    const Outcome again = run("batch scans -o " + out + options_);
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    std::ofstream(folder_ / scan(0), std::ios::binary) << first;
    for (const std::string name : {"/grains.csv", "/summary.json", "/h.ply"}) {
      EXPECT_EQ(content(out + name), content("whole" + name)) << name;
    }
    EXPECT_FALSE(exists(out + "/d.ply.part"));
  }
  // A table of shapes that is behind, or ahead, is brought to the same rows.
  for (const std::string name : {"/shape.csv", "/grains.csv"}) {
    const std::string kept_table = content("whole" + name);
    fs::resize_file(folder_ / ("whole" + name), kept_table.rfind("scans/h.ply"));
    EXPECT_EQ(run(std::string("batch scans -o whole") + options_).exit_code, 0);
    EXPECT_EQ(content("whole" + name), kept_table);
    EXPECT_EQ(column("whole/shape.csv", "grain").size(), 8U);
    EXPECT_EQ(column("whole/grains.csv", "grain").size(), 8U);
  }
}

TEST_F(Batch, ShapesAreThoseOfDescribe) {
  write_scans(2);
  ASSERT_EQ(run(std::string("batch scans -o out") + remesh_options_).exit_code, 0);
  EXPECT_EQ(column("out/shape.csv", "file"), (std::vector<std::string>{"a.ply", "b.ply"}));
  EXPECT_EQ(column("out/shape.csv", "nodes"), (std::vector<std::string>{"60", "60"}));
  const Records shapes = records("out/shape.csv");
  const std::vector<std::pair<std::string, std::string>> meshes = {{"scan", scan(1)},
                                                                   {"remesh", "out/b.ply"}};
  for (const auto& [name, file] : meshes) {
    ASSERT_EQ(run("describe " + file + " -q --report " + name + ".csv").exit_code, 0);
    const Records described = records(name + ".csv");
    std::size_t compared = 0;
    for (std::size_t k = 0; k < described[0].size(); ++k) {
      const std::string key = described[0][k].substr(described[0][k].find_last_of('.') + 1);
      for (const char* unit : {"", " [length]", " [length^2]", " [length^3]"}) {
        if (described[0][k].rfind("descriptors.", 0) != 0) continue;
        const std::vector<std::string> columns = shapes[0];
        const std::string heading = name + "." + key + std::string(unit);
        if (std::find(columns.begin(), columns.end(), heading) == columns.end()) continue;
        ++compared;
        const std::string value =
            shapes[2][std::find(columns.begin(), columns.end(), heading) - columns.begin()];
        if (name == "scan" || described[1][k].empty()) {
          EXPECT_EQ(value, described[1][k]) << heading;
        } else {
          // The printed Sdq and the search of the box hang on the order of the faces.
          EXPECT_NEAR(std::stod(value), std::stod(described[1][k]), 2e-3 * std::stod(value) + 1e-6)
              << heading;
        }
      }
    }
    EXPECT_EQ(compared, 46U) << "of the table in lib/README.md";
  }
  EXPECT_EQ(run("batch " + scan(0) + " -o none --describe none" + remesh_options_).exit_code, 0);
  EXPECT_FALSE(exists("none/shape.csv"));
  EXPECT_EQ(run("batch " + scan(0) + " -o one --describe remesh" + remesh_options_).exit_code, 0);
  EXPECT_FALSE(holds(content("one/shape.csv"), "scan."));
  EXPECT_TRUE(holds(content("one/shape.csv"), ",remesh.volume [length^3],"));
}

TEST_F(Batch, LevelsAreTheBatchesOfTheirNumbersOfNodes) {
  write_scans(2);
  std::ofstream(folder_ / "scans/broken.ply") << "no mesh";
  ASSERT_EQ(run("batch scans -o levels -q -d 6 -n 90,60").exit_code, 3);
  for (const std::string nodes : {"60", "90"}) {
    ASSERT_EQ(run("batch scans -o out" + nodes + " -q -d 6 -n " + nodes).exit_code, 3);
    for (const std::string name : {"/grains.csv", "/shape.csv", "/b.ply", "/summary.json"}) {
      EXPECT_EQ(content("levels/n" + nodes + name), content("out" + nodes + name)) << name;
    }
  }
  expect_refused("batch scans -o bad -q",
                 {{"-n 60,60", 2, "twice"},
                  {"-n 60,x", 2, "x"},
                  {"-n 60,3", 2, "3"},
                  {"-n 60,90 --max-error 1", 2, "needs a single number of nodes"}},
                 {"bad"});
}

TEST_F(Batch, FilesForASimulationAreThoseOfTheGrainsAlone) {
  write_scans(2);
  std::ofstream(folder_ / "scans/broken.ply") << "no mesh";
  const std::string options = " -q -d 6 --frame principal --size 3 --sdf-spacing 0.3 ";
  ASSERT_EQ(run("batch scans -o out -n 60,90 --describe none --node-table csv --node-table shp "
                "--sdf npy --sdf json" +
                options)
                .exit_code,
            3);
  for (const std::string nodes : {"60", "90"}) {
    // In a folder of their own, because the shape has the file's name.
    ASSERT_EQ(run("remesh " + scan(1) + " b.ply -n " + nodes +
                  " --node-table b.csv --node-table b.shp --sdf b.npy --sdf b.json" + options)
                  .exit_code,
              0);
    const std::string out = "out/n" + nodes;
    EXPECT_EQ(content(out + "/b.ply"), content("b.ply"));
    for (const std::string name :
         {"node-table/b.csv", "node-table/b.shp", "sdf/b.npy", "sdf/b.json"}) {
      EXPECT_NE(content(out + "/" + name), "") << name;
      EXPECT_EQ(content(out + "/" + name), content(fs::path(name).filename())) << name;
    }
    // The masses are those of the description beside the grid, which alone has a date.
    Json alone = Json::parse(content("b.npy.json"));
    Json made = Json::parse(content(out + "/sdf/b.npy.json"));
    EXPECT_TRUE(made.at("date").is_null());
    alone["date"] = nullptr;
    EXPECT_EQ(made, alone);
    EXPECT_EQ(column(out + "/mass.csv", "status"),
              (std::vector<std::string>{"done", "done", "failed"}));
    EXPECT_EQ(column(out + "/mass.csv", "file")[1], "b.ply");
    const Json& mass = made.at("mass");
    EXPECT_NEAR(mass.at("volume"), 4.5 * test::pi, 1e-9) << "of a sphere with diameter 3";
    for (const char* key : {"volume", "inertia_tensor.xx", "principal_moments.greatest"}) {
      const Json::json_pointer place("/" + std::regex_replace(key, std::regex("\\."), "/"));
      EXPECT_EQ(std::stod(column(out + "/mass.csv", key)[1]), mass.at(place)) << key;
    }
  }
  // It goes on, and with other options it does not.
  const std::string table = content("out/n60/mass.csv");
  fs::resize_file(folder_ / "out/n60/mass.csv", table.size() - 10);
  const std::string again =
      "batch scans -o out -n 60,90 --describe none --node-table csv "
      "--node-table shp --sdf npy --sdf json -q -d 6 --sdf-spacing 0.3 ";
  EXPECT_EQ(run(again + "--frame principal --size 3").exit_code, 3);
  EXPECT_EQ(content("out/n60/mass.csv"), table);
  EXPECT_EQ(run(again + "--frame principal --size 2").exit_code, 2);
  EXPECT_EQ(run("describe out/n60/b.ply -q --report out/n60/mass.csv").exit_code, 2);
  expect_refused("batch scans -o bad -q",
                 {{"--node-table txt", 2, "Use .csv, .vtp or .shp"},
                  {"--node-table shp", 2, "principal"},
                  {"--sdf csv", 2, "Use .npy, .vti or .json"},
                  {"--size 1 --scale 2", 2, "Give one of them"}},
                 {"bad"});
  EXPECT_EQ(run("batch " + scan(0) + " -o plain -q -n 60 -d 6").exit_code, 0);
  EXPECT_FALSE(exists("plain/mass.csv"));
}

TEST_F(Batch, AFailureBeforeItGoesOnCounts) {
  write_scans(2);
  std::ofstream(folder_ / "broken.ply") << "no mesh";
  const std::string first = std::string("batch -o out") + options_ + "broken.ply " + scan(0);
  EXPECT_EQ(run(first).exit_code, 3);
  EXPECT_EQ(run(first + " " + scan(1)).exit_code, 3);
  EXPECT_EQ(column("out/grains.csv", "status"),
            (std::vector<std::string>{"failed", "done", "done"}));
}

TEST_F(Batch, GoesOnOnlyWithWhatItBeganWith) {
  write_scans(3);
  ASSERT_EQ(run("batch " + scan(0) + " " + scan(1) + " -o out" + options_).exit_code, 0);
  const std::string before = content("out/grains.csv");
  const Outcome options = run("batch " + scan(0) + " " + scan(1) + " -o out -q -n 61 -d 6");
  EXPECT_EQ(options.exit_code, 2);
  EXPECT_TRUE(holds(options.errors, "out/call.json"));
  const Outcome inputs = run("batch " + scan(1) + " " + scan(2) + " -o out" + options_);
  EXPECT_EQ(inputs.exit_code, 2);
  EXPECT_TRUE(holds(inputs.errors, "other inputs"));
  EXPECT_EQ(run("batch scans -o out -q -n 60 -d 6 --frame centred").exit_code, 2);
  EXPECT_EQ(content("out/grains.csv"), before);
  // More grains at the end are welcome.
  EXPECT_EQ(run(std::string("batch scans -o out") + options_).exit_code, 0);
  EXPECT_EQ(column("out/grains.csv", "grain"),
            (std::vector<std::string>{scan(0), scan(1), scan(2)}));
  EXPECT_EQ(content("out/grains.csv").rfind(before, 0), 0U);
}

TEST_F(Batch, OtherNumbersOfNodesAreOtherOptions) {
  write_scans(2);
  ASSERT_EQ(run(std::string("batch scans -o one") + options_).exit_code, 0);
  ASSERT_EQ(run("batch scans -o two -q -n 40,60 -d 6 --describe remesh").exit_code, 0);
  for (const auto& [folder, nodes] : {std::pair("one", "40,60"), std::pair("two", "60")}) {
    const std::string call = std::string(folder) + "/call.json";
    const std::string before = content(call);
    const Outcome other = run("batch scans -o " + std::string(folder) + " -q -d 6 -n " + nodes +
                              " --describe remesh");
    EXPECT_EQ(other.exit_code, 2) << folder;
    EXPECT_TRUE(holds(other.errors, call));
    EXPECT_EQ(content(call), before) << folder;
  }
  EXPECT_FALSE(exists("one/n40"));
}

TEST_F(Batch, OtherCommandsDoNotReplaceItsFiles) {
  write_scans(3);
  ASSERT_EQ(run(std::string("batch scans -o out") + options_).exit_code, 0);
  ASSERT_EQ(run("batch scans -o levels -q -n 40,60 --describe remesh").exit_code, 0);
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"sample out", "out/shape.csv"},          {"sample out", "out/grains.csv"},
      {"sample out", "out/summary.html"},       {"sample out", "./out/../out/summary.json"},
      {"sample out", "out/call.json"},          {"sample levels", "levels/n40/shape.csv"},
      {"describe scans/a.ply", "out/shape.csv"}};
  for (const auto& [command, file] : cases) {
    SCOPED_TRACE(command + " " + file);
    const std::string before = content(file);
    const Outcome outcome = run(command + " -q --report " + file);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.errors;
    EXPECT_TRUE(holds(outcome.errors, "is a file of a batch"));
    EXPECT_EQ(content(file), before);
  }
  EXPECT_EQ(run("sample out -q --report out/sample.csv --report shape.csv").exit_code, 0);
}

TEST_F(Batch, OtherCommandsDoNotReplaceFilesOfItsGrains) {
  write_scans(2);
  ASSERT_EQ(run("batch scans -o out -q -n 40 --describe none --node-table csv").exit_code, 0);
  ASSERT_EQ(run("batch scans -o levels -q -n 40,60 --describe none").exit_code, 0);
  for (const char* file : {"out/a.ply", "levels/n40/a.ply"}) {
    SCOPED_TRACE(file);
    const std::string before = content(file);
    const Outcome outcome = run(std::string("remesh scans/a.ply ") + file + " -n 50 -q");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.errors;
    EXPECT_TRUE(holds(outcome.errors, "is a file of a batch"));
    EXPECT_EQ(content(file), before);
  }
  const std::string nodes = content("out/node-table/a.csv");
  EXPECT_EQ(run("remesh scans/a.ply a.ply -n 50 -q --node-table out/node-table/a.csv").exit_code,
            2);
  EXPECT_EQ(content("out/node-table/a.csv"), nodes);
  // A file of the user beside them, also again.
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(run("remesh scans/a.ply out/a.off -n 50 -q").exit_code, 0);
  }
}

TEST_F(Batch, OtherCommandsDoNotReplaceTables) {
  write_scans(1);
  const std::vector<std::pair<std::string, std::string>> tables = {
      {"labels.csv", "grain,label,name"},
      {"bodies.csv", "body,state,volume"},
      {"contacts.csv", "first,second,area"},
      {"fragments.csv", "fragment,file,volume"},
      {"grains.csv", "label,name,voxels"}};
  for (const auto& [name, header] : tables) {
    SCOPED_TRACE(name);
    const std::string before = header + "\r\n";
    std::ofstream(path(name)) << before;
    for (const std::string call :
         {"remesh scans/a.ply o.ply -n 40 -q --node-table ", "clump scans/a.ply -k 2 -q -o "}) {
      const Outcome outcome = run(call + name);
      EXPECT_EQ(outcome.exit_code, 2) << outcome.errors;
      EXPECT_TRUE(holds(outcome.errors, "is a table of another command"));
    }
    EXPECT_EQ(content(name), before);
  }
  // One's own, again.
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(run("remesh scans/a.ply o.ply -n 40 -q --node-table nodes.csv").exit_code, 0);
    EXPECT_EQ(run("clump scans/a.ply -k 2 -q -o labels_of_mine.csv").exit_code, 0);
  }
}

TEST_F(Batch, NamesOfAnyLengthAreRemeshed) {
  write_scans(1);
  fs::create_directory(folder_ / "long");
  // 255 bytes are the most that a name has.
  for (const int bytes : {100, 251, 252, 255}) {
    const std::string name = std::string(static_cast<std::size_t>(bytes) - 4, 'x') + ".ply";
    fs::copy_file(folder_ / scan(0), folder_ / "long" / name);
  }
  const Outcome outcome = run(std::string("batch long -o out") + options_);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(column("out/grains.csv", "status"), std::vector<std::string>(4, "done"));
}

TEST_F(Batch, SaysThatAnInputIsNotThere) {
  const Outcome outcome = run("batch nowhere -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(holds(outcome.errors, "There is no file and no folder \"nowhere\""));
}

TEST_F(Batch, TakesFilesFoldersPatternsAndLists) {
  write_scans(4);
  fs::create_directory(folder_ / "more");
  write_mesh(test::sphere(3), path("more/x.STL"));
  std::ofstream(folder_ / "more/notes.txt") << "no mesh";
  write_mesh(test::sphere(3), path("y.obj"));
  std::ofstream(folder_ / "list.txt") << "scans/c.ply\r\n\nscans/[d]*\n";
  const Outcome outcome = run(
      std::string("batch y.obj more 'scans/[ba].ply' @list.txt missing.off -o out --format off") +
      options_);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
  EXPECT_EQ(column("out/grains.csv", "grain"),
            (std::vector<std::string>{"y.obj", "more/x.STL", scan(0), scan(1), scan(2), scan(3),
                                      "missing.off"}));
  EXPECT_EQ(column("out/grains.csv", "status").back(), "failed");
  EXPECT_EQ(read_mesh(path("out/x.off")).points.size(), 60U);

  struct BadInputs {
    std::string inputs;
    std::string part_of_the_sentence;
  };
  for (const BadInputs& call :
       {BadInputs{"-o out2 scans " + scan(1), "would both be written to \""},
        BadInputs{"-o out2 'scans/z*'", "No file matches"}, BadInputs{"-o out2 @no.txt", "no.txt"},
        BadInputs{"-o out2 out2", "out2"}, BadInputs{"scans -o scans", "replace the scan"}}) {
    SCOPED_TRACE(call.inputs);
    fs::create_directory(folder_ / "out2");
    const Outcome refused = run("batch " + call.inputs + options_);
    EXPECT_EQ(refused.exit_code, call.inputs.find("@no.txt") == std::string::npos ? 2 : 1);
    EXPECT_TRUE(holds(refused.errors, call.part_of_the_sentence));
    EXPECT_TRUE(fs::is_empty(folder_ / "out2"));
  }
  EXPECT_EQ(run("batch scans -o out2 --shard 3/2").exit_code, 2);
  EXPECT_EQ(run("batch scans -o out2 --format step").exit_code, 2);
}

TEST_F(Batch, PartsAreStableAndTheSameCallJoinsThem) {
  write_scans(8);
  std::ofstream(folder_ / "scans/broken.ply") << "no mesh";
  ASSERT_EQ(run(std::string("batch scans -o whole") + options_).exit_code, 3);
  for (const int count : {2, 3}) {
    const std::string out = "out" + std::to_string(count);
    for (int index = count; index >= 1; --index) {
      const std::string part = std::to_string(index) + "/" + std::to_string(count);
      run("batch scans -o " + out + options_ + "--shard " + part);
      const std::string table =
          out + "/grains-" + std::to_string(index) + "-of-" + std::to_string(count) + ".csv";
      for (const std::string& grain : column(table, "grain")) {
        std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a, as its authors give it
        for (const char c : grain.substr(6)) {
          hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
        }
        EXPECT_EQ(hash % static_cast<std::uint64_t>(count), static_cast<std::uint64_t>(index - 1))
            << grain;
      }
    }
    // What has a row is not made again.
    fs::remove(path(out + "/grain3.ply"));
    const Outcome joined =
        run("batch scans -o " + out + std::regex_replace(options_, std::regex(" -q"), ""));
    EXPECT_EQ(joined.exit_code, 3) << joined.errors;
    EXPECT_TRUE(holds(joined.output, "1 failed"));
    EXPECT_TRUE(holds(joined.errors, "Failed: scans/broken.ply: "));
    EXPECT_FALSE(exists(out + "/grain3.ply"));
    for (const std::string file : {"/grains.csv", "/shape.csv", "/summary.json"}) {
      EXPECT_EQ(content(out + file), content("whole" + file)) << file;
    }
  }
  // A part of other options is refused, and nothing is begun.
  fs::create_directory(path("mixed"));
  ASSERT_LE(run("batch scans -o mixed -q -n 61 -d 6 --shard 1/2").exit_code, 3);
  const Outcome other = run(std::string("batch scans -o mixed") + options_);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(holds(other.errors, "call-1-of-2.json"));
  EXPECT_FALSE(exists("mixed/grains.csv"));
  // Of a part that was cut, the whole makes what is missing.
  const std::string part = content("out2/grains-1-of-2.csv");
  fs::resize_file(folder_ / "out2/grains-1-of-2.csv", part.size() - 1);
  for (const char* table : {"out2/grains.csv", "out2/shape.csv"}) fs::remove(path(table));
  ASSERT_EQ(run(std::string("batch scans -o out2") + options_).exit_code, 3);
  EXPECT_EQ(content("out2/grains.csv"), content("whole/grains.csv"));
}

TEST_F(Batch, TellsRateAndTimeLeftOnATerminal) {
  write_scans(2);
  // It waits for the second grain, a pipe, with one done and one to come.
  const std::string kept = content(scan(1));
  fs::remove(folder_ / scan(1));
  ASSERT_EQ(mkfifo(path(scan(1)).c_str(), 0600), 0);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    if (chdir(folder_.c_str()) != 0) _exit(99);
    execl(WSCVT_PROGRAM, "wscvt", "batch", "scans", "-o", "out", "-n", "60", "-d", "6", nullptr);
    _exit(98);
  }
  std::string seen;
  const auto read_until = [&](const std::regex& wanted) {
    for (int tries = 0; tries < 300 && !std::regex_search(seen, wanted); ++tries) {
      pollfd waiting = {terminal, POLLIN, 0};
      char bytes[4096];
      const ssize_t count = poll(&waiting, 1, 100) > 0 ? read(terminal, bytes, sizeof bytes) : 0;
      if (count < 0) break;  // the program has ended
      seen.append(bytes, static_cast<std::size_t>(count));
    }
    return std::regex_search(seen, wanted);
  };
  EXPECT_TRUE(read_until(std::regex(
      "50 %  1 of 2 grains, [0-9.e-]+ per second, ([0-9]+ h )?([0-9]+ min )?([0-9]+ s )?left")))
      << seen;
  std::ofstream(folder_ / scan(1), std::ios::binary) << kept;
  EXPECT_TRUE(read_until(std::regex("2 grains: 2 remeshed"))) << seen;
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  close(terminal);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST_F(Batch, TwoDoNotWriteOneTable) {
  write_scans(2);
  fs::remove(folder_ / scan(1));
  ASSERT_EQ(mkfifo(path(scan(1)).c_str(), 0600), 0);
  const pid_t child =
      start({"batch", "scans", "-o", "out", "-q", "-n", "60", "-d", "6", "--describe", "remesh"});
  wait_for_rows("out/grains.csv", 2);
  const Outcome second = run(std::string("batch scans -o out") + options_);
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_TRUE(holds(second.errors, "another batch"));
  kill(child, SIGKILL);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
}

TEST_F(Batch, DoesNotRunAheadOfASlowGrain) {
  write_scans(1);
  ASSERT_EQ(mkfifo(path("slow.ply").c_str(), 0600), 0);
  write_links("more", 120);
  const pid_t child = start({"batch", "slow.ply", "more", "-o", "out", "-q", "-n", "60", "-d", "6",
                             "-t", "2", "--describe", "none"});
  wait_for_rows("out/grains.csv", 1);
  const auto made = [&] {
    fs::directory_iterator files(folder_ / "out");
    return std::count_if(begin(files), end(files), [](const fs::directory_entry& file) {
      return file.path().extension() == ".ply";
    });
  };
  // 32 grains of each thread, the slow one among them, and then none.
  for (int tries = 0; tries < 3000 && made() < 63; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_EQ(made(), 63);
  EXPECT_EQ(records("out/grains.csv").size(), 1U);
  kill(child, SIGKILL);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
}

TEST_F(Batch, MemoryDoesNotGrowWithTheNumberOfGrains) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep what is freed";
#endif
  write_scans(1);
  const auto peak = [&](int grains) {
    const std::string name = "scans" + std::to_string(grains);
    write_links(name, grains);
    const pid_t child = start({"batch", name, "-o", name + "_out", "-q", "-n", "60", "-d", "6",
                               "-t", "2", "--describe", "none"});
    int status = 0;
    rusage used{};
    EXPECT_EQ(wait4(child, &status, 0, &used), child);
    EXPECT_EQ(status, 0);
    return used.ru_maxrss;  // KiB
  };
  const long few = peak(20);
  const long many = peak(100);
  EXPECT_LT(many, few + 4096);
}

}  // namespace
}  // namespace wscvt
