// SPDX-License-Identifier: GPL-3.0-or-later
// The formats that are, or may be, text: OBJ, OFF and STL.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "support/holds.h"
#include "support/read_content.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/readers.h"

namespace wscvt {
namespace {

using test::bytes;
using test::read_content;

void expect_refusal(test::Reader read, const std::string& content, const std::string& part) {
  const std::string sentence = test::refusal(read, content);
  EXPECT_TRUE(test::holds(sentence, part));
}

TEST(ObjReader, ReadsWhatOtherProgramsWrite) {
  const std::string text =
      "\xEF\xBB\xBF# a grain\nmtllib a b.mtl\no grain # 1\ng all\nusemtl none\ns off\n"
      "v 0 0 0\nv\t1.0\t0\t0 0.5 0.5 0.5\nv 1 1 0 1.0\n  v 0 1 0.125 # the last\n"
      "vt 0.5 0.5\nvn 0 0 1\nvp 1\nl 1 2\nl 1/1 2/1 3/1\np 1\n"
      "f 1/1/1 2//1 3/1 4\nf -4/-1/-1 \\\n -3 \\\n -1\nend words of a later version\n";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string content;
    for (const char c : text) content += c == '\n' ? end : std::string(1, c);
    const IndexedMesh mesh = read_content(read_obj, content);
    EXPECT_EQ(mesh.points, (std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.125}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
  }
  // Faces between the vertices, some named before they stand there.
  const IndexedMesh mixed =
      read_content(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\nf 1 2 4\nv 0 0 1\nf -1 1 2");
  EXPECT_EQ(mixed.triangles, (std::vector<Triangle>{{2, 1, 0}, {0, 1, 3}, {3, 0, 1}}));
}

TEST(ObjReader, NamesTheLine) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_refusal(read_obj, "", "holds no vertex");
  expect_refusal(read_obj, "<html>\n", "holds no vertex");
  expect_refusal(read_obj, "v 0 0 0\nv 0 zero 0\n", "line 2 has \"zero\"");
  expect_refusal(read_obj, "v 0 0 0\nv 1 0\n", "line 2 gives a vertex fewer");
  expect_refusal(read_obj, "v 0 0 0\nv 1 0 1e999\n", "line 2 has \"1e999\"");
  expect_refusal(read_obj, points + "f 1 2 4\nf 1 2 3\n", "line 4 names vertex 4");
  expect_refusal(read_obj, points + "f 0 1 2\n", "line 4 has \"0\"");
  expect_refusal(read_obj, points + "f 1 2 -4\n", "line 4 names vertex -4");
  expect_refusal(read_obj, points + "f 1 2 99999999999\n", "line 4 names vertex 99999999999");
  expect_refusal(read_obj, points + "f 1 2 x/1\n", "line 4 has \"x/1\"");
  expect_refusal(read_obj, points + "f 1 2\n", "none of them has three corners");
  expect_refusal(read_obj, points + "\\\n\\\nf 1 2 \\\n9\n", "line 7 names vertex 9");
}

TEST(OffReader, ReadsItsForms) {
  const std::vector<Triangle> two{{0, 1, 2}, {0, 2, 3}};
  for (const std::string text :
       {"OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 3\n",
        "OFF 4 1\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 3 255 0 0\n",
        "# made by hand\n\nCOFF # with colours\n# counts\n4 1 6\n\n0 0 0 255 0 0 255\n"
        "1 0 0 255 0 0 255 # second\n1 1 0 0 0 0 1\n\t0 1\t0.5 0 0 0 1\n\n4 0 1 2 3",
        "NOFF\r\n4 1 0\r\n0 0 0 0 0 1\r\n1 0 0 0 0 1\r\n1 1 0 0 0 1\r\n0 1 0.5 0 0 1\r\n"
        "4 0 1 2 3\r\n",
        "STCNOFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n3 0 1 2\n3 0 2 3 0.1 0.2\n"}) {
    SCOPED_TRACE(text);
    const IndexedMesh mesh = read_content(read_off, text);
    EXPECT_EQ(mesh.points, (std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}}));
    EXPECT_EQ(mesh.triangles, two);
  }
}

