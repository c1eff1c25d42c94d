// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "toolbox/sample/grain_table.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Returns the tables of shapes of a path: the file itself, or shape.csv of a batch's folder. A
/// batch with several numbers of nodes has one in each of its folders, such as n100. Throws
/// Error(InvalidInput) for a folder without a table, and for a mesh or grains.csv instead of a
/// table.
std::vector<std::string> sample_files(const std::string& path);

/// The tables of a sample: one, or one per number of nodes.
struct SampleTables {
  std::vector<GrainTable> tables;
  std::vector<std::string> files;  ///< their paths; empty if they are from no files
};

/// Reads the tables that sample_files returns. Throws as sample_files and read_grain_table do,
/// Error(Cancelled).
SampleTables read_sample(const std::string& path, const Execution& execution);

/// Returns the table with the most nodes, whose remeshes are closest to the scans; the first table
/// if none has a column "nodes".
std::size_t finest_table(const std::vector<GrainTable>& tables);

}  // namespace wscvt
