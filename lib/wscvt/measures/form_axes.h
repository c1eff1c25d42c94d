// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Three mutually perpendicular dimensions of a body, S <= I <= L; full lengths, not halves.
struct FormAxes {
  double shortest = 0.0;      ///< S
  double intermediate = 0.0;  ///< I
  double longest = 0.0;       ///< L
};

/// Edges of the smallest-volume oriented box about the points, by the optimisation of Chang,
/// Gorissen and Melchior (2011), "Fast oriented bounding box optimization on the rotation group
/// SO(3,R)", ACM Trans. Graph. 30, 122 (CGAL::oriented_bounding_box, fixed seed): near the
/// smallest, not proved so; more than 2,000 points are first thinned to the extreme ones in 2,000
/// directions. The edges bound the points exactly. Throws Error(InvalidInput) for fewer than four
/// points, coordinates that are not finite and extents not between 1e-60 and 1e60,
/// Error(Cancelled). Takes one thread.
FormAxes oriented_box_axes(const std::vector<Vector3>& points,
                           const Execution& execution = Execution(1));

/// Ratios of the three dimensions; none has a unit.
struct FormRatios {
  double aspect_ratio = 0.0;      ///< S/L, in (0, 1]
  double zingg_elongation = 0.0;  ///< I/L, in (0, 1] (Zingg 1935, Beitrag zur Schotteranalyse)
  double zingg_flatness = 0.0;    ///< S/I, in (0, 1] (the same)
  /// (L - I)/L, in [0, 1) (Kong and Fonseca 2018, "Quantification of the morphology of shelly
  /// carbonate sands using 3D images", Geotechnique; read as SHAPE does: Angelidakis, Nadimi and
  /// Utili 2021, Comput. Phys. Commun. 265, 107983).
  double kong_fonseca_elongation = 0.0;
  double kong_fonseca_flatness = 0.0;  ///< (I - S)/I, in [0, 1) (the same)
  /// Intercept sphericity (I S / L^2)^(1/3), in (0, 1] (Krumbein 1941, J. Sediment. Petrol. 11,
  /// 64-72).
  double krumbein_sphericity = 0.0;
};

/// Of dimensions > 0. Throws nothing.
FormRatios form_ratios(const FormAxes& axes);

}  // namespace wscvt
