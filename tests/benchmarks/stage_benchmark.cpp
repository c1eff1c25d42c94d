// SPDX-License-Identifier: GPL-3.0-or-later
// Time of every stage and of the whole, with items per second and complexity fits. Run with
// --benchmark_filter=... to choose.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>

#include "dense_grain.h"
#include "wscvt/harmonic_surface.h"
#include "wscvt/mesh_check.h"
#include "wscvt/mesh_io.h"
#include "wscvt/mesh_surface.h"
#include "wscvt/power_cells.h"
#include "wscvt/radial_samples.h"
#include "wscvt/relaxation.h"
#include "wscvt/remesh.h"
#include "wscvt/sphere_sampling.h"

namespace wscvt {
namespace {

/// The same scan for every benchmark of one size.
const IndexedMesh& scan_of(std::int64_t vertices) {
  static std::map<std::int64_t, IndexedMesh> scans;
  const auto found = scans.find(vertices);
  if (found != scans.end()) return found->second;
  return scans.emplace(vertices, test::dense_grain(static_cast<int>(vertices))).first->second;
}

const HarmonicSurface& surface() {
  static const HarmonicSurface fitted = [] {
    const RadialSamples samples = radial_samples(scan_of(20000), Execution());
    return fit_harmonics(samples.directions, samples.radii, samples.weights, 20, Execution())
        .surface;
  }();
  return fitted;
}

SurfaceSeedModel model_of(int nodes, const Execution& execution) {
  WeightingOptions options;
  options.weighting = Weighting::Area;
  options.node_count = nodes;
  return {surface(), options, nullptr, execution};
}

void count(benchmark::State& state, std::int64_t items) {
  state.SetItemsProcessed(state.iterations() * items);
  state.SetComplexityN(items);
}

void read_ply(benchmark::State& state) {
  const std::string path = "stage_benchmark.ply";
  write_mesh(scan_of(state.range(0)), path);
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(path));
  std::remove(path.c_str());
  count(state, state.range(0));
}

void check(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(check_mesh(scan_of(state.range(0)), {}, execution));
  }
  count(state, state.range(0));
}

void sample_radii(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(radial_samples(scan_of(state.range(0)), execution));
  }
  count(state, state.range(0));
}

void fit_degree_30(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  const RadialSamples samples = radial_samples(scan_of(state.range(0)), execution);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        fit_harmonics(samples.directions, samples.radii, samples.weights, 30, execution));
  }
  count(state, state.range(0));
}

void tabulate_weights(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(model_of(static_cast<int>(state.range(0)), execution));
  }
}

