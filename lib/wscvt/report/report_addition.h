// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/report/report.h"

namespace wscvt {

/// What was made of a remesh besides its files, such as tetrahedra, for its report.
struct ReportAddition {
  std::string heading;                                      ///< on the page
  std::vector<std::string> lines;                           ///< below it
  std::string key;                                          ///< in the JSON document
  std::vector<std::pair<std::string, std::size_t>> counts;  ///< its members
  std::vector<std::pair<std::string, double>> values;       ///< members behind them
};

/// As those of report.h. A member for each addition follows the others in the JSON document, and a
/// section goes before the options of the page. A row of CSV has none of them, because all rows of
/// a table have the same columns.
std::string report_json(const RemeshResult& result, const ReportOrigin& origin,
                        const std::vector<ReportAddition>& additions);
std::string report_html(const RemeshResult& result, const ReportOrigin& origin,
                        const std::vector<ReportAddition>& additions, const Execution& execution);
void write_report(const std::string& path, const RemeshResult& result, const ReportOrigin& origin,
                  const std::vector<ReportAddition>& additions, const Execution& execution);

}  // namespace wscvt
