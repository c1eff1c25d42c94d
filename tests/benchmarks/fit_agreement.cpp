// SPDX-License-Identifier: GPL-3.0-or-later
// fit_agreement [VERTICES [DEGREE]]: how far the fit is from plain least squares on a dense grain.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "dense_grain.h"
#include "support/plain_fit.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/radial_samples.h"

namespace {

void compare(int vertices, int degree) {
  using namespace wscvt;
  const Execution execution;
  const CheckedMesh grain = check_mesh(test::dense_grain(vertices), MeshCheckOptions(), execution);
  const RadialSamples samples = radial_samples(grain.mesh, execution);
  const HarmonicFit fit =
      fit_harmonics(samples.directions, samples.radii, samples.weights, degree, execution);
  const test::PlainFit plain = test::plain_least_squares(samples.directions, samples.radii,
                                                         samples.weights, fit.report.degree);
  std::printf("%zu points, degree %d: residual %.9g, plain %.9g;\n", samples.radii.size(),
              fit.report.degree, fit.report.residual, plain.residual);
  std::printf(
      "rms difference of the surfaces / residual: %.2e\n",
      test::rms_difference(fit.surface.coefficients(), plain.coefficients) / plain.residual);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    compare(argc > 1 ? std::atoi(argv[1]) : 1000000, argc > 2 ? std::atoi(argv[2]) : 30);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
