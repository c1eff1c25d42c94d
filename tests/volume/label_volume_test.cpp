// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <tiffio.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/holds.h"
#include "support/volume_folder.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

class LabelVolumeOfAFile : public test::VolumeFolder {
 protected:
  std::string nrrd(const std::string& type, const std::string& fields) const {
    return "NRRD0004\n# made\ntype: " + type + "\ndimension: 3\nsizes: " + made_.size_text() +
           "\n" + fields;
  }

  /// Pages from `first` on into one file.
  void write_tiff(const std::string& name, const std::string& mode, int first, int pages,
                  int compression, int rows, const char* text = nullptr) const {
    TIFF* const file = TIFFOpen(path(name).c_str(), mode.c_str());
    ASSERT_NE(file, nullptr);
    for (int z = first; z < first + pages; ++z) {
      TIFFSetField(file, TIFFTAG_IMAGEWIDTH, made_.counts[0]);
      TIFFSetField(file, TIFFTAG_IMAGELENGTH, made_.counts[1]);
      TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 16);
      TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, 1);
      TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
      TIFFSetField(file, TIFFTAG_COMPRESSION, compression);
      TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, rows);
      if (text != nullptr) {
        TIFFSetField(file, TIFFTAG_IMAGEDESCRIPTION, text);
        TIFFSetField(file, TIFFTAG_XRESOLUTION, 20.0);
        TIFFSetField(file, TIFFTAG_YRESOLUTION, 10.0);
      }
      for (int y = 0; y < made_.counts[1]; ++y) {
        std::vector<std::uint16_t> row;
        for (int x = 0; x < made_.counts[0]; ++x) {
          const auto place = (static_cast<std::size_t>(z) * 5 + y) * 7 + x;
          row.push_back(static_cast<std::uint16_t>(made_.labels[place]));
        }
        ASSERT_EQ(TIFFWriteScanline(file, row.data(), static_cast<std::uint32_t>(y), 0), 1);
      }
      ASSERT_EQ(TIFFWriteDirectory(file), 1);
    }
    TIFFClose(file);
  }

  /// All pages in tiles of 16 x 16, which hang over their rims.
  template <class Voxel>
  void write_tiled_tiff(const std::string& name, const char* mode, int compression,
                        const char* text = nullptr) const {
    constexpr int side = 16;
    TIFF* const file = TIFFOpen(path(name).c_str(), mode);
    ASSERT_NE(file, nullptr);
    for (int z = 0; z < made_.counts[2]; ++z) {
      TIFFSetField(file, TIFFTAG_IMAGEWIDTH, made_.counts[0]);
      TIFFSetField(file, TIFFTAG_IMAGELENGTH, made_.counts[1]);
      TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(Voxel)));
      TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, 1);
      TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
      TIFFSetField(file, TIFFTAG_COMPRESSION, compression);
      if (text != nullptr) TIFFSetField(file, TIFFTAG_IMAGEDESCRIPTION, text);
      TIFFSetField(file, TIFFTAG_TILEWIDTH, side);
      TIFFSetField(file, TIFFTAG_TILELENGTH, side);
      for (int top = 0; top < made_.counts[1]; top += side) {
        for (int left = 0; left < made_.counts[0]; left += side) {
          std::vector<Voxel> tile(side * side,
                                  99);  // 99: beyond the rim, which is to be passed over
          for (int y = top; y < std::min(top + side, made_.counts[1]); ++y) {
            for (int x = left; x < std::min(left + side, made_.counts[0]); ++x) {
              const int place = (z * made_.counts[1] + y) * made_.counts[0] + x;
              tile[static_cast<std::size_t>((y - top) * side + x - left)] =
                  static_cast<Voxel>(made_.labels[static_cast<std::size_t>(place)]);
            }
          }
          ASSERT_GT(TIFFWriteTile(file, tile.data(), static_cast<std::uint32_t>(left),
                                  static_cast<std::uint32_t>(top), 0, 0),
                    0);
        }
      }
      ASSERT_EQ(TIFFWriteDirectory(file), 1);
    }
    TIFFClose(file);
  }
};

