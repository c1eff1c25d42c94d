// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
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
  explicit Sentence(NamedOption option) : text_("--" + option.key) {
    if (!option.value.empty() && option.value != "true") text_ += " " + option.value;
    places_.push_back({0, text_.size(), std::move(option)});
  }

  Sentence& operator+=(const Sentence& rest) {
    const std::size_t before = text_.size();
    const std::vector<Place> added = rest.places_;  // `rest` may be this
    text_ += rest.text_;
    for (const Place& place : added) {
      places_.push_back({before + place.begin, place.length, place.option});
    }
    return *this;
  }
  friend Sentence operator+(Sentence first, const Sentence& rest) { return first += rest; }

  friend bool operator==(const Sentence& a, const Sentence& b) { return a.text_ == b.text_; }

  const std::string& text() const { return text_; }
  operator const std::string&() const { return text_; }  // NOLINT(google-explicit-constructor)
  bool empty() const { return text_.empty(); }

  /// Returns the text with each option as `words` writes it.
  std::string in(const OptionWords& words) const {
    std::string text;
    std::size_t at = 0;
    for (const Place& place : places_) {
      text.append(text_, at, place.begin - at).append(words(place.option));
      at = place.begin + place.length;
    }
    return text.append(text_, at, std::string::npos);
  }

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

/// The kind of an error. A caller branches on it and shows `what()` to a person.
enum class ErrorCode {
  InvalidInput,      ///< the mesh, the file's content or an option is not usable
  NotStarShaped,     ///< rays from the centre meet the surface more often than the caller allows
  NumericalFailure,  ///< a solve or a triangulation broke down on usable input
  InputOutput,       ///< a file could not be opened, read or written
  Cancelled,         ///< the progress callback asked to stop
};

/// The base of every exception that the library throws on purpose. The message names the fault, its
/// place and the remedy. what() names options as the program does, `sentence` has them as data.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, Sentence sentence)
      : std::runtime_error(sentence.text()),
        code_(code),
        sentence_(std::make_shared<const Sentence>(std::move(sentence))) {}

  ErrorCode code() const noexcept { return code_; }
  const Sentence& sentence() const noexcept { return *sentence_; }

 private:
  ErrorCode code_;
  std::shared_ptr<const Sentence> sentence_;  ///< shared, so that copies throw nothing
};

/// Thrown when the machine refuses a resource, such as disk space or another open file. The code is
/// InputOutput. The grain is not at fault, and a later call may succeed. Refused memory is a
/// std::bad_alloc.
class MachineRefused : public Error {
 public:
  explicit MachineRefused(Sentence sentence) : Error(ErrorCode::InputOutput, std::move(sentence)) {}
};

/// Throws Error(InvalidInput) with the sentence.
[[noreturn]] inline void refuse(Sentence sentence) {
  throw Error(ErrorCode::InvalidInput, std::move(sentence));
}

}  // namespace wscvt
