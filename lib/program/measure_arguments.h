// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "common_arguments.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt::program {

/// Common arguments of `describe` and `compare`.
struct MeasureArguments {
  std::string grain;  ///< file
  CommonArguments common;
  DetailedOptions options;
  std::optional<double> voxel_size;  ///< of the scan, for the resolution; empty: not measured
};

/// Adds the arguments. Parsing changes `arguments`, which must outlive `app`.
void add_measure_arguments(CLI::App& app, MeasureArguments& arguments);

/// Measures the grain, compares it with the mesh in the file `reference` if given, writes the
/// reports and prints. Throws wscvt::Error.
void measure(const MeasureArguments& arguments, const std::optional<std::string>& reference);

}  // namespace wscvt::program
