// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/voxel_surface.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"

namespace wscvt {

namespace {

// Eight voxels meet in a corner of the lattice. Voxel dx + 2 dy + 4 dz is before the corner along
// an axis if its bit is 0, and after it if the bit is 1. Twelve faces meet there: face `place` + 4
// axis is between the two voxels that differ in the axis's bit, and `place` is their other two
// bits.

constexpr std::size_t faces_at_a_corner = 12;

std::size_t face_at(std::size_t axis, std::size_t bit_b, std::size_t bit_c) {
  return 4 * axis + bit_b + 2 * bit_c;
}

/// The rings of the faces about a corner, for one pattern of voxels inside.
struct CornerRings {
  std::array<std::uint8_t, faces_at_a_corner> ring_of_face = {};
  std::uint8_t rings = 0;
};

CornerRings rings_of(unsigned inside) {
  const auto is_inside = [&](std::size_t voxel) { return (inside >> voxel & 1U) != 0; };
  boost::disjoint_sets_with_storage<> linked(faces_at_a_corner);
  // Six edges meet in the corner, each with four voxels around it.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    for (std::size_t side = 0; side < 2; ++side) {
      struct Turn {
        std::size_t face;
        bool here;  ///< the voxel before the face, in the order around the edge
        bool there;
      };
      constexpr std::size_t round[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      std::array<Turn, 4> turns{};
      std::vector<std::size_t> faces;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& here = round[k];
        const auto& there = round[(k + 1) % 4];
        const auto voxel = [&](const std::size_t(&bits)[2]) {
          return side << axis | bits[0] << b | bits[1] << c;
        };
        // From here to there one bit changes: the face is across that axis.
        const bool across_b = here[0] != there[0];
        const std::size_t face = across_b ? face_at(b, here[1], side)   // axes after b: c, axis
                                          : face_at(c, side, here[0]);  // axes after c: axis, b
        turns[k] = {face, is_inside(voxel(here)), is_inside(voxel(there))};
        if (turns[k].here != turns[k].there) faces.push_back(k);
      }
      if (faces.size() == 2) {
        linked.union_set(turns[faces[0]].face, turns[faces[1]].face);
      } else if (faces.size() == 4) {
        // Two voxels touch only in the edge: each keeps its own two faces.
        for (std::size_t k = 0; k < 4; ++k) {
          if (!turns[k].there) continue;
          linked.union_set(turns[k].face, turns[(k + 1) % 4].face);
        }
      }
    }
  }
  CornerRings result;
  std::array<int, faces_at_a_corner> ring_of_root{};
  ring_of_root.fill(-1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t place = 0; place < 4; ++place) {
      const std::size_t before = (place & 1U) << (axis + 1) % 3 | (place >> 1U) << (axis + 2) % 3;
      if (is_inside(before) == is_inside(before | std::size_t{1} << axis)) continue;
      const std::size_t face = 4 * axis + place;
      int& ring = ring_of_root[linked.find_set(face)];
      if (ring < 0) ring = result.rings++;
      result.ring_of_face[face] = static_cast<std::uint8_t>(ring);
    }
  }
  return result;
}

const std::array<CornerRings, 256>& all_corner_rings() {
  static const std::array<CornerRings, 256> table = [] {
    std::array<CornerRings, 256> all;
    for (unsigned inside = 0; inside < all.size(); ++inside) all[inside] = rings_of(inside);
    return all;
  }();
  return table;
}

/// A box of whole numbers.
struct Box {
  VoxelCounts begin = {};
  VoxelCounts end = {};

  std::size_t size(std::size_t axis) const {
    return static_cast<std::size_t>(end[axis] - begin[axis]);
  }
};

Box box_of(const std::vector<VoxelStretch>& stretches) {
  constexpr std::int32_t far = std::numeric_limits<std::int32_t>::max();
  Box box = {{far, far, far}, {0, 0, 0}};
  for (const VoxelStretch& stretch : stretches) {
    const VoxelCounts begin = {stretch.begin, stretch.y, stretch.z};
    const VoxelCounts end = {stretch.end, stretch.y + 1, stretch.z + 1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.begin[axis] = std::min(box.begin[axis], begin[axis]);
      box.end[axis] = std::max(box.end[axis], end[axis]);
    }
  }
  return box;
}

/// Makes all faces between a label and other voxels, slice by slice of its box.
class FaceMaker {
 public:
  FaceMaker(const std::vector<VoxelStretch>& stretches, VoxelSurface& surface)
      : stretches_(stretches),
        surface_(surface),
        box_(box_of(stretches)),
        width_(box_.size(0)),
        height_(box_.size(1)),
        below_((width_ + 2) * (height_ + 2)),
        here_(below_.size()) {
    for (Layer* layer : {&bottom_, &top_}) {
      layer->inside.resize((width_ + 1) * (height_ + 1));
      layer->first_vertex.resize(layer->inside.size());
    }
  }

