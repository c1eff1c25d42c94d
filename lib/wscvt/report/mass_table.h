// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// A body's mass properties and the heading of its column.
struct NamedMass {
  std::string name;
  MassProperties mass;
};

/// Returns rows of cells: mass properties at unit density, one column per body. The first row is
/// the head. The volume is in the table of descriptors.
std::vector<std::vector<std::string>> mass_rows(const std::vector<NamedMass>& bodies);

}  // namespace wscvt
