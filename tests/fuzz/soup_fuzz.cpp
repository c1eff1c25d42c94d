// SPDX-License-Identifier: GPL-3.0-or-later
// Soups of faces and damaged bodies for the check: what it lets through is a surface, what it
// refuses it refuses with a sentence.
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/promise.h"
#include "property/promises.h"
#include "property/random_bodies.h"
#include "toolbox/job/bodies.h"
#include "wscvt/base/error.h"

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wscvt::test::Choices choices(data, size);
  const wscvt::MeshCheckOptions options = wscvt::test::random_check_options(choices);
  const wscvt::test::RandomBody scan = wscvt::test::random_scan(choices);
  const std::string broken = wscvt::test::broken_check(scan.mesh, options);
  promise(broken.empty(), (scan.description + ": " + broken).c_str());
  try {
    for (const wscvt::MeshBody& body :
         wscvt::split_bodies(scan.mesh, {}, wscvt::Execution(1)).list) {
      promise(!body.mesh.triangles.empty(), "a body without faces");
      promise(body.volume >= 0.0, "a body of negative volume");
    }
  } catch (const wscvt::Error& error) {
    promise(error.code() == wscvt::ErrorCode::InvalidInput, error.what());
  }
  // Drawn last, so that older inputs keep what they meant. Coarse, because fine ones take seconds.
  if (!choices.one_in(4)) return 0;
  const std::string torn =
      wscvt::test::broken_envelope(scan.mesh, choices.one_in(8) ? 50.0 : choices.real(10.0, 50.0));
  promise(torn.empty(), (scan.description + ": " + torn).c_str());
  return 0;
}
