// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/output_paths.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/work.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/report/report.h"
#include "wscvt/surface/grain_surface.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt::program {

namespace {

/// `wscvt create`: makes a mesh of a surface that is known exactly.
struct CreateArguments {
  CreateArguments();

  GrainSurface surface;
  std::string output;
  CommonArguments common;
  RemeshOptions options;  ///< by default, nodes on the surface
};

/// Adds an argument for several numbers, each with an option of its own.
CLI::Option* add_numbers(CLI::App& app, const std::string& name, const std::vector<double*>& values,
                         const std::vector<NumberOption<double>>& options) {
  return app
      .add_option_function<std::vector<std::string>>(
          name,
          [=](const std::vector<std::string>& texts) {
            for (std::size_t k = 0; k < texts.size(); ++k) {
              try {
                *values[k] = from_typed(texts[k], options[k]);
              } catch (const Error& error) {
                throw CLI::ValidationError(name, error.what());
              }
            }
          })
      ->expected(static_cast<int>(values.size()))
      ->allow_extra_args(false);  // the next word is the output
}

/// Reads "ellipsoid", "superellipsoid", or the name of a file of SH coefficients.
void read_surface(const std::string& text, GrainSurface& surface) {
  const std::string word = lower_case(text);
  if (word == key_of(SurfaceKind::Ellipsoid) || word == key_of(SurfaceKind::Superellipsoid)) {
    surface.kind = from_key<SurfaceKind>(word);
    return;
  }
  if (word.find('.') == std::string::npos) {
    refuse("There is no surface \"" + text +
           "\". Give ellipsoid, superellipsoid, or a file of SH coefficients: .dat, .sh or .json.");
  }
  surface.kind = SurfaceKind::Harmonics;
  surface.coefficients_file = text;
}

CreateArguments::CreateArguments() {
  OnScanOptions on_surface;
  on_surface.placement = ScanPlacement::OnSurface;
  options.method = on_surface;
}

CLI::App& add_arguments(CLI::App& program, CreateArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"create",
       "Make a mesh of an ellipsoid, a superellipsoid or an SH series",
       {"ellipsoid grain.ply --semi-axes 1 0.8 0.6 -n 500",
        "superellipsoid rod.stl --semi-axes 2 1 1 --exponents 1 0.3", "grain.json grain.ply"},
       "By default the nodes lie on the surface itself. With --placement fitted the mesh has "
       "exactly its volume.",
       true});
  add_typed(
      app, "surface",
      [&arguments](std::string_view text) { read_surface(std::string(text), arguments.surface); })
      ->required()
      ->description(
          "Surface: ellipsoid, superellipsoid, or a file of SH coefficients: .dat (text of the "
          "NIST/VCCTL particle shape sets), .sh (SHTOOLS, 4pi) or .json (written by wscvt remesh)\n"
          "ellipsoid: of the semi-axes\n"
          "superellipsoid: of the semi-axes and exponents")
      ->type_name("SURFACE");
  add_output(app, "output", arguments.output, mesh_argument_text("Mesh", MeshUse::Write));
  GrainSurface& surface = arguments.surface;
  add_numbers(app, "--semi-axes",
              {&surface.semi_axes[0], &surface.semi_axes[1], &surface.semi_axes[2]},
              {semi_axis_option, semi_axis_option, semi_axis_option})
      ->description("Semi-axes along x, y and z, " + range_text(semi_axis_option) +
                    "; not of coefficients. Default: 1 1 1")
      ->type_name("X Y Z");
  add_numbers(app, "--exponents", {&surface.polar_exponent, &surface.azimuthal_exponent},
              {polar_exponent_option, azimuthal_exponent_option})
      ->description("Exponents of the superellipsoid from pole to pole and around the equator, " +
                    range_text(polar_exponent_option) + ". Default: 1 1")
      ->type_name("P A");
  add_number(app, "-d,--degree", surface.coefficient_degree, coefficient_degree_option);
  add_remesh_arguments(app, arguments.options, Remeshed::Surface);
  add_common_arguments(app, arguments.common);
  add_verbose_argument(app, arguments.common.verbose);
  move_to_finer_settings(app, {"--threads", "--quiet", "--verbose"});
  return app;
}

int run(const CreateArguments& arguments) {
  const CommonArguments& common = arguments.common;
  std::vector<NamedFile> outputs = named_reports(common.reports);
  outputs.insert(outputs.begin(), {"the mesh", arguments.output});
  checked([&] {
    check_options(arguments.options);
    check_grain_surface(arguments.surface);
    check_mesh_format(arguments.output, MeshUse::Write);
    check_output_paths({{"the file of the coefficients", arguments.surface.coefficients_file}},
                       outputs);
    for (const std::string& report : common.reports) check_remesh_report(report);
  });

  RemeshOptions options = arguments.options;
  options.measures.written = [path = arguments.output](const RemeshResult& result) {
    return as_written(result.mesh, path);
  };
  Work work(common.threads, common.quiet);
  const RemeshResult result = remesh(arguments.surface, options, work.execution());

  work.write(arguments.output, [&] { write_mesh(result.mesh, arguments.output); });
  work.write_reports(common.reports, result, origin_of(surface_name(arguments.surface)));
  work.print_log(result, common.verbose);
  return Done;
}

}  // namespace

Command create_command(CLI::App& program) { return make_command<CreateArguments>(program); }

}  // namespace wscvt::program
