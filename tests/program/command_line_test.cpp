// SPDX-License-Identifier: GPL-3.0-or-later
// The program as a whole: files in and out, exit codes, signals, sentences.
#include <pty.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "program_run.h"
#include "support/holds.h"
#include "wscvt/base/version.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::holds;

class CommandLine : public test::ProgramRun {
 protected:
  /// What the program shows on a terminal of so many columns, without carriage returns.
  std::string shown(std::vector<std::string> words, unsigned short columns,
                    const char* variable = nullptr) const {
    winsize size{};
    size.ws_row = 40;
    size.ws_col = columns;
    std::vector<char*> argv = {const_cast<char*>("wscvt")};
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
      if (chdir(folder_.c_str()) != 0) _exit(99);
      if (variable == nullptr) unsetenv("COLUMNS");
      if (variable != nullptr) setenv("COLUMNS", variable, 1);
      execv(WSCVT_PROGRAM, argv.data());
      _exit(98);
    }
    std::string text;
    std::array<char, 4096> bytes{};
    for (ssize_t count = 0; (count = read(terminal, bytes.data(), bytes.size())) > 0;) {
      text.append(bytes.data(), static_cast<std::size_t>(count));
    }
    EXPECT_EQ(waitpid(child, nullptr, 0), child);
    close(terminal);
    text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
    return text;
  }

  static std::size_t widest(const std::string& text) {
    std::size_t most = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) most = std::max(most, line.size());
    return most;
  }

  const std::string sand_ = "'" WSCVT_MESHES_DIR "/sand_7228.ply'";
};

TEST_F(CommandLine, HelpIsAsWideAsTheTerminal) {
  for (const char* command : {"remesh", "clump", "extract"}) {
    SCOPED_TRACE(command);
    for (const auto& [columns, width] : {std::pair(40, 60), {60, 60}, {80, 80}, {200, 120}}) {
      const std::string help = shown({command, "--help-all"}, static_cast<unsigned short>(columns));
      EXPECT_LE(widest(help), static_cast<std::size_t>(width)) << help;
      EXPECT_GE(widest(help), static_cast<std::size_t>(width) - 10) << help;
    }
    EXPECT_LE(widest(run(std::string(command) + " --help-all").output), 100U);
    EXPECT_LE(widest(shown({command, "--help"}, 200, "70")), 70U);
  }
  // A call that is broken runs when it is copied.
  EXPECT_TRUE(holds(shown({"clump", "--help"}, 70), " \\\n      "));
}

TEST_F(CommandLine, SentencesAreBrokenOnATerminalOnly) {
  // A cube without a side.
  std::ofstream(folder_ / "open.obj")
      << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
         "f 1 3 2\nf 1 4 3\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\n"
         "f 4 1 5\nf 4 5 8\n";
  const Outcome piped = run("remesh open.obj x.ply -n 100");
  EXPECT_EQ(std::count(piped.errors.begin(), piped.errors.end(), '\n'), 1) << piped.errors;
  EXPECT_GT(widest(piped.errors), 150U);
  for (const auto& [columns, width] : {std::pair(50, 50), {80, 80}, {200, 80}, {0, 80}}) {
    const std::string text = shown({"remesh", "open.obj", "x.ply", "-n", "100", "-q"},
                                   static_cast<unsigned short>(columns));
    EXPECT_LE(widest(text), static_cast<std::size_t>(width)) << text;
    EXPECT_GE(widest(text), static_cast<std::size_t>(width) - 12) << text;
    // The words are the same.
    EXPECT_EQ(std::regex_replace(text, std::regex("\n +"), " "), piped.errors);
  }
}

TEST_F(CommandLine, ALogIsBrokenOnceOnANarrowTerminal) {
  const std::vector<std::string> call = {"remesh", WSCVT_MESHES_DIR "/sand_7228.ply", "x.ply", "-n",
                                         "100"};
  const std::string piped = run("remesh " + sand_ + " x.ply -n 100").output;
  const std::regex seconds("Time +[^\n]*\n");
  // Progress is drawn over: "50 %  Stage", then the rest of the line is cleared.
  const std::regex progress("[0-9]+ %  [^\x1b]*\x1b\\[K|\x1b\\[K");
  for (const unsigned short columns : {50, 60, 80}) {
    SCOPED_TRACE(columns);
    const std::string log = std::regex_replace(shown(call, columns), progress, "");
    EXPECT_LE(widest(log.substr(log.find("Scan "))), columns) << log;
    const std::string joined = std::regex_replace(log, std::regex("\n +"), " ");
    EXPECT_EQ(std::regex_replace(joined.substr(joined.find("Scan ")), seconds, ""),
              std::regex_replace(piped, seconds, ""));
    // Only the last line of a sentence may have room for the next word.
    std::istringstream lines(log.substr(log.find("Scan ")));
    std::string before;
    for (std::string line; std::getline(lines, line); before = line) {
      const std::size_t begin = line.find_first_not_of(' ');
      if (begin == 0 || begin == std::string::npos) continue;
      const std::size_t word = std::min(line.find(' ', begin), line.size()) - begin;
      EXPECT_GT(before.size() + 1 + word, columns) << before << "\n" << line;
    }
  }
}

