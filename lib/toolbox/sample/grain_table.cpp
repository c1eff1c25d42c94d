// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/grain_table.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "toolbox/sample/csv_reader.h"
#include "toolbox/sample/foreign_columns.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/table_heading.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Whether a field is a number with marks between its thousands, such as 1,000.5 or 12 500.
bool has_thousands(std::string_view field) {
  std::string text(trimmed(field));
  // No-break spaces and the typographic apostrophe, in UTF-8.
  for (const char* mark : {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89", "\xE2\x80\x99"}) {
    const std::string_view bytes = mark;
    for (std::size_t at = text.find(bytes); at != std::string::npos; at = text.find(bytes)) {
      text.replace(at, bytes.size(), "'");
    }
  }
  static const std::regex grouped(
      "[+-]?[0-9]{1,3}((,[0-9]{3})+(\\.[0-9]*)?|(\\.[0-9]{3})+(,[0-9]*)?|([ "
      "'][0-9]{3})+([.,][0-9]*)?)");
  return std::regex_match(text, grouped);
}

/// Whether a descriptor is a size, which is above 0.
bool is_size(std::string_view name) {
  if (name.rfind("scan.", 0) == 0) name.remove_prefix(5);
  return name == "volume" || name == "area" || name.rfind("axis_", 0) == 0 ||
         name.rfind("feret_", 0) == 0 || name == "equivalent_radius" ||
         name == "equivalent_diameter" || name == "mass" || name == "density";
}

/// Whether a descriptor is a fraction, at most 1 by its definition.
bool is_fraction(std::string_view name) {
  if (name.rfind("scan.", 0) == 0) name.remove_prefix(5);
  return name.rfind("sphericity", 0) == 0 || name == "convexity";
}

/// Only in square brackets another column than a size has its unit. Else it keeps its heading.
GrainColumn column_of(const TableHeading& heading) {
  const bool is_square = !heading.whole.empty() && heading.whole.back() == ']';
  const bool has_unit = is_square || (is_size(heading.name) && known_unit(heading.unit));
  return has_unit ? GrainColumn{heading.name, heading.unit} : GrainColumn{heading.whole, ""};
}

/// Content of a column: the names, files and states of grains, numbers, texts, or texts first and
/// then numbers.
enum class Role { Words, Undecided, Number, Text, Mixed };

/// Whether a field of a column of texts is a number, with a decimal point or comma.
bool is_number_among_texts(const std::string& field) {
  const auto number = number_in_field(field, ',');
  return number && !std::isnan(*number);
}

/// Reads the rows of a file one after the other.
class TableReader {
 public:
  TableReader(const std::string& path, const CsvReader& reader) : path_(path), reader_(reader) {}

  void read_heading(const std::vector<std::string>& fields);
  void read_row(const std::vector<std::string>& fields);
  void note_marks(std::size_t k, const std::string& field);
  void refuse_summary(const std::vector<std::string>& fields) const;
  bool takes_units(const std::vector<std::string>& fields);
  void check_unit(const std::vector<std::string>& fields);
  void check_name(const std::string& name);
  void check_diameter() const;
  void check_field(std::size_t k, const std::string& field, std::optional<double> number);
  void check_area() const;
  GrainTable table();

  /// Whether the table is a batch's, which may be cut in its last row.
  bool has_status() const { return status_field_.has_value(); }

  [[noreturn]] void fail(const std::string& what) const { fail_at(reader_.line(), what); }
  [[noreturn]] void fail_at(std::size_t line, const std::string& what) const {
    refuse("\"" + readable(path_, "") + "\", line " + std::to_string(line) + ": " + what);
  }

 private:
  const std::string& path_;
  const CsvReader& reader_;
  std::vector<GrainColumn> fields_;
  std::vector<ForeignColumn> foreign_;
  std::vector<Role> roles_;
  std::optional<std::size_t> name_field_;  ///< none: grains have the numbers of their rows
  std::optional<std::size_t> file_field_;
  std::optional<std::size_t> status_field_;
  std::optional<std::size_t> unit_field_;               ///< "unit" of each row
  std::string unit_;                                    ///< of the first row that has one
  std::unordered_map<std::string, std::size_t> lines_;  ///< of the grains' names
  std::optional<std::size_t> volume_field_;
  std::optional<std::size_t> diameter_field_;
  std::optional<std::size_t> area_field_;
  std::vector<std::vector<double>> numbers_;  ///< of each field of numbers
  GrainTable table_;
  bool has_comma_ = false;  ///< a number with a decimal comma
  std::string doubtful_;    ///< a number with points at thousands
  std::size_t doubtful_line_ = 0;
  /// What a column's numbers look like in a table that may have decimal commas.
  struct Marks {
    std::string grouped;  ///< the first one with points at thousands only, such as 1.660
    std::size_t line = 0;
    bool has_whole = false;    ///< one without a mark
    bool has_decimal = false;  ///< one with a point or comma that can only be a decimal mark
  };
  std::vector<Marks> marks_;
};

void TableReader::read_heading(const std::vector<std::string>& fields) {
  std::unordered_set<std::string> names;
  if (fields[0].rfind("\xFF\xFE", 0) == 0 || fields[0].rfind("\xFE\xFF", 0) == 0) {
    fail("the table is UTF-16. Save it as UTF-8.");
  }
  const bool has_numbers_only =
      std::all_of(fields.begin(), fields.end(), [&](const std::string& field) {
        return !trimmed(field).empty() && number_in_field(field, reader_.decimal()).has_value();
      });
  if (has_numbers_only) {
    fail(
        "the first line has numbers, not the names of the columns. Write a heading first, such as "
        "\"grain,volume,area\", with a name per column.");
  }
  std::vector<TableHeading> headings;
  for (const std::string& field : fields) headings.push_back(wscvt::read_heading(field));
  foreign_ = foreign_columns(headings);
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const std::string foreign(foreign_[k].name);
    fields_.push_back(foreign.empty() ? column_of(headings[k])
                                      : GrainColumn{foreign, headings[k].unit});
    const std::string& name = fields_.back().name;
    if (!names.insert(name).second) {
      fail("two columns are named \"" + readable(name, "") + "\". Rename one of them.");
    }
    if (name == "grain") name_field_ = k;
    if (name == "file") file_field_ = k;
    if (name == "status") status_field_ = k;
    if (name == "unit" || name == "units") unit_field_ = k;
    if (name == "volume") volume_field_ = k;
    if (name == "equivalent_diameter") diameter_field_ = k;
    if (name == "area" || name == "area_or_volume") area_field_ = k;
  }
  if (fields_.size() == 1) {
    fail(
        "the table has only one column. Separate columns by commas, semicolons or tabs; the first "
        "line has their names" +
        std::string(fields[0].rfind('#', 0) == 0 ? ", so delete the comments above it." : "."));
  }
  for (const GrainColumn& column : fields_) {
    const bool is_text = column.name == "file" || column.name == "status" || column.name == "error";
    roles_.push_back(is_text ? Role::Words : Role::Undecided);
  }
  // A first column without a name that is known has the grains' names, which have no unit.
  const GrainColumn& first = fields_.front();
  if (!name_field_ && first.unit.empty() && !is_size(first.name) && !is_fraction(first.name)) {
    name_field_ = 0;
  }
  if (name_field_) roles_[*name_field_] = Role::Words;
  numbers_.resize(fields_.size());
  marks_.resize(fields_.size());
}

