// SPDX-License-Identifier: GPL-3.0-or-later
// NRRD as Teem defines it: http://teem.sourceforge.net/nrrd/format.html
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "toolbox/volume/header_file.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct NrrdHeader {
  std::int64_t dimension = 0;
  std::vector<std::int64_t> sizes;
  std::string type;
  std::string encoding = "raw";
  bool has_endian = false;
  bool big_endian = false;
  std::vector<std::string> kinds;
  std::vector<double> spacings;  ///< NaN for axes that are not space
  bool has_ends = false;         ///< axis mins or axis maxs
  std::vector<std::optional<Vector3>> directions;
  Vector3 origin = Vector3::Zero();
  bool is_left_handed = false;  ///< the space
  std::vector<std::string> units;
  std::string data_file;
  std::vector<std::string> list;  ///< of `data file: LIST`
  std::int64_t line_skip = 0;
  std::int64_t byte_skip = 0;
  std::map<std::string, std::string> remarks;  ///< by key and value
};

/// Returns all texts in quotes.
std::vector<std::string> quoted_in(const std::string& text) {
  std::vector<std::string> texts;
  for (std::size_t begin = text.find('"'); begin != std::string::npos;) {
    const std::size_t end = text.find('"', begin + 1);
    if (end == std::string::npos) break;
    texts.push_back(text.substr(begin + 1, end - begin - 1));
    begin = text.find('"', end + 1);
  }
  return texts;
}

/// Reads directions, such as "none (1,0,0) (0,1,0) (0,0,1)".
std::vector<std::optional<Vector3>> directions_in(const std::string& text, const HeaderFile& file) {
  std::vector<std::optional<Vector3>> directions;
  std::size_t place = 0;
  while ((place = text.find_first_not_of(" \t", place)) != std::string::npos) {
    if (text.compare(place, 4, "none") == 0) {
      directions.emplace_back();
      place += 4;
      continue;
    }
    const std::size_t end = text.find(')', place);
    if (text[place] != '(' || end == std::string::npos) {
      file.fail_line("does not have directions of three numbers in brackets.");
    }
    directions.emplace_back(vector_in(text.substr(place, end - place), file));
    place = end + 1;
  }
  return directions;
}

/// Returns whether a space is left-handed, such as "left-anterior-superior" or "LAS". Right,
/// anterior and superior are the axes x, y and z of a right-handed space.
bool is_left_handed(const std::string& space) {
  if (space.rfind("3d-left-handed", 0) == 0) return true;
  std::string letters;
  for (const char* const word :
       {"right", "left", "anterior", "posterior", "superior", "inferior"}) {
    const std::size_t place = space.find(word);
    if (place != std::string::npos) letters += word[0];
  }
  const bool is_short =
      letters.empty() && (space.size() == 3 || (space.size() == 4 && space[3] == 't'));
  if (is_short) letters = space.substr(0, 3);
  const auto count = [&](const char* any) {
    return std::count_if(letters.begin(), letters.end(),
                         [&](char c) { return std::strchr(any, c) != nullptr; });
  };
  return letters.size() == 3 && count("rl") == 1 && count("ap") == 1 && count("si") == 1 &&
         count("lpi") % 2 == 1;
}

/// Fields that do not affect the position or type of voxels.
bool is_passed_over(const std::string& name) {
  static const std::set<std::string> names = {
      "space dimension", "measurement frame", "content",    "number", "thicknesses",
      "centers",         "centerings",        "labels",     "min",    "max",
      "block size",      "blocksize",         "old min",    "oldmin", "old max",
      "oldmax",          "sample units",      "sampleunits"};
  return names.count(name) > 0;
}

void read_field(const std::string& name, const std::string& value, const HeaderFile& file,
                NrrdHeader& header) {
  if (name == "dimension") {
    header.dimension = whole_number_of(value, file);
  } else if (name == "sizes") {
    header.sizes = whole_numbers_in(value, file);
  } else if (name == "type") {
    header.type = value;
  } else if (name == "encoding") {
    header.encoding = lower_case(value);
  } else if (name == "endian") {
    const std::string order = lower_case(value);
    if (order != "big" && order != "little") file.fail_line("is neither \"little\" nor \"big\".");
    header.has_endian = true;
    header.big_endian = order == "big";
  } else if (name == "kinds") {
    TextFields fields(value);
    for (auto field = fields.next(); !field.empty(); field = fields.next()) {
      header.kinds.push_back(lower_case(field));
    }
  } else if (name == "spacings") {
    header.spacings = numbers_in(value, file);
  } else if (name == "axis mins" || name == "axismins" || name == "axis maxs" ||
             name == "axismaxs") {
    header.has_ends = true;
  } else if (name == "space directions") {
    header.directions = directions_in(value, file);
  } else if (name == "space") {
    header.is_left_handed = is_left_handed(lower_case(value));
  } else if (name == "space origin") {
    header.origin = vector_in(value, file);
  } else if (name == "space units" || name == "units") {
    header.units = quoted_in(value);
  } else if (name == "data file" || name == "datafile") {
    header.data_file = value;
  } else if (name == "line skip" || name == "lineskip") {
    header.line_skip = whole_number_of(value, file);
  } else if (name == "byte skip" || name == "byteskip") {
    header.byte_skip = whole_number_of(value, file);
  } else if (!is_passed_over(name)) {
    file.fail_line("has the field " + in_quotes(name) + ", which NRRD does not have.");
  }
}

