// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grain_source.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "toolbox/job/grain_files.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// A folder of files, and where they are said to be.
class Inputs : public test::FileFolder {
 protected:
  Names in_folder(const Names& names) const {
    Names result;
    for (const std::string& name : names) result.push_back(path(name));
    return result;
  }
};

TEST_F(Inputs, AreTheFilesOfFoldersPatternsAndListsInTheirOrder) {
  fs::create_directories(folder_ / "scans/deep.ply");
  fs::create_directories(folder_ / "slices");
  for (const char* name : {"scans/c.stl", "scans/a.ply", "scans/b.obj", "scans/volume.vtk",
                           "scans/table.xyzzy", "x1.ply", "x2.ply", "x3.ply", "one[2].ply"}) {
    file(name, "");
  }
  const auto is_volume = [](const std::string& name) {
    return name.find("volume") != std::string::npos || name.find("slices") != std::string::npos;
  };
  const auto files = [&](const Names& inputs) { return grain_files(inputs, is_volume); };
  EXPECT_EQ(files({path("scans")}), in_folder({"scans/a.ply", "scans/b.obj", "scans/c.stl"}));
  EXPECT_EQ(files({path("x3.ply"), path("x[12].ply"), path("slices")}),
            in_folder({"x3.ply", "x1.ply", "x2.ply", "slices"}));
  EXPECT_EQ(files({path("one[2].ply")}), in_folder({"one[2].ply"})) << "a file is no pattern";
  EXPECT_EQ(files({path("later.ply")}), in_folder({"later.ply"})) << "it need not be there";
  // A list of Windows, with a line without a name.
  const std::string list = file(
      "list.txt", path("x2.ply") + "\r\n\r\n" + path("scans") + "\r\n" + path("x1.ply") + "\n");
  EXPECT_EQ(files({"@" + list}),
            in_folder({"x2.ply", "scans/a.ply", "scans/b.obj", "scans/c.stl", "x1.ply"}));
  EXPECT_EQ(grain_files({path("scans")}, {}).size(), 4U) << "without volumes a .vtk is a mesh";

  file("lists.txt", "@" + list + "\n");
  file("nul.txt", std::string("a\0.ply\n", 7));
  for (const Names& refused : {Names{path("nothing")}, Names{path("no*.ply")},
                               Names{"@" + path("lists.txt")}, Names{"@" + path("nul.txt")}}) {
    EXPECT_ERROR(files(refused), InvalidInput);
  }
  const std::string refusal =
      test::refusal(ErrorCode::InvalidInput, [&] { files({"@" + path("lists.txt")}); });
  EXPECT_TRUE(test::holds(refusal, "contains the list"));
  fs::create_directories(folder_ / "empty");
  EXPECT_ERROR(files({path("empty")}), InvalidInput);

  for (const std::string& several : {path("scans"), path("x*.ply"), "@" + list}) {
    EXPECT_TRUE(names_files(several)) << several;
  }
  for (const std::string& one : {path("x1.ply"), path("one[2].ply"), path("nothing")}) {
    EXPECT_FALSE(names_files(one)) << one;
  }
}

TEST(Parts, HaveEachGrainOnceWhereverItLies) {
  const Shard third = shard_of("3/3");
  EXPECT_EQ(std::pair(third.index, third.count), std::pair(3, 3));
  EXPECT_EQ(shard_of("12/20").index, 12);
  for (const char* text : {"3", "0/3", "4/3", "1/0", "a/3", "1/b", "/", "1/2/3"}) {
    EXPECT_ERROR(shard_of(text), InvalidInput);
  }
  std::vector<int> sizes(3, 0);
  for (int grain = 0; grain < 60; ++grain) {
    const std::string name = "grain" + std::to_string(grain) + ".ply";
    int parts = 0;
    for (int index = 1; index <= 3; ++index) {
      const Shard shard{index, 3};
      if (!is_of(shard, "a/" + name)) continue;
      ++parts;
      ++sizes[static_cast<std::size_t>(index - 1)];
      EXPECT_TRUE(is_of(shard, "b/c/" + name)) << "the folder does not count";
    }
    EXPECT_EQ(parts, 1) << name;
    // The hash is that of Fowler, Noll and Vo on every machine.
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char letter : name) {
      hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
    }
    EXPECT_TRUE(is_of({static_cast<int>(hash % 3) + 1, 3}, "a/" + name)) << name;
  }
  for (const int size : sizes) EXPECT_GT(size, 10);
}

