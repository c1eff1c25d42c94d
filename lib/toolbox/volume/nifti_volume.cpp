// SPDX-License-Identifier: GPL-3.0-or-later
// NIfTI. libnifti2 reads the header, of both versions and byte orders, and computes the axes. It
// can read voxels only all at once: a volume of 4 gigavoxels would need 8 GB. So they are read
// here, row by row.
#include <algorithm>
#include <memory>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#ifdef WSCVT_HAS_NIFTI
#include <nifti2_io.h>

#include <cmath>
#include <mutex>

#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/byte_reader.h"
#endif

namespace wscvt {

#ifdef WSCVT_HAS_NIFTI

namespace {

/// Returns the type of a data type code of the header.
VoxelType type_of(int code, const std::string& path) {
  const std::string name = nifti_datatype_string(code);
  if (const std::optional<VoxelType> type = known_voxel_type(name)) return *type;
  refuse_volume(path, "has voxels of NIfTI's type " + name + ". Save labels as whole numbers.");
}

/// Reads a signed whole number from a header.
std::int64_t number_at(const std::string& head, std::size_t place, std::size_t size, bool big) {
  return load_as<std::int64_t>(size == 2   ? Stored::Int16
                               : size == 4 ? Stored::Int32
                                           : Stored::Int64,
                               big ? boost::endian::order::big : boost::endian::order::little,
                               head.data() + place);
}

/// Refuses headers that libnifti2 would refuse, because it always prints this to the standard
/// error. Returns whether its voxels have lengths: the library replaces 0 by 1.
bool check_header(const std::string& path) {
  std::unique_ptr<ByteSource> bytes = file_bytes(path, 0);
  if (ending_of(path) == ".gz") bytes = inflated_bytes(std::move(bytes), path);
  std::string head(540, '\0');
  head.resize(bytes->read(head.data(), head.size()));
  const auto is_of = [&](std::size_t size, const char* magic, std::size_t place, bool big) {
    return head.size() >= size && number_at(head, 0, 4, big) == static_cast<std::int64_t>(size) &&
           head.compare(place, 4, std::string(magic) + '\0') == 0;
  };
  for (const bool big : {false, true}) {
    const bool is_first = is_of(348, "n+1", 344, big);
    if (!is_first && !is_of(540, "n+2", 4, big)) continue;
    type_of(static_cast<int>(number_at(head, is_first ? 70 : 12, 2, big)), path);
    const std::size_t size = is_first ? 2 : 8;
    const std::size_t place = is_first ? 40 : 16;
    const std::int64_t dimensions = number_at(head, place, size, big);
    for (std::int64_t k = 1; k <= 7; ++k) {
      const std::int64_t count =
          number_at(head, place + static_cast<std::size_t>(k) * size, size, big);
      if (dimensions < 1 || dimensions > 7 || (k <= dimensions && count < 1)) {
        refuse_volume(path, "has a NIfTI header with dimensions below 1. Export it again.");
      }
    }
    const std::size_t length = is_first ? 4 : 8;
    const std::size_t lengths = is_first ? 76 : 104;
    bool have_lengths = true;
    for (std::size_t k = 1; k <= 3; ++k) {
      // Twice the bits of -0 and 0 are 0.
      const auto bits =
          static_cast<std::uint64_t>(number_at(head, lengths + k * length, length, big));
      have_lengths = have_lengths && bits << (65 - 8 * length) != 0;
    }
    return have_lengths;
  }
  refuse_volume(path, "is not a NIfTI file of one part. Save it as .nii or .nii.gz.");
}

struct FreeImage {
  void operator()(nifti_image* image) const { nifti_image_free(image); }
};
using NiftiImage = std::unique_ptr<nifti_image, FreeImage>;

NiftiImage header_of(const std::string& path) {
  // The library stores its verbosity in a global.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  nifti_set_debug_level(0);
  NiftiImage image(nifti_image_read(path.c_str(), 0));
  if (!image) refuse_volume(path, "is not a NIfTI file, or is damaged. Export it again.");
  return image;
}

std::string unit_of_code(int code) {
  if (code == NIFTI_UNITS_METER) return "m";
  if (code == NIFTI_UNITS_MM) return "mm";
  return code == NIFTI_UNITS_MICRON ? "um" : "";
}

void set_geometry(const nifti_image& image, bool have_lengths, const VolumeChoice& choice,
                  const std::string& path, VolumeGeometry& geometry) {
  geometry.counts = voxel_counts({image.nx, image.ny, image.nz}, path);
  // sform, qform, or only the sizes, in this order of preference.
  const Vector3 lengths(image.dx, image.dy, image.dz);
  Eigen::Matrix3d axes = lengths.asDiagonal();
  Vector3 origin = Vector3::Zero();
  if (image.sform_code > 0 || image.qform_code > 0) {
    const nifti_dmat44& placed = image.sform_code > 0 ? image.sto_xyz : image.qto_xyz;
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column) axes(row, column) = placed.m[row][column];
      origin[row] = placed.m[row][3];
    }
    // The library makes these axes from lengths of single precision.
    for (Eigen::Index k = 0; image.sform_code <= 0 && k < 3; ++k) {
      axes.col(k) *= decimal_of(lengths[k]) / lengths[k];
    }
  }
  geometry.has_size = have_lengths || image.sform_code > 0;
  if (geometry.has_size) geometry.unit = unit_of_code(image.xyz_units);
  set_lattice(geometry, axes, origin, choice, path);
}

