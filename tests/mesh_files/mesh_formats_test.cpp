// SPDX-License-Identifier: GPL-3.0-or-later
// Formats of other programs: VTK's, Gmsh's, Abaqus's, clouds of points, and gzip.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <boost/endian/conversion.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/coded_bytes.h"
#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using boost::endian::order;
using test::holds;

class MeshFormats : public test::FileFolder {
 protected:
  /// Expects a file to be refused with a sentence that names it and has `part`.
  void expect_refusal(const std::string& name, const std::string& text, const std::string& part) {
    const std::string where = file(name, text);
    const std::string sentence = test::refusal(ErrorCode::InputOutput, [&] { read_mesh(where); });
    EXPECT_TRUE(holds(sentence, where));
    EXPECT_TRUE(holds(sentence, part));
  }
};

template <class Value>
std::string bytes_of(Value value, order byte_order = order::little) {
  std::string bytes(sizeof(Value), '\0');
  auto* to = reinterpret_cast<unsigned char*>(bytes.data());
  if (byte_order == order::little) {
    boost::endian::endian_store<Value, sizeof(Value), order::little>(to, value);
  } else {
    boost::endian::endian_store<Value, sizeof(Value), order::big>(to, value);
  }
  return bytes;
}

template <class Value, class Number>
std::string bytes_of_all(const std::vector<Number>& numbers, order byte_order = order::little) {
  std::string bytes;
  for (const Number number : numbers) bytes += bytes_of(static_cast<Value>(number), byte_order);
  return bytes;
}

const IndexedMesh& lumpy_body() {
  static const IndexedMesh mesh = test::transformed(test::lumpy(2), Eigen::Matrix3d::Identity(),
                                                    Vector3(1e6 + 0.123456789, -3.0e6, 1.0 / 3.0));
  return mesh;
}

TEST_F(MeshFormats, OfTextKeepEveryBit) {
  for (const char* name : {"a.vtp", "a.vtk"}) {
    write_mesh(lumpy_body(), path(name));
    const IndexedMesh back = read_mesh(path(name));
    EXPECT_EQ(back.points, lumpy_body().points) << name;
    EXPECT_EQ(back.triangles, lumpy_body().triangles) << name;
  }
  // Also where single precision would put them on one place.
  write_mesh(lumpy_body(), path("a.ASCII.stl"));
  EXPECT_EQ(content("a.ASCII.stl").rfind("solid grain\nfacet normal ", 0), 0U);
  EXPECT_EQ(read_mesh(path("a.ASCII.stl")).points, test::unwelded(lumpy_body()).points);
  EXPECT_ERROR(write_mesh(lumpy_body(), path("a.stl")), InputOutput);
}

/// The numbers of a text between two marks, with commas as blanks.
std::vector<double> numbers_between(std::string text, const std::string& from,
                                    const std::string& to) {
  const std::size_t begin = text.find(from) + from.size();
  text = text.substr(begin, text.find(to, begin) - begin);
  for (char& c : text) {
    if (c == ',') c = ' ';
  }
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;) numbers.push_back(number);
  return numbers;
}

TEST_F(MeshFormats, HoldNoPositionThatIsNotFinite) {
  for (const double lost : {std::nan(""), HUGE_VAL, 1e39}) {
    IndexedMesh mesh = lumpy_body();
    mesh.points[3].y() = lost;
    for (const char* name : {"a.ply", "a.stl", "a.obj", "a.vtu", "a.msh"}) {
      const bool is_single = std::string(name) == "a.stl";
      if (lost == 1e39 && !is_single) continue;
      EXPECT_ERROR(write_mesh(mesh, path(name)), InvalidInput);
      EXPECT_FALSE(fs::exists(path(name))) << name;
    }
    EXPECT_ERROR(write_mesh(mesh, path("a.ply"), PlyCoordinates::Float), InvalidInput);
    if (lost != 1e39) EXPECT_ERROR(write_mesh(mesh, MeshAttributes(), path("a.ply")), InvalidInput);
  }
}

TEST_F(MeshFormats, OfFiniteElementsAreReadBack) {
  for (const char* name : {"a.msh", "a.inp", "a.vtu"}) {
    write_mesh(lumpy_body(), path(name));
    const IndexedMesh back = read_mesh(path(name));
    EXPECT_EQ(back.points, as_written(lumpy_body(), name).points) << name;
    EXPECT_EQ(back.triangles, lumpy_body().triangles) << name;
  }
}

