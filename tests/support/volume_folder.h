// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/made_volume.h"
#include "toolbox/volume/open_volume.h"

namespace wscvt::test {

/// A folder for the files of a test, and a volume without symmetry in them: three side lengths,
/// every label another but for some, the largest at the last voxel.
class VolumeFolder : public FileFolder {
 protected:
  void SetUp() override {
    FileFolder::SetUp();
    make({7, 5, 3});
  }

  void make(const std::array<int, 3>& counts) {
    made_ = MadeVolume(counts);
    for (std::size_t k = 0; k < made_.labels.size(); ++k) {
      made_.labels[k] = static_cast<std::uint32_t>(k * k % 119);
    }
    made_.labels.back() = 127;
  }

  /// The labels plus a number.
  std::vector<Label> labels(std::uint32_t more) const {
    std::vector<Label> all = made_.labels;
    for (Label& label : all) label += more;
    return all;
  }

  void write(const std::string& name, const std::string& bytes) const {
    write_bytes(path(name), bytes);
  }

  static std::vector<Label> all_of(LabelVolume& volume) {
    std::vector<Label> labels;
    for_each_row(volume, Execution(1), "", [&](const std::vector<Label>& row) {
      labels.insert(labels.end(), row.begin(), row.end());
    });
    return labels;
  }

  /// All labels, read twice, after the file was left within a slice.
  std::vector<Label> labels_of(const std::string& name, const VolumeChoice& choice = {}) const {
    const std::unique_ptr<LabelVolume> volume = open_volume(path(name), choice);
    volume->rewind();
    for (int row = 0; row <= volume->geometry().counts[1]; ++row) volume->next_row();
    std::vector<Label> first = all_of(*volume);
    EXPECT_EQ(all_of(*volume), first) << name;
    return first;
  }
  void expect_made(const std::string& name, const VolumeChoice& choice = {}) const {
    EXPECT_EQ(open_volume(path(name), choice)->geometry().counts, made_.counts);
    EXPECT_EQ(labels_of(name, choice), made_.labels) << name;
  }

  /// Writes a file that has the labels.
  void expect_made_of(const std::string& name, const std::string& bytes,
                      const VolumeChoice& choice = {}) const {
    write(name, bytes);
    expect_made(name, choice);
  }

  VolumeGeometry geometry(const std::string& name, const VolumeChoice& choice = {}) const {
    return open_volume(path(name), choice)->geometry();
  }
  std::vector<std::string> notes(const std::string& name) const {
    const auto volume = open_volume(path(name));
    return {volume->notes().begin(), volume->notes().end()};
  }

  /// Opens and reads a file that has to be refused, with these words.
  void expect_refused(const std::string& name, const std::vector<std::string>& words,
                      const VolumeChoice& choice = {}) const {
    const std::string sentence = refusal(ErrorCode::InputOutput, [&] { labels_of(name, choice); });
    EXPECT_NE(sentence, "") << name << " was read.";
    for (const std::string& word : words) {
      EXPECT_TRUE(holds(sentence, word));
    }
  }

  /// Writes a file that has to be refused.
  void expect_refused_of(const std::string& name, const std::string& bytes,
                         const std::vector<std::string>& words,
                         const VolumeChoice& choice = {}) const {
    write(name, bytes);
    expect_refused(name, words, choice);
  }

  /// The file without its last bytes is refused, however many they are, by itself or by its header.
  void expect_cut_is_refused(const std::string& name, std::size_t least_left,
                             const std::string& header = "") const {
    const std::uintmax_t size = std::filesystem::file_size(path(name));
    for (std::uintmax_t left = size - 1; left >= least_left; left -= 1 + left / 9) {
      SCOPED_TRACE(name + " of " + std::to_string(left) + " bytes");
      std::filesystem::resize_file(path(name), left);
      expect_refused(header.empty() ? name : header, {});
    }
  }

  MadeVolume made_{{7, 5, 3}};
};

inline VolumeChoice channel(std::int64_t place) {
  VolumeChoice choice;
  choice.channel = place;
  return choice;
}
inline VolumeChoice frame(std::int64_t place) {
  VolumeChoice choice;
  choice.frame = place;
  return choice;
}
inline VolumeChoice array(const std::string& name) {
  VolumeChoice choice;
  choice.array = name;
  return choice;
}

}  // namespace wscvt::test