std::unique_ptr<LabelVolume> volume_of_voxels(const VolumeGeometry& geometry, const VoxelType& type,
                                              const VoxelData& data) {
  const std::string path = data.paths.front();
  if (ending_of(path) != ".gz") return volume_of_files(geometry, type, data);
  // The offset is in the unpacked bytes.
  check_voxel_bytes(stored_bytes(geometry.counts, type, data.picks), file_size(path),
                    Packing::Deflate, path);
  return volume_of_bytes(
      geometry, type, data.picks,
      [path, offset = data.offset] {
        std::unique_ptr<ByteSource> bytes = inflated_bytes(file_bytes(path, 0), path);
        bytes->skip(offset);
        return bytes;
      },
      path);
}

/// Warns if the sform, which is used, has other lengths of voxels than the rest of the header.
void compare_lengths(const nifti_image& image, bool have_lengths, const VolumeChoice& choice,
                     LabelVolume& volume) {
  if (image.sform_code <= 0 || !have_lengths || choice.voxel_size) return;
  const Vector3 used = volume.geometry().axes.colwise().norm();
  const Vector3 others = Vector3(image.dx, image.dy, image.dz).cwiseAbs();
  constexpr double rounding = 1e-3;
  if ((used - others).cwiseAbs().cwiseQuotient(used).maxCoeff() < rounding) return;
  const auto text = [](const Vector3& lengths) {
    return format_number(lengths[0], 4) + " x " + format_number(lengths[1], 4) + " x " +
           format_number(lengths[2], 4);
  };
  volume.add_warning("The header has two sizes of voxels: " + text(used) + " in its sform, " +
                     text(others) + " in its pixdim. The sform's was used. If it is wrong, give " +
                     mention("voxel-size", "X,Y,Z") + ".");
}

/// Adds a whole number to the voxels, such as the -1024 of CT in DICOM. Other scales are left out:
/// they change no order of grey values, but are not of labels.
void apply_scale(const nifti_image& image, const std::string& path, LabelVolume& volume) {
  const double slope = image.scl_slope;
  const double more = image.scl_inter;
  if (slope == 0.0 || (slope == 1.0 && more == 0.0)) return;
  constexpr double most = 1e9;
  if (slope == 1.0 && more == std::floor(more) && std::abs(more) < most) {
    volume.set_offset(static_cast<std::int64_t>(more));
    volume.add_note("The header's " + format_number(more, 10) +
                    " was added to the file's numbers.");
    return;
  }
  const std::string scale =
      "scales its voxels by " + format_number(slope, 6) + " and adds " + format_number(more, 6);
  volume.refuse_labels(
      "\"" + path + "\" " + scale +
      ", so they are not labels. Save them unscaled. If they are grey values, label "
      "the grains by wscvt segment.");
  volume.add_note("The header " + scale + ". Grey values are the file's numbers without this.");
}

}  // namespace

std::unique_ptr<LabelVolume> open_nifti(const std::string& path, const VolumeChoice& choice) {
  refuse_array_choice(choice, path);
  const bool have_lengths = check_header(path);
  const NiftiImage image = header_of(path);
  if (image->nifti_type != NIFTI_FTYPE_NIFTI1_1 && image->nifti_type != NIFTI_FTYPE_NIFTI2_1) {
    refuse_volume(path, "is not a NIfTI file of one part. Save it as .nii or .nii.gz.");
  }
  VolumeGeometry geometry;
  set_geometry(*image, have_lengths, choice, path, geometry);
  VoxelType type = type_of(image->datatype, path);
  constexpr int msb_first = 2;  // the library does not export its name for it
  type.big_endian = image->byteorder == msb_first;
  const std::int64_t more = std::max<std::int64_t>(1, image->nu) *
                            std::max<std::int64_t>(1, image->nv) *
                            std::max<std::int64_t>(1, image->nw);
  VoxelData data;
  data.paths = {path};
  data.offset = static_cast<std::uint64_t>(std::max<std::int64_t>(0, image->iname_offset));
  data.picks = picks_of({{AxisKind::Space, image->nx},
                         {AxisKind::Space, image->ny},
                         {AxisKind::Space, image->nz},
                         {AxisKind::Frame, std::max<std::int64_t>(1, image->nt)},
                         {AxisKind::Channel, more}},
                        choice, path);
  std::unique_ptr<LabelVolume> volume = volume_of_voxels(geometry, type, data);
  apply_scale(*image, path, *volume);
  compare_lengths(*image, have_lengths, choice, *volume);
  return volume;
}

#else

std::unique_ptr<LabelVolume> open_nifti(const std::string& path, const VolumeChoice&) {
  refuse_without(path, "libnifti2", "libnifti2-dev");
}

#endif

}  // namespace wscvt
