// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Finds, row by row, which stretches of one label are connected by faces of voxels. Memory is the
/// stretches of two slices.
class PartTracker {
 public:
  /// Consecutive voxels of one label along x.
  struct Stretch {
    std::int32_t begin = 0;
    std::int32_t end = 0;  ///< one after the last
    Label label = 0;
    std::uint32_t part = 0;
  };

  PartTracker(const VoxelCounts& counts, Label background)
      : background_(background),
        below_(static_cast<std::size_t>(counts[1])),
        here_(static_cast<std::size_t>(counts[1])) {}

  /// Goes back to before the first row.
  void rewind() {
    for (auto* slice : {&below_, &here_}) {
      for (std::vector<Stretch>& row : *slice) row.clear();
    }
    next_ = 0;
  }

  /// Adds the next row, and returns its stretches without the background's, valid until the next
  /// call. A stretch gets the part of a neighbour of its label in the previous row or slice, or
  /// `begin_part(label)` without a neighbour. Calls `link(a, b)` if two parts meet. The stretches
  /// of a slice end with its last row.
  template <class BeginPart, class Link>
  const std::vector<Stretch>& add_row(const std::vector<Label>& row, const BeginPart& begin_part,
                                      const Link& link) {
    if (next_ == here_.size()) {
      below_.swap(here_);
      next_ = 0;
    }
    static const std::vector<Stretch> none;
    Neighbours above(next_ == 0 ? none : here_[next_ - 1]);
    Neighbours under(below_[next_]);
    std::vector<Stretch>& stretches = here_[next_++];
    stretches.clear();
    visit_stretches(row, [&](Label label, std::int32_t begin, std::int32_t end) {
      if (label == background_) return;
      Stretch stretch = {begin, end, label, 0};
      bool has_part = false;
      const auto take = [&](std::uint32_t part) {
        if (!has_part) {
          stretch.part = part;
          has_part = true;
        } else if (part != stretch.part) {
          link(stretch.part, part);
        }
      };
      above.visit(stretch, take);
      under.visit(stretch, take);
      if (!has_part) stretch.part = begin_part(label);
      stretches.push_back(stretch);
    });
    return stretches;
  }

  /// Calls renumber(part) for every stretch of the current slice and sets its part to the result.
  template <class Renumber>
  void renumber_slice(const Renumber& renumber) {
    for (std::vector<Stretch>& row : here_) {
      for (Stretch& stretch : row) stretch.part = renumber(stretch.part);
    }
  }

 private:
  /// The stretches of a neighbouring row, visited once in order.
  class Neighbours {
   public:
    explicit Neighbours(const std::vector<Stretch>& row) : row_(row) {}

    template <class Take>
    void visit(const Stretch& stretch, const Take& take) {
      while (first_ < row_.size() && row_[first_].end <= stretch.begin) ++first_;
      for (std::size_t k = first_; k < row_.size() && row_[k].begin < stretch.end; ++k) {
        if (row_[k].label == stretch.label) take(row_[k].part);
      }
    }

   private:
    const std::vector<Stretch>& row_;
    std::size_t first_ = 0;
  };

  Label background_;
  std::vector<std::vector<Stretch>> below_;  ///< the previous slice
  std::vector<std::vector<Stretch>> here_;
  std::size_t next_ = 0;  ///< next row of the slice
};

/// Joined sets of numbers; the smallest number represents its set.
class JoinedNumbers {
 public:
  std::uint32_t add() {
    parents_.push_back(static_cast<std::uint32_t>(parents_.size()));
    return parents_.back();
  }

  std::uint32_t find(std::uint32_t number) {
    while (parents_[number] != number) {
      parents_[number] = parents_[parents_[number]];
      number = parents_[number];
    }
    return number;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a > b) std::swap(a, b);
    parents_[b] = a;
  }

  std::size_t size() const { return parents_.size(); }
  void clear() { parents_.clear(); }

 private:
  std::vector<std::uint32_t> parents_;
};

/// Returns the voxels with each part numbered from 1, in the order in which parts begin. A part is
/// the voxels of one label that are connected by faces. The background becomes 0. Reads the volume
/// once. Memory is four bytes per stretch that begins a part, and the stretches of two slices.
/// Throws Error: InvalidInput for more than 100 million such stretches, as in noise, Cancelled, and
/// what the volume throws.
std::unique_ptr<LabelVolume> parts_of(std::unique_ptr<LabelVolume> volume, Label background,
                                      const Execution& execution);

}  // namespace wscvt