// A U of 8 corners is seen whole from none of them; as a fan its area would depend on the first.
TEST_F(MeshFormats, ConcavePolygonsKeepTheirAreaFromAnyCorner) {
  const std::vector<std::array<int, 2>> outline = {{0, 0}, {3, 0}, {3, 3}, {2, 3},
                                                   {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (int first = 0; first < 8; ++first) {
    std::vector<std::vector<int>> faces(2);
    for (int k = 0; k < 8; ++k) {
      const int corner = (first + k) % 8;
      faces[0].push_back(corner + 8);
      faces[1].push_back((first + 8 - k) % 8);
      const int next = (corner + 1) % 8;
      faces.push_back({corner, next, next + 8, corner + 8});
    }
    std::string points, off, obj;
    for (int k = 0; k < 16; ++k) {
      const auto& [x, y] = outline[static_cast<std::size_t>(k % 8)];
      points += std::to_string(x) + " " + std::to_string(y) + (k < 8 ? " 0\n" : " 2\n");
    }
    std::istringstream lines(points);
    for (std::string line; std::getline(lines, line);) obj += "v " + line + "\n";
    int end = 0;
    for (const std::vector<int>& face : faces) {
      off += std::to_string(face.size());
      obj += "f";
      for (const int corner : face) {
        off += " " + std::to_string(corner);
        obj += " " + std::to_string(corner + 1);
      }
      off += "\n";
      obj += "\n";
      end += static_cast<int>(face.size());
    }
    const std::vector<std::pair<std::string, std::string>> files = {
        {"u.off", "OFF\n16 10 0\n" + points + off},
        {"u.obj", obj},
        {"u.ply",
         "ply\nformat ascii 1.0\nelement vertex 16\nproperty float x\nproperty float y\n"
         "property float z\nelement face 10\nproperty list uchar int vertex_indices\n"
         "end_header\n" +
             points + off},
        {"u.vtk", "# vtk DataFile Version 3.0\nU\nASCII\nDATASET POLYDATA\nPOINTS 16 float\n" +
                      points + "POLYGONS 10 " + std::to_string(end + 10) + "\n" + off}};
    for (const auto& [name, text] : files) {
      const IndexedMesh mesh = read_mesh(file(name, text));
      ASSERT_EQ(mesh.triangles.size(), 28U) << name << " from corner " << first;
      const MeshSums sums =
          mesh_sums(mesh.points, mesh.triangles, Vector3(0.3, 0.2, 0.1), Execution(1));
      EXPECT_NEAR(sums.volume(), 14.0, 1e-12) << name << " from corner " << first;
      EXPECT_NEAR(sums.area(), 46.0, 1e-12) << name << " from corner " << first;
    }
  }
}

TEST_F(MeshFormats, OfFiniteElementsOfOthersGiveTheirFaces) {
  const IndexedMesh expected{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}},
                             {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}};
  const auto expect = [&](const std::string& name, const std::string& text) {
    const IndexedMesh mesh = read_mesh(file(name, text));
    EXPECT_EQ(mesh.points, expected.points) << name;
    EXPECT_EQ(mesh.triangles, expected.triangles) << name;
  };
  // A quadrilateral, a triangle; a point and a line are left out, and numbers have gaps.
  expect("old.msh",
         "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"skin\"\n"
         "$EndPhysicalNames\n$Nodes\n4\n10 0 0 0\n20 1 0 0\n30 1 1 0\n40 0 1 0.5\n$EndNodes\n"
         "$Elements\n4\n1 15 2 0 1 10\n2 1 2 0 1 10 20\n3 3 2 1 1 10 20 30 40\n"
         "4 2 2 1 1 10 40 20\n$EndElements\n");
  expect("new.msh",
         "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 4 10 40\n0 1 0 1\n10\n0 0 0\n"
         "2 1 0 3\n20\n30\n40\n1 0 0\n1 1 0\n0 1 0.5\n$EndNodes\n$Elements\n3 3 1 3\n"
         "0 1 15 1\n1 10\n2 1 3 1\n2 10 20 30 40\n2 1 2 1\n3 10 40 20\n$EndElements\n");
  expect("others.inp",
         "*Heading\n** made\n*Node, nset=all\n10, 0, 0, 0\n20, 1., 0., 0.\n30, 1, 1, 0\n"
         "40, 0, 1, 5e-1,\n*Element, type=CAX4P, elset=a\n1, 10, 20, 30, 40\n"
         "*Element, type=T3D2\n2, 10, 20\n*Element, TYPE = STRI3\n3, 10, 40, 20\n"
         "*Nset, nset=b\n10, 20\n");
  expect("grid.vtu",
         "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" "
         "NumberOfCells=\"3\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
         "format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0.5</DataArray></Points><Cells><DataArray "
         "type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 0 1 2 3 0 3 1</DataArray>"
         "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">2 6 9</DataArray><DataArray "
         "type=\"UInt8\" Name=\"types\" format=\"ascii\">3 9 5</DataArray></Cells></Piece>"
         "</UnstructuredGrid></VTKFile>");
  expect_refusal("binary.msh", "$MeshFormat\n4.1 1 8\n", "Save it as text");
  expect_refusal("cut.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n",
                 "cut off");
  expect_refusal("lost.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=S3\n1,1,2,3\n", "node 2");
  // A part that stays where it is.
  const std::string part =
      "*Part, name=p\n*Node\n10,0,0,0\n20,1,0,0\n30,1,1,0\n40,0,1,.5\n"
      "*Element, type=S4\n1,10,20,30,40\n*Element, type=S3\n2,10,40,20\n"
      "*End Part\n*Assembly, name=a\n*Instance, name=p-1, part=p\n";
  expect("stays.inp", part + "0., 0., 0.\n*End Instance\n*End Assembly\n");
  expect_refusal("moved.inp", part + "0., 0., 0.\n0.,0.,0.,0.,0.,1.,90.\n", "line 15 moves");
  expect_refusal("twice.inp", part + "*End Instance\n*Instance, name=p-2, part=p\n", "repeats");
  expect_refusal("volume.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D4\n1,1,1,1,1\n", "surface");
}

TEST_F(MeshFormats, OfAbaqusRefuseNodesThatLieElsewhere) {
  const std::string nodes = "\n10,0,0,0\n20,1,0,0\n30,1,1,0\n40,0,1,.5\n";
  const std::string faces = "*Element, type=S4\n1,10,20,30,40\n*Element, type=S3\n2,10,40,20\n";
  EXPECT_EQ(read_mesh(file("plain.inp", "*Node, system=R" + nodes + faces)).triangles.size(), 3U);
  expect_refusal("system.inp", "*SYSTEM\n1,2,3,1,3,3\n*Node" + nodes + faces, "line 1 moves nodes");
  expect_refusal("round.inp", "*Node, nset=a, System=C" + nodes + faces, "cylindrical");
  expect_refusal("ball.inp", "*Node, SYSTEM = s" + nodes + faces, "spherical");
  expect_refusal("parts.inp", "*Heading\n*INCLUDE, INPUT=Mesh.inp\n" + faces, "\"Mesh.inp\"");
  expect_refusal("beside.inp", "*Node, input=Nodes.txt\n" + faces, "\"Nodes.txt\"");
  expect_refusal("beside.inp", "*Node" + nodes + "*Element, type=S3, input=e.txt\n", "\"e.txt\"");
  expect_refusal("made.inp", "*Node" + nodes + faces + "*ELGEN\n2,3,1,1\n", "\"*elgen\"");
  const MeshFile turned = read_mesh_file(
      file("turned.inp", "*Node" + nodes + "*Transform, nset=a\n0,1,0,1,0,0\n" + faces));
  ASSERT_EQ(turned.warnings.size(), 1U);
  EXPECT_TRUE(holds(turned.warnings[0], "*TRANSFORM"));
  EXPECT_EQ(turned.mesh.points.size(), 4U);
}

