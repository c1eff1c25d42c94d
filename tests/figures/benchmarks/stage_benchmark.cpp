// SPDX-License-Identifier: GPL-3.0-or-later
// Time of every stage and of the whole, with items per second and complexity fits. Run with
// --benchmark_filter=... to choose.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>

#include "dense_grain.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/nodes/scan_nodes.h"
#include "wscvt/remesh.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_fit.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/power_cells.h"
#include "wscvt/tessellation/relaxation.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {
namespace {

/// The same scan for every benchmark of one size; made at the first call, which must not be timed.
const IndexedMesh& scan_of(std::int64_t vertices) {
  static std::map<std::int64_t, IndexedMesh> scans;
  const auto found = scans.find(vertices);
  if (found != scans.end()) return found->second;
  return scans.emplace(vertices, test::dense_grain(static_cast<int>(vertices))).first->second;
}

const HarmonicSurface& surface() {
  static const HarmonicSurface fitted = [] {
    const MeshSurface rays(scan_of(20000), Vector3::Zero(), 1.0, 0.0, Execution());
    return fit_harmonics(rays, 20, Execution()).surface;
  }();
  return fitted;
}

SurfaceSeedModel model_of(int nodes, const Execution& execution) {
  WeightingOptions options;
  options.kind = Weighting::Area;
  return {surface(), options, nodes, execution};
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
  const IndexedMesh& scan = scan_of(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(check_mesh(scan, {}, execution));
  }
  count(state, state.range(0));
}

void write_ply(benchmark::State& state) {
  const std::string path = "stage_benchmark.ply";
  const IndexedMesh& scan = scan_of(state.range(0));
  for (auto _ : state) write_mesh(scan, path);
  std::remove(path.c_str());
  count(state, state.range(0));
}

void measure(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  const IndexedMesh& scan = scan_of(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(describe_shape(scan, execution));
    benchmark::DoNotOptimize(measure_quality(scan, execution));
  }
  count(state, state.range(0));
}

void prepare_distances(benchmark::State& state) {
  const IndexedMesh& scan = scan_of(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(MeshDistance(scan).distance(Vector3::Zero()));
  }
  count(state, state.range(0));
}

void fit_degree_30(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  const MeshSurface rays(scan_of(state.range(0)), Vector3::Zero(), 1.0, 0.0, execution);
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_harmonics(rays, 30, execution));
  }
  count(state, state.range(0));
}

void tabulate_weights(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(model_of(static_cast<int>(state.range(0)), execution));
  }
  count(state, state.range(0));
}

void warp_lattice(benchmark::State& state) {
  const auto nodes = static_cast<int>(state.range(0));
  const Execution execution(static_cast<int>(state.range(1)));
  const SurfaceSeedModel model = model_of(nodes, execution);
  const auto density = [&](const std::vector<Vector3>& directions) {
    return model.number_densities(directions, execution);
  };
  for (auto _ : state) benchmark::DoNotOptimize(warped_lattice(nodes, density, 360));
  count(state, nodes);
}

void triangulate(benchmark::State& state) {
  const std::vector<Vector3> seeds = fibonacci_lattice(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(SphereTriangulation(seeds));
  count(state, state.range(0));
}

/// One step: look-up of weights, repair of the triangulation, cells, move of the seeds.
void relaxation_step(benchmark::State& state) {
  const auto nodes = static_cast<int>(state.range(0));
  const Execution execution(static_cast<int>(state.range(1)));
  const SurfaceSeedModel model = model_of(nodes, execution);
  RelaxationOptions options;
  options.maximum_iterations = 20;
  options.displacement_tolerance = 1e-12;
  RelaxationResult state_of_rest = relax(fibonacci_lattice(nodes), model, options, execution);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        relax(state_of_rest.seeds, model, options, execution, state_of_rest.triangulation));
  }
  // One evaluation at the start and one after each of the steps.
  count(state, nodes * (options.maximum_iterations + std::int64_t{1}));
  state.SetComplexityN(nodes);
  state.counters["step"] =
      benchmark::Counter(static_cast<double>(state.iterations() * (options.maximum_iterations + 1)),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void relaxation(benchmark::State& state) {
  const auto nodes = static_cast<int>(state.range(0));
  const Execution execution(static_cast<int>(state.range(1)));
  const SurfaceSeedModel model = model_of(nodes, execution);
  RelaxationOptions options;
  const auto density = [&](const std::vector<Vector3>& directions) {
    return model.number_densities(directions, execution);
  };
  for (auto _ : state) {
    const int coarsest = level_sizes(nodes).front();
    benchmark::DoNotOptimize(
        relax_multilevel(warped_lattice(coarsest, density, 64), nodes, model, options, execution));
  }
  count(state, nodes);
}

/// The rays of the nodes onto a scan of 100,000 vertices.
void cast_rays(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  const MeshSurface rays(scan_of(100000), Vector3::Zero(), 1.0, 0.0, execution);
  const std::vector<Vector3> directions = fibonacci_lattice(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(rays.radii(directions, execution));
  count(state, state.range(0));
}

/// Nodes on the scan of 100,000 vertices, as the method on the scan places them.
void place_on_scan(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  const auto nodes = static_cast<int>(state.range(0));
  const IndexedMesh& scan = scan_of(100000);
  const ScanRemesher remesher(scan, ScanNodesOptions(), nodes, execution);
  for (auto _ : state) benchmark::DoNotOptimize(remesher.place(nodes, execution));
  count(state, state.range(0));
}

void measure_to_scan(benchmark::State& state) {
  const Execution execution(static_cast<int>(state.range(1)));
  const MeshDistance to_scan(scan_of(100000));
  const IndexedMesh& coarse = scan_of(state.range(0));
  const IndexedMesh& scan = scan_of(100000);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        measure_distances(coarse, scan, to_scan, usual_distance_samples, execution));
  }
  count(state, state.range(0));
}