TEST_F(LabelVolumeOfAFile, ReadsNrrdOfEveryTypeAndOrder) {
  expect_made_of("a.nrrd", nrrd("uchar", "encoding: raw\n\n") + made_.bytes<std::uint8_t>());
  expect_made_of("a.nrrd", nrrd("unsigned short", "endian: big\nencoding: raw\n\n") +
                               made_.bytes<std::uint16_t>(true));
  expect_made_of("a.nrrd", nrrd("int", "endian: little\nencoding: gzip\n\n") +
                               test::packed(made_.bytes<std::int32_t>(), true));
  expect_made_of("a.nrrd", nrrd("uint64", "endian: little\nencoding: gz\n\n") +
                               test::packed(made_.bytes<std::uint64_t>(), true));
  write("voxels", "12345" + made_.bytes<std::int16_t>());
  expect_made_of("a.nhdr",
                 nrrd("short", "encoding: raw\nbyte skip: 5\ndata file: voxels\nendian: little\n"));
  expect_made_of(
      "a.nhdr",
      nrrd("short", "encoding: raw\nendian: little\nbyte skip: -1\ndata file: ./voxels\n"));
}

TEST_F(LabelVolumeOfAFile, KeepsPlaceSizeAndUnitOfNrrd) {
  write("a.nrrd", nrrd("uchar",
                       "space directions: (0,0.5,0) (0.25,0,0) (0,0,2)\nspace origin: "
                       "(1,2,3)\nspace units: \"mm\" \"mm\" \"mm\"\nencoding: raw\n\n") +
                      made_.bytes<std::uint8_t>());
  const VolumeGeometry placed = geometry("a.nrrd");
  EXPECT_EQ(placed.unit, "mm");
  EXPECT_DOUBLE_EQ(placed.voxel_volume(), 0.25);
  // The origin is the middle of the first voxel, and a step along x goes along y here.
  EXPECT_LT((placed.point({0.5, 0.5, 0.5}) - Vector3(1.0, 2.0, 3.0)).norm(), 1e-15);
  EXPECT_LT((placed.point({1.5, 0.5, 0.5}) - Vector3(1.0, 2.5, 3.0)).norm(), 1e-15);
  VolumeChoice choice;
  choice.voxel_size = Vector3(1.0, 2.0, 4.0);
  const VolumeGeometry told = open_volume(path("a.nrrd"), choice)->geometry();
  // The file's axes are left-handed.
  EXPECT_LT((told.point({1.0, 1.0, 1.0}) - Vector3(-1.0, 2.0, 4.0)).norm(), 1e-15);
  choice.voxel_size = Vector3(1.0, 0.0, 1.0);
  EXPECT_ERROR(open_volume(path("a.nrrd"), choice), InvalidInput);
}

// The option replaces the lengths, but a grain stays on its side of the mirror.
TEST_F(LabelVolumeOfAFile, AVoxelSizeMakesNoMirrorImage) {
  VolumeChoice choice;
  choice.voxel_size = Vector3(1.0, 2.0, 4.0);
  const auto handedness = [&](const std::string& directions, const VolumeChoice& chosen) {
    write("a.nrrd", nrrd("uchar", "space directions: " + directions + "\nencoding: raw\n\n") +
                        made_.bytes<std::uint8_t>());
    return geometry("a.nrrd", chosen).axes.determinant();
  };
  for (const char* directions :
       {"(-1,0,0) (0,1,0) (0,0,1)", "(1,0,0) (0,0,1) (0,1,0)", "(0.5,0,0) (0,0.5,0) (0,0,-0.5)"}) {
    EXPECT_LT(handedness(directions, {}), 0.0) << directions;
    EXPECT_DOUBLE_EQ(handedness(directions, choice), -8.0) << directions;
  }
  EXPECT_DOUBLE_EQ(handedness("(-1,0,0) (0,-1,0) (0,0,1)", choice), 8.0);
  EXPECT_DOUBLE_EQ(handedness("(0,0,0) (0,1,0) (0,0,1)", choice), 8.0) << "the file has no hand";
  write("a.json", R"({"dimensions": [7, 5, 3], "type": "uint8"})");
  write("a.raw", made_.bytes<std::uint8_t>());
  EXPECT_LT((geometry("a.json", choice).point({1, 1, 1}) - Vector3(1, 2, 4)).norm(), 1e-15);
}