TEST_F(CommandLine, LogsAreShortAndTellSeconds) {
  const std::string two = sand_ + " '" WSCVT_MESHES_DIR "/angular_6000.ply'";
  const auto lines_of = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  const auto expect_short = [&](const std::string& call) {
    SCOPED_TRACE(call);
    const Outcome outcome = run(call);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_LE(lines_of(outcome.output), 12) << outcome.output;
    EXPECT_TRUE(std::regex_search(outcome.output, std::regex("(^|\n)Time +[0-9.e+-]+ s\n")))
        << outcome.output;
    return lines_of(outcome.output);
  };
  expect_short("remesh " + sand_ + " remesh.ply -n 100");
  expect_short("remesh " + sand_ +
               " remesh.ply -n 100 --report a.html --report a.json --report a.csv" +
               " --node-table n.csv --node-table n.vtp --sdf s.npy --coefficients b.json");
  expect_short("create ellipsoid e.ply -n 60");
  expect_short("batch " + two + " -o out -n 60,80,100");
  expect_short("batch " + two + " -o one -n 60");
  expect_short("clump " + sand_ + " -k 3 -o clump.csv");
  expect_short("clump " + two + " -k 3 -o clumps");
  expect_short("fragment " + sand_ + " -k 3 -o fragments");
  expect_short("grow one --templates -k 1 -n 60 -o chosen");
  // What is measured has more with -v.
  for (const std::string& call :
       {"describe " + sand_, "describe remesh.ply " + sand_, std::string("sample one"),
        std::string("sample out"), std::string("sample one out")}) {
    const auto count = expect_short(call);
    EXPECT_GT(lines_of(run(call + " -v").output), count) << call;
  }
}