NrrdHeader read_nrrd_header(HeaderFile& file) {
  if (file.line().rfind("NRRD000", 0) != 0) file.fail_line("is not that of an NRRD file.");
  NrrdHeader header;
  const auto is_list = [&] { return lower_case(header.data_file).rfind("list", 0) == 0; };
  while (!file.is_at_end() && !is_list()) {
    const std::string line = file.line();
    if (line.empty()) break;
    if (line.front() == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) file.fail_line("is not that of an NRRD header.");
    if (line.substr(colon, 2) == ":=") {
      header.remarks[line.substr(0, colon)] = line.substr(colon + 2);
      continue;
    }
    read_field(lower_case(trimmed(line.substr(0, colon))),
               std::string(trimmed(line.substr(colon + 1))), file, header);
  }
  // A list is the last field; the file names follow it.
  if (is_list()) header.list = file.other_lines();
  return header;
}

/// Returns the kind of each dimension. Without a kind, a dimension without a direction is not
/// space; if more than three are left, the slowest are not space either.
std::vector<VolumeAxis> axes_of(const NrrdHeader& header, const std::string& path) {
  const std::size_t count = header.sizes.size();
  const auto has_all = [&](std::size_t size) { return size == 0 || size == count; };
  if (!has_all(header.kinds.size()) || !has_all(header.spacings.size()) ||
      !has_all(header.directions.size())) {
    refuse_volume(path, "has kinds, spacings or directions of another number of axes than its " +
                            std::to_string(count) + ". Export it again.");
  }
  std::vector<VolumeAxis> axes;
  std::size_t of_space = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::string kind = header.kinds.empty() ? "???" : header.kinds[k];
    const bool is_unknown = kind == "???" || kind == "none";
    const bool has_place = header.directions.empty()
                               ? header.spacings.empty() || !std::isnan(header.spacings[k])
                               : header.directions[k].has_value();
    const bool is_space = kind == "domain" || kind == "space" || (is_unknown && has_place);
    axes.push_back({is_space ? AxisKind::Space
                             : (kind == "time" || is_unknown ? AxisKind::Frame : AxisKind::Channel),
                    header.sizes[k]});
    of_space += is_space ? 1 : 0;
  }
  for (std::size_t k = count; k-- > 0 && of_space > 3;) {
    if (axes[k].kind != AxisKind::Space) continue;
    axes[k].kind = AxisKind::Frame;
    --of_space;
  }
  if (of_space != 3) {
    refuse_volume(path, "has " + std::to_string(of_space) +
                            " dimensions of space, but a volume has three. Export it again.");
  }
  return axes;
}

void set_geometry(const NrrdHeader& header, const std::vector<VolumeAxis>& axes,
                  const VolumeChoice& choice, const std::string& path, VolumeGeometry& geometry) {
  std::array<std::int64_t, 3> counts{};
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();
  geometry.has_size = !header.directions.empty() || !header.spacings.empty();
  if (header.has_ends && !geometry.has_size && !choice.voxel_size) {
    refuse_volume(path,
                  "gives the size by \"axis mins\" and \"axis maxs\", which are not read. "
                  "Give it by " +
                      mention("voxel-size") + ", or save the volume with spacings.");
  }
  std::size_t axis = 0;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (axes[k].kind != AxisKind::Space) continue;
    const auto column = static_cast<Eigen::Index>(axis);
    counts[axis++] = axes[k].count;
    if (!header.directions.empty()) {
      if (!header.directions[k]) refuse_volume(path, "has an axis of space without a direction.");
      lattice.col(column) = *header.directions[k];
    } else if (!header.spacings.empty()) {
      lattice(column, column) = header.spacings[k];
    }
  }
  geometry.counts = voxel_counts(counts, path);
  std::vector<std::string> units = header.units;
  units.erase(std::remove(units.begin(), units.end(), ""), units.end());
  if (!units.empty()) geometry.unit = unit_of(units.front());
  for (const std::string& unit : units) {
    if (unit_of(unit) != geometry.unit && !choice.voxel_size) {
      refuse_volume(path, "has axes in " + in_quotes(units.front()) + " and in " + in_quotes(unit) +
                              ". Give the size in one unit by " + mention("voxel-size") + ".");
    }
  }
  if (header.directions.empty()) require_spacing(lattice.diagonal(), choice, path);
  Vector3 origin = header.origin;
  if (header.is_left_handed && !header.directions.empty()) {
    // Meshes are right-handed: without this the grains would be mirror images.
    lattice.row(0) *= -1.0;
    origin.x() *= -1.0;
  }
  set_lattice(geometry, lattice, origin, choice, path);
}

