// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/closing_advice.h"

#include "wscvt/scan/envelope.h"

namespace wscvt {

std::string closing_filter() {
  return "Filters > Remeshing, Simplification and Reconstruction > Uniform Mesh Resampling with "
         "Absolute Distance checked and an Offset above half the width of what is to be closed";
}

std::string where_envelopes_are() {
  return "--" + std::string(envelope_option.key) + " in the program, in MeshLab " +
         closing_filter();
}

}  // namespace wscvt
