// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace wscvt {

/// A size curve for virtual grains: the percentage by mass of grains smaller than a diameter,
/// linear between its points over the logarithm of the diameter. The diameter is of the sphere of
/// equal volume.
class GivenSizes {
 public:
  /// Diameters ascending and above 0, length; percentages ascending from 0 to 100. Throws
  /// Error(InvalidInput) for other values and for less than two points.
  GivenSizes(std::vector<double> diameters, std::vector<double> percentages);

  /// Returns the diameter below which a fraction of the grains lies, by number; length. `fraction`
  /// in [0, 1].
  double diameter(double fraction) const;

  /// The first record of table().
  static std::string heading();
  /// Returns a table that read_given_sizes reads, with a heading, commas and decimal points.
  /// `scale` multiplies the diameters.
  std::string table(double scale) const;

 private:
  std::vector<double> diameters_;
  std::vector<double> percentages_;
  std::vector<double> numbers_;  ///< cumulative, of the grains, last 1
};

/// Reads a table of two columns, diameter and percentage finer by mass, with or without a heading.
/// Throws Error: InvalidInput, with the line, for other content; InputOutput.
GivenSizes read_given_sizes(const std::string& path);

}  // namespace wscvt
