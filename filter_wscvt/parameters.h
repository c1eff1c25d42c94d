// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "wscvt/base/option.h"

namespace wscvt::filter {

/// What a parameter holds.
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
  std::string tooltip;       ///< what it does
  std::string choices_help;  ///< of a Choice: what each one does
  bool advanced = false;     ///< folded away at first by hosts that can
  bool required = false;     ///< in a script: hosts drop what they cannot read, and say nothing
};

/// Parameters in the order in which a dialog shows them.
using ParameterList = std::vector<FilterParameter>;

/// A label without what stands in brackets behind it: "WSCVT-D", for names that are to be short.
std::string short_label(std::string_view label);

FilterParameter integer_parameter(std::string name, int default_value, int minimum, int maximum,
                                  std::string label, std::string tooltip);
FilterParameter real_parameter(std::string name, double default_value, double minimum,
                               double maximum, std::string label, std::string tooltip);
FilterParameter choice_parameter(std::string name, int default_index,
                                 std::vector<std::string> choices, std::string label,
                                 std::string tooltip);

/// All that a dialog says of a parameter.
std::string whole_tooltip(const FilterParameter& parameter);

/// What a dialog without room for all of it says: of what the parameter does the first sentences,
/// as many as fit into so many characters together; the first one always.
std::string brief_tooltip(const FilterParameter& parameter, std::size_t most_characters);

/// A parameter for an option of the library: its range, which the tooltip then tells as well.
FilterParameter option_parameter(std::string name, int default_value,
                                 const NumberOption<int>& option, std::string label,
                                 const std::string& tooltip);
FilterParameter option_parameter(std::string name, double default_value,
                                 const NumberOption<double>& option, std::string label,
                                 const std::string& tooltip);

/// The labels of an enumeration as a dialog shows them, in the order of its values.
template <class Enumeration>
std::vector<std::string> choices_of() {
  std::vector<std::string> choices;
  for (const auto& row : enumerators<Enumeration>()) choices.push_back(capitalised(row.label));
  return choices;
}

/// A parameter for an enumeration of the library. The tooltip tells what each choice does.
template <class Enumeration>
FilterParameter table_parameter(std::string name, Enumeration default_value, std::string label,
                                std::string tooltip) {
  FilterParameter parameter =
      choice_parameter(std::move(name), static_cast<int>(default_value), choices_of<Enumeration>(),
                       std::move(label), std::move(tooltip));
  for (const auto& row : enumerators<Enumeration>()) {
    if (row.meaning.empty()) continue;
    parameter.choices_help.append(" ").append(short_label(row.label)).append(": ");
    parameter.choices_help.append(row.meaning).append(".");
  }
  return parameter;
}

FilterParameter flag_parameter(std::string name, bool default_value, std::string label,
                               std::string tooltip);
FilterParameter text_parameter(std::string name, std::string label, std::string tooltip);
FilterParameter input_file_parameter(std::string name, std::vector<std::string> extensions,
                                     std::string label, std::string tooltip);
FilterParameter output_file_parameter(std::string name, std::vector<std::string> extensions,
                                      std::string label, std::string tooltip);

/// A number, with enumerations as index and flags as 0 or 1, or a text.
using ParameterValue = std::variant<double, std::string>;

/// Parameter values by name.
using ParameterValues = std::map<std::string, ParameterValue>;

/// The values of all parameters of a list, checked. Scripts check nothing, so every value is
/// checked here.
class CheckedValues {
 public:
  /// A name that is missing takes its default. Throws Error(InvalidInput) for a value that is not
  /// finite, out of range, of the wrong sort or, except for a Real, not whole.
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

/// A parameter of version 2, which scripts may still hold, and what to use instead.
struct ReplacedParameter {
  const char* name;
  const char* instead;
};

/// All of them, whichever filter had them.
const std::vector<ReplacedParameter>& replaced_parameters();

/// The decimal number a user typed, given the float a host made of it: 0.1, not 0.100000001.
double typed_value(float value);

/// The same in a host whose numbers are doubles, but which reads scripts and fields as floats.
double typed_value(double value);

}  // namespace wscvt::filter
