// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <vector>

#include "toolbox/exchange/engine_folder.h"
#include "toolbox/job/grain_job.h"
#include "toolbox/volume/label_grains.h"

namespace wscvt::program {

/// A sample as the input of a command that also works on one grain.
struct ScanInputs {
  std::vector<std::string> inputs;       ///< a scan, or inputs as of a batch
  Shard shard;                           ///< of a sample
  std::string engine;                    ///< for which the folder is made ready; or empty
  std::string sizes;                     ///< file of a size curve of the packing; or empty
  const CLI::Option* density = nullptr;  ///< to know whether the command's density was given

  const CLI::Option* format = nullptr;  ///< of several scans

  /// Whether there is anything except one mesh file, or the folder is for an engine.
  bool is_sample() const;
};

/// Adds the inputs, --format, --shard, --engine and --size-curve. `files` are what is made of each
/// grain, and `format` their ending. Parsing changes `arguments` and `format`, which must outlive
/// `app`.
void add_scan_inputs(CLI::App& app, ScanInputs& arguments, const std::string& files,
                     std::string& format, EngineShapes shapes);

/// Adds --engine and --size-curve, as add_scan_inputs.
void add_engine_arguments(CLI::App& app, ScanInputs& arguments, const std::string& files,
                          EngineShapes shapes);

/// Says in the help of --density that the grains of a packing have another default.
void tell_density_of_packing(CLI::Option& density);

/// Throws wscvt::Error(InvalidInput) if there is no such engine, or its files cannot have the
/// format or the frame; or for a curve that cannot be read. Sets the format and the frame.
void check_engine_inputs(const ScanInputs& arguments, EngineShapes shapes, std::string& format,
                         FrameOptions& frame);

/// Throws wscvt::Error(InvalidInput) if what the engine needs would replace files of a person, or
/// if the packing would get the weights or sizes of an earlier call. Without an engine does
/// nothing.
void check_engine_folder(const ScanInputs& arguments, const std::string& folder,
                         const FrameOptions& frame);

/// Writes what the engine needs into the folder of a job. A sample that is a folder of templates
/// gives their weights and sizes. The density counts if it was given. Returns the command that
/// starts the engine, a line for the log. Without an engine, or for a part of a sample, does
/// nothing.
std::vector<std::string> write_engine_files(const ScanInputs& arguments, const GrainJob& job,
                                            const GrainSource& grains, EngineShapes shapes,
                                            const FrameOptions& frame, double density);

/// Throws wscvt::Error(InvalidInput) for options of several scans, if only one scan is given.
void check_one_scan(const ScanInputs& arguments);

/// Throws wscvt::Error(InvalidInput) if the outputs are not one folder, or a report is asked for.
/// `is_file` tells whether an output is the name of a file.
void check_sample_outputs(const std::vector<std::string>& outputs,
                          const std::vector<std::string>& reports, const std::string& files,
                          const std::function<bool(const std::string&)>& is_file);

/// Runs the job of a sample, prints its table's name, and returns the exit code. With an engine,
/// writes what it needs, with the density if it was given, and prints the command that starts it.
int run_sample(const ScanInputs& arguments, GrainJob job, EngineShapes shapes,
               const FrameOptions& frame, double density, int threads, bool quiet);

/// Returns the files of the inputs of a batch, see grain_files. Throws wscvt::Error for a file that
/// is no volume and whose ending is that of no mesh, and for a table of spheres.
std::vector<std::string> input_files(const std::vector<std::string>& inputs);

/// Opens the inputs of a batch: mesh files, and volumes of labels, whose labels it finds. With
/// options.parts, the bodies of a mesh are grains. Shows a line on a terminal and prints how the
/// inputs were read, unless quiet. Throws as LabelGrains. A mesh that cannot be read fails later,
/// in its row.
std::unique_ptr<GrainSource> open_inputs(const std::vector<std::string>& files,
                                         const VolumeOptions& options, const Shard& shard,
                                         bool quiet, const std::string& parts_advice);

}  // namespace wscvt::program
