// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/remesh.h"

namespace wscvt::study {

/// A way to choose nodes, as the contact study compares them.
struct ContactSampling {
  std::string name;
  RemeshOptions options;
};

/// On the scan: WSCVT-D, WSCVT-C, constant, Fibonacci and random; off it: WSCVT-D by least squares,
/// refined, and contact placements of error-adaptive weights, with their radius, for nodes against
/// another grain's surface, nodes of both, and flat walls.
std::vector<ContactSampling> contact_samplings();

}  // namespace wscvt::study
