// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/open_volume.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
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

/// Opens a file that contains all slices.
template <OpenSlices open>
std::unique_ptr<LabelVolume> open_alone(const std::string& path, const VolumeChoice& choice) {
  return open({path, {path}}, choice);
}

const Format* format_of(const std::string& path) {
  static const std::vector<Format> formats = {
      {{".nrrd", ".nhdr"}, open_nrrd},
      {{".mhd", ".mha"}, open_meta_image},
      {{".vti"}, open_vti},
      {{".tif", ".tiff"}, open_alone<open_tiff_slices>},
      {{".png"}, open_alone<open_png_slices>},
      {{".bmp"}, open_alone<open_bmp_slices>},
      {{".nii", ".nii.gz"}, open_nifti},
      {{".npy"}, open_npy},
      {{".npz"}, open_npz},
      {{".vtk"}, open_legacy_vtk},
      {{".h5", ".hdf5", ".hdf", ".nxs", ".ims", ".dream3d", ".mat"}, open_hdf5},
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

std::string between_quotes(const std::string& text) { return "\"" + text + "\""; }

/// Whether a folder is an array of Zarr, of version 2 or 3, and no group of arrays.
bool is_array_of_zarr(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / ".zarray", error)) return true;
  std::ifstream file(folder / "zarr.json");
  const auto json = nlohmann::json::parse(file, nullptr, false);
  return json.is_object() && json.contains("node_type") && json["node_type"] == "array";
}

/// Returns the first array in a group of Zarr, as Python names it; empty for an array.
std::string array_in_zarr(const fs::path& folder) {
  if (is_array_of_zarr(folder)) return "";
  std::vector<std::string> names;
  std::error_code error;
  auto entry = fs::recursive_directory_iterator(folder, error);
  for (; entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (!entry->is_directory(error) || !is_array_of_zarr(entry->path())) continue;
    names.push_back(entry->path().lexically_relative(folder).generic_string());
    entry.disable_recursion_pending();
  }
  return names.empty() ? "" : *std::min_element(names.begin(), names.end());
}

std::string way_from_zarr(const std::string& path) {
  const std::string name = array_in_zarr(path);
  return "is Zarr, which wscvt does not read. Save the array as .npy in Python: import numpy, "
         "zarr; numpy.save(\"labels.npy\", zarr.open(" +
         between_quotes(path) + ", mode=\"r\")" +
         (name.empty() ? "" : "[" + between_quotes(name) + "]") + "[:])";
}

