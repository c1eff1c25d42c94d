// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy, HDF5, MATLAB, NIfTI and VTK's files from before XML.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <zip.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "support/holds.h"
#include "support/volume_folder.h"

namespace wscvt {
namespace {

using test::array;
using test::channel;
using test::frame;
using test::MadeVolume;

class ArrayVolumes : public test::VolumeFolder {
 protected:
  static std::string npy(const std::string& type, const std::string& order,
                         const std::string& shape, const std::string& voxels, int version = 1) {
    std::string head =
        "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': (" + shape + "), }";
    const std::size_t before = version == 1 ? 10 : 12;
    while ((head.size() + before + 1) % 64 != 0) head += ' ';
    head += '\n';
    std::string length = test::four_bytes(head.size());
    if (version == 1) length.resize(2);
    return std::string("\x93NUMPY") + static_cast<char>(version) + '\0' + length + head + voxels;
  }
  /// The labels with z fastest.
  std::string turned() const {
    std::string bytes;
    for (int x = 0; x < 7; ++x) {
      for (int y = 0; y < 5; ++y) {
        for (int z = 0; z < 3; ++z) {
          const Label label = made_.labels[static_cast<std::size_t>((z * 5 + y) * 7 + x)];
          bytes += test::four_bytes(label).substr(0, 2);
        }
      }
    }
    return bytes;
  }
  /// Every voxel is where it is in `made_`, whatever the order of the file: by a voxel's middle.
  void expect_placed(const std::string& name, const Vector3& size) const {
    const std::unique_ptr<LabelVolume> volume = open_volume(path(name));
    const VolumeGeometry& geometry = volume->geometry();
    volume->rewind();
    for (int z = 0; z < geometry.counts[2]; ++z) {
      for (int y = 0; y < geometry.counts[1]; ++y) {
        const std::vector<Label> row = volume->next_row();
        for (int x = 0; x < geometry.counts[0]; ++x) {
          const Vector3 at = geometry.point(Vector3(x + 0.5, y + 0.5, z + 0.5));
          const Vector3 voxel = at.cwiseQuotient(size);
          const auto place = static_cast<std::size_t>(
              (std::floor(voxel.z()) * 5 + std::floor(voxel.y())) * 7 + std::floor(voxel.x()));
          ASSERT_LT(place, made_.labels.size());
          ASSERT_EQ(row[static_cast<std::size_t>(x)], made_.labels[place]) << name;
        }
      }
    }
  }
};

TEST_F(ArrayVolumes, ReadsNumpyOfEveryTypeAndOrder) {
  const std::string shape = "3, 5, 7";
  expect_made_of("a.npy", npy("|u1", "False", shape, made_.bytes<std::uint8_t>()));
  expect_made_of("a.npy", npy("|i1", "False", shape, made_.bytes<std::int8_t>()));
  expect_made_of("a.npy", npy("<u2", "False", shape, made_.bytes<std::uint16_t>(), 2));
  expect_made_of("a.npy", npy(">i4", "False", shape, made_.bytes<std::int32_t>(true), 3));
  expect_made_of("a.npy", npy("<i8", "False", shape, made_.bytes<std::int64_t>()));
  expect_cut_is_refused("a.npy", 1);
  std::string doubles;
  for (const Label label : made_.labels) {
    const auto value = static_cast<double>(label);
    doubles.append(reinterpret_cast<const char*>(&value), 8);
  }
  expect_made_of("a.npy", npy("<f8", "False", shape, doubles));
  expect_placed("a.npy", Vector3(1, 1, 1));
  // The first dimension fastest: nothing is mirrored by it.
  write("a.npy", npy("<u2", "True", shape, turned()));
  EXPECT_EQ(geometry("a.npy").counts, (VoxelCounts{3, 5, 7}));
  expect_placed("a.npy", Vector3(1, 1, 1));
  VolumeChoice choice;
  choice.voxel_size = Vector3(1, 2, 4);
  EXPECT_LT((geometry("a.npy", choice).point({1, 1, 1}) - Vector3(1, 2, 4)).norm(), 1e-15);
  EXPECT_LT((geometry("a.npy", choice).point({1, 0, 0}) - Vector3(0, 0, 4)).norm(), 1e-15);
  made_.labels.assign(made_.labels.size(), 1);
  expect_made_of("a.npy", npy("|b1", "False", shape, std::string(105, '\1')));
}

TEST_F(ArrayVolumes, NamesTheDimensionsOfNumpyThatAreMoreThanThree) {
  const std::string voxels = made_.bytes<std::uint16_t>();
  MadeVolume more = made_;
  for (Label& label : more.labels) label += 200;
  expect_refused_of("a.npy",
                    npy("<u2", "False", "2, 3, 5, 7", voxels + more.bytes<std::uint16_t>()),
                    {"2 frames"});
  expect_made("a.npy", frame(1));
  EXPECT_EQ(labels_of("a.npy", frame(2)), labels(200));
  for (const char* shape : {"1, 3, 5, 7", "3, 5, 7, 1", "1, 3, 1, 5, 7", "3, 5, 7,"}) {
    expect_made_of("a.npy", npy("<u2", "False", shape, voxels));
  }
  for (const auto& [shape, word] : std::vector<std::pair<std::string, std::string>>{
           {"15, 7", "three dimensions"},
           {"1, 15, 7", "one image"},
           {"105,", "three dimensions"},
           {"3, 0, 7", "above 0"},
           {"3, x, 7", "whole numbers"},
           {"2, 2, 3, 5, 7", "more than one dimension"},
           {"3, 5, 7000000", "7000000"}}) {
    expect_refused_of("a.npy", npy("<u2", "False", shape, voxels), {word});
  }
  for (const char* type : {"<c8", "<U4", "<M8[s]", "|O", "<f2", "u", ""}) {
    expect_refused_of("a.npy", npy(type, "False", "3, 5, 7", voxels), {"type"});
  }
  expect_refused_of("a.npy", npy("<u2", "Maybe", "3, 5, 7", voxels), {"order"});
  expect_refused_of("a.npy", "\x93NUMPY\1", {"not a NumPy array"});
  expect_refused_of("a.npy", "no array", {"not a NumPy array"});
}

TEST_F(ArrayVolumes, TakesAShortLastDimensionForChannels) {
  make({9, 8, 7});
  std::string all;
  for (const Label label : made_.labels) {
    for (std::size_t c = 0; c < 3; ++c) all += test::four_bytes(label + 200 * c).substr(0, 2);
  }
  expect_refused_of("a.npy", npy("<u2", "False", "7, 8, 9, 3", all),
                    {"3 channels", "--select channel=1 to channel=3", "colours"});
  expect_made("a.npy", channel(1));
  EXPECT_EQ(labels_of("a.npy", channel(3)), labels(400));
  // With frames before: both are chosen.
  write("a.npy", npy("<u2", "False", "2, 7, 8, 9, 3", all + all));
  VolumeChoice choice = channel(2);
  choice.frame = 2;
  EXPECT_EQ(labels_of("a.npy", choice), labels(200));
}

TEST_F(ArrayVolumes, RefusesChannelsBetweenSlicesAndRows) {
  make({9, 8, 7});
  const std::string slice(std::size_t{9 * 8 * 2}, '\1');
  std::string all;
  for (int k = 0; k < 7 * 3; ++k) all += slice;
  for (const VolumeChoice& choice : {VolumeChoice(), frame(1), channel(1)}) {
    expect_refused_of("a.npy", npy("<u2", "False", "7, 3, 8, 9", all),
                      {"7 x 3 x 8 x 9", "array[:, 0]"}, choice);
  }
  // Three frames, or as many slices as half the rows.
  expect_refused_of("a.npy", npy("<u2", "False", "3, 7, 8, 9", all), {"3 frames"});
  expect_refused_of("a.npy", npy("<u2", "False", "7, 4, 8, 9", all + all.substr(0, 1008)),
                    {"7 frames"});
}

TEST_F(ArrayVolumes, ReadsTheChosenArrayOfAnNpz) {
  const auto write_npz = [&](const std::vector<std::pair<std::string, std::string>>& members,
                             int level) {
    const zipFile zip = zipOpen64(path("a.npz").c_str(), APPEND_STATUS_CREATE);
    for (const auto& [name, content] : members) {
      zip_fileinfo info{};
      ASSERT_EQ(zipOpenNewFileInZip64(zip, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                                      level == 0 ? 0 : Z_DEFLATED, level, 1),
                ZIP_OK);
      ASSERT_EQ(zipWriteInFileInZip(zip, content.data(), static_cast<unsigned>(content.size())),
                ZIP_OK);
      zipCloseFileInZip(zip);
    }
    zipClose(zip, nullptr);
  };
  const std::string voxels = npy("<u2", "False", "3, 5, 7", made_.bytes<std::uint16_t>());
  MadeVolume more = made_;
  for (Label& label : more.labels) label += 200;
  for (const int level : {0, 6}) {
    write_npz({{"arr_0.npy", voxels}}, level);
    expect_made("a.npz");
    write_npz({{"grey.npy", npy("<u2", "False", "3, 5, 7", more.bytes<std::uint16_t>())},
               {"labels.npy", voxels}},
              level);
    expect_refused("a.npz", {"2 arrays", "\"grey\"", "\"labels\""});
    expect_made("a.npz", array("labels"));
    EXPECT_EQ(labels_of("a.npz", array("grey")), labels(200));
    expect_refused("a.npz", {"\"grey\""}, array("arr_0"));
    write_npz({{"arr_0.npy", voxels.substr(0, voxels.size() - 1)}}, level);
    expect_refused("a.npz", {"209 bytes"});
  }
  // A byte that was changed, packed or not.
  for (const int level : {0, 6}) {
    write_npz({{"arr_0.npy", voxels}}, level);
    std::string bytes = content("a.npz");
    char& changed = bytes[level == 0 ? 300 : 120];
    changed = static_cast<char>(changed ^ 1);
    expect_refused_of("a.npz", bytes, {});
  }
  write_npz({{"arr_0.npy", voxels}}, 6);
  std::filesystem::resize_file(path("a.npz"), std::filesystem::file_size(path("a.npz")) - 22);
  expect_cut_is_refused("a.npz", 1);
  write_npz({}, 0);
  expect_refused("a.npz", {});
}

/// A NIfTI header of version 1 or 2, of 16-bit labels unless told otherwise.
struct Nifti {
  int version = 1;
  bool big_endian = false;
  std::vector<int> dimensions = {3, 7, 5, 3};
  unsigned unit = 3;  ///< metres, millimetres, micrometres from 1
  int type = 512;     // uint16
  int bits = 16;
  double slope = 0.0;
  double more = 0.0;  ///< added to a scaled voxel
  int sform = 1;
  bool has_sizes = true;
  double scale = 1.0;  ///< of the sizes, but not of the matrix

