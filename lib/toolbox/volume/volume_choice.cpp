// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/volume_choice.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/table_heading.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

/// Returns a name in quotes, whole: paths of data sets differ at their ends.
std::string whole_in_quotes(const std::string& name) {
  std::string text = name;
  for (char& c : text) c = c >= ' ' && c <= '~' ? c : '?';
  return "\"" + text + "\"";
}

}  // namespace

void refuse_volume(const std::string& path, const Sentence& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

void refuse_without(const std::string& path, const std::string& library,
                    const std::string& package) {
  refuse_volume(path, "cannot be read: this wscvt was built without " + library +
                          ", as Python's module always is. Save the volume as .nrrd or .npy, or "
                          "give it to the program wscvt, built with " +
                          package + ".");
}

std::int64_t chosen_place(const VolumeAxis& axis, const VolumeChoice& choice,
                          const std::string& path) {
  const bool is_channel = axis.kind == AxisKind::Channel;
  const std::string name = is_channel ? "channel" : "frame";
  const std::string option = is_channel ? "channel=" : "time=";
  const std::optional<std::int64_t>& chosen = is_channel ? choice.channel : choice.frame;
  const std::string has = "has " + std::to_string(axis.count) + " " + name;
  if (!chosen) {
    if (axis.count == 1) return 0;
    refuse_volume(path, has + "s, but a volume of labels is one of them. Choose one by " +
                            mention("select", option + "1") + " to " + option +
                            std::to_string(axis.count) + "." +
                            (is_channel && (axis.count == 3 || axis.count == 4)
                                 ? " If they are colours, save the labels instead: one channel "
                                   "would mix the grains."
                                 : ""));
  }
  if (*chosen < 1 || *chosen > axis.count) {
    refuse_volume(path, has + (axis.count == 1 ? "" : "s") + ", not a " + name + " " +
                            std::to_string(*chosen) + ". Correct " +
                            mention("select", option + std::to_string(*chosen)) + ".");
  }
  return *chosen - 1;
}

std::size_t chosen_array(const std::vector<std::string>& names, const VolumeChoice& choice,
                         const std::string& path) {
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.push_back(whole_in_quotes(name));
  constexpr std::size_t most_shown = 12;
  const std::string all = listed(quoted, most_shown);
  if (choice.array.empty()) {
    if (names.size() == 1) return 0;
    refuse_volume(path, "has " + std::to_string(names.size()) + " arrays: " + all +
                            ". Choose the array of labels by " + mention("select", "array=NAME") +
                            ".");
  }
  const auto found = std::find(names.begin(), names.end(), choice.array);
  if (found == names.end()) {
    refuse_volume(path, "has no array " + in_quotes(choice.array) + ". It has " + all +
                            ". Correct " + mention("select", "array=" + choice.array) + ".");
  }
  if (std::find(found + 1, names.end(), choice.array) != names.end()) {
    refuse_volume(path, "has two arrays " + in_quotes(choice.array) +
                            ". Save the array of labels under another name.");
  }
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<BlockPick> picks_of(const std::vector<VolumeAxis>& axes, const VolumeChoice& choice,
                                const std::string& path) {
  std::vector<BlockPick> picks;
  std::int64_t block = 1;
  for (const VolumeAxis& axis : axes) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() / 16;
    if (axis.count < 1 || axis.count > most / block) {
      refuse_volume(path, "has a dimension of " + std::to_string(axis.count) +
                              ", which is impossible. Export it again.");
    }
    if (axis.kind == AxisKind::Space) {
      block *= axis.count;
      continue;
    }
    const std::int64_t place = chosen_place(axis, choice, path);
    if (axis.count > 1) picks.push_back({block, axis.count, place});
  }
  // The selection must exist: a file without channels has only the first.
  for (const AxisKind kind : {AxisKind::Channel, AxisKind::Frame}) {
    const bool has_axis = std::any_of(axes.begin(), axes.end(),
                                      [&](const VolumeAxis& axis) { return axis.kind == kind; });
    if (!has_axis) chosen_place({kind, 1}, choice, path);
  }
  return picks;
}

std::string unit_of(const std::string& text) {
  const std::string unit = known_unit(text).value_or(text);
  return unit == "voxel" ? "" : unit;
}

bool is_known_unit(const std::string& text) { return nanometres(unit_of(text)) > 0.0; }

}  // namespace wscvt
