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

#include "volume/volume_choice.h"
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
  std::string unit;                  ///< of length, see unit_of; empty: it is not said
  bool has_size = false;             ///< the file, or who asked, says how large a voxel is
  /// Along which of the file's axes x, y and z each axis of the lattice runs: voxels may stand in
  /// another order in the file.
  std::array<Eigen::Index, 3> order = {0, 1, 2};

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

  /// What a person should know of how the file was read: sentences.
  const std::vector<std::string>& notes() const { return notes_; }
  void add_note(const std::string& sentence);

  /// What the file calls its labels; empty: it does not say.
  const std::map<Label, std::string>& names() const { return names_; }
  void set_names(std::map<Label, std::string> names) { names_ = std::move(names); }

  /// The next row, geometry().counts[0] labels, valid until the next call. Throws
  /// Error(InputOutput) when the file ends before it, is damaged, or holds a label below 0 or above
  /// 4294967295.
  virtual const std::vector<Label>& next_row() = 0;

  /// Rows hold grey values from now on, any numbers, as the codes of grey_code.
  void read_grey_values() { is_grey_ = true; }

  /// Back to the first row.
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

/// A grey value as 32 bits whose order is that of the values, and back. NaN is the least.
Label grey_code(float value);
float grey_value(Label code);

/// Whether a name is one of a volume: it ends as the formats below do, or is a folder with TIFF
/// files and no meshes.
bool is_volume(const std::string& path);

/// Opens a volume of labels: whole numbers of 1 to 64 bits, or floats that are whole. The format
/// follows from the ending; lib/doc/files.md has the table of what is read of each. What was chosen
/// of it, and a voxel size in place of the file's, is in `choice`.
///
/// Throws Error: InputOutput when the file cannot be read, is cut short, of a form that is not
/// known, or holds more than one volume of which none was chosen; InvalidInput for sizes that are
/// not above 0.
std::unique_ptr<LabelVolume> open_volume(const std::string& path, const VolumeChoice& choice = {});

}  // namespace wscvt