TEST_F(CommandLine, RemeshesToTheExactCount) {
  const Outcome outcome = run(sand_ + " remesh.ply -n 300 --report report.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  const IndexedMesh mesh = read_mesh(path("remesh.ply"));
  EXPECT_EQ(mesh.points.size(), 300U);
  EXPECT_EQ(mesh.triangles.size(), 596U);
  EXPECT_TRUE(holds(outcome.output, "300 nodes, 596 faces"));
  EXPECT_TRUE(holds(content("report.json"), "wscvt-report"));
}

TEST_F(CommandLine, WritesReportsByTheirEndings) {
  const std::time_t before = std::time(nullptr);
  // Two grains in one table; the page and the other report are of the last.
  for (const std::string nodes : {"100", "120"}) {
    const Outcome outcome = run(sand_ + " remesh.ply -q -n " + nodes +
                                " --report page.html --report table.csv --report all.json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  }
  const std::string page = content("page.html");
  EXPECT_TRUE(holds(page, "sand_7228.ply with 120 nodes</title>"));
  EXPECT_TRUE(holds(page, "data:image/png;base64,"));
  const auto is_of_today = [&](std::time_t now) {
    std::array<char, 16> today{};
    std::strftime(today.data(), today.size(), "%Y-%m-%d", std::localtime(&now));
    return std::regex_search(page, std::regex("by wscvt [0-9.]+ on " + std::string(today.data())));
  };
  EXPECT_TRUE(is_of_today(before) || is_of_today(std::time(nullptr)));
  EXPECT_TRUE(holds(content("all.json"), "sand_7228.ply\""));
  const std::string table = content("table.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  // What cannot become a report is refused before the work, of a million nodes here.
  std::ofstream(folder_ / "other.csv") << "a,b\r\n";
  for (const std::string bad :
       {"report.pdf", "report", "other.csv", "remesh.ply", "no/page.html"}) {
    SCOPED_TRACE(bad);
    const Outcome outcome = run(sand_ + " remesh.ply -n 1000000 --report " + bad);
    EXPECT_EQ(outcome.exit_code, bad == "no/page.html" ? 1 : 2);
    EXPECT_TRUE(holds(outcome.errors, bad));
  }
  EXPECT_EQ(content("other.csv"), "a,b\r\n");
}

TEST_F(CommandLine, SaysItsVersion) {
  const Outcome outcome = run("--version");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, std::string("wscvt ") + version() + "\n");
  EXPECT_EQ(outcome.errors, "");
}

TEST_F(CommandLine, TellsAWrongCallFromWorkThatFails) {
  expect_refused("--report report.json",
                 {{"missing.ply remesh.ply -n 100", 1, "missing.ply"},
                  {sand_ + " remesh.ply --coefficients ./report.json", 2, "two names"},
                  {sand_ + " remesh.ply --coefficients g.txt", 2, "in .json"},
                  {sand_ + " o.xyz", 2, "o.xyz"},
                  {"scan.step remesh.ply", 2, "scan.step"},
                  {sand_ + " remesh.ply --report x.txt", 2, "x.txt"},
                  {sand_ + " remesh.ply --sdf x.txt", 2, "x.txt"},
                  {sand_ + " remesh.ply --node-table x.txt", 2, "x.txt"},
                  {sand_ + " remesh.ply --size 1 --scale 2", 2, "Give one of them"},
                  {sand_ + " remesh.ply --nodse 100", 2, "nodse"},
                  {sand_ + " remesh.ply more.ply", 2, "more.ply"},
                  {sand_, 2, "output"}},
                 {"remesh.ply", "report.json"});
}

TEST_F(CommandLine, TellsWhatACommandOrTheProgramLacks) {
  for (const auto& [call, words] :
       {std::pair("--versoin", "wscvt has no option --versoin. Did you mean --version?"),
        {"batch meshes", "--output is required. Give its name by -o."},
        {"sample a b c", "3 samples are given. Give one sample, or two to compare."}}) {
    const Outcome outcome = run(call);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(holds(outcome.errors, words));
  }
}

TEST_F(CommandLine, NeverReplacesTheScan) {
  fs::copy_file(WSCVT_MESHES_DIR "/sand_7228.ply", folder_ / "scan.ply");
  const std::string before = content("scan.ply");
  fs::create_symlink("scan.ply", folder_ / "link.ply");
  fs::create_hard_link(folder_ / "scan.ply", folder_ / "hard.ply");
  for (const std::string output : {"./scan.ply", "link.ply", "hard.ply"}) {
    const Outcome outcome = run("scan.ply " + output + " -n 100");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(holds(outcome.errors, "the scan itself. Give another name"));
    EXPECT_EQ(content("scan.ply"), before);
  }
  fs::create_symlink("scan.ply", folder_ / "scan.json");
  EXPECT_EQ(run("scan.ply remesh.ply -n 100 --report scan.json").exit_code, 2);
  EXPECT_EQ(content("scan.ply"), before);
}

TEST_F(CommandLine, WritesWhereItsPathsLead) {
  // A report through a dangling link must not overwrite the mesh it points to.
  fs::create_symlink("remesh.ply", folder_ / "link.json");
  const Outcome dangling = run(sand_ + " remesh.ply -n 100 --report link.json");
  EXPECT_EQ(dangling.exit_code, 2);
  EXPECT_TRUE(holds(dangling.errors, "two names"));
  fs::create_symlink("/dev/null", folder_ / "null.json");
  const Outcome null =
      run(sand_ + " remesh.ply -n 100 -q --report null.json --coefficients /dev/null");
  EXPECT_EQ(null.exit_code, 0) << null.errors;
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::create_symlink("/dev/stdout", folder_ / "out.json");
  const Outcome out = run(sand_ + " remesh.ply -n 100 -q --report out.json");
  EXPECT_EQ(out.exit_code, 0) << out.errors;
  EXPECT_EQ(out.output.front(), '{');
  const Outcome both = run(sand_ + " remesh.ply -n 100 --report out.json");
  EXPECT_EQ(both.exit_code, 0) << both.errors;
  EXPECT_EQ(both.output.front(), '{');
  EXPECT_TRUE(holds(both.output, "100 nodes, 196 faces"));
}

TEST_F(CommandLine, ChecksItsPathsBeforeTheWork) {
  // A million nodes would take long.
  for (const std::string bad : {"remesh.step", "remesh.ply --report no/folder/report.json",
                                "no/folder/remesh.ply", "remesh.ply --coefficients ."}) {
    SCOPED_TRACE(bad);
    const Outcome outcome = run("missing.ply " + bad + " -n 1000000");
    EXPECT_EQ(outcome.exit_code, bad == "remesh.step" ? 2 : 1);
    EXPECT_FALSE(holds(outcome.errors, "missing.ply"));
  }
}

TEST_F(CommandLine, NoTwoOutputsHaveOneName) {
  const std::vector<std::string> options = {"--coefficients", "--report", "--report", "--sdf"};
  for (std::size_t first = 0; first < options.size(); ++first) {
    for (std::size_t second = first + 1; second < options.size(); ++second) {
      std::string call = sand_ + " remesh.ply -n 1000000";
      for (std::size_t k = 0; k < options.size(); ++k) {
        call += " " + options[k] + " " + std::to_string(k == second ? first : k) + ".json";
      }
      SCOPED_TRACE(call);
      const Outcome outcome = run(call);
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_TRUE(holds(outcome.errors, "Give two names"));
    }
  }
}

TEST_F(CommandLine, AStandardOutputThatTakesNothingIsAnError) {
  for (const std::string where : {" >/dev/full", " >&-"}) {
    SCOPED_TRACE(where);
    const Outcome outcome = run(sand_ + " remesh.ply -n 100" + where + " 2>errors.txt #");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(holds(content("errors.txt"), "/dev/stdout"));
    EXPECT_EQ(run("--help" + where + " 2>errors.txt #").exit_code, 1);
  }
  // Closed streams do not take what is meant for a file.
  EXPECT_EQ(run(sand_ + " remesh.ply -n 100 -q <&- >&- 2>&- #").exit_code, 0);
  EXPECT_EQ(read_mesh((folder_ / "remesh.ply").string()).points.size(), 100U);
}

TEST_F(CommandLine, QuietHidesNoWarning) {
  const Outcome outcome = run(sand_ + " remesh.ply -n 4 -q");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, "");
  EXPECT_TRUE(holds(outcome.errors, "Warning: "));
  EXPECT_EQ(outcome.errors.find('\r'), std::string::npos) << "progress went into a file";
}

TEST_F(CommandLine, TakesPointsOnlyWhenTold) {
  IndexedMesh points = read_mesh(WSCVT_MESHES_DIR "/sand_7228.ply");
  points.triangles.clear();
  write_mesh(points, (folder_ / "points.ply").string());
  const Outcome refused = run("points.ply remesh.ply -n 100");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_TRUE(holds(refused.errors, "--points"));
  const Outcome told = run("points.ply remesh.ply -n 100 --points");  // the advice
  EXPECT_EQ(told.exit_code, 0) << told.errors;
  EXPECT_TRUE(holds(told.errors, "read as points"));
}

/// Starts the program in a folder, where said.txt gets what it says on the standard error.
template <class... Words>
pid_t start(const fs::path& folder, Words... words) {
  const pid_t child = fork();
  if (child == 0) {
    // Not inherited: the shell that started the test may ignore it.
    for (const int number : {SIGINT, SIGHUP}) std::signal(number, SIG_DFL);
    if (chdir(folder.c_str()) != 0) _exit(99);
    if (std::freopen("said.txt", "w", stderr) == nullptr) _exit(97);
    execl(WSCVT_PROGRAM, "wscvt", words..., nullptr);
    _exit(98);
  }
  return child;
}

/// What the program exits with; -1 when a signal ended it.
int exit_code_of(pid_t child) {
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Sends SIGTERM to the program as soon as it is ready, and expects that it ends by it.
void end_when(pid_t child, const std::function<bool()>& is_ready) {
  ASSERT_NE(child, -1);
  while (!is_ready()) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, WNOHANG), 0) << "it ended before it was ready";
  }
  ASSERT_EQ(kill(child, SIGTERM), 0);
  EXPECT_EQ(exit_code_of(child), 128 + SIGTERM);
}