  std::string bytes() const {
    std::string head(version == 1 ? 348 : 540, '\0');
    const auto put = [&](std::size_t place, std::size_t size, std::uint64_t value) {
      for (std::size_t k = 0; k < size; ++k) {
        head[place + (big_endian ? size - 1 - k : k)] = static_cast<char>(value >> (8 * k) & 0xffU);
      }
    };
    const auto put_real = [&](std::size_t place, double value) {
      if (version == 1) {
        const auto single = static_cast<float>(value);
        std::uint32_t word = 0;
        std::memcpy(&word, &single, 4);
        put(place, 4, word);
      } else {
        std::uint64_t word = 0;
        std::memcpy(&word, &value, 8);
        put(place, 8, word);
      }
    };
    const std::size_t real = version == 1 ? 4 : 8;
    put(0, 4, head.size());
    const std::size_t dimension_size = version == 1 ? 2 : 8;
    for (std::size_t k = 0; k < 8; ++k) {
      put((version == 1 ? 40U : 16U) + k * dimension_size, dimension_size,
          k < dimensions.size() ? static_cast<std::uint64_t>(dimensions[k]) : 1U);
    }
    put(version == 1 ? 70 : 12, 2, static_cast<std::uint64_t>(type));
    put(version == 1 ? 72 : 14, 2, static_cast<std::uint64_t>(bits));
    const std::size_t sizes = version == 1 ? 76 : 104;
    const double pixdim[8] = {1.0, 0.5, 0.25, 2.0, 1.0, 1.0, 1.0, 1.0};
    for (std::size_t k = 0; k < 8; ++k)
      put_real(sizes + k * real, has_sizes ? scale * pixdim[k] : 0.0);
    if (version == 1) {
      put_real(108, 352.0);
    } else {
      put(168, 8, 544);
    }
    put_real(version == 1 ? 112 : 176, slope);
    put_real(version == 1 ? 116 : 184, more);
    put(version == 1 ? 123 : 500, version == 1 ? 1 : 4, unit);
    put(version == 1 ? 254 : 348, version == 1 ? 2 : 4, static_cast<std::uint64_t>(sform));
    // x of the lattice runs along -y, y along x.
    const double rows[3][4] = {{0, 0.25, 0, 10}, {-0.5, 0, 0, 20}, {0, 0, 2, 30}};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        put_real((version == 1 ? 280 : 400) + (4 * r + c) * real, rows[r][c]);
      }
    }
    if (version == 1) {
      std::memcpy(&head[344], "n+1\0", 4);
    } else {
      std::memcpy(&head[4], "n+2\0\r\n\032\n", 8);
    }
    return head + std::string(4, '\0');
  }
};