void TableReader::note_marks(std::size_t k, const std::string& field) {
  const std::string_view text = trimmed(field);
  Marks& marks = marks_[k];
  if (text.find_first_of(".,eE") == std::string_view::npos) {
    marks.has_whole = marks.has_whole || !text.empty();
  } else if (!has_thousands(field) || text.front() == '0' || text.find(',') != text.npos) {
    marks.has_decimal = true;
  } else if (marks.grouped.empty()) {
    marks.grouped = field;
    marks.line = reader_.line();
  }
}

/// Throws for a number that no grain has.
void TableReader::check_field(std::size_t k, const std::string& field,
                              std::optional<double> number) {
  const auto fail_field = [&](const std::string& what) {
    fail("the column \"" + readable(fields_[k].name, "") + "\" has \"" + readable(field, "") +
         "\"" + what);
  };
  if (!number) {
    if (has_thousands(field)) fail_field(". Write numbers without marks between thousands.");
    if (is_size(fields_[k].name) || is_fraction(fields_[k].name)) {
      const std::string_view text = trimmed(field);
      if (!text.empty() && text.front() == '#') {
        fail_field(", an error of a spreadsheet. Correct it, or leave the field empty.");
      }
      const std::size_t end = text.find_first_not_of("+-0123456789., ");
      const std::string unit(end == 0 || end == std::string_view::npos ? ""
                                                                       : trimmed(text.substr(end)));
      fail_field(unit == "%" ? ". Write fractions of 1 without %."
                 : unit.empty()
                     ? ". Write a number, or leave the field empty."
                     : ". Write numbers only, with the unit in the heading: \"" +
                           readable(fields_[k].name, "") + " [" + readable(unit, "") + "]\".");
    }
    return;
  }
  if (reader_.decimal() == ',') note_marks(k, field);
  // In a table with decimal commas 1.000 may be one or a thousand.
  if (reader_.decimal() == ',' && field.find(',') != std::string::npos) has_comma_ = true;
  if (reader_.decimal() == ',' && field.find('.') != std::string::npos && has_thousands(field) &&
      doubtful_.empty()) {
    doubtful_ = field;
    doubtful_line_ = reader_.line();
  }
  if (std::isnan(*number)) {
    if (!is_size(fields_[k].name) || lower_case(trimmed(field)).find("nan") == std::string::npos) {
      return;  // left empty
    }
    fail_field(". Write a number, or leave the field empty.");
  }
  if (std::isinf(*number)) fail_field(", which is not finite. Leave the field empty.");
  if (is_size(fields_[k].name) && !(*number > 0.0)) {
    fail_field(", but every grain has a value above 0. Correct the row, or leave it out.");
  }
  if (is_fraction(fields_[k].name) && !(*number > 0.0 && *number <= 1.0 + 1e-6)) {
    fail_field(", but the value is above 0 and at most 1. Correct the row, or leave it out.");
  }
}

