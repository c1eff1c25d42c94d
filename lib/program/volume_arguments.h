// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "volume/label_grains.h"
#include "wscvt/report/json.h"

namespace wscvt::program {

/// Adds what is asked of a volume of labels, under a heading of the help. Reading a call changes
/// `options`, which must outlive `app`.
void add_volume_arguments(CLI::App& app, VolumeOptions& options, const std::string& heading);

/// Adds what is taken of a file of voxels, and the size of these, alone.
void add_choice_arguments(CLI::App& app, VolumeChoice& choice, const std::string& heading);

/// Opens a volume and finds its labels, with a line on a terminal unless quiet. A signal cancels.
/// Throws as LabelGrains does.
std::unique_ptr<LabelGrains> open_grains(const std::string& volume, const VolumeOptions& options,
                                         bool quiet);

/// What a person should know of a volume, how it was read, to the standard output unless quiet;
/// and, to the standard error, which part of it is left out. `command` is what one calls to take
/// each part as a grain.
void print_notes(const LabelGrains& grains, const std::string& command, bool quiet);

/// Whether so much of a volume is left out that the exit code says so.
bool is_much_left_out(const LabelGrains& grains);

/// Every option under the name that one types.
Json json_of(const VolumeOptions& options);

}  // namespace wscvt::program