// pigz -i, bgzip and cat of several files make them: streams one behind the other, as gzip's
// definition allows (RFC 1952, 2.2).
TEST_F(LabelVolumeOfAFile, ReadsGzipOfSeveralStreams) {
  const std::string voxels = made_.bytes<std::uint16_t>();
  const std::vector<std::vector<std::size_t>> all_cuts = {
      {1}, {voxels.size() - 1}, {0, 70, 71, 140}, {100, 100, 105}};
  for (const std::vector<std::size_t>& cuts : all_cuts) {
    std::string packed;
    std::size_t begin = 0;
    for (const std::size_t cut : cuts) {
      packed += test::packed(voxels.substr(begin, cut - begin), true);
      begin = cut;
    }
    packed += test::packed(voxels.substr(begin), true);
    expect_made_of("a.nrrd", nrrd("ushort", "encoding: gzip\nendian: little\n\n") + packed);
  }
  // The same of zlib, in the blocks of a .vti and in MetaImage.
  write("a.zraw", test::packed(voxels.substr(0, 31), false) +
                      test::packed(voxels.substr(31, 100), false) +
                      test::packed(voxels.substr(131), false));
  expect_made_of("a.mhd", "NDims = 3\nDimSize = " + made_.size_text() +
                              "\nElementType = MET_USHORT\nCompressedData = True\n"
                              "ElementDataFile = a.zraw\n");
}

