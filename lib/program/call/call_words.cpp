// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/Error.hpp>
#include <algorithm>
#include <filesystem>
#include <numeric>
#include <system_error>
#include <utility>

#include "program/call/command.h"
#include "toolbox/job/grain_files.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::program {

namespace {

[[noreturn]] void refuse_call(const std::string& sentence) {
  throw CLI::ParseError(sentence, CLI::ExitCodes::InvalidError);
}

/// Returns the number of letters to insert, remove or replace (Levenshtein 1966).
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

/// Returns " Did you mean WORD?" with the nearest of the words; empty if all differ too much.
std::string meant_word(const std::string& word, const std::vector<std::string>& words) {
  const auto nearest =
      std::min_element(words.begin(), words.end(), [&](const std::string& a, const std::string& b) {
        return edits_between(word, a) < edits_between(word, b);
      });
  // At most two typing errors; more make another word.
  const bool is_near = nearest != words.end() && edits_between(word, *nearest) <= 2;
  return is_near ? " Did you mean " + *nearest + "?" : "";
}

[[noreturn]] void refuse_unknown(const std::string& word,
                                 const std::vector<std::string>& commands) {
  const std::string names = enumerated(commands, " or ");
  if (word.empty()) refuse_call("No command is given. Give " + names + ".");
  refuse_call("There is no command \"" + word + "\". Give " + names + "." +
              meant_word(word, commands));
}

/// Whether a word is an option of this name, short ("-o", "-oOUT") or long ("--output").
bool is_option(const std::string& word, const std::string& brief, const std::string& name) {
  return word.rfind("--", 0) == 0 ? word.substr(0, word.find('=')) == name
                                  : word.rfind(brief, 0) == 0;
}

bool is_given(const std::vector<std::string>& words, const std::string& brief,
              const std::string& name) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return is_option(word, brief, name); });
}

/// Throws CLI::ParseError if the output of several remeshes is or would be a file.
void check_batch_output(const std::string& output) {
  std::error_code ignored;
  const bool is_mesh = is_mesh_file(output) && !std::filesystem::is_directory(output, ignored);
  if (!is_mesh && !std::filesystem::is_regular_file(output, ignored)) return;
  refuse_call("Several scans need a folder for their remeshes, but \"" + output +
              "\" is the name of a file. Put the name of a folder last, as in \"wscvt batch "
              "SCANS... -o OUT\".");
}

/// Returns the call of a batch. The first `count` words are inputs, and possibly the output;
/// options follow.
CallWords batch_call(std::vector<std::string> words, std::ptrdiff_t count) {
  if (!is_given(words, "-o", "--output")) {
    if (count < 2) {
      refuse_call("The output is missing. \"wscvt batch " + words.front() +
                  " -o OUT\" remeshes the scans in \"" + words.front() + "\".");
    }
    --count;
    check_batch_output(words[count]);
    words.insert(words.begin() + count, "-o");
  }
  words.insert(words.begin(), "batch");
  CallWords call{words, ""};
  if (is_given(words, "-q", "--quiet")) return call;
  // A shell may have expanded a pattern to a thousand names.
  if (count > 3) words.erase(words.begin() + 3, words.begin() + 1 + count);
  for (std::size_t k = 0; k < words.size(); ++k) {
    call.notice += " " + words[k] + (count > 3 && k == 2 ? " ..." : "");
  }
  call.notice = "This is \"wscvt" + call.notice +
                "\", which remeshes each scan. \"wscvt help batch\" lists its options.";
  return call;
}

}  // namespace

CallWords call_words(std::vector<std::string> words, const std::vector<std::string>& commands) {
  const std::string first = words.empty() ? "" : words.front();
  if (std::find(commands.begin(), commands.end(), first) != commands.end()) return {words, ""};
  if (first == "help") {
    words.erase(words.begin());
    words.resize(std::min<std::size_t>(words.size(), 1));
    if (!words.empty() && std::find(commands.begin(), commands.end(), words[0]) == commands.end()) {
      refuse_unknown(words[0], commands);
    }
    words.emplace_back("--help");
    return {words, ""};
  }
  if (first == "-v" && words.size() == 1) return {{"--version"}, ""};
  for (const char* own : {"--help", "-h", "--version", "--completion", "--man-pages"}) {
    if (first.substr(0, first.find('=')) == own) return {words, ""};
  }
  if (words.size() == 1 && first.rfind("--", 0) == 0) {
    refuse_call("wscvt has no option " + first + "." +
                meant_word(first, {"--help", "--version", "--completion", "--man-pages"}) +
                " \"wscvt --help\" lists all.");
  }
  const bool is_many = names_files(first);
  // A file name has a point or a slash, or that of Windows.
  if (!is_many && first.find_first_of("-./\\") == std::string::npos)
    refuse_unknown(first, commands);
  const auto option = std::find_if(words.begin(), words.end(),
                                   [](const std::string& word) { return word.rfind('-', 0) == 0; });
  const std::ptrdiff_t count = option - words.begin();
  if (is_many || count > (is_given(words, "-o", "--output") ? 1 : 2)) {
    return batch_call(std::move(words), count);
  }
  words.insert(words.begin(), "remesh");
  return {words, ""};
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
      std::string sentence = call;
      sentence.append(" has no option ").append(word).append(".").append(meant_word(word, names));
      const bool has_more = !command->get_help_all_ptr()->get_group().empty();
      return sentence.append(" \"").append(call).append(has_more ? " --help-all" : " --help") +
             "\" lists all.";
    }
    const CLI::Option* output = command->get_option_no_throw("--output");
    const bool is_missing =
        output != nullptr && std::string(error.what()) == "--output is required";
    if (!is_missing) continue;
    return output->get_positional()
               ? output->get_name(true) + " is required, as the last word or by -o."
               : "--output is required. Give its name by -o.";
  }
  return "";
}

}  // namespace wscvt::program
