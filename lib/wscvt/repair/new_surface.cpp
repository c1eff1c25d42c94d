// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/new_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/version.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/coordinates.h"
#include "wscvt/repair/scan_advice.h"
#include "wscvt/repair/weld.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

constexpr const char* cloud_stage = "Making a surface of the points";

}  // namespace

IndexedMesh mesh_of_points(std::vector<Vector3> points, const Execution& execution) {
  execution.report(0.0, cloud_stage);
  IndexedMesh mesh;
  mesh.points = different_points(std::move(points), execution);
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : mesh.points) centre += p / static_cast<double>(mesh.points.size());
  // The mean of the points is biased to dense regions. The second round uses the volume's centroid.
  std::vector<Vector3> directions(mesh.points.size());
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < directions.size(); ++i) {
      directions[i] = (mesh.points[i] - centre).normalized();
    }
    const Execution part = execution.part(0.5 * round, 0.5 * (round + 1));
    const auto triangulation =
        SphereTriangulation::try_build(directions, std::vector<double>(), part);
    if (!triangulation) {
      // A wrap enters gaps between points that are as wide as its opening. Points of a box of
      // 4 x 7 x 9 at a distance of 1 need 13 %.
      constexpr double first_percent = 15.0;
      throw Error(ErrorCode::NumericalFailure,
                  "No surface with one radius in each direction goes through the points: they do "
                  "not surround their centre, or two lie on one ray from it. " +
                      surface_of_points_advice() + " " + wrap_advice(first_percent));
    }
    mesh.triangles = triangulation->triangles();
    centre += mesh_sums(mesh.points, mesh.triangles, centre, part).centroid();
  }
  return mesh;
}

IndexedMesh with_surface(IndexedMesh scan, bool points_only, const Execution& execution) {
  if (points_only) return mesh_of_points(std::move(scan.points), execution);
  if (!scan.triangles.empty() || scan.points.empty()) return scan;
  refuse("The scan has " + std::to_string(scan.points.size()) +
         " points and no faces. If it was exported without its faces, export it again. If there "
         "are only points, build a surface from them: " +
         mention("points", "true") + ".");
}

namespace {

/// Splits the faces of a node of CGAL's tree of boxes in two, as its traits do, and reports
/// progress, because a tree of two million faces takes seconds. For AABB_tree::custom_build.
template <class Traits>
class ReportingSplit {
 public:
  ReportingSplit(const Traits& traits, const Execution& execution, const char* stage)
      : split_(traits.split_primitives_object()), execution_(execution), stage_(stage) {}

  template <class Iterator, class Box>
  void operator()(Iterator first, Iterator beyond, const Box& box) const {
    constexpr std::ptrdiff_t faces_a_report = 8192;  // some hundredths of a second
    if (beyond - first > faces_a_report) execution_.report(0.0, stage_);
    split_(first, beyond, box);
  }

 private:
  typename Traits::Split_primitives split_;
  const Execution& execution_;
  const char* stage_;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Wrap = CGAL::Surface_mesh<Kernel::Point_3>;

// The parts of CGAL::alpha_wrap_3. It takes seconds to minutes. The function itself cannot be
// stopped while it builds its tree of the faces, a second for a million vertices.
namespace parts = CGAL::Alpha_wraps_3::internal;
// Both start searches for the nearest face from hint points on the scan. CGAL takes one point per
// face and sorts all at once; for a million vertices this cannot be stopped for half a second.

std::size_t hint_stride(std::size_t size) {
  constexpr std::size_t most = 100000;
  return 1 + size / most;
}

struct FaceOracle : parts::Triangle_soup_oracle<Kernel> {
  using parts::Triangle_soup_oracle<Kernel>::Triangle_soup_oracle;

  /// Once the tree is built.
  void choose_hints() {
    std::vector<typename Splitter::AABB_tree::Point_and_primitive_id> hints;
    for (std::size_t i = 0; i < tree().size(); i += hint_stride(tree().size())) {
      const typename Splitter::ID id(i, this->m_dppmb.range()[i]);
      hints.emplace_back(get(this->m_rppm, id), id);
    }
    tree().accelerate_distance_queries(hints.begin(), hints.end());
  }

 private:
  using Splitter = parts::AABB_tree_splitter_traits<Kernel::Point_3, Geom_traits>;
};

struct PointOracle : parts::Point_set_oracle<Kernel> {
  /// The points must outlive it.
  explicit PointOracle(const std::vector<Kernel::Point_3>& points) : points_(&points) {
    tree().insert(points.begin(), points.end());
  }

  /// Once the tree is built.
  void choose_hints() {
    using Tree = std::decay_t<decltype(tree())>;
    std::vector<typename Tree::Point_and_primitive_id> hints;
    for (std::size_t i = 0; i < points_->size(); i += hint_stride(points_->size())) {
      hints.emplace_back((*points_)[i], points_->begin() + static_cast<std::ptrdiff_t>(i));
    }
    tree().accelerate_distance_queries(hints.begin(), hints.end());
  }