// Axes that are neither at right angles nor alike, steps of 2, 3 and 5 along them: no two of the
// nine numbers may be taken for each other.
TEST_F(LabelVolumeOfAFile, EachAxisHasItsOwnDirectionAndStepInEveryFormat) {
  Eigen::Matrix3d unit_axes;
  unit_axes.col(0) = Vector3(0.6, 0.8, 0.0);
  unit_axes.col(1) = Vector3(0.0, 0.28, 0.96);
  unit_axes.col(2) = Vector3(1.0, 0.0, 0.0);
  const Vector3 steps(2.0, 3.0, 5.0);
  const Vector3 origin(10.0, 20.0, 40.0);
  const Eigen::Matrix3d axes = unit_axes * steps.asDiagonal();
  const auto text = [](double number) { return std::to_string(number) + " "; };
  const auto vector = [&](const Vector3& v, const std::string& between) {
    return std::to_string(v.x()) + between + std::to_string(v.y()) + between +
           std::to_string(v.z());
  };
  std::string directions;  // NRRD: a vector an axis
  std::string rows;        // MetaImage: the axes one after the other, without their lengths
  std::string matrix;      // VTK: row by row
  for (Eigen::Index k = 0; k < 3; ++k) {
    directions += "(" + vector(axes.col(k), ",") + ") ";
    rows += vector(unit_axes.col(k), " ") + " ";
    for (Eigen::Index column = 0; column < 3; ++column) matrix += text(unit_axes(k, column));
  }
  write("a.nrrd", nrrd("uchar", "space directions: " + directions + "\nspace origin: (" +
                                    vector(origin, ",") + ")\nencoding: raw\n\n") +
                      made_.bytes<std::uint8_t>());
  write("a.mha",
        "NDims = 3\nDimSize = " + made_.size_text() + "\nTransformMatrix = " + rows +
            "\nOffset = " + vector(origin, " ") + "\nElementSpacing = " + vector(steps, " ") +
            "\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + made_.bytes<std::uint8_t>());
  write("a.vti", test::packed_vti(made_, "<ImageData WholeExtent=\"0 6 0 4 0 2\" Origin=\"" +
                                             vector(origin, " ") + "\" Spacing=\"" +
                                             vector(steps, " ") + "\" Direction=\"" + matrix +
                                             "\">\n<Piece Extent=\"0 6 0 4 0 2\">\n"));
  for (const char* name : {"a.nrrd", "a.mha", "a.vti"}) {
    SCOPED_TRACE(name);
    const VolumeGeometry placed = geometry(name);
    EXPECT_LT((placed.axes - axes).norm(), 1e-6);  // six decimals were written
    for (const Vector3& voxel : {Vector3(0, 0, 0), Vector3(6, 0, 0), Vector3(0, 4, 0),
                                 Vector3(0, 0, 2), Vector3(1, 2, 1)}) {
      const Vector3 middle = voxel + Vector3::Constant(0.5);
      EXPECT_LT((placed.point(middle) - (origin + axes * voxel)).norm(), 1e-5);
    }
    // Sizes that are told take the place of all that: along x, y and z, from the origin on.
    VolumeChoice choice;
    choice.voxel_size = steps;
    const VolumeGeometry told = open_volume(path(name), choice)->geometry();
    EXPECT_EQ(told.point({1, 1, 1}), steps);
    EXPECT_EQ(told.point({0, 0, 0}), Vector3(0, 0, 0));
  }
  // Three spacings without directions, and a raw file's.
  write("b.nrrd",
        nrrd("uchar", "spacings: 2 3 5\nencoding: raw\n\n") + made_.bytes<std::uint8_t>());
  write("b.raw", made_.bytes<std::uint8_t>());
  write("b.json", R"({"dimensions": [7, 5, 3], "type": "uint8", "spacing": [2, 3, 5]})");
  for (const char* name : {"b.nrrd", "b.json"}) {
    const VolumeGeometry placed = geometry(name);
    EXPECT_EQ(Vector3(placed.point({2, 2, 2}) - placed.point({1, 1, 1})), steps) << name;
  }
}

TEST_F(LabelVolumeOfAFile, ReadsMetaImage) {
  const std::string fields = "ObjectType = Image\nNDims = 3\nDimSize = " + made_.size_text() +
                             "\nElementSpacing = 0.1 0.2 0.4\nOffset = 10 20 30\n";
  expect_made_of("a.mha", fields + "ElementType = MET_USHORT\nElementDataFile = LOCAL\n" +
                              made_.bytes<std::uint16_t>());
  EXPECT_LT((geometry("a.mha").point({1.5, 1.5, 1.5}) - Vector3(10.1, 20.2, 30.4)).norm(), 1e-13);
  expect_cut_is_refused("a.mha", 20);
  write("a.zraw", test::packed(made_.bytes<std::uint8_t>(), false));
  expect_made_of("a.mhd", fields +
                              "ElementType = MET_UCHAR\nCompressedData = True\n"
                              "ElementDataFile = a.zraw\n");
  write("a.raw", made_.bytes<std::uint32_t>(true));
  expect_made_of("a.mhd", fields +
                              "ElementType = MET_UINT\nBinaryDataByteOrderMSB = True\n"
                              "ElementDataFile = a.raw\n");
  expect_cut_is_refused("a.raw", 1, "a.mhd");
}

TEST_F(LabelVolumeOfAFile, ReadsVtiInAllItsForms) {
  const std::string points =
      "<ImageData WholeExtent=\"1 7 0 4 0 2\" Origin=\"10 20 30\" Spacing=\"0.1 0.2 0.4\">\n"
      "<Piece Extent=\"1 7 0 4 0 2\">\n";
  expect_made_of("packed.vti", test::packed_vti(made_, points));
  // Points are the middles of voxels; the first has the number 1 along x.
  EXPECT_LT((geometry("packed.vti").point({0.5, 0.5, 0.5}) - Vector3(10.1, 20.0, 30.0)).norm(),
            1e-13);
  const std::string bytes = made_.bytes<std::uint16_t>(true);
  const std::string cells =
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"BigEndian\" "
      "header_type=\"UInt64\">\n<ImageData WholeExtent=\"0 7 0 5 0 3\" Origin=\"10 20 30\" "
      "Spacing=\"0.1 0.2 0.4\">\n<Piece Extent=\"0 7 0 5 0 3\">\n<CellData>\n<DataArray "
      "type=\"UInt16\" Name=\"l\" format=\"appended\" offset=\"";
  const std::string end_of_cells = "\"/></CellData></Piece></ImageData>\n<AppendedData encoding=";
  std::string length(8, '\0');
  length[6] = static_cast<char>(bytes.size() >> 8);
  length[7] = static_cast<char>(bytes.size() & 0xff);
  expect_made_of("raw.vti", cells + "3" + end_of_cells + "\"raw\">\n _<&>" + length + bytes +
                                "\n</AppendedData></VTKFile>");
  EXPECT_LT((geometry("raw.vti").point({0.0, 0.0, 0.0}) - Vector3(10.0, 20.0, 30.0)).norm(), 1e-13);
  expect_made_of("text.vti", cells + "0" + end_of_cells + "\"base64\">_" +
                                 test::base64(length + bytes) + "</AppendedData></VTKFile>");
  for (const auto& [known, other] :
       std::vector<std::pair<std::string, std::string>>{{"=\"binary\">\n", "=\"ascii\">\n"},
                                                        {"ZLib", "LZMA"},
                                                        {"UInt16", "String"},
                                                        {"Piece Extent=\"1", "Piece Extent=\"2"},
                                                        {"<PointData", "<PointDate"}}) {
    SCOPED_TRACE(other);
    std::string text = test::packed_vti(made_, points);
    const std::size_t place = text.find(known);
    ASSERT_NE(place, std::string::npos);
    expect_refused_of("wrong.vti", text.replace(place, known.size(), other), {});
  }
  for (const char* name : {"packed.vti", "raw.vti", "text.vti"}) {
    const std::uintmax_t end = fs::file_size(path(name));
    // What follows the voxels is not needed.
    fs::resize_file(path(name), end - 90 + (std::string(name) == "packed.vti" ? 0 : 50));
    expect_cut_is_refused(name, 20);
  }
}

TEST_F(LabelVolumeOfAFile, ReadsRawFilesByTheirDescription) {
  write("a.raw", "head" + made_.bytes<std::uint16_t>(true));
  expect_made_of("a.json",
                 R"({"dimensions": [7, 5, 3], "type": "uint16", "byte_order": "big", "offset": 4,
                  "spacing": 0.5, "origin": [1, 2, 3], "unit": "um"})");
  EXPECT_EQ(geometry("a.json").unit, "um");
  EXPECT_LT((geometry("a.json").point({1.5, 0.5, 0.5}) - Vector3(1.5, 2.0, 3.0)).norm(), 1e-15);
  expect_cut_is_refused("a.raw", 1, "a.json");
  for (const char* wrong : {"", "[]", "{}", R"({"dimensions": [7, 5], "type": "uint16"})",
                            R"({"dimensions": [7, 5, 3], "type": "float16"})",
                            R"({"dimensions": [7, 5, 3], "type": "uint8", "endian": "big"})",
                            R"({"dimensions": [7, 5, 3], "type": "uint8", "spacing": [0, 1, 1]})",
                            R"({"dimensions": [7, 5, 3], "type": "uint8", "spacing": "x"})",
                            R"({"dimensions": [7, 5, 3], "type": "uint8", "unit": 3})",
                            R"({"dimensions": [7, 5, 3], "type": "uint8", "offset": -3})",
                            R"({"dimensions": [7, 5, 3], "type": "uint8", "byte_order": "odd"})",
                            R"({"dimensions": [7, 5, 3], "type": "uint8", "file": "not there"})",
                            R"({"dimensions": [7, 5, 100000000000], "type": "uint8"})"}) {
    SCOPED_TRACE(wrong);
    write("a.raw", made_.bytes<std::uint8_t>());
    write("a.json", wrong);
    EXPECT_ERROR(open_volume(path("a.json")), InputOutput);
  }
}

