// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "parameters.h"

namespace wscvt::filter {

/// The parameter ReportFile of every filter.
FilterParameter report_file_parameter();

/// Refuses before work starts what could not be written after it: other extensions and tables with
/// other columns (InvalidInput), folders that do not exist and names of folders (InputOutput). An
/// empty name is none.
void check_remesh_report_file(const std::string& path);

/// The same for the report of the descriptors, whose tables have more columns with a reference.
void check_descriptor_report_file(const std::string& path, bool with_reference);

/// The same for a parameter that names a file to be written, with one of `extensions` (".json").
void check_output_file(const std::string& path, const std::vector<std::string>& extensions,
                       const std::string& parameter);

/// Throws Error(InvalidInput) unless a file's name ends in one of `extensions`, in either case.
void check_extension(const std::string& path, const std::vector<std::string>& extensions,
                     const std::string& parameter);

/// Throws Error(InvalidInput) when two parameters name one file, which the one would overwrite
/// after the other was read or written.
void check_different_files(const std::string& path, const std::string& parameter,
                           const std::string& other, const std::string& other_parameter);

}  // namespace wscvt::filter
