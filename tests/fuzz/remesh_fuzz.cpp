// SPDX-License-Identifier: GPL-3.0-or-later
// Whole remeshes of random bodies with random options: every promise of the library.
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/promise.h"
#include "property/promises.h"
#include "property/random_bodies.h"

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wscvt::test::Choices choices(data, size);
  const wscvt::RemeshOptions options = wscvt::test::random_options(choices);
  const wscvt::test::RandomBody body = wscvt::test::random_body(choices);
  const std::string broken = wscvt::test::broken_remesh(body.mesh, options, choices.one_in(8));
  promise(broken.empty(), (body.description + ": " + broken).c_str());
  return 0;
}
