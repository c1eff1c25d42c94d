// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/grain_sample.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "toolbox/sample/distribution.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/voxel_resolution.h"

namespace wscvt {

namespace {

const char* column_of(SizeMeasure size) {
  switch (size) {
    case SizeMeasure::Sieve:
      return "axis_i_box";
    case SizeMeasure::EquivalentDiameter:
      return "equivalent_diameter";
    case SizeMeasure::LargestFeret:
      return "feret_max";
    case SizeMeasure::SmallestFeret:
      break;
  }
  return "feret_min";
}

/// Position and orientation of a grain are not its shape.
bool is_pose(const std::string& name) {
  return name.rfind("centroid_", 0) == 0 || name.rfind("principal_axes_", 0) == 0;
}

/// Returns the columns of a mesh, as indices into the table.
std::vector<std::size_t> places_of(const GrainTable& table, const std::string& mesh) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const std::string& name = table.columns[k].name;
    if (name.rfind(mesh, 0) == 0 && !is_pose(name.substr(mesh.size()))) places.push_back(k);
  }
  return places;
}

std::vector<std::size_t> choose_columns(const GrainTable& table, const SampleOptions& options,
                                        GrainSample& sample) {
  const std::string wanted = key_of(options.of) + ".";
  const std::string other = options.of == SampledMesh::Scan ? "remesh." : "scan.";
  std::string mesh = wanted;
  std::vector<std::size_t> places = places_of(table, mesh);
  if (places.empty()) {
    mesh = other;
    places = places_of(table, mesh);
    if (!places.empty()) {
      sample.notes.push_back("The table has no columns \"" + wanted + "\", so these are the \"" +
                             other + "\" columns.");
    }
  }
  if (places.empty()) {
    mesh.clear();
    places = places_of(table, mesh);
  }
  for (const std::size_t place : places) {
    sample.columns.push_back(
        {table.columns[place].name.substr(mesh.size()), table.columns[place].unit});
  }
  return places;
}

/// The column that gives a size: its own, or for the equivalent diameter the volume.
std::optional<std::size_t> place_of_size(const GrainSample& sample, SizeMeasure size) {
  const auto own = find_column(sample.columns, column_of(size));
  return own || size != SizeMeasure::EquivalentDiameter ? own
                                                        : find_column(sample.columns, "volume");
}

/// Returns the size measures that the columns have, for a sentence.
std::string sizes_in(const GrainSample& sample) {
  std::string keys;
  for (const auto& row : EnumerationTable<SizeMeasure>::rows) {
    if (!place_of_size(sample, row.value)) continue;
    keys += (keys.empty() ? "" : " or ") + std::string(row.key);
  }
  return keys;
}

[[noreturn]] void refuse_without_size(const GrainTable& table, const GrainSample& sample,
                                      const std::string& column) {
  if (const std::string sizes = sizes_in(sample); !sizes.empty()) {
    refuse("The table has no column \"" + column + "\" for the size of the grains. Use " +
           mention("diameter", sizes) + ", which the table has.");
  }
  for (const std::string& text : table.text_columns) {
    if (text == column || text == "scan." + column) {
      refuse("The column \"" + text +
             "\" has a text in its first row. Write numbers only, and the "
             "unit in the heading, such as \"" +
             text + " [mm]\".");
    }
  }
  constexpr std::size_t most = 20;  // of the columns of a long table
  refuse("The table has no column \"" + column +
         "\" for the size of the grains, and no other size. Name the column of diameters "
         "\"equivalent_diameter\", or that of volumes \"volume\", and give " +
         mention("diameter", "equivalent-diameter") +
         ". Its numeric columns: " + table.column_names(most) + ".");
}

/// Returns the mass of a grain from its row and volume.
using MassOf = std::function<double(Eigen::Index row, double volume)>;

