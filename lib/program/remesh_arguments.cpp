// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_arguments.h"

#include <string>
#include <string_view>

#include "help_text.h"
#include "wscvt/base/error.h"

namespace wscvt::program {

namespace {

/// Options of everyday work, which the help shows first, and their letters. A key that is not here
/// stands under the finer settings.
struct Everyday {
  std::string_view key;
  char letter;  ///< 0: none
};
constexpr Everyday everyday[] = {
    {node_count_option.key, 'n'},
    {EnumerationTable<Method>::key, 0},
    {EnumerationTable<Weighting>::key, 'w'},
    {EnumerationTable<RelaxationMetric>::key, 'm'},
    {EnumerationTable<NodePlacement>::key, 'p'},
    {refinement_rounds_option.key, 'r'},
    {EnumerationTable<Sampling>::key, 's'},
    {harmonic_degree_option.key, 'd'},
    {curvature_alpha_option.key, 'a'},
    {maximum_iterations_option.key, 'i'},
    {error_target_option.key, 0},
    {EnumerationTable<ErrorMeasure>::key, 0},
    {largest_node_count_option.key, 0},
    {fold_limit_option.key, 0},
    {points_option.key, 0},
    {distances_option.key, 0},
};

class AddArgument {
 public:
  explicit AddArgument(CLI::App& app) : app_(app) {}

  template <class Number>
  void operator()(Number& value, const NumberOption<Number>& option) {
    add(option.key, "N", [&value, &option](std::string_view text) {
      value = from_typed(text, option);
    })->description(help_of(value, option));
  }

  template <class Enumeration>
  void operator()(Enumeration& value) {
    add(EnumerationTable<Enumeration>::key, "NAME", [&value](std::string_view text) {
      value = from_key<Enumeration>(text);
    })->description(help_of(value));
  }

  void operator()(bool& value, const FlagOption& option) {
    const std::string name = "--" + std::string(option.key);
    // What is on without being asked for needs a way to be off.
    const std::string off = value ? ",!--no-" + std::string(option.key) : "";
    app_.add_flag(name + off, value, help_of(value, option))->group(group_of(option.key));
  }

 private:
  static const Everyday* everyday_of(std::string_view key) {
    for (const Everyday& one : everyday) {
      if (one.key == key) return &one;
    }
    return nullptr;
  }
  static std::string group_of(std::string_view key) {
    return everyday_of(key) != nullptr ? "Options" : "Finer settings";
  }

  template <class Read>
  CLI::Option* add(std::string_view key, const std::string& type, const Read& read) {
    const std::string name = "--" + std::string(key);
    const Everyday* one = everyday_of(key);
    const std::string names =
        one != nullptr && one->letter != 0 ? "-" + std::string(1, one->letter) + "," + name : name;
    return app_
        .add_option_function<std::string>(names,
                                          [name, read](const std::string& text) {
                                            try {
                                              read(text);
                                            } catch (const Error& error) {
                                              throw CLI::ValidationError(name, error.what());
                                            }
                                          })
        ->type_name(type)
        ->take_last()  // so that one can be added behind those of a report
        ->group(group_of(key));
  }

  CLI::App& app_;
};

}  // namespace

void add_remesh_arguments(CLI::App& app, RemeshOptions& options) {
  AddArgument add(app);
  for_each_option(options, add);
}

}  // namespace wscvt::program