  void run() {
    for (std::int32_t z = box_.begin[2]; z <= box_.end[2]; ++z) {
      std::swap(below_, here_);
      fill_slice(z);
      std::swap(bottom_, top_);
      fill_layer(z);
      // The layer at z is the top of slice z - 1; the previous layer is its bottom.
      make_faces_across_z();
      if (z > box_.begin[2]) {
        make_faces_within(0);
        make_faces_within(1);
      }
    }
  }

 private:
  using Slice = std::vector<std::uint8_t>;  ///< with a rim of voxels outside

  /// The corners between two slices.
  struct Layer {
    std::vector<std::uint8_t> inside;  ///< pattern of the eight voxels about each corner
    std::vector<std::int32_t> first_vertex;
  };

  std::size_t voxel(std::size_t i, std::size_t j) const { return (j + 1) * (width_ + 2) + i + 1; }
  std::size_t corner(std::size_t i, std::size_t j) const { return j * (width_ + 1) + i; }

  void fill_slice(std::int32_t z) {
    std::fill(here_.begin(), here_.end(), std::uint8_t{0});
    for (; next_ < stretches_.size() && stretches_[next_].z == z; ++next_) {
      const VoxelStretch& stretch = stretches_[next_];
      const auto j = static_cast<std::size_t>(stretch.y - box_.begin[1]);
      const auto first =
          here_.begin() + static_cast<std::ptrdiff_t>(
                              voxel(static_cast<std::size_t>(stretch.begin - box_.begin[0]), j));
      std::fill(first, first + (stretch.end - stretch.begin), std::uint8_t{1});
    }
  }

  void fill_layer(std::int32_t z) {
    const std::array<CornerRings, 256>& rings = all_corner_rings();
    for (std::size_t j = 0; j <= height_; ++j) {
      // Of the four voxels before or after the corner along x, two are in each slice; `before` is
      // one row earlier.
      const std::size_t before = j * (width_ + 2);
      const std::size_t behind = before + width_ + 2;
      const auto four_at = [&](std::size_t i) {
        return static_cast<unsigned>(below_[before + i] | below_[behind + i] << 2 |
                                     here_[before + i] << 4 | here_[behind + i] << 6);
      };
      unsigned earlier = four_at(0);
      for (std::size_t i = 0; i <= width_; ++i) {
        const unsigned later = four_at(i + 1);
        const unsigned inside = earlier | later << 1;
        earlier = later;
        top_.inside[corner(i, j)] = static_cast<std::uint8_t>(inside);
        if (rings[inside].rings == 0) continue;
        top_.first_vertex[corner(i, j)] = static_cast<std::int32_t>(surface_.corners.size());
        for (int ring = 0; ring < rings[inside].rings; ++ring) {
          surface_.corners.push_back({box_.begin[0] + static_cast<std::int32_t>(i),
                                      box_.begin[1] + static_cast<std::int32_t>(j), z});
        }
      }
    }
  }

  /// Returns the vertex of a face at one of its corners.
  static std::int32_t vertex(const Layer& layer, std::size_t corner, std::size_t face) {
    const CornerRings& rings = all_corner_rings()[layer.inside[corner]];
    return layer.first_vertex[corner] + rings.ring_of_face[face];
  }

  void add(VoxelFace face, bool looks_back) {
    if (looks_back) std::reverse(face.begin(), face.end());
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 6;  // half-edges
    if (surface_.faces.size() == most) {
      refuse(
          "A label has a surface of more than 300 million faces: it seems to be the space "
          "between the grains. Name it by " +
          mention("background") + ".");
    }
    surface_.faces.push_back(face);
  }

  /// Makes the faces between the two slices.
  void make_faces_across_z() {
    for (std::size_t j = 0; j < height_; ++j) {
      if (std::memcmp(&below_[voxel(0, j)], &here_[voxel(0, j)], width_) == 0) continue;
      for (std::size_t i = 0; i < width_; ++i) {
        if (below_[voxel(i, j)] == here_[voxel(i, j)]) continue;
        // The voxels are after their first corner, and before the others: bits 1 and 0.
        add({vertex(top_, corner(i, j), face_at(2, 1, 1)),
             vertex(top_, corner(i + 1, j), face_at(2, 0, 1)),
             vertex(top_, corner(i + 1, j + 1), face_at(2, 0, 0)),
             vertex(top_, corner(i, j + 1), face_at(2, 1, 0))},
            here_[voxel(i, j)] != 0);
      }
    }
  }

