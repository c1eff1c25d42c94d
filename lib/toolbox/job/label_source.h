// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "toolbox/job/grain_source.h"
#include "toolbox/volume/label_grains.h"

namespace wscvt {

/// The grains of a volume of labels, with the names PATH/LABEL. Its census is the table of the
/// labels (label_row).
class LabelSource : public GrainSource {
 public:
  LabelSource(std::string path, std::unique_ptr<LabelGrains> grains)
      : path_(std::move(path)), grains_(std::move(grains)) {}

  std::size_t size() const override { return grains_->taken().size(); }
  std::string name(std::size_t grain) const override;
  std::string file(std::size_t /*grain*/) const override { return path_; }
  void want(const std::vector<std::size_t>& grains) override { grains_->want(grains); }
  /// Refuses a label whose largest piece is below the smallest grain.
  GrainScan read(std::size_t grain, bool with_pictures, const Execution& execution) override;
  std::string census(const MadeOf& made_of) const override;
  double left_out() const override { return grains_->left_out(); }
  std::string unit() const override { return grains_->geometry().unit; }
  std::size_t volumes() const override { return 1; }

 private:
  std::string path_;
  std::unique_ptr<LabelGrains> grains_;
};

}  // namespace wscvt
