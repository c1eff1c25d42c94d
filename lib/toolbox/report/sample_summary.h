// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/measures/mesh_quality.h"

namespace wscvt {

/// One number per remeshed grain of a sample.
struct SampleDistribution {
  std::string key;             ///< in files; never changes between versions
  std::string label;           ///< for people
  std::string unit;            ///< "length", "length^3", "%", "degrees" or nothing
  bool in_log;                 ///< logs and figures show the size and what the remesh changed
  std::vector<double> values;  ///< ascending
};

/// What the table says of a grain: why it failed, or its warnings.
struct GrainMessage {
  std::string grain;
  std::string message;
};

/// Grains with a warning of one kind. A grain counts with each of its kinds.
struct WarningKind {
  std::string kind;    ///< what they have in common, such as "The remesh is not accurate"
  std::size_t grains;  ///< their number
  std::string first;   ///< of these grains
};

/// A remesh and its distance to its scan.
struct GrainDistance {
  std::string grain;
  double percent;    ///< rms distance in % of the equivalent radius
  std::string file;  ///< of the remesh, for its picture; empty: not known
};

/// Numbers of labels or bodies by their state in a census, such as "at the border", and of "all";
/// also of the "pieces" that are written, and of "pores".
using CensusStates = std::map<std::string, std::size_t>;

/// "5 labels: 3 written (1 in pieces), 1 at the border, 1 too small". `noun`: "labels" or "bodies".
std::string census_line(CensusStates states, const std::string& noun);

/// Statistics of a sample's table (see sample_table.h).
struct SampleSummary {
  CensusStates labels;  ///< of the sample's volumes; empty: none
  std::size_t grains = 0;
  std::size_t failed = 0;
  std::size_t with_warnings = 0;
  std::vector<WarningKind> warning_kinds;  ///< of all grains with warnings
  /// The first grains with warnings only, to limit the memory.
  std::vector<GrainMessage> warned;
  /// The first failures only, to limit the memory.
  std::vector<GrainMessage> failures;
  /// Options of the remeshes by the name that users type, with their values as text. "several" if
  /// the grains have different values.
  std::vector<std::pair<std::string, std::string>> options;
  /// The grains whose remeshes are farthest from their scans, farthest first.
  std::vector<GrainDistance> farthest;
  /// Size, form, sphericity, errors and quality.
  std::vector<SampleDistribution> distributions;
};

/// Max. number of failures, and of grains with warnings, that a summary names.
inline constexpr std::size_t most_failures_named = 100;

/// Max. number of remeshes that a summary shows: a row of pictures.
inline constexpr std::size_t most_grains_shown = 14;

/// Whether the file is a table of remeshed grains, as batch writes it.
bool is_batch_table(const std::string& path);

/// Reads a whole table. Needs memory for 12 numbers per grain. Throws Error(InvalidInput) if the
/// file is not such a table or ends within a row, Error(InputOutput).
SampleSummary summarise_table(const std::string& path);

/// Counts ascending values in bins from the first to the last value, 8 to 60 bins.
Histogram histogram_of(const std::vector<double>& values);

/// Returns a JSON document: counts, mean, standard deviation, smallest and largest value, 10, 50
/// and 90 % of each distribution, failures.
std::string summary_json(const SampleSummary& summary);

/// "6 grains: 5 remeshed, 1 of them with warnings, 1 failed".
std::string count_line(const SampleSummary& summary);

/// Returns the options of the remeshes for a page: "Options: nodes 300, edge-ratio 1.1." Options
/// without a value are left out.
std::string options_line(const SampleSummary& summary);

/// Returns a table's rows: mean, standard deviation and quantiles of each distribution.
std::vector<std::vector<std::string>> quantity_table(const SampleSummary& summary);

/// Returns the label of a distribution with its unit.
std::string with_unit(const SampleDistribution& one);

/// Whether the values differ by more than rounding.
bool is_spread(const SampleDistribution& one);

/// Returns lines for a log: the counts, names of grains with warnings, then size, errors and
/// quality of the remeshes. At most 10 lines.
std::vector<std::string> summary_lines(const SampleSummary& summary);

}  // namespace wscvt
