// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/holds.h"
#include "support/read_content.h"
#include "support/seeds.h"
#include "wscvt/mesh_files/readers.h"

namespace wscvt {
namespace {

using test::bytes;

IndexedMesh read(const std::string& content) { return test::read_content(read_ply, content); }
std::string refusal(const std::string& content) { return test::refusal(read_ply, content); }

/// A tetrahedron on small whole coordinates, which every scalar type holds.
const std::vector<Vector3> corners{{0, 0, 0}, {5, 0, 1}, {0, 7, 2}, {1, 1, 9}};
const std::vector<Triangle> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

const std::array<const char*, 8> types{"char", "uchar", "short", "ushort",
                                       "int",  "uint",  "float", "double"};

/// A number as a file of one encoding holds it.
std::string number(double value, const std::string& type, const std::string& encoding) {
  if (encoding == "ascii") return std::to_string(static_cast<int>(value)) + " ";
  const bool big = encoding == "binary_big_endian";
  if (type == "char") return bytes(static_cast<std::int8_t>(value), big);
  if (type == "uchar") return bytes(static_cast<std::uint8_t>(value), big);
  if (type == "short") return bytes(static_cast<std::int16_t>(value), big);
  if (type == "ushort") return bytes(static_cast<std::uint16_t>(value), big);
  if (type == "int") return bytes(static_cast<std::int32_t>(value), big);
  if (type == "uint") return bytes(static_cast<std::uint32_t>(value), big);
  if (type == "float") return bytes(static_cast<float>(value), big);
  return bytes(value, big);
}

std::string header_of(const std::string& encoding, const std::string& rest) {
  return "ply\nformat " + encoding + " 1.0\n" + rest + "end_header\n";
}

TEST(PlyReader, ReadsEveryScalarTypeInEveryEncoding) {
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string coordinate : types) {
      for (const std::string index : types) {
        for (std::size_t c = 0; c < 6; ++c) {
          const std::string count = types[c];
          SCOPED_TRACE(encoding + " " + coordinate + " " + count + " " + index);
          const std::string p = "property " + coordinate;
          std::string content = header_of(encoding, "element vertex 4\n" + p + " x\n" + p + " y\n" +
                                                        p + " z\nelement face 4\nproperty list " +
                                                        count + " " + index + " vertex_indices\n");
          const std::string end = encoding == "ascii" ? "\n" : "";
          for (const Vector3& v : corners) {
            for (const double k : v) content += number(k, coordinate, encoding);
            content += end;
          }
          for (const Triangle& t : faces) {
            content += number(3, count, encoding);
            for (const std::int32_t k : t) content += number(k, index, encoding);
            content += end;
          }
          const IndexedMesh mesh = read(content);
          EXPECT_EQ(mesh.points, corners);
          EXPECT_EQ(mesh.triangles, faces);
          EXPECT_NE(refusal(content.substr(0, content.size() - 3)), "");
        }
      }
    }
  }
}