TEST_F(CommandLine, SignalsCancelAndLeaveNothing) {
  // The program waits for a scan from a pipe, gets the signal, then the scan, and cancels.
  ASSERT_EQ(mkfifo((folder_ / "scan.ply").c_str(), 0600), 0);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    const pid_t child = start(folder_, "scan.ply", "remesh.ply", "-n", "1000", "-q");
    ASSERT_NE(child, -1);
    {
      std::ofstream scan(folder_ / "scan.ply", std::ios::binary);  // opens when the program does
      ASSERT_EQ(kill(child, number), 0);
      scan << std::ifstream(WSCVT_MESHES_DIR "/sand_7228.ply", std::ios::binary).rdbuf();
    }
    EXPECT_EQ(exit_code_of(child), 128 + number);
    fs::directory_iterator left(folder_);
    EXPECT_EQ(std::distance(begin(left), end(left)), 2)
        << "something is left beside the scan and what the program said";
    const std::string said = content("said.txt");
    EXPECT_EQ(said.rfind("Cancelled during: ", 0), 0U) << said;
    EXPECT_TRUE(holds(said, ". Nothing was written.\n"));
  }
}

TEST_F(CommandLine, ASignalThatIsIgnoredFromTheStartDoesNotEndTheProgram) {
  ASSERT_EQ(mkfifo((folder_ / "scan.ply").c_str(), 0600), 0);
  for (const int number : {SIGINT, SIGHUP}) {  // a shell's background, nohup
    const auto before = std::signal(number, SIG_IGN);
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.c_str()) != 0) _exit(99);
      execl(WSCVT_PROGRAM, "wscvt", "scan.ply", "remesh.ply", "-n", "100", "-q", nullptr);
      _exit(98);
    }
    std::signal(number, before);
    ASSERT_NE(child, -1);
    {
      std::ofstream scan(folder_ / "scan.ply", std::ios::binary);  // opens when the program does
      ASSERT_EQ(kill(child, number), 0);
      scan << std::ifstream(WSCVT_MESHES_DIR "/sand_7228.ply", std::ios::binary).rdbuf();
    }
    EXPECT_EQ(exit_code_of(child), 0);
    EXPECT_EQ(read_mesh(path("remesh.ply")).points.size(), 100U);
    fs::remove(folder_ / "remesh.ply");
  }
}

