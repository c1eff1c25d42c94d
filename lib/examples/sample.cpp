// SPDX-License-Identifier: GPL-3.0-or-later
// sample TABLE [PAGE.html]: statistics of a table of grains, such as shape.csv of `wscvt batch` or
// a table with the columns grain, axis_i_box and volume.
#include <toolbox/report/sample_report.h>
#include <wscvt/base/error.h>

#include <exception>
#include <iostream>

int main(int count, char** arguments) {
  if (count < 2) {
    std::cerr << "usage: sample TABLE [PAGE.html]\n";
    return 2;
  }
  try {
    const wscvt::Execution all_threads;
    wscvt::SampleReport report;
    wscvt::add_sample(report, arguments[1], wscvt::read_sample(arguments[1], all_threads), {2650.0},
                      wscvt::usual_mark_percent, all_threads);
    const wscvt::ReportedSample& one = report.samples.front();
    const wscvt::Estimate d50 = one.statistics.size_by_mass.d50;
    std::cout << one.sample.grains.size() << " grains: D50 by mass " << d50.value << ' '
              << one.sample.size_unit << " (" << d50.lower << " to " << d50.upper << "), Cu "
              << one.statistics.size_by_mass.uniformity.value << '\n';
    for (const wscvt::ColumnStatistics& column : one.statistics.columns) {
      std::cout << "mean of " << column.column.name << ' ' << column.by_number.mean.value << ' '
                << column.column.unit << '\n';
    }
    if (count > 2) wscvt::write_sample_report(arguments[2], report, all_threads);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
