// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fabric/fabric.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "toolbox/fabric/contact_lines.h"
#include "toolbox/volume/label_census.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

constexpr double degree = pi / 180.0;

Vector3 vector_of(const std::array<std::int64_t, 3>& numbers) {
  return {static_cast<double>(numbers[0]), static_cast<double>(numbers[1]),
          static_cast<double>(numbers[2])};
}

/// The lattice of voxels, in length.
struct Lattice {
  Eigen::Matrix3d axes;        ///< columns
  Eigen::Matrix3d directions;  ///< the axes, with length 1
  Vector3 sizes;               ///< of a voxel along the axes
  Eigen::Matrix3d faces;       ///< area vector of the face across each axis, along the axis
  double volume;               ///< of a voxel
  double size;                 ///< of a cube with this volume

  explicit Lattice(const VolumeGeometry& geometry)
      : axes(geometry.axes),
        sizes(axes.colwise().norm()),
        volume(geometry.voxel_volume()),
        size(portable::cbrt(volume)) {
    directions = axes * sizes.cwiseInverse().asDiagonal();
    const double turn = axes.determinant() < 0.0 ? -1.0 : 1.0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      faces.col(k) = turn * axes.col((k + 1) % 3).cross(axes.col((k + 2) % 3));
    }
  }

  Vector3 area_vector(const std::array<std::int64_t, 3>& lines) const {
    const Vector3 counts = vector_of(lines);
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) sum += counts[k] * faces.col(k);
    return sum;
  }
};

/// A plane through points: their mean and principal variances.
struct PointPlane {
  double count = 0.0;
  Vector3 mean = Vector3::Zero();       ///< from the pair's origin
  Vector3 normal = Vector3::Zero();     ///< zero: no plane fits
  Vector3 variances = Vector3::Zero();  ///< ascending
  double unseen = 0.0;                  ///< variance within a voxel along the normal
};

/// `across`: how many of the points are middles of faces or gaps across each axis.
PointPlane plane_of(const PointSums& sums, const Vector3& across, const Lattice& lattice) {
  PointPlane plane;
  plane.count = static_cast<double>(sums.count);
  if (sums.count == 0) return plane;
  const auto p = [&](std::size_t k) { return static_cast<double>(sums.products[k]); };
  Eigen::Matrix3d products;
  products << p(0), p(3), p(4), p(3), p(1), p(5), p(4), p(5), p(2);
  const Vector3 mean = vector_of(sums.sum) / plane.count;
  const Eigen::Matrix3d halves = products / plane.count - mean * mean.transpose();
  plane.mean = 0.5 * (lattice.axes * mean);
  const Eigen::Matrix3d covariance = 0.25 * (lattice.axes * halves * lattice.axes.transpose());
  // A middle across an axis is within half a voxel of the wall along this axis, not along the
  // normal: with long voxels the plane of the middles is turned by it.
  Eigen::Matrix3d steps = Eigen::Matrix3d::Zero();
  const double all = across.sum();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vector3 axis = lattice.axes.col(k);
    if (all > 0.0) steps += across[k] / (12.0 * all) * axis * axis.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance - steps);
  const Vector3 least = solver.eigenvectors().col(0);
  plane.variances = solver.eigenvalues().cwiseMax(0.0);
  // Lines in step meet a wall at the same place, and tell nothing of how far it is within a voxel.
  plane.unseen = (lattice.axes.transpose() * least).cwiseAbs2().maxCoeff() / 12.0;
  plane.variances[0] = std::max(least.dot(covariance * least), plane.unseen);
  // Points on a line, or in a heap, have no plane.
  constexpr std::int64_t fewest = 6;
  constexpr double flat = 4.0;
  if (sums.count >= fewest && plane.variances[1] > flat * plane.variances[0]) {
    plane.normal = least;
  }
  return plane;
}

/// Standard uncertainty of the normal of a plane through points, if every `together` of them are
/// shifted by one error. Of a wall that is bent, or of several walls, the middles are farther from
/// the plane than voxels tell: a tenth of that is an error of all points. The tenth was fitted on
/// bumps and pairs of balls, so that the uncertainty is the error's root mean square.
double plane_uncertainty(const PointPlane& plane, double together) {
  constexpr double in_common = 0.1;
  const double between =
      plane.variances[0] * together / plane.count + in_common * (plane.variances[0] - plane.unseen);
  return std::sqrt(between / plane.variances[1] + between / plane.variances[2]) / degree;
}

/// Width of the gap at which labels of `wscvt segment` cease to touch, from the standard deviation
/// of the scan's blur; both in sizes of a voxel. Without any blur the median and the mean of 27
/// voxels close a gap. segment moves curved surfaces back, so that the width does not depend on the
/// grains' curvature. Both constants were fitted to packings of known contacts, see
/// tests/figures/study/fabric.md.
double closing_gap(double blur) {
  constexpr double of_filters = 1.1;
  constexpr double of_blur = 0.92;
  const auto fourth = [](double x) { return x * x * x * x; };
  return std::sqrt(std::sqrt(fourth(of_filters) + fourth(of_blur * blur)));
}

