// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "toolbox/volume/label_grains.h"

namespace wscvt::program {

/// Adds the options of a volume of labels, under a heading of the help. Parsing changes `options`,
/// which must outlive `app`.
void add_volume_arguments(CLI::App& app, VolumeOptions& options, const std::string& heading);

/// Adds only the choice of data in a voxel file, and the voxel size.
void add_choice_arguments(CLI::App& app, VolumeChoice& choice, const std::string& heading);

/// Adds only the number of the background.
void add_background_argument(CLI::App& app, double& background, const std::string& heading);

/// Opens a volume and finds its labels, with a progress line on a terminal unless quiet. A signal
/// cancels. Throws as LabelGrains.
std::unique_ptr<LabelGrains> open_grains(const std::string& volume, const VolumeOptions& options,
                                         bool quiet);

/// Prints how a volume was read to the standard output, unless quiet. Prints the fraction that is
/// left out to the standard error, with the advice for who wants each part to be a grain.
void print_notes(const LabelGrains& grains, const std::string& parts_advice, bool quiet);

/// For commands with add_volume_arguments. The folder may keep the results of other options.
inline constexpr const char* use_parts = "use --parts, and another output folder";

/// Returns whether the fraction of a volume that is left out is so large that the exit code is
/// SomeFailed.
bool is_much_left_out(double fraction);

}  // namespace wscvt::program
