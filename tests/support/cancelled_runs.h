// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/expect_error.h"
#include "wscvt/base/execution.h"

namespace wscvt::test {

/// Fails unless run(execution) reports at least so often under the name of a stage and, asked to
/// stop at the first and at the last of these reports, stops there with Error(Cancelled).
template <class Run>
void expect_to_be_stopped(const Run& run, const std::string& stage, int reports) {
  for (const int last : {1, reports}) {
    int count = 0;
    int later = 0;
    const Execution execution(1, [&](double /*fraction*/, const std::string& reported) {
      if (count >= last) ++later;
      if (reported == stage) ++count;
      return count < last;
    });
    EXPECT_ERROR(run(execution), Cancelled);
    EXPECT_EQ(count, last);
    EXPECT_EQ(later, 0);
  }
}

}  // namespace wscvt::test
