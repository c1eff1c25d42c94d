// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/first_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

namespace {

constexpr double passing = -1e20;  ///< below it, bodies pass each other
constexpr float nothing = -1e30F;  ///< height without a body

/// Returns uniform random rotations (Shoemake 1992). Uses only the generator's bits, because the
/// standard does not fix the results of its distributions.
std::vector<Eigen::Matrix3d> random_turns(int count) {
  std::mt19937_64 random(1);
  const auto uniform = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  std::vector<Eigen::Matrix3d> turns;
  for (int i = 0; i < count; ++i) {
    const double u = uniform();
    const double v = 2.0 * pi * uniform();
    const double w = 2.0 * pi * uniform();
    const double a = std::sqrt(1.0 - u);
    const double b = std::sqrt(u);
    turns.push_back(Eigen::Quaterniond(b * portable::cos(w), a * portable::sin(v),
                                       a * portable::cos(v), b * portable::sin(w))
                        .toRotationMatrix());
  }
  return turns;
}

/// The pixels with their centres between two positions along an axis; positions in pixels.
struct PixelSpan {
  int first;
  int last;
  PixelSpan(double from, double to)
      : first(std::max(0, static_cast<int>(std::ceil(from - 0.5)))),
        last(std::min(ContactHeights::pixels - 1, static_cast<int>(std::floor(to - 0.5)))) {}
};

/// The pixels of one pose.
class HeightMap {
 public:
  HeightMap(double reach, std::vector<float>& top, std::vector<float>& bottom)
      : scale_(0.5 * ContactHeights::pixels / reach), top_(top), bottom_(bottom) {
    const std::size_t count = std::size_t{ContactHeights::pixels} * ContactHeights::pixels;
    top_.assign(count, nothing);
    bottom_.assign(count, -nothing);
  }

  void add_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
    const std::array<double, 3> x = {place(a.x()), place(b.x()), place(c.x())};
    const std::array<double, 3> y = {place(a.y()), place(b.y()), place(c.y())};
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    if (area == 0.0) return;
    const PixelSpan rows(std::min({y[0], y[1], y[2]}), std::max({y[0], y[1], y[2]}));
    const PixelSpan columns(std::min({x[0], x[1], x[2]}), std::max({x[0], x[1], x[2]}));
    for (int row = rows.first; row <= rows.last; ++row) {
      for (int column = columns.first; column <= columns.last; ++column) {
        const double px = column + 0.5;
        const double py = row + 0.5;
        const double u = ((x[2] - x[1]) * (py - y[1]) - (y[2] - y[1]) * (px - x[1])) / area;
        const double v = ((x[0] - x[2]) * (py - y[2]) - (y[0] - y[2]) * (px - x[2])) / area;
        if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) continue;
        add(row, column, u * a.z() + v * b.z() + (1.0 - u - v) * c.z());
      }
    }
  }

  void add_sphere(const Vector3& centre, double radius) {
    const PixelSpan rows(place(centre.y() - radius), place(centre.y() + radius));
    const PixelSpan columns(place(centre.x() - radius), place(centre.x() + radius));
    for (int row = rows.first; row <= rows.last; ++row) {
      const double dy = way(row) - centre.y();
      for (int column = columns.first; column <= columns.last; ++column) {
        const double dx = way(column) - centre.x();
        const double squared = radius * radius - dx * dx - dy * dy;
        if (!(squared > 0.0)) continue;
        const double height = std::sqrt(squared);
        add(row, column, centre.z() + height);
        add(row, column, centre.z() - height);
      }
    }
  }

 private:
  double place(double way) const { return scale_ * way + 0.5 * ContactHeights::pixels; }
  double way(int pixel) const { return (pixel + 0.5 - 0.5 * ContactHeights::pixels) / scale_; }
  void add(int row, int column, double height) {
    const std::size_t pixel =
        static_cast<std::size_t>(row) * ContactHeights::pixels + static_cast<std::size_t>(column);
    const auto value = static_cast<float>(height);
    top_[pixel] = std::max(top_[pixel], value);
    bottom_[pixel] = std::min(bottom_[pixel], value);
  }

  double scale_;
  std::vector<float>& top_;
  std::vector<float>& bottom_;
};

}  // namespace

