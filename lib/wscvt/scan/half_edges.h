// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/// How the repairs name the sides of triangles: half-edge 3 f + k runs from corner k of face f to
/// its corner k + 1 (mod 3). The same number names the corner it starts at. Nothing is stored for
/// it, which is why a scan of a million vertices is checked in flat arrays and not in a half-edge
/// structure: CGAL's needs twelve times as long to build.
namespace wscvt::half_edges {

inline std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

inline std::size_t face_of(std::int32_t half_edge) { return index(half_edge) / 3; }
inline std::size_t corner_of(std::int32_t half_edge) { return index(half_edge) % 3; }
inline std::size_t following(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }
inline std::size_t preceding(std::size_t corner) { return corner == 0 ? 2 : corner - 1; }

/// Indices a block of a parallel loop takes: large enough that starting it costs nothing.
inline constexpr std::size_t block_size = 16384;

}  // namespace wscvt::half_edges
