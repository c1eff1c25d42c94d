// SPDX-License-Identifier: GPL-3.0-or-later
// What the machine refuses: threads, room on the disk, memory. It is never a grain's failure, and
// the same call goes on once there is enough.
#include <sys/mount.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "limited_run.h"
#include "program_run.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/made_volume.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Call = std::vector<std::string>;
using test::holds;

class MachineRefusals : public test::LimitedRun {
 protected:
  /// Scans of different bodies: scans/a.ply, scans/b.ply, ...
  void write_scans(int count, int subdivisions = 3) const {
    fs::create_directory(folder_ / "scans");
    for (int k = 0; k < count; ++k) {
      const Vector3 axes(1.0, 0.9 - 0.02 * k, 0.7);
      write_mesh(test::scaled(test::sphere(subdivisions), axes), path(scan(k)));
    }
  }
  static std::string scan(int k) {
    return "scans/" + std::string(1, static_cast<char>('a' + k)) + ".ply";
  }

  /// Three balls apart from each other.
  void write_volume() const {
    test::MadeVolume volume({64, 40, 40});
    volume.fill_ball(3, {15, 20, 20}, 10.0);
    volume.fill_ball(8, {35, 20, 22}, 8.0);
    volume.fill_ball(5, {52, 19, 20}, 7.0);
    test::write_bytes(folder_ / "sample.nrrd", test::nrrd(volume, "spacings: 1 1 1\n"));
  }

  std::size_t failed_rows(const std::string& table) const {
    if (!exists(table)) return 0;
    std::size_t failed = 0;
    for (const auto& row : test::csv_records(content(table))) failed += row.at(1) == "failed";
    return failed;
  }

  void expect_same(const std::string& folder, const std::string& whole) const {
    for (const auto& file : fs::directory_iterator(folder_ / whole)) {
      const std::string name = "/" + file.path().filename().string();
      EXPECT_EQ(content(folder + name), content(whole + name)) << name;
    }
    EXPECT_EQ(parts(), Call());
  }

  /// That the call was stopped, wrote down no grain as failed, and goes on to what an undisturbed
  /// one makes.
  void expect_stopped_and_going_on(const Outcome& stopped, const std::string& call,
                                   const std::string& whole) const {
    EXPECT_EQ(stopped.exit_code, 1) << stopped.errors;
    EXPECT_EQ(stopped.errors.rfind("Stopped after ", 0), 0U) << stopped.errors;
    EXPECT_TRUE(holds(stopped.errors, "The same call "));
    EXPECT_EQ(failed_rows("out/grains.csv"), 0U);
    EXPECT_EQ(parts(), Call());
    const Outcome again = run(call);
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    expect_same("out", whole);
  }
};

TEST_F(MachineRefusals, WorkGoesOnWithTheThreadsThatItGets) {
  write_scans(5);
  write_volume();
  const bool is_root = getuid() == 0;
  // Other users may have processes, which count: but one is always too many for a thread.
  for (const rlim_t most : is_root ? std::vector<rlim_t>{1, 3} : std::vector<rlim_t>{1}) {
    SCOPED_TRACE(most);
    const std::vector<Limit> limits = {{RLIMIT_NPROC, most}};
    const auto expect_done = [&](const std::string& out, const Call& words) {
      Call call = words;
      call.insert(call.end(), {"-q", "-t", "14"});
      const Outcome outcome = run_limited(call, limits, true);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
      if (outcome.exit_code == 0 && !exists("whole_" + out)) {
        fs::rename(folder_ / out, folder_ / ("whole_" + out));
        EXPECT_EQ(run_limited(call, {}, true).exit_code, 0);
      }
      if (fs::is_directory(folder_ / out)) return expect_same(out, "whole_" + out);
      EXPECT_EQ(content(out), content("whole_" + out)) << out;
    };
    const std::string n = std::to_string(most);
    expect_done("batch", {"batch", "scans", "-o", "batch", "-n", "60"});
    expect_done("dense", {"extract", "sample.nrrd", "dense"});
    expect_done("remeshed", {"batch", "sample.nrrd", "-o", "remeshed", "-n", "60"});
    expect_done("remesh.ply", {"remesh", "scans/a.ply", "remesh.ply", "-n", "60"});
    expect_done("create.ply", {"create", "ellipsoid", "create.ply", "-n", "60"});
    expect_done("shape.csv", {"describe", "scans/a.ply", "--report", "shape.csv"});
    for (const char* made :
         {"batch", "dense", "remeshed", "remesh.ply", "create.ply", "shape.csv"}) {
      fs::remove_all(folder_ / made);
    }
  }
}

