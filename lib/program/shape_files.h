// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/sample/sample_grain.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt::program {

/// The files of a sample's grains, by name: those that grain_files gives, and of a folder without
/// meshes the files of SH coefficients, .dat and .sh, or else .json. Throws wscvt::Error.
std::vector<std::string> shape_files(const std::vector<std::string>& inputs);

/// Whether the file holds SH coefficients, by its ending.
bool is_coefficient_file(const std::string& path);

/// Reads such a file: a HarmonicSurface, or of a harmonic map a HarmonicMap. Throws wscvt::Error.
std::unique_ptr<const SphereSurface> read_coefficients(const std::string& path);

/// Calls `read` for the number of each file, on several threads at once and with a line on a
/// terminal unless quiet. A file that it refuses is told on the standard error and counted in the
/// result. Throws wscvt::Error, also Cancelled, for what is not about one file.
std::size_t read_each(const std::vector<std::string>& files, int threads, bool quiet,
                      const std::function<void(std::size_t file, const Execution&)>& read);

/// The grains of a sample that could be read.
struct SampleShapes {
  std::vector<SampleGrain> grains;
  std::vector<std::string> files;  ///< one per grain
  std::size_t left_out = 0;        ///< grains that failed; the standard error says why
};

/// Reads them, on the threads and with a line on a terminal unless quiet. Throws wscvt::Error, also
/// Cancelled, for what is not about one grain.
SampleShapes read_shapes(const std::vector<std::string>& files, const SampleGrids& grids,
                         int threads, bool quiet);

}  // namespace wscvt::program