/// A grain as a contact sees it.
struct Partner {
  double radius = 0.0;  ///< of the ball with its volume
  double reach = 0.0;   ///< from its centre to the contact, along the normal; 0: it is cut

  /// Radius of curvature at a contact of this area. A grain is flat where its surface is near to
  /// its centre and pointed where it is far: an ellipsoid has the curvature of a ball whose radius
  /// is R^3 / H^2, R the radius of its volume and H the distance of its tangent plane.
  double curvature(double area) const {
    if (reach <= 0.0) return radius;
    const double cap = std::max(0.0, area) / (2.0 * pi * radius);
    const double ratio = std::clamp(radius / (reach + cap), 0.6, 1.6);
    return radius * ratio * ratio;
  }
};

double harmonic_mean(double a, double b) { return 2.0 * a * b / (a + b); }

/// Measures one pair.
class PairMeasure {
 public:
  PairMeasure(const LabelPair& pair, const Lattice& lattice, const std::optional<double>& blur)
      : pair_(pair), lattice_(lattice), blur_(blur), vector_(lattice.area_vector(pair.lines[0])) {}

  void measure(FabricContact& contact, const FabricGrain& first, const FabricGrain& second) const {
    contact.faces = static_cast<std::size_t>(pair_.faces.count);
    contact.raw_area = vector_.norm();
    const PointPlane faces = plane_of(pair_.faces, across(0, 0), lattice_);
    const Vector3 origin = 0.5 * vector_of(pair_.origin);
    contact.centre += lattice_.axes * origin + faces.mean;
    // The middles of the faces are a sample of the contact.
    contact.centre_uncertainty =
        std::sqrt((faces.variances.sum() + lattice_.size * lattice_.size / 12.0) / faces.count);
    set_normal(contact);
    if (set_closed(contact)) return;
    const auto partner = [&](const FabricGrain& grain) {
      const double reach = std::abs((contact.centre - grain.centre).dot(contact.normal));
      return Partner{equivalent_radius(grain.volume), grain.at_border ? 0.0 : reach};
    };
    set_area(contact, partner(first), partner(second));
  }

 private:
  /// The lines with gaps of these widths along each axis.
  Vector3 across(std::size_t narrowest, std::size_t widest) const {
    Vector3 count = Vector3::Zero();
    for (std::size_t gap = narrowest; gap <= widest; ++gap) {
      count += vector_of(pair_.lines[gap]).cwiseAbs();
    }
    return count;
  }

  /// Exact labels: the plane through the faces and through the middles of gaps of one voxel.
  /// Labels of a scan: faces wander where a watershed cuts a neck. The mean of two directions whose
  /// errors differ: the area vector, which only the rim decides, and the plane through the middles
  /// of the gaps around it, which only the grains' surfaces decide.
  void set_normal(FabricContact& contact) const {
    const Vector3 branch = contact.branch.normalized();
    const Vector3 area = contact.raw_area > 0.0 ? Vector3(vector_ / contact.raw_area) : branch;
    PointSums sums = pair_.around;
    if (!blur_) {
      sums = pair_.faces;
      sums += pair_.beside;
    }
    const PointPlane plane = plane_of(sums, blur_ ? across(1, widest_gap) : across(0, 1), lattice_);
    const auto faces = static_cast<double>(contact.faces);
    // One face may be off by a step of a voxel over its width, and so may the rim, which is beside
    // the gaps of a voxel; its 20 degrees were fitted on made pairs.
    const double of_area = contact.raw_area > 0.0
                               ? std::min(45.0, portable::hypot(30.0 / std::sqrt(faces),
                                                                20.0 * pair_.beside.count / faces))
                               : 90.0;
    const double of_plane = plane_uncertainty(plane, blur_ ? 9.0 : 1.0);
    if (plane.normal.isZero() || (!blur_ && of_area < of_plane)) {
      contact.normal = area;
      contact.normal_uncertainty = of_area;
      return;
    }
    const Vector3 normal = plane.normal.dot(area) < 0.0 ? Vector3(-plane.normal) : plane.normal;
    contact.normal = blur_ ? Vector3((normal + area).normalized()) : normal;
    contact.normal_uncertainty = of_plane;
  }