TEST(NamedGrains, HaveNumbersOfEnoughDigitsAndTheirPlaces) {
  EXPECT_EQ(NamedGrains("g-", 7, 3).name(6), "g-007");
  EXPECT_EQ(NamedGrains("g-", 100, 2).name(99), "g-100");
  EXPECT_EQ(NamedGrains("g-", 100, 2).name(7), "g-008");
  NamedGrains grains("g", 9, 1, [](std::size_t grain, const Execution&) {
    return test::box(1.0, 2.0, static_cast<double>(grain));
  });
  EXPECT_EQ(grains.size(), 9U);
  EXPECT_EQ(grains.file(4), "");
  const GrainScan scan = grains.read(4, false, Execution(1));
  EXPECT_EQ(scan.place, 4U);
  EXPECT_NEAR(volume_of(scan.mesh, Execution(1)), 8.0, 1e-12);
}

TEST_F(Inputs, ThatAreMeshesAreOneGrainOrTheirBodies) {
  const IndexedMesh large = test::box(3.0, 2.0, 1.0);
  const IndexedMesh small = test::moved(test::box(1.0, 1.0, 0.5), 1.0, {9, 0, 0});
  write_mesh(test::joined(large, small), path("two.ply"));
  write_mesh(large, path("one.ply"));
  const std::string broken = file("broken.ply", "no mesh");

  MeshGrains two(path("two.ply"), Execution(1));
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two.volumes(), 1U);
  EXPECT_EQ(two.file(1), path("two.ply"));
  EXPECT_EQ(two.name(0), path("two.ply/1"));
  EXPECT_EQ(two.name(1), path("two.ply/2"));
  EXPECT_NEAR(volume_of(two.read(0, false, Execution(1)).mesh, Execution(1)), 6.0, 1e-12);
  two.want({1});
  EXPECT_NEAR(volume_of(two.read(1, false, Execution(1)).mesh, Execution(1)), 0.5, 1e-12);
  EXPECT_TRUE(two.bodies().list[0].mesh.points.empty()) << "what is not wanted needs no memory";

  // Without a look at its bodies, or with a single one, it is itself.
  std::vector<std::unique_ptr<MeshGrains>> alone;
  alone.push_back(std::make_unique<MeshGrains>(path("one.ply"), Execution(1)));
  alone.push_back(std::make_unique<MeshGrains>(path("two.ply")));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(alone[k]->size(), 1U);
    EXPECT_EQ(alone[k]->volumes(), 0U);
    EXPECT_EQ(alone[k]->name(0), path(k == 0 ? "one.ply" : "two.ply"));
    EXPECT_EQ(alone[k]->file(0), alone[k]->name(0));
    EXPECT_EQ(alone[k]->read(0, false, Execution(1)).mesh.points.size(), k == 0 ? 8U : 16U);
  }
  // Its attributes come with it.
  MeshAttributes heights;
  heights.of_vertices = {{"height", ScalarType::Float64, {1, 2, 3, 4, 5, 6, 7, 8}}};
  write_mesh(large, heights, path("high.ply"));
  const GrainScan high = MeshGrains(path("high.ply")).read(0, false, Execution(1));
  ASSERT_EQ(high.attributes.of_vertices.size(), 1U);
  EXPECT_EQ(high.attributes.of_vertices[0].values, heights.of_vertices[0].values);
  const Execution stopped(1, [](double, const std::string&) { return false; });
  EXPECT_ERROR(MeshGrains(path("two.ply"), stopped), Cancelled);
  MeshGrains refused(broken, Execution(1));
  EXPECT_EQ(refused.size(), 1U);
  EXPECT_ERROR(refused.read(0, false, Execution(1)), InvalidInput);
}

