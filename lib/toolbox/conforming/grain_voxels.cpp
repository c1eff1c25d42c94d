// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/grain_voxels.h"

#include <algorithm>
#include <array>
#include <utility>

#include "wscvt/base/error.h"

namespace wscvt {

namespace {

constexpr std::int64_t smallest_pore = 64;  ///< voxels; smaller ones have no even surface

constexpr std::int32_t beyond = -2;  ///< the outermost voxels, while pieces are searched

/// Searches pieces of equal voxels, connected by faces, row by row.
class PieceSearch {
 public:
  explicit PieceSearch(GrainVoxels& voxels)
      : voxels_(voxels), steps_(voxels.steps()), seen_(voxels.grain.size(), false) {}

  struct Piece {
    std::size_t start = 0;
    std::int64_t voxels = 0;
    bool has_rim = false;         ///< reaches the outermost voxels
    std::int32_t touched = -1;    ///< one of the grains that it touches; -1: none
    std::int32_t neighbour = -1;  ///< the only one; -1: none or several
  };

  bool was_seen(std::size_t place) const { return seen_[place]; }
  void forget() { seen_.assign(seen_.size(), false); }

  /// Finds the piece of a voxel that was not seen and is not outermost. Calls visit(begin, end) for
  /// each of its rows.
  template <class Visit>
  Piece find(std::size_t start, const Visit& visit) {
    Piece piece;
    piece.start = start;
    bool has_several = false;
    const std::int32_t value = voxels_.grain[start];
    const auto meet = [&](std::int32_t other) {
      if (other == beyond) piece.has_rim = true;
      if (other < 0 || other == value) return;
      if (piece.touched >= 0 && piece.touched != other) has_several = true;
      piece.touched = other;
    };
    open_.assign(1, start);
    while (!open_.empty()) {
      const std::size_t seed = open_.back();
      open_.pop_back();
      if (seen_[seed]) continue;
      std::size_t begin = seed;
      while (voxels_.grain[begin - 1] == value) --begin;
      std::size_t end = seed + 1;
      while (voxels_.grain[end] == value) ++end;
      meet(voxels_.grain[begin - 1]);
      meet(voxels_.grain[end]);
      for (std::size_t k = begin; k < end; ++k) seen_[k] = true;
      visit(begin, end);
      piece.voxels += static_cast<std::int64_t>(end - begin);
      for (const std::size_t step : {steps_[1], steps_[2]}) {
        look_beside(begin - step, end - step, value, meet);
        look_beside(begin + step, end + step, value, meet);
      }
    }
    if (!has_several) piece.neighbour = piece.touched;
    return piece;
  }

 private:
  template <class Meet>
  void look_beside(std::size_t begin, std::size_t end, std::int32_t value, const Meet& meet) {
    bool is_within = false;
    for (std::size_t k = begin; k < end; ++k) {
      const std::int32_t other = voxels_.grain[k];
      if (other != value) meet(other);
      const bool is_open = other == value && !seen_[k];
      if (is_open && !is_within) open_.push_back(k);
      is_within = is_open;
    }
  }

  GrainVoxels& voxels_;
  std::array<std::size_t, 3> steps_;
  std::vector<bool> seen_;
  std::vector<std::size_t> open_;
};

void set_rim(GrainVoxels& voxels, std::int32_t value) {
  const auto [nx, ny, nz] = voxels.counts;
  for (std::int32_t z = 0; z < nz; ++z) {
    for (std::int32_t y = 0; y < ny; ++y) {
      const bool is_whole = z == 0 || z + 1 == nz || y == 0 || y + 1 == ny;
      for (std::int32_t x = 0; x < nx; x += is_whole ? 1 : nx - 1) {
        voxels.grain[voxels.place(x, y, z)] = value;
      }
    }
  }
}

/// The eight voxels about a corner; bit k of the number of a voxel is its side along axis k.
using Block = std::array<std::int32_t, 8>;

/// Returns in how many ways grains touch themselves, or enclose what is outside them, only in an
/// edge or in the corner of the block.
int faults_of(const Block& b) {
  static constexpr std::array<std::array<std::size_t, 4>, 6> rings = {
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  const bool is_even = std::all_of(b.begin(), b.end(), [&](std::int32_t g) { return g == b[0]; });
  if (is_even) return 0;
  int faults = 0;
  for (const auto& r : rings) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::int32_t g = b[r[k]];
      if (g >= 0 && g == b[r[k + 2]] && g != b[r[k + 1]] && g != b[r[(k + 3) % 4]]) ++faults;
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const auto count = [&](std::int32_t g) { return std::count(b.begin(), b.end(), g); };
    const std::int32_t g = b[k];
    if (g >= 0 && g == b[7 - k] && count(g) == 2) ++faults;
    const std::int32_t other = b[(k + 1) % 4];
    if (other >= 0 && b[k] != other && b[7 - k] != other && count(other) == 6) ++faults;
  }
  return faults;
}

/// Repairs blocks one voxel at a time.
class Composer {
 public:
  explicit Composer(GrainVoxels& voxels) : voxels_(voxels), steps_(voxels.steps()) {
    for (std::size_t k = 0; k < 8; ++k) {
      offsets_[k] = (k & 1U) * steps_[0] + (k >> 1U & 1U) * steps_[1] + (k >> 2U) * steps_[2];
    }
  }

