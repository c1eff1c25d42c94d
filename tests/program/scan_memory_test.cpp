// SPDX-License-Identifier: GPL-3.0-or-later
// The memory that the program takes for dense scans.

#include <cstdlib>
#include <string>

#include "program_run.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

class ScanMemory : public test::ProgramRun {};

/// A mesh takes 48 bytes a vertex. The largest need is for a scan and its copy that is coarsened,
/// with their links and areas: 164. A tree of the scan's faces alone takes 260 or more.
TEST_F(ScanMemory, OfARemeshIsLessThanFourAndAHalfMeshes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep what is freed";
#endif
  const auto peak = [&](const IndexedMesh& scan) {
    write_mesh(scan, path("scan.ply"));
    // By a small process: what a child has of ours until it becomes the program counts as its own.
    const std::string command = "cd '" + folder_.string() +
                                "' && /usr/bin/time -f %M -o peak.txt '" WSCVT_PROGRAM
                                "' remesh scan.ply out.ply -q -t 1 -n 100";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return 1024.0 * std::stod(content("peak.txt"));
  };
  const IndexedMesh small = test::lumpy(6);
  const IndexedMesh large = test::lumpy(7);
  const double more = peak(large) - peak(small);
  const auto vertices = static_cast<double>(large.points.size() - small.points.size());
  EXPECT_LT(more / vertices, 4.5 * 48.0);
}

}  // namespace
}  // namespace wscvt