TEST_F(ArrayVolumes, TellsTwoSizesInNifti) {
  Nifti nifti;
  const auto warnings = [&](const VolumeChoice& chosen) {
    write("a.nii", nifti.bytes() + made_.bytes<std::uint16_t>());
    const auto volume = open_volume(path("a.nii"), chosen);
    const auto& all = volume->warnings();
    return std::count_if(all.begin(), all.end(), [](const Sentence& warning) {
      return warning.text().find("two sizes") != std::string::npos;
    });
  };
  EXPECT_EQ(warnings({}), 0);
  nifti.scale = 10.0;
  EXPECT_EQ(warnings({}), 1);
  const auto volume = open_volume(path("a.nii"));
  EXPECT_TRUE(test::holds(volume->warnings().front().text(),
                          "0.5 x 0.25 x 2 in its sform, 5 x 2.5 x 20 in its"));
  VolumeChoice choice;
  choice.voxel_size = Vector3(0.5, 0.5, 0.5);
  EXPECT_EQ(warnings(choice), 0);
  nifti.sform = 0;
  EXPECT_EQ(warnings({}), 0);
  nifti.sform = 1;
  nifti.has_sizes = false;
  EXPECT_EQ(warnings({}), 0);
}

TEST_F(ArrayVolumes, TakesSinglePrecisionForTheDecimalsItMeans) {
  Nifti nifti;
  nifti.sform = 0;
  nifti.scale = 0.2;
  write("a.nii", nifti.bytes() + made_.bytes<std::uint16_t>());
  const VolumeGeometry placed = geometry("a.nii");
  EXPECT_EQ(placed.axes(0, 0), 0.1);
  EXPECT_EQ(placed.axes(1, 1), 0.05);
  EXPECT_EQ(placed.axes(2, 2), 0.4);
  nifti.version = 2;
  nifti.scale = 0.3;
  write("a.nii", nifti.bytes() + made_.bytes<std::uint16_t>());
  EXPECT_EQ(geometry("a.nii").axes(0, 0), 0.3 * 0.5);
}

TEST_F(ArrayVolumes, NiftiHasTheUnitOfItsCode) {
  Nifti nifti;
  for (const char* unit : {"", "m", "mm", "um"}) {
    nifti.unit = unit[0] == 0 ? 0 : unit[1] == 0 ? 1 : unit[0] == 'm' ? 2 : 3;
    write("a.nii", nifti.bytes() + made_.bytes<std::uint16_t>());
    EXPECT_EQ(geometry("a.nii").unit, unit);
  }
}

