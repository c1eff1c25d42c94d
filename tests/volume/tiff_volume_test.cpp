// SPDX-License-Identifier: GPL-3.0-or-later
// TIFF as ImageJ, OME, tifffile and MATLAB write it, and folders of slices.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "support/holds.h"
#include "support/tiff_pages.h"
#include "support/volume_folder.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::channel;
using test::frame;
using test::holds;
using test::MadeVolume;
using test::TiffPages;

class TiffVolume : public test::VolumeFolder {
 protected:
  TiffPages as() const {
    TiffPages pages;
    pages.width = made_.counts[0];
    pages.height = made_.counts[1];
    return pages;
  }

  /// Slices as pages of 16 bits, plus a number.
  std::string page(int z, std::uint32_t more = 0) const {
    MadeVolume volume = made_;
    for (std::uint32_t& label : volume.labels) label += more;
    const std::size_t size = 2 * static_cast<std::size_t>(made_.counts[0] * made_.counts[1]);
    return volume.bytes<std::uint16_t>().substr(static_cast<std::size_t>(z) * size, size);
  }
  std::vector<std::string> pages(std::uint32_t more = 0) const {
    std::vector<std::string> all;
    for (int z = 0; z < made_.counts[2]; ++z) all.push_back(page(z, more));
    return all;
  }

  /// Bytes of one type, cut into pages.
  template <class Value>
  std::vector<std::string> pages_of() const {
    const std::string bytes = made_.bytes<Value>();
    const std::size_t size = bytes.size() / static_cast<std::size_t>(made_.counts[2]);
    std::vector<std::string> all;
    for (std::size_t z = 0; z < static_cast<std::size_t>(made_.counts[2]); ++z) {
      all.push_back(bytes.substr(z * size, size));
    }
    return all;
  }

  /// Writes pages that have the labels, or have to be refused.
  void expect_made_of(const TiffPages& stack, const std::vector<std::string>& content,
                      const VolumeChoice& choice = {}) const {
    write_tiff(path("a.tif"), stack, content);
    expect_made("a.tif", choice);
  }
  void expect_refused_of(const TiffPages& stack, const std::vector<std::string>& content,
                         const std::vector<std::string>& words,
                         const VolumeChoice& choice = {}) const {
    write_tiff(path("a.tif"), stack, content);
    expect_refused("a.tif", words, choice);
  }

  void write_png(const std::string& name, int z, int bits, int color, bool interlaced = false,
                 int height = 5) const {
    std::FILE* const file = std::fopen(path(name).c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, 7, static_cast<png_uint_32>(height), bits, color,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette(256);
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 1 << bits);
    png_write_info(png, info);
    png_set_packing(png);
    const int channels = color == PNG_COLOR_TYPE_RGB ? 3 : 1;
    const std::uint32_t most = bits == 16 ? 0xffffU : (1U << bits) - 1U;
    std::vector<std::vector<png_byte>> rows;
    for (int y = 0; y < height; ++y) {
      std::vector<png_byte> row;
      for (int x = 0; x < 7; ++x) {
        for (int c = 0; c < channels; ++c) {
          const std::uint32_t label =
              (made_.labels[static_cast<std::size_t>((z * 5 + y % 5) * 7 + x)] + 3U * c) & most;
          if (bits == 16) row.push_back(static_cast<png_byte>(label >> 8));
          row.push_back(static_cast<png_byte>(label & 0xffU));
        }
      }
      rows.push_back(row);
    }
    std::vector<png_bytep> pointers;
    for (auto& row : rows) pointers.push_back(row.data());
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
  }
};

// Of microscopes and of tifffile: previews, pyramids and masks stand between the slices.
TEST_F(TiffVolume, LeavesReducedImagesOut) {
  const auto expect_left_out = [&](int count) {
    expect_made("a.tif");
    ASSERT_EQ(notes("a.tif").size(), 2U);
    EXPECT_EQ(notes("a.tif")[0].find("Left out: " + std::to_string(count) + " reduced image"), 0U);
  };
  TiffPages small = as();
  small.width = 4;
  small.height = 3;
  small.marks = FILETYPE_REDUCEDIMAGE;
  const std::string small_page(24, '\1');
  for (const std::string& page : pages()) {  // as Zeiss' .lsm
    TiffPages stack = as();
    stack.mode = fs::exists(path("a.tif")) ? "a" : "w";
    write_tiff(path("a.tif"), stack, {page});
    small.mode = "a";
    write_tiff(path("a.tif"), small, {small_page});
  }
  expect_left_out(3);
  // Unmarked: a pyramid of half the size behind the slices, or one preview.
  small.marks = 0;
  for (const std::size_t levels : {3U, 1U}) {
    write_tiff(path("a.tif"), as(), pages());
    write_tiff(path("a.tif"), small, std::vector<std::string>(levels, small_page));
    expect_left_out(static_cast<int>(levels));
  }
  TiffPages stack = as();
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\n";
  stack.mode = "a";
  small.mode = "w";
  write_tiff(path("a.tif"), small, {small_page});
  write_tiff(path("a.tif"), stack, pages());
  expect_left_out(1);
  // In a folder, and behind a page.
  fs::create_directory(path("s"));
  small.mode = "a";
  for (int z = 0; z < 3; ++z) {
    write_tiff(path("s/" + std::to_string(z) + ".tif"), as(), {page(z)});
    write_tiff(path("s/" + std::to_string(z) + ".tif"), small, {small_page});
  }
  expect_made("s");
  stack = as();
  stack.behind_first = 1;
  write_tiff(path("a.tif"), stack, {page(0), page(2), page(1), page(2)});
  expect_left_out(1);
  // A mask is as large as its page.
  TiffPages mask = as();
  mask.mode = "a";
  mask.marks = FILETYPE_MASK;
  write_tiff(path("a.tif"), as(), pages());
  write_tiff(path("a.tif"), mask, {page(1)});
  expect_left_out(1);
}

TEST_F(TiffVolume, ReadsPagesThatAreReducedByTheirMarkAlone) {
  TiffPages stack = as();
  stack.marks = FILETYPE_REDUCEDIMAGE;
  expect_made_of(stack, pages());
  EXPECT_EQ(notes("a.tif").size(), 1U);
  write_tiff(path("a.tif"), as(), {page(0), page(1)});
  stack.mode = "a";
  write_tiff(path("a.tif"), stack, {page(2)});
  expect_made("a.tif");
  EXPECT_EQ(open_volume(path("a.tif"))->warnings().size(), 1U);
  // No previews: larger, between the slices, or of another volume.
  TiffPages other = as();
  other.mode = "a";
  stack = as();
  stack.mode = "a";
  write_tiff(path("a.tif"), as(), pages());
  other.width = 8;
  write_tiff(path("a.tif"), other, {std::string(80, '\1')});
  expect_refused("a.tif", {"the page 4 of", "but the first has"});
  other.width = 3;
  other.height = 4;
  write_tiff(path("a.tif"), as(), {page(0), page(1)});
  write_tiff(path("a.tif"), other, {std::string(24, '\1')});
  write_tiff(path("a.tif"), stack, {page(2)});
  expect_refused("a.tif", {"the page 3 of", "but the first has"});
  write_tiff(path("a.tif"), as(), pages());
  write_tiff(path("a.tif"), other, std::vector<std::string>(3, std::string(24, '\1')));
  expect_refused("a.tif", {"the page 4 of", "but the first has"});
}

