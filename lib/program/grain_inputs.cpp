// SPDX-License-Identifier: GPL-3.0-or-later
#include "grain_inputs.h"

#include <utility>

#include "progress_line.h"
#include "signals.h"
#include "toolbox/job/label_source.h"
#include "toolbox/volume/open_volume.h"
#include "volume_arguments.h"
#include "work.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::program {

namespace {

/// Returns the bodies of a mesh file as grains, or the file itself.
std::unique_ptr<MeshGrains> bodies_of(const std::string& path, bool quiet) {
  note_signals();
  ProgressLine line(!quiet);
  const Execution execution(1, [&](double fraction, const std::string& stage) {
    line.show(fraction, stage);
    return noted_signal() == 0;
  });
  return std::make_unique<MeshGrains>(path, execution);
}

void print_bodies(const std::string& path, const MeshBodies& bodies, bool quiet) {
  if (bodies.list.empty()) return;
  print({path + ": " + std::to_string(bodies.list.size()) + " bodies"}, quiet);
  print(bodies.warnings, quiet);
  for (std::size_t k = 0; k < bodies.list.size(); ++k) {
    const std::string& name = bodies.list[k].name;
    if (!name.empty()) print({"  " + std::to_string(k + 1) + ": " + name}, quiet);
  }
}

}  // namespace

std::vector<std::string> input_files(const std::vector<std::string>& inputs) {
  std::vector<std::string> files = grain_files(inputs, is_volume);
  for (const std::string& file : files) {
    if (!is_volume(file)) check_mesh_format(file, MeshUse::Read);
  }
  return files;
}

std::unique_ptr<GrainSource> open_inputs(const std::vector<std::string>& files,
                                         const VolumeOptions& options, const Shard& shard,
                                         bool quiet) {
  auto inputs = std::make_unique<JoinedGrains>(shard);
  for (const std::string& path : files) {
    if (is_volume(path)) {
      std::unique_ptr<LabelGrains> grains = open_grains(path, options, quiet);
      print_notes(*grains, "wscvt batch " + path + " -o OUT", quiet);
      inputs->add(std::make_unique<LabelSource>(path, std::move(grains)));
    } else if (options.parts) {
      std::unique_ptr<MeshGrains> bodies = bodies_of(path, quiet);
      print_bodies(path, bodies->bodies(), quiet);
      inputs->add(std::move(bodies));
    } else {
      inputs->add(std::make_unique<MeshGrains>(path));
    }
  }
  return inputs;
}

}  // namespace wscvt::program