/// Chooses the source of the masses.
MassOf masses_of(const GrainTable& table, const SampleOptions& options, GrainSample& sample) {
  const auto column = [&](std::size_t place) {
    return [&table, place](Eigen::Index row) { return table.values(row, place); };
  };
  const auto mass = table.find("mass");
  const auto density = table.find("density");
  if (!options.density && (mass || density)) {
    sample.density = std::numeric_limits<double>::quiet_NaN();
    sample.mass_column = table.columns[mass ? *mass : *density];
    if (mass) {
      sample.notes.push_back("Masses are from the column \"mass\".");
      return [read = column(*mass)](Eigen::Index row, double) { return read(row); };
    }
    sample.notes.push_back("Densities are from the column \"density\".");
    return
        [read = column(*density)](Eigen::Index row, double volume) { return read(row) * volume; };
  }
  sample.density = options.density.value_or(1.0);
  return [all = sample.density](Eigen::Index, double volume) { return all * volume; };
}

/// Fills the sample's resolution from the rows `kept` of a table that has it. Notes the descriptors
/// that the voxels of grains do not resolve: their statistics are those of the voxels.
void add_resolution(const GrainTable& table, const std::vector<Eigen::Index>& kept,
                    GrainSample& sample) {
  const auto across = table.find("resolution.voxels_across");
  if (!across) return;
  const auto rows = static_cast<Eigen::Index>(kept.size());
  const auto read = [&](std::size_t column, Eigen::Index row) {
    return table.values(kept[row], column);
  };
  sample.voxels_across.resize(rows);
  for (Eigen::Index row = 0; row < rows; ++row) sample.voxels_across[row] = read(*across, row);
  sample.corrected.setConstant(rows, sample.values.cols(),
                               std::numeric_limits<double>::quiet_NaN());
  std::string unresolved;
  for (std::size_t k = 0; k < sample.columns.size(); ++k) {
    const auto column = table.find("resolution." + sample.columns[k].name + ".corrected");
    if (!column) continue;
    Eigen::Index given = 0;
    Eigen::Index missing = 0;
    for (Eigen::Index row = 0; row < rows; ++row) {
      const auto place = static_cast<Eigen::Index>(k);
      sample.corrected(row, place) = read(*column, row);
      if (!std::isfinite(sample.voxels_across[row]) || !std::isfinite(sample.values(row, place))) {
        continue;
      }
      ++given;
      if (!std::isfinite(sample.corrected(row, place))) ++missing;
    }
    if (missing == 0) continue;
    unresolved +=
        (unresolved.empty() ? "" : ", ") + sample.columns[k].name + " of " +
        (missing == given ? "all" : std::to_string(missing) + " of " + std::to_string(given)) +
        " grains";
  }
  if (unresolved.empty()) return;
  sample.notes.push_back("Not resolved by the voxels: " + unresolved +
                         ". Their numbers here are those of the voxels.");
}

/// Notes the classes of size, fifths of the grains, of which half the grains have too few voxels.
void note_few_voxels(GrainSample& sample) {
  std::vector<std::pair<double, double>> known;  // size, voxels across
  for (Eigen::Index k = 0; k < sample.voxels_across.size(); ++k) {
    if (std::isfinite(sample.voxels_across[k])) {
      known.emplace_back(sample.sizes[k], sample.voxels_across[k]);
    }
  }
  std::sort(known.begin(), known.end());
  constexpr std::size_t most_classes = 5;
  const std::size_t classes = std::min(most_classes, known.size());
  for (std::size_t k = 0; k < classes; ++k) {
    const std::size_t begin = k * known.size() / classes;
    const std::size_t end = (k + 1) * known.size() / classes;
    std::vector<double> across;
    for (std::size_t at = begin; at < end; ++at) across.push_back(known[at].second);
    std::sort(across.begin(), across.end());
    const double median = quantile(across, 0.5);
    if (!(median < least_trusted_across)) continue;
    const std::string unit = sample.size_unit.empty() ? "" : " " + sample.size_unit;
    sample.notes.push_back(
        format_count(end - begin, "grain") + " of size " + format_number(known[begin].first, 3) +
        " to " + format_number(known[end - 1].first, 3) + unit + " have " +
        format_number(median, 3) + " voxels across (median). Below " +
        format_number(least_trusted_across, 3) +
        " a trend with size may be a trend of the voxels. Leave out these grains, or scan them "
        "with smaller voxels.");
  }
}