TEST_F(TiffVolume, RefusesPagesOfSeveralSlicesWithAWay) {
  TiffPages stack = as();
  stack.depth = 2;
  write_tiff(path("a.tif"), stack, pages());
  expect_refused("a.tif", {"pages of 2 slices", "tifffile.imread(\"a.tif\")"});
}

TEST_F(TiffVolume, LeavesAConstantAlphaOut) {
  TiffPages stack = as();
  stack.samples = 2;
  for (const int kind : {EXTRASAMPLE_ASSOCALPHA, EXTRASAMPLE_UNASSALPHA}) {
    stack.extra = kind;
    std::vector<std::string> content;
    for (const std::string& grey : pages()) {
      content.emplace_back();
      for (std::size_t k = 0; k < grey.size(); k += 2) {
        content.back() += grey.substr(k, 2) + "\xff\xff";
      }
    }
    expect_made_of(stack, content);
    EXPECT_EQ(notes("a.tif")[0], "Left out: the channel alpha, which is constant.");
    content.back().back() = '\0';
    expect_refused_of(stack, content, {"alpha, that is not constant", "--select channel=1"});
    expect_made("a.tif", channel(1));
  }
  stack.extra = EXTRASAMPLE_UNSPECIFIED;
  expect_refused_of(stack, std::vector<std::string>(3, std::string(140, '\1')), {"2 channels"});
}

// Griottes 2 and its kind: channels and frames stand between the slices.
TEST_F(TiffVolume, NamesImageJsChannelsAndFramesAndReadsTheChosenOnes) {
  TiffPages stack = as();
  std::vector<std::string> all;  // channels run fastest, then slices, then frames
  for (std::uint32_t t = 0; t < 4; ++t) {
    for (int z = 0; z < 3; ++z) {
      for (std::uint32_t c = 0; c < 2; ++c) all.push_back(page(z, 1000 * t + 200 * c));
    }
  }
  for (const char* mode : {"wl", "wb", "w8"}) {
    stack.mode = mode;
    stack.text = "ImageJ=1.53\nimages=24\nchannels=2\nslices=3\nframes=4\nhyperstack=true\n";
    expect_refused_of(stack, all, {"2 channels", "--select channel=1 to channel=2"});
    expect_refused("a.tif", {"4 frames", "--select time=1 to time=4"}, channel(1));
    VolumeChoice choice = channel(2);
    choice.frame = 3;
    EXPECT_EQ(labels_of("a.tif", choice), labels(2200)) << mode;
    choice.frame = 4;
    EXPECT_EQ(labels_of("a.tif", choice), labels(3200)) << mode;
    choice.frame = 5;
    expect_refused("a.tif", {"4 frames, not a frame 5"}, choice);
  }
  stack.text = "ImageJ=1.53\nimages=24\nchannels=2\nslices=3\nframes=3\n";
  expect_refused_of(stack, all, {"24 images", "3 slices"}, channel(1));
  stack.text = "ImageJ=1.53\nimages=12\nslices=12\n";
  expect_refused_of(stack, all, {"24 pages, but ImageJ noted 12"});
  stack.text = "ImageJ=1.53\nimages=24\nframes=24\n";
  expect_refused_of(stack, all, {"one slice", "24 images"});
  // A stack of slices has no channel to choose but the first.
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\n";
  expect_made_of(stack, pages(), channel(1));
  expect_refused("a.tif", {"1 channel, not a channel 2"}, channel(2));
  expect_refused("a.tif", {"--select array=labels"}, test::array("labels"));
}

TEST_F(TiffVolume, TakesImageJsSizesAsImageJDoes) {
  TiffPages stack = as();
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\nunit=\\u00B5m\nspacing=0.25\n";
  stack.resolution = 20.0;
  for (const int unit : {RESUNIT_NONE, RESUNIT_INCH, RESUNIT_CENTIMETER}) {
    stack.resolution_unit = unit;
    write_tiff(path("a.tif"), stack, pages());
    const VolumeGeometry read = geometry("a.tif");
    EXPECT_TRUE(read.has_size);
    EXPECT_EQ(read.unit, "um");
    EXPECT_LT((read.point({1, 1, 1}) - Vector3(0.05, 0.1, 0.25)).norm(), 1e-7) << unit;
    EXPECT_TRUE(notes("a.tif").empty());
  }
  // It writes no distance of 1.
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\nunit=mm\n";
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(0.05, 0.1, 1.0)).norm(), 1e-7);
  ASSERT_EQ(notes("a.tif").size(), 1U);
  EXPECT_TRUE(holds(notes("a.tif")[0], "1 mm"));
  // A distance of slices without a unit still says how long the voxels are.
  for (const char* unitless : {"spacing=3\n", "unit=pixel\nspacing=3\n"}) {
    stack.text = std::string("ImageJ=1.53\nimages=3\nslices=3\n") + unitless;
    write_tiff(path("a.tif"), stack, pages());
    EXPECT_TRUE(geometry("a.tif").has_size);
    EXPECT_EQ(geometry("a.tif").unit, "");
    EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(0.05, 0.1, 3.0)).norm(), 1e-7);
    ASSERT_EQ(notes("a.tif").size(), 1U);
    EXPECT_TRUE(holds(notes("a.tif")[0], "the unit is unknown"));
  }
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\n";
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_FALSE(geometry("a.tif").has_size);
  EXPECT_EQ(geometry("a.tif").voxel_volume(), 1.0);
  ASSERT_EQ(notes("a.tif").size(), 1U);
  EXPECT_TRUE(holds(notes("a.tif")[0], "No voxel size found: lengths in voxels"));
}

TEST_F(TiffVolume, TakesAResolutionPerCmWhereImageJsUnitMakesVoxelsFlat) {
  TiffPages stack = as();
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\nunit=um\nspacing=0.25\n";
  stack.resolution = 50000.0;  // of 0.2 um; along y half as many
  stack.resolution_unit = RESUNIT_CENTIMETER;
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(0.2, 0.4, 0.25)).norm(), 1e-7);
  EXPECT_TRUE(holds(notes("a.tif")[0], "per cm"));
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\nunit=um\n";  // 1 um along z
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(0.2, 0.4, 1.0)).norm(), 1e-7);
  stack.resolution_unit = RESUNIT_NONE;
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(2e-5, 4e-5, 1.0)).norm(), 1e-7);
  EXPECT_EQ(open_volume(path("a.tif"))->warnings().size(), 1U);
}

TEST_F(TiffVolume, RefusesImageJsAxesInTwoUnits) {
  TiffPages stack = as();
  stack.resolution = 20.0;
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\nunit=mm\nzunit=micron\nspacing=0.25\n";
  expect_refused_of(stack, pages(), {"in \"mm\" and in \"um\"", "--voxel-size"});
  VolumeChoice given;
  given.voxel_size = Vector3(0.05, 0.1, 0.00025);
  EXPECT_EQ(open_volume(path("a.tif"), given)->geometry().point({1, 1, 1}), *given.voxel_size);
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\nunit=um\nyunit=micron\nspacing=0.25\n";
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_EQ(geometry("a.tif").unit, "um");
}

