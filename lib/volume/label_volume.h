// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// What a voxel holds: the number of the grain it belongs to.
using Label = std::uint32_t;

/// How many voxels a volume has along x, y and z.
using VoxelCounts = std::array<std::int32_t, 3>;

/// Where the voxels of a volume lie.
struct VolumeGeometry {
  VoxelCounts counts = {};
  /// From lattice coordinates to those of the file: voxel (i, j, k) fills the cell from (i, j, k)
  /// to (i + 1, j + 1, k + 1). Length.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Vector3 corner = Vector3::Zero();  ///< of the cell of voxel (0, 0, 0)
  std::string unit;                  ///< of length, as the file names it; empty: it does not

  Vector3 point(const Vector3& lattice) const { return axes * lattice + corner; }
  double voxel_volume() const;  ///< length^3
};

/// The labels of a volume, row by row along x, rows along y, slices along z, as often as wanted
/// from the beginning. Memory is that of a row and of what the file is unpacked with, a TIFF's
/// strip, its tiles beside each other or a block, never that of the volume.
class LabelVolume {
 public:
  virtual ~LabelVolume() = default;

  const VolumeGeometry& geometry() const { return geometry_; }

  /// The next row, geometry().counts[0] labels, valid until the next call. Throws
  /// Error(InputOutput) when the file ends before it, is damaged, or holds a label below 0 or above
  /// 4294967295.
  virtual const std::vector<Label>& next_row() = 0;

  /// Back to the first row.
  virtual void rewind() = 0;

 protected:
  explicit LabelVolume(VolumeGeometry geometry);

 private:
  VolumeGeometry geometry_;
};

/// Whether a name is one of a volume: it ends as the formats below do, or is a folder with TIFF
/// files and no meshes.
bool is_volume(const std::string& path);

/// Opens a volume of labels: whole numbers of 8 to 64 bits. The format follows from the ending:
/// - .nrrd, .nhdr: NRRD of three dimensions, raw or gzip, the voxels in it or in one file beside;
/// - .mhd, .mha: MetaImage likewise, raw or zlib;
/// - .vti: VTK ImageData, its scalars or first array, at points or cells, appended or in base64,
///   plain or packed by zlib;
/// - .tif, .tiff: TIFF of a page a slice, in strips or tiles, packed by what libtiff knows, or as
///   ImageJ writes stacks above 4 GiB; a folder: of the TIFF files in it, by name, numbers in their
///   order;
/// - .json: a description of a raw file (see open_raw in volume_formats.h).
/// `voxel_size`, along x, y and z, replaces the file's, and its axes then are those of the lattice.
///
/// Throws Error: InputOutput when the file cannot be read, is cut short or of a form that is not
/// known, InvalidInput for sizes that are not above 0.
std::unique_ptr<LabelVolume> open_volume(const std::string& path,
                                         const std::optional<Vector3>& voxel_size = {});

}  // namespace wscvt
