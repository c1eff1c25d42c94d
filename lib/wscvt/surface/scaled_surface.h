// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// A star-shaped surface in another unit of length.
class ScaledSurface : public RadialSurface {
 public:
  /// Lengths are lengths of `surface` / unit; unit > 0. The surface must outlive this.
  ScaledSurface(const RadialSurface& surface, double unit) : surface_(surface), unit_(unit) {}

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override {
    surface_.evaluate(directions, count, derivatives, jets);
    for (std::size_t i = 0; i < count; ++i) {
      jets[i].radius /= unit_;
      jets[i].gradient /= unit_;
      jets[i].hessian /= unit_;
    }
  }

 private:
  const RadialSurface& surface_;
  double unit_;
};

}  // namespace wscvt