void whole(benchmark::State& state) {
  RemeshOptions options;
  options.node_count = static_cast<int>(state.range(1));
  const Execution execution(static_cast<int>(state.range(2)));
  const IndexedMesh& scan = scan_of(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(remesh(scan, options, execution));
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

// One family a number of threads, so that each has a complexity fit of its own.
template <int Threads>
void sizes(benchmark::internal::Benchmark* b) {
  for (const std::int64_t vertices : {10000, 100000, 1000000}) b->Args({vertices, Threads});
  b->UseRealTime()->Complexity();
}
template <int Threads>
void nodes(benchmark::internal::Benchmark* b) {
  for (const std::int64_t count : {1000, 10000, 100000}) b->Args({count, Threads});
  b->UseRealTime()->Complexity();
}
template <int Threads>
void scans(benchmark::internal::Benchmark* b) {
  for (const std::int64_t vertices : {7228, 100000, 1000000}) b->Args({vertices, 1000, Threads});
  b->UseRealTime()->Complexity();
}
template <int Threads>
void counts(benchmark::internal::Benchmark* b) {
  for (const std::int64_t count : {1000, 10000, 100000}) b->Args({100000, count, Threads});
  b->UseRealTime()->Complexity();
}

// Stages that run on one thread whatever they are given.
BENCHMARK(read_ply)->Arg(10000)->Arg(100000)->Arg(1000000)->Complexity();
BENCHMARK(write_ply)->Arg(10000)->Arg(100000)->Arg(1000000)->Complexity();
BENCHMARK(prepare_distances)->Arg(10000)->Arg(100000)->Arg(1000000)->Complexity();
BENCHMARK(triangulate)->Arg(1000)->Arg(10000)->Arg(100000)->Complexity();

BENCHMARK(check)->Apply(sizes<1>);
BENCHMARK(check)->Apply(sizes<2>);
BENCHMARK(fit_degree_30)->Apply(sizes<1>);
BENCHMARK(fit_degree_30)->Apply(sizes<2>);
BENCHMARK(measure)->Apply(sizes<1>);
BENCHMARK(measure)->Apply(sizes<2>);
BENCHMARK(tabulate_weights)->Apply(nodes<1>);
BENCHMARK(tabulate_weights)->Apply(nodes<2>);
BENCHMARK(warp_lattice)->Apply(nodes<1>);
BENCHMARK(warp_lattice)->Apply(nodes<2>);
BENCHMARK(relaxation_step)->Apply(nodes<1>);
BENCHMARK(relaxation_step)->Apply(nodes<2>);
BENCHMARK(relaxation)->Apply(nodes<1>);
BENCHMARK(relaxation)->Apply(nodes<2>);
BENCHMARK(cast_rays)->Apply(nodes<1>);
BENCHMARK(cast_rays)->Apply(nodes<2>);
BENCHMARK(place_on_scan)->Apply(nodes<1>);
BENCHMARK(place_on_scan)->Apply(nodes<2>);
BENCHMARK(measure_to_scan)->Apply(nodes<1>);
BENCHMARK(measure_to_scan)->Apply(nodes<2>);
BENCHMARK(whole_by_input)->Apply(scans<1>);
BENCHMARK(whole_by_input)->Apply(scans<2>);
BENCHMARK(whole_by_nodes)->Apply(counts<1>);
BENCHMARK(whole_by_nodes)->Apply(counts<2>);

}  // namespace
}  // namespace wscvt

BENCHMARK_MAIN();
