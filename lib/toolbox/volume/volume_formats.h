// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/error.h"

namespace wscvt {

struct VolumeArray;  // open_volume.h

// One function per format; see open_volume for what each reads and throws.

std::unique_ptr<LabelVolume> open_nrrd(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_meta_image(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_vti(const std::string& path, const VolumeChoice& choice);
/// Opens a file.
std::unique_ptr<LabelVolume> open_tiff(const std::string& path, const VolumeChoice& choice);

std::unique_ptr<LabelVolume> open_png(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_bmp(const std::string& path, const VolumeChoice& choice);

std::unique_ptr<LabelVolume> open_nifti(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_npy(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_npz(const std::string& path, const VolumeChoice& choice);
std::unique_ptr<LabelVolume> open_legacy_vtk(const std::string& path, const VolumeChoice& choice);

/// Opens an array in memory, see VolumeArray. `name` is for messages.
std::unique_ptr<LabelVolume> volume_of_array(const VolumeArray& array, const VolumeChoice& choice,
                                             const std::string& name);

/// Opens HDF5, and MATLAB's files from version 7.3 on.
std::unique_ptr<LabelVolume> open_hdf5(const std::string& path, const VolumeChoice& choice);

/// Opens a raw file described by a JSON object with "dimensions", [x, y, z], "type", such as
/// "uint16", and if needed:
/// - "byte_order": "little" (the default) or "big";
/// - "spacing": [x, y, z] or one number;
/// - "origin": the centre of the first voxel;
/// - "unit";
/// - "offset": bytes before the first voxel;
/// - "file": the raw file beside it; the default is this file's name with the ending .raw.
std::unique_ptr<LabelVolume> open_raw(const std::string& path, const VolumeChoice& choice);

/// Opens a folder of slices; see image_stack.h.
std::unique_ptr<LabelVolume> open_stack(const std::string& path, const VolumeChoice& choice);

/// Throws Error(InputOutput), naming the file, if an array was chosen in a format with only one.
void refuse_array_choice(const VolumeChoice& choice, const std::string& path);

/// Throws Error(InputOutput), naming the file, for lengths of voxels that are not finite and above
/// 0, unless a voxel size was chosen.
void require_spacing(const Vector3& spacing, const VolumeChoice& choice, const std::string& path);

/// Sets the lattice of a file whose voxels have their centres at `origin` + `axes` (i, j, k). If a
/// voxel size was chosen, sets the lattice at its multiples, along x, y and z in the order of
/// geometry.order. Throws Error(InputOutput), naming the file, if voxels have no volume.
void set_lattice(VolumeGeometry& geometry, const Eigen::Matrix3d& axes, const Vector3& origin,
                 const VolumeChoice& choice, const std::string& path);

}  // namespace wscvt