TEST_F(CommandLine, ACancelledCreationSaysWhereItWas) {
  const pid_t child = start(folder_, "create", "superellipsoid", "made.ply", "-n", "200000", "-q");
  // As soon as the program notes the signal, before it has told of anything.
  const auto notes_signals = [&] {
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (line.rfind("SigCgt:", 0) != 0) continue;
      return (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1U) != 0;
    }
    return false;
  };
  end_when(child, notes_signals);
  const std::string said = content("said.txt");
  EXPECT_EQ(said.rfind("Cancelled", 0), 0U) << said;
  EXPECT_FALSE(holds(said, ": ."));
  EXPECT_TRUE(holds(said, ". Nothing was written.\n"));
  EXPECT_FALSE(exists("made.ply"));
}

TEST_F(CommandLine, SignalsAreHeardBetweenFiles) {
  // Signed distances at 12 million points take minutes; the remesh is there before them.
  const pid_t child =
      start(folder_, WSCVT_MESHES_DIR "/sand_7228.ply", "remesh.ply", "-n", "100", "-q", "--size",
            "1", "--node-table", "nodes.csv", "--sdf", "grid.npy", "--sdf-spacing", "0.005");
  end_when(child, [&] { return exists("nodes.csv"); });
  EXPECT_EQ(read_mesh(path("remesh.ply")).points.size(), 100U);
  EXPECT_FALSE(exists("grid.npy"));
  const std::string said = content("said.txt");
  EXPECT_EQ(said.rfind("Cancelled during: ", 0), 0U) << said;
  EXPECT_TRUE(holds(said, ". Written before that: \"remesh.ply\", \"nodes.csv\".\n"));
}

TEST_F(CommandLine, ASignalAfterManyFilesNamesFiveOfThem) {
  const pid_t child =
      start(folder_, WSCVT_MESHES_DIR "/sand_7228.ply", "remesh.ply", "-n", "100", "-q", "--size",
            "1", "--node-table", "1.csv", "--node-table", "2.csv", "--node-table", "3.csv",
            "--node-table", "4.csv", "--node-table", "5.csv", "--node-table", "6.csv", "--sdf",
            "grid.npy", "--sdf-spacing", "0.005");
  end_when(child, [&] { return exists("6.csv"); });
  const std::string said = content("said.txt");
  EXPECT_TRUE(holds(said,
                    "before that: \"remesh.ply\", \"1.csv\", \"2.csv\", \"3.csv\", "
                    "\"4.csv\", and 2 other files.\n"))
      << said;
}

