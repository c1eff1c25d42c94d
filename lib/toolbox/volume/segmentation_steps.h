// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

struct CutOffGreys;  // segmentation.h
struct EdgeSteps;

// The steps of segment, in their order, and the neighbours of a voxel.

/// The voxels of a volume, numbered x fastest.
struct VoxelGrid {
  std::array<std::size_t, 3> sizes;  ///< voxels along x, y and z
  std::array<std::size_t, 3> steps;  ///< from one to the next along each
  std::size_t voxels;

  explicit VoxelGrid(const VoxelCounts& counts)
      : sizes{static_cast<std::size_t>(counts[0]), static_cast<std::size_t>(counts[1]),
              static_cast<std::size_t>(counts[2])},
        steps{1, sizes[0], sizes[0] * sizes[1]},
        voxels(steps[2] * sizes[2]) {}

  std::array<std::size_t, 3> place(std::size_t voxel) const {
    return {voxel % sizes[0], voxel / sizes[0] % sizes[1], voxel / steps[2]};
  }
};

/// Whether a voxel has the mark 1. Without marks, none has.
inline bool is_marked(const std::vector<std::uint8_t>& marks, std::size_t voxel) {
  return !marks.empty() && marks[voxel] != 0;
}

/// Calls take(neighbour) for the neighbours of a voxel by faces, or for those so many voxels away.
template <class Take>
void for_each_neighbour(std::size_t voxel, const VoxelCounts& counts, const Take& take,
                        std::size_t away = 1) {
  const VoxelGrid grid(counts);
  const std::size_t width = grid.sizes[0];
  const std::size_t slice = grid.steps[2];
  const std::size_t x = voxel % width;
  const std::size_t in_slice = voxel % slice;
  if (x >= away) take(voxel - away);
  if (x + away < width) take(voxel + away);
  if (in_slice >= away * width) take(voxel - away * width);
  if (in_slice + away * width < slice) take(voxel + away * width);
  if (voxel >= away * slice) take(voxel - away * slice);
  if (voxel + away * slice < grid.voxels) take(voxel + away * slice);
}

/// Calls take(voxel, neighbour) once for each pair of voxels with a common face; the neighbour has
/// the smaller number.
template <class Take>
void for_each_pair(const VoxelCounts& counts, const Take& take) {
  const VoxelGrid grid(counts);
  const std::size_t width = grid.sizes[0];
  const std::size_t slice = grid.steps[2];
  for (std::size_t voxel = 0; voxel < grid.voxels; ++voxel) {
    if (voxel % width > 0) take(voxel, voxel - 1);
    if (voxel % slice >= width) take(voxel, voxel - width);
    if (voxel >= slice) take(voxel, voxel - slice);
  }
}

/// The wall of a container in which grains were scanned.
struct ContainerWall {
  /// 1 for its voxels, those beside it and those outside of it, x fastest; empty: there is none.
  std::vector<std::uint8_t> marks;
  std::uint64_t voxels = 0;  ///< of material among them
};

/// Finds a tube, box, cup or plate among material. It is what is met first from sides of the volume
/// that see a smooth surface, has one thickness, and has void behind it. Grains that touch it are
/// parted from it at this thickness. `mask`: 1 for material, x fastest; void and what was not
/// scanned are 0. `spacing`: edge lengths of a voxel. Throws as basins_of.
ContainerWall container_wall(const std::vector<std::uint8_t>& mask, const VoxelCounts& counts,
                             const Vector3& spacing, const Execution& execution);

/// Returns 1 for each voxel that was not scanned, x fastest; empty if all were. Reads the volume,
/// which gives grey values, once or twice. Not scanned are, as far as they are connected to the
/// border by faces:
/// - voxels that are not a number;
/// - voxels of one value that fills corners of the slices, if what they leave is a convex body. Its
///   ends along an axis are at the border of the volume, or planes: the cylinder of a
///   reconstruction, also with slices added to it. Void between grains leaves no convex body.
std::vector<std::uint8_t> not_scanned(LabelVolume& scan, const Execution& execution);

/// Returns the grey value half way between the two peaks of a histogram, void and material. Otsu's
/// threshold separates the two sides; each peak is the maximum of its side's smoothed counts.
/// Otsu's threshold itself lies nearer to the wider side, and depends on the fractions of the two.
/// `counts` are for the grey values 0, 1, 2, ...; at least two are above 0.
double level_between_peaks(const std::vector<std::uint64_t>& counts);