// ImageJ's "Save as image sequence": each slice has the unit, none the distance of slices.
TEST_F(TiffVolume, TakesImageJsSizesOfSlicesInAFolder) {
  fs::create_directory(folder_ / "slices");
  TiffPages slice = as();
  slice.resolution = 20.0;
  const auto write_slices = [&](const std::string& text, std::uint32_t more) {
    slice.text = text;
    for (int z = 0; z < 3; ++z) {
      write_tiff(path("slices/s" + std::to_string(z) + ".tif"), slice, {page(z, more)});
    }
  };
  write_slices("ImageJ=1.53t\nunit=mm\n", 0);
  expect_made("slices");
  EXPECT_EQ(geometry("slices").unit, "mm");
  EXPECT_LT((geometry("slices").point({1, 1, 1}) - Vector3(0.05, 0.1, 0.05)).norm(), 1e-7);
  ASSERT_EQ(notes("slices").size(), 1U);
  EXPECT_TRUE(holds(notes("slices")[0], "along z as along x"));
  write_slices("ImageJ=1.53t\nunit=mm\nspacing=1.1\ncf=0\nc0=-32768\nc1=1\n", 32768);
  EXPECT_LT((geometry("slices").point({1, 1, 1}) - Vector3(0.05, 0.1, 1.1)).norm(), 1e-7);
  expect_made("slices");
  write_slices("ImageJ=1.53t\n", 0);
  EXPECT_FALSE(geometry("slices").has_size);
  // Another unit, shift or resolution of one slice.
  write_slices("ImageJ=1.53t\nunit=mm\n", 0);
  for (const char* other : {"unit=um\n", "unit=mm\nspacing=1.1\n", "unit=mm\n"}) {
    slice.text = std::string("ImageJ=1.53t\n") + other;
    if (std::string(other) == "unit=mm\n") slice.resolution = 30.0;
    write_tiff(path("slices/s1.tif"), slice, {page(1)});
    EXPECT_FALSE(geometry("slices").has_size) << other;
    EXPECT_TRUE(holds(notes("slices")[0], "s1.tif\" says another size of voxels"));
  }
  slice.text = "ImageJ=1.53t\nunit=mm\ncf=0\nc0=-32768\nc1=1\n";
  write_tiff(path("slices/s2.tif"), slice, {page(2)});
  expect_refused("slices", {"s2.tif", "another calibration"});
}

TEST_F(TiffVolume, TakesOmesSizesAndOrderOfSlicesInAFolder) {
  fs::create_directory(folder_ / "slices");
  const auto write_slices = [&](const std::array<int, 3>& places, const std::string& last_z,
                                const std::string& last_where = "") {
    for (int z = 0; z < 3; ++z) {
      TiffPages slice = as();
      slice.text =
          "<?xml version=\"1.0\"?><OME><Image><Pixels DimensionOrder=\"XYZCT\" SizeC=\"1\" "
          "PhysicalSizeX=\"0.5\" PhysicalSizeY=\"0.25\" PhysicalSizeZ=\"" +
          (z == 2 ? last_z : "2") + "\" PhysicalSizeXUnit=\"mm\" PhysicalSizeYUnit=\"mm\" " +
          "PhysicalSizeZUnit=\"mm\" SizeZ=\"3\">";
      for (std::size_t k = 0; k < 3; ++k) {
        slice.text += "<TiffData FirstZ=\"" + std::to_string(places[k]) + "\" " +
                      (k == 2 ? last_where : "") + "><UUID FileName=\"s" + std::to_string(k) +
                      ".ome.tif\">urn</UUID></TiffData>";
      }
      slice.text += "</Pixels></Image></OME>";
      write_tiff(path("slices/s" + std::to_string(z) + ".ome.tif"), slice, {page(z)});
    }
  };
  write_slices({0, 1, 2}, "2");
  expect_made("slices");
  EXPECT_EQ(geometry("slices").unit, "mm");
  EXPECT_LT((geometry("slices").point({1, 1, 1}) - Vector3(0.5, 0.25, 2.0)).norm(), 1e-7);
  EXPECT_TRUE(notes("slices").empty());
  write_slices({0, 1, 2}, "1");
  EXPECT_FALSE(geometry("slices").has_size);
  write_slices({0, 2, 1}, "2");
  expect_refused("slices", {"s2.ome.tif", "is the slice 2 by OME's text", "Rename the files"});
  write_slices({0, 1, 1}, "2", "FirstC=\"1\"");
  expect_refused("slices", {"s2.ome.tif", "of another channel"});
}

TEST_F(TiffVolume, TakesAResolutionThatIsOfNoPrinter) {
  TiffPages stack = as();
  stack.resolution = 2000.0;
  stack.resolution_unit = RESUNIT_CENTIMETER;  // 0.005 mm along x
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_EQ(geometry("a.tif").unit, "mm");
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(0.005, 0.01, 0.005)).norm(), 1e-9);
  EXPECT_TRUE(holds(notes("a.tif").at(0), "resolution"));
  VolumeChoice choice;
  choice.voxel_size = Vector3(1, 2, 4);
  EXPECT_TRUE(open_volume(path("a.tif"), choice)->notes().empty());
  // A text that gives only the shape takes no size away.
  stack.text = R"({"shape": [3, 5, 7]})";
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_EQ(geometry("a.tif").unit, "mm");
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(0.005, 0.01, 0.005)).norm(), 1e-9);
  stack.text = R"({"shape": [3, 5, 7], "spacing": 0.25, "unit": "um"})";
  stack.resolution = 20.0;
  stack.resolution_unit = RESUNIT_NONE;
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_EQ(geometry("a.tif").unit, "um");
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(0.05, 0.1, 0.25)).norm(), 1e-7);
  stack.text = "";
  stack.resolution_unit = RESUNIT_INCH;
  for (const double paper : {72.0, 300.0, 600.0, 1200.0, 2400.0}) {
    stack.resolution = paper;
    write_tiff(path("a.tif"), stack, pages());
    EXPECT_FALSE(geometry("a.tif").has_size) << paper;
  }
}