TEST_F(MeshFormats, NameObjectsGroupsAndSolids) {
  const MeshFile obj =
      read_mesh_file(file("a.obj",
                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\no first\ng a\nf 1 3 4\n"
                          "o second one\ng b\nf 1 2 3 4\no first\nf 2 3 4\n"));
  ASSERT_EQ(obj.named_faces.size(), 2U);
  EXPECT_EQ(obj.named_faces[0].names, (std::vector<std::string>{"first", "second one"}));
  EXPECT_EQ(obj.named_faces[0].of_face, (std::vector<std::int32_t>{-1, 0, 1, 1, 0}));
  EXPECT_EQ(obj.named_faces[1].of_face, (std::vector<std::int32_t>{-1, 0, 1, 1, 1}));
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\n";
  const MeshFile stl =
      read_mesh_file(file("a.stl", "solid grain 7\n" + facet + facet + "endsolid grain 7\nsolid\n" +
                                       facet + "endsolid\n"));
  ASSERT_EQ(stl.named_faces.size(), 1U);
  EXPECT_EQ(stl.named_faces[0].names, (std::vector<std::string>{"grain 7", ""}));
  EXPECT_EQ(stl.named_faces[0].of_face, (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_TRUE(read_mesh_file(file("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nf 1 2 3\n"))
                  .named_faces.empty());
}

// Two tetrahedra and a face of no group, of which the first has a square cut in two.
TEST_F(MeshFormats, OfFiniteElementsNameTheirGroups) {
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 0\n";
  std::string commas = nodes;
  std::replace(commas.begin(), commas.end(), ' ', ',');
  const std::vector<std::int32_t> expected = {0, 0, 0, 1, 2};
  for (const auto& [name, text] :
       {std::pair(std::string("old.msh"),
                  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 7 \"bulk\"\n"
                  "2 7 \"a grain\"\n$EndPhysicalNames\n$Nodes\n5\n" +
                      nodes +
                      "$EndNodes\n$Elements\n4\n1 3 2 7 1 1 2 5 3\n2 2 2 7 2 1 2 4\n"
                      "3 2 2 9 3 1 3 4\n4 2 2 0 4 2 3 4\n$EndElements\n"),
        {"new.msh",
         "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"a grain\"\n"
         "$EndPhysicalNames\n$Entities\n1 1 3 0\n1 0 0 0 0\n7 0 0 0 1 0 0 0 2 1 -1\n"
         "1 0 0 0 1 1 0 1 7 1 7\n2 0 0 0 0 1 1 1 -9 0\n3 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n"
         "1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 0\n$EndNodes\n"
         "$Elements\n4 4 1 4\n2 1 3 1\n1 1 2 5 3\n2 1 2 1\n2 1 2 4\n2 2 2 1\n3 1 3 4\n"
         "2 3 2 1\n4 2 3 4\n$EndElements\n"},
        {"others.inp", "*Node\n" + commas +
                           "*Element, type=S4R, elset=a grain\n1,1,2,5,3\n"
                           "*Element, type=S3, elset=a grain\n2,1,2,4\n"
                           "*Element, elset=9, type=S3\n3,1,3,4\n*Element, type=S3\n4,2,3,4\n"}}) {
    SCOPED_TRACE(name);
    const MeshFile read = read_mesh_file(file(name, text));
    ASSERT_EQ(read.named_faces.size(), 1U);
    EXPECT_EQ(read.named_faces[0].names, (std::vector<std::string>{"a grain", "9", ""}));
    EXPECT_EQ(read.named_faces[0].of_face, expected);
  }
  // A face of no group before one group is a set too, as behind it.
  const MeshFile first = read_mesh_file(file(
      "first.inp",
      "*Node\n" + commas + "*Element, type=S3\n4,2,3,4\n*Element, type=S3, elset=core\n2,1,2,4\n"));
  ASSERT_EQ(first.named_faces.size(), 1U);
  EXPECT_EQ(first.named_faces[0].names, (std::vector<std::string>{"", "core"}));
  EXPECT_EQ(first.named_faces[0].of_face, (std::vector<std::int32_t>{0, 1}));
}

TEST_F(MeshFormats, ThatWouldFillTheMemoryAreRefused) {
  gzFile packed = ::gzopen(path("bomb.ply.gz").c_str(), "wb9");
  const std::string blanks(std::size_t{1} << 20, ' ');
  for (int k = 0; k < 200; ++k) ::gzwrite(packed, blanks.data(), 1U << 20U);
  ::gzclose(packed);
  const std::string sentence =
      test::refusal(ErrorCode::InputOutput, [&] { read_mesh(path("bomb.ply.gz")); });
  EXPECT_TRUE(holds(sentence, "unpacks to more than"));
  EXPECT_ERROR(read_mesh("/dev/zero"), InvalidInput);
}

TEST_F(MeshFormats, OfGmshAbaqusAndVtuHoldTheMesh) {
  const std::size_t n = lumpy_body().points.size();
  const std::size_t m = lumpy_body().triangles.size();
  write_mesh(lumpy_body(), path("a.msh"));
  write_mesh(lumpy_body(), path("a.inp"));
  write_mesh(lumpy_body(), path("a.vtu"));
  const auto nodes = numbers_between(content("a.msh"), "$Nodes\n", "$EndNodes");
  const auto elements = numbers_between(content("a.msh"), "$Elements\n", "$EndElements");
  const auto points = numbers_between(content("a.inp"), "*NODE\n", "*ELEMENT");
  const auto shells = numbers_between(content("a.inp"), "TYPE=S3, ELSET=grain\n", "*");
  const auto corners = numbers_between(content("a.vtu"), "\"connectivity\" format=\"ascii\">", "<");
  const auto ends = numbers_between(content("a.vtu"), "\"offsets\" format=\"ascii\">", "<");
  const auto types = numbers_between(content("a.vtu"), "\"types\" format=\"ascii\">", "<");
  ASSERT_EQ(nodes.size(), 8 + 4 * n);
  ASSERT_EQ(elements.size(), 8 + 4 * m);
  ASSERT_EQ(points.size(), 4 * n);
  ASSERT_EQ(shells.size(), 4 * m);
  ASSERT_EQ(corners.size(), 3 * m);
  EXPECT_EQ(ends.back(), 3.0 * static_cast<double>(m));
  EXPECT_EQ(types, std::vector<double>(m, 5.0));
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(nodes[8 + i], static_cast<double>(i + 1));
    EXPECT_EQ(points[4 * i], static_cast<double>(i + 1));
    for (std::size_t k = 0; k < 3; ++k) {
      const double coordinate = lumpy_body().points[i][static_cast<Eigen::Index>(k)];
      EXPECT_EQ(nodes[8 + n + 3 * i + k], coordinate);
      EXPECT_NEAR(points[4 * i + 1 + k] / coordinate, 1.0, 1e-12);
    }
  }
  for (std::size_t f = 0; f < m; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(elements[8 + 4 * f + 1 + k], lumpy_body().triangles[f][k] + 1.0);
      EXPECT_EQ(shells[4 * f + 1 + k], lumpy_body().triangles[f][k] + 1.0);
      EXPECT_EQ(corners[3 * f + k], lumpy_body().triangles[f][k]);
    }
  }
  // Abaqus cuts a number behind 20 characters.
  std::istringstream lines(content("a.inp"));
  for (std::string word; lines >> word;) EXPECT_LE(word.size(), 21U) << word;  // with its comma
}