TEST_F(LabelVolumeOfAFile, ReadsTiffPagesFoldersAndStacksOfImageJ) {
  for (const char* mode : {"w", "wb", "wl", "w8"}) {
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
      SCOPED_TRACE(mode + std::to_string(compression));
      write_tiff("a.tif", mode, 0, 3, compression, 2);
      expect_made("a.tif");
    }
  }
  EXPECT_EQ(geometry("a.tif").unit, "");
  EXPECT_LT((geometry("a.tif").point({7, 5, 3}) - Vector3(7, 5, 3)).norm(), 1e-15);
  fs::create_directory(folder_ / "slices");
  write_tiff("slices/s10.tif", "w", 2, 1, COMPRESSION_NONE, 5);
  write_tiff("slices/s9.TIFF", "w", 1, 1, COMPRESSION_LZW, 1);
  write_tiff("slices/s1.tif", "w", 0, 1, COMPRESSION_NONE, 5);
  EXPECT_TRUE(is_volume(path("slices")));
  expect_made("slices");
  // Beside meshes they are pictures of them: a folder of scans.
  write("slices/grain.ply", "ply\n");
  EXPECT_FALSE(is_volume(path("slices")));
  fs::remove(path("slices/grain.ply"));
  // Sizes of voxels as ImageJ notes them.
  const char* const text = "ImageJ=1.53\nimages=3\nslices=3\nunit=\\u00B5m\nspacing=0.25\n";
  write_tiff("a.tif", "w", 0, 3, COMPRESSION_NONE, 5, text);
  expect_made("a.tif");
  EXPECT_EQ(geometry("a.tif").unit, "um");
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(0.05, 0.1, 0.25)).norm(), 1e-7);
  // Above 4 GiB: one page, and all voxels behind it.
  write_tiff("one.tif", "wb", 0, 1, COMPRESSION_NONE, 5, text);
  const std::string page = made_.bytes<std::uint16_t>(true).substr(0, 70);
  std::string bytes = content("one.tif");
  // Its voxels stand before its directory: the strip's offset is turned to the end.
  const std::size_t place = bytes.find(page);
  ASSERT_NE(place, std::string::npos);
  const auto big_endian = [](std::size_t number) {
    const std::string least_first = test::four_bytes(number);
    return std::string(least_first.rbegin(), least_first.rend());
  };
  const std::string tag = std::string("\x01\x11\x00\x04\x00\x00\x00\x01", 8) + big_endian(place);
  const std::size_t entry = bytes.find(tag);
  ASSERT_NE(entry, std::string::npos);
  bytes.replace(entry + 8, 4, big_endian(bytes.size()));
  expect_made_of("one.tif", bytes + made_.bytes<std::uint16_t>(true));
  expect_cut_is_refused("one.tif", bytes.size());
}