/// Notes the columns that are left out although they have numbers.
void note_mixed_columns(const GrainTable& table, GrainSample& sample) {
  if (table.mixed_columns.empty()) return;
  std::vector<std::string> names;
  for (const std::string& name : table.mixed_columns) names.push_back(readable(name, ""));
  constexpr std::size_t most = 5;
  sample.notes.push_back(
      "Columns left out, because their first entry is no number: " + listed(names, most) +
      ". Write numbers with decimal points, and leave other fields empty.");
}

}  // namespace

int SampleOptions::repetitions_for(std::size_t grains, std::size_t most_at_full) const {
  constexpr int least = 200;
  if (grains <= most_at_full || repetitions <= least) return repetitions;
  const double share = static_cast<double>(most_at_full) / static_cast<double>(grains);
  return std::max(least, static_cast<int>(repetitions * share));
}

GrainSample sample_of(const GrainTable& table, const SampleOptions& options) {
  if (options.density) require_in_range(*options.density, density_option);
  require_in_range(options.repetitions, repetitions_option);
  GrainSample sample;
  sample.failed = table.failed;
  const std::vector<std::size_t> places = choose_columns(table, options, sample);
  const std::string size_column = column_of(options.size);
  const auto size_place = place_of_size(sample, options.size);
  if (!size_place) refuse_without_size(table, sample, size_column);
  note_mixed_columns(table, sample);
  sample.size_name = label_of(options.size);
  sample.size_unit = sample.columns[*size_place].unit;
  const bool is_from_volume = sample.columns[*size_place].name != size_column;
  if (is_from_volume) {
    const std::size_t power = sample.size_unit.rfind("^3");
    if (power != std::string::npos) sample.size_unit.erase(power);
    sample.notes.push_back("Sizes are from the column \"volume\".");
  }
  const auto value = [&](Eigen::Index grain, std::size_t column) {
    return table.values(grain, places[column]);
  };
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < table.values.rows(); ++k) {
    if (value(k, *size_place) > 0.0) kept.push_back(k);
  }
  const std::size_t without = table.grains.size() - kept.size();
  if (without > 0) {
    sample.notes.push_back(format_count(without, "grain") + " without a size left out.");
  }
  const auto volume = find_column(sample.columns, "volume");
  if (!volume && (options.density || !table.find("mass"))) {
    sample.notes.push_back(
        "The table has no column \"volume\", so masses are computed for spheres of the grains' "
        "size.");
  }
  const MassOf mass_of = masses_of(table, options, sample);
  const auto size_of = [&](Eigen::Index k) {
    const double read = value(k, *size_place);
    return is_from_volume ? cbrt(6.0 / pi * read) : read;
  };
  const auto mass_in = [&](Eigen::Index k) {
    const double size = size_of(k);
    return mass_of(k, volume ? value(k, *volume) : pi / 6.0 * size * size * size);
  };
  // An empty cell: without its mass the grain would count by number only.
  const auto weighed = std::stable_partition(kept.begin(), kept.end(), [&](Eigen::Index k) {
    const double mass = mass_in(k);
    return std::isfinite(mass) && mass > 0.0;
  });
  if (weighed != kept.end()) {
    sample.notes.push_back(format_count(static_cast<std::size_t>(kept.end() - weighed), "grain") +
                           " without a mass (volume, density) left out.");
    kept.erase(weighed, kept.end());
  }
  if (kept.size() < 2) {
    refuse("The table has " + format_count(kept.size(), "grain") + " with a size and a mass" +
           ". Statistics need two or more.");
  }
  const auto rows = static_cast<Eigen::Index>(kept.size());
  sample.values.resize(rows, places.size());
  sample.sizes.resize(rows);
  sample.masses.resize(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Eigen::Index k = kept[row];
    sample.grains.push_back(table.grains[k]);
    if (!table.files.empty()) sample.files.push_back(table.files[k]);
    for (std::size_t column = 0; column < places.size(); ++column) {
      sample.values(row, column) = value(k, column);
    }
    sample.sizes[row] = size_of(k);
    sample.masses[row] = mass_in(k);
  }
  // The columns are the scans' own.
  if (table.find("scan." + sample.columns[*size_place].name) == places[*size_place]) {
    add_resolution(table, kept, sample);
    note_few_voxels(sample);
  }
  return sample;
}

}  // namespace wscvt
