// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#ifdef WSCVT_HAS_TIFF
#include <filesystem>

#include "toolbox/volume/tiff_pages.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/text_fields.h"
#endif

namespace wscvt {

#ifdef WSCVT_HAS_TIFF

namespace {

/// Returns the positions of the slices of the selected channel and frame in a file of pages.
std::vector<SlicePage> slices_of(const TiffLayout& layout, const std::vector<std::uint32_t>& pages,
                                 std::int64_t channel, std::int64_t frame) {
  std::vector<SlicePage> slices;
  std::int64_t count = 1;
  for (const VolumeAxis& axis : layout.axes) {
    if (axis.kind == AxisKind::Space) count = axis.count;
  }
  for (std::int64_t z = 0; z < count; ++z) {
    std::int64_t plane = 0;
    std::int64_t step = 1;
    for (const VolumeAxis& axis : layout.axes) {
      if (axis.kind == AxisKind::Space) {
        plane += step * z;
      } else if (axis.count > 1) {
        plane += step * (axis.kind == AxisKind::Channel ? channel : frame);
      }
      step *= axis.count;
    }
    const auto place = static_cast<std::size_t>(plane);
    slices.push_back(
        {0, layout.pages.empty() ? pages[place] : static_cast<std::uint32_t>(layout.pages[place])});
  }
  return slices;
}

void add_notes(const TiffLayout& layout, const TiffPageList& pages, const TiffPage& page,
               const VolumeChoice& choice, LabelVolume& volume) {
  for (const std::string& note : layout.notes) {
    if (!choice.voxel_size) volume.add_note(note);
  }
  for (const std::string& note : layout.more_notes) volume.add_note(note);
  if (pages.left_out > 0) {
    volume.add_note(
        "Left out: " + format_count(static_cast<std::size_t>(pages.left_out), "reduced image") +
        " (preview, pyramid or mask).");
  }
  if (pages.marked > 0) {
    volume.add_warning(std::to_string(pages.marked) +
                       " of the pages are marked as reduced images, "
                       "but are as large as the others. They were read as slices.");
  }
  if (page.has_alpha) volume.add_note("Left out: the channel alpha, which is constant.");
}

/// Returns the channels in the voxels of a page. Three equal colours are one, and alpha is none.
VolumeAxis channels_of(const TiffPage& page) {
  return {AxisKind::Channel, page.shows_colours || page.has_alpha ? 1 : page.samples};
}

/// Returns the channels in a file's dimensions or in its voxels; refuses a file with both.
VolumeAxis channels_of(const TiffLayout& layout, const TiffPage& page, const std::string& path) {
  VolumeAxis channels = channels_of(page);
  for (const VolumeAxis& axis : layout.axes) {
    if (axis.kind != AxisKind::Channel || axis.count == 1) continue;
    if (channels.count > 1) {
      refuse_volume(path, "has " + std::to_string(axis.count) + " channels of " +
                              std::to_string(channels.count) +
                              " numbers per voxel. Save only one channel.");
    }
    channels.count = axis.count;
  }
  return channels;
}

std::unique_ptr<LabelVolume> volume_of_pages(const TiffFile& file, const TiffPageList& list,
                                             const TiffPage& page, const VolumeChoice& choice) {
  const std::string& path = file.path();
  const auto pages = static_cast<std::int64_t>(list.slices.size());
  TiffLayout layout = tiff_layout(
      list.text, pages, {page.width, page.height, page.samples, list.slices.back() + 1}, path);
  VolumeAxis frames = {AxisKind::Frame, 1};
  std::int64_t slices = 1;
  for (const VolumeAxis& axis : layout.axes) {
    if (axis.kind == AxisKind::Space) slices *= axis.count;
    if (axis.kind == AxisKind::Frame && axis.count > 1) {
      if (frames.count > 1) {
        refuse_volume(path, "has two dimensions besides space, of " + std::to_string(frames.count) +
                                " and " + std::to_string(axis.count) +
                                " places. Save only one volume.");
      }
      frames.count = axis.count;
    }
  }
  if (slices == 1 && pages > 1 && !layout.writer.empty()) {
    refuse_volume(path, "has one slice: " + layout.writer + "'s text says that its " +
                            std::to_string(pages) +
                            " pages are channels or frames. If they are slices, save it again with "
                            "the axes ZYX.");
  }
  // Each kind of dimension is selected once.
  const std::int64_t channel = chosen_place(channels_of(layout, page, path), choice, path);
  const std::int64_t frame = chosen_place(frames, choice, path);
  VolumeGeometry geometry;
  geometry.counts = voxel_counts({page.width, page.height, slices}, path);
  set_lattice_of_tiff(geometry, file, page, layout, choice);
  std::unique_ptr<LabelVolume> volume;
  if (layout.may_be_one_block) {
    // Above 4 GiB, ImageJ writes one page, then all voxels uncompressed.
    std::uint16_t compression = COMPRESSION_NONE;
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_COMPRESSION, &compression);
    std::uint64_t* offsets = nullptr;
    if (compression != COMPRESSION_NONE || TIFFIsTiled(file.get()) != 0 || page.bits < 8 ||
        page.samples > 1 || TIFFGetField(file.get(), TIFFTAG_STRIPOFFSETS, &offsets) == 0) {
      std::int64_t images = 1;
      for (const VolumeAxis& axis : layout.axes) images *= axis.count;
      file.fail("has one page of the " + std::to_string(images) + " that " + layout.writer +
                " noted");
    }
    VoxelType type = page.type;
    type.big_endian = TIFFIsBigEndian(file.get()) != 0;
    std::vector<VolumeAxis> axes = {{AxisKind::Space, page.width}, {AxisKind::Space, page.height}};
    axes.insert(axes.end(), layout.axes.begin(), layout.axes.end());
    VoxelData data;
    data.paths = {path};
    data.offset = offsets[0];
    data.picks = picks_of(axes, choice, path);
    volume = volume_of_files(geometry, type, data);
  } else {
    volume = volume_of_slices(geometry, page, channel, std::vector<std::string>{path},
                              slices_of(layout, list.slices, channel, frame));
  }
  volume->set_offset(layout.offset);
  add_notes(layout, list, page, choice, *volume);
  return volume;
}

/// Reads what the text of a slice, a file of its own, says of all.
TiffLayout layout_of_slice(const TiffFile& file, const TiffPageList& list) {
  TiffLayout layout = slice_layout(list.text, file.path());
  const std::optional<Vector3> resolution = voxel_of_resolution(file);
  if (layout.writer != "ImageJ" || layout.voxel_size.z() > 0.0 || !resolution) return layout;
  std::uint16_t unit = RESUNIT_INCH;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_RESOLUTIONUNIT, &unit);
  layout.voxel_size.z() = resolution->x() / (unit == RESUNIT_INCH ? 2.54 : 1.0);
  layout.notes.push_back(
      "ImageJ noted no distance of slices: along z as along x. Give another by " +
      mention("voxel-size", "X,Y,Z") + ".");
  return layout;
}

