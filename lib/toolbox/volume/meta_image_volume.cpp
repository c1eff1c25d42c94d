// SPDX-License-Identifier: GPL-3.0-or-later
// MetaImage as ITK defines it: https://docs.itk.org/en/latest/learn/metaio.html
#include <utility>

#include "toolbox/volume/header_file.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct MetaHeader {
  std::int64_t dimensions = 3;
  std::vector<std::int64_t> sizes;
  std::string type;
  std::int64_t channels = 1;
  bool is_text = false;
  bool is_packed = false;
  bool big_endian = false;
  std::string unit;
  std::vector<double> spacing;
  std::vector<double> directions;
  std::vector<double> origin;
  std::int64_t header_size = 0;
  std::string data_file;
  std::vector<std::string> list;  ///< of `ElementDataFile = LIST`
};

bool is_true(const std::string& value) {
  const std::string lower = lower_case(value);
  return lower == "true" || lower == "t" || lower == "1";
}

// Unknown fields are the writer's notes: ITK's writer adds an image's whole dictionary. All fields
// for the position and type of voxels are known.
void read_field(const std::string& name, const std::string& value, const HeaderFile& file,
                MetaHeader& header) {
  if (name == "objecttype") {
    if (lower_case(value) != "image") file.fail_line("is of no image.");
  } else if (name == "ndims") {
    header.dimensions = whole_number_of(value, file);
  } else if (name == "dimsize") {
    header.sizes = whole_numbers_in(value, file);
  } else if (name == "elementtype") {
    header.type = value;
  } else if (name == "elementnumberofchannels") {
    header.channels = whole_number_of(value, file);
  } else if (name == "binarydata") {
    header.is_text = !is_true(value);
  } else if (name == "compresseddata") {
    header.is_packed = is_true(value);
  } else if (name == "binarydatabyteordermsb" || name == "elementbyteordermsb") {
    header.big_endian = is_true(value);
  } else if (name == "distanceunits") {
    header.unit = value == "?" ? "" : value;
  } else if (name == "elementspacing" || (name == "elementsize" && header.spacing.empty())) {
    header.spacing = numbers_in(value, file);
  } else if (name == "transformmatrix" || name == "rotation" || name == "orientation") {
    header.directions = numbers_in(value, file);
  } else if (name == "offset" || name == "position" || name == "origin") {
    header.origin = numbers_in(value, file);
  } else if (name == "headersize") {
    header.header_size = whole_number_of(value, file);
  } else if (name == "elementdatafile") {
    header.data_file = value;
  }
}

MetaHeader read_meta_header(HeaderFile& file) {
  MetaHeader header;
  while (header.data_file.empty()) {  // the last field
    const std::string line = file.line();
    const std::size_t sign = line.find('=');
    if (line.empty()) continue;
    if (sign == std::string::npos) file.fail_line("is not that of a MetaImage.");
    read_field(lower_case(trimmed(line.substr(0, sign))),
               std::string(trimmed(line.substr(sign + 1))), file, header);
  }
  if (lower_case(header.data_file).rfind("list", 0) == 0) header.list = file.other_lines();
  return header;
}

/// Returns the dimensions in the file's order: channels, x, y, z, and frames as a fourth dimension.
std::vector<VolumeAxis> axes_of(const MetaHeader& header, const std::string& path) {
  check_dimensions(header.dimensions, header.sizes.size(), path);
  if (header.dimensions != 3 && header.dimensions != 4) {
    refuse_volume(
        path, "has " + std::to_string(header.dimensions) + " dimensions. Save only one volume.");
  }
  std::vector<VolumeAxis> axes;
  if (header.channels != 1) axes.push_back({AxisKind::Channel, header.channels});
  for (std::size_t k = 0; k < header.sizes.size(); ++k) {
    axes.push_back({k < 3 ? AxisKind::Space : AxisKind::Frame, header.sizes[k]});
  }
  return axes;
}

/// Returns the first three numbers of as many as there are dimensions.
Vector3 vector_of(const std::vector<double>& numbers, const MetaHeader& header,
                  const Vector3& fallback, const std::string& path) {
  if (numbers.empty()) return fallback;
  if (numbers.size() != header.sizes.size()) {
    refuse_volume(
        path,
        "has a spacing or an offset of another number of axes than its sizes. Export it again.");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

void set_geometry(const MetaHeader& header, const VolumeChoice& choice, const std::string& path,
                  VolumeGeometry& geometry) {
  geometry.counts = voxel_counts({header.sizes[0], header.sizes[1], header.sizes[2]}, path);
  geometry.has_size = !header.spacing.empty();
  geometry.unit = unit_of(header.unit);
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
  const std::size_t side = header.sizes.size();
  if (!header.directions.empty()) {
    if (header.directions.size() != side * side) {
      refuse_volume(path,
                    "has directions of another number of axes than its sizes. Export it "
                    "again.");
    }
    for (std::size_t k = 0; k < 9; ++k) {
      directions(static_cast<Eigen::Index>(k % 3), static_cast<Eigen::Index>(k / 3)) =
          header.directions[k / 3 * side + k % 3];
    }
  }
  const Vector3 spacing = vector_of(header.spacing, header, Vector3::Ones(), path);
  require_spacing(spacing, choice, path);
  set_lattice(geometry, directions * spacing.asDiagonal(),
              vector_of(header.origin, header, Vector3::Zero(), path), choice, path);
}

}  // namespace

std::unique_ptr<LabelVolume> open_meta_image(const std::string& path, const VolumeChoice& choice) {
  HeaderFile file(path);
  const MetaHeader header = read_meta_header(file);
  refuse_array_choice(choice, path);
  const std::vector<VolumeAxis> axes = axes_of(header, path);
  VolumeGeometry geometry;
  set_geometry(header, choice, path, geometry);
  VoxelType type = voxel_type_of(header.type, path);
  type.big_endian = header.big_endian;

  const bool is_local = lower_case(header.data_file) == "local";
  VoxelData data;
  data.picks = picks_of(axes, choice, path);
  // MetaIO needs no last number and no step.
  data.paths = is_local ? std::vector<std::string>{path}
                        : voxel_files_beside(path, header.data_file, header.list,
                                             {{1, header.sizes.back(), 1}});
  data.offset = is_local ? file.offset() : 0;
  if (header.is_packed) data.packing = Packing::Deflate;
  if (header.is_text) data.packing = Packing::Text;
  data.at_end = header.header_size == -1 && data.packing == Packing::None;
  if (header.header_size > 0) data.offset = static_cast<std::uint64_t>(header.header_size);
  return volume_of_files(geometry, type, data);
}

}  // namespace wscvt
