// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

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
/// place and the remedy.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

/// Thrown when the machine refuses a resource, such as disk space or another open file. The code is
/// InputOutput. The grain is not at fault, and a later call may succeed. Refused memory is a
/// std::bad_alloc.
class MachineRefused : public Error {
 public:
  explicit MachineRefused(const std::string& sentence) : Error(ErrorCode::InputOutput, sentence) {}
};

/// Throws Error(InvalidInput) with the sentence.
[[noreturn]] inline void refuse(const std::string& sentence) {
  throw Error(ErrorCode::InvalidInput, sentence);
}

}  // namespace wscvt
