// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "toolbox/volume/edge_profiles.h"
#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/label_volume.h"

namespace wscvt {

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
  /// The means of grains with two steps, those that go on and those that turn back, if there are
  /// such.
  std::vector<EdgeSteps> steps;
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

}  // namespace wscvt
