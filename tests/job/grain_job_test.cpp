// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grain_job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "toolbox/job/grain_files.h"
#include "toolbox/report/sample_table.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::holds;

/// Grains of one point, whose x is the number of the grain. With `scans`, each is read from a file
/// in this folder.
class Points : public GrainSource {
 public:
  explicit Points(std::size_t count, fs::path scans = {})
      : count_(count), scans_(std::move(scans)) {}
  std::string file(std::size_t grain) const override {
    return scans_.empty() ? "" : (scans_ / std::to_string(grain)).string();
  }
  std::size_t size() const override { return count_; }
  std::string name(std::size_t grain) const override {
    return "folder/grain" + std::to_string(grain) + ".ply";
  }
  void want(const std::vector<std::size_t>& grains) override { wanted_ = grains; }
  GrainScan read(std::size_t grain, bool with_pictures, const Execution&) override {
    has_pictures_ = with_pictures;
    GrainScan scan;
    scan.mesh.points = {Vector3(static_cast<double>(grain), 0.0, 0.0)};
    return scan;
  }
  std::string census(const MadeOf& made_of) const override {
    return "what,file\r\n" + made_of(name(0)).file + "," + made_of(name(1)).file + "\r\n";
  }

  std::vector<std::size_t> wanted_;
  std::atomic<bool> has_pictures_{false};  ///< whether the last was read with them

 private:
  std::size_t count_;
  fs::path scans_;
};

class Job : public test::FileFolder {
 protected:
  /// A job whose files contain the grain's number, with two tables.
  GrainJob number_job(const std::string& folder) const {
    GrainJob job;
    job.folder = (folder_ / folder).string();
    job.ending = "txt";
    job.call = "the options\n";
    job.tables = {{"grains", sample_header("number\r\n0\r\n")},
                  {"other", "grain,status,twice\r\n"}};
    job.make = [](GrainAtWork& grain) -> std::vector<std::string> {
      const int number = static_cast<int>(grain.scan.mesh.points.front().x());
      // Later grains are done earlier.
      std::this_thread::sleep_for(std::chrono::microseconds(number % 3 == 0 ? 900 : 10));
      write_file(grain.folders.front().file_of(grain.name), std::to_string(number));
      return {sample_row(grain.name, "number\r\n" + std::to_string(number) + "\r\n"),
              grain.name + ",done," + std::to_string(2 * number) + "\r\n"};
    };
    job.failed = [](const std::string& grain,
                    const std::string& error) -> std::vector<std::string> {
      return {failed_row(grain, error, "number\r\n0\r\n"), grain + ",failed,\r\n"};
    };
    return job;
  }
};

TEST_F(Job, HasTheSameFilesAtAnyNumberOfThreadsInTheOrderOfTheGrains) {
  for (const int threads : {1, 2, 7}) {
    Points grains(100);
    const std::string out = "out" + std::to_string(threads);
    const JobEnd end = run_job(number_job(out), grains, {threads});
    EXPECT_EQ(end.done, 100U);
    EXPECT_EQ(end.failed, 0U);
    for (const std::string name : {"/grains.csv", "/other.csv", "/grain57.txt", "/call.json"}) {
      EXPECT_EQ(content(out + name), content("out1" + name)) << name;
    }
  }
  std::string expected = "grain,status,twice\r\n";
  for (int k = 0; k < 100; ++k) {
    expected += "folder/grain" + std::to_string(k) + ".ply,done," + std::to_string(2 * k) + "\r\n";
  }
  EXPECT_EQ(content("out1/other.csv"), expected);
  EXPECT_EQ(content("out1/grain99.txt"), "99");
}

TEST_F(Job, TablesHaveTheUnitOfTheGrains) {
  class PointsInMillimetres : public Points {
   public:
    using Points::Points;
    std::string unit() const override { return "mm"; }
  };
  GrainJob job = number_job("out");
  job.tables[1].header = "grain,status,twice [length^2],length [length]\r\n";
  PointsInMillimetres grains(2);
  EXPECT_EQ(run_job(job, grains, {1}).done, 2U);
  EXPECT_TRUE(holds(content("out/other.csv"), "grain,status,twice [mm^2],length [mm]\r\n"));
  EXPECT_EQ(run_job(job, grains, {1}).done, 2U);
  Points without(2);
  job.folder = (folder_ / "without").string();
  run_job(job, without, {1});
  EXPECT_TRUE(holds(content("without/other.csv"), job.tables[1].header));
}