/// Throws if the last row has less area than a ball of its volume. Estimates from few voxels may be
/// a little below.
void TableReader::check_area() const {
  if (!volume_field_ || !area_field_ || fields_[*area_field_].name != "area") return;
  const std::vector<double>& volumes = numbers_[*volume_field_];
  const std::vector<double>& areas = numbers_[*area_field_];
  const auto unit = [&](std::size_t k) {
    const std::string& text = fields_[k].unit;
    return text.substr(0, text.find('^'));
  };
  if (volumes.empty() || areas.empty() || unit(*volume_field_) != unit(*area_field_)) return;
  const double of_ball = portable::cbrt(36.0 * pi * volumes.back() * volumes.back());
  constexpr double least = 0.7;
  if (!(areas.back() < least * of_ball)) return;
  fail("the area " + format_number(areas.back(), 4) + " is less than " + format_number(of_ball, 4) +
       ", that of a ball of the volume " + format_number(volumes.back(), 4) +
       ". No body has less. Correct the row, or rename the column if it is not the area of the "
       "surface.");
}

/// Throws if the last row's diameter is that of a disc: the grain is a section in a 2D image. The
/// diameter of a ball with an "area" that is its volume is scikit-image's.
void TableReader::check_diameter() const {
  if (!diameter_field_ || !area_field_) return;
  const double diameter = numbers_[*diameter_field_].back();
  const double area = numbers_[*area_field_].back();
  const auto is_near = [&](double other) { return std::abs(area - other) < 2e-3 * area; };
  const double of_disc = pi * diameter * diameter / 4.0;
  const double of_ball = pi * diameter * diameter * diameter / 6.0;
  const bool is_volume = fields_[*area_field_].name != "area";
  if (is_near(of_disc) && !is_near(of_ball)) {
    fail("the equivalent diameter " + format_number(diameter, 4) +
         " is that of a disc of the area " + format_number(area, 4) +
         ". The table is of a section, a 2D image, and no table of bodies. Measure the volume.");
  }
  if (is_volume || !is_near(of_ball)) return;
  fail("the area " + format_number(area, 4) +
       " is the volume of a ball with the equivalent diameter " + format_number(diameter, 4) +
       ", as scikit-image names it. Rename the column \"volume\".");
}

