// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/coded_bytes.h"
#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/readers.h"

namespace wscvt {
namespace {

using Colours = std::vector<std::uint8_t>;

std::string of_hexadecimal(const std::string& hexadecimal) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hexadecimal.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

/// Six pixels of six colours, by ImageMagick.
const std::string png_of_six = of_hexadecimal(
    "89504e470d0a1a0a0000000d49484452000000030000000204030000006f5a7b2900000012504c54450ac81e5a14fa"
    "ff8000003c8c46f005212c37415cc95a0000000e4944415408d76360546030090000014300a66ee6c21000000000"
    "49454e44ae426082");
const Colours six_colours = {10, 200, 30,  90, 20,  250, 255, 128, 0,
                             0,  60,  140, 70, 240, 5,   33,  44,  55};

/// 16 x 8 pixels, the left half (200, 40, 90), the right half (20, 150, 60), by ImageMagick.
const std::string jpeg_of_two = of_hexadecimal(
    "ffd8ffe000104a46494600010100000100010000ffdb0043000302020302020303030304030304050805050404050a"
    "070706080c0a0c0c0b0a0b0b0d0e12100d0e110e0b0b1016101113141515150c0f171816141812141514ffdb004301"
    "03040405040509050509140d0b0d1414141414141414141414141414141414141414141414141414141414141414"
    "14141414141414141414141414141414141414141414ffc00011080008001003011100021101031101ffc4001500"
    "010100000000000000000000000000000507ffc40014100100000000000000000000000000000000ffc40017010003"
    "010000000000000000000000000003060809ffc40014110100000000000000000000000000000000ffda000c0301"
    "0002110311003f009204b2c991d932ffd9");

/// Pictures are an optional part of the build.
class TextureFiles : public test::FileFolder {
 protected:
  void SetUp() override {
    FileFolder::SetUp();
    try {
      read_picture(file("six.png", png_of_six));
    } catch (const Error& error) {
      if (std::string(error.what()).find("libstb-dev") != std::string::npos) GTEST_SKIP();
    }
  }