TEST(OffReader, ItsLastLineNeedsNoEndHoweverShortItIs) {
  // The shortest vertices, and no face.
  for (const std::string end : {"", "\n", "\r\n"}) {
    const IndexedMesh mesh = read_content(read_off, "OFF\n3 0 0\n0 1 2\n3 4 5\n6 7 8" + end);
    EXPECT_EQ(mesh.points, (std::vector<Vector3>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
  }
  // The shortest faces behind one.
  for (const std::string end : {"", "\n"}) {
    const IndexedMesh mesh =
        read_content(read_off, "OFF\n3 3 0\n0 1 2\n3 4 5\n6 7 8\n3 0 1 2\n0\n0" + end);
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  }
}

TEST(OffReader, SaysWhatIsWrong) {
  const std::string four = "OFF\n4 1 0\n0 0 0\n0 0 1\n0 1 0\n1 0 0\n";
  expect_refusal(read_off, "", "\"OFF\"");
  expect_refusal(read_off, "4 1 0\n0 0 0\n", "\"OFF\"");
  expect_refusal(read_off, "OFFICE\n4 1 0\n0 0 0\n", "\"OFF\"");
  expect_refusal(read_off, "4OFF\n1 0 0\n0 0 0 1\n", "plain OFF");
  expect_refusal(read_off, "nOFF\n5\n1 0 0\n0 0 0 1 2\n", "plain OFF");
  expect_refusal(read_off, "OFF BINARY\n" + std::string(40, '\0'), "as text");
  expect_refusal(read_off, "OFF\nmany 1 0\n", "line 2 has \"many\"");
  expect_refusal(read_off, "OFF\n-4 1 0\n", "line 2 has \"-4\"");
  expect_refusal(read_off, "OFF\n1000000000 4000000000 0\n0 0 0\n", "declares 1000000000");
  expect_refusal(read_off, "OFF\n4 9223372036854775807 0\n" + std::string(99, ' '), "declares 4");
  expect_refusal(read_off, four + "1000000000 0 1 2\n", "line 7 (face 0) claims 1000000000");
  expect_refusal(read_off, four + "3 0 1 4\n", "line 7 (face 0) names vertex 4");
  expect_refusal(read_off, four + "3 0 1 -1\n", "line 7 has \"-1\"");
  expect_refusal(read_off, four + "3 0 1\n", "line 7 ");
  expect_refusal(read_off, four + "2 0 1\n", "none of them has three corners");
  expect_refusal(read_off, four + "   ", "ends before face 0 of 1");
  expect_refusal(read_off, "OFF\n4 0 0\n0 0 0\n0 0 1\n0 1 0\n           ", "before vertex 3 of 4");
  expect_refusal(read_off, "OFF\n2 0 0\n0 0 0\n0 zero 1\n", "line 4 (vertex 1) has \"zero\"");
}

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0.5\nvertex 0 1e0 0\nendloop\n"
    "endfacet\n";

TEST(StlReader, ReadsTextInEitherCase) {
  std::string capitals = "SOLID A\n" + facet + facet + "ENDSOLID A\n";
  for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  std::string windows;
  for (const char c : capitals) windows += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& text : std::vector<std::string>{
           capitals, windows, "\xEF\xBB\xBF" + windows,
           "solid facet vertex\n" + facet + facet + "endsolid facet vertex",
           "solid\n" + facet + "endsolid\n\nsolid b\n" + facet + "endsolid b\n\n",
           "solid a\nfacet normal nan -nan(ind) nan outer loop vertex 0 0 0 vertex 1 0 0.5\n"
           "vertex 0 1 0 endloop endfacet\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0.5\n"
           "vertex 0 1 0\nendloop\nendfacet\nendsolid"}) {
    SCOPED_TRACE(text);
    const IndexedMesh mesh = read_content(read_stl, text);
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
    ASSERT_EQ(mesh.points.size(), 6U);
    EXPECT_EQ(mesh.points[4], Vector3(1, 0, 0.5));
  }
}

TEST(StlReader, TellsBinaryByItsSize) {
  std::string content = "solid grain" + std::string(69, ' ') + bytes(std::uint32_t{1});
  for (int k = 0; k < 12; ++k) content += bytes(static_cast<float>(k));
  content += std::string(2, '\0');
  const IndexedMesh mesh = read_content(read_stl, content);
  EXPECT_EQ(mesh.points, (std::vector<Vector3>{{3, 4, 5}, {6, 7, 8}, {9, 10, 11}}));
  expect_refusal(read_stl, content.substr(0, content.size() - 1), "cut off");
  expect_refusal(read_stl, "grain" + content.substr(5, content.size() - 6),
                 "announces 1 triangles");
  expect_refusal(read_stl, std::string(84, '\0'), "no triangles");
  expect_refusal(read_stl, std::string(80, 'a') + "\xff\xff\xff\xff", "announces 4294967295");
}

TEST(StlReader, SaysWhatIsWrong) {
  expect_refusal(read_stl, "", "too short");
  expect_refusal(read_stl, "solid a\nendsolid a\n", "no triangles");
  // Cut off anywhere, also between two facets.
  const std::string whole = "solid a\n" + facet + facet + "endsolid\n";
  for (std::size_t length = 8; length < whole.size() - 1; ++length) {
    EXPECT_NE(test::refusal(read_stl, whole.substr(0, length)), "");
  }
  expect_refusal(read_stl, "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n",
                 "line 4 has \"zero\"");
  expect_refusal(read_stl, "solid a\n" + facet + "face\n", "line 9 has \"face\"");
  expect_refusal(read_stl, "solid a\n" + facet + "endsolid\nmore\n", "line 10 has \"more\"");
  expect_refusal(read_stl,
                 "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 1\n"
                 "vertex 0 1 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid\n",
                 "line 7 has \"vertex\" instead of \"endloop\"");
}

TEST(ByteReader, AReadThatFailsIsNotTheEndOfTheFile) {
  // Of its own memory a process can read no byte at 0: the system's error is that of a bad disk.
  InputFile memory("/proc/self/mem");
  ByteReader reader(memory, 1000, "/proc/self/mem");
  EXPECT_THROW(reader.next(10), MachineRefused);
}

}  // namespace
}  // namespace wscvt
