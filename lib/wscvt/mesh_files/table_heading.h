// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wscvt {

/// The heading of a column of a table: "Volume (µm³)" has the name "Volume" and the unit "um^3".
struct TableHeading {
  std::string name;
  std::string unit;   ///< as known_unit returns it, or another text in brackets; empty: none
  std::string whole;  ///< UTF-8
};

/// Reads a heading. Its unit stands in square or round brackets: "x [mm]", "x(mm)". A known unit
/// may follow a comma, an underscore, a slash or a blank instead: "x, mm", "x_mm", "x / mm". A text
/// that is no UTF-8 is Latin-1, which programs write on Windows.
TableHeading read_heading(std::string_view text);

/// Reads the headings of a line, behind a "#" if there is one. If blanks separate them, a unit in
/// brackets may be a field of its own: "x [mm] y [mm]".
std::vector<TableHeading> read_headings(std::string_view line);

/// Returns a unit of length, area or volume in our form, with or without brackets: "um" for "µm"
/// and "micron", "mm^3" for "mm³" and "mm3", "voxel" for "px"; "" for "-", which means that there
/// is no unit. Returns nothing for other texts.
std::optional<std::string> known_unit(std::string_view text);

/// Returns the length of a unit that known_unit returned; 0 for voxels, areas and other texts. The
/// numbers are whole, so that 900 um are exactly .9 mm.
double nanometres(std::string_view unit);

/// The unit of columns that must have one unit. Columns without a unit have the others'.
struct CommonUnit {
  std::string unit;
  std::string fault;  ///< "has columns in mm and in um, ...": two columns differ; empty: none do
};

CommonUnit common_unit(const std::vector<std::string>& units);

}  // namespace wscvt
