// SPDX-License-Identifier: GPL-3.0-or-later

// Lets grains of convex parts fall by Bullet's C++ library, until they are at rest. run.py writes
// packing.scene. Prints "energy time kinetic" lines, "grain x y z qw qx qy qz" of each grain, and "contact i j".
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <list>

double kinetic_energy(const std::list<btRigidBody>& grains) {
  double sum = 0.0;
  for (const btRigidBody& grain : grains) {
    const btVector3 spin = grain.getWorldTransform().getBasis().transpose() * grain.getAngularVelocity();
    sum += 0.5 * grain.getLinearVelocity().length2() / grain.getInvMass();
    sum += 0.5 * (spin * spin).dot(grain.getLocalInertia());
  }
  return sum;
}

int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -9.81));
  world.getSolverInfo().m_numIterations = 50;
  std::ifstream scene("packing.scene");
  int sides = 0;
  double half = 0.0, seconds = 0.0, fall = 0.0, rest = 0.0, friction = 0.0;
  if (!(scene >> sides >> half >> seconds >> fall >> rest >> friction)) return 1;
  for (int k = -1; k < sides; ++k) {
    const double angle = 2.0 * 3.14159265358979323846 * k / sides;
    const btVector3 normal = k < 0 ? btVector3(0, 0, 1) : btVector3(-std::cos(angle), -std::sin(angle), 0);
    auto* wall = new btRigidBody(0.0, nullptr, new btStaticPlaneShape(normal, k < 0 ? 0.0 : -half));
    wall->setFriction(friction);
    wall->setUserIndex(-1);
    world.addRigidBody(wall);
  }
  std::list<btRigidBody> grains;
  int parts = 0;
  for (double m, i, j, k, x, y, z, w, a, b, c; scene >> m >> i >> j >> k >> x >> y >> z >> w >> a >> b >> c >> parts;) {
    auto* shape = new btCompoundShape;
    for (int part = 0; part < parts; ++part) {
      auto* hull = new btConvexHullShape;
      int points = 0;
      scene >> points;
      for (double u, v, t; points > 0 && scene >> u >> v >> t; --points) hull->addPoint(btVector3(u, v, t), false);
      hull->recalcLocalAabb();
      hull->setMargin(0.001);
      shape->addChildShape(btTransform::getIdentity(), hull);
    }
    btRigidBody& grain = grains.emplace_back(m, nullptr, shape, btVector3(i, j, k));
    grain.setWorldTransform(btTransform(btQuaternion(a, b, c, w), btVector3(x, y, z)));
    grain.setFriction(friction);
    grain.setDamping(0.3, 0.3);  // or contacts tremble for seconds
    grain.setUserIndex(static_cast<int>(grains.size()) - 1);
    world.addRigidBody(&grain);
  }
  for (int step = 1; step <= 240 * seconds; ++step) {
    world.stepSimulation(1.0 / 240, 0);
    if (step % 20 != 0) continue;
    const double energy = kinetic_energy(grains);
    std::printf("energy %.9g %.9g\n", step / 240.0, energy);
    if (step > 240 * fall && energy < rest) break;
  }
  for (const btRigidBody& grain : grains) {
    const btVector3 p = grain.getWorldTransform().getOrigin();
    const btQuaternion q = grain.getWorldTransform().getRotation();
    std::printf("grain %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
  }
  for (int k = 0; k < dispatcher.getNumManifolds(); ++k) {
    const btPersistentManifold* pair = dispatcher.getManifoldByIndexInternal(k);
    const int i = pair->getBody0()->getUserIndex(), j = pair->getBody1()->getUserIndex();
    if (i >= 0 && j >= 0 && pair->getNumContacts() > 0) std::printf("contact %d %d\n", i, j);
  }
}
