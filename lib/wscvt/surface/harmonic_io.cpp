// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {

namespace {

constexpr const char* format_tag = "wscvt-harmonics-1";
constexpr const char* radial_kind = "radial";
constexpr const char* map_kind = "map";
constexpr std::array<const char*, 3> coordinate_names{"x", "y", "z"};

[[noreturn]] void refuse_file(const std::string& path, const std::string& what) {
  refuse("The file " + path + " is not usable: " + what);
}

[[noreturn]] void refuse_line(const std::string& path, std::size_t line, const std::string& what) {
  refuse_file(path, "line " + std::to_string(line) + " " + what);
}

/// One line of the text form; `line` is 0 if no line was read.
struct ComplexCoefficient {
  std::size_t line = 0;
  std::complex<double> value;
};

/// Returns coefficients in the order of harmonic_index, up to the highest degree in the file.
/// Allows commas between numbers if `with_commas`.
std::vector<ComplexCoefficient> read_lines(const std::string& path, bool with_commas) {
  InputFile stream(path);
  std::vector<ComplexCoefficient> coefficients;
  std::string text;
  std::size_t line = 0;
  while (std::getline(stream, text)) {
    ++line;
    if (with_commas) std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream fields(text);
    fields.imbue(std::locale::classic());
    fields >> std::ws;
    if (fields.eof()) continue;
    int n = 0;
    int m = 0;
    double real = 0.0;
    double imaginary = 0.0;
    if (!(fields >> n >> m >> real >> imaginary) || !(fields >> std::ws).eof()) {
      refuse_line(path, line,
                  with_commas ? "does not have the four numbers l, m, C, S."
                              : "does not have the four numbers n m Re Im.");
    }
    if (n < 0 || n > maximum_harmonic_degree || m < -n || m > n) {
      refuse_line(path, line,
                  "gives n = " + std::to_string(n) + ", m = " + std::to_string(m) +
                      ". n must be 0 to " + std::to_string(maximum_harmonic_degree) +
                      " and m from -n to n.");
    }
    if (coefficients.size() < harmonic_count(n)) coefficients.resize(harmonic_count(n));
    ComplexCoefficient& coefficient = coefficients[harmonic_index(n, m)];
    if (coefficient.line != 0) {
      refuse_line(path, line,
                  "repeats the coefficient of line " + std::to_string(coefficient.line) + ".");
    }
    coefficient = {line, {real, imaginary}};
  }
  if (coefficients.empty()) refuse_file(path, "it has no coefficients.");
  return coefficients;
}

/// Returns the degree up to which coefficients are used.
int used_degree(const std::vector<ComplexCoefficient>& coefficients, int degree) {
  const int highest = static_cast<int>(std::lround(std::sqrt(coefficients.size()))) - 1;
  return degree < 0 ? highest : std::min(degree, highest);
}

/// Two families of programs write four numbers per row. Refuses a file that fits both conventions.
void check_convention(const std::vector<ComplexCoefficient>& coefficients,
                      const std::string& path) {
  if (coefficients.size() == 1) return;
  for (std::size_t n = 1; n * n < coefficients.size(); ++n) {
    for (std::size_t m = 0; m < n; ++m) {
      if (coefficients[n * n + m].line != 0) return;  // of a negative order
    }
  }
  refuse_file(path,
              "it has no negative orders, so its rows are n m Re Im of the NIST particle shape "
              "sets with half of them left out, or l m C S of SHTOOLS. Add the rows of negative "
              "orders, (-1)^m times the conjugates, or name the file .sh if SHTOOLS wrote it "
              "(normalization 4pi, csphase 1).");
}

/// Returns the factor from SHTOOLS's coefficients for m >= 0 to ours. SHTOOLS's harmonics have no
/// Condon-Shortley phase and a mean square over the sphere of 1. Ours have the phase, and the
/// integral of their squares is 1.
double shtools_factor(int m) { return (m % 2 == 0 ? 1.0 : -1.0) * std::sqrt(4.0 * pi); }

/// Returns the surface of a file after checks.
HarmonicSurface make_surface(const std::string& path, std::vector<double> coefficients) {
  HarmonicSurface surface(std::move(coefficients));
  if (!(smallest_radius(surface, Execution(1)) > 0.0)) {
    refuse_file(path, "the radius of its series is not positive everywhere.");
  }
  return surface;
}

/// Opens and parses the file, checks its format and calls `read`.
template <class Read>
auto read_json(const std::string& path, const Read& read) {
  InputFile stream(path);
  try {
    const nlohmann::json json = nlohmann::json::parse(stream);
    if (json.at("format").get<std::string>() != format_tag) {
      refuse_file(path, std::string("its \"format\" is not \"") + format_tag + "\".");
    }
    return read(json);
  } catch (const nlohmann::json::exception& error) {
    // The parser's message contains the line and column.
    refuse_file(path, error.what());
  }
}

/// Whether the file has series of x, y and z, not one of the radius.
bool is_map(const std::string& path, const nlohmann::json& json) {
  const std::string kind = json.value("kind", std::string(radial_kind));
  if (kind != radial_kind && kind != map_kind) {
    refuse_file(path, "its \"kind\" is \"" + kind + "\". It must be \"" + radial_kind + "\" or \"" +
                          map_kind + "\".");
  }
  return kind == map_kind;
}

std::vector<double> coefficients_of(const std::string& path, const nlohmann::json& degree_json,
                                    const nlohmann::json& values) {
  // The JSON library would read 2.7 as 2, 1e30 as any number and true as 1.
  if (!degree_json.is_number_integer() || degree_json < 0 ||
      degree_json > maximum_harmonic_degree) {
    refuse_file(path, "its \"degree\" is not a whole number from 0 to " +
                          std::to_string(maximum_harmonic_degree) + ".");
  }
  const int degree = degree_json.get<int>();
  if (!values.is_array()) refuse_file(path, "its \"coefficients\" are not a list.");
  std::vector<double> coefficients;
  for (const nlohmann::json& coefficient : values) {
    if (!coefficient.is_number()) {
      refuse_file(path, "coefficient " + std::to_string(coefficients.size()) + " is not a number.");
    }
    coefficients.push_back(coefficient.get<double>());
  }
  if (coefficients.size() != harmonic_count(degree)) {
    refuse_file(path, "\"degree\" is " + std::to_string(degree) + " and there are " +
                          std::to_string(coefficients.size()) +
                          " coefficients. There must be (degree + 1)^2, degree 0 to " +
                          std::to_string(maximum_harmonic_degree) + ".");
  }
  return coefficients;
}

void write_json(const std::string& path, const char* kind, int degree,
                const nlohmann::ordered_json& coefficients) {
  nlohmann::ordered_json json;
  json["format"] = format_tag;
  json["kind"] = kind;
  json["degree"] = degree;
  json["coefficients"] = coefficients;
  write_file(path, json.dump(1) + "\n");
}

}  // namespace

