// SPDX-License-Identifier: GPL-3.0-or-later
// MetaImage as ITK defines it: https://docs.itk.org/en/latest/learn/metaio.html
#include "volume/header_file.h"
#include "volume/volume_formats.h"
#include "volume/voxel_rows.h"
#include "wscvt/scan/text_fields.h"

namespace wscvt {

namespace {

struct MetaHeader {
  std::array<std::int64_t, 3> sizes = {};
  bool has_sizes = false;
  std::string type;
  bool is_packed = false;
  bool big_endian = false;
  Vector3 spacing = Vector3::Ones();
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
  Vector3 origin = Vector3::Zero();
  std::int64_t header_size = 0;
  std::string data_file;
};

bool is_true(const std::string& value) { return lower_case(value) == "true" || value == "1"; }

void read_field(const std::string& name, const std::string& value, const HeaderFile& file,
                MetaHeader& header) {
  if (name == "ndims") {
    if (value != "3")
      file.fail_line("says that it has not three dimensions; save one volume alone.");
  } else if (name == "dimsize") {
    header.sizes = whole_vector_in(value, file);
    header.has_sizes = true;
  } else if (name == "elementtype") {
    header.type = value;
  } else if (name == "elementnumberofchannels") {
    if (value != "1") file.fail_line("has voxels of more than one number; save the labels alone.");
  } else if (name == "binarydata") {
    if (!is_true(value)) file.fail_line("has its voxels as text; save them binary.");
  } else if (name == "compresseddata") {
    header.is_packed = is_true(value);
  } else if (name == "binarydatabyteordermsb" || name == "elementbyteordermsb") {
    header.big_endian = is_true(value);
  } else if (name == "elementspacing") {
    header.spacing = vector_in(value, file);
  } else if (name == "transformmatrix" || name == "rotation" || name == "orientation") {
    const std::vector<double> numbers = numbers_in(value, file);
    if (numbers.size() != 9) file.fail_line("does not have nine numbers.");
    for (Eigen::Index k = 0; k < 9; ++k) {
      header.directions(k % 3, k / 3) = numbers[static_cast<std::size_t>(k)];
    }
  } else if (name == "offset" || name == "position" || name == "origin") {
    header.origin = vector_in(value, file);
  } else if (name == "headersize") {
    header.header_size = whole_number_of(value, file);
  } else if (name == "elementdatafile") {
    header.data_file = value;
  }
}

MetaHeader read_meta_header(HeaderFile& file) {
  MetaHeader header;
  while (header.data_file.empty()) {  // which is the last
    const std::string line = file.line();
    const std::size_t sign = line.find('=');
    if (line.empty()) continue;
    if (sign == std::string::npos) file.fail_line("is not that of a MetaImage.");
    read_field(lower_case(trimmed(line.substr(0, sign))),
               std::string(trimmed(line.substr(sign + 1))), file, header);
  }
  return header;
}

}  // namespace

std::unique_ptr<LabelVolume> open_meta_image(const std::string& path,
                                             const std::optional<Vector3>& voxel_size) {
  HeaderFile file(path);
  const MetaHeader header = read_meta_header(file);
  if (!header.has_sizes) refuse_volume(path, "does not say how large it is; export it again.");
  VolumeGeometry geometry;
  geometry.counts = voxel_counts(header.sizes, path);
  set_lattice(geometry, header.directions * header.spacing.asDiagonal(), header.origin, voxel_size,
              path);
  VoxelType type = voxel_type_of(header.type, path);
  type.big_endian = header.big_endian;

  const bool is_local = lower_case(header.data_file) == "local";
  VoxelData data;
  data.path = is_local ? path : voxel_file_beside(path, header.data_file);
  data.offset = is_local ? file.offset() : 0;
  data.is_packed = header.is_packed;
  data.at_end = header.header_size == -1 && !header.is_packed;
  if (header.header_size > 0) data.offset = static_cast<std::uint64_t>(header.header_size);
  return volume_of_file(geometry, type, data);
}

}  // namespace wscvt