TEST_F(MachineRefusals, AFileOfABatchThatCannotBeReadChangesNothing) {
  write_scans(2);
  ASSERT_EQ(run("batch scans -o out -q -n 60").exit_code, 0);
  const std::string rows = content("out/grains.csv");
  // A file of Linux that can be opened, and whose first byte cannot be read.
  fs::remove(folder_ / "out/call.json");
  fs::create_symlink("/proc/self/mem", folder_ / "out/call.json");
  const Outcome stopped = run("batch scans -o out -q -n 60");
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_TRUE(holds(stopped.errors, "call.json\" could not be read to its end. Check the disk."));
  EXPECT_EQ(content("out/grains.csv"), rows);
}

TEST_F(MachineRefusals, AFullDiskStopsABatchWhichThenGoesOn) {
  write_scans(3);
  const std::string call = "batch scans -o out -q --describe none -n 1500 --format off";
  ASSERT_EQ(run("batch scans -o whole -q --describe none -n 1500 --format off").exit_code, 0);
  // The limit of a file's size, in place of a disk that is full: the table fits, a mesh does not.
  const rlim_t most = 40000;
  ASSERT_GT(fs::file_size(folder_ / "whole/a.off"), most);
  ASSERT_LT(fs::file_size(folder_ / "whole/grains.csv"), most);
  const Outcome stopped = run_limited({"batch", "scans", "-o", "out", "-q", "--describe", "none",
                                       "-n", "1500", "--format", "off", "-t", "2"},
                                      {{RLIMIT_FSIZE, most}});
  EXPECT_TRUE(holds(stopped.errors, "ulimit -f"));
  expect_stopped_and_going_on(stopped, call, "whole");
}

TEST_F(MachineRefusals, AFullDiskStopsAnExtractionWhichThenGoesOn) {
  write_volume();
  ASSERT_EQ(run("batch sample.nrrd -o whole -q --describe none -n 1500 --format off").exit_code, 0);
  const Outcome stopped = run_limited({"batch", "sample.nrrd", "-o", "out", "-q", "--describe",
                                       "none", "-n", "1500", "--format", "off"},
                                      {{RLIMIT_FSIZE, 40000}});
  expect_stopped_and_going_on(
      stopped, "batch sample.nrrd -o out -q --describe none -n 1500 --format off", "whole");
  ASSERT_EQ(run("extract sample.nrrd dense -q").exit_code, 0);
  fs::remove_all(folder_ / "out");
  const Outcome dense =
      run_limited({"extract", "sample.nrrd", "out", "-q"}, {{RLIMIT_FSIZE, 40000}});
  EXPECT_FALSE(exists("out/labels.csv"));
  expect_stopped_and_going_on(dense, "extract sample.nrrd out -q", "dense");
}

TEST_F(MachineRefusals, ADiskThatFillsWithinABatchDoesNotFailItsGrains) {
  write_scans(4);
  fs::create_directory(folder_ / "disk");
  if (mount("none", path("disk").c_str(), "tmpfs", 0, "size=80k") != 0) {
    GTEST_SKIP() << "a disk of its own takes root";
  }
  ASSERT_EQ(run("batch scans -o whole -q --describe none -n 700").exit_code, 0);  // 36 KB a mesh
  const std::string call = "batch scans -o disk/out -q --describe none -n 700";
  const Outcome full = run(call + " -t 1");
  EXPECT_EQ(full.exit_code, 1) << full.errors;
  EXPECT_EQ(failed_rows("disk/out/grains.csv"), 0U);
  EXPECT_TRUE(holds(full.errors, "space on the disk"));
  EXPECT_EQ(full.errors.rfind("Stopped after 1 of 4 grains. ", 0), 0U) << full.errors;
  EXPECT_EQ(mount("none", path("disk").c_str(), "tmpfs", MS_REMOUNT, "size=4m"), 0);
  const Outcome again = run(call);
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  expect_same("disk/out", "whole");
  umount(path("disk").c_str());
}

