// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/mesh_io.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <thread>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/read_content.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::holds;

class MeshIo : public test::FileFolder {
 protected:
  static std::string refusal(const std::string& where) {
    const std::string sentence = test::refusal(ErrorCode::InputOutput, [&] { read_mesh(where); });
    EXPECT_TRUE(sentence.empty() || sentence.find(where) != std::string::npos) << sentence;
    return sentence;
  }
};

using test::bytes;

const Vector3 far_away(1e6 + 0.123456789, -3.0e6, 1.0 / 3.0);

TEST_F(MeshIo, WritesAndReadsBackEveryFormat) {
  const IndexedMesh mesh = test::transformed(test::lumpy(3), Eigen::Matrix3d::Identity(), far_away);
  for (const char* name : {"a.ply", "a.obj", "a.off", "A.PLY"}) {
    SCOPED_TRACE(name);
    write_mesh(mesh, path(name));
    const IndexedMesh back = read_mesh(path(name));
    EXPECT_EQ(back.points, mesh.points);  // no bit lost
    EXPECT_EQ(back.triangles, mesh.triangles);
  }
}

TEST_F(MeshIo, SaysWhichCoordinatesAFileKeeps) {
  const IndexedMesh mesh = test::transformed(test::lumpy(2), Eigen::Matrix3d::Identity(), far_away);
  for (const auto coordinates : {PlyCoordinates::Double, PlyCoordinates::Float}) {
    for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) {
      SCOPED_TRACE(name);
      const IndexedMesh kept = as_written(mesh, path(name), coordinates);
      const bool is_stl = std::string(name) == "a.stl";
      // Nearer, where STL takes it: its corners are points of their own.
      const IndexedMesh near = is_stl ? as_written(test::lumpy(2), path(name)) : kept;
      write_mesh(is_stl ? test::lumpy(2) : mesh, path(name), coordinates);
      const IndexedMesh back = read_mesh(path(name));
      ASSERT_EQ(back.triangles.size(), near.triangles.size());
      for (std::size_t f = 0; f < near.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_EQ(back.points[back.triangles[f][k]], near.points[near.triangles[f][k]]);
        }
      }
      EXPECT_EQ(kept.triangles, mesh.triangles);
      const bool is_single =
          is_stl || (std::string(name) == "a.ply" && coordinates == PlyCoordinates::Float);
      EXPECT_EQ(kept.points == mesh.points, !is_single);
    }
  }
}

TEST_F(MeshIo, ReadsFilesOfManyBuffersWhereverTheirLinesEnd) {
  // Buffers are of 256 KiB. A first line of 0 to 69 characters more moves all that follow, so that
  // some line ends at each place about a buffer's end.
  const IndexedMesh mesh = test::lumpy(5);
  write_mesh(mesh, path("a.obj"));
  const std::string lines = content("a.obj");
  ASSERT_GT(lines.size(), std::size_t{2} << 18);
  for (std::size_t more = 0; more < 70; ++more) {
    const IndexedMesh back = read_mesh(file("b.obj", "#" + std::string(more, 'x') + "\n" + lines));
    ASSERT_EQ(back.points, mesh.points) << more;
    ASSERT_EQ(back.triangles, mesh.triangles) << more;
  }
  for (const char* name : {"a.ply", "a.off"}) {
    write_mesh(mesh, path(name));
    const IndexedMesh back = read_mesh(path(name));
    EXPECT_EQ(back.points, mesh.points) << name;
    EXPECT_EQ(back.triangles, mesh.triangles) << name;
  }
}

