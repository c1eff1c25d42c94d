// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a scan of a packing of known grains, segments it with many settings, and says how many
// grains were found one to one and how far the volume is off; or draws the slices of the page.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "grains/packing.h"
#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/open_volume.h"
#include "toolbox/volume/segmentation_page.h"
#include "toolbox/volume/segmentation_steps.h"
#include "wscvt/base/output_file.h"

namespace {

using wscvt::test::PackedGrain;
using wscvt::test::PackedVoxels;

/// The scan as a file in an NRRD of 16 bits.
void write_scan(const std::string& path, const PackedVoxels& voxels,
                const std::vector<std::uint32_t>& grey) {
  std::string text = "NRRD0004\ntype: uint16\nendian: little\nencoding: raw\ndimension: 3\nsizes:";
  for (const int count : voxels.counts) text += " " + std::to_string(count);
  text += "\nspacings:";
  for (const double length : voxels.spacing) text += " " + std::to_string(length * 0.012);
  text += "\nspace units: \"mm\" \"mm\" \"mm\"\n\n";
  for (const std::uint32_t value : grey) {
    text += static_cast<char>(value & 0xffU);
    text += static_cast<char>(value >> 8U);
  }
  wscvt::write_file(path, text);
}

/// How often each grey value is there once the scan is smoothed.
std::vector<std::uint64_t> smoothed_histogram(const std::vector<std::uint32_t>& grey,
                                              const PackedVoxels& voxels) {
  std::vector<std::uint64_t> counts(65536, 0);
  for (const std::uint16_t value :
       wscvt::median_of({grey.begin(), grey.end()}, voxels.counts, wscvt::Execution())) {
    ++counts[value];
  }
  return counts;
}

/// The slices of the page beside each other, as a PNG.
void write_picture(const std::string& path, const std::string& scan_path) {
  const std::unique_ptr<wscvt::LabelVolume> scan = wscvt::open_volume(scan_path);
  const wscvt::Segmentation found = wscvt::segment(*scan, {}, wscvt::Execution());
  const std::vector<wscvt::Picture> slices =
      wscvt::outlined_slices(*scan, found, wscvt::Execution()).pictures;
  constexpr int gap = 12;
  wscvt::Picture all;
  for (const wscvt::Picture& slice : slices) {
    all.width += slice.width + (all.width == 0 ? 0 : gap);
    all.height = std::max(all.height, slice.height);
  }
  all.pixels.assign(static_cast<std::size_t>(all.width) * all.height, {255, 255, 255});
  int left = 0;
  for (const wscvt::Picture& slice : slices) {
    for (int y = 0; y < slice.height; ++y) {
      std::copy_n(slice.pixels.begin() + static_cast<std::ptrdiff_t>(y) * slice.width, slice.width,
                  all.pixels.begin() + static_cast<std::ptrdiff_t>(y) * all.width + left);
    }
    left += slice.width + gap;
  }
  wscvt::write_file(path, wscvt::png_of(all));
}

void run(const std::string& path, const wscvt::test::PackingOptions& options,
         const wscvt::Vector3& spacing, const wscvt::test::GreyOptions& grey_options,
         const std::string& picture) {
  const std::vector<PackedGrain> grains = wscvt::test::packing(options);
  const PackedVoxels voxels = wscvt::test::voxels_of(grains, options.box, spacing);
  const std::vector<std::uint32_t> grey = wscvt::test::grey_values(voxels, grey_options);
  write_scan(path, voxels, grey);
  if (!picture.empty()) return write_picture(picture, path);
  const auto try_it = [&](const wscvt::SegmentationOptions& how, const std::string& what) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::unique_ptr<wscvt::LabelVolume> scan = wscvt::open_volume(path);
    const wscvt::Segmentation found = wscvt::segment(*scan, how, wscvt::Execution());
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    std::vector<std::uint32_t> labels;
    found.labels->rewind();
    for (int row = 0; row < voxels.counts[1] * voxels.counts[2]; ++row) {
      for (const wscvt::Label label : found.labels->next_row()) {
        labels.push_back(label > found.grains.size() ? 0 : label);
      }
    }
    const auto score = wscvt::test::found_in(labels, grains, voxels);
    std::printf("%-18s level %7.2f: %3zu of %zu one to one, %3zu labels, volume %+.2f %%, %.1f s\n",
                what.c_str(), found.threshold, score.one_to_one, grains.size(), score.labels,
                100.0 * score.volume_bias, seconds);
    std::fflush(stdout);
  };
  for (const double neck : {0.5, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9}) {
    wscvt::SegmentationOptions how;
    how.separate = neck;
    try_it(how, "--separate " + std::to_string(neck).substr(0, 4));
  }
  wscvt::SegmentationOptions how;
  how.threshold = wscvt::otsu_level(smoothed_histogram(grey, voxels));
  try_it(how, "Otsu");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Segments a packing of known grains.");
  std::string path = "packing.nrrd";
  std::string picture;
  wscvt::test::PackingOptions options;
  options.count = 200;
  options.smallest = 7.0;
  options.largest = 14.0;
  wscvt::test::GreyOptions grey;
  double width = 150.0;
  double height = 110.0;
  wscvt::Vector3 spacing = wscvt::Vector3::Ones();
  app.add_option("scan", path, "The scan that is made, .nrrd");
  app.add_option("--picture", picture, "Of the slices of the page, .png, in place of the table");
  app.add_option("--count", options.count, "Grains");
  app.add_option("--smallest", options.smallest, "Largest half axis of the smallest grain");
  app.add_option("--largest", options.largest, "Of the largest");
  app.add_option("--width", width, "Of the box");
  app.add_option("--height", height, "Of the box");
  app.add_option("--seed", options.seed, "Of the packing");
  app.add_option("--noise", grey.noise, "Of the contrast");
  app.add_option("--blur", grey.blur, "Standard deviation, in voxels");
  app.add_option("--x", spacing[0], "Length of a voxel");
  app.add_option("--y", spacing[1], "Length of a voxel");
  app.add_option("--z", spacing[2], "Length of a voxel");
  CLI11_PARSE(app, argc, argv);
  options.box = {width, width, height};
  try {
    run(path, options, spacing, grey, picture);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