  /// Makes faces across x or y in the slice between the two layers, which is now `below_`.
  void make_faces_within(std::size_t axis) {
    const std::size_t step = axis == 0 ? 1 : width_ + 2;
    const std::size_t last_i = axis == 0 ? width_ + 1 : width_;
    const std::size_t last_j = axis == 0 ? height_ : height_ + 1;
    for (std::size_t j = 0; j < last_j; ++j) {
      const std::uint8_t* const row = &below_[voxel(0, j)];
      if (std::memcmp(row - step, row, last_i) == 0) continue;
      for (std::size_t i = 0; i < last_i; ++i) {
        const std::size_t behind = voxel(i, j);
        if (below_[behind - step] == below_[behind]) continue;
        const bool looks_back = below_[behind] != 0;
        const std::size_t here = corner(i, j);
        if (axis == 0) {  // the axes after x: y and z
          const std::size_t next = corner(i, j + 1);
          add({vertex(bottom_, here, face_at(0, 1, 1)), vertex(bottom_, next, face_at(0, 0, 1)),
               vertex(top_, next, face_at(0, 0, 0)), vertex(top_, here, face_at(0, 1, 0))},
              looks_back);
        } else {  // the axes after y: z and x
          const std::size_t next = corner(i + 1, j);
          add({vertex(bottom_, here, face_at(1, 1, 1)), vertex(top_, here, face_at(1, 0, 1)),
               vertex(top_, next, face_at(1, 0, 0)), vertex(bottom_, next, face_at(1, 1, 0))},
              looks_back);
        }
      }
    }
  }

  const std::vector<VoxelStretch>& stretches_;
  VoxelSurface& surface_;
  Box box_;
  std::size_t width_;
  std::size_t height_;
  std::size_t next_ = 0;  ///< index into the stretches
  Slice below_;
  Slice here_;
  Layer bottom_;
  Layer top_;
};

/// Returns the part of the surface of each vertex.
std::vector<std::int32_t> parts_of(const VoxelSurface& surface) {
  boost::disjoint_sets_with_storage<> linked(surface.corners.size());
  for (const VoxelFace& face : surface.faces) {
    for (std::size_t k = 1; k < 4; ++k) linked.union_set(index(face[0]), index(face[k]));
  }
  std::vector<std::int32_t> parts(surface.corners.size());
  std::iota(parts.begin(), parts.end(), 0);
  // A part is represented by its first vertex, so of two equally large parts the first is kept.
  linked.normalize_sets(parts.begin(), parts.end());
  for (std::int32_t& part : parts) part = static_cast<std::int32_t>(linked.find_set(index(part)));
  return parts;
}

/// Keeps the part of largest volume. The others are outer surfaces of other pieces, with volumes
/// above 0, and surfaces of pores, below 0.
void keep_largest(VoxelSurface& surface) {
  const std::vector<std::int32_t> part = parts_of(surface);
  // The divergence theorem in whole numbers: faces across x, multiplied by their x.
  std::vector<std::int64_t> volumes(part.size(), 0);
  for (const VoxelFace& face : surface.faces) {
    const auto corner = [&](std::size_t k) { return surface.corners[index(face[k])]; };
    // The normal's x, from the edges at the first corner, in y and z.
    const std::int64_t normal =
        std::int64_t{corner(1)[1] - corner(0)[1]} * (corner(3)[2] - corner(0)[2]) -
        std::int64_t{corner(1)[2] - corner(0)[2]} * (corner(3)[1] - corner(0)[1]);
    volumes[index(part[index(face[0])])] += normal * corner(0)[0];
  }
  for (const std::int64_t volume : volumes) {
    if (volume > 0) {
      ++surface.pieces;
      surface.piece_voxels += volume;
    } else {
      surface.pore_voxels -= volume;
    }
  }
  const auto largest = std::max_element(volumes.begin(), volumes.end());
  surface.enclosed = *largest;
  const auto kept = static_cast<std::int32_t>(largest - volumes.begin());

  std::vector<std::int32_t> places(part.size(), -1);
  std::size_t count = 0;
  for (std::size_t v = 0; v < part.size(); ++v) {
    if (part[v] != kept) continue;
    places[v] = static_cast<std::int32_t>(count);
    surface.corners[count++] = surface.corners[v];
  }
  surface.corners.resize(count);
  std::size_t faces = 0;
  for (const VoxelFace& face : surface.faces) {
    if (part[index(face[0])] != kept) continue;
    VoxelFace& placed = surface.faces[faces++];
    for (std::size_t k = 0; k < 4; ++k) placed[k] = places[index(face[k])];
  }
  surface.faces.resize(faces);
}

}  // namespace

VoxelSurface voxel_surface(const std::vector<VoxelStretch>& stretches) {
  if (stretches.empty()) refuse("There are no voxels for a surface. Give at least one.");
  VoxelSurface surface;
  FaceMaker(stretches, surface).run();
  keep_largest(surface);
  return surface;
}

}  // namespace wscvt
