// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/header_file.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "toolbox/volume/voxel_bytes.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

HeaderFile::HeaderFile(const std::string& path, std::uint64_t begin)
    : size_(file_size(path)),
      stream_(path),
      reader_(stream_, size_ - std::min(size_, begin), path) {
  stream_.seekg(static_cast<std::streamoff>(std::min(size_, begin)));
}

std::string HeaderFile::line() {
  constexpr std::size_t most_lines = 10000;
  constexpr std::size_t most_characters = 10000;
  // Checked before reading, because a line of voxels may be as long as the file.
  const std::string_view ahead = reader_.peek(most_characters);
  const bool has_end = ahead.size() < most_characters || ahead.find('\n') != std::string_view::npos;
  const std::optional<std::string_view> text = has_end ? reader_.line() : std::nullopt;
  if (!text || reader_.line_number() > most_lines) {
    fail_line("does not end the header correctly. Export it again.");
  }
  return std::string(trimmed(*text));
}

std::vector<std::string> HeaderFile::other_lines() {
  std::vector<std::string> lines;
  while (!is_at_end()) {
    std::string next = line();
    if (!next.empty()) lines.push_back(std::move(next));
  }
  return lines;
}

std::vector<double> numbers_in(std::string_view text, const HeaderFile& file) {
  std::string plain(text);
  for (char& c : plain) {
    if (c == ',' || c == '(' || c == ')' || c == '[' || c == ']') c = ' ';
  }
  std::vector<double> numbers;
  TextFields fields(plain);
  for (std::string_view field = fields.next(); !field.empty(); field = fields.next()) {
    const std::optional<double> number = number_in(field);
    if (!number) file.fail_line("has " + in_quotes(field) + " instead of a number.");
    numbers.push_back(*number);
  }
  return numbers;
}

Vector3 vector_in(std::string_view text, const HeaderFile& file) {
  const std::vector<double> numbers = numbers_in(text, file);
  if (numbers.size() != 3) file.fail_line("does not have three numbers.");
  return {numbers[0], numbers[1], numbers[2]};
}

std::vector<std::int64_t> whole_numbers_in(std::string_view text, const HeaderFile& file) {
  std::vector<std::int64_t> numbers;
  TextFields fields(text);
  for (std::string_view field = fields.next(); !field.empty(); field = fields.next()) {
    numbers.push_back(whole_number_of(field, file));
  }
  return numbers;
}

std::int64_t whole_number_of(std::string_view text, const HeaderFile& file) {
  const std::optional<std::int64_t> number = whole_number_in(trimmed(text));
  if (!number) file.fail_line("has " + in_quotes(text) + " instead of a whole number.");
  return *number;
}

}  // namespace wscvt
