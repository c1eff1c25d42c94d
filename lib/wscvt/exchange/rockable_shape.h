// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/exchange/node_table.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// A shape file (.shp) of Rockable, which exaDEM reads too: corners, edges and faces of a body that
/// is rounded by a small sphere, with its box, volume and moments. The sphere's radius is a
/// hundredth of the equivalent radius, and the corners are drawn in along their normals by as much,
/// so that the rounded body has the grain's size. Not tried: Rockable is not in Debian.
///
/// `name` is one word. Throws Error(InvalidInput) unless `mass` is that of a body in its principal
/// frame about its centroid: the form holds three moments and no axes.
std::string rockable_shape(const std::string& name, const NodeTable& nodes,
                           const MassProperties& mass);

}  // namespace wscvt