/// Keeps the size of the first slices' voxels if this slice, the file `path`, says the same.
/// Otherwise no size is known. Refuses another shift of the numbers.
void take_size_of_slice(const TiffLayout& slice, const std::optional<Vector3>& first_resolution,
                        const std::optional<Vector3>& resolution, const std::string& path,
                        TiffLayout& layout) {
  if (slice.offset != layout.offset) {
    refuse_volume(path,
                  "has another calibration of its numbers than the slices before it. Save "
                  "all slices alike.");
  }
  if (!layout.differing.empty()) return;
  const auto differ = [](const Vector3& a, const Vector3& b) {
    return (a - b).cwiseAbs().maxCoeff() > 1e-4 * b.cwiseAbs().maxCoeff();
  };
  const Vector3 none = Vector3::Zero();
  if (slice.writer == layout.writer && slice.unit == layout.unit &&
      !differ(slice.voxel_size, layout.voxel_size) &&
      !differ(resolution.value_or(none), first_resolution.value_or(none))) {
    return;
  }
  layout.differing = std::filesystem::path(path).filename().string();
}

std::unique_ptr<LabelVolume> volume_of_page_files(const SliceFiles& slices, const TiffFile& first,
                                                  const TiffPageList& list, const TiffPage& page,
                                                  const VolumeChoice& choice) {
  std::vector<SlicePage> pages;
  TiffPageList all;
  TiffLayout layout = layout_of_slice(first, list);
  const std::optional<Vector3> resolution = voxel_of_resolution(first);
  check_ome_slices(list.text, slices.paths);
  for (std::size_t k = 0; k < slices.paths.size(); ++k) {
    const TiffFile file(slices.paths[k]);
    const TiffPageList of_slice = list_pages(file);
    const std::size_t count = of_slice.slices.size();
    all.left_out += of_slice.left_out;
    if (count > 1) {
      refuse_volume(slices.paths[k],
                    "has " + std::to_string(count) +
                        " pages, but a folder is one volume, whose files are slices of "
                        "one page. Save all slices in one file, or one in each.");
    }
    const TiffPage here = page_of(file);
    if (!(here == page)) {
      refuse_volume(slices.paths[k], "is a slice of " + here.text() +
                                         ", but the slices before it have " + page.text() +
                                         ". Save all slices alike.");
    }
    take_size_of_slice(layout_of_slice(file, of_slice), resolution, voxel_of_resolution(file),
                       file.path(), layout);
    pages.push_back({k, of_slice.slices.front()});
  }
  const std::int64_t channel = chosen_place(channels_of(page), choice, slices.folder);
  chosen_place({AxisKind::Frame, 1}, choice, slices.folder);
  VolumeGeometry geometry;
  geometry.counts = voxel_counts({page.width, page.height, static_cast<std::int64_t>(pages.size())},
                                 slices.folder);
  set_lattice_of_tiff(geometry, first, page, layout, choice);
  std::unique_ptr<LabelVolume> volume =
      volume_of_slices(geometry, page, channel, slices.paths, std::move(pages));
  volume->set_offset(layout.offset);
  add_notes(layout, all, page, choice, *volume);
  return volume;
}

}  // namespace

std::unique_ptr<LabelVolume> open_tiff_slices(const SliceFiles& slices,
                                              const VolumeChoice& choice) {
  refuse_array_choice(choice, slices.folder);
  const TiffFile first(slices.paths.front());
  const TiffPageList list = list_pages(first);
  TiffPage page = page_of(first);
  page.shows_colours = page.shows_colours && !choice.channel;
  page.has_alpha = page.has_alpha && !choice.channel;
  std::unique_ptr<LabelVolume> volume =
      slices.paths.size() == 1 ? volume_of_pages(first, list, page, choice)
                               : volume_of_page_files(slices, first, list, page, choice);
  if (page.shows_0_as_white) {
    volume->add_note(
        "The TIFF shows 0 as white. Its numbers were used unchanged. This is correct if the space "
        "between the grains is white. Otherwise give " +
        mention("background") + ", or to segment it " + mention("dark") + ".");
  }
  return volume;
}

#else

std::unique_ptr<LabelVolume> open_tiff_slices(const SliceFiles& slices, const VolumeChoice&) {
  refuse_without(slices.folder, "libtiff", "libtiff-dev");
}

#endif

}  // namespace wscvt