// A box's face of four corners, two triangles, and a strip of three, as each version has them.
const std::vector<double> sheet_corners = {0, 0, 0, 1.5, 0, 0, 1.5, 1, 0, 0, 1, -0.25};
const std::vector<Triangle> sheet_faces = {{0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {0, 1, 3}, {3, 1, 2}};

void expect_the_faces(const std::string& where) {
  const IndexedMesh mesh = read_mesh(where);
  ASSERT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.points[1], Vector3(1.5, 0, 0));
  EXPECT_EQ(mesh.points[3], Vector3(0, 1, -0.25));
  EXPECT_EQ(mesh.triangles, sheet_faces);
}

const std::string vtk_head = "# vtk DataFile Version 4.2\na title\n";

TEST_F(MeshFormats, ReadsEveryFormOfLegacyVtk) {
  // 0 1 3 2 as a strip is 0 1 3 and, turned round, 1 3 2.
  expect_the_faces(file(
      "a.vtk", vtk_head +
                   "ASCII\nDATASET POLYDATA\nFIELD FieldData 1\nTIME 1 1 double\n0.5\n"
                   "POINTS 4 float\n0 0 0 1.5 0\n0 1.5 1 0\n0 1 -0.25\nMETADATA\nINFORMATION 0\n"
                   "\nVERTICES 1 2\n1 3\nPOLYGONS 2 9\n4 0 1 2 3\n3 3 2 1\n"
                   "TRIANGLE_STRIPS 1 5\n4 0 1 3 2\nPOINT_DATA 4\nSCALARS s double 1\n"
                   "LOOKUP_TABLE default\n1 2 3 4\n"));
  const std::string points = "BINARY\nDATASET POLYDATA\nPOINTS 4 double\n" +
                             bytes_of_all<double>(sheet_corners, order::big);
  expect_the_faces(
      file("b.vtk",
           vtk_head + points + "\nPOLYGONS 2 9\n" +
               bytes_of_all<std::int32_t>(std::vector<int>{4, 0, 1, 2, 3, 3, 3, 2, 1}, order::big) +
               "\nTRIANGLE_STRIPS 1 5\n" +
               bytes_of_all<std::int32_t>(std::vector<int>{4, 0, 1, 3, 2}, order::big) + "\n"));
  const auto array = [](const std::string& name, const std::vector<int>& numbers) {
    return name + " vtktypeint64\n" + bytes_of_all<std::int64_t>(numbers, order::big) + "\n";
  };
  expect_the_faces(file("c.vtk", "# vtk DataFile Version 5.1\nt\n" + points + "\nPOLYGONS 3 7\n" +
                                     array("OFFSETS", {0, 4, 7}) +
                                     array("CONNECTIVITY", {0, 1, 2, 3, 3, 2, 1}) +
                                     "TRIANGLE_STRIPS 2 4\n" + array("OFFSETS", {0, 4}) +
                                     array("CONNECTIVITY", {0, 1, 3, 2})));
  // A line among the cells, which is none of a surface.
  expect_the_faces(file("d.vtk", vtk_head +
                                     "ASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
                                     "0 0 0 1.5 0 0 1.5 1 0 0 1 -0.25\nCELLS 4 17\n4 0 1 2 3\n"
                                     "2 0 1\n3 3 2 1\n4 0 1 3 2\nCELL_TYPES 4\n9\n3\n5\n6\n"));
}

struct GridCell {
  int type;  ///< VTK's number
  std::vector<int> nodes;
};

