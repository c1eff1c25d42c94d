// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/descriptor_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A value below this fraction of its reference size is noise, such as the roughness of a smooth
/// grain, which a remesh of flat triangles multiplies.
constexpr double near_zero_share = 1e-3;

void append_axes(std::vector<DescriptorValue>& rows, const std::string& suffix,
                 const std::string& convention, const FormAxes& axes, const FormRatios& ratios) {
  const std::string in = " (" + convention + ")";
  rows.push_back({"axis_s_" + suffix, "axis S" + in, "length", axes.shortest});
  rows.push_back({"axis_i_" + suffix, "axis I" + in, "length", axes.intermediate});
  rows.push_back({"axis_l_" + suffix, "axis L" + in, "length", axes.longest});
  rows.push_back({"aspect_ratio_" + suffix, "aspect ratio S/L" + in, "", ratios.aspect_ratio});
  rows.push_back(
      {"zingg_elongation_" + suffix, "Zingg elongation I/L" + in, "", ratios.zingg_elongation});
  rows.push_back(
      {"zingg_flatness_" + suffix, "Zingg flatness S/I" + in, "", ratios.zingg_flatness});
  rows.push_back({"kong_fonseca_elongation_" + suffix, "Kong-Fonseca elongation (L-I)/L" + in, "",
                  ratios.kong_fonseca_elongation, false});
  rows.push_back({"kong_fonseca_flatness_" + suffix, "Kong-Fonseca flatness (I-S)/I" + in, "",
                  ratios.kong_fonseca_flatness, false});
  rows.push_back({"krumbein_sphericity_" + suffix, "Krumbein sphericity" + in, "",
                  ratios.krumbein_sphericity});
}

}  // namespace

std::vector<DescriptorValue> list_descriptors(const ShapeDescriptors& d) {
  return {
      {"volume", "volume", "length^3", d.volume},
      {"area", "surface area", "length^2", d.area},
      {"aspect_ratio_inertia", "aspect ratio S/L (inertia ellipsoid)", "", d.aspect_ratio},
      {"sphericity_wadell", "sphericity (Wadell)", "", d.sphericity},
      {"sdq_invariant", "Sdq (invariant form)", "", d.sdq},
      {"sdq_clipped_fraction", "fraction of Sdq^2 at the clip", "", d.sdq_clipped_fraction, false},
      {"axis_s_inertia", "axis S (inertia ellipsoid)", "length", 2.0 * d.inertia_semi_axes[0]},
      {"axis_i_inertia", "axis I (inertia ellipsoid)", "length", 2.0 * d.inertia_semi_axes[1]},
      {"axis_l_inertia", "axis L (inertia ellipsoid)", "length", 2.0 * d.inertia_semi_axes[2]},
  };
}

