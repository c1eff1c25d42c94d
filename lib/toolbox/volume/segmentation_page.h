// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/volume/segmentation.h"
#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"
#include "wscvt/report/picture.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Returns sentences about signs of a wrong segmentation; empty if there are none.
std::vector<Sentence> doubts_of(const Segmentation& segmentation);

/// Returns a few lines about a segmentation: grains, grains at the border, dropped voxels, the
/// threshold.
std::vector<std::string> segmentation_lines(const Segmentation& segmentation);

/// Slices across z, y and x.
struct OutlinedSlices {
  std::vector<Picture> pictures;
  VoxelCounts places = {};  ///< of the slices across x, y and z; voxels
};

/// Draws the slice across each axis that has the most boundary of grains: grey values with the
/// outlines of the grains in a few colours, dropped parts in red. Voxels keep their proportions;
/// pictures are 300 to 900 pixels wide and high, as far as the proportions allow. Reads the scan
/// once, the labels twice.
OutlinedSlices outlined_slices(LabelVolume& scan, const Segmentation& segmentation,
                               const Execution& execution);

/// Whether a file is a page of segmentation_html.
bool is_segmentation_page(const std::string& path);

/// Returns an HTML page for checking a segmentation: the slices, the lines, the sizes of the
/// grains.
std::string segmentation_html(LabelVolume& scan, const Segmentation& segmentation,
                              const ReportOrigin& origin, const Execution& execution);

}  // namespace wscvt
