// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's files from before XML, with structured points:
// https://docs.vtk.org/en/latest/vtk_file_formats/
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "toolbox/volume/header_file.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct VtkArray {
  std::string name;
  std::string type;
  std::int64_t components = 1;
  bool of_cells = false;
  std::uint64_t data = 0;
};

struct VtkHeader {
  bool is_text = false;
  std::array<std::int64_t, 3> counts = {};
  Vector3 origin = Vector3::Zero();
  Vector3 spacing = Vector3::Ones();
  bool has_size = false;
  std::vector<VtkArray> arrays;
};

VoxelType vtk_type_of(const std::string& name, const std::string& path) {
  // VTK writes a long with eight bytes, and binary numbers in big-endian order.
  std::string known = lower_case(name);
  std::replace(known.begin(), known.end(), '_', ' ');
  if (known == "char") known = "signed char";
  if (known == "long" || known == "vtktypeint64") known = "int64";
  if (known == "unsigned long" || known == "vtktypeuint64") known = "uint64";
  VoxelType type = voxel_type_of(known, path);
  type.big_endian = true;
  return type;
}

/// Returns the position after so many numbers of a text.
std::uint64_t end_of_numbers(const std::string& path, std::uint64_t begin, std::uint64_t count) {
  const std::unique_ptr<ByteSource> bytes = file_bytes(path, begin);
  std::vector<char> part(1 << 16);
  std::uint64_t place = begin;
  bool is_in_number = false;
  for (;;) {
    const std::size_t got = bytes->read(part.data(), part.size());
    for (std::size_t k = 0; k < got; ++k) {
      if (is_in_number && is_blank(part[k]) && --count == 0) return place + k;
      is_in_number = !is_blank(part[k]);
    }
    place += got;
    if (got < part.size()) return place;
  }
}

/// Reads keywords and arrays in turn: an array's numbers are between its line and the next keyword.
class VtkParser {
 public:
  explicit VtkParser(const std::string& path) : path_(path) { file_.emplace(path, 0); }

  VtkHeader read() {
    if (next_line().rfind("# vtk DataFile Version", 0) != 0) {
      file_->fail_line("is not that of a VTK file.");
    }
    next_line();  // a title
    const std::string form = lower_case(next_line());
    if (form != "ascii" && form != "binary") file_->fail_line("is neither ASCII nor BINARY.");
    header_.is_text = form == "ascii";
    bool has_dataset = false;
    while (!file_->is_at_end()) {
      const std::string line = next_line();
      if (line.empty()) continue;
      TextFields fields(line);
      const std::string key = lower_case(fields.next());
      if (key == "dataset") {
        const std::string kind = lower_case(fields.next());
        if (kind == "rectilinear_grid" || kind == "structured_grid") {
          refuse_volume(path_,
                        "is a grid whose voxels may differ in size, which is not read. Save it as "
                        ".vti, in ParaView by Filters > Resample To Image with as many points.");
        }
        if (kind != "structured_points") {
          refuse_volume(path_,
                        "has no structured points, so it is not a volume of labels. For a mesh, "
                        "use wscvt remesh.");
        }
        has_dataset = true;
      } else if (!has_dataset) {
        file_->fail_line("is before the data set.");
      } else {
        read_keyword(key, fields);
      }
    }
    return header_;
  }

 private:
  std::string next_line() { return file_->line(); }