TEST_F(ArrayVolumes, ReadsNifti) {
  for (const int version : {1, 2}) {
    for (const bool big : {false, true}) {
      SCOPED_TRACE(std::to_string(version) + (big ? " big" : " little"));
      Nifti nifti;
      nifti.version = version;
      nifti.big_endian = big;
      expect_made_of("a.nii", nifti.bytes() + made_.bytes<std::uint16_t>(big));
      const VolumeGeometry placed = geometry("a.nii");
      EXPECT_EQ(placed.unit, "um");
      EXPECT_TRUE(placed.has_size);
      EXPECT_LT((placed.point({0.5, 0.5, 0.5}) - Vector3(10, 20, 30)).norm(), 1e-12);
      EXPECT_LT((placed.point({1.5, 0.5, 0.5}) - Vector3(10, 19.5, 30)).norm(), 1e-12);
      EXPECT_LT((placed.point({0.5, 1.5, 1.5}) - Vector3(10.25, 20, 32)).norm(), 1e-12);
      expect_made_of("a.nii.gz",
                     test::packed(nifti.bytes() + made_.bytes<std::uint16_t>(big), true));
      EXPECT_TRUE(is_volume(path("a.nii.gz")));
      EXPECT_FALSE(is_volume(path("a.ply.gz")));
      nifti.sform = 0;
      write("a.nii", nifti.bytes() + made_.bytes<std::uint16_t>(big));
      EXPECT_NEAR(geometry("a.nii").voxel_volume(), 0.25, 1e-12);
      nifti.has_sizes = false;
      write("a.nii", nifti.bytes() + made_.bytes<std::uint16_t>(big));
      EXPECT_FALSE(geometry("a.nii").has_size);
      EXPECT_EQ(geometry("a.nii").unit, "");
      nifti.has_sizes = true;
      nifti.dimensions = {4, 7, 5, 3, 2};
      const std::string first = made_.bytes<std::uint16_t>(big);
      MadeVolume more = made_;
      for (Label& label : more.labels) label += 200;
      expect_refused_of("a.nii", nifti.bytes() + first + more.bytes<std::uint16_t>(big),
                        {"2 frames"});
      EXPECT_EQ(labels_of("a.nii", frame(2)), labels(200));
      nifti.dimensions = {5, 7, 5, 3, 1, 2};
      expect_refused_of("a.nii", nifti.bytes() + first + more.bytes<std::uint16_t>(big),
                        {"2 channels"});
      EXPECT_EQ(labels_of("a.nii", channel(2)), labels(200));
    }
  }
  Nifti nifti;
  const auto write_as = [&](int type, int bits, const std::string& voxels) {
    nifti.type = type;
    nifti.bits = bits;
    write("a.nii", nifti.bytes() + voxels);
  };
  write_as(2, 8, made_.bytes<std::uint8_t>());
  expect_made("a.nii");
  write_as(256, 8, made_.bytes<std::int8_t>());
  expect_made("a.nii");
  write_as(4, 16, made_.bytes<std::int16_t>());
  expect_made("a.nii");
  write_as(8, 32, made_.bytes<std::int32_t>());
  expect_made("a.nii");
  write_as(768, 32, made_.bytes<std::uint32_t>());
  expect_made("a.nii");
  write_as(1024, 64, made_.bytes<std::int64_t>());
  expect_made("a.nii");
  write_as(1280, 64, made_.bytes<std::uint64_t>());
  expect_made("a.nii");
  std::string floats;
  for (const Label label : made_.labels) {
    const auto value = static_cast<float>(label);
    floats.append(reinterpret_cast<const char*>(&value), 4);
  }
  write_as(16, 32, floats);
  expect_made("a.nii");
  expect_cut_is_refused("a.nii", 1);
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(floats.data(), &infinite, 4);
  write_as(16, 32, floats);
  expect_refused("a.nii", {"holds infinity", "Change it to the background"});
  write_as(128, 24, std::string(315, '\0'));  // RGB
  expect_refused("a.nii", {"type"});
  nifti.slope = 2.0;
  write_as(4, 16, made_.bytes<std::int16_t>());
  expect_refused("a.nii", {"scales its voxels by 2", "wscvt segment"});
  const auto scaled = open_volume(path("a.nii"));
  scaled->read_grey_values();
  EXPECT_EQ(grey_value(scaled->next_row().front()), static_cast<float>(made_.labels.front()));
  nifti.slope = 1.0;
  nifti.more = 3.0;  // as dcm2niix writes CT, with -1024
  write_as(4, 16, made_.bytes<std::int16_t>());
  EXPECT_EQ(open_volume(path("a.nii"))->next_row().front(), made_.labels.front() + 3);
  expect_refused_of("a.nii", "no NIfTI", {"not a NIfTI"});
  nifti.slope = 0.0;
  nifti.dimensions = {3, 7, 0, 3};
  write_as(4, 16, made_.bytes<std::int16_t>());
  expect_refused("a.nii", {"dimensions below 1"});
  expect_refused_of("a.nii.gz", test::packed("no NIfTI", true), {"not a NIfTI"});
}

TEST_F(ArrayVolumes, LeadsFromOtherGridsOfVtkToImages) {
  for (const char* kind : {"RECTILINEAR_GRID", "STRUCTURED_GRID"}) {
    expect_refused_of("a.vtk",
                      std::string("# vtk DataFile Version 3.0\nt\nASCII\nDATASET ") + kind +
                          "\nDIMENSIONS 7 5 3\n",
                      {"Resample To Image"});
  }
}

