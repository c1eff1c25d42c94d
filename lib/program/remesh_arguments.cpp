// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_arguments.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "command.h"

namespace wscvt::program {

namespace {

/// Options with a letter, or of everyday work, which --help shows; all others stand under the finer
/// settings.
struct Marked {
  std::string_view key;
  char letter;  ///< 0: none
  bool everyday;
};
constexpr Marked marked[] = {
    {node_count_option.key, 'n', true},
    {EnumerationTable<Method>::key, 0, true},
    {EnumerationTable<Weighting>::key, 'w', true},
    {EnumerationTable<RelaxationMetric>::key, 'm', false},
    {EnumerationTable<NodePlacement>::key, 'p', true},
    {refinement_rounds_option.key, 'r', true},
    {EnumerationTable<Sampling>::key, 's', false},
    {harmonic_degree_option.key, 'd', false},
    {curvature_alpha_option.key, 'a', false},
    {maximum_iterations_option.key, 'i', false},
    {error_target_option.key, 0, true},
    {points_option.key, 0, true},
    {distances_option.key, 0, true},
};

/// Options that mean nothing for a surface that is known exactly; see remesh.
constexpr std::string_view of_a_scan[] = {
    EnumerationTable<Method>::key,
    EnumerationTable<CurvatureSource>::key,
    EnumerationTable<Parametrization>::key,
    harmonic_degree_option.key,
    fold_limit_option.key,
    points_option.key,
    envelope_option.key,
    advice_option.key,
    weld_tolerance_option.key,
    mended_area_limit_option.key,
    dropped_volume_limit_option.key,
    handle_length_option.key,
    handle_count_option.key,
};

class AddArgument {
 public:
  AddArgument(CLI::App& app, Remeshed remeshed) : app_(app), remeshed_(remeshed) {}

  template <class Number>
  void operator()(Number& value, const NumberOption<Number>& option) {
    if (!is_wanted(option.key)) return;
    add_number(app_, names_of(option.key), value, option)->group(group_of(option.key));
  }

  template <class Enumeration>
  void operator()(Enumeration& value) {
    constexpr std::string_view key = EnumerationTable<Enumeration>::key;
    if (!is_wanted(key)) return;
    add_choice(app_, names_of(key), value)->group(group_of(key));
  }

  void operator()(bool& value, const FlagOption& option) {
    if (!is_wanted(option.key)) return;
    const std::string name = "--" + std::string(option.key);
    // What is on without being asked for needs a way to be off.
    const std::string off = value ? ",!--no-" + std::string(option.key) : "";
    app_.add_flag(name + off, value, help_of(value, option))->group(group_of(option.key));
  }

 private:
  bool is_wanted(std::string_view key) const {
    return remeshed_ == Remeshed::Scan ||
           std::find(std::begin(of_a_scan), std::end(of_a_scan), key) == std::end(of_a_scan);
  }
  static const Marked* mark_of(std::string_view key) {
    const Marked* found = std::find_if(std::begin(marked), std::end(marked),
                                       [&](const Marked& one) { return one.key == key; });
    return found == std::end(marked) ? nullptr : found;
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
};

}  // namespace

void add_remesh_arguments(CLI::App& app, RemeshOptions& options, Remeshed remeshed) {
  AddArgument add(app, remeshed);
  for_each_option(options, add);
}

}  // namespace wscvt::program
