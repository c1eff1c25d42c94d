// SPDX-License-Identifier: GPL-3.0-or-later
#include "packing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

#include "marching_cubes.h"

namespace wscvt::test {

namespace {

/// The same on every machine, unlike the distributions of <random>.
class PackingNumbers {
 public:
  explicit PackingNumbers(std::uint64_t seed) : engine_(seed) {}
  double between(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  double normal() {
    return std::sqrt(-2.0 * std::log(1.0 - between(0.0, 1.0))) *
           std::cos(between(0.0, 6.283185307179586));
  }
  Vector3 vector() { return {normal(), normal(), normal()}; }

 private:
  std::mt19937_64 engine_;
};

/// Points on the surface, evenly by their directions in the grain's own frame.
std::vector<Vector3> surface_points(const PackedGrain& grain) {
  constexpr int count = 300;
  std::vector<Vector3> points;
  for (int k = 0; k < count; ++k) {
    const double z = (2.0 * k + 1.0) / count - 1.0;
    const double angle = 2.399963229728653 * k;
    const double r = std::sqrt(1.0 - z * z);
    const Vector3 way =
        grain.half_axes.cwiseProduct(Vector3(r * std::cos(angle), r * std::sin(angle), z));
    const Vector3 turned = grain.turn * way;
    points.push_back(grain.centre + turned / grain.gauge(grain.centre + turned));
  }
  return points;
}

struct Placed {
  PackedGrain grain;
  std::vector<Vector3> points;
  double reach = 0.0;

  void move(const Vector3& way) {
    grain.centre += way;
    for (Vector3& point : points) point += way;
  }
};

Placed placed(const PackedGrain& grain) {
  Placed result{grain, surface_points(grain), 0.0};
  for (const Vector3& point : result.points) {
    result.reach = std::max(result.reach, (point - grain.centre).norm());
  }
  return result;
}

bool overlap(const Placed& a, const Placed& b) {
  if ((a.grain.centre - b.grain.centre).norm() > a.reach + b.reach) return false;
  const auto has_point_in = [](const Placed& one, const PackedGrain& other) {
    return std::any_of(one.points.begin(), one.points.end(),
                       [&](const Vector3& point) { return other.gauge(point) < 1.0; });
  };
  return has_point_in(a, b.grain) || has_point_in(b, a.grain);
}

/// Whether a grain may be where it is; above the box it may.
bool has_room(const Placed& one, const std::vector<Placed>& others, const PackingOptions& options) {
  for (const Vector3& point : one.points) {
    if (point.minCoeff() < options.margin) return false;
    if (point.x() > options.box.x() - options.margin) return false;
    if (point.y() > options.box.y() - options.margin) return false;
  }
  return std::none_of(others.begin(), others.end(),
                      [&](const Placed& other) { return overlap(one, other); });
}

/// Moves a grain down and a little aside, as far as it goes.
Placed settled(Placed one, const std::vector<Placed>& others, const PackingOptions& options,
               PackingNumbers& random) {
  constexpr double finest = 0.05;
  for (double step = one.reach; step > finest; step *= 0.5) {
    for (int failures = 0; failures < 10;) {
      // Straight down first: what touches below touches closely.
      const double aside = failures == 0 ? 0.0 : step;
      Placed next = one;
      next.move({random.between(-aside, aside), random.between(-aside, aside), -step});
      if (has_room(next, others, options)) {
        one = next;
        failures = 0;
      } else {
        ++failures;
      }
    }
  }
  return one;
}

}  // namespace

double PackedGrain::gauge(const Vector3& point) const {
  const Vector3 own = (turn.transpose() * (point - centre)).cwiseAbs().cwiseQuotient(half_axes);
  const double largest = own.maxCoeff();
  if (largest == 0.0) return 0.0;
  return largest * std::pow((own.array() / largest).pow(power).sum(), 1.0 / power);
}

double PackedGrain::volume() const {
  return 8.0 * half_axes.prod() * std::pow(std::tgamma(1.0 + 1.0 / power), 3.0) /
         std::tgamma(1.0 + 3.0 / power);
}

std::vector<PackedGrain> packing(const PackingOptions& options) {
  PackingNumbers random(options.seed);
  std::vector<Placed> grains;
  for (std::size_t k = 0; k < options.count; ++k) {
    PackedGrain grain;
    const double size =
        options.largest - (options.largest - options.smallest) * static_cast<double>(k) /
                              static_cast<double>(std::max<std::size_t>(options.count - 1, 1));
    grain.half_axes = size * Vector3(1.0, random.between(0.75, 1.0), random.between(0.6, 0.75));
    grain.power = random.between(2.0, 3.2);
    Eigen::Quaterniond turn(random.normal(), random.normal(), random.normal(), random.normal());
    grain.turn = turn.normalized().toRotationMatrix();
    Placed lowest;
    constexpr int tries = 4;
    for (int attempt = 0; attempt < tries; ++attempt) {
      const double side = options.margin + 1.3 * size;
      grain.centre = {random.between(side, options.box.x() - side),
                      random.between(side, options.box.y() - side), options.box.z() + 1.3 * size};
      const Placed one = settled(placed(grain), grains, options, random);
      if (attempt == 0 || one.grain.centre.z() < lowest.grain.centre.z()) lowest = one;
    }
    for (const Vector3& point : lowest.points) {
      if (point.z() > options.box.z() - options.margin) {
        throw std::runtime_error("The box is full after " + std::to_string(k) + " grains.");
      }
    }
    grains.push_back(lowest);
  }
  std::vector<PackedGrain> result;
  result.reserve(grains.size());
  for (const Placed& one : grains) result.push_back(one.grain);
  return result;
}

PackedVoxels voxels_of(const std::vector<PackedGrain>& grains, const Vector3& box,
                       const Vector3& spacing) {
  PackedVoxels voxels;
  voxels.spacing = spacing;
  for (Eigen::Index k = 0; k < 3; ++k) {
    voxels.counts[static_cast<std::size_t>(k)] = static_cast<int>(std::lround(box[k] / spacing[k]));
  }
  const auto& n = voxels.counts;
  voxels.share.assign(static_cast<std::size_t>(n[0]) * n[1] * n[2], 0.0);
  voxels.truth.assign(voxels.share.size(), 0);
  std::vector<double> nearest(voxels.share.size(), 1.0);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const PackedGrain& grain = grains[g];
    const double reach = 1.75 * grain.half_axes.maxCoeff();
    const double clear = 0.5 * spacing.norm() / grain.half_axes.minCoeff();
    std::array<int, 3> first{};
    std::array<int, 3> last{};
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      first[axis] = std::max(0, static_cast<int>((grain.centre[k] - reach) / spacing[k]));
      last[axis] = std::min(n[axis], static_cast<int>((grain.centre[k] + reach) / spacing[k]) + 1);
    }
    for (int z = first[2]; z < last[2]; ++z) {
      for (int y = first[1]; y < last[1]; ++y) {
        for (int x = first[0]; x < last[0]; ++x) {
          const auto place = (static_cast<std::size_t>(z) * n[1] + y) * n[0] + x;
          const auto at = [&](double i, double j, double k) {
            return grain.gauge(Vector3(x + i, y + j, z + k).cwiseProduct(spacing));
          };
          const double middle = at(0.5, 0.5, 0.5);
          if (middle < nearest[place]) {
            nearest[place] = middle;
            voxels.truth[place] = static_cast<std::uint32_t>(g + 1);
          }
          int inside = middle < 1.0 ? 27 : 0;
          if (std::abs(middle - 1.0) <= clear) {
            inside = 0;
            for (int sub = 0; sub < 27; ++sub) {
              const double i = sub % 3;
              const double j = sub / 3 % 3;
              const double k = sub / 9;
              if (at((i + 0.5) / 3.0, (j + 0.5) / 3.0, (k + 0.5) / 3.0) < 1.0) ++inside;
            }
          }
          voxels.share[place] = std::min(1.0, voxels.share[place] + inside / 27.0);
        }
      }
    }
  }
  return voxels;
}

