// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "parameters.h"

namespace wscvt::filter {

/// The parameter ReportFile of every filter.
FilterParameter report_file_parameter();

/// Checks before the work that the file can be written. Throws Error(InvalidInput) for other
/// extensions and for tables with other columns, Error(InputOutput) for missing folders and names
/// of folders. An empty name means no file.
void check_remesh_report_file(const std::string& path);

/// Checks a report of descriptors. Its tables have more columns with a reference.
void check_descriptor_report_file(const std::string& path, bool with_reference);

/// Checks a parameter with the name of an output file, with one of `extensions` (".json").
void check_output_file(const std::string& path, const std::vector<std::string>& extensions,
                       const std::string& parameter);

/// Throws Error(InvalidInput) unless a file's name ends in one of `extensions`, in either case.
void check_extension(const std::string& path, const std::vector<std::string>& extensions,
                     const std::string& parameter);

/// Throws Error(InvalidInput) if two parameters name one file, because one would overwrite the
/// other.
void check_different_files(const std::string& path, const std::string& parameter,
                           const std::string& other, const std::string& other_parameter);

}  // namespace wscvt::filter
