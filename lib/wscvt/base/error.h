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

/// Every exception the library throws on purpose. The sentence says what is wrong, where, and what
/// to do about it.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

/// What the machine refuses, such as room on a disk or another open file: an Error(InputOutput)
/// that says nothing about the grain. The same call may go well later. Memory that is refused is a
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
