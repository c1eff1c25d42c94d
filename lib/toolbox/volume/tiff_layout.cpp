// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/tiff_layout.h"

#ifdef WSCVT_HAS_EXPAT
#include <expat.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/table_heading.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

using Json = nlohmann::json;

constexpr const char* blanks = " \t\r\n\xef\xbb\xbf";

bool is_ome(const std::string& text) {
  const std::size_t first = text.find_first_not_of(blanks);
  return first != std::string::npos && text[first] == '<' && text.find("<OME") != std::string::npos;
}

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
    return std::string(trimmed(text_.substr(begin, text_.find('\n', begin) - begin)));
  }

  std::int64_t count(const std::string& key) const {
    return std::clamp<std::int64_t>(whole_number_in(value(key)).value_or(1), 1, 1000000);
  }

 private:
  std::string text_;
};

/// Reads the calibration of the numbers, a straight line c0 + c1 n if cf is 0 or missing, as ImageJ
/// does. It stores 16 bits with a sign as numbers without one and c0=-32768.
void read_calibration(const ImageJText& text, TiffLayout& layout) {
  const std::string kind = text.value("cf");
  if (kind.empty() && text.value("c0").empty()) return;
  const double least = number_in(text.value("c0")).value_or(0.0);
  const double slope = number_in(text.value("c1")).value_or(1.0);
  const bool is_shift = (kind.empty() || kind == "0") && slope == 1.0 &&
                        least == std::floor(least) && std::abs(least) < 1e9;
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
                            const std::string& path) {
  const ImageJText text(description);
  TiffLayout layout;
  layout.writer = "ImageJ";
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

/// Refuses axes whose order is not z, y, x: read as if it were, they would give mirror images, or
/// channels behind x as voxels. tifffile leaves dimensions of one out as it reads.
void check_order_of(const std::string& all, const std::vector<std::int64_t>& counts,
                    const TiffPageShape& page, const std::string& path) {
  std::string letters;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (counts[k] > 1 || all[k] == 'X' || all[k] == 'Y') letters += all[k];
  }
  std::string space;
  std::string order;
  std::string others;
  for (std::size_t k = 0; k < letters.size(); ++k) {
    const bool is_space = std::string("XYZ").find(letters[k]) != std::string::npos;
    (is_space ? space : others) += letters[k];
    if (!is_space) order += std::to_string(k) + ", ";
  }
  std::string sorted = space;
  std::sort(sorted.rbegin(), sorted.rend());
  const bool ends_in_space = letters.empty() || space.find(letters.back()) != std::string::npos;
  if (space == sorted && (ends_in_space || page.samples > 1)) return;
  for (const char letter : sorted) order += std::to_string(letters.find(letter)) + ", ";
  order.resize(order.size() - 2);
  const std::string name = std::filesystem::path(path).filename().string();
  refuse_volume(path, "has the axes " + in_quotes(all) +
                          " in tifffile's text. Their order must be z, y, x, with others before "
                          "these. Save it so in Python: import tifffile; a = tifffile.imread(\"" +
                          name + "\").transpose(" + order +
                          "); tifffile.imwrite(\"zyx.tif\", a, metadata={\"axes\": \"" + others +
                          sorted + "\"})");
}

/// Reads tifffile's text: {"shape": [2, 24, 28, 36], "axes": "CZYX"}; the last dimensions are the
/// page's.
TiffLayout layout_of_tifffile(const Json& json, std::int64_t pages, const TiffPageShape& page,
                              const std::string& path) {
  TiffLayout layout;
  layout.writer = "tifffile";
  // Other keys are the caller's; these two are named as in ImageJ's text.
  if (json.contains("spacing") && json["spacing"].is_number()) {
    layout.voxel_size = Vector3::Constant(std::abs(json["spacing"].get<double>()));
    if (json.contains("unit") && json["unit"].is_string()) {
      layout.unit = unit_of(json["unit"].get<std::string>());
    }
  }
  const Json& shape = json["shape"];
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
  if (!letters.empty() && letters.size() != counts.size()) {
    refuse_volume(path, "has a \"shape\" in its text that fits no page. Export it again.");
  }
  check_order_of(letters, counts, page, path);
  if (page.samples == 1 && letters.find_first_of("ZCTS") == std::string::npos) {
    refuse_channels_inside(counts, path);
  }
  const std::size_t of_page = dimensions_of_page(counts, page);
  if (of_page == 0) {
    refuse_volume(path, "has pages of " + std::to_string(page.height) + " x " +
                            std::to_string(page.width) +
                            " voxels, but the \"shape\" in its text, " + text_of_counts(counts) +
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
    refuse_volume(path, "has " + std::to_string(pages) + " pages, but its text gives " +
                            text_of_counts(counts) +
                            " voxels. If it holds several volumes, save the labels alone.");
  }
  return layout;
}

}  // namespace

