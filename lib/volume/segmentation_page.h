// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "volume/segmentation.h"
#include "wscvt/base/execution.h"
#include "wscvt/report/picture.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// What a page says of a segmentation in a few lines: grains, those at the border, what was
/// dropped, the threshold.
std::vector<std::string> segmentation_lines(const Segmentation& segmentation);

/// The grey values of the slice in the middle of each axis, x, y, z, with the outlines of the
/// grains over them, each grain's in one of a few colours, and what was dropped in red. Voxels have
/// their own proportions; pictures are 300 to 900 pixels wide and high, as far as the proportions
/// allow. Reads scan and labels once.
std::vector<Picture> outlined_slices(LabelVolume& scan, const Segmentation& segmentation,
                                     const Execution& execution);

/// A page (HTML) for looking whether a segmentation is right: the slices, the lines, the sizes of
/// the grains.
std::string segmentation_html(LabelVolume& scan, const Segmentation& segmentation,
                              const ReportOrigin& origin, const Execution& execution);

}  // namespace wscvt
