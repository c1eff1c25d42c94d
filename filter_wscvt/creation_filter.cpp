// SPDX-License-Identifier: GPL-3.0-or-later
#include "creation_filter.h"

#include <algorithm>
#include <vector>

#include "report_file.h"
#include "wscvt/base/error.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt::filter {

namespace {

FilterParameter semi_axis(const std::string& name, double default_value, const std::string& axis) {
  // The limit is in one tooltip only, because the dialog is long.
  return option_parameter(name, default_value, semi_axis_option, "Semi-axis along " + axis,
                          "Half the extent along " + axis +
                              (axis == "x" ? ", not for harmonics. At most about 20 times another "
                                             "semi-axis, 5 times with exponents above 1."
                                           : "."));
}

FilterParameter exponent(const std::string& name, const NumberOption<double>& option,
                         const std::string& label, const std::string& where) {
  return option_parameter(name, 1.0, option, label,
                          "Superellipsoid (Barr, 1981) only: squareness " + where +
                              ". 0.1 nearly a box, 1 round as the ellipsoid, 2 a bevelled edge.");
}

}  // namespace

std::string creation_name() { return "Create: grain from ellipsoid, superellipsoid or harmonics"; }

std::string creation_help() {
  // One line: the dialog of 2020.09 does not scroll, and Apply must fit on a screen 768 pixels
  // high.
  return "Makes a closed mesh with <b>exactly the given number of nodes</b>.";
}

ParameterList creation_parameters() {
  ParameterList parameters = {
      table_parameter("Surface", SurfaceKind::Ellipsoid, "Surface", "The surface to be meshed."),
      semi_axis("SemiAxisX", 1.0, "x"),
      semi_axis("SemiAxisY", 1.0, "y"),
      semi_axis("SemiAxisZ", 1.0, "z"),
      exponent("PolarExponent", polar_exponent_option, "Polar exponent", "seen from the side"),
      exponent("AzimuthalExponent", azimuthal_exponent_option, "Azimuthal exponent",
               "seen along z"),
      file_parameter(
          "CoefficientsFile", ParameterKind::InputFile, {".dat", ".sh", ".json"},
          "Coefficients file",
          "For harmonics: .dat (text of the NIST/VCCTL particle shape sets), .sh (SHTOOLS, 4pi) or "
          ".json (from the remesher). The radius must be positive everywhere."),
      option_parameter("CoefficientDegree", -1, coefficient_degree_option,
                       "Cut the series at degree",
                       "For a .dat or .sh file, as in the tables of the particle shape sets. -1 "
                       "keeps all degrees."),
      node_count_parameter(),
      method_parameter(),
      weighting_parameter(),
      curvature_alpha_parameter(),
      placement_parameter(),
      edge_ratio_parameter(),
      table_parameter("Quality", CreationSettings().result.quality, "Vertex quality",
                      "Value stored at each vertex of the result."),
      colour_by_quality_parameter(),
      report_file_parameter(),
  };
  const std::vector<std::string> seldom = {"CoefficientDegree", "CurvatureAlpha", "EdgeRatio"};
  for (FilterParameter& parameter : parameters) {
    parameter.advanced = std::find(seldom.begin(), seldom.end(), parameter.name) != seldom.end();
  }
  return parameters;
}

CreationSettings read_creation_settings(const ParameterValues& values) {
  const CheckedValues checked(creation_parameters(), values);
  CreationSettings settings;
  GrainSurface& surface = settings.surface;
  surface.kind = checked.choice<SurfaceKind>("Surface");
  surface.semi_axes =
      Vector3(checked.real("SemiAxisX"), checked.real("SemiAxisY"), checked.real("SemiAxisZ"));
  surface.polar_exponent = checked.real("PolarExponent");
  surface.azimuthal_exponent = checked.real("AzimuthalExponent");
  surface.coefficients_file = checked.text("CoefficientsFile");
  surface.coefficient_degree = checked.whole("CoefficientDegree");
  if (surface.kind == SurfaceKind::Harmonics) {
    if (surface.coefficients_file.empty()) {
      refuse(
          "Parameter CoefficientsFile is empty. Give the .dat, .sh or .json file with the "
          "coefficients of the harmonics. Nothing was changed.");
    }
    check_extension(surface.coefficients_file, {".dat", ".sh", ".json"}, "CoefficientsFile");
  }
  settings.options = read_node_options(checked, true);
  settings.result.quality = checked.choice<VertexQuality>("Quality");
  request_quality(settings.options, settings.result.quality);
  settings.result.colour_by_quality = checked.flag("ColorByQuality");
  settings.result.report_file = checked.text("ReportFile");
  check_remesh_report_file(settings.result.report_file);
  check_different_files(settings.result.report_file, "ReportFile", surface.coefficients_file,
                        "CoefficientsFile");
  return settings;
}

}  // namespace wscvt::filter