std::vector<DescriptorValue> list_descriptors(const DetailedDescriptors& d) {
  std::vector<DescriptorValue> rows = {
      {"volume", "volume", "length^3", d.basic.volume},
      {"area", "surface area", "length^2", d.basic.area},
      {"equivalent_diameter", "equivalent diameter", "length", d.equivalent_diameter},
      {"sphericity_wadell", "sphericity (Wadell)", "", d.basic.sphericity},
      {"convexity", "convexity V / V(hull)", "", d.convexity},
      {"inscribed_radius", "radius of the largest inscribed sphere", "length",
       d.inscribed_sphere.radius},
  };
  append_axes(rows, "inertia", "inertia ellipsoid", d.inertia_axes, d.inertia_ratios);
  append_axes(rows, "box", "oriented box", d.box_axes, d.box_ratios);
  rows.push_back({"feret_max", "largest Feret diameter (L of NIST)", "length", d.feret.largest});
  rows.push_back({"feret_min", "smallest Feret diameter", "length", d.feret.smallest});
  rows.push_back(
      {"nist_width", "longest chord across L (W of NIST)", "length", d.feret.width_across});
  rows.push_back({"nist_thickness", "longest chord across L and W (T of NIST)", "length",
                  d.feret.thickness_across});
  rows.push_back({"mean_curvature_integral", "integral of mean curvature", "length",
                  d.mean_curvature_integral});

  const double ball = d.roundness.ball_radius / d.inscribed_sphere.radius;
  rows.push_back({"roundness_wadell",
                  "roundness (Wadell, by turn, balls of " + format_number(ball, 3) + " R)", "",
                  d.roundness.roundness});
  rows.push_back({"roundness_smallest_radius", "smallest corner radius resolved, of R", "",
                  d.roundness.smallest_radius});
  // Heights depend on the cut-off, so every label of a height names it.
  const auto rough = [&d](double value) { return d.has_roughness ? value : not_a_number; };
  const std::string above = " (cut-off " + format_number(d.roughness.cutoff, 4) + ")";
  rows.push_back({"roughness_cutoff", "cut-off length of roughness", "length", d.roughness.cutoff});
  rows.push_back({"sa", "roughness Sa" + above, "length", rough(d.roughness.sa)});
  rows.push_back({"sq", "roughness Sq" + above, "length", rough(d.roughness.sq)});
  rows.push_back({"sq_form_leak", "form in Sq, at most about" + above, "length",
                  rough(d.roughness.form_leak)});
  rows.push_back({"ssk", "skewness Ssk" + above, "", rough(d.roughness.ssk), false});
  rows.push_back({"sku", "kurtosis Sku" + above, "", rough(d.roughness.sku)});
  rows.push_back({"sdq_invariant", "Sdq (invariant form)", "", d.basic.sdq});
  rows.push_back({"sdq_clipped_fraction", "fraction of Sdq^2 at the clip", "",
                  d.basic.sdq_clipped_fraction, false});
  rows.push_back({"sdq_printed", "Sdq (as printed, eq. 17, this pose)", "",
                  d.has_radius ? d.printed_sdq : not_a_number});
  rows.push_back({"orientation_f1", "surface orientation f1", "", d.orientation.eigenvalues[0]});
  rows.push_back({"orientation_f2", "surface orientation f2", "", d.orientation.eigenvalues[1]});
  rows.push_back({"orientation_f3", "surface orientation f3", "", d.orientation.eigenvalues[2]});
  rows.push_back({"compactness", "compactness f3/f1", "", d.orientation.compactness});
  rows.push_back({"flakiness", "flakiness (f1-f2)/f1", "", d.orientation.flakiness, false});
  rows.push_back({"rodness", "rodness (f2-f3)/f1", "", d.orientation.rodness, false});
  return rows;
}

std::string descriptor_words(const std::string& key) {
  for (const DescriptorValue& one : list_descriptors(DetailedDescriptors())) {
    if (one.key != key) continue;
    const std::size_t settings =
        std::min(one.label.find(", balls of"), one.label.find(" (cut-off"));
    const bool is_in_brackets = settings < one.label.size() && one.label[settings] == ',';
    return one.label.substr(0, settings) + (is_in_brackets ? ")" : "");
  }
  return "";
}

bool is_read_first(std::string_view key) {
  constexpr std::string_view keys[] = {"sphericity_wadell", "convexity", "zingg_elongation_box",
                                       "zingg_flatness_box", "roundness_wadell"};
  return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

namespace {

/// Returns the common label of two rows. Labels differ only in the cut-off lengths in brackets,
/// which have their own row.
std::string shared_label(const std::string& one, const std::string& other) {
  return one == other ? one : one.substr(0, one.find(" (")) + " (each at its cut-off)";
}

}  // namespace

std::vector<DescriptorComparison> compare_descriptors(const std::vector<DescriptorValue>& reference,
                                                      const std::vector<DescriptorValue>& values) {
  if (reference.size() != values.size()) {
    refuse("The two lists contain " + std::to_string(reference.size()) + " and " +
           std::to_string(values.size()) +
           " descriptors. Compare lists made by the same function.");
  }
  // Sizes for the test of near zero: 1 for numbers without a unit, otherwise the largest value with
  // the unit, such as the longest axis for lengths.
  std::map<std::string, double> sizes = {{"", 1.0}};
  for (const DescriptorValue& row : reference) {
    double& size = sizes[row.unit];
    if (!row.unit.empty() && std::isfinite(row.value)) size = std::max(size, std::abs(row.value));
  }
  std::vector<DescriptorComparison> rows;
  rows.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const DescriptorValue& from = reference[i];
    const DescriptorValue& to = values[i];
    if (from.key != to.key) {
      refuse("Row " + std::to_string(i) + " is " + from.key + " in one list and " + to.key +
             " in the other. Compare lists made by the same function.");
    }
    const bool near_zero = std::abs(from.value) < near_zero_share * sizes[from.unit];
    const double error = from.on_ratio_scale && !near_zero
                             ? relative_error_percent(to.value, from.value)
                             : not_a_number;
    rows.push_back(
        {from.key, shared_label(from.label, to.label), from.unit, from.value, to.value, error});
  }
  return rows;
}