// All orders that OME has, pages in their order and not.
TEST_F(TiffVolume, ReadsOmeInEveryOrderOfDimensions) {
  std::string order = "CTZ";
  int orders = 0;
  do {
    SCOPED_TRACE(order);
    const auto count_of = [](char letter) { return letter == 'Z' ? 3 : letter == 'C' ? 2 : 4; };
    std::vector<std::string> planes;
    std::vector<std::string> where;
    for (int c = 0; c < count_of(order[2]); ++c) {
      for (int b = 0; b < count_of(order[1]); ++b) {
        for (int a = 0; a < count_of(order[0]); ++a) {
          const int at[3] = {a, b, c};
          const auto place = [&](char letter) { return at[order.find(letter)]; };
          planes.push_back(
              page(place('Z'), static_cast<std::uint32_t>(1000 * place('T') + 200 * place('C'))));
          where.push_back("FirstZ=\"" + std::to_string(place('Z')) + "\" FirstC=\"" +
                          std::to_string(place('C')) + "\" FirstT=\"" + std::to_string(place('T')) +
                          "\"");
        }
      }
    }
    const std::string head =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><OME xmlns=\"o\"><Image ID=\"Image:0\">"
        "<Pixels DimensionOrder=\"XY" +
        order +
        "\" SizeX=\"7\" SizeY=\"5\" SizeZ=\"3\" SizeC=\"2\" SizeT=\"4\" PhysicalSizeX=\"0.5\" "
        "PhysicalSizeXUnit=\"mm\" PhysicalSizeY=\"0.25\" PhysicalSizeYUnit=\"mm\" "
        "PhysicalSizeZ=\"2000\" PhysicalSizeZUnit=\"\xc2\xb5m\" Type=\"uint16\">";
    const std::string end = "</Pixels></Image></OME>";
    // Backwards in the file, each page named; as Bio-Formats names them.
    std::string parts;
    std::vector<std::string> backwards(planes.rbegin(), planes.rend());
    for (std::size_t k = 0; k < planes.size(); ++k) {
      parts += "<TiffData IFD=\"" + std::to_string(planes.size() - 1 - k) + "\" " + where[k] +
               " PlaneCount=\"1\"><UUID FileName=\"x.ome.tif\">u</UUID></TiffData>";
    }
    const std::vector<std::pair<std::string, const std::vector<std::string>*>> forms = {
        {"<TiffData IFD=\"0\" PlaneCount=\"24\"/>", &planes},
        {"<TiffData/>", &planes},
        {"", &planes},
        {parts, &backwards}};
    for (const auto& [tags, written] : forms) {
      TiffPages stack = as();
      stack.text = head + tags + end;
      stack.resolution = 1.0;  // of no meaning beside the text's, as tifffile writes it
      stack.resolution_unit = RESUNIT_NONE;
      write_tiff(path("a.ome.tif"), stack, *written);
      expect_refused("a.ome.tif", {"2 channels"});
      VolumeChoice choice = channel(2);
      choice.frame = 4;
      EXPECT_EQ(labels_of("a.ome.tif", choice), labels(3200)) << tags;
      const VolumeGeometry read = geometry("a.ome.tif", choice);
      EXPECT_EQ(read.unit, "mm");
      EXPECT_LT((read.point({1, 1, 1}) - Vector3(0.5, 0.25, 2.0)).norm(), 1e-12);
      EXPECT_LT(read.corner.norm(), 1e-15);
    }
    ++orders;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(orders, 6);
}

TEST_F(TiffVolume, RefusesOmesTextThatFitsNoPages) {
  const auto text = [](const std::string& attributes, const std::string& more) {
    return "<OME><Image><Pixels DimensionOrder=\"XYZCT\" SizeZ=\"3\" " + attributes + ">" + more +
           "</Pixels></Image></OME>";
  };
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {text("SizeC=\"2\"", ""), "3 pages, but OME's text has 6"},
      {text("SizeC=\"x\"", ""), "SizeC"},
      {text("SizeC=\"0\"", ""), "SizeC"},
      {text("", "<TiffData IFD=\"1\" PlaneCount=\"3\"/>"), "outside"},
      {text("", "<TiffData IFD=\"0\" FirstZ=\"1\" PlaneCount=\"2\"/>"), "lacks planes"},
      {text("",
            "<TiffData IFD=\"0\" PlaneCount=\"2\"><UUID FileName=\"a\"/></TiffData><TiffData "
            "IFD=\"0\" FirstZ=\"2\"><UUID FileName=\"b\"/></TiffData>"),
       "several files"},
      {text("PhysicalSizeX=\"-1\"", ""), "PhysicalSizeX"},
      {text("PhysicalSizeX=\"1\" PhysicalSizeXUnit=\"furlong\" PhysicalSizeY=\"1\"", ""),
       "furlong"},
      {"<OME><Image><Pixels SizeZ=\"3\"/><Pixels SizeZ=\"3\"/></Image></OME>", "2 images"},
      {"<OME><Image><Pixels DimensionOrder=\"XYZZT\" SizeZ=\"3\"/></Image></OME>", "order"},
      {"<OME><Image><Pixels SizeZ=\"3\"/></Image>", "damaged"},
      {"<OME></OME>", "without Pixels"}};
  for (const auto& [xml, word] : wrong) {
    SCOPED_TRACE(xml);
    TiffPages stack = as();
    stack.text = xml;
    expect_refused_of(stack, pages(), {word});
  }
  TiffPages stack = as();
  stack.text = text("PhysicalSizeX=\"2\" PhysicalSizeY=\"3\"", "");
  expect_made_of(stack, pages());
  EXPECT_EQ(geometry("a.tif").unit, "um");
  EXPECT_LT((geometry("a.tif").point({1, 1, 1}) - Vector3(2, 3, 2)).norm(), 1e-12);
  EXPECT_TRUE(holds(notes("a.tif").at(0), "PhysicalSizeZ"));
}

TEST_F(TiffVolume, ReadsTheOnlyVolumeOfOmesImages) {
  TiffPages stack = as();
  const auto text = [](const std::string& slices) {
    return "<OME><Image Name=\"label\"><Pixels SizeZ=\"1\"><TiffData IFD=\"0\"/></Pixels></Image>"
           "<Image Name=\"sand\"><Pixels SizeZ=\"3\"><TiffData IFD=\"1\" "
           "PlaneCount=\"3\"/></Pixels></Image><Image Name=\"macro\"><Pixels SizeZ=\"" +
           slices + "\"><TiffData IFD=\"4\"/></Pixels></Image></OME>";
  };
  stack.text = text("1");
  expect_made_of(stack, {page(2), page(0), page(1), page(2), page(1)});
  EXPECT_TRUE(holds(notes("a.tif")[0], "Left out: the images of one slice"));
  stack.text = text("2");
  expect_refused_of(stack, pages(),
                    {"3 images", "\"sand\" of 3 slices", "\"macro\" of 2 slices", "series=0"});
}

TEST_F(TiffVolume, ReadsTheShapeThatTifffileWrites) {
  std::vector<std::string> all = pages(200);
  for (const std::string& one : pages(400)) all.push_back(one);
  TiffPages stack = as();
  stack.text = R"({"shape": [2, 3, 5, 7]})";
  expect_refused_of(stack, all, {"2 frames", "--select time=1"});
  EXPECT_EQ(labels_of("a.tif", frame(2)), labels(400));
  stack.text = R"({"shape": [2, 3, 5, 7], "axes": "CZYX"})";
  write_tiff(path("a.tif"), stack, all);
  EXPECT_EQ(labels_of("a.tif", channel(1)), labels(200));
  stack.text = R"({"shape": [3, 2, 5, 7], "axes": "ZCYX"})";
  write_tiff(path("a.tif"), stack, {all[0], all[3], all[1], all[4], all[2], all[5]});
  EXPECT_EQ(labels_of("a.tif", channel(2)), labels(400));
  stack.text = R"({"shape": [2, 4, 5, 7]})";
  expect_refused_of(stack, all, {"6 pages", "2 x 4 x 5 x 7"}, frame(1));
  for (const char* wrong :
       {R"({"shape": [-6, 5, 7]})", R"({"shape": [7]})", R"({"shape": [6, 5, 7], "axes": "ZY"})"}) {
    stack.text = wrong;
    expect_refused_of(stack, all, {"shape"});
  }
  stack.text = R"({"shape": [3, 5, 7]})";
  expect_made_of(stack, pages());
  // To choose one of the frames would lead to one image.
  for (const char* axes : {"TYX", "CYX"}) {
    stack.text = std::string(R"({"shape": [3, 5, 7], "axes": ")") + axes + "\"}";
    expect_refused_of(stack, pages(), {"one slice", "3 pages are channels or frames", "ZYX"});
  }
}

