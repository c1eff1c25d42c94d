// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "wscvt/base/mesh.h"

namespace wscvt::host_test {

/// One call of the filter, made both in this process and through meshlabserver.
struct Call {
  std::string name;                 ///< letters and digits, of the test
  std::optional<IndexedMesh> mesh;  ///< none: no mesh is loaded
  std::map<std::string, std::string>
      parameters;                  ///< that differ from their defaults, as in a script
  std::vector<std::string> words;  ///< a refusal's sentence holds all of them, whatever their case
};

/// Names the call in test output.
inline void PrintTo(const Call& call, std::ostream* out) { *out << call.name; }

/// Calls that must be refused with a sentence and change nothing.
std::vector<Call> refused_calls();

/// The same for the filter that measures: bodies that have no shape descriptors.
std::vector<Call> unmeasurable_calls();

/// Calls at the edge of what is possible, which must work.
std::vector<Call> extreme_calls();

}  // namespace wscvt::host_test
