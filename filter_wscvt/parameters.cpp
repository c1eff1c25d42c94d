// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameters.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text.h"

namespace wscvt::filter {

namespace {

double checked_value(const FilterParameter& parameter, double value) {
  const bool whole = parameter.kind == ParameterKind::Real || value == std::floor(value);
  if (value >= parameter.minimum && value <= parameter.maximum && whole) return value;

  std::string sentence = "Parameter " + parameter.name + " is " + typed_text(value) + ". Give ";
  if (parameter.kind == ParameterKind::Choice) {
    std::vector<std::string> choices;
    for (const std::string& choice : parameter.choices) {
      choices.push_back(std::to_string(choices.size()) + " (" + choice + ")");
    }
    sentence += enumerated(choices, " or ");
  } else {
    sentence += parameter.kind == ParameterKind::Real ? "a number from " : "a whole number from ";
    sentence += typed_text(parameter.minimum) + " to " + typed_text(parameter.maximum);
  }
  refuse(sentence + ". Nothing was changed.");
}

ParameterValue default_of(const FilterParameter& parameter) {
  if (holds_text(parameter.kind)) return std::string();
  return parameter.default_value;
}

ParameterValue checked(const FilterParameter& parameter, const ParameterValue& value) {
  const bool is_text = std::holds_alternative<std::string>(value);
  if (is_text != holds_text(parameter.kind)) {
    refuse("Parameter " + parameter.name + " is " +
           (is_text ? "a text. Give a number." : "a number. Give a text."));
  }
  if (is_text) return value;
  return checked_value(parameter, std::get<double>(value));
}

}  // namespace

bool holds_text(ParameterKind kind) { return kind == ParameterKind::Text || holds_file(kind); }

bool holds_file(ParameterKind kind) {
  return kind == ParameterKind::InputFile || kind == ParameterKind::OutputFile;
}

FilterParameter number_parameter(std::string name, ParameterKind kind, double default_value,
                                 double minimum, double maximum, std::string label,
                                 std::string tooltip) {
  FilterParameter parameter;
  parameter.name = std::move(name);
  parameter.kind = kind;
  parameter.default_value = default_value;
  parameter.minimum = minimum;
  parameter.maximum = maximum;
  parameter.label = std::move(label);
  parameter.tooltip = std::move(tooltip);
  return parameter;
}

std::string whole_tooltip(const FilterParameter& parameter) {
  return parameter.tooltip + parameter.choices_help;
}

std::string brief_tooltip(const FilterParameter& parameter, std::size_t most_characters) {
  const std::string& text = parameter.tooltip;
  std::size_t length = 0;
  while (length < text.size()) {
    const std::size_t stop = text.find(". ", length);
    const std::size_t end = stop == std::string::npos ? text.size() : stop + 1;
    if (length > 0 && end > most_characters) break;
    length = end;
  }
  return text.substr(0, length);
}

std::string short_label(std::string_view label) {
  return capitalised(label.substr(0, label.find(" (")));
}

FilterParameter flag_parameter(std::string name, bool default_value, std::string label,
                               std::string tooltip) {
  return number_parameter(std::move(name), ParameterKind::Flag, default_value ? 1 : 0, 0, 1,
                          std::move(label), std::move(tooltip));
}

FilterParameter text_parameter(std::string name, std::string label, std::string tooltip) {
  return number_parameter(std::move(name), ParameterKind::Text, 0, 0, 0, std::move(label),
                          std::move(tooltip));
}

FilterParameter file_parameter(std::string name, ParameterKind kind,
                               std::vector<std::string> extensions, std::string label,
                               std::string tooltip) {
  FilterParameter parameter =
      number_parameter(std::move(name), kind, 0, 0, 0, std::move(label), std::move(tooltip));
  parameter.extensions = std::move(extensions);
  return parameter;
}

CheckedValues::CheckedValues(const ParameterList& parameters, const ParameterValues& values) {
  for (const FilterParameter& parameter : parameters) {
    const auto given = values.find(parameter.name);
    values_[parameter.name] =
        given == values.end() ? default_of(parameter) : checked(parameter, given->second);
  }
}

double typed_value(float value) {
  std::array<char, 32> buffer{};
  const auto text = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  double result = 0.0;
  std::from_chars(buffer.data(), text.ptr, result);
  return result;
}

double typed_value(double value) {
  const auto read_as_float = static_cast<float>(value);
  return static_cast<double>(read_as_float) == value ? typed_value(read_as_float) : value;
}

}  // namespace wscvt::filter
