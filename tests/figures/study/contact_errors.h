// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "toolbox/exchange/distance_grid.h"
#include "toolbox/exchange/node_table.h"
#include "wscvt/base/execution.h"
#include "wscvt/remesh.h"

namespace wscvt::study {

/// A mean over contacts, and the standard deviation about it.
struct MeanAndScatter {
  double mean = 0.0;
  double scatter = 0.0;
};

/// What a contact law that sees a grain by its nodes makes of it, against what the scan itself
/// would. Lengths are in % of the equivalent radius; below 0 the grain comes nearer than it could,
/// which is overlap that the nodes hide.
struct ContactErrors {
  /// First contact of the nodes with the surface of an equal grain, as the centres near each other
  /// along a random line in random poses.
  MeanAndScatter grain;
  /// The same where the nodes of both are looked at and the first to touch decides.
  MeanAndScatter both;
  /// First contact of the nodes with a plane.
  MeanAndScatter plane;
  // At a true overlap of 1 % of the radius, grain on grain:
  MeanAndScatter deepest_force;  ///< overlap of the deepest node / the true one
  MeanAndScatter area_force;     ///< |sum of area x overlap x normal| over the nodes / the true one
  double missed = 0.0;           ///< % of these contacts that no node sees
};

/// A grain of equivalent radius 1 in its principal frame, and contacts in which nodes are tried.
/// The scan's vertices and the middles of its edges stand for its surface, against the distances of
/// a grid.
class ContactGrain {
 public:
  /// `scan` is checked (see check_mesh), star-shaped, in its principal frame and with an equivalent
  /// radius of 1. `contacts` poses, always the same ones of the same `series`.
  ContactGrain(const IndexedMesh& scan, std::size_t contacts, const Execution& execution,
               std::uint64_t series = 0);

  /// Of nodes in the scan's frame.
  ContactErrors errors(const NodeTable& nodes, const Execution& execution) const;

  /// Nodes moved, each in all three directions, to where the sum of squares of the error of first
  /// contact with an equal grain is least over these very contacts: what no choice of places that
  /// knows them less can be expected to beat. Thirty Gauss-Newton steps; the best seen.
  std::vector<Vector3> fitted_to_contacts(std::vector<Vector3> nodes,
                                          const Execution& execution) const;

 private:
  /// Two grains that near each other: the second is `second` turned into the first one's frame and
  /// comes against `direction`.
  struct Contact {
    Eigen::Matrix3d turn;   ///< of the first grain's frame into the second's
    Vector3 direction;      ///< from the first to the second, in the first one's frame
    double distance = 0.0;  ///< of the centres as nodes of the first touch the second's surface
    double back = 0.0;      ///< as nodes of the second touch the first's
    double plane = 0.0;     ///< reach of the first along `direction`
    double deepest = 0.0;   ///< overlaps at 1 % of the radius past `distance`
    double area_sum = 0.0;
  };

  /// The distance of the centres at first contact, and the node.
  struct Touch {
    double distance = 0.0;
    std::size_t node = 0;
  };
  Touch first_touch(const std::vector<Vector3>& nodes, const Eigen::Matrix3d& turn,
                    const Vector3& direction) const;
  double touching_distance(const std::vector<Vector3>& nodes, const Eigen::Matrix3d& turn,
                           const Vector3& direction) const {
    return first_touch(nodes, turn, direction).distance;
  }
  void forces(const NodeTable& nodes, const Contact& contact, double& deepest,
              double& area_sum) const;

  DistanceGrid field_;
  double reach_ = 0.0;  ///< of the grain from its centre
  std::vector<Contact> contacts_;
};

/// The scan in its principal frame with an equivalent radius of 1, as ContactGrain wants it.
IndexedMesh unit_scan(const IndexedMesh& scan, const Execution& execution);

/// A way to choose nodes, as the contact study compares them.
struct ContactSampling {
  std::string name;
  RemeshOptions options;
};

/// As published, with nodes on the scan: WSCVT-D, WSCVT-C, constant, Fibonacci. By the method on
/// the scan: nodes on it, fitted, fitted closely, and contact fits of an edge ratio of 1.4, with
/// their radius, for nodes against another grain's surface, nodes of both, and flat walls.
std::vector<ContactSampling> contact_samplings();

}  // namespace wscvt::study