TEST_F(Job, GoesOnWhereItWasCut) {
  Points whole(20);
  GrainJob job = number_job("whole");
  job.has_census = true;
  run_job(job, whole, {2});
  EXPECT_EQ(content("whole/labels.csv"), "what,file\r\ngrain0.txt,grain1.txt\r\n");
  // Cancelled, then cut within a row of one table.
  GrainJob begun = number_job("out");
  std::atomic<int> made{0};
  begun.make = [&, make = begun.make](GrainAtWork& grain) {
    ++made;
    return make(grain);
  };
  Points first(20);
  JobHost host{1};
  host.is_cancelled = [&] { return made >= 12; };
  const JobEnd end = run_job(begun, first, host);
  EXPECT_TRUE(end.was_cancelled());
  const auto done = static_cast<std::size_t>(end.done);
  ASSERT_GE(done, 10U);
  ASSERT_LT(done, 20U);
  const fs::path table = folder_ / "out/other.csv";
  fs::resize_file(table, fs::file_size(table) - 5);
  write_file((folder_ / "out/grain19.txt.part").string(), "half");
  made = 0;
  Points second(20);
  const JobEnd again = run_job(begun, second, {2});
  EXPECT_FALSE(again.was_cancelled());
  EXPECT_EQ(static_cast<std::size_t>(made), 20 - done + 1) << "made anew";
  EXPECT_EQ(second.wanted_.front(), done - 1);
  EXPECT_EQ(second.wanted_.size(), 20 - done + 1);
  for (const std::string name : {"/grains.csv", "/other.csv", "/grain13.txt"}) {
    EXPECT_EQ(content("out" + name), content("whole" + name)) << name;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out/grain19.txt.part"));
  // Killed between the rows of a grain: the first table is written last.
  const fs::path last = folder_ / "out/grains.csv";
  fs::resize_file(last, fs::file_size(last) - 5);
  made = 0;
  Points third(20);
  run_job(begun, third, {1});
  EXPECT_EQ(made, 1);
  for (const std::string name : {"/grains.csv", "/other.csv"}) {
    EXPECT_EQ(content("out" + name), content("whole" + name)) << name;
  }
}

TEST_F(Job, MakesFilesAgainThatAreMissingOrEmpty) {
  GrainJob job = number_job("out");
  std::atomic<int> made{0};
  job.make = [&, make = job.make](GrainAtWork& grain) {
    if (grain.name == "folder/grain2.ply") throw Error(ErrorCode::InvalidInput, "No grain.");
    ++made;
    return make(grain);
  };
  Points grains(10);
  run_job(job, grains, {1});
  const std::string table = content("out/grains.csv");
  fs::remove(folder_ / "out/grain7.txt");
  write_file((folder_ / "out/grain5.txt").string(), "");
  made = 0;
  run_job(job, grains, {1});
  EXPECT_EQ(made, 5) << "from grain 5 on; grain 2 failed and has no file";
  EXPECT_EQ(content("out/grain5.txt"), "5");
  EXPECT_EQ(content("out/grain7.txt"), "7");
  EXPECT_EQ(content("out/grains.csv"), table);
  fs::remove(folder_ / "out/grain0.txt");
  made = 0;
  run_job(job, grains, {1});
  EXPECT_EQ(made, 9) << "all but the failed";
  // One of several files too.
  job.folder = (folder_ / "more").string();
  job.more_files = {{"tables", "csv"}, {"grids", "json"}};
  const std::string more = (folder_ / "more/tables").string();
  job.make = [&, make = job.make](GrainAtWork& grain) {
    const JobFolder& place = grain.folders.front();
    const std::vector<std::string> rows = make(grain);
    write_file(place.file_of(grain.name, {"tables", "csv"}), grain.name + "\n");
    write_file(place.file_of(grain.name, {"grids", "json"}), "{}\n");
    return rows;
  };
  run_job(job, grains, {1});
  made = 0;
  run_job(job, grains, {1});
  EXPECT_EQ(made, 0);
  fs::remove(more + "/grain8.csv");
  const std::vector<std::string> halves = {more + "/grain9.csv.part",
                                           job.folder + "/summary.html.part"};
  for (const std::string& half : halves) write_file(half, "half");
  run_job(job, grains, {1});
  for (const std::string& half : halves) EXPECT_FALSE(fs::exists(half)) << half;
  EXPECT_EQ(made, 2) << "from grain 8 on";
  EXPECT_EQ(content("more/tables/grain8.csv"), "folder/grain8.ply\n");
  // A text that is cut, as by a full disk.
  write_file(more + "/grain6.csv", "folder/gra");
  made = 0;
  run_job(job, grains, {1});
  EXPECT_EQ(made, 4) << "from grain 6 on";
  EXPECT_EQ(content("more/tables/grain6.csv"), "folder/grain6.ply\n");
  write_file(job.folder + "/grids/grain7.json", "{");
  made = 0;
  run_job(job, grains, {1});
  EXPECT_EQ(made, 3) << "from grain 7 on";
}

TEST_F(Job, ReplacesNoFilesOfAnotherCommand) {
  GrainJob batch = number_job("out");
  batch.call = "{\"format\": \"wscvt-batch\"}\n";
  GrainJob other = number_job("out");
  other.call = "{\"format\": \"wscvt-extract\"}\n";
  other.is_kept = false;
  Points grains(3);
  run_job(batch, grains, {1});
  const std::string table = content("out/grains.csv");
  for (const auto& begun :
       std::vector<std::function<void()>>{[&] { run_job(other, grains, {1}); },
                                          [&] { require_no_job((folder_ / "out").string()); }}) {
    try {
      begun();
      FAIL() << "the files were replaced";
    } catch (const Error& error) {
      EXPECT_TRUE(holds(error.what(), "another command (wscvt-batch)"));
    }
  }
  EXPECT_EQ(content("out/grains.csv"), table);
  EXPECT_EQ(content("out/call.json"), batch.call);
  require_no_job((folder_ / "elsewhere").string());
  // A table without a call: of a command that keeps none, or the user's.
  for (GrainJob* job : {&batch, &other}) {
    job->folder = (folder_ / "users").string();
    fs::create_directories(job->folder);
    write_file(job->folder + "/grains.csv", "mine\r\n1\r\n");
    try {
      run_job(*job, grains, {1});
      FAIL() << "the table was replaced";
    } catch (const Error& error) {
      EXPECT_TRUE(holds(error.what(), "a grains.csv of another command"));
    }
    EXPECT_EQ(content("users/grains.csv"), "mine\r\n1\r\n");
    EXPECT_FALSE(fs::exists(folder_ / "users/call.json"));
  }
}

TEST_F(Job, FilesOfAnEarlierCallDoNotStay) {
  const auto file = [&](const std::string& name) { return (folder_ / name).string(); };
  for (const char* name : {"1.ply", "2.ply", "3.ply", "mine.ply"}) write_file(file(name), "old");
  fs::create_directories(folder_ / "deep");
  write_file(file("deep/4.ply"), "old");
  write_file(file("labels.csv"),
             "label,file\r\n1,1.ply\r\n2,2.ply\r\n3,3.ply\r\n4,\r\n"
             "5,deep/4.ply\r\n");
  const OlderFiles older(folder_.string(), {"labels.csv", "bodies.csv"});
  write_file(file("1.stl"), "new");
  EXPECT_TRUE(older.remove_but({"1.stl", "2.ply"}, file("3.ply")).empty()) << "the input stays";
  EXPECT_EQ(older.remove_but({"1.stl", "2.ply"}, file("2.ply")),
            std::vector<std::string>{"1 file of the earlier call removed"});
  EXPECT_FALSE(fs::exists(file("3.ply")));
  for (const char* name : {"1.ply", "1.stl", "2.ply", "mine.ply", "deep/4.ply"}) {
    EXPECT_TRUE(fs::exists(file(name))) << name;
  }
  EXPECT_TRUE(older.remove_but({"1.ply", "2.ply"}, "").empty());
}

// A scan that was replaced or repaired must not keep the result of the old one.
TEST_F(Job, WorksAgainOnScansThatAreNewerThanTheirResults) {
  fs::create_directories(folder_ / "scans");
  for (int k = 0; k < 10; ++k) {
    write_file((folder_ / "scans" / std::to_string(k)).string(), "a scan");
  }
  const auto later = [&](int scan, int seconds) {
    fs::last_write_time(folder_ / "scans" / std::to_string(scan),
                        fs::file_time_type::clock::now() + std::chrono::seconds(seconds));
  };
  GrainJob job = number_job("out");
  std::atomic<int> made{0};
  std::atomic<bool> is_repaired{false};
  job.make = [&, make = job.make](GrainAtWork& grain) {
    ++made;
    if (grain.name == "folder/grain2.ply" && !is_repaired) {
      throw Error(ErrorCode::InvalidInput, "No grain.");
    }
    return make(grain);
  };
  Points grains(10, folder_ / "scans");
  run_job(job, grains, {1});
  for (const auto& [scan, seconds, expected] :
       {std::tuple(9, -100, 0), std::tuple(6, 1, 4), std::tuple(2, 2, 8)}) {
    later(scan, seconds);
    made = 0;
    is_repaired = scan == 2;
    const JobEnd end = run_job(job, grains, {1});
    EXPECT_EQ(made, expected) << "scan " << scan;
    EXPECT_EQ(end.failed, scan == 2 ? 0U : 1U);
    if (seconds > 0) later(scan, -100);
  }
  // A folder of slices is as new as its newest slice.
  const fs::path slices = folder_ / "scans" / "3";
  fs::remove(slices);
  fs::create_directories(slices);
  write_file((slices / "1.tif").string(), "a slice");
  fs::last_write_time(slices / "1.tif", fs::file_time_type::clock::now() + std::chrono::seconds(3));
  later(3, -100);
  made = 0;
  run_job(job, grains, {1});
  EXPECT_EQ(made, 7);
}

TEST_F(Job, TakesNoRowsOfPartsThatAreOlderThanTheirScans) {
  fs::create_directories(folder_ / "scans");
  for (int k = 0; k < 10; ++k) {
    write_file((folder_ / "scans" / std::to_string(k)).string(), "a scan");
  }
  std::atomic<int> made{0};
  const auto run = [&](int index, bool is_repaired) {
    GrainJob job = number_job("out");
    if (index > 0) job.shard = {index, 2};
    made = 0;
    job.make = [&made, is_repaired, make = job.make](GrainAtWork& grain) {
      ++made;
      if (grain.name == "folder/grain2.ply" && !is_repaired) {
        throw Error(ErrorCode::InvalidInput, "No grain.");
      }
      return make(grain);
    };
    JoinedGrains part(job.shard);
    part.add(std::make_unique<Points>(10, folder_ / "scans"));
    return run_job(job, part, {1}).failed;
  };
  EXPECT_EQ(run(1, false) + run(2, false), 1U);
  const auto now = fs::file_time_type::clock::now();
  for (const char* scan : {"2", "6"}) {  // one that failed, and one that was made
    fs::last_write_time(folder_ / "scans" / scan, now + std::chrono::seconds(1000));
  }
  // A file that is older than its scan, though its row is not.
  fs::last_write_time(folder_ / "out/grain7.txt", now - std::chrono::seconds(2000));
  fs::last_write_time(folder_ / "scans/7", now - std::chrono::seconds(1000));
  EXPECT_EQ(run(0, true), 0U);
  EXPECT_EQ(made, 3);
  // A part itself makes them again too.
  int again = 0;
  for (const int index : {1, 2}) {
    run(index, true);
    again += made;
  }
  EXPECT_GE(again, 2);
}

TEST_F(Job, MakesLostFilesOfItsPartsAgain) {
  std::atomic<int> made{0};
  const auto run = [&](int index) {
    GrainJob job = number_job("out");
    if (index > 0) job.shard = {index, 2};
    made = 0;
    job.make = [&made, make = job.make](GrainAtWork& grain) {
      ++made;
      return make(grain);
    };
    JoinedGrains part(job.shard);
    part.add(std::make_unique<Points>(10));
    run_job(job, part, {1});
  };
  run(1);
  run(2);
  fs::remove(folder_ / "out/grain3.txt");
  write_file((folder_ / "out/grain4.txt").string(), "");
  run(0);
  EXPECT_EQ(made, 2);
  EXPECT_EQ(content("out/grain3.txt"), "3");
  EXPECT_EQ(content("out/grain4.txt"), "4");
}

TEST_F(Job, ThatIsNotKeptMakesLostFilesAgain) {
  std::atomic<int> made{0};
  GrainJob job = number_job("out");
  job.is_kept = false;
  job.make = [&made, make = job.make](GrainAtWork& grain) {
    ++made;
    return make(grain);
  };
  Points grains(20);
  JobHost host{1};
  host.is_cancelled = [&] { return made >= 12; };
  ASSERT_TRUE(run_job(job, grains, host).was_cancelled());
  ASSERT_TRUE(fs::remove(folder_ / "out/grain2.txt"));
  EXPECT_EQ(run_job(job, grains, {1}).done, 20U);
  EXPECT_EQ(content("out/grain2.txt"), "2");
}

TEST_F(Job, PartsAreTheWhole) {
  Points grains(40);
  run_job(number_job("whole"), grains, {2});
  std::atomic<int> made{0};
  for (const int index : {2, 1, 0}) {
    GrainJob job = number_job("out");
    if (index > 0) job.shard = {index, 2};
    job.has_census = index > 0;
    job.make = [&, make = job.make](GrainAtWork& grain) {
      ++made;
      return make(grain);
    };
    JoinedGrains part(job.shard);
    part.add(std::make_unique<Points>(40));
    EXPECT_GT(part.size(), 5U);
    EXPECT_LT(part.size(), index == 0 ? 41U : 35U);
    run_job(job, part, {2});
    EXPECT_EQ(content("out/labels.csv"), "what,file\r\ngrain0.txt,grain1.txt\r\n");
    const fs::path table = folders_of(job).front().table();
    EXPECT_EQ(table.filename(),
              index == 0 ? "grains.csv" : "grains-" + std::to_string(index) + "-of-2.csv");
  }
  EXPECT_EQ(made, 40) << "the whole takes over what its parts made";
  for (const std::string name : {"/grains.csv", "/other.csv"}) {
    EXPECT_EQ(content("out" + name), content("whole" + name)) << name;
  }
  for (int k = 0; k < 40; ++k) {
    EXPECT_EQ(content("out/grain" + std::to_string(k) + ".txt"), std::to_string(k));
  }
}

TEST_F(Job, OnlyResultsStayOfOneThatIsNotKept) {
  GrainJob job = number_job("out");
  job.is_kept = false;
  std::atomic<int> made{0};
  job.make = [&, make = job.make](GrainAtWork& grain) {
    ++made;
    return make(grain);
  };
  JobHost host{1};
  host.is_cancelled = [&] { return made >= 5; };
  Points grains(10);
  ASSERT_TRUE(run_job(job, grains, host).was_cancelled());
  EXPECT_TRUE(fs::exists(folder_ / "out/call.json"));
  const int before = made;
  run_job(job, grains, {1});
  EXPECT_LT(made, before + 10) << "it goes on";
  EXPECT_FALSE(fs::exists(folder_ / "out/call.json"));
  made = 0;
  run_job(job, grains, {1});
  EXPECT_EQ(made, 10) << "anew";
}

TEST_F(Job, LevelsHaveTheirFilesAndTables) {
  GrainJob job = number_job("out");
  job.levels = {"n20", "n100"};
  int made = 0;
  job.make = [&made](GrainAtWork& grain) {
    ++made;
    if (grain.name == Points(3).name(1)) throw Error(ErrorCode::InvalidInput, "No grain.");
    std::vector<std::string> records;
    for (const JobFolder& folder : grain.folders) {
      const std::string level = fs::path(folder.path()).filename().string();
      write_file(folder.file_of(grain.name), level);
      records.push_back(sample_row(grain.name, "number\r\n" + level + "\r\n"));
      records.push_back(grain.name + ",done," + level + "\r\n");
    }
    return records;
  };
  Points grains(3);
  EXPECT_EQ(run_job(job, grains, {1}).failed, 1U);
  // A file that a level lost is made again.
  fs::remove(folder_ / "out/n100/grain2.txt");
  made = 0;
  run_job(job, grains, {1});
  EXPECT_EQ(made, 1);
  for (const std::string level : {"n20", "n100"}) {
    EXPECT_EQ(content("out/" + level + "/grain2.txt"), level);
    EXPECT_TRUE(holds(content("out/" + level + "/grains.csv"), "grain1.ply,failed,No grain.,\r\n"));
    EXPECT_TRUE(holds(content("out/" + level + "/other.csv"), "grain1.ply,failed,\r\n"));
    const std::string row = "folder/grain2.ply,done," + level + "\r\n";
    const std::string table = content("out/" + level + "/other.csv");
    EXPECT_EQ(table.substr(table.size() - row.size()), row);
  }
  EXPECT_FALSE(fs::exists(folder_ / "out/grains.csv"));
  // The whole folder is one job's.
  GrainJob other = number_job("out");
  other.call = "other options";
  EXPECT_THROW(run_job(other, grains, {1}), Error);
}

TEST_F(Job, OfTheWholeTakesOnlyWholeRowsOfPartsWithItsOptions) {
  std::atomic<int> made{0};
  std::vector<std::size_t> wanted;
  const auto run = [&](int index, const std::string& call, bool breaks) {
    GrainJob job = number_job("out");
    job.is_kept = false;
    job.call = call;
    if (index > 0) job.shard = {index, 2};
    job.make = [&made, breaks, make = job.make](GrainAtWork& grain) {
      ++made;
      if (breaks && grain.name == Points(3).name(2)) {
        throw Error(ErrorCode::InvalidInput, "No grain.");
      }
      return make(grain);
    };
    made = 0;
    JoinedGrains part(job.shard);
    auto points = std::make_unique<Points>(30);
    const Points& source = *points;
    part.add(std::move(points));
    const JobEnd end = run_job(job, part, {1});
    wanted = source.wanted_;
    return end;
  };
  const auto parts = [&](const std::string& call) {
    const std::size_t failed = run(1, call, true).failed + run(2, call, true).failed;
    EXPECT_EQ(failed, 1U);
  };
  const auto expect_only_results = [&] {
    for (const std::string part : {"1-of-2", "2-of-2"}) {
      for (const std::string& name : {"grains-" + part + ".csv", "call-" + part + ".json"}) {
        EXPECT_FALSE(fs::exists(folder_ / "out" / name)) << name;
      }
    }
    EXPECT_FALSE(fs::exists(folder_ / "out/call.json"));
  };
  parts("the options\n");
  EXPECT_TRUE(fs::exists(folder_ / "out/call-1-of-2.json"));
  EXPECT_EQ(run(0, "the options\n", false).failed, 1U) << "the row of a part";
  EXPECT_EQ(made, 0);
  EXPECT_TRUE(wanted.empty());
  expect_only_results();
  // Of other options.
  parts("old options\n");
  EXPECT_EQ(run(0, "the options\n", false).failed, 0U);
  EXPECT_EQ(made, 30);
  fs::remove_all(folder_ / "out");
  // A row that only one of the tables has.
  parts("the options\n");
  const fs::path table = folder_ / "out/other-2-of-2.csv";
  const std::string rows = content("out/other-2-of-2.csv");
  fs::resize_file(table, rows.rfind("\r\n", rows.size() - 3) + 2);
  run(0, "the options\n", false);
  EXPECT_EQ(made, 1);
  EXPECT_EQ(wanted.size(), 1U);
  fs::remove_all(folder_ / "out");
  // A table with other columns.
  parts("the options\n");
  write_file(table.string(), "grain,status,thrice\r\n" + rows.substr(rows.find("\r\n") + 2));
  run(0, "the options\n", false);
  EXPECT_EQ(static_cast<std::size_t>(made), wanted.size());
  EXPECT_GT(made, 5);
}

TEST_F(Job, MakesWhatIsRefusedOnlyIfItTakesIt) {
  class Refused : public Points {
   public:
    using Points::Points;
    GrainScan read(std::size_t grain, bool pictures, const Execution& execution) override {
      GrainScan scan = Points::read(grain, pictures, execution);
      if (grain == 1) scan.refused = "Only crumbs.";
      return scan;
    }
  };
  for (const bool takes : {false, true}) {
    GrainJob job = number_job(takes ? "taken" : "out");
    job.takes_refused = takes;
    Refused grains(3);
    job.reads_pictures = takes;
    EXPECT_EQ(run_job(job, grains, {1}).failed, takes ? 0U : 1U);
    EXPECT_EQ(grains.has_pictures_, takes);
  }
  EXPECT_TRUE(holds(content("out/grains.csv"), "grain1.ply,failed,Only crumbs.,"));
  EXPECT_EQ(content("taken/grain1.txt"), "1");
}

TEST_F(Job, ReplacesNoCensusAndNoTableOfAnotherCommand) {
  class OneVolume : public Points {
   public:
    using Points::Points;
    std::size_t volumes() const override { return 1; }
  };
  fs::create_directories(folder_ / "out");
  const std::string labels = (folder_ / "out/labels.csv").string();
  OneVolume grains(2);
  const auto refuses = [&](const GrainJob& job, const std::string& table) {
    write_file(labels, table);
    const std::string refusal =
        test::refusal(ErrorCode::InvalidInput, [&] { run_job(job, grains, {1}); });
    EXPECT_EQ(content("out/labels.csv") == table, !refusal.empty() || !job.has_census);
    fs::remove(labels);
    fs::remove_all(folder_ / "out/n5");
    for (const char* name : {"call.json", "grains.csv", "other.csv"}) {
      fs::remove(folder_ / "out" / name);
    }
    return !refusal.empty();
  };
  GrainJob job = number_job("out");
  EXPECT_FALSE(refuses(job, "label,file\r\n1,a.txt\r\n"));
  EXPECT_TRUE(refuses(job, "label,file\r\n1,grain1.txt\r\n")) << "a grain's file";
  job.has_census = true;
  EXPECT_TRUE(refuses(job, "label,file\r\n1,a.txt\r\n")) << "the census";
  job.has_census = false;
  job.levels = {"n5"};
  EXPECT_FALSE(refuses(job, "label,file\r\n1,grain1.txt\r\n")) << "another folder";
  job.levels.clear();
  job.last_table = {"labels", "label,file\r\n"};
  EXPECT_FALSE(refuses(job, "label,file\r\n1,grain1.txt\r\n")) << "its own table";
  EXPECT_TRUE(refuses(job, "label,name\r\n1,a\r\n"));
  // A kept job whose call is lost does not go on.
  GrainJob kept = number_job("kept");
  run_job(kept, grains, {1});
  fs::remove(folder_ / "kept/call.json");
  EXPECT_TRUE(holds(test::refusal(ErrorCode::InvalidInput, [&] { run_job(kept, grains, {1}); }),
                    "call.json is missing"));
}

TEST_F(Job, OnlyTheGrainsOwnFailureIsInItsRow) {
  const std::vector<std::pair<std::string, std::function<void()>>> refusals = {
      {"disk", [] { throw MachineRefused(Sentence("The disk is full.")); }},
      {"memory", [] { throw std::bad_alloc(); }}};
  for (const auto& [name, refusal] : refusals) {
    GrainJob job = number_job(name);
    bool refuses = true;
    job.make = [&, make = job.make, end = refusal](GrainAtWork& grain) {
      if (grain.name == Points(9).name(3)) {
        throw Error(ErrorCode::NumericalFailure, "It breaks.");
      }
      if (grain.name == Points(9).name(4)) throw std::runtime_error("It breaks too.");
      if (refuses && grain.name == Points(9).name(6)) end();
      return make(grain);
    };
    Points grains(9);
    std::vector<std::string> failures;
    JobHost host{1};
    host.failed = [&](const std::string& grain, const std::string& error) {
      failures.push_back(grain + ": " + error);
    };
    EXPECT_THROW(run_job(job, grains, host), Error);
    EXPECT_EQ(failures, (std::vector<std::string>{"folder/grain3.ply: It breaks.",
                                                  "folder/grain4.ply: It breaks too."}));
    const std::string table = content(name + "/grains.csv");
    EXPECT_TRUE(holds(table, "grain3.ply,failed,It breaks.,\r\n"));
    EXPECT_TRUE(holds(table, "grain5.ply"));
    EXPECT_FALSE(holds(table, "grain6.ply")) << "a refusal is a row";
    // The machine is well again: the same call goes on, and counts the failures before.
    refuses = false;
    const JobEnd end = run_job(job, grains, {1});
    EXPECT_EQ(end.done, 9U);
    EXPECT_EQ(end.failed, 2U);
    EXPECT_TRUE(holds(content(name + "/grains.csv"), "grain6.ply,done"));
  }
}

TEST_F(Job, RefusesFilesThatWouldReplaceEachOther) {
  GrainJob job = number_job("out");
  JoinedGrains twice({});
  twice.add(std::make_unique<Points>(2));
  twice.add(std::make_unique<Points>(1));
  EXPECT_THROW(run_job(job, twice, {1}), Error);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  // Its own scan.
  const std::string scan = (folder_ / "scan.ply").string();
  write_file(scan, "a scan");
  job = number_job("");
  job.ending = "ply";
  MeshGrains grain(scan);
  EXPECT_THROW(run_job(job, grain, {1}), Error);
  EXPECT_EQ(content("scan.ply"), "a scan");
  // The mesh of which it is a body.
  const IndexedMesh two =
      test::joined(test::box(1, 1, 1), test::moved(test::box(1, 1, 1), 1.0, {3, 0, 0}));
  write_mesh(two, (folder_ / "1.ply").string());
  const std::string bodies = content("1.ply");
  MeshGrains of_two((folder_ / "1.ply").string(), Execution(1));
  EXPECT_EQ(of_two.size(), 2U);
  EXPECT_THROW(run_job(job, of_two, {1}), Error);
  EXPECT_EQ(content("1.ply"), bodies);
  // That of another grain, by a file beside its own.
  const std::string part = (folder_ / "scan_1.obj").string();
  write_file(part, "another scan");
  job.ending = "urdf";
  job.beside = [](const std::string& file) {
    return std::vector<std::string>{file.substr(0, file.size() - 5) + "_1.obj"};
  };
  JoinedGrains both({});
  both.add(std::make_unique<MeshGrains>(scan));
  both.add(std::make_unique<MeshGrains>(part));
  EXPECT_THROW(run_job(job, both, {1}), Error);
  EXPECT_EQ(content("scan_1.obj"), "another scan");
  // By a link to it in the folder.
  fs::create_directory(folder_ / "out");
  fs::create_symlink(part, folder_ / "out" / "scan.urdf");
  job = number_job("out");
  job.ending = "urdf";
  EXPECT_ERROR(run_job(job, both, {1}), InvalidInput);
  EXPECT_EQ(content("scan_1.obj"), "another scan");
}

TEST_F(Job, RequiresThatScansAreKeptWhereverTheyLie) {
  GrainJob job = number_job("out");
  job.levels = {"n20", "n100"};
  job.more_files = {{"tables", "csv"}};
  const Points grains(3);
  for (const std::string name : {"out/n100/grain2.txt", "out/n20/tables/grain0.csv"}) {
    const fs::path scan = folder_ / name;
    fs::create_directories(scan.parent_path());
    write_file(scan.string(), "a scan");
    EXPECT_ERROR(require_scans_kept(job, grains, {scan.string()}), InvalidInput);
    fs::create_directory_symlink(scan.parent_path(), folder_ / "link");
    EXPECT_ERROR(require_scans_kept(job, grains, {(folder_ / "link" / scan.filename()).string()}),
                 InvalidInput);
    fs::remove(folder_ / "link");
    EXPECT_NO_THROW(require_scans_kept(job, grains, {(folder_ / "grain2.txt").string()}));
  }
}

TEST_F(Job, OneTableHasOneUnit) {
  class Sized : public Points {
   public:
    explicit Sized(std::string unit) : Points(1), unit_(std::move(unit)) {}
    std::string unit() const override { return unit_; }

   private:
    std::string unit_;
  };
  JoinedGrains joined({});
  for (const char* unit : {"", "um", "", "um"}) joined.add(std::make_unique<Sized>(unit));
  EXPECT_EQ(joined.unit(), "um");
  try {
    joined.add(std::make_unique<Sized>("mm"));
    FAIL() << "two units in one table";
  } catch (const Error& error) {
    EXPECT_TRUE(holds(error.what(), "are in um, and of"));
  }
}

TEST(Formats, OfMeshesAreEndingsWithoutAPoint) {
  for (const char* format : {"ply", "obj", "ascii.stl", "vtu"})
    EXPECT_NO_THROW(check_format(format));
  for (const char* format : {"", ".", ".obj", "..obj", "obj.", "tif"}) {
    test::expect_error(ErrorCode::InvalidInput, [&] { check_format(format); });
  }
}

}  // namespace
}  // namespace wscvt
