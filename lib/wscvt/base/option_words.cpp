// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/option_words.h"

namespace wscvt {

namespace {

bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

}  // namespace

std::string with_option_names(std::string_view sentence,
                              const std::function<std::string(std::string_view key)>& name_of) {
  std::string text;
  std::size_t at = 0;
  while (at < sentence.size()) {
    const std::size_t dashes = sentence.find("--", at);
    const std::size_t begin = dashes == std::string_view::npos ? dashes : dashes + 2;
    if (begin >= sentence.size()) break;
    std::size_t end = begin;
    while (end < sentence.size() && (is_letter(sentence[end]) || sentence[end] == '-')) ++end;
    // A dash at the end belongs to the sentence.
    while (end > begin && sentence[end - 1] == '-') --end;
    text.append(sentence.substr(at, dashes - at));
    if (end > begin) {
      text += name_of(sentence.substr(begin, end - begin));
    } else {
      text.append("--");
      end = begin;
    }
    at = end;
  }
  if (at < sentence.size()) text.append(sentence.substr(at));
  return text;
}

}  // namespace wscvt