// A raw file that was imported in the wrong order, and saved.
TEST_F(TiffVolume, DoubtsTheByteOrder) {
  make({30, 20, 9});
  for (std::size_t k = 0; k < made_.labels.size(); ++k) {
    made_.labels[k] = static_cast<Label>((k % 30 < 14 ? 9000 : 21000) + k * 7919 % 1009);
  }
  for (const bool is_swapped : {false, true}) {
    if (is_swapped) {
      for (Label& label : made_.labels) label = (label & 0xffU) << 8U | label >> 8U;
    }
    write_tiff(path("a.tif"), as(), pages());
    const auto volume = open_volume(path("a.tif"));
    const std::size_t before = volume->warnings().size();
    all_of(*volume);
    EXPECT_EQ(volume->warnings().size() - before, is_swapped ? 1U : 0U);
    const auto grey = open_volume(path("a.tif"));
    grey->read_grey_values();
    const std::string told = test::refusal(ErrorCode::InputOutput, [&] { all_of(*grey); });
    EXPECT_EQ(told.find("Import the raw numbers") != std::string::npos, is_swapped) << told;
  }
}

TEST_F(TiffVolume, RefusesChannelsBetweenSlicesAndRows) {
  make({9, 8, 7});
  TiffPages stack = as();
  std::vector<std::string> all;
  for (int z = 0; z < 7; ++z) all.insert(all.end(), 3, page(z));
  stack.text = R"({"shape": [7, 3, 8, 9]})";
  expect_refused_of(stack, all, {"7 x 3 x 8 x 9", "array[:, 0]"});
  expect_refused("a.tif", {"array[:, 0]"}, frame(1));
  stack.text = R"({"shape": [7, 3, 8, 9], "axes": "ZCYX"})";
  expect_made_of(stack, all, channel(2));
}

TEST_F(TiffVolume, ReadsTheChosenNumberOfAVoxel) {
  TiffPages stack = as();
  stack.samples = 3;
  stack.bits = 8;
  stack.photometric = PHOTOMETRIC_RGB;
  for (const bool is_planar : {false, true}) {
    stack.is_planar = is_planar;
    std::vector<std::string> all;
    for (const std::string& one : pages_of<std::uint8_t>()) {
      std::string mixed;
      for (std::size_t k = 0; k < 3 * one.size(); ++k) {
        const std::size_t sample = is_planar ? k / one.size() : k % 3;
        mixed += static_cast<char>(one[is_planar ? k % one.size() : k / 3] + 60 * sample);
      }
      all.push_back(mixed);
    }
    // tifffile notes the planes as a dimension, which are no slices.
    stack.text = is_planar ? R"({"shape": [3, 3, 5, 7]})" : "";
    expect_refused_of(stack, all, {"picture in colours"});
    expect_made("a.tif", channel(1));
    EXPECT_EQ(labels_of("a.tif", channel(3)), labels(120)) << is_planar;
  }
}

template <class Value>
std::string bytes_of_float(const std::vector<std::uint32_t>& labels, Value last) {
  std::vector<Value> values(labels.begin(), labels.end());
  values.back() = last;
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

// As on a network's disk that goes away.
TEST_F(TiffVolume, ThatIsCutWhileItIsReadIsRefused) {
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW}) {
    TiffPages stack = as();
    stack.compression = compression;
    write_tiff(path("a.tif"), stack, pages());
    const auto volume = open_volume(path("a.tif"));
    volume->rewind();
    volume->next_row();
    std::filesystem::resize_file(path("a.tif"), 0);
    const int rows = made_.counts[1] * made_.counts[2];
    const auto read_on = [&] {
      for (int row = 1; row < rows; ++row) volume->next_row();
    };
    EXPECT_ERROR(read_on(), InputOutput);
  }
}

// MorphoLibJ's watershed, and every user of NumPy.
TEST_F(TiffVolume, TakesFloatsThatAreWholeForLabels) {
  const auto cut = [](const std::string& bytes) {
    std::vector<std::string> all;
    for (std::size_t z = 0; z < 3; ++z) {
      all.push_back(bytes.substr(z * bytes.size() / 3, bytes.size() / 3));
    }
    return all;
  };
  TiffPages stack = as();
  stack.format = SAMPLEFORMAT_IEEEFP;
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW}) {
    stack.compression = compression;
    for (const char* mode : {"wl", "wb"}) {
      stack.mode = mode;
      stack.bits = 32;
      expect_made_of(stack, cut(bytes_of_float<float>(made_.labels, 127.0F)));
      stack.bits = 64;
      expect_made_of(stack, cut(bytes_of_float<double>(made_.labels, 127.0)));
    }
  }
  made_.labels.back() = 4294967295U;
  expect_made_of(stack, cut(bytes_of_float<double>(made_.labels, 4294967295.0)));
  for (const double wrong : {0.5, -1.0, 4294967296.0, HUGE_VAL}) {
    write_tiff(path("a.tif"), stack, cut(bytes_of_float<double>(made_.labels, wrong)));
    // The first place, which is the last voxel here.
    expect_refused("a.tif", {"(6, 4, 2)", "whole numbers"});
  }
  std::string bytes = bytes_of_float<double>(made_.labels, 0.25);
  const double fraction = 2.75;
  std::copy_n(reinterpret_cast<const char*>(&fraction), 8, bytes.begin() + 8 * (35 + 2 * 7 + 3));
  expect_refused_of(stack, cut(bytes), {"2.75", "(3, 2, 1)"});
}

// MATLAB's logical, masks of other programs; rows end within bytes.
TEST_F(TiffVolume, ReadsNumbersOfFewerThanEightBits) {
  make({37, 21, 3});
  for (const int bits : {1, 2, 4}) {
    for (std::uint32_t& label : made_.labels) label &= (1U << bits) - 1U;
    made_.labels.back() = 1;
    std::vector<std::string> all;
    for (int z = 0; z < 3; ++z) {
      std::string one;
      for (int y = 0; y < 21; ++y) {
        std::string row(static_cast<std::size_t>((37 * bits + 7) / 8), '\0');
        for (int x = 0; x < 37; ++x) {
          const int place = x * bits;
          row[static_cast<std::size_t>(place / 8)] =
              static_cast<char>(row[static_cast<std::size_t>(place / 8)] |
                                static_cast<int>(made_.at(x, y, z)) << (8 - bits - place % 8));
        }
        one += row;
      }
      all.push_back(one);
    }
    TiffPages stack = as();
    stack.bits = bits;
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
      stack.compression = compression;
      for (const int tile : {0, 16}) {
        SCOPED_TRACE(std::to_string(bits) + " bits, tile " + std::to_string(tile));
        stack.tile = tile;
        expect_made_of(stack, all);
      }
    }
    stack.photometric = PHOTOMETRIC_MINISWHITE;
    expect_made_of(stack, all);
    EXPECT_NE(notes("a.tif").back().find("0 as white") == std::string::npos
                  ? notes("a.tif").front().find("0 as white")
                  : 0,
              std::string::npos);
  }
}

