// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_file.h"

#include <QFileInfo>
#include <algorithm>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/report/report.h"

namespace wscvt::filter {

FilterParameter report_file_parameter() {
  return file_parameter(
      "ReportFile", ParameterKind::OutputFile, report_endings(), "Report file",
      "For the report: .html (with pictures), .json (everything) or .csv (appends a row to a "
      "table). Empty: no report. The log shows the path.");
}

void check_remesh_report_file(const std::string& path) {
  check_output_file(path, report_endings(), "ReportFile");
  if (!path.empty()) check_remesh_report(path);
}

void check_descriptor_report_file(const std::string& path, bool with_reference) {
  check_output_file(path, report_endings(), "ReportFile");
  if (!path.empty()) check_descriptor_report(path, with_reference);
}

void check_extension(const std::string& path, const std::vector<std::string>& extensions,
                     const std::string& parameter) {
  if (std::find(extensions.begin(), extensions.end(), ending_of(path)) != extensions.end()) return;
  refuse("Parameter " + parameter + " is '" + path +
         "', but the extension does not fit. Give a file name that ends in " +
         enumerated(extensions, " or ") + ". Nothing was changed.");
}

void check_output_file(const std::string& path, const std::vector<std::string>& extensions,
                       const std::string& parameter) {
  if (path.empty()) return;
  check_extension(path, extensions, parameter);
  const QFileInfo folder(QFileInfo(QString::fromStdString(path)).absolutePath());
  if (!folder.isDir()) {
    throw Error(ErrorCode::InputOutput,
                "Parameter " + parameter + " is '" + path + "', but there is no folder '" +
                    folder.filePath().toStdString() + "'. Create it first. Nothing was changed.");
  }
  if (QFileInfo(QString::fromStdString(path)).isDir()) {
    throw Error(ErrorCode::InputOutput,
                "Parameter " + parameter + " is '" + path +
                    "', but this is a folder. Give the name of a file. Nothing was changed.");
  }
}

void check_different_files(const std::string& path, const std::string& parameter,
                           const std::string& other, const std::string& other_parameter) {
  if (!same_file(path, other)) return;
  refuse("Parameters " + parameter + " and " + other_parameter + " both name '" + path +
         "'. Give two names. Nothing was changed.");
}

}  // namespace wscvt::filter
