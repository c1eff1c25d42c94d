// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume_arguments.h"

#include "command.h"
#include "progress_line.h"
#include "signals.h"

namespace wscvt::program {

namespace {

/// "0.02", or "0.02,0.02,0.05" for x, y and z.
Vector3 voxel_size_of(std::string_view text) {
  Vector3 size;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::size_t comma = text.find(',');
    size[axis] = from_typed(text.substr(0, comma), voxel_size_option);
    const bool is_last = comma == std::string_view::npos;
    if (is_last && axis == 0) return Vector3::Constant(size[0]);
    if (is_last != (axis == 2)) {
      throw Error(ErrorCode::InvalidInput,
                  "The size of a voxel is \"" + std::string(text) +
                      "\"; give one number, or three with commas between them.");
    }
    text.remove_prefix(is_last ? text.size() : comma + 1);
  }
  return size;
}

}  // namespace

void add_volume_arguments(CLI::App& app, VolumeOptions& options, const std::string& heading) {
  const auto name_of = [](std::string_view key) { return "--" + std::string(key); };
  add_number(app, name_of(smallest_option.key), options.smallest, smallest_option)->group(heading);
  add_number(app, name_of(smoothing_option.key), options.smoothing, smoothing_option)
      ->group(heading);
  add_typed(app, name_of(voxel_size_option.key),
            [&options](std::string_view text) { options.voxel_size = voxel_size_of(text); })
      ->description("Size of a voxel, or X,Y,Z, " + range_text(voxel_size_option) +
                    ". Default: what the volume says, or 1")
      ->type_name("SIZE")
      ->group(heading);
  add_number(app, name_of(background_option.key), options.background, background_option)
      ->group(heading);
  app.add_flag(name_of(at_border_option.key), options.at_border,
               help_of(options.at_border, at_border_option))
      ->group(heading);
}

std::unique_ptr<LabelGrains> open_grains(const std::string& volume, const VolumeOptions& options,
                                         bool quiet) {
  note_signals();
  ProgressLine line(!quiet);
  const Execution execution(1, [&](double fraction, const std::string& stage) {
    line.show(fraction, stage);
    return noted_signal() == 0;
  });
  return std::make_unique<LabelGrains>(volume, options, execution);
}

Json json_of(const VolumeOptions& options) {
  Json json = Json::object();
  const auto put = [&](std::string_view key, const Json& value) { json[std::string(key)] = value; };
  put(smallest_option.key, options.smallest);
  put(smoothing_option.key, options.smoothing);
  put(voxel_size_option.key, options.voxel_size ? wscvt::json_of(*options.voxel_size) : Json());
  put(background_option.key, options.background);
  put(at_border_option.key, options.at_border);
  return json;
}

}  // namespace wscvt::program
