// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "wscvt/mesh_files/table_heading.h"

namespace wscvt {

/// A column of another program's table, in the words and the definition of this project.
struct ForeignColumn {
  std::string_view name;  ///< empty: the column keeps its heading and value
  double factor = 1.0;    ///< our value = factor * (their value)^exponent
  double exponent = 1.0;
};

/// Returns the column of each heading of a table. "grain" is the column that names the grains. The
/// headings, as the programs write them:
///
/// - Sand Atlas (sand-atlas, pipeline.py): "Volume (µm³)", "Middle Axis Length (µm)", ...
/// - MorphoLibJ (AnalyzeRegions3D.java): "SurfaceArea", "Elli.R1", ... Its sphericity is
///   36 pi V^2 / A^3, the cube of Wadell's; its mean breadth is the integral of the mean curvature
///   / (2 pi).
/// - any: "Volume (mm³)", "EquivalentDiameter (µm)", "Surface Area", "Label".
/// - SHAPE (Geometrical_features.m, Form_indices.m): "Surface_area", "I_obb", "Zingg_I_over_L", ...
std::vector<ForeignColumn> foreign_columns(const std::vector<TableHeading>& headings);

}  // namespace wscvt
