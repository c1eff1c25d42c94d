// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/image_stack.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/base/file_name.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

bool is_tiff(const std::string& name) {
  const std::string ending = ending_of(name);
  return ending == ".tif" || ending == ".tiff";
}

/// Files of a folder.
struct FolderContent {
  std::vector<std::string> tiffs;
  std::vector<std::string> pngs;
  std::vector<std::string> others;  ///< names
};

FolderContent content_of(const std::string& folder) {
  FolderContent content;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool is_taken = !is_foreign_file(name) && is_slice(name) && !entry.is_directory(error);
    if (!is_taken) {
      content.others.push_back(name);
    } else {
      (is_tiff(name) ? content.tiffs : content.pngs).push_back(entry.path().string());
    }
  }
  // Compares numbers in names by value: 9 before 10.
  const auto comes_before = [](const std::string& a, const std::string& b) {
    return ::strverscmp(a.c_str(), b.c_str()) < 0;
  };
  std::sort(content.tiffs.begin(), content.tiffs.end(), comes_before);
  std::sort(content.pngs.begin(), content.pngs.end(), comes_before);
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

/// Returns the last number in a name; nothing without a number.
std::optional<std::int64_t> number_of(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  const std::size_t end = stem.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  const std::size_t before = stem.find_last_not_of("0123456789", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return whole_number_in(std::string_view(stem).substr(begin, end + 1 - begin));
}

/// Returns a sentence about the first missing slice of numbered names; empty if none is missing.
std::string sentence_of_gap(const std::vector<std::string>& paths) {
  std::vector<std::int64_t> numbers;
  for (const std::string& path : paths) {
    const std::optional<std::int64_t> number = number_of(path);
    if (!number || (!numbers.empty() && *number <= numbers.back())) return "";
    numbers.push_back(*number);
  }
  std::int64_t step = std::numeric_limits<std::int64_t>::max();
  for (std::size_t k = 1; k < numbers.size(); ++k) {
    step = std::min(step, numbers[k] - numbers[k - 1]);
  }
  for (std::size_t k = 1; k < numbers.size(); ++k) {
    if (numbers[k] - numbers[k - 1] == step) continue;
    return "There is no slice between " + in_quotes(fs::path(paths[k - 1]).filename().string()) +
           " and " + in_quotes(fs::path(paths[k]).filename().string()) +
           ". They were used as neighbours. Look for the missing slices.";
  }
  return "";
}

}  // namespace

bool is_foreign_file(const std::string& name) {
  const std::string lower = lower_case(name);
  return name.empty() || name.front() == '.' || name.back() == '~' || lower == "thumbs.db" ||
         lower == "desktop.ini" || lower == "__macosx";
}

bool is_slice(const std::string& name) { return is_tiff(name) || ending_of(name) == ".png"; }

std::unique_ptr<LabelVolume> open_stack(const std::string& path, const VolumeChoice& choice) {
  const FolderContent content = content_of(path);
  if (content.tiffs.empty() && content.pngs.empty()) {
    refuse_volume(path, "has no .tif and no .png file. Check its name.");
  }
  if (!content.tiffs.empty() && !content.pngs.empty()) {
    refuse_volume(path, "holds " + std::to_string(content.tiffs.size()) + " .tif and " +
                            std::to_string(content.pngs.size()) +
                            " .png files. Keep only one kind there.");
  }
  const bool of_tiffs = !content.tiffs.empty();
  const SliceFiles slices = {path, of_tiffs ? content.tiffs : content.pngs};
  std::unique_ptr<LabelVolume> volume =
      of_tiffs ? open_tiff_slices(slices, choice) : open_png_slices(slices, choice);
  if (!content.others.empty()) volume->add_note(sentence_of_others(content.others));
  const std::string gap = sentence_of_gap(slices.paths);
  if (!gap.empty()) volume->add_note(gap);
  return volume;
}

std::unique_ptr<LabelVolume> open_tiff(const std::string& path, const VolumeChoice& choice) {
  return open_tiff_slices({path, {path}}, choice);
}

std::unique_ptr<LabelVolume> open_png(const std::string& path, const VolumeChoice& choice) {
  return open_png_slices({path, {path}}, choice);
}

}  // namespace wscvt
