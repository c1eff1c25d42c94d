// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"

namespace wscvt {

/// Splits the faces of a node of CGAL's tree of boxes in two, as its traits do, and reports
/// progress, because a tree of two million faces takes seconds. For AABB_tree::custom_build.
template <class Traits>
class ReportingSplit {
 public:
  ReportingSplit(const Traits& traits, const Execution& execution, const char* stage)
      : split_(traits.split_primitives_object()), execution_(execution), stage_(stage) {}

  template <class Iterator, class Box>
  void operator()(Iterator first, Iterator beyond, const Box& box) const {
    constexpr std::ptrdiff_t faces_a_report = 8192;  // some hundredths of a second
    if (beyond - first > faces_a_report) execution_.report(0.0, stage_);
    split_(first, beyond, box);
  }

 private:
  typename Traits::Split_primitives split_;
  const Execution& execution_;
  const char* stage_;
};

}  // namespace wscvt
