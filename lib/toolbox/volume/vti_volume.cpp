// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's XML ImageData. Not read by VTK itself: its development package brings 239 packages and 275
// MB to a bare Debian 12, its library 100 MB to users of the program. ITK, 47 packages and 40 MB,
// reads no .vti, and reads NRRD and TIFF only whole.
#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"
#include "wscvt/mesh_files/vtk_xml.h"
#ifdef WSCVT_HAS_PACKERS
#include <lz4.h>
#endif

namespace wscvt {

namespace {

#ifdef WSCVT_HAS_PACKERS
bool unpack_lz4(const std::vector<char>& packed, std::vector<char>& made) {
  const auto size = static_cast<int>(made.size());
  return ::LZ4_decompress_safe(packed.data(), made.data(), static_cast<int>(packed.size()), size) ==
         size;
}
#else
constexpr UnpackBlock unpack_lz4 = nullptr;
#endif

template <std::size_t Count>
std::array<double, Count> numbers_of(const XmlAttributes& attributes, const std::string& key,
                                     const std::string& fallback, const std::string& path) {
  std::array<double, Count> numbers{};
  const std::string text = value_of(attributes, key, fallback);
  TextFields fields(text);
  for (double& number : numbers) {
    const std::optional<double> value = number_in(fields.next());
    if (!value)
      refuse_volume(path, "has " + in_quotes(text) + " as its " + key + ". Export it again.");
    number = *value;
  }
  return numbers;
}

/// Returns the first and last points along each axis: x0 x1 y0 y1 z0 z1.
std::array<std::int64_t, 6> extent_of(const VtkXml& header, const std::string& path) {
  std::array<std::int64_t, 6> extent{};
  const std::string whole = value_of(header.image, "WholeExtent");
  const std::string text = value_of(header.pieces.front().attributes, "Extent", whole);
  if (text != whole || header.pieces.size() > 1) {
    refuse_volume(path, "is in pieces, or has a part of the image. Save it in one piece.");
  }
  TextFields fields(text);
  for (std::int64_t& place : extent) {
    const std::optional<std::int64_t> number = whole_number_in(fields.next());
    constexpr std::int64_t farthest = 1000000000;
    if (!number || *number > farthest || *number < -farthest) {
      refuse_volume(path, "has " + in_quotes(text) + " as its extent. Export it again.");
    }
    place = *number;
  }
  return extent;
}

VolumeGeometry geometry_of(const VtkXml& header, bool of_cells, const VolumeChoice& choice,
                           const std::string& path) {
  const std::array<std::int64_t, 6> extent = extent_of(header, path);
  const int more = of_cells ? 0 : 1;
  VolumeGeometry geometry;
  geometry.has_size = header.image.count("Spacing") > 0;
  geometry.counts = voxel_counts(
      {extent[1] - extent[0] + more, extent[3] - extent[2] + more, extent[5] - extent[4] + more},
      path);
  const auto origin = numbers_of<3>(header.image, "Origin", "0 0 0", path);
  const auto spacing = numbers_of<3>(header.image, "Spacing", "1 1 1", path);
  const auto direction = numbers_of<9>(header.image, "Direction", "1 0 0 0 1 0 0 0 1", path);
  Eigen::Matrix3d axes;
  for (Eigen::Index k = 0; k < 9; ++k) {
    axes(k / 3, k % 3) =
        direction[static_cast<std::size_t>(k)] * spacing[static_cast<std::size_t>(k % 3)];
  }
  const Vector3 first(static_cast<double>(extent[0]), static_cast<double>(extent[2]),
                      static_cast<double>(extent[4]));
  require_spacing({spacing[0], spacing[1], spacing[2]}, choice, path);
  const double to_centre = of_cells ? 0.5 : 0.0;
  set_lattice(
      geometry, axes,
      Vector3(origin[0], origin[1], origin[2]) + axes * (first + Vector3::Constant(to_centre)),
      choice, path);
  return geometry;
}

}  // namespace

std::unique_ptr<LabelVolume> open_vti(const std::string& path, const VolumeChoice& choice) {
  const std::uint64_t size = file_size(path);
  const VtkXml header = read_vtk_xml(file_bytes(path, 0));
  std::vector<XmlArray> arrays;
  std::vector<std::string> names;
  for (const XmlPiece& piece : header.pieces) {
    for (const XmlArray& array : piece.arrays) {
      if (array.section != "PointData" && array.section != "CellData") continue;
      arrays.push_back(array);
      names.push_back(array.name);
    }
  }
  // A file that was cut has arrays too.
  if (arrays.empty()) {
    refuse_volume(path, std::string(header.is_whole ? "holds no array of labels"
                                                    : "is not the XML of a .vti file") +
                            ". Export it again.");
  }
  const XmlArray& array = arrays[chosen_array(names, choice, path)];
  VoxelType type = voxel_type_of(value_of(array.attributes, "type"), path);
  type.big_endian = order_of(header.file) == boost::endian::order::big;
  const std::optional<std::int64_t> components =
      whole_number_in(value_of(array.attributes, "NumberOfComponents", "1"));
  const VolumeGeometry geometry = geometry_of(header, array.section == "CellData", choice, path);
  const std::vector<BlockPick> picks =
      picks_of({{AxisKind::Channel, components.value_or(0)}}, choice, path);

  const std::string format = value_of(array.attributes, "format", "ascii");
  const std::uint64_t begin = array.data;
  if (begin == 0) refuse_volume(path, "has no appended data. Export it again.");
  const std::uint64_t left = size - std::min(size, begin);
  std::uint64_t wanted = stored_bytes(geometry.counts, type, picks);
  OpenBytes open;
  if (format == "ascii") {
    wanted = wanted / static_cast<std::uint64_t>(type.bytes) * sizeof(double);
    check_voxel_bytes(wanted, left, Packing::Text, path);
    type = {sizeof(double), true, true, false};
    open = [=] { return bytes_of_numbers(file_bytes(path, begin), path); };
  } else if (format == "appended" || format == "binary") {
    VtkPacking packing(
        header.file, [path](const std::string& what) { refuse_volume(path, what); }, unpack_lz4);
    packing.cut = "has another number of bytes than its size needs, " + std::to_string(wanted) +
                  ". Copy it again, or export it again.";
    packing.damaged =
        "holds packed voxels that are damaged. Copy the file again, or export it again.";
    check_voxel_bytes(wanted, array.is_base64 ? left / 4 * 3 : left,
                      packing.unpack == nullptr ? Packing::None : Packing::Deflate, path);
    open = [=] {
      std::uint64_t stored = 0;
      auto bytes = vtk_array_bytes(file_bytes(path, begin), left, array.is_base64, packing, stored);
      if (stored != wanted) packing.refuse(packing.cut);
      return bytes;
    };
  } else {
    refuse_volume(
        path, "has its voxels as " + in_quotes(format) + ". Save it ascii, binary or appended.");
  }
  return volume_of_bytes(geometry, type, picks, std::move(open), path);
}

}  // namespace wscvt
