// SPDX-License-Identifier: GPL-3.0-or-later
// The remesher without a display: one scan in, one remesh and its report out.
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"
#include "wscvt/scan/mesh_io.h"
#include "wscvt/surface/harmonic_io.h"

namespace {

using wscvt::program::Arguments;

int run(int argc, char** argv) {
  int exit_code = -1;
  const Arguments call = wscvt::program::read_arguments(argc, argv, exit_code);
  if (exit_code >= 0) return exit_code;

  const std::vector<std::pair<std::string, std::string>> files = {
      {"the scan", call.input},
      {"the remesh", call.output},
      {"the report", call.json},
      {"the coefficients", call.coefficients}};
  for (std::size_t i = 2; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!wscvt::same_file(files[i].second, files[k].second)) continue;
      throw wscvt::Error(wscvt::ErrorCode::InvalidInput,
                         "\"" + files[i].second + "\" is named for " + files[k].first +
                             " and for " + files[i].first + "; give two names.");
    }
  }

  const wscvt::RemeshResult result =
      wscvt::remesh(wscvt::read_mesh(call.input), call.options, wscvt::Execution(call.threads));
  wscvt::write_mesh(result.mesh, call.output);
  if (!call.json.empty()) wscvt::write_file(call.json, wscvt::report_json(result));
  if (!call.coefficients.empty()) {
    wscvt::write_harmonics(call.coefficients, wscvt::HarmonicSurface(result.coefficients));
  }
  if (!call.quiet) {
    for (const std::string& line : wscvt::report_lines(result)) std::puts(line.c_str());
  }
  return wscvt::program::Done;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return wscvt::program::Failed;
  }
}
