// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/call/command.h"

namespace wscvt::program {

std::string exit_code_text(bool some_may_fail) {
  return std::string("Exit codes: 0 done; 1 the work failed; 2 wrong arguments") +
         (some_may_fail
              ? "; 3 done, but some grains failed or more than 5 % of a volume was left out"
              : "") +
         "; 130 cancelled by SIGINT; 143 cancelled by SIGTERM. A message on the standard error "
         "says what to do.";
}

CLI::App& add_command(CLI::App& program, const CommandText& text) {
  CLI::App& app = *program.add_subcommand(text.name, text.purpose);
  app.group("Commands");
  CLI::Option* help_all = app.set_help_all_flag("--help-all", "Print all options and exit");
  if (!text.has_finer_settings) help_all->group("");
  std::string footer = "Examples:\n";
  for (const std::string& example : text.examples) {
    footer += "  wscvt " + text.name + " " + example + "\n";
  }
  if (!text.notes.empty()) footer += text.notes + "\n";
  app.footer(footer + exit_code_text(text.some_may_fail));
  return app;
}

CLI::Option* add_output(CLI::App& app, const std::string& name, std::string& path,
                        const std::string& description, const std::string& type) {
  return app.add_option("-o,--output," + name, path, description)->type_name(type)->required();
}

void move_to_finer_settings(CLI::App& app, const std::vector<std::string>& names) {
  for (const std::string& name : names) app.get_option(name)->group(finer_settings);
}

CLI::Option* add_typed(CLI::App& app, const std::string& names,
                       const std::function<void(std::string_view)>& read) {
  const std::size_t long_name = names.find("--");
  const std::string name = long_name == std::string::npos ? names : names.substr(long_name);
  return app
      .add_option_function<std::string>(names,
                                        [name, read](const std::string& text) {
                                          try {
                                            read(text);
                                          } catch (const Error& error) {
                                            throw CLI::ValidationError(name, error.what());
                                          }
                                        })
      ->take_last();  // a later value replaces an earlier one, for example one copied from a report
}

}  // namespace wscvt::program
