// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/figures.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/picture.h"

namespace wscvt {

namespace {

// Units of the drawing. The page scales it, and its texts must be readable at a width of 360
// pixels.
constexpr double figure_width = 440.0;
constexpr double height = 300.0;
constexpr double font_size = 14.0;
constexpr double left = 62.0;
constexpr double right = 16.0;
constexpr double top = 34.0;
constexpr double bottom = 52.0;

std::string number(double value) { return format_number(value == 0.0 ? 0.0 : value, 6); }

/// Maps values to positions in the drawing.
struct Axis {
  double lower = 0.0;
  double upper = 1.0;
  double from = 0.0;
  double to = 1.0;

  double operator()(double value) const {
    return from + (value - lower) / (upper - lower) * (to - from);
  }
};

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" +
         more + ">" + html_escaped(text) + "</text>\n";
}

std::string line_between(double x1, double y1, double x2, double y2, const std::string& colour,
                         const std::string& more = "") {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) +
         "\" y2=\"" + number(y2) + "\" stroke=\"" + colour + "\"" + more + "/>\n";
}

struct Tick {
  double place;  ///< in the axis' values
  std::string label;
};

std::string frame(const std::string& x_title, const Axis& x, const std::vector<Tick>& x_ticks,
                  const std::string& y_title, const Axis& y, const std::vector<Tick>& y_ticks) {
  std::string svg;
  for (const Tick& tick : x_ticks) {
    svg += line_between(x(tick.place), y.from, x(tick.place), y.to, "#ddd");
    svg += text_at(x(tick.place), y.from + 17.0, "middle", tick.label);
  }
  for (const Tick& tick : y_ticks) {
    svg += line_between(x.from, y(tick.place), x.to, y(tick.place), "#ddd");
    svg += text_at(x.from - 6.0, y(tick.place) + 4.0, "end", tick.label);
  }
  svg += line_between(x.from, y.from, x.to, y.from, "#000");
  svg += line_between(x.from, y.from, x.from, y.to, "#000");
  svg += text_at(0.5 * (x.from + x.to), height - 10.0, "middle", x_title);
  const double middle = 0.5 * (y.from + y.to);
  svg += text_at(14.0, middle, "middle", y_title,
                 " transform=\"rotate(-90 14 " + number(middle) + ")\"");
  return svg;
}

std::string drawing(const std::string& title, const std::string& content,
                    double drawn_height = height) {
  return "<svg viewBox=\"0 0 " + number(figure_width) + " " + number(drawn_height) +
         "\" role=\"img\" font-family=\"sans-serif\" font-size=\"" + number(font_size) +
         "\"><title>" + html_escaped(title) + "</title>\n" + content + "</svg>\n";
}

std::vector<Tick> ticks_of(const std::vector<double>& places) {
  std::vector<Tick> ticks;
  ticks.reserve(places.size());
  for (const double place : places) ticks.push_back({place, number(place)});
  return ticks;
}

/// Draws the outline of the bars. Fractions are in %.
std::string bars(const NamedHistogram& shown, double total, const Axis& x, const Axis& y) {
  const Histogram& histogram = shown.histogram;
  const double step =
      (histogram.upper - histogram.lower) / static_cast<double>(histogram.counts.size());
  std::string path = "M" + number(x(histogram.lower)) + " " + number(y(0.0));
  for (std::size_t k = 0; k < histogram.counts.size(); ++k) {
    const double share = 100.0 * static_cast<double>(histogram.counts[k]) / total;
    const double from = histogram.lower + step * static_cast<double>(k);
    path += "L" + number(x(from)) + " " + number(y(share));
    path += "L" + number(x(from + step)) + " " + number(y(share));
  }
  path += "L" + number(x(histogram.upper)) + " " + number(y(0.0)) + "Z";
  return "<path d=\"" + path + "\" fill=\"" + shown.colour + "\" fill-opacity=\"0.4\" stroke=\"" +
         shown.colour + "\"/>\n";
}

double total_of(const Histogram& histogram) {
  double total = 0.0;
  for (const std::size_t count : histogram.counts) total += static_cast<double>(count);
  return std::max(total, 1.0);
}

/// A logarithmic axis for all values, with margins at its ends.
Axis logarithmic_axis(double smallest, double largest, double from, double to) {
  const double margin = std::max(0.05 * portable::log10(largest / smallest), 0.05);
  return {portable::log10(smallest) - margin, portable::log10(largest) + margin, from, to};
}

/// Ticks at 1, 2 and 5 times powers of ten, or at powers of ten if that is too many.
std::vector<Tick> logarithmic_ticks(const Axis& axis) {
  constexpr std::size_t most = 12;  // more texts overlap
  std::vector<Tick> ticks;
  const auto collect = [&](const std::vector<double>& digits, int step) {
    ticks.clear();
    for (int power = static_cast<int>(std::floor(axis.lower));
         power <= static_cast<int>(std::ceil(axis.upper)); ++power) {
      if (power % step != 0) continue;
      for (const double digit : digits) {
        const double value = digit * portable::pow(10.0, power);
        const double place = portable::log10(value);
        if (place >= axis.lower && place <= axis.upper) ticks.push_back({place, number(value)});
      }
    }
  };
  collect({1.0, 2.0, 5.0}, 1);
  for (int step = 1; ticks.size() > most; ++step) collect({1.0}, step);
  if (ticks.size() > 2) return ticks;
  // Less than a decade: multiples of one step are more useful.
  ticks.clear();
  for (const double value :
       round_ticks(portable::pow(10.0, axis.lower), portable::pow(10.0, axis.upper), 6)) {
    if (value > 0.0) ticks.push_back({portable::log10(value), number(value)});
  }
  return ticks;
}

}  // namespace

