// SPDX-License-Identifier: GPL-3.0-or-later
// The longest processor time, on one thread, that passes between two progress calls in every kind
// of run, on a scan of a million vertices: as long as a cancel waits at most. Arguments: the number
// of vertices, and words of the runs' names to choose from them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dense_grain.h"
#include "support/test_shapes.h"
#include "toolbox/exchange/distance_grid.h"
#include "toolbox/map/scan_harmonics.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"

namespace wscvt {
namespace {

double processor_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Watches the calls of one run; its beginning and its end count as calls.
class Watch {
 public:
  Execution execution() {
    last_ = processor_seconds();
    begin_ = last_;
    return Execution(1, [this](double /*fraction*/, const std::string& stage) {
      look(stage);
      ++calls_;
      return true;
    });
  }

  void print(const std::string& name, const std::string& ending) {
    look("the end");
    std::printf("%-34s %7.2f s %8ld calls, longest %6.3f s, from \"%s\" to \"%s\"%s\n",
                name.c_str(), last_ - begin_, calls_, longest_, from_.c_str(), to_.c_str(),
                ending.c_str());
    std::fflush(stdout);
  }

 private:
  void look(const std::string& stage) {
    const double now = processor_seconds();
    if (now - last_ > longest_) {
      longest_ = now - last_;
      from_ = stage_;
      to_ = stage;
    }
    stage_ = stage;
    last_ = processor_seconds();
  }

  double begin_ = 0.0;
  double last_ = 0.0;
  double longest_ = 0.0;
  long calls_ = 0;
  std::string stage_ = "the beginning";
  std::string from_;
  std::string to_;
};

struct Run {
  std::string name;
  std::function<void(const Execution&)> body;
  std::function<void()> prepare = [] {};  ///< not watched
};

/// A torus of that many vertices: its one handle is cut.
IndexedMesh handled(int vertices) {
  return test::torus(1.0, 0.3, static_cast<int>(std::sqrt(static_cast<double>(vertices))));
}

/// The scan without the faces of a patch.
IndexedMesh with_a_hole(IndexedMesh scan) {
  const auto in_patch = [&](const Triangle& t) {
    const Vector3& p = scan.points[t[0]];
    return p.x() > 0.97 * p.norm();
  };
  scan.triangles.erase(std::remove_if(scan.triangles.begin(), scan.triangles.end(), in_patch),
                       scan.triangles.end());
  return scan;
}

std::vector<Run> all_runs(const IndexedMesh& scan) {
  std::vector<Run> runs;
  const auto add = [&](const std::string& name, const std::function<void(RemeshOptions&)>& change) {
    runs.push_back({name, [&scan, change](const Execution& execution) {
                      RemeshOptions options;
                      change(options);
                      remesh(scan, options, execution);
                    }});
  };
  const auto on_scan = [&](const std::string& name, const auto& change) {
    add(name, [change](RemeshOptions& o) {
      OnScanOptions method;
      change(method);
      o.method = method;
    });
  };
  add("remesh", [](RemeshOptions&) {});
  add("remesh as published", [](RemeshOptions& o) { o.method = AsPublishedOptions(); });
  add("remesh as published by curvature", [](RemeshOptions& o) {
    AsPublishedOptions method;
    method.weighting = Weighting::Curvature;
    o.method = method;
    o.measures.node_curvatures = true;
  });
  on_scan("remesh by the scan's curvature",
          [](OnScanOptions& o) { o.weighting = CellWeighting::Curvature; });
  on_scan("remesh for contacts", [](OnScanOptions& o) { o.placement = ScanPlacement::ContactFit; });
  on_scan("remesh closely", [](OnScanOptions& o) { o.edge_ratio = 1.6; });
  add("remesh of points", [](RemeshOptions& o) { o.points = true; });
  add("remesh with distances", [](RemeshOptions& o) { o.measures.distances = true; });
  add("remesh to an error", [](RemeshOptions& o) {
    o.target.percent = 0.3;
    o.target.measure = ErrorMeasure::Distance;
  });
  add("remesh to 100,000 nodes", [](RemeshOptions& o) { o.node_count = 100000; });
  add("remesh as published to 1,000,000 nodes", [](RemeshOptions& o) {
    o.method = AsPublishedOptions();
    o.node_count = 1000000;
  });
  add("remesh of the wrap at 5 %", [](RemeshOptions& o) { o.shrink_wrap.opening_percent = 5.0; });
  add("remesh of the wrap at 2 %", [](RemeshOptions& o) { o.shrink_wrap.opening_percent = 2.0; });
  add("remesh of the points' wrap at 5 %", [](RemeshOptions& o) {
    o.points = true;
    o.shrink_wrap.opening_percent = 5.0;
  });
  add("remesh with coefficients", [](RemeshOptions& o) { o.measures.series = scan_harmonics; });
  for (const std::string ending : {".ply", ".obj", ".off", ".stl"}) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("wscvt_progress_gaps" + ending)).string();
    runs.push_back({"reading " + ending,
                    [path](const Execution& execution) {
                      read_mesh(path, execution);
                      std::filesystem::remove(path);
                    },
                    [&scan, path] { write_mesh(scan, path); }});
  }
  runs.push_back({"remesh of a soup", [&scan](const Execution& execution) {
                    remesh(test::unwelded(scan), {}, execution);
                  }});
  runs.push_back({"remesh with a hole", [&scan](const Execution& execution) {
                    remesh(with_a_hole(scan), {}, execution);
                  }});
  runs.push_back({"remesh of a torus", [&scan](const Execution& execution) {
                    RemeshOptions options;
                    OnScanOptions method;
                    method.handles.length_limit = 10.0;
                    options.method = method;
                    remesh(handled(static_cast<int>(scan.points.size())), options, execution);
                  }});
  runs.push_back({"descriptors and comparison", [&scan](const Execution& execution) {
                    measure_grain({"grain", scan}, NamedMesh{"reference", scan}, {}, execution);
                  }});
  runs.push_back({"signed distances",
                  [&scan](const Execution& execution) { distance_grid(scan, {}, execution); }});
  runs.push_back({"page", [&scan](const Execution& execution) {
                    RemeshOptions options;
                    options.measures.repaired_scan = true;
                    const RemeshResult result = remesh(scan, options, execution);
                    report_html(result, {}, execution);
                  }});
  return runs;
}

}  // namespace
}  // namespace wscvt

int main(int argc, char** argv) {
  using namespace wscvt;
  const int vertices = argc > 1 ? std::atoi(argv[1]) : 1000000;
  const IndexedMesh scan = test::dense_grain(vertices);
  for (const Run& run : all_runs(scan)) {
    bool chosen = argc <= 2;
    for (int i = 2; i < argc; ++i) chosen = chosen || run.name.find(argv[i]) != std::string::npos;
    if (!chosen) continue;
    run.prepare();
    Watch watch;
    std::string ending;
    try {
      run.body(watch.execution());
    } catch (const Error& error) {
      ending = std::string("; ") + error.what();
    }
    watch.print(run.name, ending);
  }
  return 0;
}