/// Throws for a grain that has a row above.
void TableReader::check_name(const std::string& name) {
  if (!name_field_ || fields_[*name_field_].name != "grain" || trimmed(name).empty()) return;
  const auto [found, is_new] = lines_.emplace(trimmed(name), reader_.line());
  if (is_new) return;
  fail("the grain \"" + readable(name, "") + "\" has a row in line " +
       std::to_string(found->second) + " too, and would count twice. Leave one out, or rename it.");
}

/// Throws for a row that spreadsheets and ImageJ write below the grains.
void TableReader::refuse_summary(const std::vector<std::string>& fields) const {
  constexpr std::string_view words[] = {"total",   "sum",     "mean",        "average",
                                        "sd",      "std",     "std dev",     "stdev",
                                        "min",     "max",     "count",       "median",
                                        "minimum", "maximum", "grand total", "standard deviation"};
  for (const std::string& field : fields) {
    const std::string text = lower_case(trimmed(field));
    if (std::find(std::begin(words), std::end(words), text) == std::end(words)) continue;
    fail("the row has \"" + readable(field, "") +
         "\", as one that sums up the rows above and is no grain. Leave it out, or name the grain "
         "otherwise.");
  }
}

/// Takes the units of a row of units below the heading. Returns false for another row.
bool TableReader::takes_units(const std::vector<std::string>& fields) {
  if (!table_.grains.empty() || unit_field_) return false;
  bool has_unit = false;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const auto unit = known_unit(fields[k]);
    if (!unit && !trimmed(fields[k]).empty() && name_field_ != k) return false;
    has_unit = has_unit || !unit.value_or("").empty();
  }
  if (!has_unit) return false;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (fields_[k].unit.empty()) fields_[k].unit = known_unit(fields[k]).value_or("");
  }
  return true;
}

/// Throws for rows in two units.
void TableReader::check_unit(const std::vector<std::string>& fields) {
  if (!unit_field_) return;
  const std::string text(trimmed(fields[*unit_field_]));
  const std::string unit = known_unit(text).value_or(text);
  if (unit.empty()) return;
  if (unit_.empty()) unit_ = unit;
  if (unit == unit_) return;
  fail("the row is in " + readable(unit, "") + ", but the rows above it are in " +
       readable(unit_, "") + ". Convert it.");
}

void TableReader::read_row(const std::vector<std::string>& fields) {
  if (fields.size() == 1 && trimmed(fields[0]).empty()) return;  // a blank line
  if (fields.size() != fields_.size()) {
    fail("the row has " + std::to_string(fields.size()) + " fields, and the heading has " +
         std::to_string(fields_.size()) + ". Write one field per column.");
  }
  if (status_field_ && fields[*status_field_] == "failed") {
    ++table_.failed;
    return;
  }
  if (takes_units(fields)) return;
  check_unit(fields);
  if (name_field_) check_name(fields[*name_field_]);
  if (!status_field_) refuse_summary(fields);
  table_.grains.push_back(name_field_ ? fields[*name_field_]
                                      : std::to_string(table_.grains.size() + 1));
  if (file_field_) table_.files.emplace_back(text_of_field(fields[*file_field_]));
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (roles_[k] == Role::Text && is_number_among_texts(fields[k])) roles_[k] = Role::Mixed;
    if (roles_[k] != Role::Undecided && roles_[k] != Role::Number) continue;
    std::optional<double> number = number_in_field(fields[k], reader_.decimal());
    if (number) *number = foreign_[k].factor * portable::pow(*number, foreign_[k].exponent);
    check_field(k, fields[k], number);
    if (!number && roles_[k] == Role::Number) {
      fail("the column \"" + readable(fields_[k].name, "") + "\" has \"" + readable(fields[k], "") +
           "\", and numbers above it. Write a number, or leave the field empty.");
    }
    if (!trimmed(fields[k]).empty()) {
      roles_[k] = number                             ? Role::Number
                  : is_number_among_texts(fields[k]) ? Role::Mixed
                                                     : Role::Text;
    }
    numbers_[k].push_back(number.value_or(missing));
  }
  check_area();
  check_diameter();
}