  void read_keyword(const std::string& key, TextFields& fields) {
    if (key == "dimensions") {
      for (std::int64_t& count : header_.counts) count = whole_number_of(fields.next(), *file_);
    } else if (key == "origin") {
      header_.origin = vector_in(fields.rest(), *file_);
    } else if (key == "spacing" || key == "aspect_ratio") {
      header_.spacing = vector_in(fields.rest(), *file_);
      header_.has_size = true;
    } else if (key == "point_data" || key == "cell_data") {
      of_cells_ = key == "cell_data";
      voxels_ = whole_number_of(fields.next(), *file_);
      std::int64_t wanted = 1;
      for (const std::int64_t count : header_.counts) {
        constexpr std::int64_t most = 1000000;
        if (count < 1 || count > most)
          file_->fail_line("needs dimensions from 1 to 1000000 before it.");
        wanted *= count - (of_cells_ ? 1 : 0);
      }
      if (voxels_ != wanted) file_->fail_line("gives another number than the dimensions.");
    } else if (key == "scalars") {
      VtkArray array;
      array.name = fields.next();
      array.type = fields.next();
      const std::string_view components = fields.next();
      array.components = components.empty() ? 1 : whole_number_of(components, *file_);
      if (lower_case(next_line()).rfind("lookup_table", 0) != 0) {
        file_->fail_line("does not name the table of colors, which follows scalars.");
      }
      add(array);
    } else if (key == "color_scalars") {
      // VTK writes every array of 8 bits so, in text by the 255th part.
      if (header_.is_text) {
        file_->fail_line("holds labels of 8 bits as fractions of 255. Save the file as BINARY.");
      }
      VtkArray array;
      array.name = fields.next();
      array.type = "unsigned_char";
      array.components = whole_number_of(fields.next(), *file_);
      add(array);
    } else if (key == "field") {
      fields.next();
      const std::int64_t count = whole_number_of(fields.next(), *file_);
      for (std::int64_t k = 0; k < count; ++k) read_field_array();
    } else if (key == "metadata") {
      while (!file_->is_at_end() && !next_line().empty()) {
      }
    } else {
      file_->fail_line("has the keyword " + in_quotes(key) +
                       ", which a volume of labels does not have. Save only the labels.");
    }
  }

  void read_field_array() {
    std::string line = next_line();
    while (line.empty()) line = next_line();
    if (lower_case(line) == "metadata") {
      while (!next_line().empty()) {
      }
      line = next_line();
    }
    TextFields fields(line);
    VtkArray array;
    array.name = fields.next();
    array.components = whole_number_of(fields.next(), *file_);
    const std::int64_t count = whole_number_of(fields.next(), *file_);
    array.type = fields.next();
    if (voxels_ == 0 || count != voxels_) {
      file_->fail_line("is an array of another number of voxels than the volume has.");
    }
    add(array);
  }

  /// Records the array, and continues after its numbers.
  void add(VtkArray array) {
    constexpr std::int64_t most = 1000000;
    if (voxels_ == 0 || array.components < 1 || array.components > most) {
      file_->fail_line("is an array of no voxels.");
    }
    array.of_cells = of_cells_;
    array.data = file_->offset();
    const auto numbers =
        static_cast<std::uint64_t>(voxels_) * static_cast<std::uint64_t>(array.components);
    const std::uint64_t end =
        header_.is_text
            ? end_of_numbers(path_, array.data, numbers)
            : array.data +
                  numbers * static_cast<std::uint64_t>(vtk_type_of(array.type, path_).bytes);
    header_.arrays.push_back(std::move(array));
    file_.emplace(path_, end);
  }

  std::string path_;
  std::optional<HeaderFile> file_;
  VtkHeader header_;
  bool of_cells_ = false;
  std::int64_t voxels_ = 0;
};

}  // namespace

std::unique_ptr<LabelVolume> open_legacy_vtk(const std::string& path, const VolumeChoice& choice) {
  const VtkHeader header = VtkParser(path).read();
  if (header.arrays.empty()) refuse_volume(path, "holds no array of labels. Export it again.");
  std::vector<std::string> names;
  for (const VtkArray& array : header.arrays) names.push_back(array.name);
  const VtkArray& array = header.arrays[chosen_array(names, choice, path)];
  const std::int64_t less = array.of_cells ? 1 : 0;
  VolumeGeometry geometry;
  geometry.has_size = header.has_size;
  geometry.counts = voxel_counts(
      {header.counts[0] - less, header.counts[1] - less, header.counts[2] - less}, path);
  const Vector3 to_centre = array.of_cells ? Vector3(0.5 * header.spacing) : Vector3::Zero();
  require_spacing(header.spacing, choice, path);
  set_lattice(geometry, header.spacing.asDiagonal(), header.origin + to_centre, choice, path);
  VoxelData data;
  data.paths = {path};
  data.offset = array.data;
  data.picks = picks_of({{AxisKind::Channel, array.components},
                         {AxisKind::Space, geometry.counts[0]},
                         {AxisKind::Space, geometry.counts[1]},
                         {AxisKind::Space, geometry.counts[2]}},
                        choice, path);
  data.packing = header.is_text ? Packing::Text : Packing::None;
  data.has_more = true;
  return volume_of_files(geometry, vtk_type_of(array.type, path), data);
}

}  // namespace wscvt
