// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/foreign_columns.h"

#include <algorithm>

#include "wscvt/base/numbers.h"
#include "wscvt/base/text.h"

namespace wscvt {

namespace {

struct KnownColumn {
  std::string_view heading;  ///< without the unit
  ForeignColumn ours;
};

/// The columns of a program, and one that no other table has.
struct Program {
  std::string_view mark;
  std::vector<KnownColumn> columns;
};

const std::vector<Program>& programs() {
  static const std::vector<Program> all = {
      {"True Sphericity",
       {{"Particle ID", {"grain"}},
        {"Volume", {"volume"}},
        {"Equivalent Diameter", {"equivalent_diameter"}},
        {"Major Axis Length", {"axis_l_inertia"}},
        {"Middle Axis Length", {"axis_i_inertia"}},
        {"Minor Axis Length", {"axis_s_inertia"}},
        {"True Sphericity", {"sphericity_wadell"}},
        {"Convexity", {"convexity"}},
        {"Flatness", {"zingg_flatness_inertia"}},
        {"Elongation", {"zingg_elongation_inertia"}},
        // 36 pi V^2 / A^3. Our compactness is of the orientation tensor.
        {"Compactness", {"compactness_of_area"}}}},
      {"SurfaceArea",
       {{"Label", {"grain"}},
        {"Volume", {"volume"}},
        {"SurfaceArea", {"area"}},
        {"MeanBreadth", {"mean_curvature_integral", 2.0 * pi}},
        {"Sphericity", {"sphericity_wadell", 1.0, 1.0 / 3.0}},
        {"Elli.R1", {"axis_l_inertia", 2.0}},
        {"Elli.R2", {"axis_i_inertia", 2.0}},
        {"Elli.R3", {"axis_s_inertia", 2.0}},
        {"InscrBall.Radius", {"inscribed_radius"}}}},
      {"Surface_area",
       {{"Volume", {"volume"}},
        {"Surface_area", {"area"}},
        {"S_obb", {"axis_s_box"}},
        {"I_obb", {"axis_i_box"}},
        {"L_obb", {"axis_l_box"}},
        {"Sphericity_Wadell", {"sphericity_wadell"}},
        {"Convexity", {"convexity"}},
        {"Intercept_Sphericity_Krumbein", {"krumbein_sphericity_box"}},
        {"Flatness_Kong_and_Fonseca_2018", {"kong_fonseca_flatness_box"}},
        {"Elongation_Kong_and_Fonseca_2018", {"kong_fonseca_elongation_box"}},
        {"Zingg_S_over_I", {"zingg_flatness_box"}},
        {"Zingg_I_over_L", {"zingg_elongation_box"}}}},
      // scikit-image: "area" is the volume of a body, but the area of a section.
      {"equivalent_diameter_area",
       {{"label", {"grain"}},
        {"area", {"area_or_volume"}},
        {"equivalent_diameter_area", {"equivalent_diameter"}},
        {"axis_major_length", {"axis_l_inertia"}},
        {"axis_minor_length", {"axis_s_inertia"}},
        {"feret_diameter_max", {"feret_max"}},
        {"solidity", {"convexity"}}}},
  };
  return all;
}

/// Headings of any program: without blanks and marks, in lower case.
constexpr std::pair<std::string_view, std::string_view> usual_headings[] = {
    {"volume", "volume"}, {"surfacearea", "area"}, {"equivalentdiameter", "equivalent_diameter"},
    {"grain", "grain"},   {"particle", "grain"},   {"label", "grain"}};

/// Returns our name of a heading such as "EquivalentDiameter", or an empty text.
std::string_view usual_name(const std::string& heading) {
  std::string letters;
  for (const char byte : lower_case(heading)) {
    if (byte != ' ' && byte != '_' && byte != '-') letters += byte;
  }
  for (const auto& [usual, name] : usual_headings) {
    if (letters == usual) return name;
  }
  return {};
}

}  // namespace

std::vector<ForeignColumn> foreign_columns(const std::vector<TableHeading>& headings) {
  std::vector<ForeignColumn> columns(headings.size());
  for (const Program& program : programs()) {
    const bool is_of_program =
        std::any_of(headings.begin(), headings.end(),
                    [&](const TableHeading& one) { return one.name == program.mark; });
    if (!is_of_program) continue;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      for (const KnownColumn& known : program.columns) {
        if (headings[k].name == known.heading) columns[k] = known.ours;
      }
    }
    return columns;
  }
  for (std::size_t k = 0; k < columns.size(); ++k) columns[k].name = usual_name(headings[k].name);
  return columns;
}

}  // namespace wscvt