std::vector<double> round_ticks(double lower, double upper, int most) {
  std::vector<double> ticks;
  if (!(lower < upper) || most < 1) return ticks;
  const double size = (upper - lower) / most;
  double step = portable::pow(10.0, std::floor(portable::log10(size)));
  for (const double factor : {2.0, 2.5, 2.0}) {  // 1, 2, 5, 10
    if (step >= size) break;
    step *= factor;
  }
  // If the limits are neighbouring numbers, no tick lies between them and the loop would not end.
  constexpr double least_share = 1e-12;
  if (!(step > least_share * std::max(std::abs(lower), std::abs(upper)))) return ticks;
  // Rounding may move a tick slightly beyond an end.
  const double slack = 1e-9 * step;
  for (double k = std::ceil((lower - slack) / step); k * step <= upper + slack; k += 1.0) {
    ticks.push_back(k * step);
  }
  if (static_cast<int>(ticks.size()) > most) ticks.pop_back();
  return ticks;
}

std::string histogram_figure(const std::string& axis, const std::string& counted,
                             const std::vector<NamedHistogram>& histograms) {
  Axis x{0.0, 1.0, left, figure_width - right};
  Axis y{0.0, 1.0, height - bottom, top};
  if (!histograms.empty()) {
    x.lower = histograms.front().histogram.lower;
    x.upper = histograms.front().histogram.upper;
    double largest = 0.0;
    for (const NamedHistogram& one : histograms) {
      const double total = total_of(one.histogram);
      for (const std::size_t count : one.histogram.counts) {
        largest = std::max(largest, 100.0 * static_cast<double>(count) / total);
      }
    }
    y.upper = largest > 0.0 ? 1.05 * largest : 1.0;
  }
  std::string svg =
      frame(axis, x, ticks_of(round_ticks(x.lower, x.upper, 8)),
            "fraction of the " + counted + ", %", y, ticks_of(round_ticks(y.lower, y.upper, 6)));
  double legend = left + 10.0;
  for (const NamedHistogram& one : histograms) {
    svg += bars(one, total_of(one.histogram), x, y);
    if (one.name.empty()) continue;
    svg += "<rect x=\"" + number(legend) + "\" y=\"12\" width=\"12\" height=\"12\" fill=\"" +
           one.colour + "\" fill-opacity=\"0.4\" stroke=\"" + one.colour + "\"/>\n";
    svg += text_at(legend + 18.0, 23.0, "start", one.name);
    legend += 18.0 + 8.0 * static_cast<double>(one.name.size()) + 20.0;
  }
  return drawing(axis, svg);
}

std::string colour_scale(double limit) {
  // Linear from one end colour to white to the other, like diverging_colour.
  std::string svg = "<linearGradient id=\"scale\">";
  for (const double value : {-1.0, 0.0, 1.0}) {
    const Colour colour = diverging_colour(value);
    svg += "<stop offset=\"" + number(0.5 * (value + 1.0)) + "\" stop-color=\"rgb(" +
           std::to_string(colour[0]) + "," + std::to_string(colour[1]) + "," +
           std::to_string(colour[2]) + ")\"/>";
  }
  const Axis x{-limit, limit, 40.0, figure_width - 40.0};
  svg += "</linearGradient>\n<rect x=\"" + number(x.from) + "\" y=\"4\" width=\"" +
         number(x.to - x.from) + "\" height=\"14\" fill=\"url(#scale)\" stroke=\"#888\"/>\n";
  for (const double value : {-limit, 0.0, limit}) {
    svg += text_at(x(value), 34.0, "middle", format_number(value, 3));
  }
  return drawing("scale of the colours", svg, 40.0);
}

std::string logarithmic_figure(const std::string& x_axis, const std::string& y_axis,
                               std::vector<CurvePoint> points, double level) {
  const auto unusable = [](const CurvePoint& p) {
    return !(p.x > 0.0 && p.y > 0.0 && std::isfinite(p.x) && std::isfinite(p.y));
  };
  points.erase(std::remove_if(points.begin(), points.end(), unusable), points.end());
  std::sort(points.begin(), points.end(),
            [](const CurvePoint& a, const CurvePoint& b) { return a.x < b.x; });
  if (points.empty()) return drawing(y_axis, "");
  const auto by_y = [](const CurvePoint& a, const CurvePoint& b) { return a.y < b.y; };
  const auto [lowest, highest] = std::minmax_element(points.begin(), points.end(), by_y);
  const bool has_level = level > 0.0 && std::isfinite(level);
  const Axis x = logarithmic_axis(points.front().x, points.back().x, left, figure_width - right);
  const Axis y =
      logarithmic_axis(has_level ? std::min(level, lowest->y) : lowest->y,
                       has_level ? std::max(level, highest->y) : highest->y, height - bottom, top);
  std::string svg = frame(x_axis, x, logarithmic_ticks(x), y_axis, y, logarithmic_ticks(y));
  if (has_level) {
    const double place = y(portable::log10(level));
    svg += line_between(x.from, place, x.to, place, "#c60", " stroke-dasharray=\"6 4\"");
    svg += text_at(x.to - 4.0, place - 5.0, "end", "target " + number(level), " fill=\"#c60\"");
  }
  std::string path;
  for (const CurvePoint& p : points) {
    path += (path.empty() ? "M" : "L") + number(x(portable::log10(p.x))) + " " +
            number(y(portable::log10(p.y)));
  }
  svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"#0a58b4\"/>\n";
  for (const CurvePoint& p : points) {
    svg += "<circle cx=\"" + number(x(portable::log10(p.x))) + "\" cy=\"" +
           number(y(portable::log10(p.y))) + "\" r=\"3.5\" fill=\"#0a58b4\"/>\n";
  }
  return drawing(y_axis, svg);
}

}  // namespace wscvt
