// SPDX-License-Identifier: GPL-3.0-or-later
#include "shown_words.h"

#include <algorithm>
#include <map>
#include <regex>
#include <string_view>

#include "everyday_filter.h"
#include "filters.h"
#include "remesh_filter.h"
#include "wscvt/base/option_words.h"
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

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// Whether the remesher has the parameter but the basic dialog does not.
bool is_in_full_dialog_only(const std::string& name) {
  const auto holds = [&](const ParameterList& list) {
    return std::any_of(list.begin(), list.end(),
                       [&](const FilterParameter& parameter) { return parameter.name == name; });
  };
  return holds(remesh_parameters()) && !holds(everyday_parameters());
}

/// Returns "the method on-scan" as the dialog shows it.
template <class Enumeration>
void show_values(std::string& text, const std::string& subject) {
  for (const auto& row : enumerators<Enumeration>()) {
    replace_all(text, "the " + subject + " " + std::string(row.key),
                "the " + subject + " \"" + capitalised(row.label) + "\"");
  }
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

std::string shown_words(const std::string& sentence) {
  const std::map<std::string, std::string> labels = labels_by_name();
  std::string text = with_option_names(sentence, [&](std::string_view key) {
    const auto name = names_by_option().find(key);
    if (name == names_by_option().end()) return "wscvt --" + std::string(key);
    const std::string label = "\"" + labels.at(name->second) + "\"";
    return is_in_full_dialog_only(name->second) ? label + " (in " + remesh_name() + ")" : label;
  });
  show_values<Method>(text, "method");
  show_values<ScanPlacement>(text, "placement");
  for (const auto& [name, label] : labels) text = with_label(text, name, label);
  return text;
}

}  // namespace wscvt::filter
