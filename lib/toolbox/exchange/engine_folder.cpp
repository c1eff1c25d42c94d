// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/engine_folder.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/output_file.h"
#include "wscvt/report/json.h"

namespace wscvt {

// The files of the folder engines/.
extern const char* const packing_script;
extern const char* const run_yade_script;
extern const char* const yade_level_sets_script;
extern const char* const run_lammps_script;
extern const char* const run_liggghts_script;
extern const char* const run_mercurydpm_script;
extern const char* const mercurydpm_settle_script;
extern const char* const run_chrono_script;
extern const char* const chrono_settle_script;
extern const char* const run_dem_engine_script;
extern const char* const run_mujoco_script;
extern const char* const mujoco_settle_script;
extern const char* const run_bullet_script;
extern const char* const bullet_settle_script;
extern const char* const run_rockable_script;

namespace {

/// Shapes that an engine takes. An engine that takes several has a row for each.
struct EngineRow {
  std::string_view name;
  EngineShapes shapes;
  const char* format;  ///< ending of their files
  const char* command;
  const char* script;     ///< run.py
  const char* more_name;  ///< of a file that run.py compiles or imports; or null
  const char* more;
};

constexpr const char* python = "python3 run.py";
constexpr const char* in_yade = "yade -n -x run.py";

const std::vector<EngineRow>& engines() {
  constexpr EngineShapes clumps = EngineShapes::Clumps;
  constexpr EngineShapes parts = EngineShapes::Parts;
  static const std::vector<EngineRow> rows = {
      {"yade", clumps, "csv", in_yade, run_yade_script, nullptr, nullptr},
      {"yade", parts, "obj", in_yade, run_yade_script, nullptr, nullptr},
      {"yade", EngineShapes::LevelSets, "obj", in_yade, run_yade_script, "yade_level_sets.py",
       yade_level_sets_script},
      {"lammps", clumps, "csv", python, run_lammps_script, nullptr, nullptr},
      {"liggghts", clumps, "csv", python, run_liggghts_script, nullptr, nullptr},
      {"mercurydpm", clumps, "csv", python, run_mercurydpm_script, "mercurydpm_settle.cpp",
       mercurydpm_settle_script},
      {"chrono", clumps, "csv", python, run_chrono_script, "chrono_settle.cpp",
       chrono_settle_script},
      {"dem-engine", clumps, "csv", python, run_dem_engine_script, nullptr, nullptr},
      {"mujoco", parts, "obj", python, run_mujoco_script, "mujoco_settle.cpp",
       mujoco_settle_script},
      {"bullet", parts, "obj", python, run_bullet_script, "bullet_settle.cpp",
       bullet_settle_script},
      {"rockable", parts, "shp", python, run_rockable_script, nullptr, nullptr},
  };
  return rows;
}

/// The name of shapes, and the command that makes them.
std::pair<std::string, std::string> name_and_command(EngineShapes shapes) {
  switch (shapes) {
    case EngineShapes::Clumps:
      return {"clumps", "wscvt clump"};
    case EngineShapes::Parts:
      return {"convex parts", "wscvt convex"};
    case EngineShapes::LevelSets:
      break;
  }
  return {"level sets", "wscvt batch"};
}

std::string scene_text(const FrameOptions& frame, double density) {
  const Json scene = {{"grains", 200},
                      {"seed", 1},
                      {"container", {{"shape", "box"}, {"width", 0.0}}},
                      {"gravity", 9.81},
                      {"material",
                       {{"density", density},
                        {"young_modulus", 0.0},
                        {"poisson_ratio", 0.3},
                        {"friction", 0.5},
                        {"restitution", 0.2}}},
                      {"size", frame.size},
                      {"scale", frame.scale}};
  return json_document(scene);
}

std::string shapes_text(const std::vector<EngineGrain>& grains) {
  Json list = Json::array();
  for (const EngineGrain& grain : grains) {
    list.push_back({{"grain", grain.name}, {"file", grain.file}});
  }
  return json_document(list);
}

/// Throws as engine_format.
const EngineRow& engine_row(const std::string& engine, EngineShapes shapes) {
  std::string other;
  for (const EngineRow& row : engines()) {
    if (row.name != engine) continue;
    if (row.shapes == shapes) return row;
    other = name_and_command(row.shapes).second;
  }
  if (!other.empty()) {
    refuse("\"" + engine + "\" takes no " + name_and_command(shapes).first + ". Use " + other +
           " with this engine, or one of " + engine_names(shapes) + ".");
  }
  refuse("There are no files for an engine \"" + engine + "\". Give one of " +
         engine_names(shapes) + ".");
}

}  // namespace

std::string engine_names(EngineShapes shapes) {
  std::string names;
  for (const EngineRow& engine : engines()) {
    if (engine.shapes != shapes) continue;
    names += (names.empty() ? "" : ", ") + std::string(engine.name);
  }
  return names;
}

std::string engine_format(const std::string& engine, EngineShapes shapes) {
  return engine_row(engine, shapes).format;
}

void require_own_script(const std::string& folder) {
  const std::string script = file_content((std::filesystem::path(folder) / "run.py").string());
  const bool is_own = std::any_of(engines().begin(), engines().end(),
                                  [&](const EngineRow& row) { return script == row.script; });
  if (script.empty() || is_own) return;
  refuse("The folder \"" + folder +
         "\" has a run.py that was changed, or that is of another program. It would be replaced: "
         "rename it, or give another folder with " +
         mention("output") + ".");
}

std::string write_engine_folder(const std::string& folder, const std::string& engine,
                                EngineShapes shapes, const std::vector<EngineGrain>& grains,
                                const FrameOptions& frame, double density) {
  const EngineRow& row = engine_row(engine, shapes);
  const std::filesystem::path in(folder);
  write_file((in / "packing.py").string(), packing_script);
  write_file((in / "run.py").string(), row.script);
  if (row.more != nullptr) write_file((in / row.more_name).string(), row.more);
  write_file((in / "shapes.json").string(), shapes_text(grains));
  const std::filesystem::path scene = in / "scene.json";
  std::error_code ignored;
  if (!std::filesystem::exists(scene, ignored)) {
    write_file(scene.string(), scene_text(frame, density));
  }
  return row.command;
}

}  // namespace wscvt
