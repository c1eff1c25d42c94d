// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/sample_table.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "toolbox/sample/csv_reader.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

constexpr const char* done = "done";
constexpr const char* failed = "failed";

/// Returns the error of a failed row, or null.
const std::string* failure_of(const std::vector<std::string>& fields) {
  for (const std::size_t status : {1U, 3U}) {  // of a label, the fourth
    if (fields.size() > status + 1 && fields[status] == failed) return &fields[status + 1];
  }
  return nullptr;
}

/// Joins the fields and the record `rest` into one record.
std::string before(const std::vector<std::string>& fields, const std::string& rest) {
  const std::string record = csv_record(fields);
  return record.substr(0, record.size() - 2) + "," + rest;
}

/// Splits a report into header and row.
std::pair<std::string, std::string> halves(const std::string& csv) {
  const std::size_t row = csv.find("\r\n") + 2;
  return {csv.substr(0, row), csv.substr(row)};
}

/// Returns the path, after check_writable.
const std::string& writable(const std::string& path) {
  check_writable(path);
  return path;
}

}  // namespace

std::string sample_header(const std::string& report) {
  return before({"grain", "status", "error"}, halves(report).first);
}

std::string sample_row(const std::string& grain, const std::string& report) {
  return before({grain, done, ""}, halves(report).second);
}

std::string failed_row(const std::string& grain, const std::string& error,
                       const std::string& report) {
  const std::string header = halves(report).first;
  const auto columns = std::count(header.begin(), header.end(), ',');
  return before({grain, failed, error},
                std::string(static_cast<std::size_t>(columns), ',') + "\r\n");
}

std::string sample_header() { return sample_header(report_csv(RemeshResult())); }

std::string sample_row(const std::string& grain, const RemeshResult& result) {
  return sample_row(grain, report_csv(result, {grain, ""}));
}

std::string failed_row(const std::string& grain, const std::string& error) {
  return failed_row(grain, error, report_csv(RemeshResult()));
}

std::string failure_in(const std::string& record) {
  std::istringstream stream(record);
  std::vector<std::string> fields;
  CsvReader(stream).next(fields);
  const std::string* error = failure_of(fields);
  return error == nullptr ? "" : *error;
}

SampleTable::SampleTable(const std::string& path, const std::string& header,
                         const std::vector<std::string>& grains)
    : table_(writable(path), TableUse::AppendAlone) {
  InputFile stream(path);
  CsvReader reader(stream);
  std::vector<std::string> fields;
  if (reader.next(fields) && reader.text() != header) {
    refuse("\"" + path + "\" is not a table with this batch's columns. Give another folder.");
  }
  for (std::size_t begin = reader.size(); reader.next(fields); begin = reader.size()) {
    const std::string expected =
        rows_.size() < grains.size() ? csv_field(grains[rows_.size()]) : "nothing";
    if (fields.front() != expected) {
      refuse("\"" + path + "\" has \"" + fields.front() + "\" in row " +
             std::to_string(rows_.size() + 1) + ", but the inputs have " + expected +
             ". The table is from other inputs. Give those, or another folder.");
    }
    rows_.push_back({begin, failure_of(fields) != nullptr});
  }
  if (reader.is_cut()) table_.cut(reader.size());
  if (table_.size() == 0) table_.append(header);
}

std::size_t SampleTable::failed_rows() const {
  return static_cast<std::size_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.failed; }));
}

void SampleTable::keep(std::size_t rows) {
  if (rows >= rows_.size()) return;
  table_.cut(rows_[rows].begin);
  rows_.resize(rows);
}

void SampleTable::append(const std::string& row) { table_.append(row); }

}  // namespace wscvt