TEST_F(MeshIo, WritesAndReadsBackWhatPlyCarriesInEveryType) {
  const IndexedMesh mesh = test::tetrahedron(2.0);
  MeshAttributes own;
  const std::vector<double> whole{0.0, 5.0, 99.0, 127.0};
  for (int type = 0; type < 8; ++type) {
    own.of_vertices.push_back({"v" + std::to_string(type), static_cast<ScalarType>(type), whole});
    own.of_faces.push_back({"f" + std::to_string(type), static_cast<ScalarType>(type), whole});
  }
  write_mesh(mesh, own, path("a.ply"));
  const MeshFile read = read_mesh_file(path("a.ply"));
  EXPECT_EQ(read.mesh.points, mesh.points);
  EXPECT_EQ(read.mesh.triangles, mesh.triangles);
  ASSERT_EQ(read.attributes.of_vertices.size(), 8U);
  ASSERT_EQ(read.attributes.of_faces.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(read.attributes.of_vertices[k].name, own.of_vertices[k].name);
    EXPECT_EQ(read.attributes.of_vertices[k].type, own.of_vertices[k].type);
    EXPECT_EQ(read.attributes.of_vertices[k].values, whole);
    EXPECT_EQ(read.attributes.of_faces[k].type, own.of_faces[k].type);
    EXPECT_EQ(read.attributes.of_faces[k].values, whole);
  }
  // Colours between those of vertices are rounded, and stay within their type.
  own.of_vertices = {{"red", ScalarType::Uint8, {99.4, 99.6, 300.0, -4.0}}};
  own.of_faces.clear();
  write_mesh(mesh, own, path("b.ply"));
  EXPECT_EQ(read_mesh_file(path("b.ply")).attributes.of_vertices[0].values,
            (std::vector<double>{99.0, 100.0, 255.0, 0.0}));
  // Other formats hold none.
  EXPECT_FALSE(holds_attributes(path("b.obj")));
  write_mesh(mesh, own, path("b.obj"));
  EXPECT_TRUE(read_mesh_file(path("b.obj")).attributes.empty());
  own.of_vertices[0].values.pop_back();
  EXPECT_ERROR(write_mesh(mesh, own, path("b.ply")), InvalidInput);
}

TEST_F(MeshIo, WritesPlyInSinglePrecisionWhenTold) {
  const IndexedMesh mesh = test::lumpy(2);
  write_mesh(mesh, path("a.ply"), PlyCoordinates::Float);
  const IndexedMesh back = read_mesh(path("a.ply"));
  EXPECT_EQ(back.triangles, mesh.triangles);
  ASSERT_EQ(back.points.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto expected = static_cast<float>(mesh.points[i][axis]);
      EXPECT_EQ(back.points[i][axis], static_cast<double>(expected));
    }
  }
}

TEST_F(MeshIo, WritesStlInSinglePrecision) {
  const IndexedMesh mesh = test::lumpy(3);
  write_mesh(mesh, path("a.stl"));
  EXPECT_EQ(fs::file_size(path("a.stl")), 84 + 50 * mesh.triangles.size());
  const IndexedMesh back = read_mesh(path("a.stl"));
  ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto expected = static_cast<float>(mesh.points[mesh.triangles[f][k]][axis]);
        EXPECT_EQ(back.points[back.triangles[f][k]][axis], static_cast<double>(expected));
      }
    }
  }
}

TEST_F(MeshIo, RefusesStlThatWouldMergeVertices) {
  const auto at = [](double x) {
    return test::transformed(test::lumpy(5), Eigen::Matrix3d::Identity(), Vector3(x, x, x));
  };
  write_mesh(at(10.0), path("a.stl"));
  try {
    write_mesh(at(1e8), path("a.stl"));
    FAIL() << "vertices were merged in silence";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InputOutput);
    EXPECT_TRUE(holds(error.what(), "Write PLY"));
  }
  // The file there stays, and the advice works.
  EXPECT_EQ(read_mesh(path("a.stl")).triangles.size(), at(0.0).triangles.size());
  write_mesh(at(1e8), path("a.ply"));
  EXPECT_EQ(read_mesh(path("a.ply")).points, at(1e8).points);
}

