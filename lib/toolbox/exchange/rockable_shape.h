// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toolbox/exchange/node_table.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Returns a shape file (.shp) of Rockable, which exaDEM reads too: corners, edges and faces of a
/// body rounded by a small sphere, with its box, volume and moments. The sphere's radius is a
/// hundredth of the equivalent radius. The corners are moved inwards along their normals by this
/// radius, so that the rounded body has the grain's size. Not tested: Rockable is not in Debian.
///
/// `name` is one word. Throws Error(InvalidInput) unless `mass` is given in the principal frame
/// about the centroid, because the format has three moments and no axes.
std::string rockable_shape(const std::string& name, const NodeTable& nodes,
                           const MassProperties& mass);

}  // namespace wscvt