// OME's XML, in any order of dimensions:
// https://docs.openmicroscopy.org/ome-model/latest/ome-tiff/specification.html

#ifdef WSCVT_HAS_EXPAT

namespace {

using Attributes = std::map<std::string, std::string>;

/// An image of the XML.
struct OmeImage {
  std::string name;
  Attributes pixels;
  struct Planes {
    Attributes where;  ///< of TiffData
    std::string file;  ///< empty: this file
  };
  std::vector<Planes> planes;
};

struct OmeText {
  XML_Parser parser = nullptr;
  bool ends_at_pixels = false;  ///< only the first image's attributes are read
  std::vector<OmeImage> images;
};

void begin_element(void* user, const char* qualified, const char** pairs) {
  auto& text = *static_cast<OmeText*>(user);
  const std::string full(qualified);
  const std::string name =
      full.substr(full.find(':') == std::string::npos ? 0 : full.find(':') + 1);
  Attributes attributes;
  for (; *pairs != nullptr; pairs += 2) attributes[pairs[0]] = pairs[1];
  if (name == "Image") text.images.push_back({attributes["Name"], {}, {}});
  if (text.images.empty()) return;
  if (name == "Pixels") {
    if (!text.images.back().pixels.empty()) text.images.emplace_back();
    text.images.back().pixels = attributes;
    if (text.ends_at_pixels) XML_StopParser(text.parser, XML_FALSE);
  }
  OmeImage& image = text.images.back();
  if (name == "TiffData") image.planes.push_back({attributes, ""});
  if (name == "UUID" && !image.planes.empty()) image.planes.back().file = attributes["FileName"];
}

std::vector<OmeImage> ome_images_of(const std::string& xml, bool ends_at_pixels,
                                    const std::string& path) {
  if (xml.size() > std::size_t{1} << 28) refuse_volume(path, "has a text of more than 256 MB.");
  OmeText text;
  text.ends_at_pixels = ends_at_pixels;
  text.parser = XML_ParserCreate(nullptr);
  if (text.parser == nullptr) throw std::bad_alloc();
  XML_SetUserData(text.parser, &text);
  XML_SetElementHandler(text.parser, begin_element, nullptr);
  const XML_Status status = XML_Parse(text.parser, xml.data(), static_cast<int>(xml.size()), 1);
  const XML_Error code = XML_GetErrorCode(text.parser);
  const char* const said = XML_ErrorString(code);  // null: no error
  XML_ParserFree(text.parser);
  if (status != XML_STATUS_OK && code != XML_ERROR_ABORTED) {
    refuse_volume(path, "has damaged OME XML (" + std::string(said == nullptr ? "" : said) +
                            "). Export it again.");
  }
  std::vector<OmeImage>& images = text.images;
  images.erase(std::remove_if(images.begin(), images.end(),
                              [](const OmeImage& image) { return image.pixels.empty(); }),
               images.end());
  if (images.empty()) refuse_volume(path, "has OME XML without Pixels. Export it again.");
  return images;
}

/// Returns a whole number of an attribute, at least `least`.
std::int64_t count_of(const Attributes& attributes, const std::string& key, std::int64_t fallback,
                      std::int64_t least, const std::string& path) {
  const auto found = attributes.find(key);
  if (found == attributes.end()) return fallback;
  const std::optional<std::int64_t> number = whole_number_in(found->second);
  constexpr std::int64_t most = 1000000;
  if (!number || *number < least || *number > most) {
    refuse_volume(path,
                  "has " + in_quotes(found->second) + " as OME's " + key + ". Export it again.");
  }
  return *number;
}

void read_voxel_size(const Attributes& pixels, const std::string& path, TiffLayout& layout) {
  std::array<std::string, 3> units;
  Vector3 size = Vector3::Zero();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::string key = std::string("PhysicalSize") + "XYZ"[axis];
    const auto found = pixels.find(key);
    const auto unit = pixels.find(key + "Unit");
    units[static_cast<std::size_t>(axis)] = unit == pixels.end() ? "um" : unit_of(unit->second);
    if (found == pixels.end()) continue;
    const std::optional<double> number = number_in(found->second);
    if (!number || !(*number > 0.0) || !std::isfinite(*number)) {
      refuse_volume(path, "has " + in_quotes(found->second) + " as OME's " + key +
                              ". Correct it, or save it without OME's text.");
    }
    size[axis] = *number;
  }
  if (!(size.x() > 0.0) || !(size.y() > 0.0)) return;
  if (!(size.z() > 0.0)) {
    size.z() = size.x();
    units[2] = units[0];
    layout.notes.push_back(
        "OME's text has no PhysicalSizeZ. The size along x was used. Give another by " +
        mention("voxel-size", "X,Y,Z") + ".");
  }
  layout.unit = units[0];
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (units[axis] == units[0]) continue;
    const double from = nanometres(units[axis]);
    const double to = nanometres(units[0]);
    if (from * to == 0.0) {
      refuse_volume(path, "has voxel sizes in " + in_quotes(units[0]) + " and in " +
                              in_quotes(units[axis]) +
                              ". Save it in one unit, or without OME's text.");
    }
    size[static_cast<Eigen::Index>(axis)] *= from / to;
  }
  layout.voxel_size = size;
}