TEST_F(MeshIo, RefusesStlWhoseStepsTurnFaces) {
  // As a rock in coordinates of a map: no two vertices coincide, but faces turn by degrees.
  const IndexedMesh far =
      test::transformed(test::lumpy(3), Eigen::Matrix3d::Identity(), Vector3(5e5, 5.4e5, 100.0));
  try {
    write_mesh(far, path("a.stl"));
    FAIL() << "the mesh was rounded in silence";
  } catch (const Error& error) {
    EXPECT_TRUE(holds(error.what(), "of the mean edge. Write PLY"));
  }
  write_mesh(far, path("a.off"));
}

TEST_F(MeshIo, ReadsBinaryPlyWithOtherProperties) {
  // Float and double, other properties around, polygons, both names of the list.
  for (const bool doubles : {false, true}) {
    const char* const type = doubles ? "double" : "float";
    std::ostringstream header;
    header << "ply\nformat binary_little_endian 1.0\ncomment made by hand\nelement vertex 5\n"
           << "property uchar red\nproperty " << type << " x\nproperty " << type
           << " y\nproperty float quality\nproperty " << type << " z\nelement face 3\n"
           << "property int flags\nproperty list uint8 uint32 "
           << (doubles ? "vertex_index" : "vertex_indices") << "\nproperty uchar red\nend_header\n";
    std::string content = header.str();
    for (int i = 0; i < 5; ++i) {
      content += bytes(std::uint8_t{7});
      const double x = i + 0.25;
      const auto number = [&](double v) {
        return doubles ? bytes(v) : bytes(static_cast<float>(v));
      };
      content += number(x) + number(2 * x) + bytes(99.0F) + number(-x);
    }
    const std::vector<std::vector<std::uint32_t>> polygons{{0, 1, 2}, {0, 2, 3, 4}, {4, 1}};
    for (const auto& polygon : polygons) {
      content += bytes(std::int32_t{5}) + bytes(static_cast<std::uint8_t>(polygon.size()));
      for (const std::uint32_t v : polygon) content += bytes(v);
      content += bytes(std::uint8_t{1});
    }
    const IndexedMesh mesh = read_mesh(file("a.ply", content));
    ASSERT_EQ(mesh.points.size(), 5U);
    for (int i = 0; i < 5; ++i) {
      EXPECT_EQ(mesh.points[i], Vector3(i + 0.25, 2 * i + 0.5, -i - 0.25));
    }
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
    // Any byte short is noticed.
    EXPECT_NE(refusal(file("b.ply", content.substr(0, content.size() - 1))), "");
    EXPECT_NE(refusal(file("c.ply", content.substr(0, content.find("end_header") + 30))), "");
  }
}

TEST_F(MeshIo, ReadsOtherLayoutsOfPly) {
  const IndexedMesh mesh =
      test::transformed(test::box(1, 2, 3), Eigen::Matrix3d::Identity(), far_away);
  std::ostringstream text;
  text.precision(17);
  std::string big;
  const std::string header =
      " 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\nelement "
      "face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vector3& p : mesh.points) {
    text << p.x() << " " << p.y() << " " << p.z() << "\n";
    for (const double v : p) big += bytes(v, true);
  }
  for (const Triangle& t : mesh.triangles) {
    text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    big += bytes(std::uint8_t{3});
    for (const std::int32_t v : t) big += bytes(v, true);
  }
  std::string text_file = "ply\nformat ascii";
  text_file.append(header).append(text.str());
  std::string big_file = "ply\nformat binary_big_endian";
  big_file.append(header).append(big);
  for (const std::string& where : {file("text.ply", text_file), file("big.ply", big_file)}) {
    const IndexedMesh back = read_mesh(where);
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.triangles, mesh.triangles);
  }
}

TEST_F(MeshIo, ReadsTextStl) {
  const std::string where =
      file("a.stl",
           "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0.5\nvertex 0 1e0 0\n"
           "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0.5\nvertex 1 1 0\n"
           "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
  const IndexedMesh mesh = read_mesh(where);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.points[mesh.triangles[0][1]], Vector3(1, 0, 0.5));
  EXPECT_EQ(mesh.points[mesh.triangles[1][1]], Vector3(1, 1, 0));
}