template <class Draw>
void ContactHeights::draw_poses(const Execution& execution, const Draw& draw) {
  const std::vector<Eigen::Matrix3d> turns = random_turns(poses);
  maps_.resize(turns.size());
  execution.parallel_for_each(turns.size(), 1, [&](std::size_t pose) {
    HeightMap map(reach_, maps_[pose].top, maps_[pose].bottom);
    draw(turns[pose], map);
  });
}

ContactHeights::ContactHeights(const IndexedMesh& mesh, double reach, const Execution& execution)
    : reach_(reach) {
  draw_poses(execution, [&](const Eigen::Matrix3d& turn, HeightMap& map) {
    std::vector<Vector3> turned;
    turned.reserve(mesh.points.size());
    for (const Vector3& p : mesh.points) turned.push_back(turn * p);
    for (const auto& [a, b, c] : mesh.triangles) {
      map.add_triangle(turned[a], turned[b], turned[c]);
    }
  });
}

ContactHeights::ContactHeights(const std::vector<Sphere>& spheres, double reach,
                               const Execution& execution)
    : reach_(reach) {
  draw_poses(execution, [&](const Eigen::Matrix3d& turn, HeightMap& map) {
    for (const Sphere& sphere : spheres) map.add_sphere(turn * sphere.centre, sphere.radius);
  });
}

namespace {

float largest_sum(const std::vector<float>& top, const std::vector<float>& bottom) {
  // Eight maxima, which the compiler updates at once.
  std::array<float, 8> largest;
  largest.fill(nothing);
  for (std::size_t i = 0; i < top.size(); i += largest.size()) {
    for (std::size_t lane = 0; lane < largest.size(); ++lane) {
      const float sum = top[i + lane] - bottom[i + lane];
      largest[lane] = sum > largest[lane] ? sum : largest[lane];
    }
  }
  return *std::max_element(largest.begin(), largest.end());
}

/// Returns the slopes of a map's heights along x and y at a pixel, per pixel; at the body's rim
/// only towards the inside.
std::array<double, 2> slopes_at(const std::vector<float>& heights, std::size_t pixel) {
  constexpr std::size_t pixels = ContactHeights::pixels;
  const std::array<std::size_t, 2> strides = {1, pixels};
  const std::array<std::size_t, 2> places = {pixel % pixels, pixel / pixels};
  std::array<double, 2> slopes{};
  const auto is_body = [&](std::size_t at) { return std::abs(heights[at]) < -nothing; };
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::size_t stride = strides[axis];
    const std::size_t from = places[axis] > 0 && is_body(pixel - stride) ? pixel - stride : pixel;
    const std::size_t to =
        places[axis] + 1 < pixels && is_body(pixel + stride) ? pixel + stride : pixel;
    if (from == to) continue;
    slopes[axis] = (static_cast<double>(heights[to]) - static_cast<double>(heights[from])) *
                   static_cast<double>(stride) / static_cast<double>(to - from);
  }
  return slopes;
}

}  // namespace

std::pair<std::size_t, std::size_t> ContactHeights::poses_of(std::size_t pair) const {
  const std::size_t count = maps_.size();
  const std::size_t below = pair / (count - 1);
  return {below, (below + 1 + pair % (count - 1)) % count};
}

std::vector<double> ContactHeights::distances(const Execution& execution) const {
  std::vector<double> result(maps_.size() * (maps_.size() - 1));
  execution.parallel_for_each(result.size(), 16, [&](std::size_t pair) {
    const auto [below, above] = poses_of(pair);
    result[pair] = largest_sum(maps_[below].top, maps_[above].bottom);
  });
  return result;
}

