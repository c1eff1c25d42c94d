// SPDX-License-Identifier: GPL-3.0-or-later

// Lets clumps fall in MercuryDPM, until they are at rest. run.py writes packing.scene. Prints
// "energy time kinetic" lines, "grain x y z" of each grain, and "sphere k x y z r" of grain k.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>

#include "Mercury3DClump.h"

struct Packing : Mercury3Dclump {
  std::ifstream scene{"packing.scene"};
  int sides = 0;
  double half = 0.0, seconds = 0.0, fall = 0.0, rest = 0.0, gravity = 0.0;
  double density = 0.0, young = 0.0, poisson = 0.0, friction = 0.0, restitution = 0.0;
  int steps_between = 0;

  void setupInitialConditions() override {
    scene >> sides >> half >> seconds >> fall >> rest >> gravity;
    if (!(scene >> density >> young >> poisson >> friction >> restitution)) {
      logger(ERROR, "packing.scene cannot be read");
    }
    auto* species = speciesHandler.copyAndAddObject(LinearViscoelasticFrictionSpecies());
    species->setDensity(density);
    int spheres = 0;
    double least = 0.0, top = 0.0;
    for (double m, i, j, k, x, y, z, w, a, b, c;
         scene >> m >> i >> j >> k >> x >> y >> z >> w >> a >> b >> c >> spheres;) {
      ClumpParticle grain;
      grain.setSpecies(species);
      grain.setClump();
      grain.setPosition(Vec3D(x, y, z));
      for (double u, v, t, r; spheres > 0 && scene >> u >> v >> t >> r; --spheres) {
        if (grain.NPebble() == 0) grain.setRadius(r);
        grain.addPebble(Vec3D(u, v, t), r);
      }
      grain.setInitInertia({i, 0, 0, j, 0, k});
      grain.setPrincipalDirections({1 - 2 * (b * b + c * c), 2 * (a * b - w * c), 2 * (a * c + w * b),
                                    2 * (a * b + w * c), 1 - 2 * (a * a + c * c), 2 * (b * c - w * a),
                                    2 * (a * c - w * b), 2 * (b * c + w * a), 1 - 2 * (a * a + b * b)});
      grain.setClumpMass(m);
      particleHandler.copyAndAddObject(grain);
      if (least == 0.0 || m < least) least = m;
      top = std::fmax(top, z);
    }
    const double size = std::cbrt(least / density);
    const double stiffness = young * size;
    species->setStiffnessAndRestitutionCoefficient(stiffness, restitution, least);
    species->setSlidingFrictionCoefficient(friction);
    species->setSlidingStiffness(2.0 / 7.0 * species->getStiffness());
    species->setSlidingDissipation(2.0 / 7.0 * species->getDissipation());
    setTimeStep(0.05 * std::sqrt(least / stiffness));
    setTimeMax(seconds);
    steps_between = std::max(1, static_cast<int>(2.0 * std::sqrt(size / gravity) / getTimeStep()));
    setSaveCount(steps_between);
    setGravity(Vec3D(0, 0, -gravity));
    setDomain(Vec3D(-half, -half, 0), Vec3D(half, half, 2.0 * top));
    InfiniteWall wall(species);
    for (int k = -1; k < sides; ++k) {
      const double angle = 2.0 * 3.14159265358979323846 * k / sides;
      const Vec3D out = k < 0 ? Vec3D(0, 0, -1) : Vec3D(std::cos(angle), std::sin(angle), 0);
      wall.set(out, k < 0 ? Vec3D(0, 0, 0) : half * out);
      wallHandler.copyAndAddObject(wall);
    }
  }

  double kinetic_energy() const {
    double sum = 0.0;
    for (const BaseParticle* grain : particleHandler) {
      if (grain->isClump()) sum += grain->getKineticEnergy() + grain->getRotationalEnergy();
    }
    return sum;
  }

  void actionsAfterTimeStep() override {
    if (getNumberOfTimeSteps() % steps_between != 0) return;
    const double energy = kinetic_energy();
    std::printf("energy %.9g %.9g\n", getTime(), energy);
    if (getTime() > fall && energy < rest) setTimeMax(getTime());
  }
};

int main() {
  Packing packing;
  packing.setName("mercurydpm_settle");
  packing.setFileType(FileType::NO_FILE);
  packing.solve();
  std::map<unsigned, int> numbers;
  for (const BaseParticle* grain : packing.particleHandler) {
    if (!grain->isClump()) continue;
    const int number = static_cast<int>(numbers.size());
    numbers[grain->getId()] = number;
    const Vec3D at = grain->getPosition();
    std::printf("grain %.9g %.9g %.9g\n", at.X, at.Y, at.Z);
  }
  for (const BaseParticle* sphere : packing.particleHandler) {
    if (!sphere->isPebble()) continue;
    const Vec3D at = sphere->getPosition();
    std::printf("sphere %d %.9g %.9g %.9g %.9g\n", numbers.at(sphere->getClump()->getId()), at.X, at.Y, at.Z,
                sphere->getRadius());
  }
}
