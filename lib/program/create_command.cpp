// SPDX-License-Identifier: GPL-3.0-or-later
#include "create_command.h"

#include <vector>

#include "command.h"
#include "exit_code.h"
#include "output_paths.h"
#include "remesh_arguments.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt::program {

namespace {

void add_semi_axes(CLI::App& app, Vector3& semi_axes) {
  const std::string name = "--semi-axes";
  app.add_option_function<std::vector<std::string>>(
         name,
         [&semi_axes, name](const std::vector<std::string>& texts) {
           for (std::size_t axis = 0; axis < texts.size(); ++axis) {
             try {
               semi_axes[static_cast<Eigen::Index>(axis)] =
                   from_typed(texts[axis], semi_axis_option);
             } catch (const Error& error) {
               throw CLI::ValidationError(name, error.what());
             }
           }
         })
      ->description("Semi-axes along x, y and z, " + range_text(semi_axis_option) +
                    "; not for harmonics. Default: 1 1 1")
      ->type_name("X Y Z")
      ->expected(3)
      ->allow_extra_args(false);  // the next word is the output
}

}  // namespace

CreateArguments::CreateArguments() {
  OnScanOptions on_surface;
  on_surface.placement = ScanPlacement::OnSurface;
  options.method = on_surface;
}

CLI::App& add_command(CLI::App& program, CreateArguments& arguments) {
  CLI::App& app = add_command(
      program, {"create",
                "Make a mesh of an ellipsoid, a superellipsoid or an SH series",
                {"ellipsoid grain.ply --semi-axes 1 0.8 0.6 -n 500",
                 "superellipsoid rod.stl --semi-axes 2 1 1 --azimuthal-exponent 0.3",
                 "harmonics grain.ply --coefficients grain.json"},
                "With --placement on-surface the nodes lie on the surface itself, as with\n"
                "--method as-published.",
                true});
  add_choice(app, "surface", arguments.surface.kind)
      ->required()
      ->description(help_of_choices<decltype(arguments.surface.kind)>());
  add_output(app, "output", arguments.output, mesh_argument_text("Mesh", MeshUse::Write));
  add_semi_axes(app, arguments.surface.semi_axes);
  add_number(app, "--" + std::string(polar_exponent_option.key), arguments.surface.polar_exponent,
             polar_exponent_option);
  add_number(app, "--" + std::string(azimuthal_exponent_option.key),
             arguments.surface.azimuthal_exponent, azimuthal_exponent_option);
  add_file_argument(app, "--coefficients", arguments.surface.coefficients_file,
                    "File of harmonics: .dat (text of the NIST/VCCTL particle shape sets), .sh "
                    "(SHTOOLS, 4pi) or .json (written by wscvt remesh)");
  add_number(app, "--" + std::string(coefficient_degree_option.key),
             arguments.surface.coefficient_degree, coefficient_degree_option);
  add_remesh_arguments(app, arguments.options, Remeshed::Surface);
  add_common_arguments(app, arguments.common);
  add_verbose_argument(app, arguments.common.verbose);
  for (const char* name : {"--threads", "--overwrite", "--quiet", "--verbose"}) {
    app.get_option(name)->group(finer_settings);
  }
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
                       outputs, common.overwrite);
    for (const std::string& report : common.reports) check_remesh_report(report);
  });

  RemeshOptions options = arguments.options;
  options.measures.written = [path = arguments.output](const RemeshResult& result) {
    return as_written(result.mesh, path);
  };
  Work work(common);
  const RemeshResult result = remesh(arguments.surface, options, work.execution());

  work.write(arguments.output,
             [&](const std::string& path, const Execution&) { write_mesh(result.mesh, path); });
  const ReportOrigin origin = origin_of(surface_name(arguments.surface));
  for (const std::string& report : common.reports) {
    work.write(report, [&](const std::string& path, const Execution& execution) {
      write_report(path, result, origin, execution);
    });
  }
  work.print_log(result, common.verbose);
  return Done;
}

}  // namespace wscvt::program
