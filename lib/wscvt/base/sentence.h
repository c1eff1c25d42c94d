// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace wscvt {

/// An option that a sentence names.
struct NamedOption {
  std::string key;    ///< as in NumberOption: "edge-ratio"
  std::string value;  ///< as a user types it; "true": the flag itself; empty: no value is named
};

/// Returns how a door (the program, Python, MeshLab) writes an option.
using OptionWords = std::function<std::string(const NamedOption& option)>;

/// A sentence for a person. The options in it are data, so that each door can say them in its own
/// words. Texts convert to sentences without options. As a text, a sentence has the words of the
/// program: "--edge-ratio 1.4".
class Sentence {
 public:
  Sentence() = default;
  Sentence(std::string text) : text_(std::move(text)) {}  // NOLINT(google-explicit-constructor)
  Sentence(const char* text) : text_(text) {}             // NOLINT(google-explicit-constructor)
  explicit Sentence(NamedOption option);

  Sentence& operator+=(const Sentence& rest);
  friend Sentence operator+(Sentence first, const Sentence& rest) { return first += rest; }

  friend bool operator==(const Sentence& a, const Sentence& b) { return a.text_ == b.text_; }

  const std::string& text() const { return text_; }
  operator const std::string&() const { return text_; }  // NOLINT(google-explicit-constructor)
  bool empty() const { return text_.empty(); }

  /// Returns the text with each option as `words` writes it.
  std::string in(const OptionWords& words) const;

 private:
  struct Place {
    std::size_t begin;
    std::size_t length;
    NamedOption option;
  };
  std::string text_;
  std::vector<Place> places_;  ///< of the options in the text, ascending
};

/// Returns a sentence that is only an option, to be joined with others.
inline Sentence mention(std::string key, std::string value = "") {
  return Sentence(NamedOption{std::move(key), std::move(value)});
}

}  // namespace wscvt
