// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/sample_table.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include "wscvt/base/csv_reader.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

constexpr const char* done = "done";
constexpr const char* failed = "failed";
constexpr std::size_t status_column = 1;

[[noreturn]] void fail(ErrorCode code, const std::string& path, const std::string& what) {
  throw Error(code, "\"" + path + "\" " + what);
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

std::vector<std::string> first_fields(const std::string& grain, const char* status,
                                      const std::string& error, Seconds seconds) {
  std::vector<std::string> fields = {grain, status, error};
  if (seconds) fields.push_back(format_exact(*seconds));
  return fields;
}

/// Position of a grain's row.
struct RowPlace {
  std::string grain;
  std::size_t table;
  std::size_t offset;
  std::size_t size;
};

/// Returns the table's header. Throws if the file is not such a table.
std::string read_header(const std::string& path, CsvReader& reader) {
  std::vector<std::string> fields;
  if (!reader.next(fields) || fields.size() < 3 || fields[0] != "grain" ||
      fields[status_column] != "status") {
    fail(ErrorCode::InvalidInput, path,
         "is not a table of a sample. Give tables that batch wrote.");
  }
  return reader.text();
}

std::ifstream open(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream.is_open()) {
    fail(ErrorCode::InputOutput, path, "cannot be opened. Check that the file exists.");
  }
  return stream;
}

void add_places(const std::string& path, std::size_t table, std::string& header,
                std::vector<RowPlace>& places) {
  std::ifstream stream = open(path);
  CsvReader reader(stream);
  const std::string own_header = read_header(path, reader);
  if (table > 0 && own_header != header) {
    fail(
        ErrorCode::InvalidInput, path,
        "has other columns than the first table. Join only tables of one version and one command.");
  }
  header = own_header;
  std::vector<std::string> fields;
  for (std::size_t offset = reader.size(); reader.next(fields); offset = reader.size()) {
    places.push_back({fields.front(), table, offset, reader.text().size()});
  }
  if (reader.is_cut()) {
    fail(ErrorCode::InvalidInput, path,
         "ends within a row. Run its batch command again to complete it.");
  }
}

/// Returns the path, after check_writable.
const std::string& writable(const std::string& path) {
  check_writable(path);
  return path;
}

}  // namespace

std::string sample_header(const std::string& report, bool with_seconds) {
  std::vector<std::string> names = {"grain", "status", "error", "seconds"};
  if (!with_seconds) names.pop_back();
  return before(names, halves(report).first);
}

std::string sample_row(const std::string& grain, const std::string& report, Seconds seconds) {
  return before(first_fields(grain, done, "", seconds), halves(report).second);
}

std::string failed_row(const std::string& grain, const std::string& error,
                       const std::string& report, Seconds seconds) {
  const std::string header = halves(report).first;
  const auto columns = std::count(header.begin(), header.end(), ',');
  return before(first_fields(grain, failed, error, seconds),
                std::string(static_cast<std::size_t>(columns), ',') + "\r\n");
}

std::string sample_header(bool with_seconds) {
  return sample_header(report_csv(RemeshResult()), with_seconds);
}

std::string sample_row(const std::string& grain, const RemeshResult& result, Seconds seconds) {
  return sample_row(grain, report_csv(result, {grain, ""}), seconds);
}

std::string failed_row(const std::string& grain, const std::string& error, Seconds seconds) {
  return failed_row(grain, error, report_csv(RemeshResult()), seconds);
}

SampleTable::SampleTable(const std::string& path, const std::string& header,
                         const std::vector<std::string>& grains)
    : table_(writable(path), TableUse::AppendAlone) {
  read(header, grains);
  if (table_.size() == 0) table_.append(header);
}

void SampleTable::read(const std::string& header, const std::vector<std::string>& grains) {
  const std::string& path = table_.path();
  std::ifstream stream = open(path);
  CsvReader reader(stream);
  std::vector<std::string> fields;
  if (reader.next(fields) && reader.text() != header) {
    fail(ErrorCode::InvalidInput, path,
         "is not a table with this batch's columns. Give another folder.");
  }
  for (std::size_t begin = reader.size(); reader.next(fields); begin = reader.size()) {
    const std::string expected =
        rows_.size() < grains.size() ? csv_field(grains[rows_.size()]) : "nothing";
    if (fields.front() != expected) {
      fail(ErrorCode::InvalidInput, path,
           "has \"" + fields.front() + "\" in row " + std::to_string(rows_.size() + 1) +
               ", but the inputs have " + expected +
               ". The table is from other inputs. Give those, or another folder.");
    }
    rows_.push_back({begin, fields[status_column] == failed});
  }
  if (reader.is_cut()) table_.cut(reader.size());
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

void join_tables(const std::vector<std::string>& tables, const std::string& joined) {
  std::string header;
  std::vector<RowPlace> places;
  for (std::size_t table = 0; table < tables.size(); ++table) {
    add_places(tables[table], table, header, places);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const RowPlace& a, const RowPlace& b) { return a.grain < b.grain; });
  std::vector<std::ifstream> streams;
  streams.reserve(tables.size());
  for (const std::string& table : tables) streams.push_back(open(table));
  write_file(joined, [&](std::ostream& stream) {
    stream << header;
    std::string last;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const RowPlace& place = places[k];
      std::string row(place.size, '\0');
      streams[place.table].seekg(static_cast<std::streamoff>(place.offset));
      streams[place.table].read(row.data(), static_cast<std::streamsize>(row.size()));
      if (k > 0 && places[k - 1].grain == place.grain) {
        if (row == last) continue;
        fail(ErrorCode::InvalidInput, tables[place.table],
             "and \"" + tables[places[k - 1].table] + "\" have different rows of \"" + place.grain +
                 "\". Join only tables of parts of one sample.");
      }
      stream << row;
      last = std::move(row);
    }
    return stream.good();
  });
}

}  // namespace wscvt
