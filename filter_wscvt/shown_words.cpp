// SPDX-License-Identifier: GPL-3.0-or-later
#include "shown_words.h"

#include <map>
#include <regex>
#include <string_view>

#include "filters.h"
#include "wscvt/remesh/error_target.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::filter {

namespace {

/// The parameters of all filters and their labels.
std::map<std::string, std::string> labels_by_name() {
  std::map<std::string, std::string> labels;
  for (const Filter& filter : all_filters()) {
    for (const FilterParameter& parameter : filter.parameters) {
      labels[parameter.name] = parameter.label;
    }
  }
  return labels;
}

/// The parameters that are options of the program, by the option's key.
const std::map<std::string_view, const char*>& names_by_option() {
  static const std::map<std::string_view, const char*> names = {
      {"alpha", "CurvatureAlpha"},
      {"degree", "HarmonicDegree"},
      {"edge-ratio", "EdgeRatio"},
      {"error-measure", "TargetMeasure"},
      {"max-error", "ErrorTarget"},
      {"max-overhang", "FoldLimit"},
      {"max-repaired-area", "MendLimit"},
      {"method", "Method"},
      {"nodes", "NodeCount"},
      {"placement", "Placement"},
      {"points", "Points"},
      {"roughness-cutoff", "RoughnessCutoff"},
      {"roundness-ball", "RoundnessBall"},
      {"weighting", "Weighting"},
  };
  return names;
}

/// Returns the value of an option as the dialog shows it, if it is one of the enumeration's.
template <class Enumeration>
void show_value(const NamedOption& option, std::string& shown) {
  if (EnumerationTable<Enumeration>::key != option.key) return;
  for (const auto& row : enumerators<Enumeration>()) {
    if (row.key == option.value) shown = capitalised(row.label);
  }
}

/// Returns an option as the window shows it: "\"Method: On the scan\"".
std::string shown_option(const NamedOption& option,
                         const std::map<std::string, std::string>& labels) {
  const auto name = names_by_option().find(option.key);
  if (name == names_by_option().end()) return "wscvt " + Sentence(option).text();
  std::string value = option.value == "true" ? "" : option.value;
  show_value<Method>(option, value);
  show_value<ScanPlacement>(option, value);
  show_value<PublishedPlacement>(option, value);
  return "\"" + labels.at(name->second) + (value.empty() ? "" : ": " + value) + "\"";
}

/// Returns the text with the label before a script parameter: "Parameter \"Report file\"
/// (ReportFile)".
std::string with_label(const std::string& text, const std::string& name, const std::string& label) {
  const std::string shown = "\"" + label + "\" (" + name + ")";
  const std::regex alone("\\bParameter " + name + "\\b");
  const std::regex among_others("(\\bParameters .*)\\b" + name + "\\b(?!\\))");
  return std::regex_replace(std::regex_replace(text, alone, "Parameter " + shown), among_others,
                            "$1" + shown);
}

}  // namespace

std::string shown_words(const Sentence& sentence) {
  const std::map<std::string, std::string> labels = labels_by_name();
  std::string text =
      sentence.in([&](const NamedOption& option) { return shown_option(option, labels); });
  for (const auto& [name, label] : labels) text = with_label(text, name, label);
  return text;
}

}  // namespace wscvt::filter