namespace {

std::string label_cell(const std::string& label, const std::string& unit) {
  return "  " + label + (unit.empty() ? "" : ", " + unit);
}

}  // namespace

std::vector<std::string> table_lines(const std::vector<DescriptorValue>& values) {
  std::vector<std::vector<std::string>> cells = {{"Descriptor", "value"}};
  for (const DescriptorValue& row : values) {
    cells.push_back({label_cell(row.label, row.unit), format_number(row.value)});
  }
  return aligned_lines(cells);
}

std::vector<std::vector<std::string>> resolution_rows(const std::vector<DescriptorValue>& values,
                                                      const Resolution& resolution) {
  std::vector<std::vector<std::string>> cells = {
      {"Descriptor", "value", "corrected", "low", "high"}};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ResolvedValue& row = resolution.rows[k];
    cells.push_back({label_cell(values[k].label, values[k].unit), format_number(row.value)});
    if (row.is_resolved()) {
      for (const double value : {row.corrected, row.low, row.high}) {
        cells.back().push_back(format_number(value));
      }
    } else {
      cells.back().insert(cells.back().end(), {"not resolved", "", ""});
    }
  }
  return cells;
}

std::vector<std::string> table_lines(const std::vector<DescriptorValue>& values,
                                     const Resolution& resolution) {
  return aligned_lines(resolution_rows(values, resolution));
}

std::string resolution_sentence(const Resolution& resolution) {
  if (!resolution.has_voxels) {
    return "Nothing is resolved: the mesh does not show voxels of this size. Take a mesh as "
           "wscvt extract writes it, and the size in its unit.";
  }
  constexpr std::pair<const char*, const char*> told[] = {{"area", "area"},
                                                          {"sphericity_wadell", "sphericity"},
                                                          {"convexity", "convexity"},
                                                          {"roundness_wadell", "roundness"},
                                                          {"sq", "Sq"}};
  std::vector<std::string> errors;
  std::vector<std::string> missing;
  for (const auto& [key, name] : told) {
    const auto row = std::find_if(resolution.rows.begin(), resolution.rows.end(),
                                  [key = key](const ResolvedValue& one) { return one.key == key; });
    if (row == resolution.rows.end()) continue;
    if (!row->is_resolved()) {
      missing.emplace_back(name);
      continue;
    }
    errors.push_back(name + (" " + error_text(relative_error_percent(row->value, row->corrected))));
  }
  std::string sentence = "The grain is " + format_number(resolution.voxels_across, 3) +
                         " voxels across. Errors by the voxels, about: " +
                         (errors.empty() ? "none is known" : listed(errors)) + ".";
  if (!missing.empty()) sentence += " Not resolved: " + listed(missing) + ".";
  return sentence;
}

std::vector<std::string> table_lines(const std::vector<DescriptorComparison>& rows,
                                     const ComparisonNames& names) {
  std::vector<std::vector<std::string>> cells = {
      {"Descriptor", names.reference, names.value, "error %"}};
  for (const DescriptorComparison& row : rows) {
    cells.push_back({label_cell(row.label, row.unit), format_number(row.reference),
                     format_number(row.value), format_error(row.error_percent)});
  }
  return aligned_lines(cells);
}

}  // namespace wscvt