// As some writers pad the last strip of a page. Each page ends in more rows of background than the
// page before, whose labels must not appear in them.
TEST_F(TiffVolume, ReadsStripsThatArePaddedToWholeOnes) {
  make({37, 21, 3});
  for (int z = 0; z < 3; ++z) {
    const auto page = made_.labels.begin() + std::ptrdiff_t{37} * 21 * z;
    std::fill(page + std::ptrdiff_t{37} * (21 - 6 * z), page + std::ptrdiff_t{37} * 21, 0U);
  }
  TiffPages stack = as();
  stack.compression = COMPRESSION_ADOBE_DEFLATE;
  stack.pads = true;
  for (const int rows : {21, 32, 64}) {
    stack.rows = rows;
    expect_made_of(stack, pages());
  }
}

TEST_F(TiffVolume, RefusesWhatMakesNoLabels) {
  TiffPages stack = as();
  stack.bits = 8;
  stack.compression = COMPRESSION_JPEG;
  stack.rows = 16;
  expect_refused_of(stack, pages_of<std::uint8_t>(), {"JPEG"});
  stack = as();
  expect_refused_of(stack, {page(1)}, {"one image of 7 x 5"});
  stack.format = SAMPLEFORMAT_IEEEFP;
  expect_refused_of(stack, pages(), {"16 bits"});
}

// Folders from a Mac and from Windows, and what is odd in them is named.
TEST_F(TiffVolume, LeavesForeignFilesOutOfAFolderAndNamesTheOddSlice) {
  fs::create_directory(folder_ / "slices");
  for (int z = 0; z < 3; ++z) {
    write_tiff(path("slices/s" + std::to_string(8 + z) + ".tif"), as(), {page(z)});
  }
  expect_made("slices");
  EXPECT_EQ(notes("slices").size(), 1U);  // of the voxel size
  write("slices/._s9.tif", std::string("\0\5\x16\7", 4));
  write("slices/Thumbs.db", "x");
  write("slices/.DS_Store", "x");
  EXPECT_TRUE(is_volume(path("slices")));
  expect_made("slices");
  EXPECT_TRUE(holds(notes("slices").at(0), "\"._s9.tif\""));
  EXPECT_TRUE(holds(notes("slices").at(0), "\"Thumbs.db\""));
  write("slices/remarks.txt", "x");
  EXPECT_TRUE(holds(notes("slices").at(0), "and 1 more"));
  expect_refused("slices", {"1 channel, not a channel 2"}, channel(2));

  fs::rename(path("slices/s10.tif"), path("slices/s11.tif"));
  expect_made("slices");
  EXPECT_TRUE(holds(notes("slices").back(), "voxel size"));
  EXPECT_TRUE(holds(open_volume(path("slices"))->warnings().at(0).text(),
                    "between \"s9.tif\" and \"s11.tif\""));

  TiffPages odd = as();
  odd.height = 4;
  write_tiff(path("slices/s9.tif"), odd, {page(1).substr(0, 56)});
  expect_refused("slices", {"s9.tif", "7 x 4", "7 x 5"});
  odd = as();
  odd.bits = 8;
  write_tiff(path("slices/s9.tif"), odd, {pages_of<std::uint8_t>()[1]});
  expect_refused("slices", {"s9.tif", "8 bits"});
  write_tiff(path("slices/s9.tif"), as(), {page(0), page(1)});
  expect_refused("slices", {"s9.tif", "2 pages", "Save all slices in one file"});
  write("slices/s9.tif", "no TIFF");
  expect_refused("slices", {"s9.tif"});
  fs::remove(path("slices/s9.tif"));
  write_png("slices/s9.png", 1, 16, PNG_COLOR_TYPE_GRAY);
  expect_refused("slices", {"2 .tif, 1 .png"});
  for (const char* name : {"slices/s8.tif", "slices/s11.tif", "slices/s9.png"}) {
    fs::remove(path(name));
  }
  expect_refused("slices", {"no .tif, .png or .bmp"});
  write("slices/grain.ply", "ply\n");
  expect_refused("slices", {"folder of meshes", "wscvt batch FOLDER"});
}

TEST_F(TiffVolume, ReadsFoldersOfPngs) {
  fs::create_directory(folder_ / "slices");
  for (const bool is_interlaced : {false, true}) {
    for (const int color : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_PALETTE}) {
      for (const int bits : {1, 2, 4, 8, 16}) {
        if (color == PNG_COLOR_TYPE_PALETTE && bits == 16) continue;
        SCOPED_TRACE(bits);
        for (int z = 0; z < 3; ++z) {
          write_png("slices/s" + std::to_string(9 + z) + ".png", z, bits, color, is_interlaced);
        }
        std::vector<Label> wanted = made_.labels;
        for (Label& label : wanted) label &= bits == 16 ? 0xffffU : (1U << bits) - 1U;
        EXPECT_EQ(labels_of("slices"), wanted);
      }
    }
  }
  for (int z = 0; z < 3; ++z) {
    write_png("slices/s" + std::to_string(9 + z) + ".png", z, 16, PNG_COLOR_TYPE_RGB);
  }
  expect_refused("slices", {"picture in colours"});
  EXPECT_EQ(labels_of("slices", channel(3)), labels(6));
  expect_refused("slices/s9.png", {"one image of 7 x 5"}, channel(1));
  write_png("slices/s10.png", 1, 16, PNG_COLOR_TYPE_RGB, false, 6);
  expect_refused("slices", {"s10.png", "7 x 6"});
  write_png("slices/s10.png", 1, 16, PNG_COLOR_TYPE_RGB);
  const std::uintmax_t size = fs::file_size(path("slices/s10.png"));
  for (std::uintmax_t left = size - 30; left > 0; left /= 2) {
    fs::resize_file(path("slices/s10.png"), left);
    expect_refused("slices", {"s10.png"}, channel(1));
  }
}

// ImageJ, and tifffile with imagej=True, write 16 bits with a sign without it, 32768 higher.
TEST_F(TiffVolume, AppliesTheShiftThatImageJNotes) {
  TiffPages stack = as();
  stack.text = "ImageJ=1.53t\nimages=3\nslices=3\ncf=0\nc0=-32768.0\nc1=1.0\n";
  expect_made_of(stack, pages(32768));
  EXPECT_TRUE(holds(notes("a.tif")[0], "-32768"));
  const std::unique_ptr<LabelVolume> grey = open_volume(path("a.tif"));
  grey->read_grey_values();
  EXPECT_EQ(grey_value(grey->next_row()[3]), static_cast<float>(made_.labels[3]));
  stack.text = "ImageJ=1.53t\nimages=3\nslices=3\nc0=-32768.0\nc1=1.0\n";  // cf is then 0
  expect_made_of(stack, pages(32768));
  // A calibration that is no shift is told, and left.
  stack.text = "ImageJ=1.53t\nimages=3\nslices=3\ncf=0\nc0=3\nc1=0.5\n";
  expect_made_of(stack, pages());
  EXPECT_TRUE(holds(notes("a.tif")[0], "calibration"));
  stack.text = "ImageJ=1.53t\nimages=3\nslices=3\ncf=0\nc0=0\nc1=1\n";
  write_tiff(path("a.tif"), stack, pages());
  EXPECT_EQ(notes("a.tif").size(), 1U);
}