  std::size_t run() {
    const auto [nx, ny, nz] = voxels_.counts;
    for (std::int32_t z = 0; z + 1 < nz; ++z) {
      for (std::int32_t y = 0; y + 1 < ny; ++y) {
        for (std::int32_t x = 0; x + 1 < nx; ++x) {
          const std::size_t base = voxels_.place(x, y, z);
          if (faults_of(block_at(base)) > 0) open_.push_back(base);
        }
      }
    }
    const std::size_t most = 1000 + 100 * open_.size();
    std::size_t changed = 0;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const std::size_t base = open_[k];
      if (faults_of(block_at(base)) == 0) continue;
      if (k > most) fail(base);
      // Not always the best change, if blocks come back again and again.
      repair(base, k > most / 2 ? k % 4 : 0);
      ++changed;
      if (faults_of(block_at(base)) > 0) open_.push_back(base);
    }
    return changed;
  }

 private:
  Block block_at(std::size_t base) const {
    Block block{};
    for (std::size_t k = 0; k < 8; ++k) block[k] = voxels_.grain[base + offsets_[k]];
    return block;
  }

  int faults_about(std::size_t voxel) const {
    int faults = 0;
    for (const std::size_t offset : offsets_) faults += faults_of(block_at(voxel - offset));
    return faults;
  }

  bool is_rim(std::size_t voxel) const {
    const std::size_t nx = steps_[1];
    const std::size_t ny = steps_[2] / steps_[1];
    const std::size_t x = voxel % nx;
    const std::size_t y = voxel / nx % ny;
    const std::size_t z = voxel / steps_[2];
    return x == 0 || x + 1 == nx || y == 0 || y + 1 == ny || z == 0 ||
           z + 1 == static_cast<std::size_t>(voxels_.counts[2]);
  }

  int faces_to(std::size_t voxel, std::int32_t grain) const {
    int faces = 0;
    for (const std::size_t step : steps_) {
      faces += (voxels_.grain[voxel - step] == grain ? 1 : 0) +
               (voxels_.grain[voxel + step] == grain ? 1 : 0);
    }
    return faces;
  }

