// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/resolution/descriptor_biases.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace wscvt {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Without a gain: voxels only scatter the value, or the correction takes away less than 15 % of
/// the error.
constexpr DescriptorBias biases[] = {
    {"volume", none, 9.5, 0, 0, 0, 0, 0.7264, 0.908, 0.07264, 1.747},
    {"area", none, 9.5, -0.7332, -1.746, -0.03851, -0.08055, 0.09298, 0.3719, 0, 2.217},
    {"equivalent_diameter", none, 9.5, 0, 0, 0, 0, 1.331, 0.3327, 0.02661, 1.778},
    {"sphericity_wadell", 1, 9.5, -0.8299, -1.706, 0.04148, 0.07355, 0.2135, 0.854, 0, 0.4794},
    {"convexity", 1, 9.5, 0.3805, 0.9571, 0.01433, -0.02812, 1.291, 0.8604, 0.2753, 0.8903},
    {"inscribed_radius", none, 9.5, 0.2641, 0.3889, 0.01552, -0.05545, 1.379, 0, 0.7356, 0.7624},
    {"axis_s_inertia", none, 9.5, 0, 0, 0, 0, 1.069, 1.425, 0.05699, 1.246},
    {"axis_i_inertia", none, 9.5, 0, 0, 0, 0, 0.681, 1.362, 0.07264, 1.494},
    {"axis_l_inertia", none, 9.5, 0, 0, 0, 0, 0.6201, 1.24, 0.06615, 1.315},
    {"aspect_ratio_inertia", 1, 9.5, 0, 0, 0, 0, 0.06547, 0.982, 0.2095, 0.8027},
    {"zingg_elongation_inertia", 1, 9.5, 0, 0, 0, 0, 0, 1.484, 0.1583, 1.038},
    {"zingg_flatness_inertia", 1, 9.5, 0, 0, 0, 0, 1.097, 1.097, 0.1755, 0.9368},
    {"kong_fonseca_elongation_inertia", 1, 9.5, 0, 0, 0, 0, 1.914, 1.914, 0.1531, 1.155},
    {"kong_fonseca_flatness_inertia", 1, 9.5, 0, 0, 0, 0, 1.434, 1.434, 0.4588, 0.9319},
    {"krumbein_sphericity_inertia", 1, 9.5, 0, 0, 0, 0, 0.2123, 0.7077, 0.1132, 0.7586},
    {"axis_s_box", none, 9.5, 0, 0, 0, 0, 0.5209, 0, 0.8335, 1.375},
    {"axis_i_box", none, 9.5, 0, 0, 0, 0, 0.6654, 0, 1.065, 1.963},
    {"axis_l_box", none, 9.5, 0, 0, 0, 0, 1.403, 0, 1.122, 0.9166},
    {"aspect_ratio_box", 1, 9.5, 0, 0, 0, 0, 0.4317, 0, 1.382, 0.7529},
    {"zingg_elongation_box", 1, 9.5, 0, 0, 0, 0, 0.6546, 0, 2.095, 1.342},
    {"zingg_flatness_box", 1, 9.5, 0, 0, 0, 0, 0, 1.432, 1.832, 0.6004},
    {"kong_fonseca_elongation_box", 1, 9.5, 0, 0, 0, 0, 2.048, 0, 6.552, 1.393},
    {"kong_fonseca_flatness_box", 1, 9.5, 0, 0, 0, 0, 1.392, 4.175, 0.4453, 2.259},
    {"krumbein_sphericity_box", 1, 9.5, 0, 0, 0, 0, 0.9516, 0, 1.015, 1.139},
    {"feret_max", none, 9.5, 0, 0, 0, 0, 0.07944, 0, 0.2542, 2.243},
    {"feret_min", none, 9.5, 0, 0, 0, 0, 1.308, 0, 0.3488, 1.936},
    {"nist_width", none, 9.5, 0, 0, 0, 0, 0.6184, 1.237, 0.2639, 1.685},
    {"nist_thickness", none, 9.5, 0, 0, 0, 0, 0, 1.584, 1.014, 0.8419},
    {"mean_curvature_integral", none, 9.5, -0.5867, 0.8333, -0.02638, 0.05594, 0.1213, 0, 0.388,
     2.383},
    {"roundness_wadell", 1, 14.25, 1.879, -0.2471, 0.1615, -0.5117, 0, 6.871, 8.795, 0.9166},
    {"sdq_invariant", none, 9.5, 0.393, 1.896, -0.03703, 0.0779, 0.7621, 1.905, 1.219, 1.121},
    {"orientation_f1", 1, 9.5, 0.1073, 2.817, 0.01286, -0.04147, 0, 1.064, 0.6813, 0.658},
    {"orientation_f2", 1, 9.5, 0, 0, 0, 0, 2.031, 0.5079, 0.325, 1.511},
    {"orientation_f3", 1, 9.5, 0.5744, 1.572, -0.02114, 0.065, 0.3009, 0.7522, 0.9628, 1.132},
    {"compactness", 1, 9.5, 0.1228, 2.485, -0.03594, 0.1142, 0.4259, 1.065, 1.363, 1.191},
    {"flakiness", 1, 9.5, 0, 0, 0, 0, 0, 5.601, 1.792, 0.6962},
    {"rodness", 1, 9.5, 0, 0, 0, 0, 1.35, 2.251, 1.44, 1.102},
};

}  // namespace

const DescriptorBias* bias_of(std::string_view key) {
  const auto* found = std::find_if(std::begin(biases), std::end(biases),
                                   [&](const DescriptorBias& bias) { return bias.key == key; });
  return found == std::end(biases) ? nullptr : found;
}

}  // namespace wscvt