TEST_F(TiffVolume, TurnsPagesAsTheirOrientationTagSays) {
  // Where the first row and the first column lie: TIFF 6.0, Orientation.
  for (int orientation = 1; orientation <= 8; ++orientation) {
    SCOPED_TRACE(orientation);
    TiffPages stack = as();
    stack.orientation = orientation;
    write_tiff(path("a.tif"), stack, pages());
    const Vector3 found = geometry("a.tif").point({1.5, 2.5, 0.5});
    const bool is_transposed = orientation > 4;
    const bool is_from_right =
        orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool is_from_below =
        orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    Vector3 wanted(is_transposed ? 2.5 : 1.5, is_transposed ? 1.5 : 2.5, 0.5);
    if (is_from_right) wanted.x() = (is_transposed ? 5 : 7) - wanted.x();
    if (is_from_below) wanted.y() = (is_transposed ? 7 : 5) - wanted.y();
    EXPECT_LT((found - wanted).norm(), 1e-14) << found.transpose();
    EXPECT_EQ(notes("a.tif").size(), orientation == 1 ? 1U : 2U);
  }
}

TEST_F(TiffVolume, ReadsShapesThatEndInOneAndPagesThatWereWrittenOneByOne) {
  TiffPages stack = as();
  for (const char* text :
       {R"({"shape": [3, 5, 7, 1]})", R"({"shape": [1, 3, 5, 7, 1, 1]})", R"({"shape": [5, 7]})",
        R"({"shape": [1, 5, 7]})", "ImageJ=1.11a\nimages=1\n"}) {
    stack.text = text;
    expect_made_of(stack, pages());
  }
}

TEST_F(TiffVolume, TakesThreeEqualColoursForOneNumber) {
  TiffPages stack = as();
  stack.samples = 3;
  stack.bits = 8;
  stack.photometric = PHOTOMETRIC_RGB;
  std::vector<std::string> all;
  std::vector<std::string> planes;
  for (const std::string& one : pages_of<std::uint8_t>()) {
    std::string three;
    for (const char c : one) three += std::string(3, c);
    all.push_back(three);
    planes.push_back(one + one + one);
  }
  expect_made_of(stack, all);
  stack.is_planar = true;
  expect_made_of(stack, planes);
  ++planes.back().back();
  expect_refused_of(stack, planes, {"picture in colours"});
}

// It writes the resolution that its caller gave as per inch, and the caller's text beside it.
TEST_F(TiffVolume, ReadsTheResolutionBesideTifffilesSpacing) {
  const auto expect_size = [&](double resolution, int unit, const std::string& text,
                               const Vector3& size, const std::string& unit_read) {
    SCOPED_TRACE(text + std::to_string(resolution));
    TiffPages stack = as();  // the resolution along y is half of that along x
    stack.resolution = resolution;
    stack.resolution_unit = unit;
    stack.text = R"({"shape": [3, 5, 7], "axes": "ZYX", "spacing": )" + text + "}";
    expect_made_of(stack, pages());
    const VolumeGeometry read = geometry("a.tif");
    EXPECT_LT((read.point({1, 1, 1}) - read.corner - size).norm(), 1e-6 * size.norm());
    EXPECT_EQ(read.unit, unit_read);
  };
  const std::string um = R"(0.8, "unit": "um")";
  expect_size(2.0, RESUNIT_INCH, um, {0.5, 1.0, 0.8}, "um");
  expect_size(2.0, RESUNIT_NONE, um, {0.5, 1.0, 0.8}, "um");
  expect_size(20000.0, RESUNIT_CENTIMETER, um, {0.5, 1.0, 0.8}, "um");
  expect_size(50800.0, RESUNIT_INCH, um, {0.5, 1.0, 0.8}, "um");
  expect_size(2000.0, RESUNIT_INCH, R"(0.0008, "unit": "mm")", {5e-4, 1e-3, 8e-4}, "mm");
  expect_size(20000.0, RESUNIT_CENTIMETER, R"(0.0008, "unit": "mm")", {5e-4, 1e-3, 8e-4}, "mm");
  expect_size(2.0, RESUNIT_INCH, "0.8", {0.5, 1.0, 0.8}, "");
}

TEST_F(TiffVolume, DropsAScreensResolutionThatContradictsTheSlices) {
  for (const auto& [unit, dots] : std::vector<std::pair<std::string, double>>{
           {"inch", 72.0}, {"inch", 96.0}, {"inch", 300.0}, {"cm", 72.0 / 2.54}}) {
    SCOPED_TRACE(unit + std::to_string(dots));
    TiffPages stack = as();
    stack.resolution = dots;
    stack.resolution_unit = RESUNIT_NONE;
    stack.text = "ImageJ=1.53\nimages=3\nslices=3\nspacing=1\nunit=" + unit + "\n";
    write_tiff(path("a.tif"), stack, pages());
    EXPECT_FALSE(geometry("a.tif").has_size);
    EXPECT_TRUE(holds(notes("a.tif")[0], "of a screen"));
  }
  // Other voxels that are longer than five to one are taken, with a warning.
  TiffPages stack = as();
  stack.resolution = 10.0;
  stack.text = "ImageJ=1.53\nimages=3\nslices=3\nspacing=1.2\nunit=um\n";
  write_tiff(path("a.tif"), stack, pages());
  const std::unique_ptr<LabelVolume> volume = open_volume(path("a.tif"));
  ASSERT_EQ(volume->warnings().size(), 1U);
  EXPECT_TRUE(holds(volume->warnings()[0].text(), "12 times"));
  EXPECT_EQ(volume->description(), "7 x 5 x 3 voxels of 0.1 x 0.2 x 1.2 um, from ImageJ's text.");
}

TEST_F(TiffVolume, NamesTwoSeriesInAFolderAndLeavesAPreviewOut) {
  fs::create_directory(folder_ / "slices");
  const auto write_slices = [&](const std::string& before, const std::string& behind) {
    for (int z = 0; z < 3; ++z) {
      write_tiff(path("slices/" + before + std::to_string(8 + z) + behind + ".tif"), as(),
                 {page(z)});
    }
  };
  write_slices("rec", "");
  for (const char* odd : {"preview", "rec0_mip", "s9"}) {
    const std::string name = "slices/" + std::string(odd) + ".tif";
    write_tiff(path(name), as(), {page(1)});
    expect_made("slices");
    EXPECT_TRUE(holds(notes("slices")[0], odd));
    fs::remove(path(name));
  }
  for (const auto& [before, behind] : std::vector<std::pair<std::string, std::string>>{
           {"rec", "_mask"}, {"mask", ""}, {"rec", "_mask2"}, {"scan2_", ""}}) {
    write_slices(before, behind);
    expect_refused("slices", {"more than one series", "rec8.tif", before + "8" + behind});
    for (int z = 8; z < 11; ++z) {
      fs::remove(path("slices/" + before + std::to_string(z) + behind + ".tif"));
    }
  }
  // Two numbers in each name, of which one tells the series; or which count together.
  for (int z = 8; z < 11; ++z) fs::remove(path("slices/rec" + std::to_string(z) + ".tif"));
  write_slices("scan1_", "");
  expect_made("slices");
  write_slices("scan2_", "");
  expect_refused("slices", {"scan1_8.tif", "scan2_8.tif"});
}

