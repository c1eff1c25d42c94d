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
    {"volume", none, 9.5, 0, 0, 0, 0, 1.138, 1.138, 0.1821, 1.242},
    {"area", none, 9.5, -0.7332, -1.746, -0.03851, -0.08055, 0, 0, 0.4477, 4.569},
    {"equivalent_diameter", none, 9.5, 0, 0, 0, 0, 1.144, 1.144, 0.06102, 1.22},
    {"sphericity_wadell", 1, 9.5, -0.8299, -1.706, 0.04148, 0.07355, 0.3509, 0.8773, 1.123, 0.1762},
    {"convexity", 1, 9.5, 0.3805, 0.9571, 0.01433, -0.02812, 1.043, 1.304, 1.669, 0.2917},
    {"inscribed_radius", none, 9.5, 0.2641, 0.3889, 0.01552, -0.05545, 0.486, 2.43, 1.555, 0.3978},
    {"axis_s_inertia", none, 9.5, 0, 0, 0, 0, 0, 2.44, 0.2603, 1.081},
    {"axis_i_inertia", none, 9.5, 0, 0, 0, 0, 1.565, 0.3911, 0.1252, 2.738},
    {"axis_l_inertia", none, 9.5, 0, 0, 0, 0, 0.8356, 0.8356, 0.08913, 4.068},
    {"aspect_ratio_inertia", 1, 9.5, 0, 0, 0, 0, 0.4245, 6.368, 0.3396, 0.4614},
    {"zingg_elongation_inertia", 1, 9.5, 0, 0, 0, 0, 0.4407, 0.5508, 0.3525, 0.7632},
    {"zingg_flatness_inertia", 1, 9.5, 0, 0, 0, 0, 2.346, 3.127, 0.5004, 0.3498},
    {"kong_fonseca_elongation_inertia", 1, 9.5, 0, 0, 0, 0, 9.214, 2.303, 0.3686, 1.622},
    {"kong_fonseca_flatness_inertia", 1, 9.5, 0, 0, 0, 0, 0.2327, 3.49, 0.3723, 1.495},
    {"krumbein_sphericity_inertia", 1, 9.5, 0, 0, 0, 0, 0, 4.595, 0.2451, 0.3915},
    {"axis_s_box", none, 9.5, 0, 0, 0, 0, 0.8539, 0, 0.9108, 1.367},
    {"axis_i_box", none, 9.5, 0, 0, 0, 0, 0.967, 0, 1.031, 3.54},
    {"axis_l_box", none, 9.5, 0, 0, 0, 0, 0.9854, 0, 1.577, 1.058},
    {"aspect_ratio_box", 1, 9.5, 0, 0, 0, 0, 0.8639, 0, 1.382, 1.751},
    {"zingg_elongation_box", 1, 9.5, 0, 0, 0, 0, 0.5519, 1.38, 1.766, 2.419},
    {"zingg_flatness_box", 1, 9.5, 0, 0, 0, 0, 0.9834, 0, 3.147, 0.6856},
    {"kong_fonseca_elongation_box", 1, 9.5, 0, 0, 0, 0, 5.466, 6.832, 8.745, 0.776},
    {"kong_fonseca_flatness_box", 1, 9.5, 0, 0, 0, 0, 3.068, 5.113, 3.272, 1.36},
    {"krumbein_sphericity_box", 1, 9.5, 0, 0, 0, 0, 0.606, 0.7575, 0.9696, 1.755},
    {"feret_max", none, 9.5, 0, 0, 0, 0, 0, 0, 0.3045, 5.268},
    {"feret_min", none, 9.5, 0, 0, 0, 0, 0.417, 0, 0.6672, 1.526},
    {"nist_width", none, 9.5, 0, 0, 0, 0, 1.105, 1.474, 0.4716, 2.286},
    {"nist_thickness", none, 9.5, 0, 0, 0, 0, 0.8635, 1.439, 0.9211, 0.8548},
    {"mean_curvature_integral", none, 9.5, -0.5867, 0.8333, -0.02638, 0.05594, 0, 0.7094, 0.454,
     3.738},
    {"roundness_wadell", 1, 14.25, 1.879, -0.2471, 0.1615, -0.5117, 5.187, 0, 16.6, 0.5874},
    {"sdq_invariant", none, 9.5, 0.393, 1.896, -0.03703, 0.0779, 0, 0, 2.733, 2.762},
    {"orientation_f1", 1, 9.5, 0.1073, 2.817, 0.01286, -0.04147, 0, 1.528, 1.956, 0.512},
    {"orientation_f2", 1, 9.5, 0, 0, 0, 0, 6.47, 0, 0.647, 1.63},
    {"orientation_f3", 1, 9.5, 0.5744, 1.572, -0.02114, 0.065, 0, 0, 1.606, 2.373},
    {"compactness", 1, 9.5, 0.1228, 2.485, -0.03594, 0.1142, 0, 0, 2.492, 2.417},
    {"flakiness", 1, 9.5, 0, 0, 0, 0, 3.098, 9.293, 1.982, 0.5597},
    {"rodness", 1, 9.5, 0, 0, 0, 0, 5.838, 5.838, 1.868, 0.8462},
};

}  // namespace

const DescriptorBias* bias_of(std::string_view key) {
  const auto* found = std::find_if(std::begin(biases), std::end(biases),
                                   [&](const DescriptorBias& bias) { return bias.key == key; });
  return found == std::end(biases) ? nullptr : found;
}

}  // namespace wscvt
