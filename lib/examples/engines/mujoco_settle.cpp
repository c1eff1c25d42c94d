// SPDX-License-Identifier: GPL-3.0-or-later
// Lets the free bodies of a MuJoCo scene fall, and prints the place (x, y, z) and the turn
// (w, x, y, z) of each, in the order of the file, and last the largest speed along an axis. For
// mujoco_packing.py, where MuJoCo's Python is not.
//   mujoco_settle SCENE.xml SECONDS
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  char error[1000] = "usage: mujoco_settle SCENE.xml SECONDS";
  mjModel* model = argc == 3 ? mj_loadXML(argv[1], nullptr, error, sizeof error) : nullptr;
  if (model == nullptr) {
    std::fprintf(stderr, "%s\n", error);
    return 1;
  }
  mjData* data = mj_makeData(model);
  while (data->time < std::atof(argv[2])) mj_step(model, data);
  mj_forward(model, data);
  double speed = 0.0;
  for (int k = 0; k < model->nv; ++k) {
    if (k % 6 < 3) speed = std::fmax(speed, std::fabs(data->qvel[k]));
  }
  for (int k = 0; k < model->nq; ++k) std::printf("%.9g%c", data->qpos[k], k % 7 == 6 ? '\n' : ' ');
  std::printf("%.9g\n", speed);
  return 0;
}