HarmonicSurface read_complex_harmonics(const std::string& path, int degree) {
  if (degree < -1) {
    refuse("The degree to cut the series at is " + std::to_string(degree) +
           ". Give 0 or more, or -1 to keep all.");
  }
  const std::vector<ComplexCoefficient> complex = read_lines(path, false);
  check_convention(complex, path);
  double largest = 0.0;
  for (const ComplexCoefficient& coefficient : complex) {
    largest = std::max(largest, std::abs(coefficient.value));
  }
  const int used = used_degree(complex, degree);
  std::vector<double> real(harmonic_count(used));
  for (int n = 0; n <= used; ++n) {
    for (int m = 0; m <= n; ++m) {
      const ComplexCoefficient& coefficient = complex[harmonic_index(n, m)];
      if (coefficient.line == 0) {
        refuse_file(path, "the coefficient n = " + std::to_string(n) +
                              ", m = " + std::to_string(m) + " is missing.");
      }
      // r is real: c_n,-m = (-1)^m conj(c_nm), which makes c_n0 real.
      const ComplexCoefficient& mirrored = complex[harmonic_index(n, -m)];
      const double parity = m % 2 == 0 ? 1.0 : -1.0;
      if (mirrored.line != 0 &&
          std::abs(mirrored.value - parity * std::conj(coefficient.value)) > 1e-6 * largest) {
        refuse_line(path, mirrored.line,
                    "makes the radius complex: it is not (-1)^m times the conjugate of line " +
                        std::to_string(coefficient.line) + ".");
      }
      const double factor = m > 0 ? std::sqrt(2.0) : 1.0;
      real[harmonic_index(n, m)] = factor * coefficient.value.real();
      if (m > 0) real[harmonic_index(n, -m)] = -factor * coefficient.value.imag();
    }
  }
  return make_surface(path, std::move(real));
}