  /// Whether the wall closes on itself: its faces' area vectors nearly cancel each other, and few
  /// gaps are around it.
  bool set_closed(FabricContact& contact) const {
    const Vector3 counts = vector_of(pair_.faces_across);
    double all = 0.0;
    for (Eigen::Index k = 0; k < 3; ++k) all += counts[k] * lattice_.faces.col(k).norm();
    // A cube of two voxels has 24 faces. Of a plane wall at least .58 of the faces' area is
    // projected, of half a sphere .33.
    constexpr std::size_t fewest = 24;
    constexpr double most = 0.3;
    contact.is_closed = contact.faces >= fewest && contact.raw_area < most * all &&
                        pair_.faces.count > pair_.around.count;
    if (!contact.is_closed) return false;
    contact.is_contact = true;
    contact.area = 2.0 / 3.0 * all;
    // Of walls that are more along the axes than others.
    constexpr double shape = 0.1;
    contact.area_uncertainty = shape * contact.area;
    contact.normal_uncertainty = 90.0;
    return true;
  }

  void set_area(FabricContact& contact, const Partner& first, const Partner& second) const {
    const Vector3& n = contact.normal;
    double mean = 0.0;  // of the lengths of voxels along the normal, weighted as the lines are
    double square = 0.0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double along = std::abs(lattice_.directions.col(k).dot(n)) * lattice_.sizes[k];
      const double weight = lattice_.sizes[k] * lattice_.faces.col(k).dot(n) *
                            lattice_.directions.col(k).dot(n) / lattice_.volume;
      mean += weight * along;
      square += weight * along * along;
    }
    const double touching = vector_.dot(n);
    // A line with a gap of the length L has no voxel in it with the probability 1 - L.
    double width = 0.5 * mean;
    double squared = square / 3.0;
    double from_gap = 0.0;  // radius of curvature
    double radius = harmonic_mean(first.radius, second.radius);
    if (blur_) {
      width = lattice_.size * closing_gap(*blur_ / lattice_.size);
      squared = width * width;
    } else {
      const double ring =
          (lattice_.area_vector(pair_.lines[1]) + lattice_.area_vector(pair_.lines[2])).dot(n);
      from_gap = (ring + 0.25 * pi * 6.0 * square) / (2.0 * pi * mean);
      // Without a gap beside it the contact is a flat wall.
      from_gap = ring > 0.0 ? std::min(from_gap, 3.0 * radius) : 0.0;
    }
    // Between two spheres the area within a gap g grows by pi (c g - g^2 / 4), where c is the
    // radius times the cosine of half the angle that the contact spans.
    double area = touching;
    double ring = 0.0;
    constexpr int steps = 30;
    for (int step = 0; step < steps; ++step) {
      if (blur_) radius = harmonic_mean(first.curvature(area), second.curvature(area));
      const double root = std::sqrt(std::max(0.0, radius * radius - std::max(0.0, area) / pi));
      const double curved = blur_ ? root : std::sqrt(root * from_gap);
      ring = std::max(0.0, pi * (curved * width - 0.25 * squared));
      area = touching - ring;
    }
    contact.area = area;
    contact.is_contact = area > 0.0;
    // Lattice: each line of the ring is cut or not. Lines in step: the gap at which they cease to
    // touch is anywhere between 0 and a voxel; its deviation over its mean is 1 / sqrt(3). Shape: a
    // part of the radius of curvature. In a scan that of angular grains may err by half, which no
    // count of voxels shows; that of round grains by less than a tenth.
    const double shape = blur_ ? 0.3 : 0.1;
    const double step = blur_ ? 0.0 : in_step(n, std::max(touching, 0.0)) / std::sqrt(3.0);
    const double face = lattice_.size * lattice_.size;
    contact.area_uncertainty =
        std::sqrt(0.5 * std::max(ring, face) * face + (shape * shape + step * step) * ring * ring);
  }

  /// The part of a line's error that the lines around a contact of this area share, 0 to 1. If the
  /// normal is along an axis or a diagonal of the lattice, all lines meet the gap at the same place
  /// between two voxels. Otherwise the place goes round between neighbouring lines: its mean over a
  /// circle of the radius a is J0(2 pi a q), q turns per length, and J0(x)^2 is about
  /// 1 / (1 + x^2 / 2).
  double in_step(const Vector3& n, double area) const {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double along = lattice_.axes.col(k).dot(n);
      const double weight = lattice_.faces.col(k).dot(n) * along / lattice_.volume;
      if (std::abs(along) < 1e-6 * lattice_.size) continue;
      double square = 0.0;  // of q
      for (const Eigen::Index other : {(k + 1) % 3, (k + 2) % 3}) {
        const double turns = lattice_.axes.col(other).dot(n) / along;
        const double rest = (turns - std::round(turns)) / lattice_.sizes[other];
        square += rest * rest;
      }
      sum += weight / std::sqrt(1.0 + 2.0 * pi * area * square);
    }
    return sum;
  }

  const LabelPair& pair_;
  const Lattice& lattice_;
  const std::optional<double>& blur_;
  Vector3 vector_;  ///< area of the faces
};

