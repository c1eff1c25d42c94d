// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "toolbox/clump/clump.h"
#include "toolbox/exchange/simulation_options.h"
#include "wscvt/base/option.h"

namespace wscvt {

// Files of a clump. The ending of the name selects the format:
//   .csv          x,y,z,r with a header, in the frame of the options; read_clump reads it
//   .multisphere  LIGGGHTS: lines "x y z r"; beside it NAME.multisphere.in with the fix clump_NAME
//   .py           Yade: a script with the template, and a function that adds a clump
//   .chrono.csv   Chrono DEM-Engine: x,y,z,r, then mass and moments as comments
//   .mclump       MercuryDPM: a folder like the output of its tool MClump
//   .p3dat        PFC: the command "clump template create"
//   .molecule     LAMMPS: a molecule for fix rigid/small, with its spheres as atoms of type 1
//   .clu          Kratos: a cluster of its DEM application
// All but .csv are in the grain's principal axes about its centroid, in which its tensor of inertia
// is diagonal. They contain the grain's mass properties at unit density; .molecule at the chosen
// density, because LAMMPS cannot change it.

/// Density of the grain in a .molecule file.
inline constexpr NumberOption<double> clump_density_option = {
    "density",     "density",
    0.0,           std::numeric_limits<double>::infinity(),
    Ends::Neither, "mass per unit volume in .molecule"};

/// Returns whether a name has one of the endings above, in either case.
bool is_clump_name(const std::string& path);

/// Throws Error(InvalidInput), with the endings, for another ending.
void check_clump_path(const std::string& path);

/// Returns the files that are written for one path, including itself.
std::vector<std::string> files_of_clump(const std::string& path);

/// Writes the clump. Throws Error: InvalidInput for another ending or a density out of range,
/// InputOutput.
void write_clump(const std::string& path, const ClumpResult& clump, const FrameOptions& frame,
                 double density = 1.0);

/// Returns whether a file is a table of spheres: its first line, behind comments, names x, y, z and
/// r, radius or diameter, or is four or more numbers in a .csv or .multisphere file. Of a radius
/// and a diameter the radius is used. False if it cannot be read. A .txt file is one whatever it
/// has, as no mesh has this ending: read_clump says what is wrong with it, and with five numbers.
bool is_clump_file(const std::string& path);

/// Returns whether it is one by its heading: four numbers may be a point and a grey value.
bool has_sphere_heading(const std::string& path);

/// Reads the spheres of such a file. Throws Error: InvalidInput, with the line, for other content;
/// InputOutput.
std::vector<Sphere> read_clump(const std::string& path);

}  // namespace wscvt
