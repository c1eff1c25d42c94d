// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "toolbox/sample/grain_table.h"
#include "wscvt/base/option.h"

namespace wscvt {

/// The length used as a grain's size.
enum class SizeMeasure { Sieve, EquivalentDiameter, LargestFeret, SmallestFeret };

template <>
struct EnumerationTable<SizeMeasure> {
  static constexpr std::string_view key = "diameter";
  static constexpr std::string_view subject = "size of a grain";
  static constexpr Enumerator<SizeMeasure> rows[] = {
      {SizeMeasure::Sieve, "sieve", "sieve size: second largest edge of the smallest box",
       "second largest edge of the smallest oriented box; it sets the sieve opening that the grain "
       "passes"},
      {SizeMeasure::EquivalentDiameter, "equivalent-diameter",
       "diameter of the sphere of equal volume", "diameter of the sphere of equal volume"},
      {SizeMeasure::LargestFeret, "feret-max", "largest Feret diameter", "largest Feret diameter"},
      {SizeMeasure::SmallestFeret, "feret-min", "smallest Feret diameter",
       "smallest Feret diameter"},
  };
};

/// The meshes of a table of shapes that are measured.
enum class SampledMesh { Scan, Remesh };

template <>
struct EnumerationTable<SampledMesh> {
  static constexpr std::string_view key = "describe";
  static constexpr std::string_view subject = "described mesh";
  static constexpr Enumerator<SampledMesh> rows[] = {
      {SampledMesh::Scan, "scan", "scan", "statistics of the scans"},
      {SampledMesh::Remesh, "remesh", "remesh", "statistics of the remeshes"},
  };
};

struct SampleOptions {
  SizeMeasure size = SizeMeasure::Sieve;
  SampledMesh of = SampledMesh::Scan;
  /// Mass / volume of all grains, > 0. If not given, the table's density or 1; see sample_of.
  std::optional<double> density;
  std::uint64_t seed = 1;  ///< of the random numbers for intervals and p
  int repetitions = 1000;  ///< 0: no intervals and no p

  /// Returns fewer repetitions for more than so many grains, but at least 200 of them.
  int repetitions_for(std::size_t grains, std::size_t most_at_full) const;
};

inline constexpr NumberOption<double> density_option = {
    "density", "density", 0.0, 1e30, Ends::NotMinimum, "mass / volume, in the units of the table"};
inline constexpr NumberOption<int> repetitions_option = {
    "repetitions",
    "number of repetitions",
    0,
    100000,
    Ends::Both,
    "for the bootstrap of the 95 % intervals and for the permutations of p; 0: no intervals and no "
    "p"};

/// A sample ready for statistics: sizes, masses and the descriptors of one mesh of each grain.
struct GrainSample {
  std::vector<std::string> grains;
  std::vector<std::string> files;  ///< of the remeshes; may be empty
  std::string size_name;           ///< for people, such as "sieve size (axis_i_box)"
  std::string size_unit;           ///< such as "length"; may be empty
  Eigen::VectorXd sizes;
  Eigen::VectorXd masses;            ///< above 0 and finite
  double density = 1.0;              ///< of all grains; NaN if the table has masses or densities
  GrainColumn mass_column;           ///< of the table, "mass" or "density"; without a name: none
  std::vector<GrainColumn> columns;  ///< names without "scan."; no positions and no directions
  Eigen::MatrixXd values;            ///< grains x columns; NaN: missing
  /// Of each scan, NaN: not known; empty if the table has no resolution.
  Eigen::VectorXd voxels_across;
  /// The values without the voxels' error, as `values`; NaN: not resolved. Empty as voxels_across.
  Eigen::MatrixXd corrected;
  std::size_t failed = 0;          ///< of the table
  std::vector<std::string> notes;  ///< for people: grains left out, masses from sizes
};

/// Chooses a sample's columns from a table: the columns "scan." or "remesh." by options.of if there
/// are such, else all. If a table has only remeshes, they are used, with a note. Grains without a
/// size are left out, with a note. A mass is the density times the volume, or times pi / 6 size^3
/// if the table has no column "volume". Without options.density, masses come from the table's
/// column "mass", or densities from its column "density". Throws Error(InvalidInput) for options
/// out of range, if the table has no column for the size, and if fewer than two grains remain. Of
/// scans with the columns of a resolution (shape_table.h), a note names the classes of size whose
/// grains have too few voxels across.
GrainSample sample_of(const GrainTable& table, const SampleOptions& options);

}  // namespace wscvt