std::vector<std::uint32_t> grey_values(const PackedVoxels& voxels, const GreyOptions& options) {
  VoxelGrid grid;
  grid.size = voxels.counts;
  grid.values = voxels.share;
  if (options.blur > 0.0) blur(grid, options.blur);
  PackingNumbers random(options.seed);
  std::vector<std::uint32_t> values;
  values.reserve(grid.values.size());
  for (const double share : grid.values) {
    const double value =
        options.dark + (options.bright - options.dark) * (share + options.noise * random.normal());
    values.push_back(static_cast<std::uint32_t>(std::lround(std::max(0.0, value))));
  }
  return values;
}

PackingFound found_in(const std::vector<std::uint32_t>& labels,
                      const std::vector<PackedGrain>& grains, const PackedVoxels& voxels) {
  std::map<std::uint32_t, std::map<std::uint32_t, std::size_t>> shared;  // by grain, label
  std::map<std::uint32_t, std::size_t> label_voxels;
  std::map<std::uint32_t, std::size_t> grain_voxels;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (labels[k] != 0) ++label_voxels[labels[k]];
    if (voxels.truth[k] != 0) ++grain_voxels[voxels.truth[k]];
    if (labels[k] != 0 && voxels.truth[k] != 0) ++shared[voxels.truth[k]][labels[k]];
  }
  PackingFound found;
  found.labels = label_voxels.size();
  for (const auto& [grain, by_label] : shared) {
    for (const auto& [label, count] : by_label) {
      if (2 * count > grain_voxels[grain] && 2 * count > label_voxels[label]) ++found.one_to_one;
    }
  }
  double truth = 0.0;
  for (const PackedGrain& grain : grains) truth += grain.volume();
  std::size_t all = 0;
  for (const auto& [label, count] : label_voxels) all += count;
  found.volume_bias = static_cast<double>(all) * voxels.spacing.prod() / truth - 1.0;
  return found;
}

}  // namespace wscvt::test