// tifffile, libvips and many microscopes write tiles; NumPy's whole numbers are of 64 bits.
TEST_F(LabelVolumeOfAFile, ReadsTiffsInTilesAndOf64Bits) {
  make({37, 21, 3});
  for (const char* mode : {"w", "wb", "wl", "w8"}) {
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
      SCOPED_TRACE(mode + std::to_string(compression));
      write_tiled_tiff<std::uint8_t>("a.tif", mode, compression);
      expect_made("a.tif");
      write_tiled_tiff<std::uint64_t>("a.tif", mode, compression);
      expect_made("a.tif");
    }
  }
  write_tiled_tiff<std::uint16_t>("a.tif", "w", COMPRESSION_LZW);
  expect_cut_is_refused("a.tif", 1);
}

TEST_F(LabelVolumeOfAFile, TakesNoPageThatWasWrittenAnewForImageJsBlock) {
  // Other programs keep the text of the stack when they write a page of it packed or in tiles:
  // the voxels of the others do not stand behind it.
  const char* const text = "ImageJ=1.53\nimages=3\nslices=3\n";
  for (const int compression : {COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
    write_tiff("a.tif", "w", 0, 1, compression, 5, text);
    EXPECT_ERROR(open_volume(path("a.tif")), InputOutput);
  }
  make({37, 21, 1});
  write_tiled_tiff<std::uint16_t>("a.tif", "w", COMPRESSION_NONE, text);
  const std::string sentence =
      test::refusal(ErrorCode::InputOutput, [&] { open_volume(path("a.tif")); });
  EXPECT_TRUE(test::holds(sentence, "has one page of the 3 that ImageJ noted"));
}

TEST_F(LabelVolumeOfAFile, RefusesTiffsThatAreCutOrDiffer) {
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW}) {
    write_tiff("a.tif", "w", 0, 3, compression, 2);
    expect_cut_is_refused("a.tif", 1);
  }
  fs::create_directory(folder_ / "slices");
  write_tiff("slices/1.tif", "w", 0, 1, COMPRESSION_NONE, 5);
  make({7, 6, 3});
  write_tiff("slices/2.tif", "w", 0, 1, COMPRESSION_NONE, 5);
  expect_refused("slices", {});
  write("slices/3.tif", "no TIFF");
  EXPECT_ERROR(open_volume(path("slices")), InputOutput);
  fs::create_directory(folder_ / "empty");
  EXPECT_ERROR(open_volume(path("empty")), InputOutput);
  EXPECT_FALSE(is_volume(path("empty")));
}

