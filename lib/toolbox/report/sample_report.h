// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "toolbox/report/sample_summary.h"
#include "toolbox/sample/detail_levels.h"
#include "toolbox/sample/sample_comparison.h"
#include "toolbox/sample/sample_files.h"
#include "toolbox/sample/sample_statistics.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// A sample with its name and statistics.
struct ReportedSample {
  std::string name;    ///< empty: the only sample, whose name is not told
  std::string folder;  ///< of the grains' mesh files; empty: no thumbnails
  /// Of the batch that measured the grains, for a page: its failures, warnings and options.
  std::optional<SampleSummary> batch;
  GrainSample sample;  ///< a page may be of a batch alone: then without grains
  SampleStatistics statistics;
  std::vector<VoxelTrend> trends;  ///< empty if the size of the voxels is not known
};

/// Statistics of one sample, or of two samples with their comparison.
struct SampleReport {
  SampleOptions options;
  std::vector<ReportedSample> samples;       ///< one or two
  std::vector<ColumnComparison> comparison;  ///< of two samples
  std::optional<DetailLevels> levels;        ///< of the first sample
};

/// Measures a sample with the report's options and adds it. If a sample has several tables, the
/// finest is shown (see finest_table). The tables of the first sample give the levels.
/// The batch is that of the folder of the table that is shown, if it has one. `mark_percent`: see
/// measure_levels. `densities`: one for all samples, one per sample, or empty
/// (see SampleOptions::density). Throws the errors of sample_of, measure_sample and measure_levels.
void add_sample(SampleReport& report, const std::string& name, const SampleTables& sample,
                const std::vector<double>& densities, double mark_percent,
                const Execution& execution);

/// Compares the samples of the report if there are two. Throws the errors of compare_samples(a, b,
/// ...).
void compare_samples(SampleReport& report, const Execution& execution);

/// Returns the whole log: sizes, the main descriptors, the comparison, the levels. Rows of tables
/// have at most 80 characters.
std::vector<std::string> sample_lines(const SampleReport& report);

/// Returns the lines that a person reads first: of each sample the grains and the sizes, then one
/// table: the comparison, else the levels, else the descriptors. At most 11 lines without notes.
std::vector<std::string> summary_lines(const SampleReport& report);

/// Whether a person reads this column first.
bool is_first_read(const std::string& name);

/// "4.1 (3.9 to 4.4)".
std::string with_interval(const Estimate& estimate);

/// Returns the name of the size without its definition, and its unit: "sieve size, mm".
std::string size_name(const GrainSample& sample);

/// Returns all statistics as a JSON document.
std::string sample_json(const SampleReport& report);

/// Returns all statistics as CSV (RFC 4180), a row per statistic: sample, descriptor, unit,
/// weighting, statistic, value, lower, upper. The last rows are the errors at each number of nodes:
/// error_median_n100, error_percent_90_n100 and nodes_needed. With the size of voxels, there are
/// the correlations with size of the resolved, the corrected and the trusted values (VoxelTrend).
std::string sample_csv(const SampleReport& report);

/// Returns an HTML report for reading and printing, one file without references to other files. Of
/// a batch: failures, warnings and options, the remeshes that are farthest from their scans, and
/// what the remeshes changed. Of a sample: size curve, diagrams of form, histograms, thumbnails,
/// the number of grains that an interval needs. The reader chooses the descriptor, and saves each
/// figure as SVG and its data as CSV. The report contains the numbers of at most 10,000 grains of a
/// sample and pictures of at most 100, chosen evenly by size. Long tables are collapsed.
std::string sample_html(const SampleReport& report, const Execution& execution);

/// Writes the report in the format of the file's name: .html, .json or .csv. Throws the errors of
/// report_format and write_file.
void write_sample_report(const std::string& path, const SampleReport& report,
                         const Execution& execution);

}  // namespace wscvt
