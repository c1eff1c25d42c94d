// SPDX-License-Identifier: GPL-3.0-or-later
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "program/call/help_text.h"
#include "wscvt/base/version.h"

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

namespace {

/// Returns a text for roff: typed text has minus signs instead of hyphens, and no line is a
/// request.
std::string roff(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (letter == '.' || letter == '\'')) result += "\\&";
    if (letter == '\\') {
      result += "\\e";
    } else if (letter == '-') {
      result += "\\-";
    } else {
      result += letter;
    }
  }
  return result;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }

std::string heading(std::string_view text) {
  std::string capitals(text);
  for (char& letter : capitals) {
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  }
  return ".SH \"" + roff(capitals) + "\"\n";
}

std::string term(const std::string& name, const std::string& meaning) {
  return ".TP\n" + name + "\n" + meaning + "\n";
}

/// Returns the entry of an option, with its values and their meanings.
std::string option_entry(const CLI::Option& option, bool is_positional) {
  const HelpFormatter help(HelpFormatter::Extent::Full);
  std::string names = bold(help.make_option_name(&option, is_positional));
  if (!is_positional && option.get_positional()) {
    return term(names + " " + roff(option.get_type_name()),
                roff("Same as " + option.get_name(true)));
  }
  names += roff(help.make_option_opts(&option));
  std::string text = ".TP\n" + names + "\n";
  bool is_first = true;
  for (const HelpParagraph& paragraph : help_paragraphs(option)) {
    const std::string meaning = roff(paragraph.text);
    if (paragraph.value.empty()) {
      text += (is_first ? "" : ".IP\n") + meaning + "\n";
    } else {
      text += ".RS\n" + term(bold(paragraph.value), meaning) + ".RE\n";
    }
    is_first = false;
  }
  return text;
}

/// Returns the examples and the texts below them in the help.
std::string footer_sections(const std::string& footer) {
  std::string text = ".PP\n";
  bool is_call = false;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    const std::string exit_codes = "Exit codes: ";
    const bool was_call = is_call;
    is_call = line.rfind("  ", 0) == 0;
    if (was_call && !is_call) text += ".EE\n.PP\n";
    if (is_call && !was_call) text += ".PP\n.EX\n";
    if (line == "Examples:") {
      text += heading("Examples");
    } else if (line.rfind(exit_codes, 0) == 0) {
      text += heading("Exit status") + roff(line.substr(exit_codes.size())) + "\n";
    } else {
      text += roff(line) + "\n";
    }
  }
  return text;
}

ManPage page_of(const CLI::App& app, const CLI::App& program) {
  const bool is_command = &app != &program;
  const std::string name = program.get_name() + (is_command ? "-" + app.get_name() : "");
  const std::string call = program.get_name() + (is_command ? " " + app.get_name() : "");
  std::string capitals = heading(name).substr(4);
  capitals.pop_back();
  std::string text = ".TH " + capitals + " 1 \"\" \"wscvt " + version() + "\" \"User Commands\"\n";
  text += heading("Name") + roff(name) + " \\- " + roff(app.get_description()) + "\n";
  const std::string usage =
      HelpFormatter(HelpFormatter::Extent::Full, std::string::npos).make_usage(&app, call);
  text += heading("Synopsis") + roff(usage.substr(usage.find(": ") + 2));
  const auto options = [&](const std::string& title, bool is_positional, const auto& is_wanted) {
    std::string entries;
    for (const CLI::Option* option : app.get_options(is_wanted)) {
      entries += option_entry(*option, is_positional);
    }
    if (!entries.empty()) text += heading(title) + entries;
  };
  options("Arguments", true, [](const CLI::Option* option) {
    return option->get_positional() && !option->get_group().empty();
  });
  std::string others;
  for (const std::string& group : app.get_groups()) {
    if (group.empty()) continue;
    options(group, false, [&](const CLI::Option* option) {
      return option->nonpositional() && option->get_group() == group;
    });
  }
  for (const CLI::App* command : app.get_subcommands({})) {
    if (others.empty()) text += heading("Commands");
    text += term(bold(command->get_name()), roff(command->get_description() + "."));
    others += (others.empty() ? "" : ", ") + bold("wscvt-" + command->get_name()) + "(1)";
  }
  text += footer_sections(app.get_footer());
  text += heading("See also") + (is_command ? bold(program.get_name()) + "(1)" : others) + "\n";
  return {name + ".1", text};
}

}  // namespace

std::vector<ManPage> man_pages(const CLI::App& program) {
  std::vector<ManPage> pages = {page_of(program, program)};
  for (const CLI::App* command : program.get_subcommands({})) {
    pages.push_back(page_of(*command, program));
  }
  return pages;
}

}  // namespace wscvt::program
