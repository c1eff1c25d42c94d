// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/fabric/fabric.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Returns CSV (RFC 4180) with a row per pair of labels that touch. Columns:
///   first, second       the labels
///   contact             1 or 0
///   faces               of voxels that both share
///   raw_area, area, area_uncertainty                length^2
///   x, y, z, centre_uncertainty                     length
///   normal_x, normal_y, normal_z                    from the first to the second
///   normal_uncertainty                              degrees
///   branch_x, branch_y, branch_z                    length
///   at_border           1 if the border of the volume cuts one of the two
///   unit                of length, as the file names it
/// Numbers read back to the same bits.
std::string contacts_csv(const Fabric& fabric);

/// Returns CSV with a row per label. Columns: label, name (the file's), voxels, volume, x, y, z
/// (the centre), touching, contacts, contact_area, at_border, unit.
std::string fabric_grains_csv(const Fabric& fabric);

/// Returns VTK's XML PolyData (.vtp), for ParaView: a disc of 16 triangles for each contact, with
/// its centre, normal and corrected area, and the point arrays "normal", "branch", "area",
/// "area_uncertainty", "first" and "second". Pairs that are no contact are left out.
std::string contacts_vtp(const Fabric& fabric);

/// Returns a few lines: grains, pairs, contacts, coordination, fabric tensor, the scan's blur.
std::vector<std::string> fabric_lines(const Fabric& fabric);

/// Returns an HTML page: the lines of fabric_lines, rose diagrams of the normals and of the branch
/// vectors in the three planes of the axes, the numbers of contacts of the grains, the tensors, the
/// areas before and after the correction.
std::string fabric_html(const Fabric& fabric, const ReportOrigin& origin);

}  // namespace wscvt
