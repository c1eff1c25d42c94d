// SPDX-License-Identifier: GPL-3.0-or-later
// own_surface OUTPUT: a surface of one's own formula, as published with WSCVT-D weights: a ball
// with a bump, whose radius in the direction (x, y, z) is 1 + 0.3 exp(-8 (1 - z)).
#include <wscvt/mesh_files/mesh_io.h>
#include <wscvt/remesh.h>
#include <wscvt/surface/radial_surface.h>

#include <cmath>
#include <cstddef>
#include <exception>
#include <iostream>

namespace {

class BallWithBump : public wscvt::RadialSurface {
 public:
  void evaluate(const wscvt::Vector3* directions, std::size_t count, wscvt::Derivatives /*wanted*/,
                wscvt::RadialJet* jets) const override {
    for (std::size_t i = 0; i < count; ++i) {
      const wscvt::Vector3& u = directions[i];
      // r = 1 + b(c) with c = z / |x|, and the derivatives of c at |x| = 1.
      const double bump = 0.3 * std::exp(-8.0 * (1.0 - u.z()));
      const wscvt::Vector3 axis = wscvt::Vector3::UnitZ();
      const wscvt::Vector3 slope = axis - u.z() * u;
      const wscvt::Matrix3 bend = 3.0 * u.z() * u * u.transpose() - axis * u.transpose() -
                                  u * axis.transpose() - u.z() * wscvt::Matrix3::Identity();
      jets[i].radius = 1.0 + bump;
      jets[i].gradient = 8.0 * bump * slope;
      jets[i].hessian = 64.0 * bump * slope * slope.transpose() + 8.0 * bump * bend;
    }
  }
};

}  // namespace

int main(int count, char** arguments) try {
  if (count != 2) {
    std::cerr << "usage: own_surface OUTPUT\n";
    return 2;
  }
  wscvt::RemeshOptions options;
  options.node_count = 800;
  options.method = wscvt::AsPublishedOptions();
  const wscvt::RemeshResult result = wscvt::remesh(BallWithBump(), options);
  wscvt::write_mesh(result.mesh, arguments[1]);
  std::cout << "volume of the formula " << result.scan.volume << ", of the mesh "
            << result.remesh.volume << '\n';
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
