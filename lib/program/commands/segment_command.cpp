// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "program/arguments/common_arguments.h"
#include "program/arguments/output_paths.h"
#include "program/arguments/volume_arguments.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/work.h"
#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/open_volume.h"
#include "toolbox/volume/segmentation.h"
#include "toolbox/volume/segmentation_page.h"
#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/report/report.h"

namespace wscvt::program {

namespace {

/// `wscvt segment`: labels the grains of a grey-value volume or a mask.
struct SegmentArguments {
  std::string scan;
  std::string labels;
  std::string page;  ///< empty: beside the labels
  SegmentationOptions options;
  VolumeChoice choice;
  int threads = 0;  ///< 0: all
  bool quiet = false;
};

CLI::App& add_arguments(CLI::App& program, SegmentArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"segment",
       "Label the grains of a grey-value volume or a mask",
       {"scan.tif labels.nrrd", "scan.tif labels.nrrd --phases 1",
        "mask.tif labels.mha --separate 0.6 --voxel-size 12um"},
       "Check the page first: it shows the grains' outlines on three slices of the scan. Then "
       "remesh the labels with wscvt batch."});
  add_file_argument(app, "scan", arguments.scan,
                    "Volume of grey values, or mask, in a format of wscvt extract")
      ->required();
  add_output(app, "labels", arguments.labels, "Labels to write: .nrrd or .mha");
  add_number(app, "--separate", arguments.options.separate, separate_option);
  add_typed(app, "--threshold",
            [&arguments](std::string_view text) {
              arguments.options.threshold = from_typed(text, threshold_option);
            })
      ->description(
          "Smallest grey value of the material. Default: half-way between two peaks of the "
          "histogram, see --phases")
      ->type_name("N");
  add_typed(app, "--phases",
            [&arguments](std::string_view text) {
              arguments.options.phases = from_typed(text, phases_option);
            })
      ->description(capitalised(phases_option.subject) + ": " + std::string(phases_option.meaning))
      ->type_name("N");
  app.add_flag("--dark", arguments.options.dark,
               capitalised(dark_option.subject) + ". " + std::string(dark_option.meaning));
  add_number(app, "--smallest", arguments.options.smallest, smallest_kept_option);
  add_choice_arguments(app, arguments.choice, "Options");
  add_file_argument(app, "--report", arguments.page,
                    "The page, .html. Default: the labels' name with the ending .html");
  add_threads_argument(app, arguments.threads);
  app.add_flag("-q,--quiet", arguments.quiet, "Print only errors");
  return app;
}

int run(const SegmentArguments& arguments) {
  const std::string page =
      arguments.page.empty()
          ? std::filesystem::path(arguments.labels).replace_extension(".html").string()
          : arguments.page;
  const std::unique_ptr<LabelVolume> scan = checked([&] {
    require_filters();
    check_label_file(arguments.labels);
    if (report_format(page) != ReportFormat::Page) {
      refuse("\"" + page + "\" is no name for a page. Give a name that ends in .html.");
    }
    // Nobody gave this name, so the file may be anything.
    std::error_code unknown;  // check_output_paths tells what is wrong with the folder
    if (arguments.page.empty() && std::filesystem::is_regular_file(page, unknown) &&
        !is_segmentation_page(page)) {
      refuse(
          "\"" + page +
          "\" would be replaced by the page, and no earlier wscvt segment wrote it. Give another "
          "name by --report, or for the labels.");
    }
    check_output_paths({{"the scan", arguments.scan}},
                       {{"the labels", arguments.labels}, {"the page", page}});
    return open_volume(arguments.scan, arguments.choice);
  });
  Work work(arguments.threads, arguments.quiet);
  const Segmentation result = segment(*scan, arguments.options, work.execution().part(0.0, 0.9));
  const auto grains = static_cast<Label>(result.grains.size());
  work.write(arguments.labels,
             [&] { write_labels(arguments.labels, *result.labels, grains, work.writing()); });
  work.write_text(page, [&] {
    return segmentation_html(*scan, result, origin_of(arguments.scan), work.writing());
  });
  std::vector<std::string> lines = {scan->description()};
  lines.insert(lines.end(), scan->notes().begin(), scan->notes().end());
  for (const std::string& warning : scan->warnings()) lines.push_back("Look: " + warning);
  for (std::string& line : segmentation_lines(result)) lines.push_back(std::move(line));
  work.print(
      {}, std::move(lines), "",
      "Look at \"" + page + "\" first. Then: wscvt batch " + arguments.labels + " -o out -n 500");
  return Done;
}

}  // namespace

Command segment_command(CLI::App& program) { return make_command<SegmentArguments>(program); }

}  // namespace wscvt::program