/// Returns what follows a word in a text, up to the end of the line; empty without the word.
std::string line_after(const std::string& text, const std::string& word) {
  const std::size_t place = text.find(word);
  if (place == std::string::npos) return "";
  const std::size_t begin = place + word.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// Returns the description of an AmiraMesh file as raw numbers, for a .json file beside it; empty
/// for packed numbers and for texts. The header is a text up to the line "@1".
std::string raw_description_of_amira(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(1 << 16, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t data = head.find("\n@1\n");
  if (data == std::string::npos || head.find("BINARY") > data) return "";
  head.resize(data + 4);
  const std::string size_line = line_after(head, "define Lattice");
  TextFields counts(size_line);
  std::string dimensions;
  for (int k = 0; k < 3; ++k) {
    const std::string count(counts.next());
    if (!whole_number_in(count)) return "";
    dimensions += (k == 0 ? "" : ", ") + count;
  }
  const std::string lattice_line = line_after(head, "Lattice {");
  TextFields lattice(lattice_line);
  const std::string amira(lattice.next());
  const std::vector<std::pair<const char*, const char*>> types = {
      {"byte", "uint8"}, {"ushort", "uint16"}, {"short", "int16"},
      {"int", "int32"},  {"float", "float32"}, {"double", "float64"}};
  const auto type = std::find_if(types.begin(), types.end(),
                                 [&](const auto& known) { return amira == known.first; });
  lattice.next();  // the name
  lattice.next();  // the end of the braces
  if (type == types.end() || trimmed(lattice.rest()) != "@1") return "";
  const bool is_little = head.find("LITTLE-ENDIAN") < data;
  return "{\"dimensions\": [" + dimensions + "], \"type\": \"" + type->second +
         "\", \"byte_order\": \"" + (is_little ? "little" : "big") +
         "\", \"offset\": " + std::to_string(head.size()) +
         ", \"file\": " + between_quotes(fs::path(path).filename().string()) + "}";
}

/// Returns a way from a format that is not read to one that is; empty for other formats and for
/// what does not exist. Each way was tried, see tests/volume/label_volume_test.cpp.
std::string way_from(const std::string& path) {
  std::error_code error;
  if (is_mesh_format(path, MeshUse::Read) || !fs::exists(path, error)) return "";
  const std::string ending = ending_of(path);
  bool has_dicom = ending == ".dcm" || ending == ".ima" || ending == ".dicom";
  bool is_zarr = ending == ".zarr";
  std::string folder = path;
  if (fs::is_directory(path, error)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
      const std::string name = entry.path().filename().string();
      if (is_mesh_file(name)) return "";
      is_zarr = is_zarr || name == ".zarray" || name == ".zgroup" || name == "zarr.json";
      has_dicom = has_dicom || (entry.is_regular_file(error) && is_dicom(entry.path()));
    }
  } else {
    has_dicom = has_dicom || is_dicom(path);
    folder = fs::path(path).parent_path().string();
  }
  if (has_dicom) {
    return "is DICOM, which wscvt does not read. The command dcm2niix -z y " +
           between_quotes(folder.empty() ? "." : folder) +
           " writes the series as a .nii.gz file into its folder. Give that file.";
  }
  if (is_zarr) return way_from_zarr(path);
  if (ending == ".am" || ending == ".amiramesh") {
    const std::string description = raw_description_of_amira(path);
    return "is AmiraMesh, which wscvt does not read. " +
           (description.empty()
                ? "Its voxels are packed, or a text: save it as 3D TIFF in Amira or Avizo."
                : "Its voxels are not packed: write a file labels.json beside it, with " +
                      description + ", and give that file with " + mention("voxel-size").text() +
                      ".");
  }
  if (ending == ".raw" || ending == ".vol") {
    return "is a raw file, which does not say its size. Write a .json file beside it, such as "
           "{\"dimensions\": [300, 300, 200], \"type\": \"uint16\", \"file\": \"" +
           fs::path(path).filename().string() + "\"}, and give that file.";
  }
  return "";
}

/// Throws Error(InputOutput) for a format that is not read, with the way from it.
void refuse_unread(const std::string& path) {
  std::error_code error;
  const bool is_read = fs::is_directory(path, error) ? is_stack(path) : format_of(path) != nullptr;
  const std::string way = is_read ? "" : way_from(path);
  if (!way.empty()) refuse_volume(path, way);
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
    volume.add_note("No voxel size found: lengths in voxels. Give it by " + mention("voxel-size") +
                    ".");
    return;
  }
  const Sentence source = choice.voxel_size              ? mention("voxel-size")
                          : geometry.size_source.empty() ? Sentence("the file's header")
                                                         : Sentence(geometry.size_source);
  volume.describe(counts + " voxels of " + sizes + (geometry.unit.empty() ? "" : " ") +
                  geometry.unit + ", from " + source + ".");
  const double oblique = std::abs(geometry.voxel_volume()) / lengths.prod();
  constexpr double square = 0.999;  // 2.5 degrees
  if (oblique < square) {
    volume.add_warning("The axes of the voxels are not perpendicular, from " + source +
                       ": the grains are sheared with them, but wscvt segment takes them for "
                       "perpendicular. If this is wrong, give the lengths by " +
                       mention("voxel-size", "X,Y,Z") + ".");
  }
  constexpr double longest = 5.0;
  const double ratio = lengths.maxCoeff() / lengths.minCoeff();
  if (ratio <= longest) return;
  volume.add_warning("The voxels are " + format_number(ratio) +
                     " times as long in one direction as in another: " + sizes +
                     ". Few scans have such voxels. Check " + source +
                     ", and give the right size by " + mention("voxel-size", "X,Y,Z") + ".");
}

