// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/label_volume.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "volume/volume_formats.h"
#include "volume/voxel_rows.h"
#include "wscvt/base/error.h"
#include "wscvt/base/file_name.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

struct Format {
  std::vector<std::string> endings;
  std::unique_ptr<LabelVolume> (*open)(const std::string& path,
                                       const std::optional<Vector3>& voxel_size);
};

const Format* format_of(const std::string& path) {
  static const std::vector<Format> formats = {
      {{".nrrd", ".nhdr"}, open_nrrd},
      {{".mhd", ".mha"}, open_meta_image},
      {{".vti"}, open_vti},
      {{".tif", ".tiff"}, open_tiff},
      {{".json"}, open_raw},
  };
  const std::string ending = ending_of(path);
  for (const Format& format : formats) {
    if (std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end()) {
      return &format;
    }
  }
  return nullptr;
}

/// Whether a folder is a stack of slices.
bool is_stack(const std::string& folder) {
  bool has_slices = false;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (is_mesh_file(entry.path().string())) return false;
    const std::string ending = ending_of(entry.path().string());
    has_slices = has_slices || ending == ".tif" || ending == ".tiff";
  }
  return has_slices;
}

}  // namespace

bool is_volume(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error) ? is_stack(path) : format_of(path) != nullptr;
}

std::unique_ptr<LabelVolume> open_volume(const std::string& path,
                                         const std::optional<Vector3>& voxel_size) {
  if (voxel_size && !(voxel_size->allFinite() && voxel_size->minCoeff() > 0.0)) {
    throw Error(ErrorCode::InvalidInput, "The size of a voxel has to be above 0 along each axis.");
  }
  std::error_code error;
  if (fs::is_directory(path, error)) return open_tiff(path, voxel_size);
  const Format* const format = format_of(path);
  if (format == nullptr) {
    refuse("\"" + path +
           "\" is no volume by its ending; give a .tif, .nrrd, .nhdr, .mhd, .mha, .vti, or the "
           ".json that describes a raw file, or a folder of .tif files.");
  }
  return format->open(path, voxel_size);
}

void set_lattice(VolumeGeometry& geometry, const Eigen::Matrix3d& axes, const Vector3& origin,
                 const std::optional<Vector3>& voxel_size, const std::string& path) {
  geometry.axes = voxel_size ? Eigen::Matrix3d(voxel_size->asDiagonal()) : axes;
  geometry.corner =
      voxel_size ? Vector3(Vector3::Zero()) : Vector3(origin - axes * Vector3::Constant(0.5));
  const double volume = geometry.voxel_volume();
  if (std::isnormal(volume) && geometry.corner.allFinite()) return;
  refuse_volume(path,
                "gives its voxels no volume; correct the spacing in it, or give --voxel-size.");
}

}  // namespace wscvt
