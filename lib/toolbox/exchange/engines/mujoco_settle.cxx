// SPDX-License-Identifier: GPL-3.0-or-later

// Lets the bodies of a MuJoCo scene fall until they are at rest or SECONDS have passed. For run.py, where
// MuJoCo's Python module is not. Prints "energy time kinetic" lines, "grain x y z qw qx qy qz" of each body
// in the order of the file, and "contact i j" of bodies from 0; -1 is a wall.
//   mujoco_settle SCENE.xml SECONDS FALL REST
#include <mujoco/mujoco.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  char error[1000] = "usage: mujoco_settle SCENE.xml SECONDS FALL REST";
  mjModel* model = argc == 5 ? mj_loadXML(argv[1], nullptr, error, sizeof error) : nullptr;
  if (model == nullptr) {
    std::fprintf(stderr, "%s\n", error);
    return 1;
  }
  mjData* data = mj_makeData(model);
  while (data->time < std::atof(argv[2])) {
    for (int k = 0; k < 100; ++k) mj_step(model, data);
    std::printf("energy %.9g %.9g\n", data->time, data->energy[1]);
    if (data->time > std::atof(argv[3]) && data->energy[1] < std::atof(argv[4])) break;
  }
  for (int k = 0; k < model->nq; ++k) {
    std::printf("%s%.9g%c", k % 7 == 0 ? "grain " : "", data->qpos[k], k % 7 == 6 ? '\n' : ' ');
  }
  for (int k = 0; k < data->ncon; ++k) {
    std::printf("contact %d %d\n", model->geom_bodyid[data->contact[k].geom1] - 1,
                model->geom_bodyid[data->contact[k].geom2] - 1);
  }
}
