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

/// As published, with nodes on the scan: WSCVT-D, WSCVT-C, constant, Fibonacci. By the method on
/// the scan: nodes on it, fitted, fitted closely, and contact fits of an edge ratio of 1.4, with
/// their radius, for nodes against another grain's surface, nodes of both, and flat walls.
std::vector<ContactSampling> contact_samplings();

}  // namespace wscvt::study