GrainTable TableReader::table() {
  if (has_comma_ && !doubtful_.empty()) {
    fail_at(doubtful_line_, "\"" + readable(doubtful_, "") +
                                "\" may have a point between thousands, because other fields have "
                                "decimal commas. Write numbers without marks between thousands.");
  }
  for (const Marks& marks : marks_) {
    if (marks.grouped.empty() || !marks.has_whole || marks.has_decimal) continue;
    fail_at(
        marks.line,
        "\"" + readable(marks.grouped, "") +
            "\" may have a point between thousands, because other numbers of its column are whole. "
            "Write numbers without marks between thousands. If the point is a decimal point, "
            "separate the columns by commas.");
  }
  if (table_.grains.empty()) fail("no row of the table has a grain.");
  std::vector<std::size_t> taken;
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    // A column of a batch may be empty for all of its grains.
    const Role role = roles_[k];
    if (role == Role::Text || role == Role::Mixed) table_.text_columns.push_back(fields_[k].name);
    if (role == Role::Mixed) table_.mixed_columns.push_back(fields_[k].name);
    if (role != Role::Undecided && role != Role::Number) continue;
    taken.push_back(k);
    table_.columns.push_back(fields_[k]);
  }
  if (std::count(roles_.begin(), roles_.end(), Role::Number) == 0) {
    fail("no column of the table has numbers. Write numbers without units, with decimal points.");
  }
  const auto rows = static_cast<Eigen::Index>(table_.grains.size());
  table_.values.resize(rows, taken.size());
  for (std::size_t k = 0; k < taken.size(); ++k) {
    const std::vector<double> numbers = std::move(numbers_[taken[k]]);
    table_.values.col(k) = Eigen::Map<const Eigen::VectorXd>(numbers.data(), rows);
  }
  return std::move(table_);
}

/// Whether there is a CR, but no LF, at the beginning of a file.
bool has_old_lines(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string head(4096, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find('\r') != std::string::npos && head.find('\n') == std::string::npos;
}

}  // namespace

std::optional<std::size_t> find_column(const std::vector<GrainColumn>& columns,
                                       std::string_view name) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const GrainColumn& column) { return column.name == name; });
  if (found == columns.end()) return {};
  return static_cast<std::size_t>(found - columns.begin());
}

std::string GrainTable::column_names(std::size_t most) const {
  std::vector<std::string> names;
  for (const GrainColumn& column : columns) names.push_back(readable(column.name, ""));
  return listed(names, most);
}

std::size_t GrainTable::index_of(std::string_view name) const {
  if (const auto found = find(name)) return *found;
  refuse("The table has no numeric column named \"" + readable(name, "") +
         "\". Choose one of: " + column_names() + ".");
}

std::string heading_of(const GrainColumn& column) {
  return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
}

GrainTable read_grain_table(const std::string& path) {
  InputFile stream(path);
  CsvReader reader(stream, Separator::OfFirstRecord);
  TableReader table(path, reader);
  std::vector<std::string> fields;
  if (!reader.next(fields)) {
    table.fail(has_old_lines(path)
                   ? "the lines end by CR, as on old Macs. Save the table with LF or CR LF."
                   : "the file has no table. Write a heading and a row per grain.");
  }
  table.read_heading(fields);
  while (reader.next(fields)) table.read_row(fields);
  if (!table.has_status() && reader.last(fields)) {
    table.read_row(fields);
  } else if (reader.is_cut()) {
    table.fail(
        "the file ends within this row. If the row is complete, end it with a line break. "
        "Otherwise run the batch of this table again to complete it.");
  }
  return table.table();
}

}  // namespace wscvt
