// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <grp.h>
#include <unistd.h>

namespace wscvt::test {

/// Gives this process, if it is root's, to a user who has no other process, because the system
/// counts a limit of threads by user. Two tests that run at the same time get two users. Returns
/// whether it worked.
inline bool become_own_user() {
  if (getuid() != 0) return true;
  const unsigned user = 50000U + static_cast<unsigned>(getpid()) % 10000U;
  return setgroups(0, nullptr) == 0 && setgid(user) == 0 && setuid(user) == 0;
}

}  // namespace wscvt::test
