// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/sample_table.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "wscvt/base/csv_reader.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
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

/// A record that goes on with the record `rest`.
std::string before(const std::vector<std::string>& fields, const std::string& rest) {
  const std::string record = csv_record(fields);
  return record.substr(0, record.size() - 2) + "," + rest;
}

/// The header of a report and its row.
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

/// Where the row of a grain stands.
struct Place {
  std::string grain;
  std::size_t table;
  std::size_t offset;
  std::size_t size;
};

/// A table and its header; throws where it is none.
std::string read_header(const std::string& path, CsvReader& reader) {
  std::vector<std::string> fields;
  if (!reader.next(fields) || fields.size() < 3 || fields[0] != "grain" ||
      fields[status_column] != "status") {
    fail(ErrorCode::InvalidInput, path, "is no table of a sample; give those that a batch wrote.");
  }
  return reader.text();
}

std::ifstream open(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream.is_open()) {
    fail(ErrorCode::InputOutput, path, "cannot be opened; check that the file is there.");
  }
  return stream;
}

void add_places(const std::string& path, std::size_t table, std::string& header,
                std::vector<Place>& places) {
  std::ifstream stream = open(path);
  CsvReader reader(stream);
  const std::string own_header = read_header(path, reader);
  if (table > 0 && own_header != header) {
    fail(ErrorCode::InvalidInput, path,
         "has other columns than the first table; join tables of one version and one call.");
  }
  header = own_header;
  std::vector<std::string> fields;
  for (std::size_t offset = reader.size(); reader.next(fields); offset = reader.size()) {
    places.push_back({fields.front(), table, offset, reader.text().size()});
  }
  if (reader.is_cut()) {
    fail(ErrorCode::InvalidInput, path,
         "ends within a row; start its batch again, which goes on where it was.");
  }
}

}  // namespace

std::string sample_header(bool with_seconds) {
  std::vector<std::string> names = {"grain", "status", "error"};
  if (with_seconds) names.emplace_back("seconds");
  return before(names, halves(report_csv(RemeshResult())).first);
}

std::string sample_row(const std::string& grain, const RemeshResult& result, Seconds seconds) {
  return before(first_fields(grain, done, "", seconds),
                halves(report_csv(result, {grain, ""})).second);
}

std::string failed_row(const std::string& grain, const std::string& error, Seconds seconds) {
  const std::string header = halves(report_csv(RemeshResult())).first;
  const auto columns = std::count(header.begin(), header.end(), ',');
  return before(first_fields(grain, failed, error, seconds),
                std::string(static_cast<std::size_t>(columns), ',') + "\r\n");
}

SampleTable::SampleTable(std::string path, const std::string& header,
                         const std::vector<std::string>& grains)
    : path_(std::move(path)) {
  check_writable(path_);  // with its sentences about folders and links
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    fail(ErrorCode::InputOutput, path_, "cannot be opened; check that it is a file and yours.");
  }
  try {
    // Where files cannot be locked, whoever starts two batches in one folder has to know.
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      fail(ErrorCode::InvalidInput, path_,
           "is being written by another batch; wait for it, or give another folder.");
    }
    read(header, grains);
    if (::lseek(descriptor_, 0, SEEK_END) == 0) append(header);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
  rows_ -= rows_ > 0 ? 1 : 0;  // the header
}

SampleTable::~SampleTable() { ::close(descriptor_); }

void SampleTable::read(const std::string& header, const std::vector<std::string>& grains) {
  std::ifstream stream = open(path_);
  CsvReader reader(stream);
  std::vector<std::string> fields;
  while (reader.next(fields)) {
    if (rows_ == 0 && reader.text() != header) {
      fail(ErrorCode::InvalidInput, path_,
           "is no table with this batch's columns; give another folder.");
    }
    if (rows_ > 0) {
      const std::string expected = rows_ <= grains.size() ? grains[rows_ - 1] : "nothing";
      if (fields.front() != expected) {
        fail(ErrorCode::InvalidInput, path_,
             "has \"" + fields.front() + "\" in row " + std::to_string(rows_) +
                 ", where the inputs have " + expected +
                 ": it is of other inputs; give those, or another folder.");
      }
      if (fields[status_column] == failed) ++failed_rows_;
    }
    ++rows_;
  }
  if (reader.is_cut() && ::ftruncate(descriptor_, static_cast<off_t>(reader.size())) != 0) {
    fail(ErrorCode::InputOutput, path_,
         "ends within a row, which cannot be taken off; see whose "
         "it is.");
  }
}

void SampleTable::append(const std::string& row) {
  std::size_t written = 0;
  while (written < row.size()) {
    const ssize_t count = ::write(descriptor_, row.data() + written, row.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      fail(ErrorCode::InputOutput, path_,
           "took a part of a row only; check the space on the disk and start the batch again.");
    }
    written += static_cast<std::size_t>(count);
  }
  ++rows_;
}

std::size_t join_tables(const std::vector<std::string>& tables, const std::string& joined) {
  std::string header;
  std::vector<Place> places;
  for (std::size_t table = 0; table < tables.size(); ++table) {
    add_places(tables[table], table, header, places);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.grain < b.grain; });
  std::vector<std::ifstream> streams;
  for (const std::string& table : tables) streams.push_back(open(table));
  std::size_t rows = 0;
  write_file(joined, [&](std::ostream& stream) {
    stream << header;
    std::string last;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Place& place = places[k];
      std::string row(place.size, '\0');
      streams[place.table].seekg(static_cast<std::streamoff>(place.offset));
      streams[place.table].read(row.data(), static_cast<std::streamsize>(row.size()));
      if (k > 0 && places[k - 1].grain == place.grain) {
        if (row == last) continue;
        fail(ErrorCode::InvalidInput, tables[place.table],
             "and \"" + tables[places[k - 1].table] + "\" have different rows of \"" + place.grain +
                 "\"; join tables of parts of one sample.");
      }
      stream << row;
      last = std::move(row);
      ++rows;
    }
    return stream.good();
  });
  return rows;
}

}  // namespace wscvt
