// SPDX-License-Identifier: GPL-3.0-or-later
// Lets clumps fall into a box in Project Chrono's core, by smooth contacts. chrono_smc_clumps.py
// writes the scene: width, seconds, density; per grain its .chrono.csv, its place and its turn
// (w, x, y, z). Prints place and turn of each grain, and last the largest speed.
#include <chrono/collision/ChCollisionShapeBox.h>
#include <chrono/collision/ChCollisionShapeSphere.h>
#include <chrono/physics/ChBody.h>
#include <chrono/physics/ChSystemSMC.h>

#include <cstdio>
#include <fstream>
#include <string>

using namespace chrono;

/// A grain from the rows x,y,z,r of a file, and from the volume and the moments in its comments.
std::shared_ptr<ChBody> grain_of(const std::string& path, double density,
                                 const std::shared_ptr<ChContactMaterial>& stone) {
  auto grain = chrono_types::make_shared<ChBody>();
  std::ifstream file(path);
  double x = 0.0, y = 0.0, z = 0.0, r = 0.0;
  for (std::string line; std::getline(file, line);) {
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &x, &y, &z, &r) == 4) {
      grain->AddCollisionShape(chrono_types::make_shared<ChCollisionShapeSphere>(stone, r),
                               ChFrame<>(ChVector3d(x, y, z)));
    } else if (std::sscanf(line.c_str(), "# volume = %lf", &x) == 1) {
      grain->SetMass(density * x);
    } else if (std::sscanf(line.c_str(), "# Ixx, yy, zz = %lf, %lf, %lf", &x, &y, &z) == 3) {
      grain->SetInertiaXX(density * ChVector3d(x, y, z));
    }
  }
  grain->EnableCollision(true);
  return grain;
}

int main() {
  ChSystemSMC system;
  system.SetCollisionSystemType(ChCollisionSystem::Type::BULLET);
  system.SetGravitationalAcceleration(ChVector3d(0, 0, -9.81));
  system.SetTangentialDisplacementModel(ChSystemSMC::TangentialDisplacementModel::MultiStep);
  // Bullet's margins are made for metres.
  ChCollisionModel::SetDefaultSuggestedEnvelope(1e-4);
  ChCollisionModel::SetDefaultSuggestedMargin(1e-5);
  auto stone = chrono_types::make_shared<ChContactMaterialSMC>();
  stone->SetYoungModulus(1e7);
  stone->SetPoissonRatio(0.3f);
  stone->SetRestitution(0.2f);
  stone->SetFriction(0.5f);

  std::ifstream scene("chrono_scene.txt");
  double d = 0.0, seconds = 0.0, density = 0.0, w = 0.0, x = 0.0, y = 0.0, z = 0.0;
  scene >> d >> seconds >> density;
  auto box = chrono_types::make_shared<ChBody>();
  box->SetFixed(true);
  const ChVector3d sides[] = {{0, 0, -10 * d}, {-d, 0, 0}, {d, 0, 0}, {0, -d, 0}, {0, d, 0}};
  for (const ChVector3d& side : sides) {
    auto wall = chrono_types::make_shared<ChCollisionShapeBox>(stone, d, d, 20 * d);
    box->AddCollisionShape(wall, ChFrame<>(side));
  }
  box->EnableCollision(true);
  system.AddBody(box);
  std::string path;
  for (ChVector3d at; scene >> path >> at.x() >> at.y() >> at.z() >> w >> x >> y >> z;) {
    auto grain = grain_of(path, density, stone);
    grain->SetPos(at);
    grain->SetRot(ChQuaterniond(w, x, y, z));
    system.AddBody(grain);
  }
  while (system.GetChTime() < seconds) system.DoStepDynamics(1e-5);
  double speed = 0.0;
  for (const auto& grain : system.GetBodies()) {
    if (grain->IsFixed()) continue;
    const auto p = grain->GetPos();
    const auto q = grain->GetRot();
    std::printf("%.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", p.x(), p.y(), p.z(), q.e0(), q.e1(), q.e2(),
                q.e3());
    speed = std::fmax(speed, grain->GetPosDt().Length());
  }
  std::printf("%.9g\n", speed);
}
