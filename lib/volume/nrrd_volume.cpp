// SPDX-License-Identifier: GPL-3.0-or-later
// NRRD as Teem defines it: http://teem.sourceforge.net/nrrd/format.html
#include "volume/header_file.h"
#include "volume/volume_formats.h"
#include "volume/voxel_rows.h"
#include "wscvt/scan/text_fields.h"

namespace wscvt {

namespace {

struct NrrdHeader {
  std::array<std::int64_t, 3> sizes = {};
  bool has_sizes = false;
  std::string type;
  std::string encoding = "raw";
  bool big_endian = false;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Vector3 origin = Vector3::Zero();
  std::string unit;
  std::string data_file;
  std::int64_t line_skip = 0;
  std::int64_t byte_skip = 0;
};

/// The first text in quotes: of three axes the units are one in all that we have seen.
std::string quoted_in(std::string_view text) {
  const std::size_t begin = text.find('"');
  if (begin == std::string_view::npos) return "";
  const std::size_t end = text.find('"', begin + 1);
  return end == std::string_view::npos ? "" : std::string(text.substr(begin + 1, end - begin - 1));
}

void read_field(const std::string& name, const std::string& value, const HeaderFile& file,
                NrrdHeader& header) {
  if (name == "dimension") {
    if (value != "3")
      file.fail_line("says that it has not three dimensions; save one volume alone.");
  } else if (name == "sizes") {
    header.sizes = whole_vector_in(value, file);
    header.has_sizes = true;
  } else if (name == "type") {
    header.type = value;
  } else if (name == "encoding") {
    header.encoding = lower_case(value);
  } else if (name == "endian") {
    header.big_endian = lower_case(value) == "big";
  } else if (name == "spacings") {
    header.axes = vector_in(value, file).asDiagonal();
  } else if (name == "space directions") {
    const std::vector<double> numbers = numbers_in(value, file);
    if (numbers.size() != 9) file.fail_line("does not have three directions of three numbers.");
    for (Eigen::Index k = 0; k < 9; ++k) {
      header.axes(k % 3, k / 3) = numbers[static_cast<std::size_t>(k)];
    }
  } else if (name == "space origin") {
    header.origin = vector_in(value, file);
  } else if (name == "space units" || name == "units") {
    header.unit = quoted_in(value);
  } else if (name == "data file" || name == "datafile") {
    header.data_file = value;
  } else if (name == "line skip" || name == "lineskip") {
    header.line_skip = whole_number_of(value, file);
  } else if (name == "byte skip" || name == "byteskip") {
    header.byte_skip = whole_number_of(value, file);
  }
}

NrrdHeader read_nrrd_header(HeaderFile& file) {
  if (file.line().rfind("NRRD000", 0) != 0) file.fail_line("is not that of an NRRD file.");
  NrrdHeader header;
  while (!file.is_at_end()) {
    const std::string line = file.line();
    if (line.empty()) break;
    const std::size_t colon = line.find(':');
    if (line.front() == '#' || colon == std::string::npos) continue;
    if (line.substr(colon, 2) == ":=") continue;  // a remark by key and value
    read_field(lower_case(trimmed(line.substr(0, colon))),
               std::string(trimmed(line.substr(colon + 1))), file, header);
  }
  return header;
}

}  // namespace

std::unique_ptr<LabelVolume> open_nrrd(const std::string& path,
                                       const std::optional<Vector3>& voxel_size) {
  HeaderFile file(path);
  const NrrdHeader header = read_nrrd_header(file);
  if (!header.has_sizes) refuse_volume(path, "does not say how large it is; export it again.");
  VolumeGeometry geometry;
  geometry.counts = voxel_counts(header.sizes, path);
  geometry.unit = header.unit;
  set_lattice(geometry, header.axes, header.origin, voxel_size, path);
  VoxelType type = voxel_type_of(header.type, path);
  type.big_endian = header.big_endian;

  VoxelData data;
  data.is_packed = header.encoding == "gzip" || header.encoding == "gz";
  if (!data.is_packed && header.encoding != "raw") {
    refuse_volume(path, "is packed as " + in_quotes(header.encoding) + "; save it raw or as gzip.");
  }
  data.path = header.data_file.empty() ? path : voxel_file_beside(path, header.data_file);
  data.offset = header.data_file.empty() ? file.offset() : 0;
  data.at_end = header.byte_skip == -1 && header.line_skip == 0 && !data.is_packed;
  if (!data.at_end && (header.byte_skip != 0 || header.line_skip != 0)) {
    const bool is_known = !data.is_packed && header.line_skip == 0 && header.byte_skip > 0;
    if (!is_known) refuse_volume(path, "skips lines, or bytes of what is packed; save it anew.");
    data.offset += static_cast<std::uint64_t>(header.byte_skip);
  }
  return volume_of_file(geometry, type, data);
}

}  // namespace wscvt
