// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/resolution/descriptor_orders.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace wscvt {

namespace {

/// No correction: the error of the voxels is scatter, or the extrapolation gains less than a 20th.
constexpr double none = std::numeric_limits<double>::infinity();

constexpr DescriptorOrder orders[] = {
    {"volume", 9.5, none, 0.0000, 0.10, 0.48, 0.052, 1.70},
    {"area", 9.5, 1.4, -0.0057, 0.43, 0.00, 0.275, 2.12},
    {"equivalent_diameter", 9.5, none, 0.0000, 0.07, 0.54, 0.014, 1.70},
    {"sphericity_wadell", 9.5, 1.4, 0.0061, 0.94, 0.24, 0.302, 0.52},
    {"convexity", 9.5, 1.8, 0.0103, 0.19, 0.47, 0.608, 0.79},
    {"inscribed_radius", 9.5, 2.6, 0.0019, 0.59, 0.00, 0.628, 0.70},
    {"axis_s_inertia", 9.5, none, 0.0000, 0.32, 0.65, 0.052, 1.09},
    {"axis_i_inertia", 9.5, none, 0.0000, 0.03, 0.30, 0.096, 1.63},
    {"axis_l_inertia", 9.5, 3.8, -0.0004, 0.05, 0.51, 0.041, 2.32},
    {"aspect_ratio_inertia", 9.5, none, 0.0000, 0.20, 0.25, 0.319, 0.53},
    {"zingg_elongation_inertia", 9.5, none, 0.0000, 0.17, 0.21, 0.273, 0.68},
    {"zingg_flatness_inertia", 9.5, none, 0.0000, 0.23, 0.69, 0.074, 0.79},
    {"kong_fonseca_elongation_inertia", 9.5, none, 0.0000, 0.08, 1.26, 0.000, 1.68},
    {"kong_fonseca_flatness_inertia", 9.5, none, 0.0000, 0.23, 0.76, 0.122, 1.05},
    {"krumbein_sphericity_inertia", 9.5, none, 0.0000, 0.19, 0.31, 0.199, 0.51},
    {"axis_s_box", 9.5, 4.0, -0.0054, 0.72, 0.60, 0.767, 1.36},
    {"axis_i_box", 9.5, none, 0.0000, 0.49, 1.63, 0.520, 0.65},
    {"axis_l_box", 9.5, none, 0.0000, 0.51, 1.27, 0.408, 1.19},
    {"aspect_ratio_box", 9.5, none, 0.0000, 0.78, 1.56, 0.498, 1.06},
    {"zingg_elongation_box", 9.5, none, 0.0000, 1.37, 1.37, 0.437, 0.66},
    {"zingg_flatness_box", 9.5, none, 0.0000, 0.63, 1.05, 0.673, 1.36},
    {"kong_fonseca_elongation_box", 9.5, none, 0.0000, 1.68, 1.12, 0.717, 1.31},
    {"kong_fonseca_flatness_box", 9.5, none, 0.0000, 0.83, 2.07, 1.327, 0.75},
    {"krumbein_sphericity_box", 9.5, none, 0.0000, 1.60, 1.07, 0.342, 0.66},
    {"feret_max", 9.5, 3.7, -0.0015, 0.00, 0.00, 0.302, 1.87},
    {"feret_min", 9.5, 2.9, -0.0054, 0.00, 0.67, 0.859, 0.71},
    {"nist_width", 9.5, none, 0.0000, 0.73, 0.61, 0.391, 1.06},
    {"nist_thickness", 9.5, none, 0.0000, 1.52, 0.00, 0.973, 0.75},
    {"mean_curvature_integral", 9.5, 2.1, -0.0071, 0.31, 0.00, 0.489, 1.72},
    {"roundness_wadell", 28.5, 2.8, 0.0495, 0.00, 0.00, 19.486, 0.64},
    {"sdq_invariant", 9.5, 1.6, -0.0332, 0.00, 0.00, 1.638, 1.97},
    {"orientation_f1", 9.5, 2.2, 0.0041, 0.25, 0.00, 0.803, 0.52},
    {"orientation_f2", 9.5, 2.6, -0.0016, 0.00, 0.79, 0.504, 0.99},
    {"orientation_f3", 9.5, 2.3, -0.0060, 0.96, 2.41, 0.770, 1.07},
    {"compactness", 9.5, 2.3, -0.0081, 0.75, 2.50, 0.801, 1.33},
    {"flakiness", 9.5, 2.9, 0.0107, 0.53, 2.66, 0.852, 0.57},
    {"rodness", 9.5, none, 0.0000, 0.36, 0.91, 1.159, 1.51},
};

}  // namespace

const DescriptorOrder* order_of(std::string_view key) {
  const auto* found = std::find_if(std::begin(orders), std::end(orders),
                                   [&](const DescriptorOrder& order) { return order.key == key; });
  return found == std::end(orders) ? nullptr : found;
}

}  // namespace wscvt
