// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"
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
  std::string size_source = {};      ///< what gives it, for people; empty: the file's header
  /// The file's axis (x, y, z) of each axis of the lattice: the file may store voxels in another
  /// order.
  std::array<Eigen::Index, 3> order = {0, 1, 2};

  Vector3 point(const Vector3& lattice) const { return axes * lattice + corner; }
  double voxel_volume() const;  ///< length^3
};

/// How the numbers of a file become labels.
struct LabelCoding {
  bool as_grey = false;  ///< grey values: any numbers, as the codes of grey_code
  /// The number between the grains, as the file holds it; NaN: only NaN. NaN always counts as it.
  double background = 0.0;
  std::int64_t offset = 0;  ///< to be added to each number of the file
  std::string no_labels =
      {};  ///< why the numbers are grey values and no labels; empty: they may be
  /// The label of each number above the largest label, see LabelVolume::number_anew.
  std::map<std::uint64_t, Label> numbers = {};
  bool finds_numbers = false;  ///< such numbers are entered in `numbers`
};

/// The label that stands for a background which is no label itself, such as -1.
inline constexpr Label no_label = 0xffffffffU;

/// Returns the label of the background.
Label background_label(double background);

/// The labels of a volume, row by row along x, rows along y, slices along z, readable repeatedly
/// from the beginning. Memory is a row and the buffer for unpacking, such as a TIFF's strip, a row
/// of its tiles or a block, never the whole volume.
class LabelVolume {
 public:
  virtual ~LabelVolume() = default;

  const VolumeGeometry& geometry() const { return geometry_; }

  /// Returns sentences for the user about how the file was read, and about what looks wrong in it.
  const std::vector<Sentence>& notes() const { return notes_; }
  const std::vector<Sentence>& warnings() const { return warnings_; }
  void add_note(const Sentence& sentence) { notes_.push_back(sentence); }
  void add_warning(const Sentence& sentence) { warnings_.push_back(sentence); }
  void take_notes_of(const LabelVolume& other);

  /// Returns one sentence: the counts and the size of the voxels, and what gives the size.
  const Sentence& description() const { return description_; }
  void describe(const Sentence& sentence) { description_ = sentence; }

  /// Returns the file's names of labels; empty if it has none.
  const std::map<Label, std::string>& names() const { return names_; }
  void set_names(std::map<Label, std::string> names) { names_ = std::move(names); }

  /// Returns the next row, geometry().counts[0] labels, valid until the next call. Throws
  /// Error(InputOutput) if the file ends before it, is damaged, or has a number that is neither a
  /// label nor the background; LargeNumber for a whole number above 4294967295.
  virtual const std::vector<Label>& next_row() = 0;

  /// From now on rows contain grey values, any numbers, as the codes of grey_code.
  void read_grey_values() { coding_.as_grey = true; }

  /// Sets the number that is the background, see LabelCoding.
  void set_background(double background) { coding_.background = background; }

  /// Adds a whole number to every number of the file.
  void set_offset(std::int64_t offset) { coding_.offset = offset; }

  /// Refuses the numbers as labels, with this sentence. They can be read as grey values.
  void refuse_labels(std::string sentence) { coding_.no_labels = std::move(sentence); }

  /// Reads the volume, and numbers from now on all its labels from 1, in their order; names() get
  /// the file's numbers. For files whose numbers are larger than a label. Throws
  /// Error(InvalidInput) for more than `most` labels.
  void number_anew(std::size_t most);

  /// Goes back to the first row.
  virtual void rewind() = 0;

 protected:
  explicit LabelVolume(VolumeGeometry geometry) : geometry_(std::move(geometry)) {}
  LabelCoding& coding() { return coding_; }

 private:
  LabelCoding coding_;
  VolumeGeometry geometry_;
  std::vector<Sentence> notes_;
  std::vector<Sentence> warnings_;
  Sentence description_;
  std::map<Label, std::string> names_;
};

/// Calls take(labels) or take(labels, y, z) for each row of a volume, from its beginning. `stage`
/// is the name for the progress.
template <class Take>
void for_each_row(LabelVolume& volume, const Execution& execution, const char* stage,
                  const Take& take) {
  const VoxelCounts& counts = volume.geometry().counts;
  volume.rewind();
  for (std::int32_t z = 0; z < counts[2]; ++z) {
    execution.report(static_cast<double>(z) / counts[2], stage);
    for (std::int32_t y = 0; y < counts[1]; ++y) {
      if constexpr (std::is_invocable_v<Take, const std::vector<Label>&>) {
        take(volume.next_row());
      } else {
        take(volume.next_row(), y, z);
      }
    }
  }
}

/// Calls visit(label, begin, end) for every stretch of one label along a row.
template <class Visit>
void visit_stretches(const std::vector<Label>& row, const Visit& visit) {
  const auto count = static_cast<std::int32_t>(row.size());
  for (std::int32_t begin = 0; begin < count;) {
    const Label label = row[static_cast<std::size_t>(begin)];
    std::int32_t end = begin + 1;
    while (end < count && row[static_cast<std::size_t>(end)] == label) ++end;
    visit(label, begin, end);
    begin = end;
  }
}

/// Thrown for a whole number above the largest label.
class LargeNumber : public Error {
 public:
  using Error::Error;
};

/// Throws Error(InvalidInput) for a name that write_labels cannot write.
void check_label_file(const std::string& path);

/// Writes labels up to `largest`, larger ones as 0, by the ending of the name, .nrrd or .mha.
/// Labels are packed, with 16 bits or, if these are not enough, 32. The file has the size of
/// voxels, their directions, the position of the first, and the unit, so reading it gives the same
/// volume. Written completely or not at all; memory is the packed labels. Throws Error:
/// InvalidInput for another ending, Cancelled, MachineRefused as write_file does, and what the
/// volume throws.
void write_labels(const std::string& path, LabelVolume& volume, Label largest,
                  const Execution& execution);

/// Convert a grey value to 32 bits in the order of the values, and back. NaN is the smallest.
Label grey_code(float value);
float grey_value(Label code);

}  // namespace wscvt
