// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/sample/detail_levels.h"
#include "wscvt/sample/sample_comparison.h"
#include "wscvt/sample/sample_files.h"
#include "wscvt/sample/sample_statistics.h"

namespace wscvt {

/// A sample, its statistics and what it is called.
struct ReportedSample {
  std::string name;
  std::string folder;  ///< of the grains' mesh files; empty: no thumbnails
  GrainSample sample;
  SampleStatistics statistics;
};

/// Statistics of a sample, or of two and what lies between them.
struct SampleReport {
  SampleOptions options;
  std::vector<ReportedSample> samples;       ///< one or two
  std::vector<ColumnComparison> comparison;  ///< of two samples
  std::optional<DetailLevels> levels;        ///< of the first sample
};

/// Measures one more sample of the report, by the report's options. Of several tables the finest is
/// shown (see finest_table), and those of the first sample give the levels; `mark_percent`: see
/// measure_levels. `densities`: one for all samples, one per sample, or none (see
/// SampleOptions::density). Throws as sample_of, measure_sample and measure_levels.
void add_sample(SampleReport& report, const std::string& name, const SampleTables& sample,
                const std::vector<double>& densities, double mark_percent,
                const Execution& execution);

/// Compares the two samples of the report, if there are two. Throws as the other function.
void compare_samples(SampleReport& report, const Execution& execution);

/// The report as lines of at most 80 characters: sizes, the main descriptors, the comparison, the
/// levels.
std::vector<std::string> sample_lines(const SampleReport& report);

/// All statistics as a JSON document.
std::string sample_json(const SampleReport& report);

/// All statistics as CSV after RFC 4180, a row per statistic: sample, descriptor, unit, weighting,
/// statistic, value, lower, upper. The errors at each number of nodes stand last, as the statistics
/// error_median_n100, error_percent_90_n100 and nodes_needed.
std::string sample_csv(const SampleReport& report);

/// A page for reading and printing (HTML), one file that refers to no other: size curve, diagrams
/// of form, histograms, thumbnails, the number of grains that an interval needs. A reader chooses
/// the descriptor there, and saves each figure as SVG and its data as CSV. It holds the numbers of
/// at most 10,000 grains of a sample and the pictures of at most 100, chosen evenly by size.
std::string sample_html(const SampleReport& report, const Execution& execution);

/// Writes the report in the format of the file's name: .html, .json or .csv. Throws Error as
/// report_format and write_file do.
void write_sample_report(const std::string& path, const SampleReport& report,
                         const Execution& execution);

}  // namespace wscvt