TEST_F(LabelVolumeOfAFile, RefusesWhatIsWrongWithAHeaderOrCut) {
  const std::string voxels = made_.bytes<std::uint8_t>();
  for (const std::string& wrong :
       {std::string(""),
        std::string("NRRD"),
        std::string("PLY\n"),
        std::string(100000, 'x'),
        "NRRD0004\n" + std::string(200000, '\n'),
        std::string("NRRD0004\n\n"),
        nrrd("block", "encoding: raw\n\n") + voxels,
        nrrd("uchar", "encoding: bzip2\n\n") + voxels,
        nrrd("uchar", "encoding: hex\n\n") + voxels,
        nrrd("uchar", "spacing: 1 1 1\nencoding: raw\n\n") + voxels,
        nrrd("ushort", "encoding: raw\n\n") + voxels + voxels,
        nrrd("uchar", "spacings: 1 1\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "spacings: 1 1 x\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "spacings: 1 1 0\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "dimension: 4\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "sizes: 7 5 3 1\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "sizes: 7 5 -3\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "sizes: 7 5 99999999999999999999\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "sizes: 1000000 1000000 1000000\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "sizes: 1000000 1000000 1000000\nencoding: gzip\n\n") +
            test::packed(voxels, true),
        nrrd("uchar", "sizes: 70 50 30\nencoding: gzip\n\n") + test::packed(voxels, true),
        nrrd("uchar", "byte skip: 3\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "data file: LIST\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "data file: %03d.raw 1 3 1\nencoding: raw\n\n") + voxels,
        nrrd("uchar", "encoding: gzip\n\n") + voxels}) {
    SCOPED_TRACE(wrong.substr(0, 200));
    expect_refused_of("a.nrrd", wrong, {});
  }
  for (const char* encoding : {"raw", "gzip"}) {
    const bool is_packed = std::string(encoding) == "gzip";
    write("a.nrrd", nrrd("uchar", std::string("encoding: ") + encoding + "\n\n") +
                        (is_packed ? test::packed(voxels, true) : voxels));
    if (is_packed)
      fs::resize_file(path("a.nrrd"), fs::file_size(path("a.nrrd")) - 9);  // its sum and end
    expect_cut_is_refused("a.nrrd", 1);
  }
  EXPECT_ERROR(open_volume(path("not_there.nrrd")), InputOutput);
  EXPECT_ERROR(open_volume(path("a.ply")), InvalidInput);
}

TEST_F(LabelVolumeOfAFile, HoldsLabelsUpToTheLargest) {
  // Which a type with a sign would take for less than 0.
  for (const std::uint32_t label : {128U, 255U, 32768U, 65535U, 2147483648U, 4294967295U}) {
    SCOPED_TRACE(label);
    made_.labels.back() = label;
    if (label <= 255) {
      expect_made_of("a.nrrd", nrrd("uchar", "encoding: raw\n\n") + made_.bytes<std::uint8_t>());
    }
    if (label <= 65535) {
      expect_made_of("a.nrrd", nrrd("ushort", "endian: little\nencoding: raw\n\n") +
                                   made_.bytes<std::uint16_t>());
    }
    expect_made_of(
        "a.nrrd", nrrd("uint", "endian: little\nencoding: raw\n\n") + made_.bytes<std::uint32_t>());
    expect_made_of("a.nrrd", nrrd("int64", "endian: little\nencoding: raw\n\n") +
                                 made_.bytes<std::uint64_t>());
  }
}

TEST_F(LabelVolumeOfAFile, SkipsTheHeaderThatAMetaImageTellsOf) {
  const std::string fields = "NDims = 3\nDimSize = " + made_.size_text() +
                             "\nElementType = MET_USHORT\nElementDataFile = a.raw\n";
  write("a.raw", "1234567" + made_.bytes<std::uint16_t>());
  for (const char* size : {"7", "-1"}) {  // -1: all but the voxels
    expect_made_of("a.mhd", std::string("HeaderSize = ") + size + "\n" + fields);
  }
}

TEST_F(LabelVolumeOfAFile, FirstPointOfAVtiMayHaveAnyNumbers) {
  expect_made_of("a.vti",
                 test::packed_vti(made_,
                                  "<ImageData WholeExtent=\"-4 2 3 7 11 13\" Origin=\"10 20 "
                                  "30\" Spacing=\"2 3 5\">\n<Piece Extent=\"-4 2 3 7 11 "
                                  "13\">\n"));
  const VolumeGeometry placed = geometry("a.vti");
  EXPECT_EQ(placed.point({0.5, 0.5, 0.5}), Vector3(10 - 8, 20 + 9, 30 + 55));
}