void check_voxel_size(const VolumeChoice& choice) {
  if (choice.voxel_size &&
      !(choice.voxel_size->allFinite() && choice.voxel_size->minCoeff() > 0.0)) {
    refuse("The size of a voxel has to be above 0 along each axis.");
  }
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

void refuse_array_choice(const VolumeChoice& choice, const std::string& path) {
  if (choice.array.empty()) return;
  refuse_volume(path, "has a format with only one array. Leave " +
                          mention("select", "array=" + choice.array) + " out.");
}

void require_spacing(const Vector3& spacing, const VolumeChoice& choice, const std::string& path) {
  if (choice.voxel_size || (spacing.allFinite() && spacing.minCoeff() > 0.0)) return;
  refuse_volume(path, "has the spacing " + format_number(spacing[0]) + ", " +
                          format_number(spacing[1]) + ", " + format_number(spacing[2]) +
                          ", but the lengths of a voxel are above 0. Correct it, or give " +
                          mention("voxel-size") + ".");
}

double decimal_of(double value) {
  const auto single = static_cast<float>(value);
  if (!std::isfinite(value) || static_cast<double>(single) != value) return value;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), single).ptr;
  return number_in({text.data(), static_cast<std::size_t>(end - text.data())}).value_or(value);
}

void set_lattice(VolumeGeometry& geometry, const Eigen::Matrix3d& axes, const Vector3& origin,
                 const VolumeChoice& choice, const std::string& path) {
  geometry.axes = axes.unaryExpr(&decimal_of);
  geometry.corner = origin.unaryExpr(&decimal_of) - geometry.axes * Vector3::Constant(0.5);
  if (choice.voxel_size) {
    const double handedness = axes.determinant();
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index axis = geometry.order[static_cast<std::size_t>(k)];
      geometry.axes.col(k) = (*choice.voxel_size)[axis] * Vector3::Unit(axis);
    }
    // The file's directions are replaced too, but no grain becomes its mirror image.
    if (handedness * geometry.axes.determinant() < 0.0) geometry.axes.row(0) *= -1.0;
    geometry.corner = Vector3::Zero();
    geometry.has_size = true;
    if (!choice.unit.empty()) geometry.unit = choice.unit;
  }
  const double volume = geometry.voxel_volume();
  if (std::isnormal(volume) && geometry.corner.allFinite()) return;
  refuse_volume(path, "gives its voxels no volume. Correct the spacing in it, or give " +
                          mention("voxel-size") + ".");
}

bool is_volume(const std::string& path) {
  std::error_code error;
  const bool is_read = fs::is_directory(path, error)
                           ? is_stack(path)
                           : format_of(path) != nullptr && !holds_mesh(path);
  return is_read || !way_from(path).empty();
}

void refuse_volume_input(const std::string& path, const std::string& ways) {
  std::error_code error;
  if (!fs::exists(path, error) || !is_volume(path)) return;
  refuse_unread(path);
  refuse("\"" + path + "\" is a volume, not a mesh or a table. " + ways);
}

std::unique_ptr<LabelVolume> open_volume(const std::string& path, const VolumeChoice& choice) {
  check_voxel_size(choice);
  std::error_code error;
  std::unique_ptr<LabelVolume> volume;
  refuse_unread(path);
  if (fs::is_directory(path, error)) {
    volume = open_stack(path, choice);
  } else {
    const Format* const format = format_of(path);
    if (format == nullptr) {
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

std::unique_ptr<LabelVolume> open_array(const VolumeArray& array, const VolumeChoice& choice,
                                        const std::string& name) {
  check_voxel_size(choice);
  try {
    std::unique_ptr<LabelVolume> volume = volume_of_array(array, choice, name);
    check_opened(*volume, choice, name);
    return volume;
  } catch (const Error& error) {
    refuse(error.sentence());  // no file is wrong
  }
}

}  // namespace wscvt
