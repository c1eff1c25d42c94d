// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

std::string slice_name(const std::string& path) { return fs::path(path).filename().string(); }

/// The opener of each kind of slices: TIFF, PNG, BMP.
constexpr std::size_t slice_kinds = 3;
constexpr std::array<OpenSlices, slice_kinds> slice_openers = {open_tiff_slices, open_png_slices,
                                                               open_bmp_slices};

/// Returns the kind of a slice by its name; `slice_kinds`: it is none.
std::size_t slice_kind_of(const std::string& name) {
  const std::string ending = ending_of(name);
  if (ending == ".tif" || ending == ".tiff") return 0;
  return ending == ".png" ? 1 : ending == ".bmp" ? 2 : slice_kinds;
}

/// Files of a folder.
struct FolderContent {
  std::array<std::vector<std::string>, slice_kinds> slices;  ///< paths
  std::vector<std::string> others;                           ///< names
};

FolderContent content_of(const std::string& folder) {
  FolderContent content;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool is_taken = !is_foreign_file(name) && is_slice(name) && !entry.is_directory(error);
    if (is_taken) {
      content.slices[slice_kind_of(name)].push_back(entry.path().string());
    } else {
      content.others.push_back(name);
    }
  }
  // Compares numbers in names by value: 9 before 10. Capitals do not count: s1, S2, s3.
  const auto comes_before = [](const std::string& a, const std::string& b) {
    const int order = compare_numbered(lower_case(a), lower_case(b));
    return order != 0 ? order < 0 : a < b;
  };
  for (auto& paths : content.slices) std::sort(paths.begin(), paths.end(), comes_before);
  std::sort(content.others.begin(), content.others.end());
  return content;
}

std::string sentence_of_others(const std::vector<std::string>& names) {
  constexpr std::size_t most_shown = 3;
  std::string text = "Left out (not slices): ";
  for (std::size_t k = 0; k < std::min(names.size(), most_shown); ++k) {
    text += (k == 0 ? "" : ", ") + in_quotes(names[k]);
  }
  if (names.size() > most_shown) {
    text += " and " + std::to_string(names.size() - most_shown) + " more";
  }
  return text + ".";
}

/// Returns why a folder is no volume. `others`: the names in it.
std::string sentence_without_slices(const std::string& folder,
                                    const std::vector<std::string>& others) {
  if (std::any_of(others.begin(), others.end(), is_mesh_file)) {
    return "is a folder of meshes, not of slices. wscvt batch FOLDER -o OUT remeshes them.";
  }
  const std::string none = "has no .tif, .png or .bmp file";
  std::map<std::string, std::size_t> endings;
  for (const std::string& name : others) {
    const fs::path path = fs::path(folder) / name;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
      if (!is_slice(entry.path().filename().string())) continue;
      return none + ", but its folder " + in_quotes(name) + " has. Give that folder.";
    }
    const std::string ending = ending_of(name);
    if (!ending.empty() && !is_foreign_file(name)) ++endings[ending];
  }
  const auto most =
      std::max_element(endings.begin(), endings.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == endings.end() || most->second < 2) return none + ". Check its name.";
  return none + ", but " + std::to_string(most->second) + " " + most->first + " files. " +
         (most->first == ".jpg" || most->first == ".jpeg"
              ? "JPEG changes numbers: export the slices again, as .tif or .png."
              : "Save the slices as .tif or .png.");
}

/// A name in lower case with # for each number in it, and these numbers.
struct NumberedName {
  std::string pattern;
  std::vector<std::string> numbers;
};

NumberedName numbered(const std::string& path) {
  NumberedName name;
  bool was_digit = false;
  for (const char c : lower_case(fs::path(path).stem().string())) {
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_digit) name.pattern += c;
    if (is_digit && (name.pattern.empty() || name.pattern.back() != '#')) name.pattern += '#';
    if (is_digit && !was_digit) name.numbers.emplace_back();
    if (is_digit) name.numbers.back() += c;
    was_digit = is_digit;
  }
  return name;
}

/// Returns the last number of a name, if there is one.
std::optional<std::int64_t> last_number(const std::string& path) {
  const std::vector<std::string> numbers = numbered(path).numbers;
  return numbers.empty() ? std::nullopt : whole_number_in(numbers.back());
}

