// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/quick_shape.h"

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/form_axes.h"

namespace wscvt {

QuickShape quick_shape(const IndexedMesh& mesh, const Execution& execution) {
  QuickShape quick;
  quick.shape = describe_shape(mesh, execution);
  const Vector3& axes = quick.shape.inertia_semi_axes;
  quick.form = form_ratios({axes[0], axes[1], axes[2]});
  quick.convexity = quick.shape.volume / volume_of(convex_hull(mesh.points, execution), execution);
  return quick;
}

}  // namespace wscvt
