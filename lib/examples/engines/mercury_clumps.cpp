// SPDX-License-Identifier: GPL-3.0-or-later
// Lets clumps fall into a box in MercuryDPM. Prints each grain's speed and spheres: number, x, y,
// z, radius. mercury_clumps.py says how to compile it, and writes the scene: width, height,
// seconds, density; per grain the folder of its clump, its place, its matrix.
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "../ClumpHeaders/Mercury3DClump.h"

std::vector<double> numbers(const std::string& path, double factor = 1.0) {
  std::ifstream file(path);
  std::vector<double> values;
  for (double value; file >> value; file.ignore(1)) values.push_back(factor * value);
  if (values.empty()) logger(ERROR, "% has no numbers", path);
  return values;
}

struct Packing : Mercury3Dclump {
  std::ifstream scene;
  double density = 0.0;

  explicit Packing(const char* path) : scene(path) {
    double width = 0.0, height = 0.0, seconds = 0.0;
    if (!(scene >> width >> height >> seconds >> density)) logger(ERROR, "% is no scene", path);
    setDomain(Vec3D(-width / 2, -width / 2, 0), Vec3D(width / 2, width / 2, height));
    setTimeMax(seconds);
    setTimeStep(1e-5);
    setName("mercury_clumps");
    setGravity(Vec3D(0, 0, -9.81));
    setSaveCount(10000);
    auto* species = speciesHandler.copyAndAddObject(LinearViscoelasticFrictionSpecies());
    species->setDensity(density);
    species->setStiffness(1e5);
    species->setDissipation(20.0);
    species->setSlidingFrictionCoefficient(0.5);
    species->setSlidingStiffness(3e4);
    species->setSlidingDissipation(6.0);
  }

  void setupInitialConditions() override {
    std::string folder;
    for (double x, y, z, r[9]; scene >> folder >> x >> y >> z;) {
      for (double& value : r) scene >> value;
      const auto spheres = numbers(folder + "/Clump/Clump.txt");
      const auto m = numbers(folder + "/Inertia/TOI.txt", density);
      ClumpParticle grain;
      grain.setSpecies(speciesHandler.getObject(0));
      grain.setClump();
      grain.setPosition(Vec3D(x, y, z));
      grain.setRadius(spheres.at(3));
      for (std::size_t k = 0; k + 3 < spheres.size(); k += 4) {
        grain.addPebble(Vec3D(spheres[k], spheres[k + 1], spheres[k + 2]), spheres[k + 3]);
      }
      grain.setInitInertia({m.at(0), 0, 0, m.at(4), 0, m.at(8)});
      grain.setPrincipalDirections({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]});
      grain.setClumpMass(numbers(folder + "/Inertia/Mass.txt", density).front());
      particleHandler.copyAndAddObject(grain);
    }
    InfiniteWall wall(speciesHandler.getObject(0));
    const std::vector<Vec3D> normals = {{0, 0, -1}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    for (const Vec3D& out : normals) {
      wall.set(out, out.X + out.Y > 0 ? getMax() : getMin());
      wallHandler.copyAndAddObject(wall);
    }
  }
};

int main(int argc, char** argv) {
  Packing packing(argc == 2 ? argv[1] : "mercury_scene.txt");
  packing.solve();
  for (BaseParticle* sphere : packing.particleHandler) {
    if (sphere->isClump()) std::printf("speed %.9g\n", sphere->getVelocity().getLength());
    if (!sphere->isPebble()) continue;
    const Vec3D at = sphere->getPosition();
    std::printf("grain %u %.9g %.9g %.9g %.9g\n", sphere->getClump()->getId(), at.X, at.Y, at.Z,
                sphere->getRadius());
  }
}
