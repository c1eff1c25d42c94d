// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/contact_fit.h"

// CGAL 6 renamed some of these headers; CGAL 5 has only these names.
#define CGAL_NO_DEPRECATION_WARNINGS
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

namespace {

constexpr std::size_t contact_block = 1024;
constexpr std::size_t balls_per_node = 60;
constexpr std::size_t most_balls = 120000;
constexpr int steps = 30;
/// Fraction of a Gauss-Newton step that is used, because neighbouring nodes take over balls.
constexpr double step_share = 0.6;
/// Damping along the surface, where balls on all sides do not fix a node; of its balls' weight.
constexpr double damping = 0.02;
/// Longest step, in node distances.
constexpr double longest_step = 0.2;
/// Smallest cosine of the angle between a triangle's normal and its normal at the start.
constexpr double smallest_turn_cosine = 0.35;

/// A ball that touches the grain from outside.
struct Ball {
  Vector3 centre;
  double radius;
};

/// Returns balls with centres evenly distributed over the surface at `radius` from the grain.
/// Leaves out centres inside the grain or nearer to another part, as above hollows narrower than
/// the ball.
std::vector<Ball> touching_balls(const IndexedMesh& grain, double radius, std::size_t count,
                                 const Execution& execution) {
  const MeshDistance surface(grain, execution);
  IndexedMesh offset = grain;
  const std::vector<Vector3> normals = vertex_normals(grain.points, grain.triangles);
  for (std::size_t i = 0; i < normals.size(); ++i) offset.points[i] += radius * normals[i];
  const std::vector<Vector3> centres = area_uniform_samples(offset, count);
  const std::vector<double> distances = surface.distances(centres, execution);
  std::vector<char> outside(centres.size(), 0);
  execution.parallel_for_each(centres.size(), contact_block, [&](std::size_t i) {
    // Chords of the offset surface are a little deeper than its vertices.
    constexpr double smallest_share = 0.97;
    outside[i] = distances[i] > smallest_share * radius && !surface.contains(centres[i]) ? 1 : 0;
  });
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (outside[i] != 0) balls.push_back({centres[i], distances[i]});
  }
  return balls;
}

using SearchKernel = CGAL::Simple_cartesian<double>;
using NumberedPoint = std::tuple<SearchKernel::Point_3, std::size_t>;
using PointOf = CGAL::Nth_of_tuple_property_map<0, NumberedPoint>;
using SearchTraits =
    CGAL::Search_traits_adapter<NumberedPoint, PointOf, CGAL::Search_traits_3<SearchKernel>>;
using NearestSearch = CGAL::Orthogonal_k_neighbor_search<SearchTraits>;

/// Returns the node nearest to each ball's centre.
std::vector<std::size_t> nearest_nodes(const std::vector<Vector3>& nodes,
                                       const std::vector<Ball>& balls, const Execution& execution) {
  std::vector<NumberedPoint> points;
  points.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    points.emplace_back(SearchKernel::Point_3(nodes[i].x(), nodes[i].y(), nodes[i].z()), i);
  }
  NearestSearch::Tree tree(points.begin(), points.end());
  tree.build();  // now, because several threads may make the first query
  std::vector<std::size_t> nearest(balls.size());
  execution.parallel_for_each(balls.size(), contact_block, [&](std::size_t b) {
    const Vector3& c = balls[b].centre;
    const NearestSearch search(tree, SearchKernel::Point_3(c.x(), c.y(), c.z()), 1);
    nearest[b] = std::get<1>(search.begin()->first);
  });
  return nearest;
}

/// Equations of a node for the gaps of its balls.
struct NodeEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Vector3 right_side = Vector3::Zero();
  std::size_t balls = 0;
};

