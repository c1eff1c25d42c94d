// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

/// Returns a sentence for an option that the method does not have but the other method has: that it
/// belongs to the other method, and what to do. Empty for any other key.
Sentence refusal_of_option(std::string_view key, Method method);

/// Returns such a sentence for a value of an option, or for a weighting that is gone.
Sentence refusal_of_value(std::string_view key, std::string_view value, Method method);

/// Options as users type them: texts by the options' keys.
using TypedOptions = std::map<std::string, std::string, std::less<>>;

/// Takes the key of an option and what is wrong with it; empty if no method has it. Throws.
using RefuseOption = std::function<void(std::string_view key, const Sentence& refusal)>;

/// Reads the texts into `options`, the method first. A flag is "true" or "false".
void read_options(const TypedOptions& typed, RemeshOptions& options, const RefuseOption& refuse);

}  // namespace wscvt
