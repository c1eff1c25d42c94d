// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include "program/arguments/common_arguments.h"
#include "program/call/command.h"
#include "program/terminal/terminal.h"
#include "wscvt/base/text.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

namespace {

/// Options with a letter, and basic options that --help shows. All others are advanced options.
struct Marked {
  std::string_view key;
  char letter;  ///< 0: no letter
  bool everyday;
};
constexpr Marked marked[] = {
    {node_count_option.key, 'n', true},
    {EnumerationTable<Method>::key, 0, true},
    {EnumerationTable<CellWeighting>::key, 'w', true},
    {EnumerationTable<ScanPlacement>::key, 'p', true},
    {edge_ratio_option.key, 'e', true},
    {EnumerationTable<Sampling>::key, 's', false},
    {harmonic_degree_option.key, 'd', false},
    {curvature_alpha_option.key, 'a', false},
    {error_target_option.key, 0, true},
    {distances_option.key, 0, true},
};

/// An option that has an effect only with a value of another; empty: with any value.
struct Dependent {
  std::string_view key;
  std::string_view other;
  std::string_view value;
};
constexpr Dependent dependents[] = {
    {curvature_alpha_option.key, EnumerationTable<CellWeighting>::key, "wscvt-c"},
    {contact_radius_option.key, EnumerationTable<ScanPlacement>::key, "contact-fit"},
    {EnumerationTable<ErrorMeasure>::key, error_target_option.key, ""},
};

/// Tells options without an effect. They are no error: a call may have all options of a report.
void tell_idle_options(const TypedOptions& given) {
  for (const Dependent& one : dependents) {
    if (given.count(std::string(one.key)) == 0) continue;
    const auto other = given.find(std::string(one.other));
    const bool is_used =
        other != given.end() && (one.value.empty() || lower_case(other->second) == one.value);
    if (is_used) continue;
    std::string needed = "--" + std::string(one.other);
    if (!one.value.empty()) needed += "=" + std::string(one.value);
    print_error("Warning: --" + std::string(one.key) + " has no effect without " + needed + ".");
  }
}

const Marked* mark_of(std::string_view key) {
  const Marked* found = std::find_if(std::begin(marked), std::end(marked),
                                     [&](const Marked& one) { return one.key == key; });
  return found == std::end(marked) ? nullptr : found;
}

/// Returns the error of a flag's value, `--points=VALUE`; empty if it is correct.
std::string is_true_or_false(const std::string& text) {
  try {
    CLI::detail::to_flag_value(text);
    return "";
  } catch (const std::exception&) {
    return "\"" + text + "\" is neither true nor false";
  }
}

/// Adds an argument for each option, with the help texts of both methods if both have the option.
class AddArgument {
 public:
  AddArgument(CLI::App& app, Remeshed remeshed, TypedOptions& given)
      : app_(app), remeshed_(remeshed), given_(given) {}

  /// Options that follow belong to one method only.
  void begin_method(Method method) { of_method_ = " (" + key_of(method) + ")"; }
  void end_methods() { of_method_.clear(); }

  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) {
    add(option.key, help_of(value, option), "N");
  }
  /// --max-handle-loop says it too: 0 keeps all handles.
  void operator()(const HandleAction& /*value*/) {}
  template <class Enumeration>
  void operator()(const Enumeration& value) {
    add(EnumerationTable<Enumeration>::key, help_of(value), "NAME");
  }
  void operator()(const bool& value, const FlagOption& option) {
    const std::string key(option.key);
    if (!is_option_of(key, remeshed_)) return;
    // A flag that is on by default needs a name that turns it off.
    const std::string off = value ? ",!--no-" + key : "";
    app_.add_flag_function(
            "--" + key + off,
            [this_given = &given_, key](std::int64_t count) {
              (*this_given)[key] = count > 0 ? "true" : "false";
            },
            help_of(value, option))
        ->check(is_true_or_false, "")
        ->group(group_of(key));
  }

 private:
  void add(std::string_view name, const std::string& help, const std::string& type) {
    const std::string key(name);
    if (!is_option_of(key, remeshed_)) return;
    CLI::Option* known = app_.get_option_no_throw("--" + key);
    if (known != nullptr) {
      // Both methods have the option, each with its own values.
      const std::string before = known->get_description();
      known->description(type == "NAME" ? before + "\n" + with_method(help)
                                        : before.substr(0, before.rfind(" (")));
      return;
    }
    app_.add_option_function<std::string>(
            names_of(key),
            [this_given = &given_, key](const std::string& text) { (*this_given)[key] = text; })
        ->take_last()
        ->description(with_method(help))
        ->type_name(type)
        ->group(group_of(key));
  }

  /// Returns the help with the method after the first paragraph, which --help shows.
  std::string with_method(std::string help) const {
    return help.insert(std::min(help.find('\n'), help.size()), of_method_);
  }
  static std::string group_of(std::string_view key) {
    const Marked* mark = mark_of(key);
    return mark != nullptr && mark->everyday ? "Options" : finer_settings;
  }
  static std::string names_of(std::string_view key) {
    const Marked* mark = mark_of(key);
    const std::string name = "--" + std::string(key);
    return mark != nullptr && mark->letter != 0 ? "-" + std::string(1, mark->letter) + "," + name
                                                : name;
  }

  CLI::App& app_;
  Remeshed remeshed_;
  TypedOptions& given_;
  std::string of_method_;
};

}  // namespace

void add_remesh_arguments(CLI::App& app, RemeshOptions& options, Remeshed remeshed) {
  const auto given = std::make_shared<TypedOptions>();
  AddArgument add(app, remeshed, *given);
  const Method method = method_of(options);
  add(method);
  // One method has the caller's defaults, the other the library's.
  const auto* on_scan = std::get_if<OnScanOptions>(&options.method);
  const auto* published = std::get_if<AsPublishedOptions>(&options.method);
  const OnScanOptions scan_defaults = on_scan != nullptr ? *on_scan : OnScanOptions();
  const AsPublishedOptions published_defaults =
      published != nullptr ? *published : AsPublishedOptions();
  add.begin_method(Method::OnScan);
  for_each_method_option(scan_defaults, add);
  add.begin_method(Method::AsPublished);
  for_each_method_option(published_defaults, add);
  add.end_methods();
  for_each_common_option(options, add);
  app.parse_complete_callback([given, &options] {
    read_options(*given, options, [](std::string_view key, const Sentence& refusal) {
      throw CLI::ValidationError("--" + std::string(key), refusal);
    });
    tell_idle_options(*given);
  });
}

}  // namespace wscvt::program