TEST_F(ArrayVolumes, ReadsLegacyVtk) {
  const auto head = [&](const std::string& form, const std::string& counts) {
    return "# vtk DataFile Version 3.0\nlabels\n" + form +
           "\nDATASET STRUCTURED_POINTS\nDIMENSIONS " + counts +
           "\nSPACING 0.1 0.2 0.4\nORIGIN 10 20 30\n";
  };
  const std::string scalars =
      "POINT_DATA 105\nSCALARS labels unsigned_short 1\nLOOKUP_TABLE default\n";
  expect_made_of("a.vtk", head("BINARY", "7 5 3") + scalars + made_.bytes<std::uint16_t>(true));
  EXPECT_TRUE(notes("a.vtk").empty());
  EXPECT_LT((geometry("a.vtk").point({0.5, 0.5, 0.5}) - Vector3(10, 20, 30)).norm(), 1e-13);
  expect_cut_is_refused("a.vtk", 1);
  expect_made_of("a.vtk", head("BINARY", "8 6 4") +
                              "CELL_DATA 105\nSCALARS labels int\nLOOKUP_TABLE default\n" +
                              made_.bytes<std::int32_t>(true));
  EXPECT_LT((geometry("a.vtk").point({0, 0, 0}) - Vector3(10, 20, 30)).norm(), 1e-13);
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
           {"unsigned_char", made_.bytes<std::uint8_t>()},
           {"char", made_.bytes<std::int8_t>()},
           {"short", made_.bytes<std::int16_t>(true)},
           {"unsigned_int", made_.bytes<std::uint32_t>(true)},
           {"long", made_.bytes<std::int64_t>(true)},
           {"vtktypeint64", made_.bytes<std::int64_t>(true)},
           {"unsigned_long", made_.bytes<std::uint64_t>(true)}}) {
    expect_made_of("a.vtk", head("BINARY", "7 5 3") + "POINT_DATA 105\nSCALARS labels " + name +
                                "\nLOOKUP_TABLE default\n" + bytes);
  }
  // As VTK writes every array of 8 bits.
  const std::string colours = "POINT_DATA 105\nCOLOR_SCALARS labels 1\n";
  expect_made_of("a.vtk", head("BINARY", "7 5 3") + colours + made_.bytes<std::uint8_t>() + "\n");
  expect_refused_of("a.vtk", head("ASCII", "7 5 3") + colours + "0.5", {"line 9", "BINARY"});
  // Several arrays, among them those of a field; text and numbers.
  std::string text;
  std::string twice;
  std::string grey;
  for (std::size_t k = 0; k < made_.labels.size(); ++k) {
    text += std::to_string(made_.labels[k]) + (k % 9 == 8 ? "\n" : " ");
    twice += std::to_string(made_.labels[k]) + " " + std::to_string(made_.labels[k] + 200) + "\n";
    grey += "0.5 ";
  }
  const std::string fields = "FIELD FieldData 2\nlabels 1 105 int\n" + text +
                             "\nMETADATA\nINFORMATION 0\n\npair 2 105 int\n" + twice;
  expect_refused_of("a.vtk",
                    head("ASCII", "7 5 3") +
                        "POINT_DATA 105\nSCALARS grey float\nLOOKUP_TABLE default\n" + grey + "\n" +
                        fields,
                    {"3 arrays", "\"grey\"", "\"labels\"", "\"pair\""});
  expect_made("a.vtk", array("labels"));
  VolumeChoice choice = array("pair");
  expect_refused("a.vtk", {"2 channels"}, choice);
  choice.channel = 2;
  EXPECT_EQ(labels_of("a.vtk", choice), labels(200));
  expect_refused("a.vtk", {"0.5"}, array("grey"));
  expect_made_of("a.vtk",
                 head("BINARY", "7 5 3") + "POINT_DATA 105\nFIELD f 2\na 1 105 unsigned_char\n" +
                     std::string(105, '\n') + "\nlabels 1 105 unsigned_short\n" +
                     made_.bytes<std::uint16_t>(true) + "\n",
                 array("labels"));
  for (const auto& [wrong, word] : std::vector<std::pair<std::string, std::string>>{
           {"no VTK\n", "VTK"},
           {"# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 0 float\n",
            "structured points"},
           {head("BINARY", "7 5 4") + scalars, "another number"},
           {head("BINARY", "7 5 0") + scalars, "dimensions"},
           {head("BINARY", "7 5 3"), "no array"},
           {head("BINARY", "7 5 3") + "POINT_DATA 105\nTENSORS t float\n", "\"tensors\""},
           {head("BINARY", "7 5 3") + "POINT_DATA 105\nSCALARS l bit\nLOOKUP_TABLE d\n", "bit"},
           {"# vtk DataFile Version 3.0\nx\nBINARY\nDATASET STRUCTURED_POINTS\nDIMENSIONS 7 5 3\n"
            "SPACING -1 -1 1\n" +
                scalars + made_.bytes<std::uint16_t>(true),
            "the spacing -1, -1, 1"},
           {head("OTHER", "7 5 3"), "ASCII"}}) {
    expect_refused_of("a.vtk", wrong, {word});
  }
}

class Hdf5Volumes : public ArrayVolumes {
 protected:
  /// The labels as they are stored in the order x, y, z, the last one fastest; 2 bytes each.
  std::string bytes_by_x() const {
    std::string bytes;
    for (int x = 0; x < 7; ++x) {
      for (int y = 0; y < 5; ++y) {
        for (int z = 0; z < 3; ++z) {
          const std::uint32_t label = made_.labels[static_cast<std::size_t>((z * 5 + y) * 7 + x)];
          bytes += test::four_bytes(label).substr(0, 2);
        }
      }
    }
    return bytes;
  }