TEST(PlyReader, KeepsNumbersOfVerticesAndFacesButNotNormals) {
  const std::string rest =
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty uchar red\nproperty double quality\nproperty short red\n"
      "element face 2\nproperty int label\nproperty list uchar int vertex_indices\n"
      "property uchar flags\nproperty float heat\n";
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE(encoding);
    const auto put = [&](double value, const std::string& type) {
      return number(value, type, encoding);
    };
    const std::string end = encoding == "ascii" ? "\n" : "";
    std::string content = header_of(encoding, rest);
    for (int i = 0; i < 4; ++i) {
      for (const double k : corners[static_cast<std::size_t>(i)]) content += put(k, "float");
      content +=
          put(9, "float") + put(10 * i, "uchar") + put(7 - i, "double") + put(77, "short") + end;
    }
    content += put(-5, "int") + put(4, "uchar");
    for (const int k : {0, 2, 1, 3}) content += put(k, "int");
    content += put(1, "uchar") + put(6, "float") + end + put(1234, "int") + put(3, "uchar");
    for (const int k : {0, 1, 3}) content += put(k, "int");
    content += put(1, "uchar") + put(8, "float") + end;
    const MeshFile file = test::read_file(read_ply, content);
    const IndexedMesh& mesh = file.mesh;
    const MeshAttributes& kept = file.attributes;
    ASSERT_EQ(mesh.triangles.size(), 3U);  // a quadrangle and a triangle
    EXPECT_EQ(mesh.points, corners);
    ASSERT_EQ(kept.of_vertices.size(), 2U);
    EXPECT_EQ(kept.of_vertices[0].name, "red");
    EXPECT_EQ(kept.of_vertices[0].type, ScalarType::Uint8);
    EXPECT_EQ(kept.of_vertices[0].values, (std::vector<double>{0, 10, 20, 30}));
    EXPECT_EQ(kept.of_vertices[1].name, "quality");
    EXPECT_EQ(kept.of_vertices[1].values, (std::vector<double>{7, 6, 5, 4}));
    ASSERT_EQ(kept.of_faces.size(), 2U);
    EXPECT_EQ(kept.of_faces[0].name, "label");
    EXPECT_EQ(kept.of_faces[0].type, ScalarType::Int32);
    EXPECT_EQ(kept.of_faces[0].values, (std::vector<double>{-5, -5, 1234}));
    EXPECT_EQ(kept.of_faces[1].values, (std::vector<double>{6, 6, 8}));
  }
}

TEST(PlyReader, PassesOverOtherElementsAndPropertiesInAnyOrder) {
  // Faces before the vertices, lists and numbers around what is wanted, types mixed.
  const std::string rest =
      "comment by hand\nelement camera 2\nproperty double view\nproperty list uchar int marks\n"
      "element face 4\nproperty list uchar float texcoord\nproperty uchar flags\n"
      "property list int short Vertex_Index\nproperty float quality\n"
      "obj_info none\nelement material 1\nproperty int ka\n"
      "element vertex 4\nproperty list uchar uchar tags\nproperty double Z\nproperty float nx\n"
      "property short X\nproperty int Y\nelement empty 4000000000000\n";
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE(encoding);
    const auto put = [&](double value, const std::string& type) {
      return number(value, type, encoding);
    };
    const std::string end = encoding == "ascii" ? "\n" : "";
    std::string content = header_of(encoding, rest);
    for (int i = 0; i < 2; ++i) {
      content += put(1, "double") + put(i, "uchar");
      for (int k = 0; k < i; ++k) content += put(9, "int");
      content += end;
    }
    for (const Triangle& t : faces) {
      content += put(2, "uchar") + put(4, "float") + put(5, "float") + put(1, "uchar");
      content += put(3, "int");
      for (const std::int32_t k : t) content += put(k, "short");
      content += put(8, "float") + end;
    }
    content += put(6, "int") + end;
    for (const Vector3& v : corners) {
      content += put(1, "uchar") + put(3, "uchar") + put(v.z(), "double") + put(2, "float") +
                 put(v.x(), "short") + put(v.y(), "int") + end;
    }
    const IndexedMesh mesh = read(content);
    EXPECT_EQ(mesh.points, corners);
    EXPECT_EQ(mesh.triangles, faces);
  }
}

TEST(PlyReader, ReadsTriangleStrips) {
  const std::string rest =
      "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::vector<Triangle> expected{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}};
  const std::vector<int> strip{0, 1, 2, 3, 4, -1, 4, 3, 3, -1, 4, 3, 0};
  for (const std::string encoding : {"ascii", "binary_little_endian"}) {
    const std::string end = encoding == "ascii" ? "\n" : "";
    std::string content = header_of(encoding, rest);
    for (int i = 0; i < 5; ++i) {
      for (int k = 0; k < 3; ++k) content += number(i * k, "float", encoding);
      content += end;
    }
    content += number(static_cast<double>(strip.size()), "int", encoding);
    for (const int k : strip) content += number(k, "int", encoding);
    EXPECT_EQ(read(content + end).triangles, expected);
  }
}