  /// Makes the change of a voxel of the block that takes away most faults; of several, the one with
  /// most faces to its new grain and fewest to its old. `worse` takes so many changes further on.
  void repair(std::size_t base, std::size_t worse) {
    struct Change {
      int gain;
      int faces;
      std::size_t voxel;
      std::int32_t grain;
    };
    std::vector<Change> changes;
    Block values = block_at(base);
    for (const std::size_t offset : offsets_) {
      const std::size_t voxel = base + offset;
      if (is_rim(voxel)) continue;
      const std::int32_t old = voxels_.grain[voxel];
      const int before = faults_about(voxel);
      for (std::size_t k = 0; k < 8; ++k) {
        const std::int32_t grain = values[k];
        if (grain == old || std::find(values.begin(), values.begin() + k, grain) !=
                                values.begin() + static_cast<std::ptrdiff_t>(k)) {
          continue;
        }
        voxels_.grain[voxel] = grain;
        const int gain = before - faults_about(voxel);
        voxels_.grain[voxel] = old;
        changes.push_back({gain, faces_to(voxel, grain) - faces_to(voxel, old), voxel, grain});
      }
    }
    if (changes.empty()) fail(base);
    std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
      return a.gain != b.gain ? a.gain > b.gain : a.faces > b.faces;
    });
    const Change& change = changes[std::min(changes.size() - 1, worse)];
    voxels_.grain[change.voxel] = change.grain;
    for (const std::size_t offset : offsets_) {
      const std::size_t block = change.voxel - offset;
      if (block != base && faults_of(block_at(block)) > 0) open_.push_back(block);
    }
  }

  [[noreturn]] void fail(std::size_t base) const {
    const std::size_t nx = steps_[1];
    throw Error(ErrorCode::NumericalFailure,
                "Grains touch themselves in edges or corners of voxels about voxel (" +
                    std::to_string(base % nx) + ", " +
                    std::to_string(base / nx % (steps_[2] / nx)) + ", " +
                    std::to_string(base / steps_[2]) +
                    "), and no change of single voxels repairs it. Segment the volume with less "
                    "noise.");
  }

  GrainVoxels& voxels_;
  std::array<std::size_t, 3> steps_;
  std::array<std::size_t, 8> offsets_{};
  std::vector<std::size_t> open_;
};

/// Returns the voxels of background that are in a cube of eight.
std::vector<bool> wide_gaps(const GrainVoxels& voxels) {
  const std::array<std::size_t, 3> steps = voxels.steps();
  std::array<std::size_t, 8> offsets{};
  for (std::size_t k = 0; k < 8; ++k) {
    offsets[k] = (k & 1U) * steps[0] + (k >> 1U & 1U) * steps[1] + (k >> 2U) * steps[2];
  }
  std::vector<bool> is_wide(voxels.grain.size(), false);
  for (std::size_t base = 0; base + offsets[7] < voxels.grain.size(); ++base) {
    if (std::any_of(offsets.begin(), offsets.end(),
                    [&](std::size_t offset) { return voxels.grain[base + offset] >= 0; })) {
      continue;
    }
    for (const std::size_t offset : offsets) is_wide[base + offset] = true;
  }
  return is_wide;
}

/// Calls visit(place) for the 27 voxels about one that is not outermost, itself included.
template <class Visit>
void visit_about(std::size_t voxel, const std::array<std::size_t, 3>& steps, const Visit& visit) {
  for (std::size_t z = voxel - steps[2]; z <= voxel + steps[2]; z += steps[2]) {
    for (std::size_t y = z - steps[1]; y <= z + steps[1]; y += steps[1]) {
      for (std::size_t x = y - 1; x <= y + 1; ++x) visit(x);
    }
  }
}

/// Whether a voxel of a grain has other grains before and behind it along an axis.
bool is_between(const GrainVoxels& voxels, std::size_t voxel,
                const std::array<std::size_t, 3>& steps) {
  const std::int32_t own = voxels.grain[voxel];
  return std::any_of(steps.begin(), steps.end(), [&](std::size_t step) {
    const std::int32_t low = voxels.grain[voxel - step];
    const std::int32_t high = voxels.grain[voxel + step];
    return low >= 0 && high >= 0 && low != own && high != own;
  });
}

/// Returns the other grain with most voxels about a voxel, of those that have a face with it; of
/// equal ones the first; -1: none.
std::int32_t other_grain(const GrainVoxels& voxels, std::size_t voxel,
                         const std::array<std::size_t, 3>& steps) {
  std::array<std::int32_t, 27> about{};
  std::size_t count = 0;
  visit_about(voxel, steps, [&](std::size_t x) { about[count++] = voxels.grain[x]; });
  std::int32_t best = -1;
  std::ptrdiff_t most = 0;
  for (const std::size_t step : steps) {
    for (const std::int32_t grain : {voxels.grain[voxel - step], voxels.grain[voxel + step]}) {
      if (grain < 0 || grain == voxels.grain[voxel]) continue;
      const std::ptrdiff_t number = std::count(about.begin(), about.end(), grain);
      if (number < most || (number == most && grain >= best)) continue;
      most = number;
      best = grain;
    }
  }
  return best;
}

}  // namespace

