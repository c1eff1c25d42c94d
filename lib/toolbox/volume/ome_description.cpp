// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/tiff_layout.h"
#include "toolbox/volume/voxel_rows.h"
#ifdef WSCVT_HAS_EXPAT
#include <expat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <new>

#include "wscvt/mesh_files/text_fields.h"
#endif

namespace wscvt {

#ifdef WSCVT_HAS_EXPAT

namespace {

using Attributes = std::map<std::string, std::string>;

/// Description of the pages in the XML.
struct OmeText {
  int images = 0;
  Attributes pixels;  ///< of the first image
  struct Planes {
    Attributes where;  ///< of TiffData
    std::string file;  ///< empty: this file
  };
  std::vector<Planes> planes;
};

void begin_element(void* user, const char* qualified, const char** pairs) {
  auto& text = *static_cast<OmeText*>(user);
  const std::string full(qualified);
  const std::string name =
      full.substr(full.find(':') == std::string::npos ? 0 : full.find(':') + 1);
  Attributes attributes;
  for (; *pairs != nullptr; pairs += 2) attributes[pairs[0]] = pairs[1];
  if (name == "Pixels" && ++text.images == 1) text.pixels = attributes;
  if (text.images > 1) return;
  if (name == "TiffData") text.planes.push_back({attributes, ""});
  if (name == "UUID" && !text.planes.empty()) text.planes.back().file = attributes["FileName"];
}

OmeText ome_text_of(const std::string& xml, const std::string& path) {
  OmeText text;
  XML_Parser const parser = XML_ParserCreate(nullptr);
  if (parser == nullptr) throw std::bad_alloc();
  XML_SetUserData(parser, &text);
  XML_SetElementHandler(parser, begin_element, nullptr);
  const XML_Status status = XML_Parse(parser, xml.data(), static_cast<int>(xml.size()), 1);
  const char* const said = XML_ErrorString(XML_GetErrorCode(parser));  // null: no error
  XML_ParserFree(parser);
  if (status != XML_STATUS_OK) {
    refuse_volume(path, "has damaged OME XML (" + std::string(said == nullptr ? "" : said) +
                            "). Export it again.");
  }
  if (text.images == 0) refuse_volume(path, "has OME XML without Pixels. Export it again.");
  return text;
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

/// Returns the length of a unit in metres; nothing for unknown units.
std::optional<double> in_metres(const std::string& unit) {
  static const std::map<std::string, double> units = {{"nm", 1e-9}, {"um", 1e-6}, {"mm", 1e-3},
                                                      {"cm", 1e-2}, {"m", 1.0},   {"inch", 0.0254}};
  const auto found = units.find(unit);
  if (found == units.end()) return std::nullopt;
  return found->second;
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
    const std::optional<double> from = in_metres(units[axis]);
    const std::optional<double> to = in_metres(units[0]);
    if (!from || !to) {
      refuse_volume(path, "has voxel sizes in " + in_quotes(units[0]) + " and in " +
                              in_quotes(units[axis]) +
                              ". Save it in one unit, or without OME's text.");
    }
    size[static_cast<Eigen::Index>(axis)] *= *from / *to;
  }
  layout.voxel_size = size;
}

/// Computes the page of each plane, in the order of `layout.axes`.
void read_pages(const OmeText& text, std::int64_t pages, const std::string& path,
                TiffLayout& layout) {
  std::int64_t planes = 1;
  for (const VolumeAxis& axis : layout.axes) {
    constexpr std::int64_t most = 100000000;
    planes *= axis.count;
    if (planes > most) refuse_volume(path, "gives more planes than a file can have.");
  }
  // Without TiffData, the planes are in the order of the file.
  if (text.planes.empty()) {
    if (planes != pages) {
      refuse_volume(path, "has " + std::to_string(pages) + " pages, but OME's text has " +
                              std::to_string(planes) + " planes. Export it again.");
    }
    return;
  }
  layout.pages.assign(static_cast<std::size_t>(planes), -1);
  for (const OmeText::Planes& part : text.planes) {
    // A file may be renamed, but all its planes must be in one file.
    const std::string& other = text.planes.front().file;
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
      if (plane + k >= planes || first + k >= pages) {
        refuse_volume(path, "has " + std::to_string(pages) + " pages, but OME's text places " +
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

}  // namespace

TiffLayout layout_of_ome(const std::string& xml, std::int64_t pages, std::int64_t samples,
                         const std::string& path) {
  if (xml.size() > std::size_t{1} << 28) refuse_volume(path, "has a text of more than 256 MB.");
  const OmeText text = ome_text_of(xml, path);
  if (text.images > 1) {
    refuse_volume(path, "holds " + std::to_string(text.images) +
                            " images by OME's text. Save only the image of the labels.");
  }
  TiffLayout layout;
  layout.writer = "OME";
  layout.samples = samples;
  const auto found = text.pixels.find("DimensionOrder");
  const std::string order = found == text.pixels.end() ? "XYZCT" : found->second;
  std::string letters = order;
  std::sort(letters.begin(), letters.end());
  if (letters != "CTXYZ" || order.rfind("XY", 0) != 0) {
    refuse_volume(path,
                  "has " + in_quotes(order) + " as OME's order of dimensions. Export it again.");
  }
  for (const char letter : order.substr(2)) {
    const std::string key = std::string("Size") + letter;
    if (letter == 'Z') {
      layout.axes.push_back({AxisKind::Space, count_of(text.pixels, key, 1, 1, path)});
    } else if (letter == 'C') {
      const std::int64_t channels = count_of(text.pixels, key, 1, 1, path);
      if (channels % samples != 0) {
        refuse_volume(path, "has " + std::to_string(samples) + " numbers per voxel, but " +
                                std::to_string(channels) +
                                " channels by OME's text. Export it "
                                "again.");
      }
      layout.axes.push_back({AxisKind::Channel, channels / samples});
    } else {
      layout.axes.push_back({AxisKind::Frame, count_of(text.pixels, key, 1, 1, path)});
    }
  }
  read_pages(text, pages, path, layout);
  read_voxel_size(text.pixels, path, layout);
  return layout;
}

#else

TiffLayout layout_of_ome(const std::string&, std::int64_t, std::int64_t, const std::string& path) {
  refuse_volume(path,
                "has OME XML, but this program was built without Expat. Install "
                "libexpat1-dev and build it again, or save the volume as .nrrd.");
}

#endif

}  // namespace wscvt
