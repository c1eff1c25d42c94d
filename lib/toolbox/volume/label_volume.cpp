// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/label_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "toolbox/volume/image_stack.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/base/error.h"
#include "wscvt/base/file_name.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

struct Format {
  std::vector<std::string> endings;
  std::unique_ptr<LabelVolume> (*open)(const std::string& path, const VolumeChoice& choice);
};

const Format* format_of(const std::string& path) {
  static const std::vector<Format> formats = {
      {{".nrrd", ".nhdr"}, open_nrrd},
      {{".mhd", ".mha"}, open_meta_image},
      {{".vti"}, open_vti},
      {{".tif", ".tiff"}, open_tiff},
      {{".png"}, open_png},
      {{".nii", ".nii.gz"}, open_nifti},
      {{".npy"}, open_npy},
      {{".npz"}, open_npz},
      {{".vtk"}, open_legacy_vtk},
      {{".h5", ".hdf5", ".hdf", ".mat"}, open_hdf5},
      {{".json"}, open_raw},
  };
  std::string ending = ending_of(path);
  if (ending == ".gz") ending = ending_of(path.substr(0, path.size() - 3)) + ending;
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
    const std::string name = entry.path().filename().string();
    if (is_foreign_file(name)) continue;
    if (is_mesh_file(name)) return false;
    has_slices = has_slices || is_slice(name);
  }
  return has_slices;
}

/// Whether an old VTK file contains a mesh: meshes have the same ending.
bool holds_mesh(const std::string& path) {
  std::error_code error;
  if (ending_of(path) != ".vtk" || !fs::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  constexpr int most_lines = 5;
  constexpr std::streamsize longest = 300;
  std::array<char, longest> line{};
  for (int k = 0; k < most_lines && file.getline(line.data(), longest); ++k) {
    TextFields fields(line.data());
    if (lower_case(fields.next()) != "dataset") continue;
    const std::string kind = lower_case(fields.next());
    return kind == "polydata" || kind == "unstructured_grid";
  }
  return false;
}

/// Checks common to all formats.
void check_opened(LabelVolume& volume, const std::string& path) {
  const VolumeGeometry& geometry = volume.geometry();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (geometry.counts[axis] > 1) continue;
    refuse_volume(path, "is one image of " + std::to_string(geometry.counts[axis == 0 ? 1 : 0]) +
                            " x " + std::to_string(geometry.counts[axis == 2 ? 1 : 2]) +
                            " voxels, but grains need a stack of images. Give the folder of the "
                            "slices, or a file with all slices.");
  }
  if (!geometry.has_size) {
    volume.add_note("Voxel size not in the file: lengths in voxels. Give it by --voxel-size.");
  }
}

}  // namespace

bool is_volume(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return is_stack(path);
  return format_of(path) != nullptr && !holds_mesh(path);
}

std::unique_ptr<LabelVolume> open_volume(const std::string& path, const VolumeChoice& choice) {
  if (choice.voxel_size &&
      !(choice.voxel_size->allFinite() && choice.voxel_size->minCoeff() > 0.0)) {
    throw Error(ErrorCode::InvalidInput, "The size of a voxel has to be above 0 along each axis.");
  }
  std::error_code error;
  std::unique_ptr<LabelVolume> volume;
  if (fs::is_directory(path, error)) {
    volume = open_stack(path, choice);
  } else {
    const Format* const format = format_of(path);
    if (format == nullptr) {
      refuse("\"" + path +
             "\" does not have the ending of a volume. Give a .tif, .nrrd, .nhdr, .mhd, .mha, "
             ".vti, .vtk, "
             ".nii, .nii.gz, .npy, .npz, .h5 or .mat, the .json that describes a raw file, or a "
             "folder of .tif or .png files.");
    }
    volume = format->open(path, choice);
  }
  check_opened(*volume, path);
  return volume;
}

void refuse_array_choice(const VolumeChoice& choice, const std::string& path) {
  if (choice.array.empty()) return;
  refuse_volume(path, "has a format with only one array. Leave --array out.");
}

void set_lattice(VolumeGeometry& geometry, const Eigen::Matrix3d& axes, const Vector3& origin,
                 const VolumeChoice& choice, const std::string& path) {
  geometry.axes = axes;
  geometry.corner = origin - axes * Vector3::Constant(0.5);
  if (choice.voxel_size) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index axis = geometry.order[static_cast<std::size_t>(k)];
      geometry.axes.col(k) = (*choice.voxel_size)[axis] * Vector3::Unit(axis);
    }
    geometry.corner = Vector3::Zero();
    geometry.has_size = true;
    if (!choice.unit.empty()) geometry.unit = choice.unit;
  }
  const double volume = geometry.voxel_volume();
  if (std::isnormal(volume) && geometry.corner.allFinite()) return;
  refuse_volume(path,
                "gives its voxels no volume. Correct the spacing in it, or give --voxel-size.");
}

}  // namespace wscvt
