// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "toolbox/job/grain_job.h"

namespace wscvt::test {

/// Expects each change of the options to change the call, by which a job goes on or does not.
template <class Job>
void expect_calls_differ(const std::vector<std::function<void(Job&)>>& changes) {
  std::map<std::string, std::size_t> calls;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    Job options;
    changes[k](options);
    const auto [other, is_new] = calls.emplace(make_job(options, "out").call, k);
    EXPECT_TRUE(is_new) << k << " as " << other->second;
  }
}

}  // namespace wscvt::test
