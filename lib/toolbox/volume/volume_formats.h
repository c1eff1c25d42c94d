// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/error.h"

namespace wscvt {

struct VolumeArray;  // open_volume.h

// One function per format; see open_volume for what each reads and throws.

std::unique_ptr<LabelVolume> open_nrrd(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_meta_image(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_vti(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_nifti(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_npy(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_npz(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_legacy_vtk(const std::string& path, const VolumeChoice& choice);

/// Opens an array in memory, see VolumeArray. `name` is for messages.
std::unique_ptr<LabelVolume> volume_of_array(const VolumeArray& array, const VolumeChoice& choice,
                                             const std::string& name);

/// Opens HDF5, and MATLAB's files from version 7.3 on.
std::unique_ptr<LabelVolume> open_hdf5(const std::string& path, const VolumeChoice& chosen);

/// Opens a raw file described by a JSON object with "dimensions", [x, y, z], "type", such as
/// "uint16", and if needed:
/// - "byte_order": "little" (the default) or "big";
/// - "spacing": [x, y, z] or one number;
/// - "origin": the centre of the first voxel;
/// - "unit";
/// - "offset": bytes before the first voxel;
/// - "file": the raw file beside it; the default is this file's name with the ending .raw.
std::unique_ptr<LabelVolume> open_raw(const std::string& path, const VolumeChoice& choice);

/// Opens a folder of slices, each an image: TIFF, PNG or BMP.
std::unique_ptr<LabelVolume> open_stack(const std::string& path, const VolumeChoice& choice);

/// Returns whether a file is a hidden one from a system: "._s03.tif", "Thumbs.db", ".DS_Store".
bool is_foreign_file(const std::string& name);

/// Returns whether a name is a slice's, by its ending.
bool is_slice(const std::string& name);

/// The slices of a volume.
struct SliceFiles {
  std::string folder;              ///< or the file, if it contains all slices
  std::vector<std::string> paths;  ///< in the order of the numbers in their names
};

using OpenSlices = std::unique_ptr<LabelVolume> (*)(const SliceFiles& slices,
                                                    const VolumeChoice& choice);

/// Opens slices that are files of one page, or the pages of the only file. Throws as open_volume
/// does, and Error(InputOutput) naming the first slice whose size or type differs from the previous
/// ones.
std::unique_ptr<LabelVolume> open_tiff_slices(const SliceFiles& slices, const VolumeChoice& choice);

/// A slice, unpacked.
struct SliceImage {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::string numbers;        ///< of each voxel, for messages: "3 x 8 bits"
  std::size_t channels = 1;   ///< numbers of each voxel
  std::size_t bytes = 1;      ///< of each number, the most significant first
  std::vector<char> content;  ///< rows from above
};

/// Reads a file; without `content` only its form. Throws Error(InputOutput), naming it.
using ReadSlice = SliceImage (*)(const std::string& path, bool with_content);

/// Opens slices that are files of one image each, in the same way. Without a chosen channel, three
/// equal colours are one, and transparency is no channel of labels.
std::unique_ptr<LabelVolume> open_images(const SliceFiles& slices, const VolumeChoice& choice,
                                         ReadSlice read);

/// Opens slices that are PNG files, in the same way.
std::unique_ptr<LabelVolume> open_png_slices(const SliceFiles& slices, const VolumeChoice& choice);

/// Opens slices that are BMP files, of 8 bits or of three equal colours, in the same way.
std::unique_ptr<LabelVolume> open_bmp_slices(const SliceFiles& slices, const VolumeChoice& choice);

/// Dimensions of an array whose file does not say their meaning, in the file's order.
struct ArrayShape {
  std::vector<std::int64_t> counts;  ///< the slowest first, as in NumPy and HDF5
  /// For each dimension, 0, 1, 2 if it is x, y, z; -1: frames; -2: channels. Empty: by convention,
  /// see ShapedVolume.
  std::vector<int> roles = {};
  Vector3 voxel_size = Vector3::Zero();  ///< along x, y, z; not above 0: unknown
  std::string unit;
  std::string size_source = {};        ///< see VolumeGeometry
  std::optional<Vector3> corner = {};  ///< of the first voxel's cell
};

/// A volume's geometry, and the selected part of the array, by the convention of NumPy,
/// scikit-image, napari and Fiji. Dimensions of size one are ignored. The last three of the others
/// are z, y and x; dimensions before them are frames. A last dimension that is shorter than half of
/// each of the three before it, and at most 8, has channels, as colours do.
struct ShapedVolume {
  VolumeGeometry geometry;
  std::vector<VolumeAxis> axes;  ///< the fastest first
  std::vector<BlockPick> picks;
};

/// Returns "2 x 24 x 28 x 36".
std::string text_of_counts(const std::vector<std::int64_t>& counts);

/// Throws Error(InputOutput), naming the file, for counts that look like z, c, y, x, as PyTorch and
/// others store channels: they would be taken for the slices of frames.
void refuse_channels_inside(const std::vector<std::int64_t>& counts, const std::string& path);

/// Returns the geometry and the selection. Throws Error(InputOutput), naming the file `path`, for
/// shapes that are no volume.
ShapedVolume volume_of_shape(const ArrayShape& shape, const VolumeChoice& choice,
                             const std::string& path);

/// Throws Error(InputOutput), naming the file, if an array was chosen in a format with only one.
void refuse_array_choice(const VolumeChoice& choice, const std::string& path);

/// Throws Error(InputOutput), naming the file, for lengths of voxels that are not finite and above
/// 0, unless a voxel size was chosen.
void require_spacing(const Vector3& spacing, const VolumeChoice& choice, const std::string& path);

/// Returns the decimal number that a number of single precision means: 0.1 for the float next to
/// it. Other numbers are returned unchanged.
double decimal_of(double value);

/// Sets the lattice of a file whose voxels have their centres at `origin` + `axes` (i, j, k), each
/// number as decimal_of. If a voxel size was chosen, sets the lattice at its multiples, along x, y
/// and z in the order of geometry.order, along -x if the file's axes are of the other hand. Throws
/// Error(InputOutput), naming the file, if voxels have no volume.
void set_lattice(VolumeGeometry& geometry, const Eigen::Matrix3d& axes, const Vector3& origin,
                 const VolumeChoice& choice, const std::string& path);

}  // namespace wscvt