GrainVoxels::GrainVoxels(const VoxelCounts& size)
    : counts(size),
      grain(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                static_cast<std::size_t>(size[2]),
            -1) {}

std::vector<GrainPieces> keep_largest_pieces(GrainVoxels& voxels, std::size_t grains) {
  set_rim(voxels, beyond);
  PieceSearch search(voxels);
  const auto no_visit = [](std::size_t, std::size_t) {};
  const auto fill = [&](std::int32_t value) {
    return [&voxels, value](std::size_t begin, std::size_t end) {
      std::fill(voxels.grain.begin() + static_cast<std::ptrdiff_t>(begin),
                voxels.grain.begin() + static_cast<std::ptrdiff_t>(end), value);
    };
  };
  std::vector<GrainPieces> rows(grains);
  std::vector<PieceSearch::Piece> largest(grains);
  std::vector<PieceSearch::Piece> others;
  for (std::size_t k = 0; k < voxels.grain.size(); ++k) {
    const std::int32_t g = voxels.grain[k];
    if (g < 0 || search.was_seen(k)) continue;
    PieceSearch::Piece piece = search.find(k, no_visit);
    PieceSearch::Piece& best = largest[g];
    ++rows[g].pieces;
    if (piece.voxels > best.voxels) std::swap(piece, best);
    if (piece.voxels > 0) others.push_back(piece);
  }
  for (std::size_t g = 0; g < grains; ++g) rows[g].voxels = largest[g].voxels;
  search.forget();
  for (const PieceSearch::Piece& piece : others) {
    rows[voxels.grain[piece.start]].left_out += piece.voxels;
    search.find(piece.start, fill(-1));
  }
  search.forget();
  std::vector<PieceSearch::Piece> pores;
  for (std::size_t k = 0; k < voxels.grain.size(); ++k) {
    if (voxels.grain[k] != -1 || search.was_seen(k)) continue;
    PieceSearch::Piece piece = search.find(k, no_visit);
    if (piece.has_rim) continue;
    if (piece.neighbour < 0 && piece.voxels < smallest_pore) piece.neighbour = piece.touched;
    if (piece.neighbour >= 0) pores.push_back(piece);
  }
  search.forget();
  for (const PieceSearch::Piece& pore : pores) {
    search.find(pore.start, fill(pore.neighbour));
    rows[pore.neighbour].voxels += pore.voxels;
    rows[pore.neighbour].pore_voxels += pore.voxels;
  }
  set_rim(voxels, -1);
  return rows;
}

void remove_thin_parts(GrainVoxels& voxels) {
  constexpr int most_passes = 10;
  const std::array<std::size_t, 3> steps = voxels.steps();
  const std::vector<bool> is_wide = wide_gaps(voxels);
  const auto is_near_wide = [&](std::size_t voxel) {
    return is_wide[voxel] || std::any_of(steps.begin(), steps.end(), [&](std::size_t step) {
             return is_wide[voxel - step] || is_wide[voxel + step];
           });
  };
  std::vector<std::pair<std::size_t, std::int32_t>> changes;
  for (int pass = 0; pass < most_passes; ++pass) {
    changes.clear();
    for (std::int32_t z = 1; z + 1 < voxels.counts[2]; ++z) {
      for (std::int32_t y = 1; y + 1 < voxels.counts[1]; ++y) {
        const std::size_t row = voxels.place(0, y, z);
        for (std::size_t k = row + 1; k + 1 < row + steps[1]; ++k) {
          const std::int32_t own = voxels.grain[k];
          if (std::all_of(steps.begin(), steps.end(), [&](std::size_t step) {
                return voxels.grain[k - step] == own && voxels.grain[k + step] == own;
              })) {
            continue;
          }
          if (own < 0 ? is_near_wide(k) : !is_between(voxels, k, steps)) continue;
          const std::int32_t grain = other_grain(voxels, k, steps);
          if (grain >= 0) changes.emplace_back(k, grain);
        }
      }
    }
    for (const auto& [voxel, grain] : changes) voxels.grain[voxel] = grain;
    if (changes.empty()) return;
  }
}

std::size_t make_well_composed(GrainVoxels& voxels) { return Composer(voxels).run(); }

}  // namespace wscvt
