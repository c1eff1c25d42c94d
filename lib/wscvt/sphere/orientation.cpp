// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace wscvt {

int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto point = [](const Vector3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  return static_cast<int>(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

}  // namespace wscvt
