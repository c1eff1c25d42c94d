// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/closing_advice.h"

#include "wscvt/scan/scan_options.h"

namespace wscvt {

std::string where_envelopes_are() {
  return "--" + std::string(envelope_option.key) +
         " in the program, in MeshLab Filters > Remeshing, Simplification and Reconstruction > "
         "Uniform Mesh Resampling with Absolute Distance checked and an Offset above half the "
         "width of what is to be closed";
}

std::string envelope_of_flaws_advice() {
  // Two real scans with flaws for handles, of which 1000 nodes made 8 pairs that meet and angles of
  // 9 and 18 degrees, gave none and angles from 38 by their envelope of 3 %, volumes .9 and 2 %
  // larger.
  return "Where they are flaws of the scan, its envelope has none and is easier to follow (" +
         where_envelopes_are() + "); 3 % of the bounding box is a start.";
}

std::string surface_of_points_advice() {
  // Four clouds of photographs with strays inside, which had no surface here, came out so with rms
  // .6 to .9 % at 1000 nodes, and with the volume of the meshes that their authors made, within
  // 1e-5 where there is one. The wrap's volume is a tenth larger; it falls through gaps between
  // points that are as wide as the opening, and then has handles.
  return "Make a surface of them first, in MeshLab by Filters > Normals, Curvatures and "
         "Orientation "
         "> Compute normals for point sets and then Filters > Remeshing, Simplification and "
         "Reconstruction > Surface Reconstruction: Screened Poisson; or take their envelope, with "
         "an opening wider than the gaps between them: --points --" +
         std::string(envelope_option.key) + " 10 in the program is a start.";
}

}  // namespace wscvt