TEST(PlyReader, ReadsWindowsAndOldMacintoshLines) {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment a\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n+1e0\t0  0.5\n0 1 0\n\n3 0 1 2\n";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string content;
    for (const char c : text) content += c == '\n' ? end : std::string(1, c);
    const IndexedMesh mesh = read(content);
    ASSERT_EQ(mesh.points.size(), 3U);
    EXPECT_EQ(mesh.points[1], Vector3(1, 0, 0.5));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  }
  // Binary, whose first byte after the header could be taken for an end of line.
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string content = "ply" + end + "format binary_little_endian 1.0" + end +
                          "element vertex 1" + end + "property uchar x" + end + "property uchar y" +
                          end + "property uchar z" + end + "end_header" + end;
    EXPECT_EQ(read(content + "\r\x0c\x0d").points.front(), Vector3(13, 12, 13));
  }
}

TEST(PlyReader, ItsLastLineNeedsNoEndHoweverShortItIs) {
  // The shortest records that there are: a digit a line.
  const std::string points = header_of("ascii",
                                       "element vertex 3\nproperty float x\nproperty float y\n"
                                       "property float z\nelement flag 4\nproperty uchar f\n") +
                             "0 1 2\n3 4 5\n6 7 8\n1\n0\n1\n0";
  for (const std::string end : {"", "\n", "\r\n", "\n\n"}) {
    const IndexedMesh mesh = read(points + end);
    ASSERT_EQ(mesh.points.size(), 3U);
    EXPECT_EQ(mesh.points[2], Vector3(6, 7, 8));
  }
  // A line less is one too few.
  EXPECT_NE(refusal(points.substr(0, points.size() - 2)), "");
  // The last of the vertices, and the last of the faces, likewise.
  const std::string vertices =
      header_of("ascii", "element vertex 2\nproperty int x\nproperty int y\nproperty int z\n") +
      "1 2 3\n4 5 6";
  EXPECT_EQ(read(vertices).points, (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(read(header_of("ascii",
                           "element vertex 3\nproperty int x\nproperty int y\nproperty int z\n"
                           "element face 1\nproperty list uchar int vertex_index\n") +
                 "1 2 3\n4 5 6\n7 8 0\n3 0 1 2")
                .triangles,
            (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(PlyReader, BelievesNoCount) {
  const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
  const std::string four = "0 0 0\n0 0 1\n0 1 0\n1 0 0\n";
  // Each took gigabytes, or would take for ever.
  for (const std::string& content :
       {header_of("ascii", "element vertex 4\n" + vertex +
                               "element face 1\nproperty list uint int vertex_indices\n") +
            four + "1000000000 0 1 2\n",
        header_of("ascii", "element vertex 9223372036854775807\n" + vertex) + four,
        header_of("ascii", "element vertex 2000000000\n" + vertex) + four,
        header_of(
            "binary_little_endian",
            "element other 9223372036854775807\nproperty int a\nelement vertex 1\n" + vertex) +
            std::string(12, '\0'),
        header_of("binary_little_endian",
                  "element other 9223372036854775807\nproperty list uint double a\n"
                  "element vertex 1\n" +
                      vertex) +
            std::string(12, '\xff'),
        header_of("binary_big_endian",
                  "element vertex 1\n" + vertex +
                      "element face 1\nproperty list uint double vertex_indices\n") +
            std::string(16, '\x7f')}) {
    EXPECT_NE(refusal(content), "");
  }
}

TEST(PlyReader, NamesTheLineOrTheElement) {
  const std::string rest =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string text = header_of("ascii", rest);  // nine lines
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const auto says = [](const std::string& content, const std::string& part) {
    const std::string sentence = refusal(content);
    EXPECT_TRUE(test::holds(sentence, part));
  };
  says("not a mesh\n", "\"ply\"");
  says("", "\"ply\"");
  says("ply\nformat ascii 1.0\n", "end_header");
  says("ply\nend_header\n", "\"format\"");
  says("ply\nformat ascii 1.0\nend_header\n", "\"vertex\"");
  says("ply\nformat text 1.0\nend_header\n", "line 2 ");
  says("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "line 3 ");
  says("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n", "line 3 ");
  says("ply\nformat ascii 1.0\nelement vertex many\nend_header\n", "\"many\"");
  says("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n", "line 4 ");
  says("ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n",
       "line 4 ");
  says("ply\nformat ascii 1.0\nelements vertex 1\nend_header\n", "line 3 ");
  says(header_of("ascii", "element vertex 1\nproperty float x\nproperty float y\n") + "0 0\n",
       "\"z\"");
  says(text + "0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", "line 11 (vertex 1) has \"zero\"");
  says(text + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 11 (vertex 1) holds fewer");
  says(text + "0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n", "line 11 (vertex 1) holds more");
  says(text + "0 0 0\n1 0 0,5\n0 1 0\n3 0 1 2\n", "\"0,5\"");
  says(text + points + "3 0 1 3\n", "line 13 (face 0) names vertex 3");
  says(text + points + "3 0 1 -2\n", "names vertex -2");
  says(text + points + "3 0 1 0.5\n", "(face 0) names vertex");
  says(text + points + "2.5 0 1 2\n", "count");
  says(text + points + "2 0 1\n", "none of them has three corners");
  says(text + points, "declares 1 elements \"face\"");
  says(text + points + "   \n", "ends within face 0");
  const std::string binary = header_of("binary_little_endian", rest);
  says(binary + std::string(36, '\0') + std::string("\3\0\0\0\0\1\0\0\0\3\0\0\0", 13),
       "(face 0) names vertex 3");
  says(binary + std::string(36, '\0') + std::string("\3\0\0\0\0\1\0\0\0\xff\xff\xff\xff", 13),
       "(face 0) names vertex -1");
  says(binary + std::string(36, '\0') + std::string("\3\0\0\0\0\1\0\0\0\2", 10),
       "ends within face 0");
  // Names are shown without what would cut the sentence or move the cursor.
  says(std::string("ply\nformat ascii 1.0\nelement a\0b\x1b 5\nproperty int a\nelement vertex 0\n"
                   "property int x\nproperty int y\nproperty int z\nend_header\n",
                   124),
       "\"a?b?\"");
  // The advice of them all is a file that the header fits.
  EXPECT_EQ(read(text + points + "3 0 1 2\n").triangles.size(), 1U);
}

TEST(PlyReader, SurvivesBytesThatWereChanged) {
  // What comes out, if anything, names only vertices that are there.
  const std::string rest =
      "element vertex 4\nproperty float x\nproperty short y\nproperty float z\n"
      "element face 4\nproperty uchar a\nproperty list uchar int vertex_indices\n"
      "element tristrips 1\nproperty list uint int vertex_indices\n";
  std::mt19937 generator(test::announced(77));
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string end = encoding == "ascii" ? "\n" : "";
    std::string content = header_of(encoding, rest);
    for (const Vector3& v : corners) {
      content += number(v.x(), "float", encoding) + number(v.y(), "short", encoding) +
                 number(v.z(), "float", encoding) + end;
    }
    for (const Triangle& t : faces) {
      content += number(7, "uchar", encoding) + number(3, "uchar", encoding);
      for (const std::int32_t k : t) content += number(k, "int", encoding);
      content += end;
    }
    content += number(3, "uint", encoding);
    for (int k = 0; k < 3; ++k) content += number(k, "int", encoding);
    content += end;
    EXPECT_EQ(read(content).triangles.size(), 5U);
    for (int trial = 0; trial < 3000; ++trial) {
      std::string changed = content;
      for (int k = 0; k < 1 + trial % 4; ++k) {
        changed[generator() % changed.size()] = static_cast<char>(generator());
      }
      if (trial % 3 == 0) changed.resize(generator() % changed.size());
      try {
        const IndexedMesh mesh = read(changed);
        for (const Triangle& t : mesh.triangles) {
          for (const std::int32_t v : t) {
            ASSERT_GE(v, 0);
            ASSERT_LT(static_cast<std::size_t>(v), mesh.points.size());
          }
        }
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InputOutput) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace wscvt