TEST_F(TiffVolume, RefusesTwoSlicesOfOneNumber) {
  fs::create_directory(folder_ / "slices");
  for (int z = 0; z < 3; ++z) {
    write_tiff(path("slices/s00" + std::to_string(z) + ".tif"), as(), {page(z)});
  }
  expect_made("slices");
  for (const char* again : {"s1", "S01", "s0001"}) {
    const std::string name = std::string(again) + ".tif";
    write_tiff(path("slices/" + name), as(), {page(1)});
    expect_refused("slices", {"number 1 twice", "s001.tif", name});
    fs::remove(path("slices/" + name));
  }
  expect_made("slices");
}

TEST_F(TiffVolume, ReadsSlicesOfBmp) {
  fs::create_directory(folder_ / "slices");
  const auto two = [](std::size_t number) { return test::four_bytes(number).substr(0, 2); };
  const auto write_bmp = [&](int z, int bits, bool is_from_above, int other) {
    const std::string voxels = made_.bytes<std::uint8_t>();
    std::string rows;
    for (int y = 0; y < 5; ++y) {
      const int from = is_from_above ? y : 4 - y;
      std::string row;
      for (int x = 0; x < 7; ++x) {
        const char value = voxels[static_cast<std::size_t>((z * 5 + from) * 7 + x)];
        row += std::string(static_cast<std::size_t>(bits / 8), value);
      }
      if (bits > 8) row[2] = static_cast<char>(row[2] + other);
      while (row.size() % 4 != 0) row += 'x';
      rows += row;
    }
    const std::size_t offset = 54 + (bits == 8 ? 1024 : 0);
    write("slices/rec" + std::to_string(8 + z) + ".bmp",
          "BM" + test::four_bytes(offset + rows.size()) + test::four_bytes(0) +
              test::four_bytes(offset) + test::four_bytes(40) + test::four_bytes(7) +
              test::four_bytes(is_from_above ? 0xfffffffbU : 5U) + two(1) +
              two(static_cast<std::size_t>(bits)) + std::string(24, '\0') +
              std::string(offset - 54, '\0') + rows);
  };
  for (const int bits : {8, 24, 32}) {
    for (const bool is_from_above : {false, true}) {
      for (int z = 0; z < 3; ++z) write_bmp(z, bits, is_from_above, 0);
      expect_made("slices");
    }
  }
  write_bmp(1, 32, false, 1);
  expect_refused("slices", {"picture in colours"});
  write_bmp(1, 8, false, 0);
  expect_refused("slices", {"rec9.bmp", "8 bits", "32 bits"});
  fs::resize_file(path("slices/rec8.bmp"), 100);
  expect_refused("slices", {"rec8.bmp"});
}

constexpr const char* whole_numbers = "whole numbers from 0 on, in their order";

// Capitals do not count, and what the sentences advise works.
TEST_F(TiffVolume, OrdersSlicesWhateverTheirCapitalsAndSaysWhyAFolderIsNoVolume) {
  const auto write_slices = [&](int count, const std::function<std::string(int)>& name) {
    fs::remove_all(path("slices"));
    fs::create_directories(path("slices/inner"));
    for (int z = 0; z < count; ++z) write_tiff(path("slices/" + name(z)), as(), {page(z % 3)});
  };
  write_slices(3, [](int z) { return (z % 2 == 0 ? "s" : "S") + std::to_string(z) + ".tif"; });
  expect_made("slices");
  write_slices(8, [](int z) { return "s" + std::to_string(z - 4) + ".tif"; });
  expect_refused("slices", {"more than one series", "s-1.tif", whole_numbers});
  write_slices(
      8, [](int z) { return "s" + std::to_string(z / 2) + (z % 2 == 0 ? ".0" : ".5") + ".tif"; });
  expect_refused("slices", {"more than one series", "s0.5.tif", whole_numbers});
  // Hexadecimal: the decimal ones among them have no gap.
  write_slices(20, [](int z) {
    return std::string("s") + (z < 16 ? "0" : "1") + "0123456789abcdef"[z % 16] + ".tif";
  });
  expect_refused("slices", {"more than one series", whole_numbers});
  write_slices(8, [](int z) { return std::to_string(z) + ".jpg"; });
  expect_refused("slices", {"8 .jpg files", "JPEG changes numbers"});
  write_slices(3, [](int z) { return "inner/" + std::to_string(z) + ".tif"; });
  expect_refused("slices", {"its folder \"inner\" has", "Give that folder"});
  expect_made("slices/inner");
}

TEST_F(TiffVolume, WarnsOfAMissingSliceAndTellsAVolumeInTwoParts) {
  make({5, 4, 8});
  fs::create_directory(folder_ / "slices");
  const auto file = [&](const std::string& before, int z) {
    return path("slices/" + before + std::to_string(10 + 2 * z) + ".tif");
  };
  for (int z = 0; z < 8; ++z) write_tiff(file("rec", z), as(), {page(z)});
  EXPECT_EQ(open_volume(path("slices"))->warnings().size(), 0U);
  fs::remove(file("rec", 3));
  const auto volume = open_volume(path("slices"));
  ASSERT_EQ(volume->warnings().size(), 1U);
  EXPECT_TRUE(holds(volume->warnings()[0].text(), "between \"rec14.tif\" and \"rec18.tif\""));
  for (int z = 4; z < 8; ++z) fs::rename(file("rec", z), file("upper", z));
  expect_refused("slices", {"more than one series", whole_numbers});
}

TEST_F(TiffVolume, RefusesTifffilesAxesWithXBeforeY) {
  TiffPages stack = as();
  for (const char* axes : {"ZYX", "QYX", "IYX", "TYX"}) {
    stack.text = R"({"shape": [3, 5, 7], "axes": ")" + std::string(axes) + "\"}";
    write_tiff(path("a.tif"), stack, pages());
    if (axes[0] != 'T') expect_made("a.tif");
  }
  for (const auto& [axes, turn] : std::vector<std::pair<std::string, std::string>>{
           {"ZXY", "0, 2, 1"}, {"XYZ", "2, 1, 0"}, {"YXZ", "2, 0, 1"}, {"YZX", "1, 0, 2"}}) {
    stack.text = R"({"shape": [3, 5, 7], "axes": ")" + axes + "\"}";
    expect_refused_of(stack, pages(), {axes, ".transpose(" + turn + ")", "\"axes\": \"ZYX\""});
  }
  // Channels behind x are pages of a few columns.
  stack.text = R"({"shape": [3, 2, 5, 7], "axes": "ZYXC"})";
  expect_refused_of(stack, pages(), {"ZYXC", ".transpose(3, 0, 1, 2)", "\"axes\": \"CZYX\""});
  stack.text = R"({"shape": [1, 3, 5, 7], "axes": "TZXY"})";
  expect_refused_of(stack, pages(), {"TZXY", ".transpose(0, 2, 1)", "\"axes\": \"ZYX\""});
}

}  // namespace
}  // namespace wscvt
