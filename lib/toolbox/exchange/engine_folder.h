// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/exchange/simulation_options.h"

namespace wscvt {

/// What an engine takes for a grain.
enum class EngineShapes { Clumps, Parts, LevelSets };

/// Returns the names of the engines that take these shapes, with commas between.
std::string engine_names(EngineShapes shapes);

/// Returns the ending of the files of grains in the folder of an engine, without the point: "csv"
/// for clumps, "obj" or "shp" for parts, "obj" for the meshes of level sets, which have tables of
/// nodes (csv) and grids of distances (npy) too. The files are in the principal frame. Throws
/// Error(InvalidInput), with the engines' names, unless the engine takes these shapes.
std::string engine_format(const std::string& engine, EngineShapes shapes);

/// Throws Error(InvalidInput) if the folder has a run.py that is not as write_engine_folder writes
/// it for any engine, because a person changed it or it is of another program.
void require_own_script(const std::string& folder);

/// Density of quartz, kg/m^3, in scene.json unless another is given.
inline constexpr double engine_density = 2650.0;

/// A grain of a folder.
struct EngineGrain {
  std::string name;  ///< as in grains.csv
  std::string file;  ///< of its shape, in the folder
};

/// Writes what an engine needs to pack the grains of a folder: run.py, which starts the engine,
/// packing.py, which it uses, shapes.json, the list of the grains, and scene.json, with what a
/// person changes: number of grains, container, materials. The folder has the grains' files and
/// their table grains.csv already. A scene.json that is there stays, so that changes are not lost.
/// `frame` has the size of the files. Returns the command that starts the engine in the folder.
/// Throws Error: InvalidInput as engine_format; InputOutput.
std::string write_engine_folder(const std::string& folder, const std::string& engine,
                                EngineShapes shapes, const std::vector<EngineGrain>& grains,
                                const FrameOptions& frame, double density = engine_density);

}  // namespace wscvt
