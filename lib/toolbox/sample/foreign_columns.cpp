// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/foreign_columns.h"

#include <algorithm>

#include "wscvt/base/numbers.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct KnownColumn {
  std::string_view heading;  ///< without the unit
  std::string_view name;
  double factor = 1.0;
  double exponent = 1.0;
};

/// The columns of a program, and one that no other table has.
struct Program {
  std::string_view mark;
  std::vector<KnownColumn> columns;
};

const std::vector<Program>& programs() {
  static const std::vector<Program> all = {
      {"True Sphericity",
       {{"Particle ID", "grain"},
        {"Volume", "volume"},
        {"Equivalent Diameter", "equivalent_diameter"},
        {"Major Axis Length", "axis_l_inertia"},
        {"Middle Axis Length", "axis_i_inertia"},
        {"Minor Axis Length", "axis_s_inertia"},
        {"True Sphericity", "sphericity_wadell"},
        {"Convexity", "convexity"},
        {"Flatness", "zingg_flatness_inertia"},
        {"Elongation", "zingg_elongation_inertia"},
        // 36 pi V^2 / A^3. Our compactness is of the orientation tensor.
        {"Compactness", "compactness_of_area"}}},
      {"SurfaceArea",
       {{"Label", "grain"},
        {"Volume", "volume"},
        {"SurfaceArea", "area"},
        {"MeanBreadth", "mean_curvature_integral", 2.0 * pi},
        {"Sphericity", "sphericity_wadell", 1.0, 1.0 / 3.0},
        {"Elli.R1", "axis_l_inertia", 2.0},
        {"Elli.R2", "axis_i_inertia", 2.0},
        {"Elli.R3", "axis_s_inertia", 2.0},
        {"InscrBall.Radius", "inscribed_radius"}}},
      {"Surface_area",
       {{"Volume", "volume"},
        {"Surface_area", "area"},
        {"S_obb", "axis_s_box"},
        {"I_obb", "axis_i_box"},
        {"L_obb", "axis_l_box"},
        {"Sphericity_Wadell", "sphericity_wadell"},
        {"Convexity", "convexity"},
        {"Intercept_Sphericity_Krumbein", "krumbein_sphericity_box"},
        {"Flatness_Kong_and_Fonseca_2018", "kong_fonseca_flatness_box"},
        {"Elongation_Kong_and_Fonseca_2018", "kong_fonseca_elongation_box"},
        {"Zingg_S_over_I", "zingg_flatness_box"},
        {"Zingg_I_over_L", "zingg_elongation_box"}}},
      // scikit-image: "area" is the volume of a body, but the area of a section.
      {"equivalent_diameter_area",
       {{"label", "grain"},
        {"area", "area_or_volume"},
        {"equivalent_diameter_area", "equivalent_diameter"},
        {"axis_major_length", "axis_l_inertia"},
        {"axis_minor_length", "axis_s_inertia"},
        {"feret_diameter_max", "feret_max"},
        {"solidity", "convexity"}}},
  };
  return all;
}

/// Divides "Volume (µm³)" or "Volume [µm³]" into "Volume" and "µm^3". "(-)" is no unit.
ForeignColumn without_unit(std::string_view heading) {
  const std::string_view text = trimmed(heading);
  const bool is_square = !text.empty() && text.back() == ']';
  const std::size_t bracket = is_square ? text.rfind('[') : text.rfind(" (");
  if (bracket == std::string_view::npos || (!is_square && text.back() != ')')) {
    return {std::string(text), ""};
  }
  const std::size_t begin = bracket + (is_square ? 1 : 2);
  std::string unit(text.substr(begin, text.size() - begin - 1));
  for (const auto& [from, to] :
       {std::pair<std::string_view, std::string_view>{"\xC2\xB3", "^3"}, {"\xC2\xB2", "^2"}}) {
    const std::size_t at = unit.find(from);
    if (at != std::string::npos) unit.replace(at, from.size(), to);
  }
  if (unit == "-") unit.clear();
  return {std::string(trimmed(text.substr(0, bracket))), unit};
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

std::optional<std::vector<ForeignColumn>> foreign_columns(
    const std::vector<std::string>& headings) {
  std::vector<ForeignColumn> columns;
  for (const std::string& heading : headings) columns.push_back(without_unit(heading));
  for (const Program& program : programs()) {
    const bool is_of_program =
        std::any_of(columns.begin(), columns.end(),
                    [&](const ForeignColumn& one) { return one.name == program.mark; });
    if (!is_of_program) continue;
    for (ForeignColumn& one : columns) {
      for (const KnownColumn& known : program.columns) {
        if (one.name != known.heading) continue;
        one = {std::string(known.name), one.unit, known.factor, known.exponent};
        break;
      }
    }
    return columns;
  }
  bool is_usual = false;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string_view name = usual_name(columns[k].name);
    if (name.empty() || name == columns[k].name) continue;
    columns[k].name = name;
    is_usual = true;
  }
  if (!is_usual) return {};
  return columns;
}

}  // namespace wscvt
