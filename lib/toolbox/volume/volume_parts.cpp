// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/volume_parts.h"

#include <algorithm>
#include <utility>

#include "wscvt/base/error.h"

namespace wscvt {

namespace {

class VolumeOfParts : public LabelVolume {
 public:
  VolumeOfParts(std::unique_ptr<LabelVolume> volume, Label background, const Execution& execution)
      : LabelVolume(volume->geometry()),
        volume_(std::move(volume)),
        tracker_(geometry().counts, background) {
    take_notes_of(*volume_);
    join_parts(execution);
    rewind();
  }

  const std::vector<Label>& next_row() override {
    // The numbers come in the order in which parts were joined before.
    const auto& stretches = tracker_.add_row(
        volume_->next_row(), [&](Label) { return next_part_++; },
        [](std::uint32_t, std::uint32_t) {});
    row_.assign(static_cast<std::size_t>(geometry().counts[0]), 0);
    for (const PartTracker::Stretch& stretch : stretches) {
      std::fill(row_.begin() + stretch.begin, row_.begin() + stretch.end, numbers_[stretch.part]);
    }
    return row_;
  }

  void rewind() override {
    volume_->rewind();
    tracker_.rewind();
    next_part_ = 0;
  }

 private:
  void join_parts(const Execution& execution) {
    constexpr std::size_t most_parts = 100000000;
    JoinedNumbers joined;
    const auto begin_part = [&](Label) {
      if (joined.size() == most_parts) {
        refuse("The volume has more than " + std::to_string(most_parts) +
               " parts: it seems to be noise. Smooth it before it is segmented.");
      }
      return joined.add();
    };
    const auto link = [&](std::uint32_t a, std::uint32_t b) { joined.join(a, b); };
    for_each_row(*volume_, execution, "Separating parts",
                 [&](const std::vector<Label>& row) { tracker_.add_row(row, begin_part, link); });
    numbers_.resize(joined.size());
    Label next = 1;
    for (std::uint32_t part = 0; part < numbers_.size(); ++part) {
      const std::uint32_t first = joined.find(part);
      numbers_[part] = first == part ? next++ : numbers_[first];
    }
  }

  std::unique_ptr<LabelVolume> volume_;
  PartTracker tracker_;
  std::vector<Label> numbers_;  ///< number of each part at its beginning
  std::uint32_t next_part_ = 0;
  std::vector<Label> row_;
};

}  // namespace

std::unique_ptr<LabelVolume> parts_of(std::unique_ptr<LabelVolume> volume, Label background,
                                      const Execution& execution) {
  return std::make_unique<VolumeOfParts>(std::move(volume), background, execution);
}

}  // namespace wscvt
