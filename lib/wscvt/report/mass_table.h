// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// A body's mass properties and what its column is called.
struct NamedMass {
  std::string name;
  MassProperties mass;
};

/// Rows of cells, the first of them the head: mass properties at unit density, a column a body. The
/// volume stands among the descriptors.
std::vector<std::vector<std::string>> mass_rows(const std::vector<NamedMass>& bodies);

}  // namespace wscvt
