// SPDX-License-Identifier: GPL-3.0-or-later
// Templates of a sample and virtual grains. The Python package combines these parts into structured
// arrays.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <exception>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/sample/grain_grower.h"
#include "toolbox/sample/grown_mesh.h"
#include "toolbox/sample/nearest_grain.h"
#include "toolbox/sample/templates.h"
#include "work.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

py::dict templates(const Eigen::MatrixXd& descriptors, const std::vector<double>& masses, int k,
                   std::uint64_t seed, int threads, const py::object& progress) {
  TemplateOptions options;
  options.count = k;
  options.seed = seed;
  const SampleTemplates chosen = work_on(threads, progress, [&](const Execution& execution) {
    return choose_templates(descriptors, masses, options, execution);
  });
  py::dict parts;
  parts["grains"] = py::array(py::cast(chosen.grains));
  parts["by_number"] = array_of(chosen.by_number);
  parts["by_mass"] = array_of(chosen.by_mass);
  parts["stands_for"] = py::array(py::cast(chosen.stands_for));
  parts["distance_by_number"] = array_of(chosen.reached.by_number);
  parts["distance_by_mass"] = array_of(chosen.reached.by_mass);
  parts["random_by_number"] = array_of(chosen.random.by_number);
  parts["random_by_mass"] = array_of(chosen.random.by_mass);
  return parts;
}

/// Coefficients of a grain or its mesh; the other is empty.
struct RealGrain {
  std::vector<double> coefficients;
  IndexedMesh mesh;
};

RealGrain real_grain(const py::handle& grain) {
  RealGrain real;
  if (py::isinstance<py::tuple>(grain)) {
    real.mesh = mesh_of_reference(py::reinterpret_borrow<py::object>(grain));
  } else {
    real.coefficients = py::cast<std::vector<double>>(grain);
  }
  return real;
}

std::vector<SampleGrain> sample_of_grains(std::vector<RealGrain>& grains, const SampleGrids& grids,
                                          const Execution& execution) {
  std::vector<SampleGrain> sample(grains.size());
  execution.parallel_for_each(grains.size(), 1, [&](std::size_t k) {
    const Execution one_thread(1);
    RealGrain& grain = grains[k];
    sample[k] =
        grain.coefficients.empty()
            ? sample_grain(check_mesh(std::move(grain.mesh), MeshCheckOptions(), one_thread).mesh,
                           grids, one_thread)
            : sample_grain(HarmonicSurface(grain.coefficients), grids, one_thread);
  });
  return sample;
}

py::list grow(const py::list& grains, std::size_t n, int nodes, int degree, std::uint64_t seed,
              int threads, const py::object& progress) {
  std::vector<RealGrain> real;
  for (const py::handle& grain : grains) real.push_back(real_grain(grain));
  GrowOptions options;
  options.seed = seed;
  using Grown = std::pair<GrownBody, NearestGrain>;
  const std::vector<Grown> bodies = work_on(threads, progress, [&](const Execution& execution) {
    const SampleGrids grids(degree);
    std::vector<SampleGrain> sample = sample_of_grains(real, grids, execution.part(0.0, 0.2));
    const GrainSearch search(sample);
    const GrainGrower grower(std::move(sample), grids, options);
    const GrownMeshes meshes(nodes, execution);
    std::vector<Grown> grown(n);
    GrainRun run;
    run.count = n;
    run.name = [](std::size_t k) { return std::to_string(k); };
    std::mutex mutex;
    std::exception_ptr failure;  // the first ends the run
    run.work = [&](std::size_t k, const Execution&) -> GrainRow {
      auto& [body, nearest] = grown[k];
      try {
        body = grow_body(grower, meshes, k);
        nearest = search.nearest(body.grain.radial);
      } catch (const Error&) {
        const std::lock_guard<std::mutex> lock(mutex);
        failure = std::current_exception();
      }
      return {};
    };
    const Execution growing = execution.part(0.2, 1.0);
    JobHost host = host_of(threads, growing);
    host.is_cancelled = [&] {
      const std::lock_guard<std::mutex> lock(mutex);
      return failure != nullptr;
    };
    const JobEnd end = run_grains(run, host);
    if (failure) std::rethrow_exception(failure);
    check_end(end);
    return grown;
  });
  py::list list;
  for (const auto& [body, nearest] : bodies) {
    list.append(py::make_tuple(array_of(body.mesh.points), array_of(body.mesh.triangles),
                               2.0 * body.grain.radius, body.grain.donors.front(), nearest.grain,
                               nearest.distance, body.grain.collage, body.grain.redraws));
  }
  return list;
}

}  // namespace

void bind_grow(py::module_& module) {
  module.def("templates_of", &templates);
  module.def("grow_of", &grow);
}

}  // namespace wscvt::python