TEST_F(CommandLine, SeveralScansAreABatch) {
  std::filesystem::create_directory(folder_ / "scans");
  const char* const names[] = {"scans/a.ply", "scans/b.ply", "scans/c.ply", "scans/d.ply"};
  double longest = 1.0;
  for (const char* name : names) {
    ASSERT_EQ(run("create ellipsoid " + std::string(name) + " -n 90 --semi-axes 0.7 0.9 " +
                  std::to_string(longest += 0.1))
                  .exit_code,
              0);
  }
  const std::string all = "scans/a.ply scans/b.ply scans/c.ply scans/d.ply ";
  struct Call {
    std::string words;
    std::string as_batch;  // that the notice shows
    std::size_t remeshes;
  };
  for (const Call& call :
       {Call{"scans out.1 -n 40", "batch scans -o out.1 -n 40", 4},
        Call{"scans -n 40 -oout.2", "batch scans -n 40 -oout.2", 4},
        Call{"'scans/[ac].ply' out.3 -n 40", "batch scans/[ac].ply -o out.3 -n 40", 2},
        Call{"scans/a.ply scans/d.ply out.4 -n 40", "batch scans/a.ply scans/d.ply -o out.4 -n 40",
             2},
        Call{"scans/a.ply scans/d.ply --output=out.5 -n 40",
             "batch scans/a.ply scans/d.ply --output=out.5 -n 40", 2},
        Call{all + "out.6 -n 40", "batch scans/a.ply scans/b.ply ... -o out.6 -n 40", 4}}) {
    SCOPED_TRACE(call.words);
    const Outcome outcome = run(call.words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_TRUE(holds(outcome.errors, "This is \"wscvt " + call.as_batch + "\""));
    const std::string out = call.words.substr(call.words.find("out."), 5);
    std::size_t remeshes = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder_ / out)) {
      remeshes += file.path().extension() == ".ply" ? 1 : 0;
    }
    EXPECT_EQ(remeshes, call.remeshes);
    EXPECT_EQ(read_mesh(path(out + "/a.ply")).points.size(), 40U);
  }
  EXPECT_EQ(run("scans out.1 -n 40 --quiet").errors, "");

  // "wscvt *.ply" without an output would take the last scan for it.
  const std::string scan = content("scans/d.ply");
  for (const std::string& words :
       std::vector<std::string>{all, "scans scans/d.ply", "scans new.ply", all + "new.ply"}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_TRUE(holds(outcome.errors, "is the name of a file. Put the name of a folder last"));
  }
  EXPECT_EQ(content("scans/d.ply"), scan);
  EXPECT_FALSE(exists("new.ply"));
}

TEST_F(CommandLine, HelpsWhoSlipsOrBringsAFolder) {
  const auto refusal = [&](const std::string& words) {
    const Outcome call = run(words);
    EXPECT_EQ(call.exit_code, 2) << words;
    return call.errors;
  };
  EXPECT_TRUE(holds(refusal("remsh a.ply b.ply"), "Did you mean remesh?"));
  EXPECT_TRUE(holds(refusal("descirbe a.ply"), "Did you mean describe?"));
  EXPECT_FALSE(holds(refusal("simplify a.ply b.ply"), "Did you mean"));
  EXPECT_TRUE(holds(refusal("help remsh"), "Did you mean remesh?"));
  std::filesystem::create_directory(folder_ / "scans.d");
  EXPECT_TRUE(holds(refusal("scans.d"), "wscvt batch scans.d -o OUT"));
  EXPECT_TRUE(holds(refusal("scans.d -n 300"), "wscvt batch scans.d -o OUT"));
  EXPECT_TRUE(holds(refusal("a.ply b.ply --noeds=5"), "Did you mean --nodes?"));
  EXPECT_TRUE(holds(refusal("describe a.ply --nodes 5"), "wscvt describe has no option --nodes."));
  // Only what the help of the command shows is proposed.
  EXPECT_TRUE(holds(refusal("remesh a.ply b.ply --helpall"), "Did you mean --help-all?"));
  EXPECT_FALSE(holds(refusal("sample a.csv --helpall"), "Did you mean"));
  EXPECT_TRUE(holds(refusal("remesh a.ply b.ply --faces 9"), "\"wscvt remesh --help-all\" lists"));
  EXPECT_TRUE(holds(refusal("sample a.csv --faces 9"), "\"wscvt sample --help\" lists all"));
  EXPECT_EQ(run("help batch").output, run("batch --help").output);
  EXPECT_EQ(run("help").output, run("--help").output);
  EXPECT_EQ(run("-v").output, run("--version").output);
  EXPECT_TRUE(holds(run("-v none.ply b.ply").errors, "none.ply")) << "--verbose";
}

}  // namespace
}  // namespace wscvt