// meshio 530, stl_reader 3: bytes behind the last triangle, and a cut, whatever the header says.
TEST_F(MeshIo, ReadsBinaryStlWithATailAndSaysHowMuchOfACutOneIsThere) {
  write_mesh(test::box(1, 1, 1), path("a.stl"));
  const std::string bytes = content("a.stl");
  for (const char* header : {"made", "solid exported by SolidWorks", "SOLID"}) {
    std::string named = bytes;
    named.replace(0, 80, std::string(header).append(80 - std::string(header).size(), ' '));
    for (const std::string& tail :
         {std::string("\r\n"), std::string(37, '\0'), std::string(49, 'x')}) {
      std::ofstream(path("b.stl"), std::ios::binary) << named << tail;
      const MeshFile file = read_mesh_file(path("b.stl"));
      EXPECT_EQ(file.mesh.points, read_mesh(path("a.stl")).points) << header;
      ASSERT_EQ(file.warnings.size(), 1U) << header;
      EXPECT_EQ(file.warnings[0].find("\"" + path("b.stl") + "\" has " +
                                      std::to_string(tail.size()) + " bytes behind"),
                0U)
          << file.warnings[0];
    }
    std::ofstream(path("b.stl"), std::ios::binary) << named;
    EXPECT_TRUE(read_mesh_file(path("b.stl")).warnings.empty());
    for (const std::size_t left : {named.size() - 1, named.size() - 50, named.size() - 251}) {
      std::ofstream(path("b.stl"), std::ios::binary) << named.substr(0, left);
      const std::string held = std::to_string((left - 84) / 50);
      EXPECT_TRUE(holds(refusal(path("b.stl")), "announces 12 triangles, but holds " + held));
    }
    std::ofstream(path("b.stl"), std::ios::binary) << named << std::string(50, 'x');
    EXPECT_TRUE(holds(refusal(path("b.stl")), "announces 12 triangles, but holds 13"));
  }
}

TEST_F(MeshIo, ReadsBinaryStlWhoseHeaderSaysSolid) {
  write_mesh(test::box(1, 1, 1), path("a.stl"));
  std::fstream stream(path("a.stl"), std::ios::in | std::ios::out | std::ios::binary);
  stream.write("solid grain", 11);
  stream.close();
  EXPECT_EQ(read_mesh(path("a.stl")).triangles.size(), 12U);
}

TEST_F(MeshIo, ReadsObjWithSlashesPolygonsAndNegativeIndices) {
  const IndexedMesh mesh = read_mesh(
      file("a.obj",
           "# a grain\nmtllib a.mtl\no grain\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.125\nvn 0 0 1\n"
           "vt 0 0\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -4 -3 -1\n"));
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.points[3], Vector3(0, 1, 0.125));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
}

TEST_F(MeshIo, ReadsPointsWithoutFaces) {
  for (const std::string& where :
       {file("a.obj", "v 0 0 0\nv 1 0 0\n"), file("a.off", "OFF\n2 0 0\n0 0 0\n1 0 0\n"),
        file("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n0 0 0\n1 0 0\n")}) {
    const IndexedMesh mesh = read_mesh(where);
    EXPECT_EQ(mesh.points.size(), 2U) << where;
    EXPECT_TRUE(mesh.triangles.empty()) << where;
  }
}

TEST_F(MeshIo, PassesOnPositionsThatAreNotFiniteAndWritesNone) {
  // They are for the mesh check to refuse, which can say which vertex it is.
  std::ofstream(path("a.off")) << "OFF\n4 1 0\n0 0 0\n1 0 0\n0 inf 1\n0 nan 1\n3 0 1 2\n";
  const IndexedMesh back = read_mesh(path("a.off"));
  EXPECT_TRUE(std::isinf(back.points[2].y()));
  EXPECT_TRUE(std::isnan(back.points[3].y()));
  EXPECT_ERROR(write_mesh(back, path("b.off")), InvalidInput);
  EXPECT_FALSE(fs::exists(path("b.off")));
}