/// An unstructured grid, as legacy VTK and as XML: the corners of a unit cube, four points far off
/// it, and cells with the labels 100 and 101 in turn.
std::array<std::string, 2> texts_of_grid(const std::vector<GridCell>& cells) {
  const std::string points =
      "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 9 9 9 9 8 9 8 9 9 9 9 8 ";
  std::string lists;
  std::string corners;
  std::string ends;
  std::string types;
  std::string labels;
  std::string fractions;  // of 255, as VTK writes labels of 8 bits in text
  std::size_t count = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    lists += std::to_string(cells[k].nodes.size());
    for (const int node : cells[k].nodes) {
      lists += " " + std::to_string(node);
      corners += std::to_string(node) + " ";
    }
    lists += "\n";
    count += cells[k].nodes.size();
    ends += std::to_string(count) + " ";
    types += std::to_string(cells[k].type) + " ";
    labels += std::to_string(100 + k % 2) + " ";
    fractions += std::to_string(static_cast<double>(100 + k % 2) / 255.0) + " ";
  }
  const std::string number = std::to_string(cells.size());
  const auto array = [](const std::string& name, const std::string& type,
                        const std::string& numbers) {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + numbers +
           "</DataArray>";
  };
  return {vtk_head + "ASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 float\n" + points + "\nCELLS " +
              number + " " + std::to_string(count + cells.size()) + "\n" + lists + "CELL_TYPES " +
              number + "\n" + types + "\nCELL_DATA " + number + "\nCOLOR_SCALARS label 1\n" +
              fractions + "\n",
          "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"12\" "
          "NumberOfCells=\"" +
              number + "\"><Points>" + array("Points", "Float64", points) + "</Points><Cells>" +
              array("connectivity", "Int64", corners) + array("offsets", "Int64", ends) +
              array("types", "UInt8", types) + "</Cells><CellData>" +
              array("label", "Int32", labels) + "</CellData></Piece></UnstructuredGrid></VTKFile>"};
}

// The faces of a box in every kind that VTK has for surfaces, among cells that are none: a vertex,
// a line, a body. Nodes behind the corners lie far off the box.
TEST_F(MeshFormats, ReadEveryKindOfSurfaceCellOfAGrid) {
  const std::vector<std::vector<int>> sides = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const auto box_of = [&](int type, std::size_t corners, std::size_t more, bool in_rows) {
    std::vector<GridCell> cells = {{1, {0}}, {3, {0, 1}}};
    for (const std::vector<int>& side : sides) {
      for (std::size_t k = 2; k < 4; ++k) {
        std::vector<int> nodes =
            corners == 4 ? side : std::vector<int>{side[0], side[k - 1], side[k]};
        if (in_rows) std::swap(nodes[2], nodes[3]);
        for (std::size_t m = 0; m < more; ++m) nodes.push_back(static_cast<int>(8 + m));
        if (corners == 3 || k == 3) cells.push_back({type, nodes});
      }
      if (cells.size() < 5) cells.push_back({12, {0, 1, 2, 3, 4, 5, 6, 7}});
    }
    return cells;
  };
  struct Kind {
    int type;
    std::size_t corners;
    std::size_t more;
    bool in_rows;
  };
  for (const Kind& kind : {Kind{5, 3, 0, false},
                           {6, 3, 0, false},
                           {6, 4, 0, true},
                           {7, 4, 0, false},
                           {8, 4, 0, true},
                           {9, 4, 0, false},
                           {22, 3, 3, false},
                           {23, 4, 4, false},
                           {28, 4, 4, false},
                           {30, 4, 2, false},
                           {34, 3, 4, false},
                           {36, 4, 4, false},
                           {69, 3, 3, false},
                           {70, 4, 4, false},
                           {76, 3, 3, false},
                           {77, 4, 4, false}}) {
    const std::vector<GridCell> cells = box_of(kind.type, kind.corners, kind.more, kind.in_rows);
    const std::array<std::string, 2> texts = texts_of_grid(cells);
    for (const bool is_xml : {false, true}) {
      SCOPED_TRACE("type " + std::to_string(kind.type) + (is_xml ? " in a .vtu" : " in a .vtk"));
      const MeshFile read = read_mesh_file(file(is_xml ? "a.vtu" : "a.vtk", texts[is_xml ? 1 : 0]));
      ASSERT_EQ(read.mesh.triangles.size(), 12U);
      EXPECT_NEAR(volume_of(read.mesh, Execution()), 1.0, 1e-12);
      ASSERT_EQ(read.named_faces.size(), 1U);
      for (std::size_t t = 0; t < 12; ++t) {
        const auto name = static_cast<std::size_t>(read.named_faces[0].of_face[t]);
        const std::size_t label = std::stoul(read.named_faces[0].names[name]);
        std::size_t found = 0;  // cells of this label that have its three corners
        for (std::size_t k = label - 100; k < cells.size(); k += 2) {
          const std::vector<int>& nodes = cells[k].nodes;
          const auto is_corner = [&](std::int32_t corner) {
            return std::count(nodes.begin(), nodes.end(), corner) == 1;
          };
          const Triangle& triangle = read.mesh.triangles[t];
          found += cells[k].type != 12 && std::all_of(triangle.begin(), triangle.end(), is_corner)
                       ? 1U
                       : 0U;
        }
        EXPECT_EQ(found, 1U);
      }
    }
  }
}

