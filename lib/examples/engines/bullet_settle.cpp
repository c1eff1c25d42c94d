// SPDX-License-Identifier: GPL-3.0-or-later
// Lets grains of convex parts fall into a box by Bullet's C++ library. For bullet_packing.py, where
// PyBullet is not: it writes bullet_scene.txt. Prints the place (x, y, z) and the turn (w, x, y, z)
// of each grain, and last the largest speed.
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <fstream>
#include <list>
#include <map>
#include <string>

/// The parts of a grain: NAME_1.obj, NAME_2.obj and so on, each the hull of its vertices.
void read_parts(const std::string& name, btCompoundShape& grain) {
  for (int part = 1;; ++part) {
    std::ifstream file(name + "_" + std::to_string(part) + ".obj");
    if (!file) return;
    auto* hull = new btConvexHullShape;
    std::string word, rest;
    for (double x = 0.0, y = 0.0, z = 0.0; file >> word; std::getline(file, rest)) {
      if (word == "v" && file >> x >> y >> z) hull->addPoint(btVector3(x, y, z), false);
    }
    hull->recalcLocalAabb();
    hull->setMargin(0.001);
    grain.addChildShape(btTransform::getIdentity(), hull);
  }
}

int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -9.81));
  world.getSolverInfo().m_numIterations = 50;
  std::ifstream scene("bullet_scene.txt");
  double width = 0.0, seconds = 0.0, friction = 0.0;
  if (!(scene >> width >> seconds >> friction)) return 1;
  for (const btVector3& normal : {btVector3(0, 0, 1), btVector3(1, 0, 0), btVector3(-1, 0, 0),
                                  btVector3(0, 1, 0), btVector3(0, -1, 0)}) {
    auto* plane = new btStaticPlaneShape(normal, normal.z() > 0 ? 0.0 : -width / 2);
    auto* wall = new btRigidBody(0.0, nullptr, plane);
    wall->setFriction(friction);
    world.addRigidBody(wall);
  }
  std::map<std::string, btCompoundShape> shapes;
  std::list<btRigidBody> grains;
  std::string name;
  for (double m, i, j, k, x, y, z, w, a, b, c;
       scene >> name >> m >> i >> j >> k >> x >> y >> z >> w >> a >> b >> c;) {
    btCompoundShape& shape = shapes[name];
    if (shape.getNumChildShapes() == 0) read_parts(name, shape);
    btRigidBody& grain = grains.emplace_back(m, nullptr, &shape, btVector3(i, j, k));
    grain.setWorldTransform(btTransform(btQuaternion(a, b, c, w), btVector3(x, y, z)));
    grain.setFriction(friction);
    world.addRigidBody(&grain);
  }
  for (int step = 0; step < 240 * seconds; ++step) world.stepSimulation(1.0 / 240, 0);
  double speed = 0.0;
  for (const btRigidBody& grain : grains) {
    const btVector3 p = grain.getWorldTransform().getOrigin();
    const btQuaternion q = grain.getWorldTransform().getRotation();
    std::printf("%.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(),
                q.z());
    speed = btMax(speed, double(grain.getLinearVelocity().length()));
  }
  std::printf("%.9g\n", speed);
}