void triangulate(benchmark::State& state) {
  const std::vector<Vector3> seeds = fibonacci_lattice(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(SphereTriangulation(seeds));
  count(state, state.range(0));
}

/// One step: look-up of weights or radii, repair of the triangulation, cells, move of the seeds.
void relaxation_step(benchmark::State& state, RelaxationMetric metric) {
  const auto nodes = static_cast<int>(state.range(0));
  const Execution execution(static_cast<int>(state.range(1)));
  const SurfaceSeedModel model = model_of(nodes, execution);
  RelaxationOptions options;
  options.metric = metric;
  options.maximum_iterations = 20;
  options.displacement_tolerance = 1e-12;
  RelaxationResult state_of_rest = relax(fibonacci_lattice(nodes), model, options, execution);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        relax(state_of_rest.seeds, state_of_rest.triangulation, model, options, execution));
  }
  // One evaluation at the start and one after each of the steps.
  count(state, nodes * (options.maximum_iterations + std::int64_t{1}));
  state.SetComplexityN(nodes);
  state.counters["step"] =
      benchmark::Counter(static_cast<double>(state.iterations() * (options.maximum_iterations + 1)),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void relaxation(benchmark::State& state, RelaxationMetric metric) {
  const auto nodes = static_cast<int>(state.range(0));
  const Execution execution(static_cast<int>(state.range(1)));
  const SurfaceSeedModel model = model_of(nodes, execution);
  RelaxationOptions options;
  options.metric = metric;
  const MultilevelOptions levels;
  const auto density = [&](const std::vector<Vector3>& directions) {
    return model.number_densities(directions, execution);
  };
  for (auto _ : state) {
    const int coarsest = level_sizes(nodes, levels.coarsest_seeds).front();
    benchmark::DoNotOptimize(relax_multilevel(warped_lattice(coarsest, density, 64), nodes, model,
                                              options, levels, execution));
  }
  count(state, nodes);
}

void cast_rays(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  const MeshSurface rays(scan_of(state.range(0)), Vector3::Zero(), 1.0, execution);
  const std::vector<Vector3> directions = fibonacci_lattice(100000);
  for (auto _ : state) benchmark::DoNotOptimize(rays.radii(directions, execution));
  count(state, 100000);
}

void whole(benchmark::State& state) {
  RemeshOptions options;
  options.weighting = Weighting::Area;
  options.node_count = static_cast<int>(state.range(1));
  const Execution execution(static_cast<int>(state.range(2)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(remesh(scan_of(state.range(0)), options, execution));
  }
}
void whole_by_input(benchmark::State& state) {
  whole(state);
  count(state, state.range(0));
}
void whole_by_nodes(benchmark::State& state) {
  whole(state);
  count(state, state.range(1));
}

void sizes_and_threads(benchmark::internal::Benchmark* b) {
  for (const std::int64_t threads : {1, 2}) {
    for (const std::int64_t vertices : {10000, 100000, 1000000}) b->Args({vertices, threads});
  }
}
void nodes_and_threads(benchmark::internal::Benchmark* b) {
  for (const std::int64_t threads : {1, 2}) {
    for (const std::int64_t nodes : {1000, 10000, 100000}) b->Args({nodes, threads});
  }
}

BENCHMARK(read_ply)->Arg(10000)->Arg(100000)->Arg(1000000)->Complexity();
BENCHMARK(check)->Apply(sizes_and_threads)->UseRealTime()->Complexity();
BENCHMARK(sample_radii)->Apply(sizes_and_threads)->UseRealTime()->Complexity();
BENCHMARK(fit_degree_30)->Apply(sizes_and_threads)->UseRealTime()->Complexity();
BENCHMARK(tabulate_weights)->Args({1000, 1})->Args({100000, 1})->UseRealTime();
BENCHMARK(triangulate)->Arg(1000)->Arg(10000)->Arg(100000)->Complexity();
BENCHMARK_CAPTURE(relaxation_step, sphere, RelaxationMetric::Sphere)
    ->Apply(nodes_and_threads)
    ->UseRealTime()
    ->Complexity();
BENCHMARK_CAPTURE(relaxation_step, surface, RelaxationMetric::Surface)
    ->Apply(nodes_and_threads)
    ->UseRealTime()
    ->Complexity();
BENCHMARK_CAPTURE(relaxation, sphere, RelaxationMetric::Sphere)
    ->Apply(nodes_and_threads)
    ->UseRealTime()
    ->Complexity();
BENCHMARK_CAPTURE(relaxation, surface, RelaxationMetric::Surface)
    ->Apply(nodes_and_threads)
    ->UseRealTime()
    ->Complexity();
BENCHMARK(cast_rays)->Apply(sizes_and_threads)->UseRealTime();
BENCHMARK(whole_by_input)
    ->Args({7228, 1000, 1})
    ->Args({100000, 1000, 1})
    ->Args({1000000, 1000, 1})
    ->UseRealTime()
    ->Complexity();
BENCHMARK(whole_by_nodes)
    ->Args({100000, 1000, 1})
    ->Args({100000, 10000, 1})
    ->Args({100000, 100000, 1})
    ->UseRealTime()
    ->Complexity();

}  // namespace
}  // namespace wscvt

BENCHMARK_MAIN();
