// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

// The contacts of a packing, from a volume of labels.
//
// Labels touch before grains do: two grains whose gap is narrower than a voxel, or than the blur of
// the scan, share faces of voxels. Their gap widens with the distance from the contact, so a ring
// around a contact touches too. For grains with the radius of curvature r (harmonic mean) and a gap
// that closes at the width w the ring's area is about pi r w. A negative remainder is a gap.
//
// The area is that of the wall's projection along its normal. A wall that closes on itself, as
// around an inclusion, has no projection and no ring: its area is that of the wall, two thirds of
// its faces' area, the mean over all directions, and it has no normal.
//
// Exact labels: w = h / 2 times the sum of |n_k|^3 over the axes k, h the size of a voxel, n the
// normal; .375 h on average. Labels of a blurred scan: w follows from the width of its edges.

struct FabricOptions {
  /// The number between the grains, see LabelVolume::set_background.
  double background = 0.0;
  /// The grey values from which the labels were made, with the same voxels; null: the labels are
  /// taken as exact.
  LabelVolume* scan = nullptr;
};

/// A label of the volume.
struct FabricGrain {
  Label label = 0;
  std::uint64_t voxels = 0;
  double volume = 0.0;               ///< of the voxels; length^3
  Vector3 centre = Vector3::Zero();  ///< of the voxels; the volume's coordinates, length
  bool at_border = false;            ///< it touches the border of the volume, which cuts it
  std::size_t touching = 0;          ///< labels that share a face of a voxel with it
  std::size_t contacts = 0;          ///< those of them that are contacts: its coordination number
  double contact_area = 0.0;         ///< sum over its contacts, corrected; length^2
};

/// Two labels that share at least one face of a voxel. Uncertainties are standard uncertainties,
/// fitted to packings of known contacts.
struct FabricContact {
  std::size_t first = 0;             ///< index of a grain
  std::size_t second = 0;            ///< index of the other, which has the larger label
  bool is_contact = false;           ///< the corrected area is above 0
  bool is_closed = false;            ///< the wall closes on itself, see above
  std::size_t faces = 0;             ///< of voxels that both labels share
  double raw_area = 0.0;             ///< length of the sum of the faces' area vectors; length^2
  double area = 0.0;                 ///< projected, corrected; below 0 for a gap; length^2
  double area_uncertainty = 0.0;     ///< length^2
  Vector3 centre = Vector3::Zero();  ///< of the shared faces; length
  double centre_uncertainty = 0.0;   ///< length
  Vector3 normal = Vector3::Zero();  ///< from the first grain to the second; length 1
  double normal_uncertainty = 0.0;   ///< degrees; 90 without a normal
  Vector3 branch = Vector3::Zero();  ///< from the first grain's centre to the second's; length
  bool at_border = false;            ///< one of the grains touches the border
};

/// Result of measure_fabric.
struct Fabric {
  VolumeGeometry geometry;
  std::map<Label, std::string> names;   ///< the file's names of labels
  std::vector<FabricGrain> grains;      ///< by their labels
  std::vector<FabricContact> contacts;  ///< all pairs that touch, by their labels
  /// Standard deviation of the scan's blur, that of its voxels included; empty without a scan;
  /// length.
  std::optional<double> blur;
  /// Mean of n n^T over the contacts with a normal; trace 1; zero without contacts.
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  /// The same of the branch vectors' directions.
  Eigen::Matrix3d branch_tensor = Eigen::Matrix3d::Zero();
  /// Sum over the contacts, corrected. The width of the ring errs for all of them alike, so that
  /// the sum is less certain than the single uncertainties tell. length^2
  double contact_area = 0.0;
  double contact_area_uncertainty = 0.0;
  std::size_t contact_count = 0;
  std::size_t closed_count = 0;  ///< of them, those that close on themselves
  std::size_t whole_grains = 0;  ///< grains that do not touch the border
  double coordination = 0.0;     ///< mean number of contacts of the whole grains; 0 without any
};

/// Measures the contacts of all labels. Reads the labels once, row by row, and with a scan both
/// once more. Memory: two slices of positions, the grains, and pairs of grains that are near each
/// other. The result does not depend on the number of threads. Numbers above the largest label are
/// numbered anew, see LabelVolume. Throws Error: InvalidInput for less than two labels or more than
/// a million, and for a scan that has other voxels, no contrast, or too few edges; Cancelled, and
/// what the volumes throw.
Fabric measure_fabric(LabelVolume& labels, const FabricOptions& options,
                      const Execution& execution);

/// Returns the degree of anisotropy of a fabric tensor F with trace 1: sqrt(3/2) times the
/// Frobenius norm of its deviatoric form 15/2 (F - I/3) (Kanatani 1984, Int. J. Engng Sci. 22); no
/// unit. 0 for directions that are spread evenly, 7.5 for directions that are all parallel.
double anisotropy_of(const Eigen::Matrix3d& tensor);

}  // namespace wscvt
