// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>

/// Ends the program, which is how a fuzzer learns of a broken promise.
inline void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "A promise is broken: %s\n", what);
  std::abort();
}
