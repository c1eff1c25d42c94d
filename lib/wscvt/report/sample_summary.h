// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "wscvt/measures/mesh_quality.h"

namespace wscvt {

/// One number of each grain of a sample that was remeshed.
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

/// What a table of a sample comes to (see sample_table.h).
struct SampleSummary {
  std::size_t grains = 0;
  std::size_t failed = 0;
  std::size_t with_warnings = 0;
  /// The first of them: a sample in which everything fails is not to fill the memory.
  std::vector<SampleFailure> failures;
  /// Size, form, sphericity, errors and quality.
  std::vector<SampleDistribution> distributions;
};

/// How many failures a summary names.
inline constexpr std::size_t most_failures_named = 100;

/// Reads a whole table; memory is 12 numbers a grain. Throws Error: InvalidInput when the file is
/// no such table or ends within a row, InputOutput.
SampleSummary summarise_table(const std::string& path);

/// Bins from the first to the last of values that ascend, as many as a page can show.
Histogram histogram_of(const std::vector<double>& values);

/// The summary as a JSON document: counts, mean, standard deviation, smallest and largest value,
/// 10, 50 and 90 % of each distribution, failures.
std::string summary_json(const SampleSummary& summary);

/// The same as a page with a histogram of each distribution.
std::string summary_html(const SampleSummary& summary);

/// The same as lines for a log.
std::vector<std::string> summary_lines(const SampleSummary& summary);

/// Writes the summary as a page or as JSON, by the ending of the name. Throws Error: InvalidInput
/// for another ending, InputOutput.
void write_summary(const std::string& path, const SampleSummary& summary);

/// Refuses before the work what write_summary would refuse after it.
void check_summary(const std::string& path);

}  // namespace wscvt
