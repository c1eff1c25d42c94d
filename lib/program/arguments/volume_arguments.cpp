// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/arguments/volume_arguments.h"

#include <limits>

#include "program/call/command.h"
#include "program/terminal/work.h"
#include "toolbox/volume/segmentation.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"

namespace wscvt::program {

namespace {

/// "0.02", "12um", or "0.02,0.02,0.05 mm" for x, y and z.
void read_voxel_size(std::string_view text, VolumeChoice& choice) {
  const std::string whole(text);
  Vector3 size = Vector3::Zero();
  std::string unit;
  Eigen::Index count = 0;
  for (bool is_last = false; !is_last; ++count) {
    const std::size_t comma = text.find(',');
    is_last = comma == std::string_view::npos;
    const std::string_view part = text.substr(0, comma);
    // A unit follows the number, with or without a blank between.
    const std::size_t end = part.find_first_not_of("0123456789.+-eE \t");
    const std::size_t digits = part.substr(0, end).find_last_not_of(" \t");
    const std::string named(end == std::string_view::npos ? std::string_view() : part.substr(end));
    if (!named.empty() && (!is_known_unit(named) || (!unit.empty() && unit_of(named) != unit))) {
      refuse("The size of a voxel is \"" + whole +
             "\". Give one of the units nm, um, mm, cm, m, or no unit.");
    }
    if (!named.empty()) unit = unit_of(named);
    if (count == 3 || (is_last && count == 1)) {
      refuse("The size of a voxel is \"" + whole +
             "\". Give one number, or three numbers with commas between them.");
    }
    size[count] = from_typed(part.substr(0, digits == std::string_view::npos ? 0 : digits + 1),
                             voxel_size_option);
    text.remove_prefix(is_last ? text.size() : comma + 1);
  }
  choice.voxel_size = count == 1 ? Vector3(Vector3::Constant(size[0])) : size;
  choice.unit = unit;
}

/// "channel=2", "time=12" or "array=labels".
void read_selection(std::string_view text, VolumeChoice& choice) {
  const std::size_t end = text.find('=');
  const std::string name = lower_case(text.substr(0, end));
  const std::string_view value =
      end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  if (name == "channel" && !value.empty()) {
    choice.channel = from_typed(value, channel_option);
  } else if (name == "time" && !value.empty()) {
    choice.frame = from_typed(value, frame_option);
  } else if (name == "array" && !value.empty()) {
    choice.array = std::string(value);
  } else {
    refuse("The selection is \"" + std::string(text) + "\". Give channel=N, time=N or array=NAME.");
  }
}

std::string name_of(std::string_view key) { return "--" + std::string(key); }

}  // namespace

void add_choice_arguments(CLI::App& app, VolumeChoice& choice, const std::string& heading) {
  add_typed(app, name_of(voxel_size_option.key),
            [&choice](std::string_view text) { read_voxel_size(text, choice); })
      ->description("Size of a voxel, or X,Y,Z, " + range_text(voxel_size_option) +
                    ", with its unit: 12um. Default: the size in the volume file, or 1")
      ->type_name("SIZE")
      ->group(heading);
  add_typed(app, "--select", [&choice](std::string_view text) { read_selection(text, choice); })
      ->description(
          "One volume of a file that has several: channel=N or time=N (a frame), from 1, or "
          "array=NAME (also the path of a data set). May be given more than once")
      ->type_name("NAME=VALUE")
      ->trigger_on_parse()
      ->group(heading);
}

void add_background_argument(CLI::App& app, double& background, const std::string& heading) {
  add_typed(app, name_of(background_option.key),
            [&background](std::string_view text) {
              background = lower_case(text) == "nan" ? std::numeric_limits<double>::quiet_NaN()
                                                     : from_typed(text, background_option);
            })
      ->description(help_of(background, background_option))
      ->type_name("N")
      ->group(heading);
}

void add_volume_arguments(CLI::App& app, VolumeOptions& options, const std::string& heading) {
  add_number(app, options.smallest, smallest_option)->group(heading);
  add_number(app, options.smoothing, smoothing_option)->group(heading);
  add_background_argument(app, options.background, heading);
  app.add_flag(name_of(at_border_option.key), options.at_border,
               help_of(options.at_border, at_border_option))
      ->group(heading);
  app.add_flag(name_of(parts_option.key), options.parts, help_of(options.parts, parts_option))
      ->group(heading);
  add_typed(
      app, name_of(separate_option.key),
      [&options](std::string_view text) { options.separate = from_typed(text, separate_option); })
      ->description("Separate touching grains of a mask, as wscvt segment does; " +
                    std::string(separate_option.subject) + ", such as 0.85")
      ->type_name("N")
      ->group(heading);
  add_choice_arguments(app, options.choice, heading);
}

std::unique_ptr<LabelGrains> open_grains(const std::string& volume, const VolumeOptions& options,
                                         bool quiet) {
  return with_progress(quiet, [&](const Execution& execution) {
    return std::make_unique<LabelGrains>(volume, options, execution);
  });
}

void print_notes(const LabelGrains& grains, const std::string& parts_advice, bool quiet) {
  print({grains.description()}, quiet);
  for (const std::string& note : grains.notes()) print({note}, quiet);
  print_warnings({grains.warnings().begin(), grains.warnings().end()});
  std::size_t in_pieces = 0;
  std::size_t pieces = 0;
  for (const std::size_t k : grains.taken()) {
    const LabelExtent& label = grains.labels()[k];
    if (label.pieces < 2) continue;
    ++in_pieces;
    pieces = label.pieces;
  }
  if (in_pieces == 0) return;
  const std::string share = format_percent(grains.left_out());
  const std::string what =
      grains.labels().size() == 1
          ? "The volume has one label, " + std::to_string(grains.labels()[0].label) + ", in " +
                std::to_string(pieces) +
                " parts, like a mask. Only the largest part is used. The others, " + share +
                " of the voxels, are left out."
          : format_count(in_pieces, "label") + " of " + std::to_string(grains.taken().size()) +
                (in_pieces == 1 ? " is" : " are") +
                " in several parts. Only the largest part of each label is used. The others, " +
                share + " of all voxels, are left out." +
                (2 * in_pieces > grains.taken().size() ? " If the numbers are grey values, make "
                                                         "labels of them first, by wscvt segment."
                                                       : "");
  print_warnings({what + " To make each part a grain, " + parts_advice +
                  ". --separate 0.85 also separates grains that touch."});
}

bool is_much_left_out(double fraction) {
  constexpr double much = 0.05;
  return fraction > much;
}

}  // namespace wscvt::program
