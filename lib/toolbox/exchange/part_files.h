// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "toolbox/convex/convex_parts.h"
#include "toolbox/exchange/rockable_shape.h"
#include "toolbox/exchange/simulation_options.h"
#include "wscvt/base/error.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Density of a grain in the files of engines that need masses.
inline constexpr NumberOption<double> parts_density_option = {
    "density",     "density",
    0.0,           std::numeric_limits<double>::infinity(),
    Ends::Neither, "mass per unit volume, for mass and inertia in .urdf and .xml"};

/// Returns the endings of files of parts: ".obj", ".urdf", ".xml", ".shp".
const std::vector<std::string>& part_endings();

/// Returns the files that write_parts makes beside a .urdf of at most `count` parts; of other
/// formats none.
std::vector<std::string> parts_beside(const std::string& path, int count);

/// Throws Error(InvalidInput), with the endings, for a name with another ending.
void check_part_file(const std::string& path);

/// Writes parts in the format of the ending, whole or not at all (see write_file):
/// - .obj: all parts, one group per part, "part_1" to "part_K";
/// - .urdf: a robot of one link, with the mass and inertia of `mass` times `density`. Its parts are
///   OBJ files beside it, "NAME_1.obj" to "NAME_K.obj", which are written first;
/// - .xml: MuJoCo's MJCF, a free body with the same mass and inertia; the file contains the parts;
/// - .shp: one shape of Rockable, see rockable_shape, whose rounding is returned.
/// Coordinates keep all their digits. Throws Error(InputOutput) when a file cannot be written, and
/// as check_part_file and rockable_shape.
Rounding write_parts(const std::string& path, const ConvexParts& parts, const MassProperties& mass,
                     double density);

struct WrittenParts {
  Rounding rounding;  ///< of a .shp
  Sentence warning;   ///< see inertia_warning; or empty
};

/// Writes the parts of a grain in a frame.
WrittenParts write_parts(const std::string& path, const PartsResult& result,
                         const FrameOptions& options, double density);

/// Returns a warning with the unit to use if MuJoCo would refuse the inertia in a file of this
/// name, else an empty text. `mass` as write_parts takes it, in metres. `lengths`: what sets the
/// unit, in words.
Sentence inertia_warning(const std::string& path, const MassProperties& mass, double density,
                         const Sentence& lengths);

}  // namespace wscvt
