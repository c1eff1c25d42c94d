// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "wscvt/measures/mesh_quality.h"

namespace wscvt {

/// One number per remeshed grain of a sample.
struct SampleDistribution {
  std::string key;             ///< in files; never changes between versions
  std::string label;           ///< for people
  std::string unit;            ///< "length", "length^3", "%", "degrees" or nothing
  std::vector<double> values;  ///< ascending
};

/// A grain that could not be remeshed.
struct SampleFailure {
  std::string grain;
  std::string error;
};

/// Statistics of a sample's table (see sample_table.h).
struct SampleSummary {
  std::size_t grains = 0;
  std::size_t failed = 0;
  std::size_t with_warnings = 0;
  /// The first grains with warnings only, to limit the memory.
  std::vector<std::string> warned;
  /// The first failures only, to limit the memory.
  std::vector<SampleFailure> failures;
  /// Size, form, sphericity, errors and quality.
  std::vector<SampleDistribution> distributions;
};

/// Max. number of failures, and of grains with warnings, that a summary names.
inline constexpr std::size_t most_failures_named = 100;

/// Whether a file begins like a table with a row per grain that is not of remeshes, but for example
/// of shapes or clumps, and has no summary. False if it cannot be read.
bool is_without_summary(const std::string& path);

/// Reads a whole table. Needs memory for 12 numbers per grain. Throws Error(InvalidInput) if the
/// file is not such a table or ends within a row, Error(InputOutput).
SampleSummary summarise_table(const std::string& path);

/// Counts ascending values in bins from the first to the last value, 8 to 60 bins.
Histogram histogram_of(const std::vector<double>& values);

/// Returns a JSON document: counts, mean, standard deviation, smallest and largest value, 10, 50
/// and 90 % of each distribution, failures.
std::string summary_json(const SampleSummary& summary);

/// Returns an HTML report with a histogram of each distribution.
std::string summary_html(const SampleSummary& summary);

/// Returns lines for a log.
std::vector<std::string> summary_lines(const SampleSummary& summary);

/// Writes the summary as HTML or JSON, by the ending of the name. Throws Error(InvalidInput) for
/// another ending, Error(InputOutput).
void write_summary(const std::string& path, const SampleSummary& summary);

/// Checks before the work that write_summary will accept the name.
void check_summary(const std::string& path);

}  // namespace wscvt