 private:
  const std::vector<Kernel::Point_3>* points_;
};

constexpr const char* shrink_wrap_stage = "Wrapping the scan";

/// Faces given to the oracle at once: some hundredths of a second.
constexpr std::size_t faces_a_report = 1 << 17;

/// Reports before each step of the wrapping. A step takes at most milliseconds.
struct ReportingVisitor : parts::Wrapping_default_visitor {
  explicit ReportingVisitor(const Execution& to) : execution(to) {}

  template <class Wrapper, class Gate>
  void before_facet_treatment(const Wrapper& /*wrapper*/, const Gate& /*gate*/) {
    execution.report(0.1, shrink_wrap_stage);
  }

  const Execution& execution;
};

[[noreturn]] void refuse_nothing() {
  refuse(
      "There is nothing to shrink-wrap. Give a mesh whose faces have an area, or points with an "
      "extent, and an opening above 0.");
}

/// The steps of CGAL::alpha_wrap_3, with reports between them.
template <class Oracle>
Wrap alpha_wrap(Oracle oracle, double alpha, double offset, const Execution& execution) {
  auto& tree = oracle.tree();
  if (tree.empty()) refuse_nothing();  // CGAL leaves out faces without area
  using Traits = typename std::decay_t<decltype(tree)>::AABB_traits;
  tree.custom_build(tree.traits().compute_bbox_object(),
                    ReportingSplit<Traits>(tree.traits(), execution, shrink_wrap_stage));
  execution.report(0.0, shrink_wrap_stage);
  oracle.choose_hints();
  Wrap wrap;
  ReportingVisitor visitor(execution);
  const auto parameters = CGAL::parameters::visitor(visitor);
#if CGAL_VERSION_NR < CGAL_VERSION_NUMBER(6, 0, 0)
  parts::Alpha_wrap_3<Oracle>{oracle}(alpha, offset, wrap, parameters);
#else
  parts::Alpha_wrapper_3<Oracle>{oracle}(alpha, offset, wrap, parameters,
                                         CGAL::parameters::default_values());
#endif
  execution.report(0.9, shrink_wrap_stage);
  // The wrap is made off the scan to avoid the scan's flaws, then moved back so that its volume is
  // not too large. A tenth of the distance stays, because several vertices about a corner have one
  // nearest point there.
  for (const auto v : wrap.vertices()) {
    const Kernel::Vector_3 way = oracle.closest_point(wrap.point(v)) - wrap.point(v);
    const double length = std::sqrt(way.squared_length());
    if (length > 0.0) wrap.point(v) += 0.9 * std::min(1.0, offset / length) * way;
  }
  return wrap;
}

/// Whether CGAL can project points onto a face. It leaves out faces without area by exact
/// arithmetic, but divides by a normal of doubles. Where rounding makes that 0, the result is no
/// number, which ends the program (SIGFPE) in the exact arithmetic after it.
bool has_normal(const std::vector<Kernel::Point_3>& points, const Triangle& t) {
  constexpr double rounding = 1e-15;
  const Kernel::Vector_3 one = points[t[0]] - points[t[2]];
  const Kernel::Vector_3 other = points[t[1]] - points[t[2]];
  const double size = std::max(one.squared_length(), other.squared_length());
  const double square = CGAL::cross_product(one, other).squared_length();
  return square >= std::numeric_limits<double>::min() && std::sqrt(square) > rounding * size;
}

FaceOracle oracle_of(const std::vector<Kernel::Point_3>& points,
                     const std::vector<Triangle>& triangles, double alpha,
                     const Execution& execution) {
  FaceOracle oracle(alpha);
  std::vector<std::array<std::size_t, 3>> faces;
  for (std::size_t begin = 0; begin < triangles.size(); begin += faces_a_report) {
    execution.report(0.0, shrink_wrap_stage);
    faces.clear();
    for (std::size_t f = begin; f < std::min(triangles.size(), begin + faces_a_report); ++f) {
      const Triangle& t = triangles[f];
      if (!has_normal(points, t)) continue;
      faces.push_back({static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                       static_cast<std::size_t>(t[2])});
    }
    oracle.add_triangle_soup(points, faces);
  }
  return oracle;
}

/// A scan in units of its box's diagonal, about the box's middle.
struct LocalScan {
  std::vector<Kernel::Point_3> points;
  const std::vector<Triangle>& triangles;  ///< none: the points are wrapped
  double area = 0.0;
};

IndexedMesh mesh_of(const Wrap& wrap) {
  IndexedMesh mesh;
  std::vector<std::int32_t> number(wrap.number_of_vertices() + wrap.number_of_removed_vertices());
  for (const auto v : wrap.vertices()) {
    number[v] = static_cast<std::int32_t>(mesh.points.size());
    const Kernel::Point_3& p = wrap.point(v);
    mesh.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto face : wrap.faces()) {
    Triangle t;
    std::size_t k = 0;
    for (const auto v : wrap.vertices_around_face(wrap.halfedge(face))) t[k++] = number[v];
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// `opening`: in the scan's unit.
IndexedMesh wrap_of(const LocalScan& scan, double opening, const Execution& execution) {
  // Distance of the wrap from the scan / opening. A smaller one takes several times as long.
  constexpr double offset_share = 0.1;
  // CGAL's alpha is the radius of the empty balls that form the outside.
  const double alpha = 0.5 * opening;
  const double offset = offset_share * opening;
  return mesh_of(scan.triangles.empty()
                     ? alpha_wrap(PointOracle(scan.points), alpha, offset, execution)
                     : alpha_wrap(oracle_of(scan.points, scan.triangles, alpha, execution), alpha,
                                  offset, execution));
}

/// Whether a wrap follows both sides of a scan's faces, because it went in through a hole: a shell.
/// Faces with gaps between them have less area than their wrap too, but that is a body.
bool is_shell(const IndexedMesh& wrap, const LocalScan& scan, double opening,
              const Execution& execution) {
  if (scan.triangles.empty()) return false;
  // Of a sand grain with holes, wrapped at openings of 2 to 10 %: 1.9 to 2.0 times its area, a
  // twenty-fifth to a tenth of the opening thick. Of the same grain without: 1.0 times.
  constexpr double least_area_ratio = 1.5;
  constexpr double most_thickness = 0.25;  // of the opening
  const MeshSums sums = mesh_sums(wrap.points, wrap.triangles, Vector3::Zero(), execution);
  return sums.area() > least_area_ratio * scan.area &&
         sums.volume() < most_thickness * opening * 0.5 * sums.area();
}

/// Refuses a shell, with a larger opening that was tried and is enough.
[[noreturn]] void refuse_shell(const LocalScan& scan, double opening_percent,
                               const Execution& execution) {
  const Sentence text = "The shrink-wrap went into the scan through a hole wider than " +
                        format_percent(0.01 * opening_percent) +
                        " of the bounding-box diagonal, so it is a shell. ";
  for (const double times : {2.0, 3.0, 5.0, 10.0, 20.0}) {
    const double larger = times * opening_percent;
    if (larger > shrink_wrap_option.maximum) break;
    const double opening = 0.01 * larger;
    if (is_shell(wrap_of(scan, opening, execution), scan, opening, execution)) continue;
    refuse(text + "An opening of " + format_percent(opening) + " was tried and closes it: use " +
           mention(shrink_wrap_option, larger) + ".");
  }
  refuse(text + "Close the hole first, " + where_meshlab_closes() + ".");
}

}  // namespace

void check_shrink_wrap_options(const ShrinkWrapOptions& options) {
  require_in_range(options.opening_percent, shrink_wrap_option);
  if (options.opening_percent > 0.0 && options.opening_percent < smallest_opening_percent) {
    refuse("The " + std::string(shrink_wrap_option.subject) + " is " +
           format_number(options.opening_percent) + ". Give 0 or " +
           format_number(smallest_opening_percent) + " to " +
           format_number(shrink_wrap_option.maximum) + ".");
  }
}

IndexedMesh shrink_wrap_of(IndexedMesh scan, const ShrinkWrapOptions& options,
                           const Execution& execution) {
  check_shrink_wrap_options(options);
  const bool of_points = scan.triangles.empty();
  Eigen::AlignedBox3d box;
  if (of_points) {
    scan.points = different_points(std::move(scan.points), execution);
    box = box_of(scan.points);
  } else {
    keep_usable_faces(scan);
    box = box_of_faces(scan);
  }
  check_scan_size(box.sizes());
  if (!(options.opening_percent > 0.0) || !(box.diagonal().norm() > 0.0)) {
    refuse_nothing();
  }
  execution.report(0.0, shrink_wrap_stage);
  // Uses units of the diagonal about the middle, so that digits do not depend on position and size.
  const double unit = box.diagonal().norm();
  const Vector3 middle = box.center();
  LocalScan local{{}, scan.triangles};
  local.points.reserve(scan.points.size());
  for (const Vector3& p : scan.points) {
    const Vector3 place = (p - middle) / unit;
    local.points.emplace_back(place.x(), place.y(), place.z());
  }
  local.area = mesh_sums(scan.points, scan.triangles, middle, execution).area() / (unit * unit);
  const double opening = 0.01 * options.opening_percent;
  IndexedMesh result = wrap_of(local, opening, execution);
  if (is_shell(result, local, opening, execution)) {
    refuse_shell(local, options.opening_percent, execution);
  }
  execution.report(1.0, shrink_wrap_stage);
  for (Vector3& p : result.points) p = middle + unit * p;
  return result;
}

}  // namespace wscvt
