// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/tiff_layout.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

using Json = nlohmann::json;

std::int64_t product_of(const std::vector<VolumeAxis>& axes) {
  std::int64_t product = 1;
  for (const VolumeAxis& axis : axes) product *= axis.count;
  return product;
}

/// ImageJ's text of a stack: lines of "key=value".
class ImageJText {
 public:
  explicit ImageJText(const std::string& text) : text_("\n" + text) {}

  /// Returns a value; empty if there is none.
  std::string value(const std::string& key) const {
    const std::size_t place = text_.find("\n" + key + "=");
    if (place == std::string::npos) return "";
    const std::size_t begin = place + key.size() + 2;
    return std::string(trimmed_of(text_.substr(begin, text_.find('\n', begin) - begin)));
  }

  std::int64_t count(const std::string& key) const {
    return std::clamp<std::int64_t>(whole_number_in(value(key)).value_or(1), 1, 1000000);
  }

 private:
  static std::string trimmed_of(std::string text) {
    while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.pop_back();
    return text;
  }

  std::string text_;
};

/// Reads the calibration of the numbers, a straight line c0 + c1 n if cf is 0. ImageJ stores 16
/// bits with a sign as numbers without one and c0=-32768.
void read_calibration(const ImageJText& text, TiffLayout& layout) {
  if (text.value("cf").empty()) return;
  const double least = number_in(text.value("c0")).value_or(0.0);
  const double slope = number_in(text.value("c1")).value_or(1.0);
  const bool is_shift = text.value("cf") == "0" && slope == 1.0 && least == std::floor(least) &&
                        std::abs(least) < 1e9;
  if (is_shift && least == 0.0) return;
  if (is_shift) {
    layout.offset = static_cast<std::int64_t>(least);
    layout.more_notes.push_back(
        "ImageJ's calibration was applied: " + std::to_string(layout.offset) +
        " was added to the file's numbers.");
  } else {
    layout.more_notes.emplace_back(
        "ImageJ noted a calibration of the grey values. The file's numbers were used without it.");
  }
}

/// Reads the unit. ImageJ notes another unit of y or z beside it.
void read_unit(const ImageJText& text, TiffLayout& layout) {
  layout.unit = unit_of(text.value("unit"));
  for (const char* key : {"yunit", "zunit"}) {
    const std::string other = unit_of(text.value(key));
    if (!other.empty() && other != layout.unit) layout.other_unit = other;
  }
}

TiffLayout layout_of_imagej(const std::string& description, std::int64_t pages,
                            std::int64_t samples, const std::string& path) {
  const ImageJText text(description);
  TiffLayout layout;
  layout.writer = "ImageJ";
  layout.samples = samples;
  layout.axes = {{AxisKind::Channel, text.count("channels")},
                 {AxisKind::Space, text.count("slices")},
                 {AxisKind::Frame, text.count("frames")}};
  // A page that was written by itself says that it is one image.
  const std::int64_t images = text.count("images") == 1 ? pages : text.count("images");
  const std::int64_t product = product_of(layout.axes);
  // A stack without dimensions has slices.
  if (product == 1) layout.axes = {{AxisKind::Space, images}};
  if (product != 1 && product != images) {
    refuse_volume(path, "has " + std::to_string(images) + " images, but ImageJ noted " +
                            std::to_string(layout.axes[0].count) + " channels of " +
                            std::to_string(layout.axes[1].count) + " slices in " +
                            std::to_string(layout.axes[2].count) +
                            " frames. Set them by Image > Properties, and save it again.");
  }
  if (product != 1 && layout.axes[1].count == 1) {
    refuse_volume(path, "has one slice: ImageJ noted that its " + std::to_string(images) +
                            " images are channels or frames. If they are slices, set them by "
                            "Image > Properties, and save it again.");
  }
  layout.may_be_one_block = pages == 1 && images > 1;
  if (!layout.may_be_one_block && images != pages) {
    refuse_volume(path, "has " + std::to_string(pages) + " pages, but ImageJ noted " +
                            std::to_string(images) + " images. Export it again.");
  }
  read_calibration(text, layout);
  read_unit(text, layout);
  // ImageJ omits a spacing of 1, and reads a missing spacing as 1.
  const std::optional<double> spacing = number_in(text.value("spacing"));
  if (layout.unit.empty() && !spacing) return layout;
  layout.voxel_size = Vector3::Constant(spacing ? std::abs(*spacing) : 1.0);
  if (!spacing) {
    layout.notes.push_back("ImageJ noted no distance of slices, which means 1 " + layout.unit +
                           ". Give another by " + mention("voxel-size", "X,Y,Z") + ".");
  }
  return layout;
}

}  // namespace

TiffLayout slice_layout(const std::string& description) {
  TiffLayout layout;
  if (description.rfind("ImageJ=", 0) != 0) return layout;
  const ImageJText text(description);
  read_calibration(text, layout);
  read_unit(text, layout);
  const std::optional<double> spacing = number_in(text.value("spacing"));
  if (spacing) layout.voxel_size = Vector3::Constant(std::abs(*spacing));
  if (spacing || !layout.unit.empty()) layout.writer = "ImageJ";
  return layout;
}