/// A material or void in a histogram.
struct GreyPeak {
  std::size_t value = 0;     ///< of the fullest counts
  std::size_t valley = 0;    ///< the value of the fewest counts between it and the next peak
  std::uint64_t voxels = 0;  ///< from the valley before it to its own
};

/// Returns the peaks of a histogram, ascending: each stands out from the valleys beside it by four
/// tenths of its height, and has at least one voxel of a thousand. Of up to eight values each is a
/// peak, as in a mask of phases, but if `has_noise` not where some are next to each other.
std::vector<GreyPeak> peaks_of(const std::vector<std::uint64_t>& counts, bool has_noise);

/// Returns the number of different grey values in a histogram.
std::ptrdiff_t values_in(const std::vector<std::uint64_t>& counts);

/// Returns the histogram of voxels that were scanned. `outside`: 1 for the others; empty: none.
std::vector<std::uint64_t> counts_of_all(const std::vector<std::uint16_t>& grey,
                                         const std::vector<std::uint8_t>& outside);

/// Tells whether a window of grey values cut off those of void or material: many voxels have the
/// least or the largest value, and there is noise beside them on one side only, or the edges
/// between the phases end there at once. `grey`: not smoothed; `outside`: as above.
CutOffGreys cut_off_greys(const std::vector<std::uint16_t>& grey,
                          const std::vector<std::uint8_t>& outside, const VoxelCounts& sizes);

/// Returns the value up to which a fraction of all counts lies.
std::size_t quantile_of(const std::vector<std::uint64_t>& counts, double fraction);

/// Returns the level half way between two neighbouring peaks, the second of which is `upper`.
double level_below(const std::vector<std::uint64_t>& counts, const std::vector<GreyPeak>& peaks,
                   std::size_t upper);

/// Returns the grey value around which a histogram rises again between the two phases beside a
/// level, as of a film of water around grains: blur alone has the fewest counts in the middle.
/// Empty: it does not rise. `contrast`: between the phases.
std::optional<double> film_between(const std::vector<std::uint64_t>& counts, double level,
                                   double contrast);

/// Returns twice the distance of a level to the nearer one of the fullest values on its two sides;
/// 0 if a side is empty.
double contrast_at(const std::vector<std::uint64_t>& counts, double level);

/// Returns Otsu's threshold: the grey value in the histogram for which the values below and from it
/// on have the largest variance between their means.
double otsu_level(const std::vector<std::uint64_t>& counts);

/// A level of grey values, and which side of it is material.
struct GreyLevel {
  double value = 0.0;
  double contrast = 0.0;  ///< between the phases beside the level; 0: unknown
  bool is_dark = false;   ///< the material is up to the level, not from it on
  int medians = 1;        ///< of 27 voxels that smoothed the grey values
};

/// The largest standard deviation of a blur that level_mask corrects; voxels.
inline constexpr double largest_blur = 1.5;

/// Returns the standard deviation of the blur at a level along an axis, in voxels, from neighbours
/// on either side of the level; 0 without any. `outside` as in level_mask.
double blur_at(const std::vector<std::uint16_t>& grey, const std::vector<std::uint8_t>& outside,
               const VoxelCounts& counts, const GreyLevel& level);

/// Returns 1 for each voxel of material among smoothed grey values, x fastest.
///
/// The blur of a scan and the median move the surface of a grain to its hollow side, by half of
/// their variance times the curvature: a ball of 8 voxels radius loses 6 % of its volume. Here the
/// grey values are averaged over 27 voxels, and the multiple of their Laplacian is taken away that
/// moves a curved edge back. The blur is measured: it is what neighbours across the level differ
/// by. A blur of more than `largest_blur` counts as this. Only voxels beside the level of the
/// averages change sides, so that noise makes no specks.
///
/// `outside`: 1 for voxels that were not scanned and are no material; empty: none. Memory is 9
/// bytes per voxel.
std::vector<std::uint8_t> level_mask(const std::vector<std::uint16_t>& grey,
                                     const std::vector<std::uint8_t>& outside,
                                     const VoxelCounts& counts, const GreyLevel& level,
                                     const Execution& execution);

