// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "volume/label_volume.h"

namespace wscvt {

// One function a format; see open_volume, which says what each reads and throws.

std::unique_ptr<LabelVolume> open_nrrd(const std::string& path,
                                       const std::optional<Vector3>& voxel_size);
std::unique_ptr<LabelVolume> open_meta_image(const std::string& path,
                                             const std::optional<Vector3>& voxel_size);
std::unique_ptr<LabelVolume> open_vti(const std::string& path,
                                      const std::optional<Vector3>& voxel_size);
/// A file or a folder.
std::unique_ptr<LabelVolume> open_tiff(const std::string& path,
                                       const std::optional<Vector3>& voxel_size);

/// A raw file that a JSON object describes: "dimensions", [x, y, z]; "type", such as "uint16"; and,
/// where they are needed, "byte_order", "little" (the default) or "big"; "spacing", [x, y, z] or
/// one number; "origin", the centre of the first voxel; "unit"; "offset", bytes before the first
/// voxel; "file", the raw file beside, in place of this one's name with the ending .raw.
std::unique_ptr<LabelVolume> open_raw(const std::string& path,
                                      const std::optional<Vector3>& voxel_size);

/// Sets the lattice of a file whose voxels have their centres at `origin` + `axes` (i, j, k); of a
/// voxel size that was asked for at its multiples. Throws Error(InputOutput), naming the file,
/// where voxels have no volume.
void set_lattice(VolumeGeometry& geometry, const Eigen::Matrix3d& axes, const Vector3& origin,
                 const std::optional<Vector3>& voxel_size, const std::string& path);

}  // namespace wscvt