/// Computes the page of each plane, in the order of `layout.axes`.
void read_pages(const OmeImage& image, std::int64_t pages, std::int64_t in_file,
                const std::string& path, TiffLayout& layout) {
  std::int64_t planes = 1;
  for (const VolumeAxis& axis : layout.axes) {
    constexpr std::int64_t most = 100000000;
    planes *= axis.count;
    if (planes > most) refuse_volume(path, "gives more planes than a file can have.");
  }
  // Without TiffData, the planes are in the order of the file.
  if (image.planes.empty()) {
    if (planes != pages) {
      refuse_volume(path, "has " + std::to_string(pages) + " pages, but OME's text has " +
                              std::to_string(planes) + " planes. Export it again.");
    }
    return;
  }
  layout.pages.assign(static_cast<std::size_t>(planes), -1);
  for (const OmeImage::Planes& part : image.planes) {
    // A file may be renamed, but all its planes must be in one file.
    const std::string& other = image.planes.front().file;
    if (part.file != other) {
      refuse_volume(path, "is one of several files: OME's text names " + in_quotes(other) +
                              " and " + in_quotes(part.file) + ". Save the volume in one file.");
    }
    std::int64_t plane = 0;
    std::int64_t step = 1;
    for (const VolumeAxis& axis : layout.axes) {
      const char* const key = axis.kind == AxisKind::Space     ? "FirstZ"
                              : axis.kind == AxisKind::Channel ? "FirstC"
                                                               : "FirstT";
      plane += step * count_of(part.where, key, 0, 0, path);
      step *= axis.count;
    }
    const bool has_page = part.where.count("IFD") > 0;
    const std::int64_t first = count_of(part.where, "IFD", 0, 0, path);
    const std::int64_t count =
        count_of(part.where, "PlaneCount", has_page ? 1 : planes - plane, 0, path);
    for (std::int64_t k = 0; k < count; ++k) {
      if (plane + k >= planes || first + k >= in_file) {
        refuse_volume(path, "has " + std::to_string(in_file) + " pages, but OME's text places " +
                                "planes outside of them. Export it again.");
      }
      layout.pages[static_cast<std::size_t>(plane + k)] = first + k;
    }
  }
  for (const std::int64_t page : layout.pages) {
    if (page >= 0) continue;
    refuse_volume(path, "lacks planes of OME's text. Export it again.");
  }
}

/// Returns the only image with more than one slice, and notes how many others there are. Throws
/// Error(InputOutput), naming them, if several have, or none.
OmeImage image_of_slices(const std::string& xml, const std::string& path, TiffLayout& layout) {
  const std::vector<OmeImage> images = ome_images_of(xml, false, path);
  std::string names;
  const OmeImage* found = nullptr;
  int volumes = 0;
  for (const OmeImage& image : images) {
    const std::int64_t slices = count_of(image.pixels, "SizeZ", 1, 1, path);
    names += (names.empty() ? "" : ", ") + in_quotes(image.name) + " of " +
             format_count(static_cast<std::size_t>(slices), "slice");
    if (slices == 1 && images.size() > 1) continue;
    ++volumes;
    found = &image;
  }
  if (volumes != 1) {
    refuse_volume(path,
                  "holds " + std::to_string(images.size()) + " images by OME's text: " + names +
                      ". Save only the image of the labels, in Python by import "
                      "tifffile; tifffile.imwrite(\"one.tif\", tifffile.imread(" +
                      in_quotes(std::filesystem::path(path).filename().string()) + ", series=0))");
  }
  if (images.size() > 1) {
    layout.more_notes.push_back("Left out: the images of one slice. OME's text has " + names + ".");
  }
  return *found;
}