  /// Adds a data set to the file; `chunk` 0: in one block.
  void add(const std::string& name, hid_t type, const std::vector<hsize_t>& counts,
           const std::string& bytes, hsize_t chunk = 0, bool is_matlab = false,
           const std::vector<double>& size = {}) const {
    const bool is_new = !std::filesystem::exists(path("a.h5"));
    const hid_t file =
        is_new ? H5Fcreate(path("a.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)
               : H5Fopen(path("a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t space = H5Screate_simple(static_cast<int>(counts.size()), counts.data(), nullptr);
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    if (chunk > 0) {
      std::vector<hsize_t> chunks;
      for (const hsize_t count : counts) chunks.push_back(std::min(count, chunk));
      H5Pset_chunk(made, static_cast<int>(chunks.size()), chunks.data());
      H5Pset_deflate(made, 6);
    }
    const hid_t set = H5Dcreate2(file, name.c_str(), type, space, links, made, H5P_DEFAULT);
    ASSERT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), 0);
    const auto attribute = [&](const char* key, hid_t kind, hsize_t count, const void* value) {
      const hid_t extent = H5Screate_simple(1, &count, nullptr);
      const hid_t id = H5Acreate2(set, key, kind, extent, H5P_DEFAULT, H5P_DEFAULT);
      H5Awrite(id, kind, value);
      H5Aclose(id);
      H5Sclose(extent);
    };
    const int code = 1;
    if (is_matlab) attribute("MATLAB_class", H5T_NATIVE_INT, 1, &code);
    if (!size.empty()) attribute("element_size_um", H5T_NATIVE_DOUBLE, 3, size.data());
    H5Dclose(set);
    H5Pclose(made);
    H5Sclose(space);
    H5Pclose(links);
    H5Fclose(file);
  }

  /// Adds texts as an attribute of a data set or a group, which is made.
  void add_texts(const std::string& name, const char* key,
                 const std::vector<std::string>& texts) const {
    const hid_t file = H5Fopen(path("a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    if (H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0) {
      H5Gclose(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    }
    const hid_t object = H5Oopen(file, name.c_str(), H5P_DEFAULT);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    const hsize_t count = texts.size();
    const hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
    const hid_t id = H5Acreate2(object, key, type, space, H5P_DEFAULT, H5P_DEFAULT);
    std::vector<const char*> values;
    for (const std::string& text : texts) values.push_back(text.c_str());
    H5Awrite(id, type, values.data());
    H5Aclose(id);
    H5Sclose(space);
    H5Tclose(type);
    H5Oclose(object);
    H5Fclose(file);
  }
  void add_text(const std::string& name, const char* key, const std::string& text) const {
    add_texts(name, key, {text});
  }
  /// Adds a text letter by letter, as Imaris does.
  void add_letters(const std::string& name, const char* key, const std::string& text) const {
    const hid_t file = H5Fopen(path("a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t object = H5Oopen(file, name.c_str(), H5P_DEFAULT);
    const hsize_t count = text.size();
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t id = H5Acreate2(object, key, H5T_C_S1, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(id, H5T_C_S1, text.data());
    H5Aclose(id);
    H5Sclose(space);
    H5Oclose(object);
    H5Fclose(file);
  }
};

// What is not read is not denied: half precision, and a link to a file that could be any other's.
TEST_F(Hdf5Volumes, SaysWhichNumbersAndLinksAreNotRead) {
  const hid_t half = H5Tcopy(H5T_IEEE_F32LE);
  H5Tset_fields(half, 15, 10, 5, 0, 10);
  H5Tset_size(half, 2);
  H5Tset_ebias(half, 15);
  add("half", half, {3, 5, 7}, made_.bytes<std::uint16_t>());
  H5Tclose(half);
  expect_refused("a.h5", {"float32 or float64", "Links to other files are not followed"});
  add("labels", H5T_NATIVE_UINT16, {3, 5, 7}, made_.bytes<std::uint16_t>());
  expect_made("a.h5");
  const hid_t file = H5Fcreate(path("b.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Lcreate_external("a.h5", "/labels", file, "link", H5P_DEFAULT, H5P_DEFAULT), 0);
  H5Fclose(file);
  expect_refused("b.h5", {"float32 or float64", "Links to other files are not followed"});
}

TEST_F(Hdf5Volumes, AreReadByThePathOfTheirDataSet) {
  for (const hsize_t chunk : {0, 1, 2, 3}) {
    std::filesystem::remove(path("a.h5"));
    add("deep/in/labels", H5T_NATIVE_UINT16, {3, 5, 7}, made_.bytes<std::uint16_t>(), chunk, false,
        {4.0, 2.0, 1.0});
    add("table", H5T_NATIVE_UINT16, {15, 7}, made_.bytes<std::uint16_t>());
    expect_made("a.h5");
    EXPECT_EQ(geometry("a.h5").unit, "um");
    EXPECT_LT((geometry("a.h5").point({1, 1, 1}) - Vector3(1, 2, 4)).norm(), 1e-15);
    expect_placed("a.h5", Vector3(1, 2, 4));
    add("more", H5T_STD_I32BE, {1, 3, 5, 7}, made_.bytes<std::int32_t>(true), chunk);
    expect_refused("a.h5", {"2 arrays", "\"/deep/in/labels\"", "\"/more\""});
    add("turned", H5T_NATIVE_UINT16, {3, 5, 7}, made_.bytes<std::uint16_t>(), chunk, false,
        {-4.0, 2.0, 1.0});
    expect_refused("a.h5", {"the spacing 1, 2, -4"}, array("turned"));
    expect_made("a.h5", array("/more"));
    expect_made("a.h5", array("deep/in/labels"));
    expect_refused("a.h5", {"\"/table\"", "Correct --select array="}, array("table"));
  }
  MadeVolume more = made_;
  for (Label& label : more.labels) label += 200;
  add("frames", H5T_NATIVE_UINT16, {2, 3, 5, 7},
      made_.bytes<std::uint16_t>() + more.bytes<std::uint16_t>(), 2);
  VolumeChoice choice = array("frames");
  expect_refused("a.h5", {"2 frames"}, choice);
  choice.frame = 2;
  EXPECT_EQ(labels_of("a.h5", choice), labels(200));
  expect_refused_of("b.h5", "no HDF5", {"not an HDF5"});
  expect_refused_of("b.mat", "MATLAB 5.0 MAT-file", {"-v7.3"});
}

TEST_F(Hdf5Volumes, OfMatlabAreNotMirrored) {
  // A(row, column, slice) = made(x = column, y = row, z = slice), the row fastest.
  std::string bytes;
  for (int z = 0; z < 3; ++z) {
    for (int x = 0; x < 7; ++x) {
      for (int y = 0; y < 5; ++y) {
        bytes += test::four_bytes(made_.labels[static_cast<std::size_t>((z * 5 + y) * 7 + x)])
                     .substr(0, 2);
      }
    }
  }
  add("L", H5T_NATIVE_UINT16, {3, 7, 5}, bytes, 3, true);
  std::filesystem::rename(path("a.h5"), path("a.mat"));
  EXPECT_EQ(geometry("a.mat").counts, (VoxelCounts{5, 7, 3}));
  expect_placed("a.mat", Vector3(1, 1, 1));
}

TEST_F(Hdf5Volumes, OfIlastikAreReadByTheirAxistags) {
  // Stored as x, y, z, with the channels at any place.
  const std::string bytes = bytes_by_x();
  const auto key = [](const std::string& letter) {
    return R"({"key":")" + letter + R"(","typeFlags":2,"resolution":0,"description":""})";
  };
  for (const bool has_channel : {false, true}) {
    std::filesystem::remove(path("a.h5"));
    if (has_channel) {
      add("exported_data", H5T_NATIVE_UINT16, {7, 5, 3, 1}, bytes);
    } else {
      add("exported_data", H5T_NATIVE_UINT16, {7, 5, 3}, bytes);
    }
    add_text("exported_data", "axistags",
             R"({"axes":[)" + key("x") + "," + key("y") + "," + key("z") +
                 (has_channel ? "," + key("c") : "") + "]}");
    expect_placed("a.h5", Vector3(1, 1, 1));
  }
  std::filesystem::remove(path("a.h5"));
  add("exported_data", H5T_NATIVE_UINT16, {7, 5, 3}, bytes);
  add_text("exported_data", "axistags", R"({"axes":[)" + key("z") + "," + key("y") + "]}");
  expect_refused("a.h5", {"axistags of 2 axes", "3 dimensions"});
}

TEST_F(Hdf5Volumes, OfIlastikHaveTheResolutionOfTheirAxistags) {
  const auto write_tags = [&](const std::array<const char*, 3>& lengths,
                              const std::array<const char*, 3>& units) {
    std::filesystem::remove(path("a.h5"));
    add("exported_data", H5T_NATIVE_UINT16, {7, 5, 3}, bytes_by_x());
    std::string text;
    for (std::size_t k = 0; k < 3; ++k) {
      text += std::string(k == 0 ? "" : ",") + R"({"key":")" + "xyz"[k] + R"(","resolution":)" +
              lengths[k] + R"(,"unit":")" + units[k] + "\"}";
    }
    add_text("exported_data", "axistags", R"({"axes":[)" + text + "]}");
  };
  write_tags({"0.5", "0.25", "2000"}, {"um", "\u00b5m", "nm"});
  expect_placed("a.h5", Vector3(0.5, 0.25, 2.0));
  EXPECT_EQ(geometry("a.h5").unit, "um");
  EXPECT_EQ(geometry("a.h5").size_source, "ilastik's axistags");
  write_tags({"0.5", "0.25", "2"}, {"", "", ""});
  expect_placed("a.h5", Vector3(0.5, 0.25, 2.0));
  EXPECT_EQ(geometry("a.h5").unit, "");
  for (const auto& [length, unit] : std::vector<std::pair<const char*, const char*>>{
           {"0", "um"}, {"1", ""}, {"-1", "um"}, {"1", "bogus"}}) {
    write_tags({"1", "1", length}, {unit, unit, unit[0] == 'b' ? "um" : unit});
    EXPECT_FALSE(geometry("a.h5").has_size) << length << unit;
    expect_placed("a.h5", Vector3(1, 1, 1));
  }
}

TEST_F(Hdf5Volumes, OfNexusHaveTheStepsOfTheirAxes) {
  const auto write_axes = [&](double uneven, bool is_old) {
    std::filesystem::remove(path("a.h5"));
    add("entry/voxels", H5T_NATIVE_UINT16, {7, 5, 3}, bytes_by_x());
    add_text("entry", "NX_class", "NXdata");
    if (is_old) {
      add_text("entry/voxels", "axes", "x:y:z");
    } else {
      add_texts("entry", "axes", {"x", "y", "z"});
    }
    // Centres along x and y, edges along z.
    const std::array<std::size_t, 3> counts = {7, 5, 4};
    const std::array<double, 3> steps = {0.5, 0.25, 2.0};
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<double> places;
      for (std::size_t i = 0; i < counts[k]; ++i) {
        places.push_back(3.0 + steps[k] * static_cast<double>(i));
      }
      places[2] += uneven;
      const std::string name = std::string("entry/") + "xyz"[k];
      add(name, H5T_NATIVE_DOUBLE, {counts[k]},
          std::string(reinterpret_cast<const char*>(places.data()), 8 * counts[k]));
      add_text(name, "units", "mm");
    }
    std::filesystem::rename(path("a.h5"), path("a.nxs"));
  };
  for (const bool is_old : {false, true}) {
    write_axes(0.0, is_old);
    expect_placed("a.nxs", Vector3(0.5, 0.25, 2.0));
    EXPECT_EQ(geometry("a.nxs").unit, "mm");
    EXPECT_EQ(geometry("a.nxs").size_source, "NeXus' axes");
  }
  write_axes(0.1, false);
  EXPECT_FALSE(geometry("a.nxs").has_size);
  expect_placed("a.nxs", Vector3(1, 1, 1));
}

TEST_F(Hdf5Volumes, OfImarisAreCutToTheirImage) {
  // Stored in blocks that exceed the image of 7 x 5 x 3 voxels, with a smaller level.
  for (int c = 0; c < 2; ++c) {
    std::string bytes(4 * 8 * 8 * 2, '\x63');
    const std::string rows = made_.bytes<std::uint16_t>();
    for (std::size_t z = 0; z < 3; ++z) {
      for (std::size_t y = 0; y < 5; ++y) {
        bytes.replace((z * 8 + y) * 16, 14, rows.substr((z * 5 + y) * 14, 14));
      }
    }
    if (c == 0) bytes.assign(bytes.size(), '\1');
    for (const char* level : {"0", "1"}) {
      const std::string group = std::string("DataSet/ResolutionLevel ") + level +
                                "/TimePoint 0/Channel " + std::to_string(c);
      add(group + "/Data", H5T_NATIVE_UINT16, {4, 8, 8}, bytes, 4);
      add_letters(group, "ImageSizeX", "7");
      add_letters(group, "ImageSizeY", "5");
      add_letters(group, "ImageSizeZ", "3");
    }
  }
  add_text("DataSetInfo", "Y", "5");
  add_text("DataSetInfo/Image", "Y", "5");
  add_letters("DataSetInfo/Image", "Unit", "um");
  const std::array<std::array<const char*, 2>, 3> ends = {
      {{"10.000", "13.500"}, {"20", "21.25"}, {"-5", "1"}}};
  for (std::size_t k = 0; k < 3; ++k) {
    add_letters("DataSetInfo/Image", ("ExtMin" + std::to_string(k)).c_str(), ends[k][0]);
    add_letters("DataSetInfo/Image", ("ExtMax" + std::to_string(k)).c_str(), ends[k][1]);
  }
  std::filesystem::rename(path("a.h5"), path("a.ims"));
  expect_refused("a.ims", {"2 channels", "--select channel=1 to channel=2"});
  expect_made("a.ims", channel(2));
  expect_made("a.ims", array("DataSet/ResolutionLevel 0/TimePoint 0/Channel 1/Data"));
  const VolumeGeometry read = geometry("a.ims", channel(2));
  EXPECT_EQ(read.unit, "um");
  EXPECT_LT((read.point({0, 0, 0}) - Vector3(10, 20, -5)).norm(), 1e-12);
  EXPECT_LT((read.point({7, 5, 3}) - Vector3(13.5, 21.25, 1)).norm(), 1e-12);
}

TEST_F(Hdf5Volumes, HaveTheOrderOfTheirDimensionLabels) {
  const std::string bytes = bytes_by_x();
  const std::vector<std::string> all_labels = {"x", "Y", "z"};
  for (const std::size_t labelled : {std::size_t{3}, std::size_t{2}}) {
    std::filesystem::remove(path("a.h5"));
    add("labels", H5T_NATIVE_UINT16, {7, 5, 3}, bytes);
    const hid_t file = H5Fopen(path("a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t set = H5Dopen2(file, "labels", H5P_DEFAULT);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    const hsize_t count = 3;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t id = H5Acreate2(set, "DIMENSION_LABELS", type, space, H5P_DEFAULT, H5P_DEFAULT);
    std::array<const char*, 3> texts = {"", "", ""};
    for (std::size_t k = 0; k < labelled; ++k) texts[k] = all_labels[k].c_str();
    H5Awrite(id, type, texts.data());
    const hid_t extent = H5Screate_simple(1, &count, nullptr);
    const hid_t size =
        H5Acreate2(set, "resolution", H5T_NATIVE_DOUBLE, extent, H5P_DEFAULT, H5P_DEFAULT);
    const std::array<double, 3> lengths = {1.0, 0.5, 0.25};
    H5Awrite(size, H5T_NATIVE_DOUBLE, lengths.data());
    for (const hid_t attribute : {id, size}) H5Aclose(attribute);
    for (const hid_t one : {space, extent}) H5Sclose(one);
    H5Tclose(type);
    H5Dclose(set);
    H5Fclose(file);
    if (labelled == 3) {
      expect_placed("a.h5", Vector3(1, 1, 1));
    } else {
      EXPECT_EQ(geometry("a.h5").counts, (VoxelCounts{3, 5, 7})) << "no label for each";
    }
    ASSERT_FALSE(notes("a.h5").empty());
    EXPECT_TRUE(
        test::holds(notes("a.h5")[0], "\"resolution\" has 1, 0.5 and 0.25. It was not used"));
  }
}

TEST_F(Hdf5Volumes, OfDream3dHaveTheSizeOfTheirGeometry) {
  const std::string cells = "DataContainers/Image/CellData/";
  add(cells + "FeatureIds", H5T_NATIVE_INT32, {3, 5, 7, 1}, made_.bytes<std::int32_t>());
  add(cells + "Phases", H5T_NATIVE_INT32, {3, 5, 7, 1}, made_.bytes<std::int32_t>());
  std::vector<float> numbers = {0.5F, 0.25F, 1.0F};
  const auto bytes = [&] {
    return std::string(reinterpret_cast<const char*>(numbers.data()), 3 * sizeof(float));
  };
  add("DataContainers/Image/_SIMPL_GEOMETRY/SPACING", H5T_NATIVE_FLOAT, {3}, bytes());
  numbers = {10.0F, 20.0F, 30.0F};
  add("DataContainers/Image/_SIMPL_GEOMETRY/ORIGIN", H5T_NATIVE_FLOAT, {3}, bytes());
  const std::string geometry_group = "DataContainers/Image/_SIMPL_GEOMETRY/";
  numbers = {7.0F, 5.0F, 3.0F};
  add(geometry_group + "DIMENSIONS", H5T_NATIVE_FLOAT, {3}, bytes());
  std::filesystem::rename(path("a.h5"), path("a.dream3d"));
  EXPECT_TRUE(is_volume(path("a.dream3d")));
  expect_made("a.dream3d");
  EXPECT_TRUE(test::holds(notes("a.dream3d").at(0), "CellData/FeatureIds\""));
  EXPECT_EQ(geometry("a.dream3d").point({1, 1, 1}), Vector3(10.5, 20.25, 31.0));
  expect_made("a.dream3d", array(cells + "Phases"));
  add(cells + "FeatureIds", H5T_NATIVE_INT32, {3, 5, 7, 1}, made_.bytes<std::int32_t>());
  numbers = {0.5F, 0.25F, 1.0F};
  add(geometry_group + "SPACING", H5T_NATIVE_FLOAT, {3}, bytes());
  numbers = {3.0F, 5.0F, 7.0F};
  add(geometry_group + "DIMENSIONS", H5T_NATIVE_FLOAT, {3}, bytes());
  expect_refused("a.h5", {"7 voxels along x", "DIMENSIONS say 3"});
}

TEST_F(Hdf5Volumes, WithVoxelsInOtherFilesAreRefused) {
  write("other.raw", std::string(105, 'x'));
  const hsize_t counts[3] = {3, 5, 7};
  for (const bool is_virtual : {false, true}) {
    const hid_t file = H5Fcreate(path("a.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(3, counts, nullptr);
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    if (is_virtual) {
      H5Pset_virtual(made, space, path("other.h5").c_str(), "labels", space);
    } else {
      H5Pset_external(made, path("other.raw").c_str(), 0, 105);
    }
    const hid_t set =
        H5Dcreate2(file, "labels", H5T_NATIVE_UINT8, space, H5P_DEFAULT, made, H5P_DEFAULT);
    ASSERT_GE(set, 0);
    H5Dclose(set);
    H5Pclose(made);
    H5Sclose(space);
    H5Fclose(file);
    expect_refused("a.h5", {is_virtual ? "virtual data set" : "external storage",
                            "h5py.File(\"a.h5\")[\"/labels\"][()]"});
  }
}

}  // namespace
}  // namespace wscvt