TEST_F(MeshFormats, RefuseWhatIsNoMeshOrIsCut) {
  expect_refusal("a.vtk", "<html>", "is not a VTK file");
  expect_refusal("a.vtk", vtk_head + "ASCII\nDATASET STRUCTURED_POINTS\n", "structured_points");
  expect_refusal("a.vtk", vtk_head + "ASCII\nDATASET POLYDATA\nPOINTS 400000000 float\n1 2 3\n",
                 "cut off");
  expect_refusal("a.vtk",
                 vtk_head +
                     "ASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\nPOLYGONS 1 4\n"
                     "3 0 0 1\n",
                 "names point 1, but holds 1");
  expect_refusal("a.vtk",
                 vtk_head +
                     "ASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\nPOLYGONS 1 4\n"
                     "4 0 0 0\n",
                 "a face of 4 corners");
  expect_refusal("a.vtk",
                 vtk_head +
                     "ASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n1 2 3 4 5 6 7 8 "
                     "9 1 2 3\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n",
                 "no triangles or polygons");
  expect_refusal("a.vtk",
                 vtk_head +
                     "ASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\nPOLYGONS 2 3\n"
                     "OFFSETS double\n0 3\n",
                 "not whole numbers");
  expect_refusal("a.vtp", "<html>", "not the XML of a .vtp");
  expect_refusal("a.vtp", "<VTKFile type=\"ImageData\"><ImageData>", "ImageData");
  expect_refusal("a.vtp", "<VTKFile type=\"PolyData\"><PolyData>", "no piece");
  expect_refusal("a.vtp",
                 "<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"><Piece "
                 "NumberOfPoints=\"1\"><Points><DataArray format=\"binary\">AAAA",
                 "vtkLZ4DataCompressor");
  expect_refusal("a.xyz", "# nothing\n", "no points");
  expect_refusal("a.xyz", "1 2 3\n4 5\n", "line 2 lacks the coordinate z");
  expect_refusal("a.csv", "x [mm],y [mm],z [um]\n1,2,3\n", "two units");
  std::string counted;
  for (int k = 1; k < 12; ++k) counted += std::to_string(k) + " 0.5 " + std::to_string(k) + " 2\n";
  expect_refusal("a.xyz", counted, "the number of each point before it");
  EXPECT_EQ(read_mesh(file("a.csv", "n x y z\n" + counted)).points[1], Vector3(0.5, 2, 2));
  EXPECT_EQ(read_mesh(file("a.csv", "sep=;\nx [mm];y(mm);z [mm]\n1;2;3\n")).points[0],
            Vector3(1, 2, 3));
  expect_refusal("a.csv", "x,y,w\n1,2,3\n", "does not name the columns x, y and z");
  expect_refusal("a.csv", "x,y,x\n1,2,3\n", "does not name the columns x, y and z");
  expect_refusal("a.csv", "x,y,z\n1,,3\n", "line 2 lacks the coordinate y");
  expect_refusal("a.pcd", "FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nPOINTS 1\nDATA ascii\n1 2\n",
                 "no fields x, y and z");
  expect_refusal("a.pcd",
                 "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 100000000\nDATA "
                 "binary\nabc",
                 "cut off");
  const std::string packed =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 1\nDATA "
      "binary_compressed\n";
  // A copy from before the beginning.
  expect_refusal("a.pcd",
                 packed + bytes_of<std::uint32_t>(3) + bytes_of<std::uint32_t>(12) + "\x20\x05z",
                 "damaged");
}

/// An array's bytes as VTK packs them, in blocks of 20: their lengths, and what follows.
std::pair<std::string, std::string> packed(const std::string& bytes) {
  constexpr std::size_t block = 20;
  std::string lengths;
  std::string blocks;
  std::uint32_t count = 0;
  for (std::size_t k = 0; k < bytes.size(); k += block, ++count) {
    const std::string part = bytes.substr(k, block);
    std::string out(100, '\0');
    uLongf size = out.size();
    ::compress(reinterpret_cast<Bytef*>(out.data()), &size,
               reinterpret_cast<const Bytef*>(part.data()), part.size());
    blocks += out.substr(0, size);
    lengths += bytes_of(static_cast<std::uint32_t>(size));
  }
  const auto last = static_cast<std::uint32_t>(bytes.size() % block);
  return {bytes_of(count) + bytes_of(static_cast<std::uint32_t>(block)) + bytes_of(last) + lengths,
          blocks};
}

