// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "wscvt/base/sentence.h"

namespace wscvt {

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