std::vector<FirstTouch> ContactHeights::touches(const ContactHeights& other,
                                                const Execution& execution) const {
  std::vector<FirstTouch> result(maps_.size() * (maps_.size() - 1));
  constexpr std::size_t side = pixels;
  const double scale = 2.0 * reach_ / pixels;
  execution.parallel_for_each(result.size(), 16, [&](std::size_t pair) {
    const auto [below, above] = poses_of(pair);
    const std::vector<float>& top = maps_[below].top;
    const std::vector<float>& bottom = other.maps_[above].bottom;
    const float largest = largest_sum(top, bottom);
    FirstTouch& touch = result[pair];
    touch.distance = largest;
    touch.touches = touch.distance > passing;
    if (!touch.touches) return;
    std::size_t pixel = 0;
    while (top[pixel] - bottom[pixel] != largest) ++pixel;
    const auto way = [&](std::size_t place) {
      return (static_cast<double>(place) + 0.5 - 0.5 * pixels) * scale;
    };
    touch.place = Vector3(way(pixel % side), way(pixel / side), top[pixel]);
    for (const std::vector<float>* heights : {&top, &bottom}) {
      const std::array<double, 2> slopes = slopes_at(*heights, pixel);
      touch.normal += Vector3(-slopes[0] / scale, -slopes[1] / scale, 1.0).normalized();
    }
    touch.normal.normalize();
  });
  return result;
}

ContactError contact_error(const std::vector<double>& distances, const std::vector<double>& scan) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const bool both_touch = distances[i] > passing && scan[i] > passing;
    if (both_touch) errors.push_back(100.0 * (distances[i] - scan[i]));
  }
  ContactError error;
  const auto count = static_cast<double>(errors.size());
  for (const double one : errors) error.mean += one / count;
  double squares = 0.0;
  for (const double one : errors) squares += (one - error.mean) * (one - error.mean);
  if (!errors.empty()) error.scatter = std::sqrt(squares / count);
  return error;
}

namespace {

ContactSpread spread_of(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  if (errors.empty()) return {};
  return {quantile(errors, 0.5), quantile(errors, 0.9)};
}

}  // namespace

TouchErrors touch_errors(const std::vector<FirstTouch>& touches,
                         const std::vector<FirstTouch>& scan) {
  std::vector<double> gaps;
  std::vector<double> places;
  std::vector<double> normals;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (!touches[i].touches || !scan[i].touches) continue;
    gaps.push_back(100.0 * std::abs(touches[i].distance - scan[i].distance));
    places.push_back(100.0 * (touches[i].place - scan[i].place).norm());
    const double cosine = touches[i].normal.dot(scan[i].normal);
    normals.push_back(180.0 / pi * portable::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  return {spread_of(std::move(gaps)), spread_of(std::move(places)), spread_of(std::move(normals))};
}

namespace {

/// A remesh of few nodes extends farther than the scan.
constexpr double room = 1.2;

}  // namespace

ScanContacts::ScanContacts(const IndexedMesh& scan, const ShapeDescriptors& shape,
                           const Execution& execution)
    : frame_(shape) {
  const IndexedMesh unit = frame_.to_unit(scan);
  for (const Vector3& p : unit.points) reach_ = std::max(reach_, room * p.norm());
  heights_.emplace(unit, reach_, execution);
  touches_ = heights_->touches(*heights_, execution);
}

ScanContacts::Errors ScanContacts::errors_of(const IndexedMesh& remesh,
                                             const Execution& execution) const {
  const auto distances = [](const std::vector<FirstTouch>& touches) {
    std::vector<double> list;
    list.reserve(touches.size());
    for (const FirstTouch& one : touches) list.push_back(one.distance);
    return list;
  };
  const ContactHeights heights(frame_.to_unit(remesh), reach_, execution);
  const std::vector<FirstTouch> touches = heights.touches(heights, execution);
  return {contact_error(distances(touches), distances(touches_)), touch_errors(touches, touches_),
          touch_errors(heights.touches(*heights_, execution), touches_)};
}

}  // namespace wscvt
