// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/open_volume.h"

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
#include "wscvt/base/sentence.h"
#include "wscvt/base/text_format.h"
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
      {{".bmp"}, open_bmp},
      {{".nii", ".nii.gz"}, open_nifti},
      {{".npy"}, open_npy},
      {{".npz"}, open_npz},
      {{".vtk"}, open_legacy_vtk},
      {{".h5", ".hdf5", ".hdf", ".dream3d", ".mat"}, open_hdf5},
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

/// Whether a file has the mark of DICOM.
bool is_dicom(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 132> head{};
  return file.read(head.data(), head.size()) && std::string(head.data() + 128, 4) == "DICM";
}

/// Returns a way from a format that is not read to one that is; empty for unknown formats. Each way
/// is documented by the program that it names.
std::string way_from(const std::string& path) {
  std::error_code error;
  const std::string ending = ending_of(path);
  bool has_dicom = ending == ".dcm" || ending == ".ima" || ending == ".dicom";
  bool is_zarr = ending == ".zarr";
  if (fs::is_directory(path, error)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
      const std::string name = entry.path().filename().string();
      is_zarr = is_zarr || name == ".zarray" || name == ".zgroup" || name == "zarr.json";
      has_dicom = has_dicom || (entry.is_regular_file(error) && is_dicom(entry.path()));
    }
  } else {
    has_dicom = has_dicom || is_dicom(path);
  }
  if (has_dicom) {
    return "is DICOM, which wscvt does not read. Convert the folder of the series by \"dcm2niix -z "
           "y "
           "FOLDER\", or open it in 3D Slicer and save the volume as .nrrd.";
  }
  if (is_zarr) {
    return "is Zarr, which wscvt does not read. Save the array as .npy in Python: import numpy, "
           "zarr; numpy.save(\"labels.npy\", zarr.open(\"FOLDER\", mode=\"r\")[:]). If the folder "
           "holds several arrays, name one: zarr.open(...)[\"0\"][:].";
  }
  if (ending == ".am" || ending == ".amiramesh") {
    return "is AmiraMesh, which wscvt does not read. Open it in Fiji by File > Import > Amira, and "
           "save it by File > Save As > Tiff; or export it as TIFF from Amira or Avizo.";
  }
  if (ending == ".raw" || ending == ".vol") {
    return "is a raw file, which does not say its size. Write a .json file beside it, such as "
           "{\"dimensions\": [300, 300, 200], \"type\": \"uint16\", \"file\": \"" +
           fs::path(path).filename().string() + "\"}, and give that file.";
  }
  return "";
}

/// Says in one sentence what was read, and warns of voxels that are long beyond any scan's.
void describe(LabelVolume& volume, const VolumeChoice& choice) {
  const VolumeGeometry& geometry = volume.geometry();
  std::string counts;
  std::string sizes;
  Vector3 lengths;  // along the file's x, y and z
  for (Eigen::Index k = 0; k < 3; ++k) {
    lengths[geometry.order[static_cast<std::size_t>(k)]] = geometry.axes.col(k).norm();
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto found = std::find(geometry.order.begin(), geometry.order.end(), axis);
    const auto place = static_cast<std::size_t>(found - geometry.order.begin());
    counts += (axis == 0 ? "" : " x ") + std::to_string(geometry.counts[place]);
    sizes += (axis == 0 ? "" : " x ") + format_number(lengths[axis], 4);
  }
  if (!geometry.has_size) {
    volume.describe(counts + " voxels.");
    volume.add_note("Voxel size not in the file: lengths in voxels. Give it by " +
                    mention("voxel-size") + ".");
    return;
  }
  const Sentence source = choice.voxel_size              ? mention("voxel-size")
                          : geometry.size_source.empty() ? Sentence("the file's header")
                                                         : Sentence(geometry.size_source);
  volume.describe(counts + " voxels of " + sizes + (geometry.unit.empty() ? "" : " ") +
                  geometry.unit + ", from " + source + ".");
  constexpr double longest = 5.0;
  const double ratio = lengths.maxCoeff() / lengths.minCoeff();
  if (ratio <= longest) return;
  volume.add_warning("The voxels are " + format_number(ratio) +
                     " times as long in one direction as in another: " + sizes +
                     ". Few scans have such voxels. Check " + source +
                     ", and give the right size by " + mention("voxel-size", "X,Y,Z") + ".");
}

/// Checks common to all formats.
void check_opened(LabelVolume& volume, const VolumeChoice& choice, const std::string& path) {
  const VolumeGeometry& geometry = volume.geometry();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (geometry.counts[axis] > 1) continue;
    refuse_volume(path, "is one image of " + std::to_string(geometry.counts[axis == 0 ? 1 : 0]) +
                            " x " + std::to_string(geometry.counts[axis == 2 ? 1 : 2]) +
                            " voxels, but grains need a stack of images. Give the folder of the "
                            "slices, or a file with all slices.");
  }
  describe(volume, choice);
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
    const std::string way = is_stack(path) ? "" : way_from(path);
    if (!way.empty()) refuse_volume(path, way);
    volume = open_stack(path, choice);
  } else {
    const Format* const format = format_of(path);
    if (format == nullptr) {
      const std::string way = way_from(path);
      if (!way.empty()) refuse_volume(path, way);
      refuse("\"" + path +
             "\" does not have the ending of a volume. Give a .tif, .nrrd, .nhdr, .mhd, .mha, "
             ".vti, .vtk, "
             ".nii, .nii.gz, .npy, .npz, .h5 or .mat, the .json that describes a raw file, or a "
             "folder of .tif, .png or .bmp files.");
    }
    volume = format->open(path, choice);
  }
  check_opened(*volume, choice, path);
  return volume;
}

}  // namespace wscvt