/// Returns the names of one pattern in series: by the first number that is not another in each
/// name, when no number is.
std::map<std::string, std::vector<std::string>> series_of(const std::vector<std::string>& paths) {
  std::vector<std::set<std::string>> values;
  for (const std::string& path : paths) {
    const std::vector<std::string> numbers = numbered(path).numbers;
    values.resize(std::max(values.size(), numbers.size()));
    for (std::size_t k = 0; k < numbers.size(); ++k) values[k].insert(numbers[k]);
  }
  const auto counts_all = [&](const std::set<std::string>& of) {
    return of.size() == paths.size();
  };
  std::map<std::string, std::vector<std::string>> series;
  if (values.empty() || std::any_of(values.begin(), values.end(), counts_all)) {
    series[""] = paths;
    return series;
  }
  // The number with the fewest values but one tells the series.
  std::size_t fewest = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool is_first = values[fewest].size() < 2;
    if (values[k].size() > 1 && (is_first || values[k].size() < values[fewest].size())) fewest = k;
  }
  for (const std::string& path : paths) {
    const std::vector<std::string> numbers = numbered(path).numbers;
    series[fewest < numbers.size() ? numbers[fewest] : ""].push_back(path);
  }
  return series;
}

/// Keeps the files of one series of slices, and adds the names of odd files, such as a preview, to
/// `others`. Throws Error(InputOutput), naming them, for two series.
void keep_one_series(const std::string& folder, std::vector<std::string>& paths,
                     std::vector<std::string>& others) {
  std::map<std::string, std::vector<std::string>> by_pattern;
  for (const std::string& path : paths) by_pattern[numbered(path).pattern].push_back(path);
  if (by_pattern.size() == paths.size()) return;  // names without an order of numbers
  std::vector<std::vector<std::string>> series;
  for (const auto& [pattern, files] : by_pattern) {
    for (auto& [key, part] : series_of(files)) series.push_back(std::move(part));
  }
  std::stable_sort(series.begin(), series.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  const auto name = [](const std::string& path) { return "\"" + slice_name(path) + "\""; };
  // A preview, a mask of one slice or a logo is one file or two. Slices of hexadecimal numbers
  // leave many series of few files.
  constexpr std::size_t most_odd = 2;
  const std::size_t odd = paths.size() - series[0].size();
  if (odd > most_odd || odd == series[0].size()) {
    refuse_volume(
        folder, "holds more than one series of slices: " + std::to_string(series[0].size()) +
                    " files like " + name(series[0].front()) + " and " +
                    std::to_string(series[1].size()) + " files like " + name(series[1].front()) +
                    ". If they are one volume, number all slices alike by whole numbers from 0 on, "
                    "in their order. Else move one of them to a folder of its own.");
  }
  for (std::size_t k = 1; k < series.size(); ++k) {
    for (const std::string& path : series[k]) others.push_back(slice_name(path));
  }
  std::sort(others.begin(), others.end());
  paths = series.front();
}

/// Refuses two slices with the same numbers, such as 5 and 005: one is of another export.
void check_numbers(const std::string& folder, const std::vector<std::string>& paths) {
  std::map<std::pair<std::string, std::vector<std::string>>, std::string> found;
  for (const std::string& path : paths) {
    auto [pattern, numbers] = numbered(path);
    for (std::string& number : numbers) {
      number.erase(0, std::min(number.find_first_not_of('0'), number.size() - 1));
    }
    if (numbers.empty()) continue;
    const std::string last = numbers.back();
    const std::string name = slice_name(path);
    const auto [other, is_new] = found.emplace(std::pair(pattern, numbers), name);
    if (is_new) continue;
    refuse_volume(folder, "has the number " + last + " twice: " + in_quotes(other->second) +
                              " and " + in_quotes(name) +
                              ". Move the one that is of another series to a folder of its own.");
  }
}

/// Returns a sentence about the first missing slice of these numbers, which rise; else empty.
std::string sentence_of_gap(const std::vector<std::string>& paths,
                            const std::vector<std::int64_t>& numbers) {
  std::int64_t step = std::numeric_limits<std::int64_t>::max();
  for (std::size_t k = 1; k < numbers.size(); ++k) {
    step = std::min(step, numbers[k] - numbers[k - 1]);
  }
  for (std::size_t k = 1; k < numbers.size(); ++k) {
    if (numbers[k] - numbers[k - 1] == step) continue;
    return "There is no slice between " + in_quotes(slice_name(paths[k - 1])) + " and " +
           in_quotes(slice_name(paths[k])) +
           ". They were used as neighbours. Look for the missing slices.";
  }
  return "";
}

/// Returns the last numbers of the names if they rise, else none.
std::vector<std::int64_t> rising_numbers(const std::vector<std::string>& paths) {
  std::vector<std::int64_t> numbers;
  for (const std::string& path : paths) {
    const std::optional<std::int64_t> number = last_number(path);
    if (!number || (!numbers.empty() && *number <= numbers.back())) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

bool are_alike(const SliceImage& a, const SliceImage& b) {
  return a.width == b.width && a.height == b.height && a.numbers == b.numbers;
}

std::string text_of(const SliceImage& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " voxels of " +
         image.numbers;
}

/// The bytes of slices in separate files, of which one is in memory.
class SliceBytes : public MadeBytes {
 public:
  /// `channel`: the selected one; -1: all colours must be equal.
  SliceBytes(SliceImage form, std::int64_t channel, std::vector<std::string> paths,
             ReadSlice read_slice)
      : form_(std::move(form)),
        channel_(channel),
        paths_(std::move(paths)),
        read_slice_(read_slice) {}

 private:
  bool make(std::vector<char>& made) override {
    if (next_ == paths_.size()) return false;
    const std::string& path = paths_[next_++];
    SliceImage image = read_slice_(path, true);
    if (!are_alike(image, form_)) {  // checked when it was opened, so it has changed since
      refuse_volume(path, "was changed while it was read. Run the command again.");
    }
    if (image.channels == 1) {
      made = std::move(image.content);
      return true;
    }
    const auto chosen = static_cast<std::size_t>(std::max<std::int64_t>(channel_, 0));
    const std::size_t voxel = image.channels * image.bytes;
    for (std::size_t k = 0; k < image.content.size(); k += voxel) {
      const char* const numbers = image.content.data() + k;
      if (channel_ < 0) check_colours_equal(numbers, image.bytes, path);
      made.insert(made.end(), numbers + chosen * image.bytes, numbers + (chosen + 1) * image.bytes);
    }
    return true;
  }

  SliceImage form_;
  std::int64_t channel_;
  std::vector<std::string> paths_;
  ReadSlice read_slice_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<LabelVolume> open_images(const SliceFiles& slices, const VolumeChoice& choice,
                                         ReadSlice read) {
  refuse_array_choice(choice, slices.folder);
  const SliceImage image = read(slices.paths.front(), false);
  for (const std::string& path : slices.paths) {
    const SliceImage here = read(path, false);
    if (are_alike(here, image)) continue;
    refuse_volume(path, "is a slice of " + text_of(here) + ", but the slices before it have " +
                            text_of(image) + ". Save all slices alike.");
  }
  const auto channels = static_cast<std::int64_t>(image.channels);
  const bool is_grey = channels > 1 && !choice.channel;
  const std::int64_t channel =
      chosen_place({AxisKind::Channel, is_grey ? 1 : channels}, choice, slices.folder);
  chosen_place({AxisKind::Frame, 1}, choice, slices.folder);
  VolumeGeometry geometry;
  geometry.counts = voxel_counts(
      {image.width, image.height, static_cast<std::int64_t>(slices.paths.size())}, slices.folder);
  set_lattice(geometry, Eigen::Matrix3d::Identity(), Vector3::Constant(0.5), choice, slices.folder);
  const std::int64_t chosen = is_grey && channels > 2 ? -1 : channel;
  return volume_of_bytes(
      geometry, {static_cast<int>(image.bytes), false, false, true}, {},
      [image, chosen, paths = slices.paths, read] {
        return std::make_unique<SliceBytes>(image, chosen, paths, read);
      },
      slices.folder);
}

bool is_foreign_file(const std::string& name) {
  const std::string lower = lower_case(name);
  return name.empty() || name.front() == '.' || name.back() == '~' || lower == "thumbs.db" ||
         lower == "desktop.ini" || lower == "__macosx";
}

bool is_slice(const std::string& name) { return slice_kind_of(name) < slice_kinds; }

std::unique_ptr<LabelVolume> open_stack(const std::string& path, const VolumeChoice& choice) {
  auto [found, others] = content_of(path);
  std::size_t kind = slice_kinds;
  for (std::size_t k = 0; k < slice_kinds; ++k) {
    if (found[k].empty()) continue;
    if (kind < slice_kinds) {
      refuse_volume(path, "holds " + std::to_string(found[0].size()) + " .tif, " +
                              std::to_string(found[1].size()) + " .png and " +
                              std::to_string(found[2].size()) +
                              " .bmp files. Keep only one kind there.");
    }
    kind = k;
  }
  if (kind == slice_kinds) refuse_volume(path, sentence_without_slices(path, others));
  SliceFiles slices = {path, std::move(found[kind])};
  keep_one_series(path, slices.paths, others);
  check_numbers(path, slices.paths);
  std::unique_ptr<LabelVolume> volume = slice_openers[kind](slices, choice);
  if (!others.empty()) volume->add_note(sentence_of_others(others));
  const std::string gap = sentence_of_gap(slices.paths, rising_numbers(slices.paths));
  if (!gap.empty()) volume->add_warning(gap);
  return volume;
}

}  // namespace wscvt
