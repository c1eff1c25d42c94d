// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/closing_advice.h"

#include "wscvt/scan/envelope.h"

namespace wscvt {

std::string where_envelopes_are() {
  return "--" + std::string(envelope_option.key) +
         " in the program, in MeshLab Filters > Remeshing, Simplification and Reconstruction > "
         "Uniform Mesh Resampling with Absolute Distance checked and an Offset above half the "
         "width of what is to be closed";
}

std::string envelope_of_points_advice() {
  // The wrap falls through gaps between points as wide as the opening, and then has handles.
  return "Take their envelope, with an opening wider than the gaps between them: --points --" +
         std::string(envelope_option.key) + " 10 in the program is a start.";
}

}  // namespace wscvt