  /// The scan with its pictures.
  MeshFile scan(const std::string& name, const std::string& content) const {
    const std::string whole = file(name, content);
    MeshFile read = read_mesh_file(whole);
    read_pictures(read, whole);
    return read;
  }
};

/// Fails unless the picture is an error whose sentence holds `text`.
void expect_no_picture(const std::string& path, const std::string& text) {
  const std::string sentence = test::refusal(ErrorCode::InputOutput, [&] { read_picture(path); });
  EXPECT_TRUE(test::holds(sentence, text));
}

const std::string four_vertices = "v 0 0 0\nv 3 0 0\nv 0 5 0\nv 0 0 7\n";
const std::string four_places = "vt .1 .2\nvt .9 .25 0\nvt .3 2.75\nvt -1.5 .5\n";

void expect_corners(const std::array<MeshTexture::Place, 3>& read,
                    const std::array<std::array<float, 2>, 3>& expected) {
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(read[k].x(), expected[k][0]) << k;
    EXPECT_EQ(read[k].y(), expected[k][1]) << k;
  }
}

TEST_F(TextureFiles, PngJpegAndTgaAreReadFromTheUpperLeftCorner) {
  const TexturePicture png = read_picture(path("six.png"));
  EXPECT_EQ(png.width, 3);
  EXPECT_EQ(png.height, 2);
  EXPECT_EQ(png.colours, six_colours);
  EXPECT_EQ(read_picture(file("six.tga", test::tga_picture(3, 2, six_colours))).colours,
            six_colours);
  const TexturePicture jpeg = read_picture(file("two.jpg", jpeg_of_two));
  ASSERT_EQ(jpeg.colours.size(), 3U * 16U * 8U);
  const std::array<int, 6> both = {200, 40, 90, 20, 150, 60};
  // Of pictures in two blocks JPEG keeps the colours to some steps of its table.
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(jpeg.colours[k < 3 ? k : 8 * 3 + k], both[k], 6) << k;
}

TEST_F(TextureFiles, WhatIsNoPictureIsAnErrorThatNamesIt) {
  const std::string cut = file("cut.png", png_of_six.substr(0, 60));
  expect_no_picture(cut, cut);
  expect_no_picture(file("text.jpg", "not a picture"), "text.jpg");
  expect_no_picture(path("missing.png"), "is not there");
  expect_no_picture(folder_.string(), "is no file");
  // 60,000 x 60,000 pixels.
  std::string large = test::tga_picture(3, 2, six_colours);
  large[12] = large[14] = '\x60';
  large[13] = large[15] = '\xEA';
  expect_no_picture(file("large.tga", large), "400 million");
}

TEST_F(TextureFiles, ObjHasThePlacesOfItsCornersAndPicturesOfItsMaterials) {
  file("two halves.jpg", jpeg_of_two);
  file("my materials.mtl",
       "# by hand\nnewmtl stone face\nKd .1 .1 .1\nmap_Kd -s 1 1 1 -clamp on two halves.jpg\n"
       "newmtl rim\nKd 0.2 1.5 0.6\nnewmtl six_colours\nmap_Kd C:\\scans\\pictures\\six.png\n");
  const MeshFile read =
      scan("a.obj", "mtllib my materials.mtl\n" + four_vertices + four_places +
                        "f 1 2 3\nusemtl stone face\nf 1/1 2/2 3/3 4/4\nusemtl six_colours\n"
                        "f 1/-1/1 3/-2/2 4/1/3\nusemtl rim\nf 2//1 3//2 4//3\nusemtl stone face\n"
                        "f 4/4 3/9 1/1\n");
  EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  const MeshTexture& texture = read.attributes.texture;
  EXPECT_EQ(texture.picture_of_face, (std::vector<std::int32_t>{-1, 0, 0, 1, 2, 0}));
  ASSERT_EQ(texture.corners.size(), 6U);
  expect_corners(texture.corners[1], {{{.1F, .2F}, {.9F, .25F}, {.3F, 2.75F}}});
  expect_corners(texture.corners[2], {{{.1F, .2F}, {.3F, 2.75F}, {-1.5F, .5F}}});
  expect_corners(texture.corners[3], {{{-1.5F, .5F}, {.3F, 2.75F}, {.1F, .2F}}});
  EXPECT_FALSE(texture.corners[0][0].allFinite());
  EXPECT_FALSE(texture.corners[4][2].allFinite());
  EXPECT_FALSE(texture.corners[5][1].allFinite());  // there is no place 9
  EXPECT_TRUE(texture.corners[5][2].allFinite());
  ASSERT_EQ(texture.pictures.size(), 3U);
  EXPECT_EQ(texture.pictures[0].width, 16);
  EXPECT_EQ(texture.pictures[1].colours, six_colours);
  // A material without a picture is one pixel of its colour.
  EXPECT_EQ(texture.pictures[2].colours, (Colours{51, 255, 153}));
}

TEST_F(TextureFiles, MissingFilesAreWarningsThatNameThem) {
  const std::string of_faces =
      four_vertices + four_places + "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/2 4/3\n";
  const MeshFile no_library = scan("a.obj", "mtllib none.mtl\n" + of_faces);
  ASSERT_EQ(no_library.warnings.size(), 1U);
  EXPECT_TRUE(test::holds(no_library.warnings[0], "none.mtl"));
  file("b.mtl", "newmtl a\nmap_Kd gone.png\nnewmtl b\nmap_Kd gone.png\nnewmtl c\n");
  const MeshFile no_picture = scan("b.obj", "mtllib b.mtl\n" + of_faces);
  ASSERT_EQ(no_picture.warnings.size(), 1U);
  EXPECT_TRUE(test::holds(no_picture.warnings[0], "gone.png\" is not there"));
  for (const TexturePicture& picture : no_picture.attributes.texture.pictures) {
    EXPECT_TRUE(picture.empty());
  }
  // Colours of materials without any picture are those of programs that ask nobody.
  file("c.mtl", "newmtl a\nKd .8 .8 .8\nnewmtl b\nKd .8 .8 .8\n");
  for (const TexturePicture& picture :
       scan("c.obj", "mtllib c.mtl\n" + of_faces).attributes.texture.pictures) {
    EXPECT_TRUE(picture.empty());
  }
  // A picture that fails leaves the others.
  file("d.mtl", "newmtl a\nmap_Kd gone.png\nnewmtl b\nmap_Kd six.png\n");
  const MeshFile one = scan("d.obj", "mtllib d.mtl\n" + of_faces);
  EXPECT_EQ(one.warnings.size(), 1U);
  EXPECT_TRUE(one.attributes.texture.pictures[0].empty());
  EXPECT_EQ(one.attributes.texture.pictures[1].colours, six_colours);
  // Who asks for no pictures gets no warning.
  EXPECT_TRUE(read_mesh_file(path("b.obj")).warnings.empty());
}

TEST_F(TextureFiles, ObjHasTheColoursThatFollowAllItsVertices) {
  const MeshFile read = scan("a.obj", "v 0 0 0 0 .2 1\nv 1 0 0 .4 0 0\nv 0 1 0 1 .6 .8\nf 1 2 3\n");
  ASSERT_EQ(read.attributes.of_vertices.size(), 3U);
  EXPECT_EQ(read.attributes.of_vertices[0].name, "red");
  EXPECT_EQ(read.attributes.of_vertices[0].values, (std::vector<double>{0.0, 102.0, 255.0}));
  EXPECT_EQ(read.attributes.of_vertices[1].values, (std::vector<double>{51.0, 0.0, 153.0}));
  EXPECT_EQ(read.attributes.of_vertices[2].values, (std::vector<double>{255.0, 0.0, 204.0}));
  EXPECT_TRUE(read.attributes.texture.empty());
  // A weight is no colour.
  EXPECT_TRUE(scan("b.obj", "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n").attributes.empty());
}

TEST_F(TextureFiles, PlyHasThePlacesOfCornersAsMeshLabWritesThem) {
  file("two.jpg", jpeg_of_two);
  const MeshFile read =
      scan("a.ply",
           "ply\nformat ascii 1.0\ncomment TextureFile six.png\ncomment TextureFile two.jpg\n"
           "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 3\nproperty list uchar int vertex_indices\n"
           "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
           "0 0 0\n3 0 0\n0 5 0\n0 0 7\n"
           "4 0 1 2 3 8 .1 .2 .3 .4 .5 .6 .7 .8 1\n3 0 2 3 6 1 2 3 4 5 6 0\n3 1 2 3 0 7\n");
  const MeshTexture& texture = read.attributes.texture;
  EXPECT_EQ(texture.picture_of_face, (std::vector<std::int32_t>{1, 1, 0, -1}));
  ASSERT_EQ(texture.corners.size(), 4U);
  expect_corners(texture.corners[0], {{{.1F, .2F}, {.3F, .4F}, {.5F, .6F}}});
  expect_corners(texture.corners[1], {{{.1F, .2F}, {.5F, .6F}, {.7F, .8F}}});
  expect_corners(texture.corners[2], {{{1, 2}, {3, 4}, {5, 6}}});
  EXPECT_FALSE(texture.corners[3][0].allFinite());
  ASSERT_EQ(texture.pictures.size(), 2U);
  EXPECT_EQ(texture.pictures[0].colours, six_colours);
  EXPECT_EQ(texture.pictures[1].width, 16);
  EXPECT_TRUE(read.attributes.of_vertices.empty());
  EXPECT_TRUE(read.attributes.of_faces.empty());
}

TEST_F(TextureFiles, PlyHasThePlacesOfVerticesUnderThreeNames) {
  for (const std::string names : {"s t", "u v", "texture_u texture_v"}) {
    const std::string first = names.substr(0, names.find(' '));
    const std::string second = names.substr(names.find(' ') + 1);
    const std::string rest =
        "element vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty float " +
        first + "\nproperty uchar label\nproperty float " + second +
        "\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0 .1 5 .2\n3 0 0 .3 6 .4\n0 5 0 .5 7 .6\n3 2 0 1\n";
    const MeshFile read =
        scan("a.ply", "ply\nformat ascii 1.0\ncomment TextureFile six.png\n" + rest);
    ASSERT_EQ(read.attributes.texture.corners.size(), 1U) << names;
    expect_corners(read.attributes.texture.corners[0], {{{.5F, .6F}, {.1F, .2F}, {.3F, .4F}}});
    ASSERT_EQ(read.attributes.of_vertices.size(), 1U);
    EXPECT_EQ(read.attributes.of_vertices[0].name, "label");
    // Without a picture they tell nothing.
    EXPECT_TRUE(scan("b.ply", "ply\nformat ascii 1.0\n" + rest).attributes.texture.empty());
  }
}

}  // namespace
}  // namespace wscvt
