// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "wscvt/base/option.h"

namespace wscvt {

/// How the directions of the nodes are chosen.
enum class Sampling {
  Weighted,     ///< relaxed to a weighted centroidal tessellation: WSCVT
  Fibonacci,    ///< Fibonacci lattice, as it is
  EqualAngle,   ///< equal-angle grid with the number of points nearest to N
  Icosahedron,  ///< subdivided icosahedron with the number of points nearest to N
};

template <>
struct EnumerationTable<Sampling> {
  static constexpr std::string_view key = "sampling";
  static constexpr std::string_view subject = "sampling";
  static constexpr Enumerator<Sampling> rows[] = {
      {Sampling::Weighted, "weighted", "weighted Voronoi", "the method, with the weighting"},
      {Sampling::Fibonacci, "fibonacci", "Fibonacci lattice", "as it is, for comparison"},
      {Sampling::EqualAngle, "equal-angle", "equal-angle grid",
       "with the number of points nearest to the one asked for"},
      {Sampling::Icosahedron, "icosahedron", "icosahedron",
       "subdivided, with the number of points nearest to the one asked for"},
  };
};

/// Where the seeds of a weighted sampling start.
enum class SeedStart {
  Multilevel,     ///< warped lattice of a few hundred, subdivided and relaxed level by level
  WarpedLattice,  ///< all N in a Fibonacci lattice warped to the wanted density
  Random,         ///< uniform directions from `random_seed`
};

template <>
struct EnumerationTable<SeedStart> {
  static constexpr std::string_view key = "seed-start";
  static constexpr std::string_view subject = "start of the seeds";
  static constexpr Enumerator<SeedStart> rows[] = {
      {SeedStart::Multilevel, "multilevel", "multilevel",
       "a few hundred nodes are relaxed, subdivided and relaxed again"},
      {SeedStart::WarpedLattice, "warped-lattice", "warped lattice",
       "all nodes in a Fibonacci lattice adapted to the weighting"},
      {SeedStart::Random, "random", "random", "directions drawn with the random seed"},
  };
};

/// How the nodes' directions are chosen.
struct SeedingOptions {
  Sampling sampling = Sampling::Weighted;  ///< the others ignore weighting and relaxation
  SeedStart start = SeedStart::Multilevel;
  std::uint64_t random_seed = 1;  ///< of SeedStart::Random
};

/// A closed mesh has four nodes at least; a million take minutes.
inline constexpr NumberOption<int> node_count_option = {
    "nodes",    "number of nodes",
    4,          1000000,
    Ends::Both, "of the remesh, exactly; with an error target the first number tried"};
inline constexpr NumberOption<std::uint64_t> random_seed_option = {
    "seed",     "random seed",        0, std::numeric_limits<std::uint64_t>::max(),
    Ends::Both, "of the random start"};

}  // namespace wscvt