TEST_F(MeshIo, ReadsFromAPipe) {
  const IndexedMesh mesh = test::lumpy(3);
  write_mesh(mesh, path("a.stl"));
  ASSERT_EQ(mkfifo(path("pipe.stl").c_str(), 0600), 0);
  std::thread writer([&] { file("pipe.stl", content("a.stl")); });
  const IndexedMesh back = read_mesh(path("pipe.stl"));
  writer.join();
  EXPECT_EQ(back.points, read_mesh(path("a.stl")).points);
}

TEST_F(MeshIo, ReportsAndStopsWithinAFile) {
  const IndexedMesh mesh = test::lumpy(6);
  for (const std::string ending : {".ply", ".obj", ".off", ".stl"}) {
    const std::string name = path("a" + ending);
    write_mesh(mesh, name);
    // From buffer to buffer, of 256 KiB each.
    const int buffers = static_cast<int>(fs::file_size(name) / (1 << 18));
    ASSERT_GE(buffers, 2) << ending;
    test::expect_to_be_stopped([&](const Execution& execution) { read_mesh(name, execution); },
                               "Reading", buffers);
  }
}

TEST_F(MeshIo, SaysWhatIsWrongWithAFile) {
  EXPECT_TRUE(holds(refusal(path("nothing.ply")), "cannot be opened"));
  // Names of no format are wrong arguments.
  for (const char* name : {"a.step", "ply", ".ply"}) {
    SCOPED_TRACE(name);
    EXPECT_ERROR(read_mesh(path(name)), InvalidInput);
  }
  EXPECT_NE(refusal(file("bad.ply", "not a mesh\n")), "");
  EXPECT_NE(refusal(file("empty.ply", "")), "");
  EXPECT_NE(refusal(file("short.off", "OFF\n4 4 0\n0 0 0\n")), "");
  EXPECT_NE(refusal(file("words.obj", "v 0 zero 0\nf 1 1 1\n")), "");
  EXPECT_TRUE(holds(refusal(file("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n")), "vertex"));
  EXPECT_NE(refusal(file("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n")), "");
  EXPECT_NE(refusal(file("half.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n")),
            "");
  fs::create_directory(path("folder.ply"));
  EXPECT_TRUE(holds(refusal(path("folder.ply")), "folder"));
  fs::create_symlink("/dev/zero", path("endless.ply"));
  EXPECT_TRUE(holds(refusal(path("endless.ply")), "device"));
  // A header that promises more than the file can hold must not be believed.
  EXPECT_NE(refusal(file("huge.ply",
                         "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000000\n"
                         "property float x\nproperty float y\nproperty float z\nelement face 1\n"
                         "property list uchar int vertex_indices\nend_header\n")),
            "");
}

TEST_F(MeshIo, RefusesWhereItCannotWrite) {
  fs::create_directory(path("taken.ply"));
  EXPECT_ERROR(write_mesh(test::box(1, 1, 1), path("taken.ply")), InputOutput);
  EXPECT_TRUE(fs::is_directory(path("taken.ply")));
  EXPECT_ERROR(write_mesh(test::box(1, 1, 1), path("no/such/folder/a.ply")), InputOutput);
  EXPECT_ERROR(write_mesh(test::box(1, 1, 1), path("a.step")), InvalidInput);
}

TEST_F(MeshIo, LeavesNothingBeside) {
  write_mesh(test::box(1, 1, 1), path("a.ply"));
  write_mesh(test::box(1, 1, 2), path("a.ply"));  // over an existing one
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_))
    files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 1U);
  EXPECT_EQ(read_mesh(path("a.ply")).points, test::box(1, 1, 2).points);
}

}  // namespace
}  // namespace wscvt