FabricGrain grain_of(const LabelSums& sums, const VolumeGeometry& geometry) {
  FabricGrain grain;
  grain.label = sums.label;
  grain.voxels = sums.voxels;
  grain.volume = static_cast<double>(sums.voxels) * geometry.voxel_volume();
  grain.centre = geometry.point(vector_of(sums.middles) / (2.0 * static_cast<double>(sums.voxels)));
  grain.at_border = sums.at_border;
  return grain;
}

void require_two(const std::vector<LabelSums>& labels, double background) {
  if (labels.size() > 1) return;
  const std::string text = std::isnan(background) ? "nan" : format_number(background, 17);
  if (labels.empty()) {
    refuse("The volume has no label except the background, " + text + ". Check it, or give " +
           mention("background") + ".");
  }
  refuse("The volume has one label, " + std::to_string(labels[0].label) +
         ", and a contact needs two. Is it a mask? Then wscvt segment labels its grains.");
}

void add_areas(Fabric& fabric) {
  double squares = 0.0;
  double rings = 0.0;
  for (const FabricContact& contact : fabric.contacts) {
    if (!contact.is_contact) continue;
    fabric.contact_area += contact.area;
    squares += contact.area_uncertainty * contact.area_uncertainty;
    if (!contact.is_closed) rings += contact.raw_area - contact.area;
  }
  // By so much the widths of rings erred in packings of known contacts.
  constexpr double of_width = 0.06;
  const double in_common = of_width * rings;
  fabric.contact_area_uncertainty = std::sqrt(squares + in_common * in_common);
}

void add_statistics(Fabric& fabric) {
  add_areas(fabric);
  for (const FabricContact& contact : fabric.contacts) {
    for (const std::size_t k : {contact.first, contact.second}) {
      FabricGrain& grain = fabric.grains[k];
      ++grain.touching;
      if (!contact.is_contact) continue;
      ++grain.contacts;
      grain.contact_area += contact.area;
    }
    if (!contact.is_contact) continue;
    ++fabric.contact_count;
    if (contact.is_closed) {
      ++fabric.closed_count;
      continue;
    }
    fabric.tensor += contact.normal * contact.normal.transpose();
    const Vector3 along = contact.branch.normalized();
    fabric.branch_tensor += along * along.transpose();
  }
  if (const std::size_t open = fabric.contact_count - fabric.closed_count; open > 0) {
    fabric.tensor /= static_cast<double>(open);
    fabric.branch_tensor /= static_cast<double>(open);
  }
  std::size_t ends = 0;
  for (const FabricGrain& grain : fabric.grains) {
    if (grain.at_border) continue;
    ++fabric.whole_grains;
    ends += grain.contacts;
  }
  if (fabric.whole_grains > 0) {
    fabric.coordination = static_cast<double>(ends) / static_cast<double>(fabric.whole_grains);
  }
}

}  // namespace

Fabric measure_fabric(LabelVolume& labels, const FabricOptions& options,
                      const Execution& execution) {
  labels.set_background(options.background);
  Label background = background_label(options.background);
  const Execution counting = execution.part(0.0, options.scan == nullptr ? 1.0 : 0.4);
  ContactLines lines;
  try {
    lines = contact_lines(labels, background, counting);
  } catch (const LargeNumber&) {
    labels.number_anew(most_labels);
    background = 0;
    lines = contact_lines(labels, background, counting);
  }
  require_two(lines.labels, options.background);
  Fabric fabric;
  fabric.geometry = labels.geometry();
  fabric.names = labels.names();
  if (options.scan != nullptr) {
    fabric.blur = edge_width(labels, background, *options.scan, execution.part(0.4, 1.0));
  }
  for (const LabelSums& sums : lines.labels) {
    fabric.grains.push_back(grain_of(sums, fabric.geometry));
  }
  const Lattice lattice(fabric.geometry);
  for (const LabelPair& pair : lines.pairs) {
    const FabricGrain& first = fabric.grains[pair.first];
    const FabricGrain& second = fabric.grains[pair.second];
    FabricContact contact;
    contact.first = pair.first;
    contact.second = pair.second;
    contact.at_border = first.at_border || second.at_border;
    contact.branch = second.centre - first.centre;
    contact.centre = fabric.geometry.corner;
    PairMeasure(pair, lattice, fabric.blur).measure(contact, first, second);
    fabric.contacts.push_back(contact);
  }
  add_statistics(fabric);
  return fabric;
}

double anisotropy_of(const Eigen::Matrix3d& tensor) {
  const Eigen::Matrix3d deviator = 7.5 * (tensor - Eigen::Matrix3d::Identity() / 3.0);
  return std::sqrt(1.5) * deviator.norm();
}

}  // namespace wscvt
