// SPDX-License-Identifier: GPL-3.0-or-later
#include "completion.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

namespace {

/// A case of bash for every option whose values have names. An option of both methods has a case
/// with the values of both.
class ChoiceCases {
 public:
  explicit ChoiceCases(const CLI::App& command) : command_(command) {}

  template <class Number>
  void operator()(const Number&, const NumberOption<Number>&) {}
  void operator()(const bool&, const FlagOption&) {}

  template <class Enumeration>
  void operator()(const Enumeration&) {
    const std::string name = "--" + std::string(EnumerationTable<Enumeration>::key);
    const CLI::Option* option = command_.get_option_no_throw(name);
    if (option == nullptr) return;
    std::string names = name;
    for (const std::string& letter : option->get_snames()) names += "|-" + letter;
    auto [place, is_new] = values_.emplace(names, std::vector<std::string>());
    if (is_new) order_.push_back(names);
    std::vector<std::string>& values = place->second;
    for (const auto& row : enumerators<Enumeration>()) {
      const std::string key(row.key);
      if (std::find(values.begin(), values.end(), key) == values.end()) values.push_back(key);
    }
  }

  std::string text() const {
    std::string cases;
    for (const std::string& names : order_) {
      std::string values;
      for (const std::string& value : values_.at(names))
        values += (values.empty() ? "" : " ") + value;
      cases += "    " + names + ") words=\"" + values + "\" ;;\n";
    }
    return cases;
  }

 private:
  const CLI::App& command_;
  std::map<std::string, std::vector<std::string>> values_;
  std::vector<std::string> order_;
};

/// "--nodes --method ...", without those that only old scripts use.
std::string options_of(const CLI::App& app) {
  std::string names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) {
      names.append(names.empty() ? "--" : " --").append(name);
    }
  }
  return names;
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  const RemeshOptions options;
  const AsPublishedOptions published;
  std::string commands;
  std::string command_cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    commands += command->get_name() + " ";
    command_cases += "    " + command->get_name() + ") words=\"" + options_of(*command) + "\" ;;\n";
  }
  ChoiceCases choices(*program.get_subcommand("remesh"));
  for_each_option(options, choices);
  for_each_method_option(published, choices);
  return "# bash completion of wscvt; wscvt --completion writes it\n"
         "_wscvt() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} words=\n"
         "  case ${COMP_WORDS[COMP_CWORD-1]} in\n" +
         choices.text() +
         "  esac\n"
         "  if [ -n \"$words\" ]; then\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \"" +
         commands + options_of(program) +
         "\" -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  case $command in\n" +
         command_cases + "    *) words=\"" + options_of(*program.get_subcommand("remesh")) +
         "\" ;;\n"
         "  esac\n"
         "  case $current in\n"
         "    -*) COMPREPLY=($(compgen -W \"$words\" -- \"$current\")) ;;\n"
         "    *) COMPREPLY=() ;;\n"
         "  esac\n"
         "}\n"
         "complete -o default -F _wscvt wscvt\n";
}

}  // namespace wscvt::program
