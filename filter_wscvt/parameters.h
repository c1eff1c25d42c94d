// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "wscvt/base/option.h"

namespace wscvt::filter {

/// Kind of a parameter's value.
enum class ParameterKind {
  Integer,     ///< a whole number
  Real,        ///< a decimal number
  Choice,      ///< an index into `choices`
  Flag,        ///< 0 or 1
  Text,        ///< a layer's name, UTF-8
  InputFile,   ///< name of a file to be read, UTF-8
  OutputFile,  ///< name of a file to be written, UTF-8
};

/// Whether a value of the kind is a text, not a number.
bool holds_text(ParameterKind kind);

/// Whether a value of the kind names a file.
bool holds_file(ParameterKind kind);

/// One parameter of a filter, free of any host's types.
struct FilterParameter {
  std::string name;  ///< saved in scripts: never changes
  ParameterKind kind = ParameterKind::Integer;
  double default_value = 0.0;           ///< of a number; a Text is empty
  double minimum = 0.0;                 ///< smallest value accepted
  double maximum = 0.0;                 ///< largest value accepted
  std::vector<std::string> choices;     ///< of a Choice, in the order of their index
  std::vector<std::string> extensions;  ///< of a file: ".json", ...
  std::string label;
  std::string tooltip;       ///< its effect
  std::string choices_help;  ///< of a Choice: the effect of each choice
  bool advanced = false;     ///< hidden at first, if the host can
  bool required = false;     ///< in a script: hosts silently drop unreadable values
};

/// Parameters in the order in which a dialog shows them.
using ParameterList = std::vector<FilterParameter>;

/// Returns a label without the brackets at its end: "WSCVT-D", for short names.
std::string short_label(std::string_view label);

FilterParameter number_parameter(std::string name, ParameterKind kind, double default_value,
                                 double minimum, double maximum, std::string label,
                                 std::string tooltip);

/// Returns the full help text of a parameter.
std::string whole_tooltip(const FilterParameter& parameter);

/// Returns a short help text for dialogs without enough room: the first sentences of the tooltip
/// that fit into `most` characters together, at least one.
std::string brief_tooltip(const FilterParameter& parameter, std::size_t most_characters);

/// Makes a parameter for an option of the library. The tooltip includes its range.
template <class Number>
FilterParameter option_parameter(std::string name, Number default_value,
                                 const NumberOption<Number>& option, std::string label,
                                 const std::string& tooltip) {
  constexpr bool is_whole = std::is_integral_v<Number>;
  return number_parameter(std::move(name), is_whole ? ParameterKind::Integer : ParameterKind::Real,
                          default_value, option.minimum, option.maximum, std::move(label),
                          tooltip + " " + capitalised(range_text(option)) + ".");
}

/// Makes a parameter for an enumeration of the library. The tooltip explains each choice.
template <class Enumeration>
FilterParameter table_parameter(std::string name, Enumeration default_value, std::string label,
                                std::string tooltip) {
  const auto& rows = enumerators<Enumeration>();
  FilterParameter parameter =
      number_parameter(std::move(name), ParameterKind::Choice, static_cast<int>(default_value), 0,
                       static_cast<int>(std::size(rows)) - 1, std::move(label), std::move(tooltip));
  for (const auto& row : rows) {
    parameter.choices.push_back(capitalised(row.label));
    if (row.meaning.empty()) continue;
    parameter.choices_help.append(" ").append(short_label(row.label)).append(": ");
    parameter.choices_help.append(row.meaning).append(".");
  }
  return parameter;
}

FilterParameter flag_parameter(std::string name, bool default_value, std::string label,
                               std::string tooltip);
FilterParameter text_parameter(std::string name, std::string label, std::string tooltip);
FilterParameter file_parameter(std::string name, ParameterKind kind,
                               std::vector<std::string> extensions, std::string label,
                               std::string tooltip);

/// A number, with enumerations as index and flags as 0 or 1, or a text.
using ParameterValue = std::variant<double, std::string>;

/// Parameter values by name.
using ParameterValues = std::map<std::string, ParameterValue>;

/// The checked values of all parameters of a list. Scripts check nothing, so every value is checked
/// here.
class CheckedValues {
 public:
  /// A missing name gets its default. Throws Error(InvalidInput) for a value that is not finite,
  /// out of range, of the wrong kind or, except for a Real, not an integer.
  CheckedValues(const ParameterList& parameters, const ParameterValues& values);

  double real(const std::string& name) const { return std::get<double>(values_.at(name)); }
  int whole(const std::string& name) const { return static_cast<int>(real(name)); }
  bool flag(const std::string& name) const { return real(name) != 0.0; }
  const std::string& text(const std::string& name) const {
    return std::get<std::string>(values_.at(name));
  }
  template <class Enumeration>
  Enumeration choice(const std::string& name) const {
    return static_cast<Enumeration>(whole(name));
  }

 private:
  ParameterValues values_;
};

/// Returns the decimal number that the user typed, from the host's float: 0.1, not 0.100000001.
double typed_value(float value);

/// For hosts that store doubles, but read scripts and fields as floats.
double typed_value(double value);

}  // namespace wscvt::filter