namespace {

/// Returns how many of the last dimensions belong to a page, its rows and columns, with its samples
/// beside them or before them, or behind dimensions of one; 0 if none fit.
std::size_t dimensions_of_page(const std::vector<std::int64_t>& counts, const TiffPageShape& page) {
  const std::size_t all = counts.size();
  const auto fits = [&](const std::vector<std::int64_t>& last) {
    return last.size() <= all && std::equal(last.rbegin(), last.rend(), counts.rbegin());
  };
  if (page.samples > 1) {
    const bool fits_page = fits({page.height, page.width, page.samples}) ||
                           fits({page.samples, page.height, page.width});
    return fits_page ? 3 : 0;
  }
  std::vector<std::int64_t> last = {page.height, page.width};
  for (; last.size() <= all; last.push_back(1)) {
    if (fits(last)) return last.size();
  }
  return 0;
}

/// Reads tifffile's text: {"shape": [2, 24, 28, 36], "axes": "CZYX"}; the last dimensions are the
/// page's.
TiffLayout layout_of_tifffile(const Json& json, std::int64_t pages, const TiffPageShape& page,
                              const std::string& path) {
  TiffLayout layout;
  layout.writer = "tifffile";
  layout.samples = page.samples;
  // Other keys are the caller's; these two are named as in ImageJ's text.
  if (json.contains("spacing") && json["spacing"].is_number()) {
    layout.voxel_size = Vector3::Constant(std::abs(json["spacing"].get<double>()));
    if (json.contains("unit") && json["unit"].is_string()) {
      layout.unit = unit_of(json["unit"].get<std::string>());
    }
  }
  const Json shape = json["shape"];
  std::vector<std::int64_t> counts;
  for (const Json& count : shape) {
    if (!count.is_number_integer() || count.get<std::int64_t>() < 1 ||
        count.get<std::int64_t>() > 1000000) {
      refuse_volume(path,
                    "has a \"shape\" in its text that is not of whole numbers. Export it "
                    "again.");
    }
    counts.push_back(count.get<std::int64_t>());
  }
  std::string letters;
  if (json.contains("axes") && json["axes"].is_string()) letters = json["axes"].get<std::string>();
  std::string text;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    text += (k == 0 ? "" : " x ") + std::to_string(counts[k]);
  }
  if (!letters.empty() && letters.size() != counts.size()) {
    refuse_volume(path, "has a \"shape\" in its text that fits no page. Export it again.");
  }
  const std::size_t of_page = dimensions_of_page(counts, page);
  if (of_page == 0) {
    refuse_volume(path, "has pages of " + std::to_string(page.height) + " x " +
                            std::to_string(page.width) +
                            " voxels, but the \"shape\" in its text, " + text +
                            ", does not end so. Export it again.");
  }
  const std::size_t slower = counts.size() - of_page;
  bool has_space = false;
  for (std::size_t k = slower; k-- > 0;) {
    const char letter = letters.empty() ? '?' : letters[k];
    VolumeAxis axis = {AxisKind::Frame, counts[k]};
    // Without letters, the dimension before the page's is the slices', except dimensions of one.
    if (letter == 'Z' || ((letter == '?' || letter == 'Q' || letter == 'I') && !has_space &&
                          (counts[k] > 1 || k == 0))) {
      axis.kind = AxisKind::Space;
    } else if (letter == 'C' || letter == 'S') {
      axis.kind = AxisKind::Channel;
    }
    has_space = has_space || axis.kind == AxisKind::Space;
    layout.axes.push_back(axis);
  }
  const std::int64_t product = product_of(layout.axes);
  if (product == 1 && pages > 1) {  // each page was written by itself, with its own text
    layout.axes = {{AxisKind::Space, pages}};
    return layout;
  }
  layout.may_be_one_block = pages == 1 && product > 1;
  if (product != pages && !layout.may_be_one_block) {
    refuse_volume(path, "has " + std::to_string(pages) + " pages, but its text gives " + text +
                            " voxels. If it holds several volumes, save the labels alone.");
  }
  return layout;
}

}  // namespace

TiffLayout tiff_layout(const std::string& text, std::int64_t pages, const TiffPageShape& page,
                       const std::string& path) {
  const std::int64_t samples = page.samples;
  if (text.rfind("ImageJ=", 0) == 0) return layout_of_imagej(text, pages, samples, path);
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first != std::string::npos && text[first] == '<' && text.find("<OME") != std::string::npos) {
    return layout_of_ome(text, pages, samples, path);
  }
  if (first != std::string::npos && text[first] == '{') {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_object() && json.contains("shape") && json["shape"].is_array()) {
      return layout_of_tifffile(json, pages, page, path);
    }
  }
  TiffLayout layout;
  layout.samples = samples;
  layout.axes = {{AxisKind::Space, pages}};
  return layout;
}

}  // namespace wscvt
