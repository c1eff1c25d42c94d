// SPDX-License-Identifier: GPL-3.0-or-later
#include "call_words.h"

#include <CLI/Error.hpp>
#include <algorithm>
#include <filesystem>
#include <numeric>
#include <system_error>

namespace wscvt::program {

namespace {

[[noreturn]] void refuse_call(const std::string& sentence) {
  throw CLI::ParseError(sentence, CLI::ExitCodes::InvalidError);
}

/// How many letters are to be put in, taken out or exchanged (Levenshtein 1966).
std::size_t edits_between(const std::string& one, const std::string& other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= one.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= other.size(); ++j) {
      const std::size_t exchanged = diagonal + (one[i - 1] == other[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({exchanged, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

/// " Did you mean WORD?" of the nearest of the words; empty if all are far.
std::string meant_word(const std::string& word, const std::vector<std::string>& words) {
  const auto nearest =
      std::min_element(words.begin(), words.end(), [&](const std::string& a, const std::string& b) {
        return edits_between(word, a) < edits_between(word, b);
      });
  // Two slips of the finger; more are another word.
  const bool is_near = nearest != words.end() && edits_between(word, *nearest) <= 2;
  return is_near ? " Did you mean " + *nearest + "?" : "";
}

[[noreturn]] void refuse_unknown(const std::string& word,
                                 const std::vector<std::string>& commands) {
  std::string names;
  for (const std::string& name : commands) {
    names += (names.empty() ? "" : &name == &commands.back() ? " or " : ", ") + name;
  }
  if (word.empty()) refuse_call("No command is given; give " + names + ".");
  refuse_call("There is no command \"" + word + "\"; give " + names + "." +
              meant_word(word, commands));
}

}  // namespace

std::vector<std::string> call_words(std::vector<std::string> words,
                                    const std::vector<std::string>& commands) {
  const std::string first = words.empty() ? "" : words.front();
  if (std::find(commands.begin(), commands.end(), first) != commands.end()) return words;
  if (first == "help") {
    words.erase(words.begin());
    words.resize(std::min<std::size_t>(words.size(), 1));
    if (!words.empty() && std::find(commands.begin(), commands.end(), words[0]) == commands.end()) {
      refuse_unknown(words[0], commands);
    }
    words.emplace_back("--help");
    return words;
  }
  if (first == "-v") return {"--version"};
  for (const char* own : {"--help", "-h", "--version", "--completion", "--man-pages"}) {
    if (first.substr(0, first.find('=')) == own) return words;
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(first, ignored)) {
    refuse_call("\"" + first + "\" is a folder; \"wscvt batch " + first +
                " -o OUT\" remeshes the scans in it.");
  }
  // A file has a point for its ending, or a slash.
  if (first.find_first_of("-./") == std::string::npos) refuse_unknown(first, commands);
  const auto option = std::find_if(words.begin(), words.end(),
                                   [](const std::string& word) { return word.rfind('-', 0) == 0; });
  const bool is_output_named = std::find_if(option, words.end(), [](const std::string& word) {
                                 return word.rfind("-o", 0) == 0 || word.rfind("--output", 0) == 0;
                               }) != words.end();
  if (option - words.begin() > (is_output_named ? 1 : 2)) {
    refuse_call(
        "A remesh is of one scan, to one output; \"wscvt batch SCANS... -o OUT\" remeshes "
        "several.");
  }
  words.insert(words.begin(), "remesh");
  return words;
}

std::string refusal_text(const CLI::App& program, const CLI::ParseError& error) {
  for (const CLI::App* command : program.get_subcommands()) {
    for (const std::string& given : command->remaining()) {
      const std::string call = "wscvt " + command->get_name();
      const std::string word = given.substr(0, given.find('='));
      if (word.rfind("--", 0) != 0) continue;
      std::vector<std::string> names;
      for (const CLI::Option* option : command->get_options()) {
        if (option->get_group().empty()) continue;
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      }
      return call + " has no option " + word + "." + meant_word(word, names) + " \"" + call +
             " --help\" lists all.";
    }
    const CLI::Option* output = command->get_option_no_throw("--output");
    const bool is_missing =
        output != nullptr && std::string(error.what()) == "--output is required";
    if (is_missing && output->get_positional()) {
      return output->get_name(true) + " is required, as the last word or by -o.";
    }
  }
  return "";
}

}  // namespace wscvt::program
