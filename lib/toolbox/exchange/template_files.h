// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "toolbox/clump/sphere.h"

namespace wscvt {

/// Returns the size curve of grains as a table: equivalent diameter and percentage finer by mass,
/// from 0 at the smallest grain to 100 at the largest, in steps of 2 %. read_given_sizes reads it.
/// Diameters above 0, length; throws Error(InvalidInput) if there are none.
std::string size_curve_csv(std::vector<double> diameters);

/// Returns the same curve for MercuryDPM, PSD::setPSDFromCSV with CUMULATIVE_VOLUME_DISTRIBUTION:
/// radius and fraction finer by volume, without a heading.
std::string mercury_psd_csv(std::vector<double> diameters);

/// Returns the diameter below which a fraction of the grains' mass lies; throws as size_curve_csv.
double diameter_by_mass(std::vector<double> diameters, double fraction);

/// Returns a Python script that packs virtual grains or grains of templates in Yade. Run it with
/// `yade -n -x` and the number of grains, in the folder of grown.csv or of templates.csv and
/// sizes.csv. The meshes must be PLY files.
std::string yade_packing_script();

/// Returns the spheres as lines "x y z r", the file of LIGGGHTS's particletemplate/multisphere.
std::string sphere_rows(const std::vector<Sphere>& spheres);

/// A template for LIGGGHTS.
struct ClumpTemplate {
  std::string file;         ///< of sphere_rows
  std::size_t spheres = 0;  ///< their number
  double weight_by_mass = 0.0;
};

/// Returns an input for LIGGGHTS that packs grains: a particletemplate for each template with a
/// weight above 0 at each of the diameters, which have equal masses, and their
/// particledistribution. Throws Error(InvalidInput) for no templates or no diameters.
std::string liggghts_template_input(const std::vector<ClumpTemplate>& templates,
                                    const std::vector<double>& diameters);

}  // namespace wscvt