TEST_F(MachineRefusals, AnOutputFolderThatIsGoneForAMomentStopsABatch) {
  write_scans(4);
  ASSERT_EQ(run("batch scans -o whole -q --describe none -n 60").exit_code, 0);
  // The third grain is a pipe that gives nothing until the folder is away.
  const std::string third = content(scan(2));
  fs::remove(folder_ / scan(2));
  ASSERT_EQ(mkfifo(path(scan(2)).c_str(), 0600), 0);
  const pid_t child = start_limited(
      {"batch", "scans", "-o", "out", "-q", "--describe", "none", "-n", "60", "-t", "1"}, {});
  for (int tries = 0; tries < 3000 && !exists("out/b.ply"); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  {
    std::ofstream pipe(folder_ / scan(2), std::ios::binary);  // opens when the program does
    fs::rename(folder_ / "out", folder_ / "away");
    pipe << third;
  }
  const Outcome stopped = outcome_of(child);
  EXPECT_TRUE(holds(stopped.errors, "Check that the folder exists"));
  fs::rename(folder_ / "away", folder_ / "out");
  fs::remove(folder_ / scan(2));
  std::ofstream(folder_ / scan(2), std::ios::binary) << third;
  expect_stopped_and_going_on(stopped, "batch scans -o out -q --describe none -n 60", "whole");
}

TEST_F(MachineRefusals, AnInputFolderThatIsGoneForAMomentStopsABatch) {
  write_scans(3);
  ASSERT_EQ(
      run("batch scans/a.ply scans/b.ply scans/c.ply -o whole -q --describe none -n 60").exit_code,
      0);
  fs::create_directory(folder_ / "first");
  fs::rename(folder_ / scan(0), folder_ / "kept.ply");
  const std::string first = content("kept.ply");
  ASSERT_EQ(mkfifo(path(scan(0)).c_str(), 0600), 0);
  const pid_t child = start_limited({"batch", "scans/a.ply", "scans/b.ply", "scans/c.ply", "-o",
                                     "out", "-q", "--describe", "none", "-n", "60", "-t", "1"},
                                    {});
  {
    std::ofstream pipe(folder_ / scan(0), std::ios::binary);
    fs::rename(folder_ / "scans", folder_ / "away");
    pipe << first;
  }
  const Outcome stopped = outcome_of(child);
  EXPECT_TRUE(holds(stopped.errors, "the folder \"scans\" is not there"));
  fs::rename(folder_ / "away", folder_ / "scans");
  fs::remove(folder_ / scan(0));
  fs::rename(folder_ / "kept.ply", folder_ / scan(0));
  expect_stopped_and_going_on(
      stopped, "batch scans/a.ply scans/b.ply scans/c.ply -o out -q --describe none -n 60",
      "whole");
}

TEST_F(MachineRefusals, MemoryIsNeverAGrainsFailure) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  write_scans(2, 4);
  const Call call = {"batch", "scans", "-o", "out", "-q", "--describe",
                     "none",  "-n",    "60", "-t",  "2"};
  ASSERT_EQ(run("batch scans -o whole -q --describe none -n 60").exit_code, 0);
  bool has_stopped = false;
  // From what is enough down to what the program does not start with: its libraries take 48 MB of
  // addresses, and some of them end a program that has less before it begins.
  for (rlim_t megabytes = 60; megabytes > 10; --megabytes) {
    SCOPED_TRACE(megabytes);
    if (run_limited({"--version"}, {{RLIMIT_AS, megabytes << 20U}}).exit_code != 0) break;
    const Outcome outcome = run_limited(call, {{RLIMIT_AS, megabytes << 20U}});
    EXPECT_EQ(failed_rows("out/grains.csv"), 0U);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1)
        << outcome.exit_code << outcome.errors;
    if (outcome.exit_code == 0) expect_same("out", "whole");
    if (outcome.exit_code == 1) {
      EXPECT_TRUE(holds(outcome.errors, "not enough memory"));
      has_stopped = true;
      EXPECT_EQ(run("batch scans -o out -q --describe none -n 60").exit_code, 0);
      expect_same("out", "whole");
    }
    fs::remove_all(folder_ / "out");
  }
  EXPECT_TRUE(has_stopped);
}