TiffLayout layout_of_ome(const std::string& xml, std::int64_t pages, const TiffPageShape& page,
                         const std::string& path) {
  TiffLayout layout;
  const OmeImage image = image_of_slices(xml, path, layout);
  layout.writer = "OME";
  const auto found = image.pixels.find("DimensionOrder");
  const std::string order = found == image.pixels.end() ? "XYZCT" : found->second;
  std::string letters = order;
  std::sort(letters.begin(), letters.end());
  if (letters != "CTXYZ" || order.rfind("XY", 0) != 0) {
    refuse_volume(path,
                  "has " + in_quotes(order) + " as OME's order of dimensions. Export it again.");
  }
  for (const char letter : order.substr(2)) {
    const std::string key = std::string("Size") + letter;
    if (letter == 'Z') {
      layout.axes.push_back({AxisKind::Space, count_of(image.pixels, key, 1, 1, path)});
    } else if (letter == 'C') {
      const std::int64_t channels = count_of(image.pixels, key, 1, 1, path);
      if (channels % page.samples != 0) {
        refuse_volume(path, "has " + std::to_string(page.samples) + " numbers per voxel, but " +
                                std::to_string(channels) +
                                " channels by OME's text. Export it "
                                "again.");
      }
      layout.axes.push_back({AxisKind::Channel, channels / page.samples});
    } else {
      layout.axes.push_back({AxisKind::Frame, count_of(image.pixels, key, 1, 1, path)});
    }
  }
  read_pages(image, pages, page.in_file, path, layout);
  read_voxel_size(image.pixels, path, layout);
  return layout;
}

/// Reads the size of the voxels of a slice in a file of its own.
TiffLayout slice_layout_of_ome(const std::string& xml, const std::string& path) {
  TiffLayout layout;
  layout.writer = "OME";
  read_voxel_size(ome_images_of(xml, true, path).front().pixels, path, layout);
  return layout;
}

}  // namespace

void check_ome_slices(const std::string& text, const std::vector<std::string>& paths) {
  if (!is_ome(text)) return;
  std::map<std::string, Attributes> places;
  const std::vector<OmeImage> images = ome_images_of(text, false, paths.front());
  for (const OmeImage::Planes& part : images.front().planes) {
    if (!part.file.empty()) places[part.file] = part.where;
  }
  const auto where = [&](const std::string& path) {
    return places.find(std::filesystem::path(path).filename().string());
  };
  std::int64_t last = -1;
  for (const std::string& path : paths) {
    if (where(path) == places.end()) return;  // renamed, or not of this set
    const Attributes& here = where(path)->second;
    const Attributes& first = where(paths.front())->second;
    for (const char* key : {"FirstC", "FirstT"}) {
      if (count_of(here, key, 0, 0, path) == count_of(first, key, 0, 0, path)) continue;
      refuse_volume(path, std::string("is of another ") + (key[5] == 'C' ? "channel" : "time") +
                              " than the slices before it, by OME's text. Move the files of one "
                              "volume to a folder of their own.");
    }
    const std::int64_t slice = count_of(here, "FirstZ", 0, 0, path);
    if (slice <= last) {
      refuse_volume(path, "is the slice " + std::to_string(slice + 1) +
                              " by OME's text, but follows the slice " + std::to_string(last + 1) +
                              " by the numbers in the names. Rename the files.");
    }
    last = slice;
  }
}

#else

namespace {

TiffLayout slice_layout_of_ome(const std::string&, const std::string& path) {
  refuse_without(path, "Expat", "libexpat1-dev");
}

TiffLayout layout_of_ome(const std::string& xml, std::int64_t, const TiffPageShape&,
                         const std::string& path) {
  return slice_layout_of_ome(xml, path);
}

}  // namespace

void check_ome_slices(const std::string&, const std::vector<std::string>&) {}

#endif

TiffLayout slice_layout(const std::string& description, const std::string& path) {
  if (is_ome(description)) return slice_layout_of_ome(description, path);
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

TiffLayout tiff_layout(const std::string& text, std::int64_t pages, const TiffPageShape& page,
                       const std::string& path) {
  if (text.rfind("ImageJ=", 0) == 0) return layout_of_imagej(text, pages, path);
  if (is_ome(text)) return layout_of_ome(text, pages, page, path);
  const std::size_t first = text.find_first_not_of(blanks);
  if (first != std::string::npos && text[first] == '{') {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_object() && json.contains("shape") && json["shape"].is_array()) {
      return layout_of_tifffile(json, pages, page, path);
    }
  }
  TiffLayout layout;
  layout.axes = {{AxisKind::Space, pages}};
  return layout;
}

}  // namespace wscvt