/// Grey values with the material by one level for all.
struct LevelledVolume {
  const std::vector<std::uint16_t>& grey;     ///< smoothed, x fastest
  const std::vector<std::uint8_t>& mask;      ///< the material
  const std::vector<std::uint8_t>& left_out;  ///< 1: neither void nor material; empty: none
  VoxelCounts counts;
  std::array<double, 3> spacing;  ///< edges of a voxel
  double level = 0.0;
  double blur = 0.0;  ///< of the edges, a standard deviation, voxels
};

/// What the grey values across the surface of grains have.
struct EdgeLayers {
  /// Steps of all grains that go on, and of all that turn back, as they are on the average.
  std::vector<EdgeSteps> steps;
  bool has_fringes = false;  ///< of phase contrast, or of a filter that sharpens
};

/// Fits one and two blurred steps to the mean grey values along lines across the surface of each
/// grain, from 5 voxels outside to 6 inside. Sets the `plateaus` of grains that turn back below an
/// outer layer to that of the layer. But if the void beside most grains turns back too, beyond
/// `space`, both are fringes: there is no layer, and the surface is between void and inside. Grey
/// values as in `scan`, which is not smoothed. `labels`: of the grains, 0 between them; `plateaus`:
/// one for each label; `is_dark`: the material is darker than the void.
EdgeLayers use_layers(const LevelledVolume& volume, const std::vector<std::uint16_t>& scan,
                      const std::vector<std::uint32_t>& labels, bool is_dark, double space,
                      std::vector<double>& plateaus);

/// Grey values of the void and of the phases of material, the nearest to the void first. All are
/// brighter than the void, or all darker.
struct Phases {
  double space = 0.0;
  std::vector<double> materials;
};

/// Contrast of the values that even_contrast returns.
inline constexpr std::uint16_t even_full = 1000;

struct EvenContrast {
  std::vector<std::uint16_t> grey;
  EdgeLayers layers;
};

/// Returns grey values in which the void is 0 and each grain is `even_full`, so that the surface of
/// each is at half of this. With one level for all, grains brighter than others come out too large:
/// the level is in the outer part of their blurred edge.
///
/// `scan`: grey values that are not smoothed. `basins`: of the mask with its holes filled, with
/// distances to the void. The grey value of a basin is that of a shell below its surface, in the
/// phase that is nearest to the void there: not that of an inclusion. If the mean grey values
/// across its surface fall again, it is that of the outer layer, which may be thinner than what
/// smoothing leaves. That of the void is measured away from grains. Only voxels near the surface of
/// the mask change sides.
EvenContrast even_contrast(const LevelledVolume& volume, const std::vector<std::uint16_t>& scan,
                           Basins basins, Phases phases);

/// A grain after wide necks were joined.
struct GrainNeck {
  std::uint64_t voxels = 0;
  double neck = 0.0;  ///< widest one to a grain of a larger radius, in its own inscribed radius
};

/// Joins parts of grains that a watershed has cut. `labels`: of basins, from 1, and 0 for void, x
/// fastest; changed to one label for the parts joined. `distances`: from each voxel to the
/// void, in any unit. The neck of two basins that touch by faces of voxels is the largest distance
/// at their common border. They are one grain if it is larger than `neck` times the inscribed
/// radius, the largest distance, of the smaller one. Wide necks are joined first. Returns the
/// grains.
std::vector<GrainNeck> join_wide_necks(std::vector<std::uint32_t>& labels,
                                       const std::vector<std::uint16_t>& distances,
                                       const VoxelCounts& counts, double neck);

/// Moves the walls of touching grains to where the balls inscribed in both sides meet: gives each
/// voxel the label of the ball, around any voxel and up to the void, in which it is deepest, by the
/// power of a point. The valley of distances at a neck is flat across, so a watershed there follows
/// the errors of the distances, which tilt walls where voxels are long. Each grain hangs together
/// if it did. `labels`, `distances`: as above; `spacing`: edges of a voxel, in the unit of the
/// distances. The result does not depend on the number of threads.
void straighten_walls(std::vector<std::uint32_t>& labels,
                      const std::vector<std::uint16_t>& distances, const VoxelCounts& counts,
                      const Vector3& spacing, const Execution& execution);

}  // namespace wscvt
