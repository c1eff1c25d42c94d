// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/measures/mesh_quality.h"

namespace wscvt {

// Plots as SVG. A plotting library would be more code than the plots and would need a window
// system. The plots scale with the page and print as lines.

/// A histogram with its name and a colour such as "#0a58b4".
struct NamedHistogram {
  std::string name;  ///< of the legend; empty: it has none
  std::string colour;
  Histogram histogram;
};

/// Draws histograms over the same bins, each as fractions of its own count, in %. `axis` names the
/// measured quantity, `counted` the counted items. Throws nothing. Without histograms the plot is
/// empty.
std::string histogram_figure(const std::string& axis, const std::string& counted,
                             const std::vector<NamedHistogram>& histograms);

/// A point of a curve.
struct CurvePoint {
  double x = 0.0;
  double y = 0.0;
};

/// Draws points over logarithmic axes, joined in the order of x, and a horizontal line at `level`.
/// Omits points that are not positive and finite.
std::string logarithmic_figure(const std::string& x_axis, const std::string& y_axis,
                               std::vector<CurvePoint> points, double level);

/// Draws a bar with the colours of diverging_colour from -1 to 1, for values from -limit to limit.
std::string colour_scale(double limit);

/// Returns at most `most` ticks of an axis: multiples of 1, 2 or 5 times a power of ten in [lower,
/// upper]. Empty unless lower < upper.
std::vector<double> round_ticks(double lower, double upper, int most);

}  // namespace wscvt
