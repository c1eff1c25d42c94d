// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/label_volume.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace wscvt {

void LabelVolume::take_notes_of(const LabelVolume& other) {
  notes_ = other.notes_;
  warnings_ = other.warnings_;
  description_ = other.description_;
}

void LabelVolume::number_anew(std::size_t most) {
  coding_.numbers.clear();
  coding_.finds_numbers = true;
  rewind();
  for (std::int64_t row = 0; row < std::int64_t{geometry_.counts[1]} * geometry_.counts[2]; ++row) {
    next_row();
    if (coding_.numbers.size() <= most) continue;
    refuse("The volume has more than " + std::to_string(most) + " labels.");
  }
  coding_.finds_numbers = false;
  Label next = 1;
  for (auto& [number, label] : coding_.numbers) {
    label = next++;
    names_[label] = std::to_string(number);
  }
  add_note(
      "The file has numbers above 4294967295. Its labels were numbered from 1, in their order; "
      "the table's column \"name\" has the file's numbers.");
}

Label background_label(double background) {
  const bool is_label = background >= 0.0 && background < static_cast<double>(no_label);
  return is_label ? static_cast<Label>(background) : no_label;
}

Label grey_code(float value) {
  if (std::isnan(value)) return 0;
  Label bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  constexpr Label sign = 0x80000000U;
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

float grey_value(Label code) {
  constexpr Label sign = 0x80000000U;
  const Label bits = (code & sign) != 0 ? code & ~sign : ~code;
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

double VolumeGeometry::voxel_volume() const { return std::abs(axes.determinant()); }

}  // namespace wscvt
