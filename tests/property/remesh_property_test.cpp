// SPDX-License-Identifier: GPL-3.0-or-later
// Random bodies, random options, every promise. WSCVT_PROPERTY_SEED and WSCVT_PROPERTY_COUNT give
// other bodies and more of them, as tests/run_all.sh nightly does:
// WSCVT_PROPERTY_SEED=1000 WSCVT_PROPERTY_COUNT=10000 property_tests
#include <gtest/gtest.h>

#include <cstdlib>
#include <exception>
#include <string>

#include "property/promises.h"
#include "property/random_bodies.h"
#include "support/seeds.h"

namespace wscvt {
namespace {

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

/// The bodies are dealt to this many tests, so that they can run at the same time, and that none
/// with several slow bodies comes near the limit of a test on a busy machine.
constexpr int hands = 25;

class Promises : public ::testing::TestWithParam<int> {
 protected:
  /// Calls body(seed) for every seed of this hand.
  template <class Body>
  void for_each_seed(std::uint64_t usual_count, const Body& body) const {
    const std::uint64_t first = test::announced(setting("WSCVT_PROPERTY_SEED", 1));
    const std::uint64_t count = setting("WSCVT_PROPERTY_COUNT", usual_count);
    const auto hand = static_cast<std::uint64_t>(GetParam());
    for (std::uint64_t seed = first + hand; seed < first + count; seed += hands) body(seed);
  }
};

TEST_P(Promises, AreKeptByWholeRemeshes) {
  std::uint64_t bodies = 0;
  // A remesh takes a third of a second.
  for_each_seed(120, [&](std::uint64_t seed) {
    test::Choices choices(seed);
    const RemeshOptions options = test::random_options(choices);
    const test::RandomBody body = test::random_body(choices);
    std::string broken;
    try {
      broken = test::broken_remesh(body.mesh, options, ++bodies % 5 == 0);
    } catch (const std::exception& other) {
      broken = std::string("a foreign exception: ") + other.what();
    }
    EXPECT_EQ(broken, "") << "seed " << seed << ": " << body.description << "; "
                          << options.node_count << " nodes, " << key_of(method_of(options)) << ", "
                          << std::visit(
                                 [](const auto& method) {
                                   return key_of(method.weighting) + ", " +
                                          key_of(method.placement);
                                 },
                                 options.method);
  });
}

TEST_P(Promises, AreKeptByTheCheckOfDamagedBodiesAndSoups) {
  for_each_seed(5000, [&](std::uint64_t seed) {
    test::Choices choices(seed + 1000000007U);
    const MeshCheckOptions options = test::random_check_options(choices);
    const test::RandomBody body = test::random_scan(choices);
    std::string broken;
    try {
      broken = test::broken_check(body.mesh, options);
    } catch (const std::exception& other) {
      broken = std::string("a foreign exception: ") + other.what();
    }
    EXPECT_EQ(broken, "") << "seed " << seed << ": " << body.description;
  });
}

TEST_P(Promises, AreKeptByEnvelopesOfDamagedBodiesAndSoups) {
  for_each_seed(400, [&](std::uint64_t seed) {
    test::Choices choices(seed + 2000000011U);
    test::RandomBody body = test::random_scan(choices);
    if (choices.one_in(4)) body.mesh.triangles.clear();
    std::string broken;
    try {
      broken = test::broken_envelope(body.mesh, choices.real(10.0, 50.0));
    } catch (const std::exception& other) {
      broken = std::string("a foreign exception: ") + other.what();
    }
    EXPECT_EQ(broken, "") << "seed " << seed << ": " << body.description;
  });
}

INSTANTIATE_TEST_SUITE_P(, Promises, ::testing::Range(0, hands));

}  // namespace
}  // namespace wscvt