TEST_F(Inputs, TellWhatTheirReadersWarnOf) {
  write_mesh(test::box(3.0, 2.0, 1.0), path("a.stl"));
  file("a.stl", content("a.stl") + "more");
  const std::vector<std::string> warnings =
      MeshGrains(path("a.stl")).read(0, false, Execution(1)).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(test::holds(warnings[0], "has 4 bytes"));
  // Pictures are looked for only where they are wanted.
  MeshGrains textured(file("t.obj",
                           "mtllib lost.mtl\nv 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\nvt 0 0\nvt 1 0\n"
                           "vt 0 1\nusemtl rock\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\n"
                           "f 2/1 3/2 4/3\n"));
  EXPECT_TRUE(textured.read(0, false, Execution(1)).warnings.empty());
  const std::vector<std::string> lost = textured.read(0, true, Execution(1)).warnings;
  ASSERT_FALSE(lost.empty());
  EXPECT_TRUE(test::holds(lost[0], "lost.mtl"));
}

/// Three grains with a census, and what they are asked.
class Counted : public NamedGrains {
 public:
  Counted(std::string prefix, double left_out, std::vector<std::size_t>& wanted)
      : NamedGrains(prefix, 3, 1),
        prefix_(std::move(prefix)),
        left_out_(left_out),
        wanted_(wanted) {}
  std::string file(std::size_t grain) const override {
    return prefix_ + "/" + std::to_string(grain);
  }
  void want(const std::vector<std::size_t>& grains) override { wanted_ = grains; }
  std::string census(const MadeOf& made_of) const override {
    return "grain,file\r\n" + name(0) + "," + made_of(name(0)).file + "\r\n";
  }
  double left_out() const override { return left_out_; }
  std::size_t volumes() const override { return 2; }

 private:
  std::string prefix_;
  double left_out_;
  std::vector<std::size_t>& wanted_;
};

TEST(JoinedGrains, AreThoseOfAllSources) {
  std::vector<std::size_t> wanted[3];
  JoinedGrains grains({});
  const double left_out[] = {0.125, 0.5, 0.25};
  const char* prefixes[] = {"a", "b", "c"};
  for (std::size_t k = 0; k < 3; ++k) {
    grains.add(std::make_unique<Counted>(prefixes[k], left_out[k], wanted[k]));
  }
  ASSERT_EQ(grains.size(), 9U);
  EXPECT_EQ(grains.name(5), "b3");
  EXPECT_EQ(grains.file(7), "c/1");
  EXPECT_EQ(grains.read(4, false, Execution(1)).place, 1U);
  EXPECT_EQ(grains.left_out(), 0.5);
  EXPECT_EQ(grains.volumes(), 6U);
  EXPECT_EQ(grains.unit(), "");
  grains.want({0, 2, 4, 8});
  EXPECT_EQ(wanted[0], (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(wanted[1], (std::vector<std::size_t>{1}));
  EXPECT_EQ(wanted[2], (std::vector<std::size_t>{2}));
  const std::string census =
      grains.census([](const std::string& grain) -> MadeGrain { return {grain + ".ply"}; });
  EXPECT_EQ(census, "grain,file\r\na1,a1.ply\r\nb1,b1.ply\r\nc1,c1.ply\r\n");
}

TEST(JoinedGrains, OfAPartAreThoseOfTheSourcesThatAreInIt) {
  std::set<std::string> known;
  for (const int index : {1, 2}) {
    std::vector<std::size_t> wanted;
    JoinedGrains part({index, 2});
    for (const char* prefix : {"a", "b", "c"}) {
      part.add(std::make_unique<Counted>(prefix, 0.0, wanted));
    }
    for (std::size_t k = 0; k < part.size(); ++k) {
      EXPECT_TRUE(is_of({index, 2}, part.name(k)));
      EXPECT_TRUE(known.insert(part.name(k)).second) << part.name(k);
      EXPECT_EQ(part.file(k),
                part.name(k).substr(0, 1) + "/" + std::to_string(part.name(k).back() - '1'));
    }
  }
  EXPECT_EQ(known.size(), 9U);
}

}  // namespace
}  // namespace wscvt
