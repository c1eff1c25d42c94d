// SPDX-License-Identifier: GPL-3.0-or-later
// The remesher without a display: one scan in, one remesh and its report out.
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "arguments.h"
#include "output_paths.h"
#include "progress_line.h"
#include "signals.h"
#include "standard_streams.h"
#include "wscvt/base/output_file.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"
#include "wscvt/scan/mesh_io.h"
#include "wscvt/surface/harmonic_io.h"

namespace {

namespace program = wscvt::program;

int run(int argc, char** argv) {
  int exit_code = -1;
  const program::Arguments call = program::read_arguments(argc, argv, exit_code);
  if (exit_code >= 0) return exit_code;

  program::check_output_paths({"the scan", call.input},
                              {{"the remesh", call.output},
                               {"the report", call.json},
                               {"the coefficients", call.coefficients}},
                              call.overwrite);
  wscvt::check_mesh_format(call.output);
  if (!call.quiet) wscvt::check_writable("/dev/stdout");
  program::note_signals();
  program::ProgressLine line(!call.quiet);
  const wscvt::Execution execution(call.threads, [&](double fraction, const std::string& stage) {
    line.show(fraction, stage);
    return program::noted_signal() == 0;
  });
  execution.report(0.0, "Reading the scan");
  wscvt::IndexedMesh scan = wscvt::read_mesh(call.input);
  const wscvt::RemeshResult result = wscvt::remesh(std::move(scan), call.options, execution);
  execution.report(1.0, "Writing");  // the last chance to cancel
  line.clear();

  wscvt::write_mesh(result.mesh, call.output);
  if (!call.json.empty()) wscvt::write_file(call.json, wscvt::report_json(result));
  if (!call.coefficients.empty()) {
    wscvt::write_harmonics(call.coefficients, wscvt::HarmonicSurface(result.coefficients));
  }
  for (const std::string& warning : result.warnings) {
    std::fprintf(stderr, "Warning: %s\n", warning.c_str());
  }
  if (!call.quiet) {
    std::string text;
    for (const std::string& report_line : wscvt::report_lines(result)) text += report_line + "\n";
    wscvt::write_file("/dev/stdout", text);
  }
  return program::Done;
}

}  // namespace

int main(int argc, char** argv) {
  program::fill_closed_streams();
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    // As a shell gives it for a program that the signal ended.
    const int signal = program::noted_signal();
    return signal == 0 ? program::Failed : 128 + signal;
  }
}
