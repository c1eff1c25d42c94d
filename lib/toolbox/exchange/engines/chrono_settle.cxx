// SPDX-License-Identifier: GPL-3.0-or-later

// Lets clumps fall in Project Chrono's core by smooth contacts, until they are at rest. run.py writes
// packing.scene. Prints "energy time kinetic" lines, and "grain x y z qw qx qy qz" of each grain.
#include <chrono/collision/ChCollisionShapeBox.h>
#include <chrono/collision/ChCollisionShapeSphere.h>
#include <chrono/physics/ChBody.h>
#include <chrono/physics/ChSystemSMC.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <vector>

using namespace chrono;

int main() {
  std::ifstream scene("packing.scene");
  int sides = 0;
  double half = 0.0, seconds = 0.0, fall = 0.0, rest = 0.0, gravity = 0.0;
  double density = 0.0, young = 0.0, poisson = 0.0, friction = 0.0, restitution = 0.0;
  scene >> sides >> half >> seconds >> fall >> rest >> gravity;
  if (!(scene >> density >> young >> poisson >> friction >> restitution)) return 1;
  ChSystemSMC system;
  system.SetCollisionSystemType(ChCollisionSystem::Type::BULLET);
  system.SetGravitationalAcceleration(ChVector3d(0, 0, -gravity));
  system.SetTangentialDisplacementModel(ChSystemSMC::TangentialDisplacementModel::MultiStep);
  // Bullet's margins are made for metres.
  ChCollisionModel::SetDefaultSuggestedEnvelope(0.002 * half);
  ChCollisionModel::SetDefaultSuggestedMargin(0.0002 * half);
  auto stone = chrono_types::make_shared<ChContactMaterialSMC>();
  stone->SetYoungModulus(static_cast<float>(young));
  stone->SetPoissonRatio(static_cast<float>(poisson));
  stone->SetRestitution(static_cast<float>(restitution));
  stone->SetFriction(static_cast<float>(friction));

  std::vector<std::shared_ptr<ChBody>> grains;
  int spheres = 0;
  double smallest = half, top = 0.0;
  for (double m, i, j, k, x, y, z, w, a, b, c;
       scene >> m >> i >> j >> k >> x >> y >> z >> w >> a >> b >> c >> spheres;) {
    auto grain = chrono_types::make_shared<ChBody>();
    grain->SetMass(m);
    grain->SetInertiaXX(ChVector3d(i, j, k));
    for (double u, v, t, r; spheres > 0 && scene >> u >> v >> t >> r; --spheres) {
      grain->AddCollisionShape(chrono_types::make_shared<ChCollisionShapeSphere>(stone, r),
                               ChFrame<>(ChVector3d(u, v, t)));
    }
    grain->SetPos(ChVector3d(x, y, z));
    grain->SetRot(ChQuaterniond(w, a, b, c));
    grain->EnableCollision(true);
    system.AddBody(grain);
    grains.push_back(grain);
    smallest = std::min(smallest, std::cbrt(m / density));
    top = std::max(top, z);
  }
  auto box = chrono_types::make_shared<ChBody>();
  box->SetFixed(true);
  for (int k = -1; k < sides; ++k) {  // slabs of the container's width, whose inner faces are the walls
    const double angle = 2.0 * 3.14159265358979323846 * k / sides;
    const ChVector3d at = k < 0 ? ChVector3d(0, 0, -half) : 2.0 * half * ChVector3d(std::cos(angle), std::sin(angle), 0);
    auto slab = chrono_types::make_shared<ChCollisionShapeBox>(stone, k < 0 ? 6.0 * half : 2.0 * half,
                                                               k < 0 ? 6.0 * half : 3.0 * half,
                                                               k < 0 ? 2.0 * half : 4.0 * top);
    box->AddCollisionShape(slab, ChFrame<>(at, QuatFromAngleZ(k < 0 ? 0.0 : angle)));
  }
  box->EnableCollision(true);
  system.AddBody(box);

  const double step = 0.1 * smallest * std::sqrt(density / young);
  const int between = std::max(1, static_cast<int>(2.0 * std::sqrt(smallest / gravity) / step));
  for (long n = 1; n * step < seconds; ++n) {
    system.DoStepDynamics(step);
    if (n % between != 0) continue;
    double energy = 0.0;
    for (const auto& grain : grains) {
      const ChVector3d spin = grain->GetAngVelLocal();
      energy += 0.5 * grain->GetMass() * grain->GetPosDt().Length2() + 0.5 * spin.Dot(grain->GetInertia() * spin);
    }
    std::printf("energy %.9g %.9g\n", n * step, energy);
    if (n * step > fall && energy < rest) break;
  }
  for (const auto& grain : grains) {
    const auto p = grain->GetPos();
    const auto q = grain->GetRot();
    std::printf("grain %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", p.x(), p.y(), p.z(), q.e0(), q.e1(), q.e2(), q.e3());
  }
}