/// Returns the sum of squares of the gaps, and the equations of the step that lowers it.
double gaps(const std::vector<Vector3>& nodes, const std::vector<Ball>& balls,
            const std::vector<std::size_t>& nearest, std::vector<NodeEquations>& equations) {
  equations.assign(nodes.size(), {});
  double sum = 0.0;
  for (std::size_t b = 0; b < balls.size(); ++b) {
    const Vector3 from = nodes[nearest[b]] - balls[b].centre;
    const double distance = from.norm();
    if (!(distance > 0.0)) continue;
    const double gap = distance - balls[b].radius;
    const Vector3 direction = from / distance;
    NodeEquations& own = equations[nearest[b]];
    own.matrix += direction * direction.transpose();
    own.right_side -= gap * direction;
    ++own.balls;
    sum += gap * gap;
  }
  return sum;
}

/// Keeps triangles from turning over.
class TriangleGuard {
 public:
  explicit TriangleGuard(const IndexedMesh& mesh) : triangles_(mesh.triangles) {
    for (const Triangle& t : triangles_) {
      normals_.push_back(normal_of(mesh.points, t).normalized());
      upright_.push_back(volume_of(mesh.points, t) > 0.0 ? 1 : 0);
    }
  }

  /// Undoes the steps at triangles that would turn over, until no triangle does.
  void hold_back(const std::vector<Vector3>& nodes, std::vector<Vector3>& moved) const {
    for (bool any = true; any;) {
      any = false;
      for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (is_kept(moved, t)) continue;
        for (const std::int32_t v : triangles_[t]) {
          any = any || moved[v] != nodes[v];
          moved[v] = nodes[v];
        }
      }
    }
  }

 private:
  static Vector3 normal_of(const std::vector<Vector3>& points, const Triangle& t) {
    return doubled_area_normal(points[t[0]], points[t[1]], points[t[2]]);
  }
  static double volume_of(const std::vector<Vector3>& points, const Triangle& t) {
    return six_volumes(points[t[0]], points[t[1]], points[t[2]]);
  }
  bool is_kept(const std::vector<Vector3>& points, std::size_t t) const {
    const Vector3 normal = normal_of(points, triangles_[t]);
    return normal.dot(normals_[t]) >= smallest_turn_cosine * normal.norm() &&
           (upright_[t] == 0 || volume_of(points, triangles_[t]) > 0.0);
  }

  const std::vector<Triangle>& triangles_;
  std::vector<Vector3> normals_;
  std::vector<char> upright_;
};

double node_distance(const IndexedMesh& mesh) {
  double area = 0.0;
  for (const double one : vertex_areas(mesh)) area += one;
  return std::sqrt(area / static_cast<double>(mesh.points.size()));
}

}  // namespace

std::vector<Vector3> fit_to_contacts(const IndexedMesh& mesh, const IndexedMesh& grain,
                                     double ball_radius, const Execution& execution) {
  if (!(ball_radius > 0.0) || !std::isfinite(ball_radius)) {
    refuse("The radius of the balls for the contact fit is " + format_typed(ball_radius) +
           ". Give a number above 0.");
  }
  constexpr const char* stage = "Fitting the nodes to contacts";
  execution.report(0.0, stage);
  const std::size_t count = std::min(balls_per_node * mesh.points.size(), most_balls);
  const std::vector<Ball> balls = touching_balls(grain, ball_radius, count, execution);
  const double longest = longest_step * node_distance(mesh);
  const TriangleGuard guard(mesh);

  std::vector<Vector3> nodes = mesh.points;
  std::vector<Vector3> best = nodes;
  double least = std::numeric_limits<double>::infinity();
  std::vector<NodeEquations> equations;
  for (int step = 0; step <= steps; ++step) {
    execution.report(0.1 + 0.9 * step / steps, stage);
    const double sum = gaps(nodes, balls, nearest_nodes(nodes, balls, execution), equations);
    if (sum < least) {
      least = sum;
      best = nodes;
    }
    std::vector<Vector3> moved = nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const NodeEquations& own = equations[i];
      if (own.balls == 0) continue;
      const Eigen::Matrix3d damped =
          own.matrix + damping * static_cast<double>(own.balls) * Eigen::Matrix3d::Identity();
      Vector3 move = damped.ldlt().solve(own.right_side);
      const double length = move.norm();
      if (length > longest) move *= longest / length;
      moved[i] += step_share * move;
    }
    guard.hold_back(nodes, moved);
    nodes = std::move(moved);
  }
  return best;
}

}  // namespace wscvt