TEST_F(MeshFormats, ReadsEveryFormOfVtp) {
  struct Numbers {
    std::string tag;
    std::string bytes;
  };
  const std::vector<Numbers> arrays = {
      {"Float32\" Name=\"Points\" NumberOfComponents=\"3", bytes_of_all<float>(sheet_corners)},
      {"Int32\" Name=\"connectivity",
       bytes_of_all<std::int32_t>(std::vector<int>{0, 1, 2, 3, 3, 2, 1})},
      {"Int64\" Name=\"offsets", bytes_of_all<std::int64_t>(std::vector<int>{4, 7})},
      {"UInt8\" Name=\"connectivity", bytes_of_all<std::uint8_t>(std::vector<int>{0, 1, 3, 2})},
      {"UInt16\" Name=\"offsets", bytes_of_all<std::uint16_t>(std::vector<int>{4})}};
  for (const bool is_packed : {false, true}) {
    for (const std::string form : {"binary", "base64", "raw"}) {
      SCOPED_TRACE(form + (is_packed ? ", packed" : ""));
      std::string appended;
      const auto array = [&](std::size_t k) {
        const std::string& bytes = arrays[k].bytes;
        const auto [lengths, data] =
            is_packed ? packed(bytes)
                      : std::pair(bytes_of(static_cast<std::uint32_t>(bytes.size())) + bytes,
                                  std::string());
        const std::string stored =
            form == "raw" ? lengths + data : test::base64(lengths) + test::base64(data);
        std::string text = "<DataArray type=\"" + arrays[k].tag + "\" format=\"";
        if (form == "binary") {
          text += "binary\">\n  " + stored + "\n<InformationKey name=\"k\"/></DataArray>\n";
        } else {
          text += "appended\" offset='" + std::to_string(appended.size()) + "'/>\n";
          appended += stored;
        }
        return text;
      };
      std::string text =
          std::string(
              "<?xml version=\"1.0\"?><!-- <a> <Piece> -->\n<VTKFile type=\"PolyData\" "
              "byte_order=\"LittleEndian\"") +
          (is_packed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
          "><PolyData>\n<Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\" "
          "NumberOfStrips=\"1\"><PointData><DataArray type=\"Float32\" Name=\"connectivity\" "
          "format=\"ascii\">7 7 7 7</DataArray></PointData><Points>" +
          array(0) + "</Points><Polys>" + array(1);
      text += array(2) + "</Polys><Strips>" + array(3);
      text += array(4) + "</Strips></Piece></PolyData>";
      if (form != "binary") {
        text += "<AppendedData encoding=\"" + form + "\">\n _" + appended + "</AppendedData>";
      }
      expect_the_faces(file("a.vtp", text + "</VTKFile>"));
    }
  }
}

TEST_F(MeshFormats, ReadsAllPiecesOfVtp) {
  const std::string piece =
      "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float64\" "
      "format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray type=\"Int32\" "
      "Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int32\" "
      "Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>";
  const IndexedMesh mesh = read_mesh(file(
      "a.vtp", "<VTKFile type=\"PolyData\"><PolyData>" + piece + piece + "</PolyData></VTKFile>"));
  EXPECT_EQ(mesh.points.size(), 6U);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
}

// Behind a vertex, a square and six triangles: two bodies, with labels of each cell. Neither
// fractions nor vectors nor data of points are labels.
TEST_F(MeshFormats, ReadLabelsOfFaces) {
  const std::string points = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 5 0 0 6 0 0 5 1 0 5 0 1\n";
  const std::string corners =
      "3 2 1 0 0 1 4 1 2 4 2 3 4 3 0 4 5 7 6 5 6 8 6 7 8 7 5 8\n";  // a square, eight triangles
  const std::string ends = "4 7 10 13 16 19 22 25 28\n";
  const std::string labels = "0 7 7 7 7 7 -3 -3 -3 -3\n";
  const std::string others = ".5 1 2 3 4 5 6 7 8 9\n";
  const auto array = [](const std::string& tag, const std::string& numbers) {
    return "<DataArray type=\"Float32\" format=\"ascii\" " + tag + ">" + numbers + "</DataArray>\n";
  };
  std::string piece =
      "<Piece NumberOfPoints=\"9\" NumberOfVerts=\"1\" NumberOfPolys=\"9\"><CellData>" +
      array("Name=\"a\"", others) + array("Name=\"b\"", labels) +
      array("Name=\"c\" NumberOfComponents=\"3\"", labels + labels + labels) +
      "<DataArray type=\"String\" Name=\"d\" format=\"ascii\">x</DataArray></CellData><Points>" +
      array("NumberOfComponents=\"3\"", points) + "</Points><Polys>" +
      array("Name=\"connectivity\"", corners) + array("Name=\"offsets\"", ends) +
      "</Polys></Piece>";
  const std::string vtp = "<VTKFile type=\"PolyData\"><PolyData>";
  const std::string legacy =
      vtk_head + "ASCII\nDATASET POLYDATA\nPOINTS 9 float\n" + points +
      "VERTICES 1 2\n1 0\nPOLYGONS 9 37\n4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
      "3 5 7 6\n3 5 6 8\n3 6 7 8\n3 7 5 8\nPOINT_DATA 9\nSCALARS p int\nLOOKUP_TABLE default\n"
      "1 1 1 1 1 2 2 2 2\nCELL_DATA 10\n";
  const std::vector<std::int32_t> one = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1};
  std::vector<std::int32_t> twice = one;
  twice.insert(twice.end(), one.begin(), one.end());
  for (const auto& [path, expected] :
       {std::pair(file("a.vtp", vtp + piece + "</PolyData></VTKFile>"), one),
        {file("b.vtp", vtp + piece + piece + "</PolyData></VTKFile>"), twice},
        {file("a.vtk", legacy + "SCALARS s float 1\nLOOKUP_TABLE default\n" + labels), one},
        {file("b.vtk",
              legacy + "FIELD FieldData 2\na 1 10 float\n" + others + "b 1 10 int\n" + labels),
         one}}) {
    SCOPED_TRACE(path);
    const MeshFile read = read_mesh_file(path);
    ASSERT_EQ(read.mesh.triangles.size(), expected.size());
    ASSERT_EQ(read.named_faces.size(), 1U);
    EXPECT_EQ(read.named_faces[0].names, (std::vector<std::string>{"7", "-3"}));
    EXPECT_EQ(read.named_faces[0].of_face, expected);
  }
  // Two labels a face are those of its sides, below 1 the void.
  std::string both;
  for (const char* label :
       {"0 7", "7 0", "7 -1", "0 7", "7 0", "7 0", "-3 3", "0 3", "3 0", "3 0"}) {
    both += std::string(label) + " ";
  }
  piece.replace(piece.find(array("Name=\"b\"", labels)), array("Name=\"b\"", labels).size(),
                array("Name=\"b\" NumberOfComponents=\"2\"", both));
  for (const std::string& path :
       {file("d.vtp", vtp + piece + "</PolyData></VTKFile>"),
        file("d.vtk", legacy + "SCALARS s int 2\nLOOKUP_TABLE default\n" + both),
        file("e.vtk", legacy + "FIELD FieldData 1\nb 2 10 int\n" + both)}) {
    SCOPED_TRACE(path);
    const MeshFile read = read_mesh_file(path);
    ASSERT_EQ(read.named_faces.size(), 1U);
    EXPECT_EQ(read.named_faces[0].names, (std::vector<std::string>{"7", "3"}));
    EXPECT_EQ(read.named_faces[0].of_face,
              (std::vector<std::int32_t>{0, -1, 0,  -1, 0,  -1, -1, 0,  0, -1,
                                         0, -1, -1, 1,  -1, 1,  1,  -1, 1, -1}));
  }
  // A file whose data are cut off still has its mesh.
  EXPECT_TRUE(read_mesh_file(file("c.vtk", legacy + "SCALARS s float 1\n")).named_faces.empty());
}

