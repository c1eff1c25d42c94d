// SPDX-License-Identifier: GPL-3.0-or-later
#include "completion.h"

#include <string>
#include <vector>

#include "help_text.h"

namespace wscvt::program {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : " ").append(word);
  return text;
}

/// "    PATTERN) words="WORDS" ;;", a case of bash.
std::string case_of(const std::string& pattern, const std::string& words) {
  return "    " + pattern + ") words=\"" + words + "\" ;;\n";
}

/// Returns cases of "COMMAND OPTION" for the options with named values, and of "COMMAND" for a
/// first argument with named values.
std::string value_cases(const CLI::App& command) {
  std::string cases;
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string> values = listed_values(*option);
    if (values.empty()) continue;
    std::vector<std::string> names;
    for (const std::string& letter : option->get_snames()) names.push_back("-" + letter);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    if (option->get_positional()) names.push_back(command.get_name());
    std::string pattern;
    for (const std::string& name : names) {
      pattern += (pattern.empty() ? "'" : "|'") + command.get_name() + " " + name + "'";
    }
    cases += case_of(pattern, joined(values));
  }
  return cases;
}

/// Returns "--nodes --method ...".
std::string options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return joined(names);
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::vector<std::string> commands;
  std::string option_cases;
  std::string cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    commands.push_back(command->get_name());
    option_cases += case_of(command->get_name(), options_of(*command));
    cases += value_cases(*command);
  }
  const std::string names = joined(commands);
  std::string known;
  for (const std::string& name : commands) known += name + "|";
  return "# bash completion of wscvt, written by wscvt --completion\n"
         "_wscvt() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local command=${COMP_WORDS[1]} words=\n"
         "  if [ \"$current\" = = ]; then\n"
         "    current=\n"
         "  elif [ \"$previous\" = = ]; then\n"
         "    previous=${COMP_WORDS[COMP_CWORD-2]}\n"
         "  fi\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \"" +
         names + " help " + options_of(program) +
         "\" -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  case $command in\n"
         "    " +
         known + "help) ;;\n    *) command=remesh ;;\n" +
         "  esac\n"
         "  case \"$command $previous\" in\n" +
         cases + case_of("'help help'", names) +
         "  esac\n"
         "  if [ -z \"$words\" ] && [[ $current == -* ]]; then\n"
         "    case $command in\n" +
         option_cases +
         "    esac\n"
         "  fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _wscvt wscvt\n";
}

}  // namespace wscvt::program