TEST_F(MachineRefusals, MemoryThatIsRefusedIsASentenceOfEachCommand) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  // Smaller scans need less than the start of the program.
  write_scans(1, 6);
  const std::vector<Call> calls = {
      {"remesh", "scans/a.ply", "made.ply", "-n", "60", "-q"},
      {"describe", "scans/a.ply", "-q", "--report", "made.json"},
      {"describe", "scans/a.ply", "scans/a.ply", "-q", "--report", "made.json"},
      {"create", "ellipsoid", "made.ply", "-n", "3000", "-q"}};
  for (const Call& call : calls) {
    SCOPED_TRACE(call.front());
    bool was_said = false;
    for (rlim_t megabytes = 60; megabytes > 10 && !was_said; --megabytes) {
      const Outcome outcome = run_limited(call, {{RLIMIT_AS, megabytes << 20U}});
      if (outcome.exit_code == 0) {
        for (const char* made : {"made.ply", "made.json"}) fs::remove(folder_ / made);
        continue;
      }
      EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
      EXPECT_EQ(outcome.errors.rfind("There is not enough memory for this call. ", 0), 0U)
          << outcome.errors;
      EXPECT_FALSE(exists("made.ply") || exists("made.json"));
      was_said = true;
    }
    EXPECT_TRUE(was_said);
  }
}

TEST_F(MachineRefusals, FilesBeyondTheLimitOfTheirSizeAreASentence) {
  write_scans(1);
  write_volume();
  std::ofstream(folder_ / "made.json") << "what was there";
  const std::vector<Call> calls = {{"remesh", "scans/a.ply", "made.ply", "-n", "60", "-q"},
                                   {"describe", "scans/a.ply", "-q", "--report", "made.json"},
                                   {"describe", "scans/a.ply", "-q", "--report", "made.csv"},
                                   {"create", "ellipsoid", "made.ply", "-n", "60", "-q"},
                                   {"batch", "scans", "-o", "out", "-q"},
                                   {"extract", "sample.nrrd", "grains", "-q"}};
  for (const Call& call : calls) {
    SCOPED_TRACE(call.front());
    const Outcome outcome = run_limited(call, {{RLIMIT_FSIZE, 300}});
    EXPECT_EQ(outcome.exit_code, 1) << "a signal ends the program: " << outcome.errors;
    EXPECT_TRUE(holds(outcome.errors, "could not be written completely"));
    EXPECT_FALSE(exists("made.ply") || exists("made.csv"));
    EXPECT_EQ(content("made.json"), "what was there");
    EXPECT_EQ(parts(), Call());
  }
}

TEST_F(MachineRefusals, WhatAKilledExtractionLeftGoesWithTheNext) {
  write_volume();
  ASSERT_EQ(run("extract sample.nrrd whole -q").exit_code, 0);
  fs::create_directory(folder_ / "out");
  for (const char* left : {"out/3.ply.part", "out/5.ply.part", "out/labels.csv.part"}) {
    std::ofstream(folder_ / left) << "half";
  }
  std::ofstream(folder_ / "out/other.ply.part") << "somebody's";
  ASSERT_EQ(run("extract sample.nrrd out -q").exit_code, 0);
  EXPECT_EQ(parts(), Call{"other.ply.part"});
  fs::remove(folder_ / "out/other.ply.part");
  expect_same("out", "whole");
}

class ScanMemory : public test::ProgramRun {};

/// A mesh takes 48 bytes a vertex. The largest need is for a scan and its copy that is coarsened,
/// with their links and areas: 164. A tree of the scan's faces alone takes 260 or more.
TEST_F(ScanMemory, OfARemeshIsLessThanFourAndAHalfMeshes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep what is freed";
#endif
  const auto peak = [&](const IndexedMesh& scan) {
    write_mesh(scan, path("scan.ply"));
    // By a small process: what a child has of ours until it becomes the program counts as its own.
    const std::string command = "cd '" + folder_.string() +
                                "' && /usr/bin/time -f %M -o peak.txt '" WSCVT_PROGRAM
                                "' remesh scan.ply out.ply -q -t 1 -n 100";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return 1024.0 * std::stod(content("peak.txt"));
  };
  const IndexedMesh small = test::lumpy(6);
  const IndexedMesh large = test::lumpy(7);
  const double more = peak(large) - peak(small);
  const auto vertices = static_cast<double>(large.points.size() - small.points.size());
  EXPECT_LT(more / vertices, 4.5 * 48.0);
}

}  // namespace

}  // namespace wscvt