TEST_F(MeshFormats, ReadPointsOfTexts) {
  const std::vector<Vector3> points = {{1.5, -2, 3}, {4, 5e-1, -6}};
  EXPECT_EQ(read_mesh(file("a.xyz", "# a cloud\n1.5 -2\t3 255 0 0\n\n  4 5e-1 -6 1 1 1\n")).points,
            points);
  EXPECT_EQ(read_mesh(file("a.xyz", "1.5, -2, 3\r\n4,5e-1,-6\r\n")).points, points);
  EXPECT_EQ(read_mesh(file("a.csv", "1.5;-2;3\n4;.5;-6\n")).points, points);
  EXPECT_EQ(read_mesh(file("a.csv", "1,5;-2;3,0\n4;,5;-6\n")).points, points);
  EXPECT_EQ(
      read_mesh(file("a.csv", "\"name\",\"Z\",\"X\",,\"Y\"\na,3,1.5,,-2\n,-6,4,,0.5\n")).points,
      points);
  EXPECT_EQ(read_mesh(file("a.csv", "\"Points:0\",\"Points:1\",\"Points:2\"\n1.5,-2,3\n4,.5,-6\n"))
                .points,
            points);
  EXPECT_TRUE(read_mesh(path("a.csv")).triangles.empty());
  // A line of quotes has no field. It made the program crash.
  expect_refusal("a.csv", "\"\n1.5,-2,3\n", "line 1 lacks the coordinate x of a point");
  expect_refusal("a.xyz", " \"\" \n1.5 -2 3\n", "line 1 lacks the coordinate x of a point");
}

TEST_F(MeshFormats, ReadPointsOfTheirLibrary) {
  const std::vector<Vector3> points = {{1.5, -2, 3}, {4, 0.5, -6}};
  const std::string header =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb x y n z\nSIZE 4 4 8 2 4\nTYPE U F F I F\nCOUNT 1 1 1 2 "
      "1\nWIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ";
  const auto expect_points = [&](const std::string& text) {
    const MeshFile read = read_mesh_file(file("a.pcd", text));
    EXPECT_EQ(read.mesh.points, points);
    ASSERT_EQ(read.warnings.size(), 1U);
    EXPECT_TRUE(holds(read.warnings[0], "has 1 of 3 points without finite coordinates"));
  };
  expect_points(header + "ascii\n9 1.5 -2 7 7 3\n9 nan nan 7 7 nan\n9 4 .5 7 7 -6\n");
  const float none = std::numeric_limits<float>::quiet_NaN();
  const auto record = [](float x, double y, float z) {
    return bytes_of<std::uint32_t>(9) + bytes_of(x) + bytes_of(y) + "nnnn" + bytes_of(z);
  };
  expect_points(header + "binary\n" + record(1.5F, -2, 3) + record(none, none, none) +
                record(4, 0.5, -6));
  // By column: 12 bytes of colour, as one of zeros and a copy of it; the others as they stand, in
  // stretches of at most 32.
  const std::string columns = bytes_of_all<float>(std::vector<float>{1.5F, none, 4}) +
                              bytes_of_all<double>(std::vector<double>{-2, none, 0.5}) +
                              std::string(12, 'n') +
                              bytes_of_all<float>(std::vector<float>{3, none, -6});
  std::string packed_bytes = std::string("\0\0", 2) + std::string("\xE0\x02\x00", 3);
  for (std::size_t k = 0; k < columns.size(); k += 32) {
    const std::string part = columns.substr(k, 32);
    packed_bytes += static_cast<char>(part.size() - 1) + part;
  }
  expect_points(header + "binary_compressed\n" +
                bytes_of(static_cast<std::uint32_t>(packed_bytes.size())) +
                bytes_of<std::uint32_t>(72) + packed_bytes);
}

TEST_F(MeshFormats, ArePackedByGzip) {
  write_mesh(lumpy_body(), path("a.ply"));
  const auto pack = [&](const std::string& from, const std::string& to) {
    const std::string bytes = content(from);
    gzFile packed = ::gzopen(path(to).c_str(), "wb");
    ::gzwrite(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
    ::gzclose(packed);
  };
  pack("a.ply", "b.PLY.gz");
  EXPECT_EQ(read_mesh(path("b.PLY.gz")).points, lumpy_body().points);
  // Whatever its name says.
  pack("a.ply", "c.ply");
  EXPECT_EQ(read_mesh(path("c.ply")).triangles, lumpy_body().triangles);
  const std::string whole = content("c.ply");
  expect_refusal("cut.ply.gz", whole.substr(0, whole.size() / 2), "gzip");
  std::string wrong = whole;
  wrong[wrong.size() / 2] ^= 0x10;
  expect_refusal("wrong.ply.gz", wrong, "gzip");
  EXPECT_ERROR(write_mesh(lumpy_body(), path("d.ply.gz")), InvalidInput);
}

TEST(MeshFormatNames, SayWhatIsReadAndWhatIsWritten) {
  EXPECT_TRUE(is_mesh_format("a.VTP", MeshUse::Read) && is_mesh_format("a.vtp", MeshUse::Write));
  EXPECT_TRUE(is_mesh_format("a.msh", MeshUse::Read) && is_mesh_format("a.msh", MeshUse::Write));
  EXPECT_TRUE(is_mesh_format("a.csv", MeshUse::Read) && !is_mesh_format("a.csv", MeshUse::Write));
  EXPECT_FALSE(is_mesh_format("a.gz", MeshUse::Read));
  // In a folder of scans a table is none of them.
  EXPECT_TRUE(is_mesh_file("a.vtk") && is_mesh_file("a.ply.gz") && !is_mesh_file("grains.csv"));
  EXPECT_FALSE(is_mesh_file("job.inp"));
  EXPECT_EQ(mesh_extensions(MeshUse::Write),
            ".ply, .stl, .ascii.stl, .obj, .off, .vtp, .vtk, .vtu, .msh or .inp");
  EXPECT_EQ(mesh_extensions(MeshUse::Read),
            ".ply, .stl, .obj, .off, .vtp, .vtk, .vtu, .msh, .inp, .xyz, .csv or .pcd");
  EXPECT_ERROR(check_mesh_format("a.step", MeshUse::Read), InvalidInput);
}

}  // namespace
}  // namespace wscvt
