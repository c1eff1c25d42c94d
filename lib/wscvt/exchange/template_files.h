// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace wscvt {

/// The size curve of grains as a table: equivalent diameter and percentage finer by mass, from 0 at
/// the smallest grain to 100 at the largest, at steps of 2 %. read_given_sizes reads it. Diameters
/// above 0, length; throws Error(InvalidInput) if there are none.
std::string size_curve_csv(std::vector<double> diameters);

/// A Python script for Yade that packs grains of the templates: run with `yade -n -x` in the folder
/// of templates.csv, sizes.csv and the meshes in PLY, with the number of grains.
std::string yade_template_script();

}  // namespace wscvt