/// Returns Slicer's names of the segments of a .seg.nrrd, for the selected layer.
std::map<Label, std::string> segment_names(const NrrdHeader& header, std::int64_t layer) {
  std::map<Label, std::string> names;
  for (const auto& [key, value] : header.remarks) {
    constexpr const char* ending = "_LabelValue";
    const std::size_t place = key.find(ending);
    if (key.rfind("Segment", 0) != 0 || place == std::string::npos) continue;
    const std::string segment = key.substr(0, place);
    const auto remark = [&](const char* name) -> std::string {
      const auto found = header.remarks.find(segment + name);
      return found == header.remarks.end() ? "" : std::string(trimmed(found->second));
    };
    const std::optional<std::int64_t> label = whole_number_in(trimmed(value));
    if (!label || *label < 0 || *label > std::numeric_limits<Label>::max()) continue;
    if (whole_number_in(remark("_Layer")).value_or(0) != layer) continue;
    names[static_cast<Label>(*label)] = remark("_Name");
  }
  return names;
}

/// Returns the index of the selected layer of a .seg.nrrd; its layers are channels.
std::int64_t layer_of(const std::vector<VolumeAxis>& axes, const VolumeChoice& choice,
                      const std::string& path) {
  for (const VolumeAxis& axis : axes) {
    if (axis.kind == AxisKind::Channel) return chosen_place(axis, choice, path);
  }
  return 0;
}

Packing packing_of(const std::string& encoding, const std::string& path) {
  if (encoding == "raw") return Packing::None;
  if (encoding == "gzip" || encoding == "gz") return Packing::Deflate;
  if (encoding == "ascii" || encoding == "text" || encoding == "txt") return Packing::Text;
  refuse_volume(path, "is packed as " + in_quotes(encoding) + ". Save it raw, ascii or as gzip.");
}

}  // namespace

std::unique_ptr<LabelVolume> open_nrrd(const std::string& path, const VolumeChoice& choice) {
  HeaderFile file(path);
  const NrrdHeader header = read_nrrd_header(file);
  check_dimensions(header.dimension, header.sizes.size(), path);
  refuse_array_choice(choice, path);
  const std::vector<VolumeAxis> axes = axes_of(header, path);
  VolumeGeometry geometry;
  set_geometry(header, axes, choice, path, geometry);
  VoxelType type = voxel_type_of(header.type, path);
  type.big_endian = header.big_endian;

  VoxelData data;
  data.packing = packing_of(header.encoding, path);
  if (type.bytes > 1 && !header.has_endian && data.packing != Packing::Text) {
    refuse_volume(path,
                  "does not say its byte order. Write \"endian: little\" or \"endian: big\" "
                  "into its header.");
  }
  data.picks = picks_of(axes, choice, path);
  data.paths = header.data_file.empty()
                   ? std::vector<std::string>{path}
                   : voxel_files_beside(path, header.data_file, header.list, std::nullopt);
  data.offset = header.data_file.empty() ? file.offset() : 0;
  const bool is_packed = data.packing != Packing::None;
  data.at_end = header.byte_skip == -1 && header.line_skip == 0 && !is_packed;
  if (!data.at_end && (header.byte_skip != 0 || header.line_skip != 0)) {
    const bool is_known = !is_packed && header.line_skip == 0 && header.byte_skip > 0;
    if (!is_known) refuse_volume(path, "skips lines, or bytes of packed data. Save it again.");
    data.offset += static_cast<std::uint64_t>(header.byte_skip);
  }
  std::unique_ptr<LabelVolume> volume = volume_of_files(geometry, type, data);
  volume->set_names(segment_names(header, layer_of(axes, choice, path)));
  return volume;
}

}  // namespace wscvt
