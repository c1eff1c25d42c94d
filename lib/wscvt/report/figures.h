// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/measures/mesh_quality.h"

namespace wscvt {

// Plots as SVG, drawn here because a plotting library would be more code than the plots and need a
// window system. They scale with the page and print as lines.

/// A histogram with its name and a colour such as "#0a58b4".
struct NamedHistogram {
  std::string name;
  std::string colour;
  Histogram histogram;
};

/// Histograms over the same bins, as shares of what each counted, in %. `axis` says what is
/// measured and `counted` what was counted. Throws nothing; without histograms the plot is empty.
std::string histogram_figure(const std::string& axis, const std::string& counted,
                             const std::vector<NamedHistogram>& histograms);

/// A point of a curve.
struct CurvePoint {
  double x = 0.0;
  double y = 0.0;
};

/// Points over logarithmic axes, joined in the order of x, with a level line at `level`. Points
/// that are not positive and finite are left out.
std::string logarithmic_figure(const std::string& x_axis, const std::string& y_axis,
                               std::vector<CurvePoint> points, double level);

/// A bar with the colours of diverging_colour from -1 to 1, for values from -limit to limit.
std::string colour_scale(double limit);

/// Places for an axis' numbers: multiples of 1, 2 or 5 times a power of ten in [lower, upper], at
/// most `most` of them. Empty unless lower < upper.
std::vector<double> round_ticks(double lower, double upper, int most);

}  // namespace wscvt
