// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fabric/contact_lines.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "toolbox/volume/label_census.h"
#include "wscvt/base/error.h"

namespace wscvt {

void PointSums::add(const HalfVoxels& offset) {
  ++count;
  for (std::size_t k = 0; k < 3; ++k) {
    sum[k] += offset[k];
    products[k] += offset[k] * offset[k];
  }
  products[3] += offset[0] * offset[1];
  products[4] += offset[0] * offset[2];
  products[5] += offset[1] * offset[2];
}

PointSums& PointSums::operator+=(const PointSums& other) {
  count += other.count;
  for (std::size_t k = 0; k < 3; ++k) sum[k] += other.sum[k];
  for (std::size_t k = 0; k < 6; ++k) products[k] += other.products[k];
  return *this;
}

namespace {

/// The last voxel of a label on a line.
struct LastVoxel {
  std::uint32_t grain = 0;  ///< index + 1; 0: none yet
  std::int32_t place = 0;   ///< along the line
};

class LineCounter {
 public:
  LineCounter(const VoxelCounts& counts, Label background)
      : counts_(counts),
        background_(background),
        along_y_(static_cast<std::size_t>(counts[0])),
        along_z_(static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1])) {}

  void begin_slice() { std::fill(along_y_.begin(), along_y_.end(), LastVoxel()); }

  void add_row(const std::vector<Label>& row, std::int32_t y, std::int32_t z) {
    LastVoxel along_x;
    LastVoxel* const slice =
        along_z_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(counts_[0]);
    visit_stretches(row, [&](Label label, std::int32_t begin, std::int32_t end) {
      if (label == background_) return;
      const std::uint32_t grain = place_of(label) + 1;
      add_voxels(labels_[grain - 1], begin, end, y, z);
      if (along_x.grain != 0) add(0, along_x, grain, {begin, y, z});
      along_x = {grain, end - 1};
      for (std::int32_t x = begin; x < end; ++x) {
        LastVoxel& before_y = along_y_[static_cast<std::size_t>(x)];
        LastVoxel& before_z = slice[x];
        if (before_y.grain != 0) add(1, before_y, grain, {x, y, z});
        if (before_z.grain != 0) add(2, before_z, grain, {x, y, z});
        before_y = {grain, y};
        before_z = {grain, z};
      }
    });
  }

  ContactLines result() {
    ContactLines lines;
    std::vector<std::size_t> order(labels_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return labels_[a].label < labels_[b].label; });
    std::vector<std::size_t> rank(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      rank[order[k]] = k;
      lines.labels.push_back(labels_[order[k]]);
    }
    for (LabelPair& pair : pairs_) {
      if (pair.faces.count == 0) continue;
      pair.first = rank[pair.first];
      pair.second = rank[pair.second];
      lines.pairs.push_back(pair);
    }
    std::sort(lines.pairs.begin(), lines.pairs.end(), [](const LabelPair& a, const LabelPair& b) {
      return a.first != b.first ? a.first < b.first : a.second < b.second;
    });
    return lines;
  }

 private:
  std::uint32_t place_of(Label label) {
    if (last_place_ < labels_.size() && labels_[last_place_].label == label) return last_place_;
    const auto [place, is_new] = places_.emplace(label, static_cast<std::uint32_t>(labels_.size()));
    if (is_new) {
      if (labels_.size() == most_labels) {
        refuse("The volume has more than " + std::to_string(most_labels) +
               " labels: it seems to have grey values. Make labels of them by wscvt segment.");
      }
      LabelSums sums;
      sums.label = label;
      labels_.push_back(sums);
    }
    last_place_ = place->second;
    return last_place_;
  }

  void add_voxels(LabelSums& label, std::int32_t begin, std::int32_t end, std::int32_t y,
                  std::int32_t z) const {
    const std::int64_t count = end - begin;
    label.voxels += static_cast<std::uint64_t>(count);
    label.middles[0] += count * (std::int64_t{begin} + end);
    label.middles[1] += count * (2 * std::int64_t{y} + 1);
    label.middles[2] += count * (2 * std::int64_t{z} + 1);
    label.at_border = label.at_border || begin == 0 || end == counts_[0] || y == 0 ||
                      y + 1 == counts_[1] || z == 0 || z + 1 == counts_[2];
  }

  LabelPair& pair_of(std::uint32_t low, std::uint32_t high) {
    if (labels_[low].label > labels_[high].label) std::swap(low, high);
    const std::uint64_t key = std::uint64_t{low} << 32U | high;
    const auto [place, is_new] = pair_places_.emplace(key, pairs_.size());
    if (is_new) {
      pairs_.emplace_back();
      pairs_.back().first = low;
      pairs_.back().second = high;
    }
    return pairs_[place->second];
  }

  /// Counts a line that comes from `before` to a voxel of `grain`.
  void add(std::size_t axis, const LastVoxel& before, std::uint32_t grain,
           const std::array<std::int32_t, 3>& voxel) {
    if (before.grain == grain) return;
    const auto gap = static_cast<std::size_t>(voxel[axis] - before.place - 1);
    if (gap > widest_gap) return;
    LabelPair& pair = pair_of(before.grain - 1, grain - 1);
    pair.lines[gap][axis] += pair.first == before.grain - 1 ? 1 : -1;
    HalfVoxels point = {2 * std::int64_t{voxel[0]} + 1, 2 * std::int64_t{voxel[1]} + 1,
                        2 * std::int64_t{voxel[2]} + 1};
    point[axis] = std::int64_t{before.place} + 1 + voxel[axis];
    if (pair.faces.count + pair.around.count == 0) pair.origin = point;
    for (std::size_t k = 0; k < 3; ++k) point[k] -= pair.origin[k];
    if (gap == 0) {
      pair.faces.add(point);
      ++pair.faces_across[axis];
      return;
    }
    pair.around.add(point);
    if (gap == 1) pair.beside.add(point);
  }

  VoxelCounts counts_;
  Label background_;
  std::vector<LastVoxel> along_y_;  ///< of the slice's columns
  std::vector<LastVoxel> along_z_;
  std::vector<LabelSums> labels_;
  std::unordered_map<Label, std::uint32_t> places_;
  std::uint32_t last_place_ = 0;
  std::vector<LabelPair> pairs_;
  std::unordered_map<std::uint64_t, std::size_t> pair_places_;
};

}  // namespace

ContactLines contact_lines(LabelVolume& volume, Label background, const Execution& execution) {
  const VoxelCounts& counts = volume.geometry().counts;
  LineCounter counter(counts, background);
  GreyCheck check(background);
  const auto add = [&](const std::vector<Label>& row, std::int32_t y, std::int32_t z) {
    if (y == 0) counter.begin_slice();
    counter.add_row(row, y, z);
    check.add_row(row, y);
    if (y + 1 == counts[1]) check.end_slice();
  };
  for_each_row(volume, execution, "Finding contacts", add);
  check.end();
  return counter.result();
}

}  // namespace wscvt