TEST_F(LabelVolumeOfAFile, RefusesVoxelsThatAreNoLabels) {
  made_.at(3, 3, 1) = static_cast<std::uint32_t>(-5);
  expect_refused_of(
      "a.nrrd", nrrd("short", "endian: little\nencoding: raw\n\n") + made_.bytes<std::int16_t>(),
      {});
  std::string bytes = made_.bytes<std::uint64_t>();
  bytes[4] = 1;  // 2^32
  expect_refused_of("a.nrrd", nrrd("uint64", "endian: little\nencoding: raw\n\n") + bytes, {});
}

TEST_F(LabelVolumeOfAFile, NamesAWayFromFormatsThatAreNotRead) {
  write("a.dcm", std::string(128, '\0') + "DICM");
  write("IM0001", std::string(128, '\0') + "DICM");
  const std::string lattice =
      "\n\ndefine Lattice 7 5 3\n\nParameters {\n  CoordType \"uniform\"\n}\n\nLattice { ushort "
      "Labels } @1";
  write("a.am", "# AmiraMesh BINARY-LITTLE-ENDIAN 2.1" + lattice + "\n\n@1\n" +
                    made_.bytes<std::uint16_t>() + "\n");
  write("packed.am",
        "# AmiraMesh BINARY-LITTLE-ENDIAN 2.1" + lattice + "(HxByteRLE,66)\n\n@1\nxyz");
  write("text.am", "# AmiraMesh 3D ASCII 2.0" + lattice + "\n\n@1\n0 0 0");
  write("a.raw", "x");
  fs::create_directory(folder_ / "series");
  write("series/IM0001", std::string(128, '\0') + "DICM");
  fs::create_directory(folder_ / "a.zarr");
  write("a.zarr/.zarray", "{}");
  fs::create_directories(folder_ / "group" / "1");
  fs::create_directories(folder_ / "group" / "0");
  write("group/.zgroup", "{}");
  write("group/1/.zarray", "{}");
  write("group/0/.zarray", "{}");
  for (const char* folder : {"nested/a/b", "third/a/b/c", "third_array/c"}) {
    fs::create_directories(folder_ / folder);
  }
  write("nested/.zgroup", "{}");
  write("nested/a/.zgroup", "{}");
  write("nested/a/b/.zarray", "{}");
  write("third/zarr.json", R"({"node_type": "group"})");
  write("third/a/zarr.json", R"({"node_type": "group"})");
  write("third/a/b/zarr.json", R"({"node_type": "array"})");
  write("third_array/zarr.json", R"({"node_type": "array"})");
  for (const auto& [name, way] :
       std::vector<std::pair<std::string, std::string>>{{"a.dcm", "dcm2niix"},
                                                        {"IM0001", "dcm2niix"},
                                                        {"series", "dcm2niix"},
                                                        {"a.zarr", "a.zarr\", mode=\"r\")[:])"},
                                                        {"group", "mode=\"r\")[\"0\"][:])"},
                                                        {"nested", "mode=\"r\")[\"a/b\"][:])"},
                                                        {"third", "mode=\"r\")[\"a/b\"][:])"},
                                                        {"third_array", "mode=\"r\")[:])"},
                                                        {"packed.am", "packed, or a text"},
                                                        {"text.am", "packed, or a text"},
                                                        {"a.raw", "\"file\": \"a.raw\""}}) {
    const std::string file = path(name);
    EXPECT_TRUE(test::holds(test::refusal(ErrorCode::InputOutput, [&] { open_volume(file); }), way))
        << name;
    EXPECT_TRUE(is_volume(file)) << name << ": batch and others open it, and say the same";
  }
  write("series/a.ply", "");
  for (const char* name : {"series", "series/a.ply", "none.dcm"}) {
    EXPECT_FALSE(is_volume(path(name))) << name;
  }
  // The way from AmiraMesh, followed.
  const std::string way = test::refusal(ErrorCode::InputOutput, [&] { open_volume(path("a.am")); });
  const std::size_t begin = way.find('{');
  ASSERT_NE(begin, std::string::npos) << way;
  expect_made_of("labels.json", way.substr(begin, way.find('}') - begin + 1));
}

}  // namespace
}  // namespace wscvt