HarmonicSurface read_shtools(const std::string& path, int degree) {
  const std::vector<ComplexCoefficient> rows = read_lines(path, true);
  const int used = used_degree(rows, degree);
  std::vector<double> real(harmonic_count(used));
  for (int l = 0; l <= used; ++l) {
    for (int m = -l; m <= l; ++m) {
      const ComplexCoefficient& row = rows[harmonic_index(l, m)];
      if (m < 0 && row.line != 0) {
        refuse_line(path, row.line,
                    "has a negative order, but SHTOOLS does not write these. Name the file .dat if "
                    "it is from the NIST particle shape sets.");
      }
      if (m < 0) continue;
      if (row.line == 0) {
        refuse_file(path, "the row l = " + std::to_string(l) + ", m = " + std::to_string(m) +
                              " is missing.");
      }
      if (m == 0 && row.value.imag() != 0.0) {
        refuse_line(path, row.line, "has a sine of order 0, which does not exist.");
      }
      real[harmonic_index(l, m)] = shtools_factor(m) * row.value.real();
      if (m > 0) real[harmonic_index(l, -m)] = shtools_factor(m) * row.value.imag();
    }
  }
  return make_surface(path, std::move(real));
}

void write_shtools(const std::string& path, const HarmonicSurface& surface) {
  std::string text;
  for (int l = 0; l <= surface.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      const std::vector<double>& all = surface.coefficients();
      const double cosine = all[harmonic_index(l, m)] / shtools_factor(m);
      const double sine = m == 0 ? 0.0 : all[harmonic_index(l, -m)] / shtools_factor(m);
      text += std::to_string(l) + ", " + std::to_string(m) + ", " + format_exact(cosine) + ", " +
              format_exact(sine) + "\n";
    }
  }
  write_file(path, text);
}

HarmonicShape read_harmonics(const std::string& path) {
  return read_json(path, [&](const nlohmann::json& json) -> HarmonicShape {
    const nlohmann::json& degree = json.at("degree");
    const nlohmann::json& all = json.at("coefficients");
    if (!is_map(path, json)) return make_surface(path, coefficients_of(path, degree, all));
    std::array<std::vector<double>, 3> coefficients;
    for (std::size_t k = 0; k < 3; ++k) {
      coefficients[k] = coefficients_of(path, degree, all.at(coordinate_names[k]));
    }
    HarmonicMap map(std::move(coefficients));
    constexpr int frequency = 64;
    const Execution one(1);
    if (!(volume_of(mesh_of_surface(map, frequency, one), one) > 0.0)) {
      refuse_file(path, "the surface of its series encloses no volume, or is turned inside out.");
    }
    return map;
  });
}

HarmonicShape read_coefficients(const std::string& path, int degree) {
  const std::string ending = ending_of(path);
  if (ending == ".dat") return read_complex_harmonics(path, degree);
  if (ending == ".sh") return read_shtools(path, degree);
  return read_harmonics(path);
}

void write_harmonics(const std::string& path, const HarmonicSurface& surface) {
  write_json(path, radial_kind, surface.degree(), surface.coefficients());
}

void write_harmonic_map(const std::string& path, const HarmonicMap& map) {
  nlohmann::ordered_json coefficients;
  for (std::size_t k = 0; k < 3; ++k) coefficients[coordinate_names[k]] = map.coefficients()[k];
  write_json(path, map_kind, map.degree(), coefficients);
}

}  // namespace wscvt
