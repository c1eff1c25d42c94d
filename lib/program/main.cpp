// SPDX-License-Identifier: GPL-3.0-or-later
// The remesher without a display: one scan in, one remesh and its report out.
#include <cstdio>
#include <ctime>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "output_paths.h"
#include "progress_line.h"
#include "signals.h"
#include "standard_streams.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/remesh.h"
#include "wscvt/report/coefficients_file.h"
#include "wscvt/report/report.h"
#include "wscvt/report/report_file.h"
#include "wscvt/scan/mesh_io.h"

namespace {

namespace program = wscvt::program;

/// "2026-11-21", where the program runs; empty when the clock does not say.
std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  char text[sizeof "2026-11-21"];
  if (::localtime_r(&now, &local) == nullptr) return "";
  return std::strftime(text, sizeof text, "%Y-%m-%d", &local) == 0 ? "" : text;
}

int run(int argc, char** argv) {
  int exit_code = -1;
  const program::Arguments call = program::read_arguments(argc, argv, exit_code);
  if (exit_code >= 0) return exit_code;

  std::vector<program::NamedFile> outputs = {{"the remesh", call.output},
                                             {"the report", call.json},
                                             {"the coefficients", call.coefficients}};
  for (const std::string& report : call.reports) outputs.push_back({"a report", report});
  program::check_output_paths({"the scan", call.input}, outputs, call.overwrite);
  for (const std::string& report : call.reports) wscvt::check_remesh_report(report);
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
  wscvt::IndexedMesh shown;  // on a page
  if (!call.reports.empty()) shown = scan;
  const wscvt::RemeshResult result = wscvt::remesh(std::move(scan), call.options, execution);
  execution.report(1.0, "Writing");  // the last chance to cancel
  line.clear();

  wscvt::write_mesh(result.mesh, call.output);
  const wscvt::ReportOrigin origin = {call.input, today()};
  if (!call.json.empty()) wscvt::write_file(call.json, wscvt::report_json(result, origin));
  for (const std::string& report : call.reports) {
    wscvt::write_report(report, result, shown, origin, wscvt::Execution(call.threads));
  }
  if (!call.coefficients.empty()) {
    wscvt::write_coefficients(call.coefficients, result);
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
    // The library, which is cancelled before anything is written, knows of no files.
    const auto* known = dynamic_cast<const wscvt::Error*>(&error);
    const bool cancelled = known != nullptr && known->code() == wscvt::ErrorCode::Cancelled;
    std::fprintf(stderr, "%s%s\n", error.what(), cancelled ? " Nothing was written." : "");
    // As a shell gives it for a program that the signal ended.
    const int signal = program::noted_signal();
    return signal == 0 ? program::Failed : 128 + signal;
  }
}
