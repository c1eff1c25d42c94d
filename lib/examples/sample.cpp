// SPDX-License-Identifier: GPL-3.0-or-later
// sample TABLE [PAGE.html]: statistics of a table of grains, such as shape.csv of `wscvt batch` or
// a table with the columns grain, axis_i_box and volume.
#include <wscvt/base/error.h>
#include <wscvt/report/sample_report.h>
#include <wscvt/sample/grain_table.h>

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
    report.options.density = 2650.0;
    wscvt::ReportedSample one;
    one.name = arguments[1];
    one.sample = wscvt::sample_of(wscvt::read_grain_table(arguments[1]), report.options);
    one.statistics = wscvt::measure_sample(one.sample, report.options, all_threads);
    const wscvt::Estimate d50 = one.statistics.size_by_mass.d50;
    std::cout << one.sample.grains.size() << " grains: D50 by mass " << d50.value << ' '
              << one.sample.size_unit << " (" << d50.lower << " to " << d50.upper << "), Cu "
              << one.statistics.size_by_mass.uniformity.value << '\n';
    for (const wscvt::ColumnStatistics& column : one.statistics.columns) {
      std::cout << "mean of " << column.column.name << ' ' << column.by_number.mean.value << ' '
                << column.column.unit << '\n';
    }
    report.samples.push_back(one);
    if (count > 2) wscvt::write_sample_report(arguments[2], report, all_threads);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
