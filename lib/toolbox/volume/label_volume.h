// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Value of a voxel: the number of its grain.
using Label = std::uint32_t;

/// Numbers of voxels of a volume along x, y and z.
using VoxelCounts = std::array<std::int32_t, 3>;

/// Position of the voxels of a volume.
struct VolumeGeometry {
  VoxelCounts counts = {};
  /// From lattice coordinates to the file's coordinates: voxel (i, j, k) fills the cell from (i, j,
  /// k) to (i + 1, j + 1, k + 1). Length.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Vector3 corner = Vector3::Zero();  ///< of the cell of voxel (0, 0, 0)
  std::string unit;                  ///< of length, see unit_of; empty: unknown
  bool has_size = false;             ///< the file or the user gives the size of a voxel
  /// The file's axis (x, y, z) of each axis of the lattice: the file may store voxels in another
  /// order.
  std::array<Eigen::Index, 3> order = {0, 1, 2};

  Vector3 point(const Vector3& lattice) const { return axes * lattice + corner; }
  double voxel_volume() const;  ///< length^3
};

/// The labels of a volume, row by row along x, rows along y, slices along z, readable repeatedly
/// from the beginning. Memory is a row and the buffer for unpacking, such as a TIFF's strip, a row
/// of its tiles or a block, never the whole volume.
class LabelVolume {
 public:
  virtual ~LabelVolume() = default;

  const VolumeGeometry& geometry() const { return geometry_; }

  /// Returns sentences for the user about how the file was read.
  const std::vector<std::string>& notes() const { return notes_; }
  void add_note(const std::string& sentence);

  /// Returns the file's names of labels; empty if it has none.
  const std::map<Label, std::string>& names() const { return names_; }
  void set_names(std::map<Label, std::string> names) { names_ = std::move(names); }

  /// Returns the next row, geometry().counts[0] labels, valid until the next call. Throws
  /// Error(InputOutput) if the file ends before it, is damaged, or has a label below 0 or above
  /// 4294967295.
  virtual const std::vector<Label>& next_row() = 0;

  /// From now on rows contain grey values, any numbers, as the codes of grey_code.
  void read_grey_values() { is_grey_ = true; }

  /// Goes back to the first row.
  virtual void rewind() = 0;

 protected:
  explicit LabelVolume(VolumeGeometry geometry);
  bool is_grey() const { return is_grey_; }

 private:
  bool is_grey_ = false;
  VolumeGeometry geometry_;
  std::vector<std::string> notes_;
  std::map<Label, std::string> names_;
};

/// Convert a grey value to 32 bits in the order of the values, and back. NaN is the smallest.
Label grey_code(float value);
float grey_value(Label code);

/// Returns whether a name is a volume's: it has an ending of the formats below, or is a folder with
/// TIFF files and no meshes.
bool is_volume(const std::string& path);

/// Opens a volume of labels: whole numbers of 1 to 64 bits, or floats that are whole. The ending
/// gives the format; lib/doc/files.md has the table of what is read of each. `choice` selects a
/// part of the file, and may replace its voxel size.
///
/// Throws Error: InputOutput if the file cannot be read, is cut short, has an unknown form, or
/// contains more than one volume and none was chosen; InvalidInput for sizes that are not above 0.
std::unique_ptr<LabelVolume> open_volume(const std::string& path, const VolumeChoice& choice = {});

}  // namespace wscvt
