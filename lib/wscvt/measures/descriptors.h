// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

// Shape measures of one body: a fast set for every remesh, and the full set.

/// Shape descriptors of a closed, outward mesh that follow from integrals over it. They are cheap
/// enough for every remesh. DetailedDescriptors contains the others.
///
/// Integrals over the volume are turned into sums over the faces by the divergence theorem: each
/// face spans a signed tetrahedron with a point near the middle of the mesh (Lien and Kajiya 1984,
/// IEEE Comput. Graph. Appl. 4 (10), 35-42; Mirtich 1996, "Fast and accurate computation of
/// polyhedral mass properties", J. Graph. Tools 1 (2), 31-50). They are exact for the polyhedron.
struct ShapeDescriptors {
  /// (1/6) sum a . (b x c) over the faces, a, b, c their corners (Lien and Kajiya; Mirtich);
  /// length^3.
  double volume = 0.0;
  double area = 0.0;  ///< (1/2) sum |(b - a) x (c - a)| over the faces; length^2
  /// S/L of the inertia ellipsoid, in (0, 1]; no unit. Source: see inertia_semi_axes.
  double aspect_ratio = 0.0;
  /// (36 pi V^2)^(1/3) / A, in (0, 1]; no unit (Wadell 1932, "Volume, shape, and roundness of rock
  /// particles", J. Geol. 40, 443-451).
  double sphericity = 0.0;
  /// Root-mean-square gradient of the radius, in a form of this library that does not depend on the
  /// orientation. It replaces the paper's eq. 17, which depends on it (see printed_sdq):
  /// Sdq^2 = (1/A) integral of |grad_Omega r|^2 dOmega = (1/A) sum A_f (1 - c_f^2) / c_f, with c_f
  /// the cosine between a face's normal and the direction of its centroid from the volume centroid.
  /// c_f is clipped at 0.05 from below, so that overhangs do not count as infinitely steep. No
  /// unit; 0 for a sphere.
  double sdq = 0.0;
  /// Fraction of Sdq^2 from clipped faces, in [0, 1]. This part depends on the clip.
  double sdq_clipped_fraction = 0.0;
  double sdq_half_clip = 0.0;          ///< Sdq with half the clip; no unit
  Vector3 centroid = Vector3::Zero();  ///< of the volume (Lien and Kajiya; Mirtich); length
  /// Semi-axes of the homogeneous ellipsoid with the body's second moments per volume (the inertia
  /// ellipsoid), S <= I <= L; length. a_k = (5 m_k)^(1/2) with m_k the eigenvalues of (1/V)
  /// integral of x x^T dV about the centroid: the ellipsoid of equal radii of gyration of Medalia
  /// (1971), "Dynamic shape factors of particles", Powder Technol. 4, 117-138.
  Vector3 inertia_semi_axes = Vector3::Zero();
  /// Tensor of inertia about the centroid at unit density (Lien and Kajiya; Mirtich); length^5.
  Eigen::Matrix3d inertia_tensor = Eigen::Matrix3d::Zero();
  /// Unit quaternion that turns the principal axes into the mesh's axes, as in MassProperties; no
  /// unit.
  Eigen::Quaterniond principal_axes = Eigen::Quaterniond::Identity();
};

/// Measures a closed outward mesh. The accuracy does not depend on the distance to the origin.
/// Throws Error(InvalidInput) if the volume is not positive.
ShapeDescriptors describe_shape(const IndexedMesh& mesh, const Execution& execution);

/// Returns a warning if Sdq changes by more than 2 % when the clip is halved, because Sdq then
/// depends more on the clip than on the grain. Otherwise empty. `grain` is the grain's name.
std::string sdq_clip_sentence(const std::string& grain, const ShapeDescriptors& descriptors);

/// Returns 100 (value / reference - 1); 0 below 1e-9, which is rounding, and 0 if the two are
/// equal, even at zero.
double relative_error_percent(double value, double reference);

/// Returns the largest absolute entry of the difference of two inertia tensors, in the principal
/// axes of the reference, in % of its largest principal moment. A measure of this library.
double inertia_error_percent(const ShapeDescriptors& value, const ShapeDescriptors& reference);

/// Converts descriptors that were measured in units of length `unit` about `centre` to plain
/// lengths.
void scale(ShapeDescriptors& descriptors, double unit, const Vector3& centre);

/// Mass properties of a rigid body at unit density. Multiply volume and moments by the density.
struct MassProperties {
  double volume = 0.0;                                       ///< length^3
  Vector3 centroid = Vector3::Zero();                        ///< length
  Eigen::Matrix3d inertia_tensor = Eigen::Matrix3d::Zero();  ///< about the centroid; length^5
  Vector3 principal_moments = Vector3::Zero();               ///< ascending; length^5
  /// Unit quaternion q: a point p of the principal frame is centroid + q p in the mesh's frame. x
  /// is along the longest axis, z along the shortest. lib/doc/descriptors.md defines the signs.
  Eigen::Quaterniond principal_axes = Eigen::Quaterniond::Identity();
};

/// Returns the mass properties from descriptors. Throws nothing.
MassProperties mass_properties(const ShapeDescriptors& descriptors);

/// The two lengths on which the detailed descriptors depend.
struct DetailedOptions {
  /// Radius of the balls in which roundness measures curvature, over the radius of the largest
  /// inscribed sphere.
  double roundness_ball = 0.2;
  /// Cut-off length of roughness over the radius of the sphere of equal volume. Longer waves are
  /// form. Sq grows with the cut-off: real grains show no plateau. With 0.25 the heights contain
  /// less of the form of sharp bodies, but also fewer waves.
  double roughness_cutoff = 0.33;
};

inline constexpr NumberOption<double> roundness_ball_option = {
    "roundness-ball",
    "ball of roundness",
    0.05,
    1.0,
    Ends::Both,
    "radius of the balls for curvature, over the inscribed radius"};
inline constexpr NumberOption<double> roughness_cutoff_option = {
    "roughness-cutoff",
    "cut-off length of roughness",
    0.01,
    2.0,
    Ends::Both,
    "longest wave that counts, over the equivalent radius"};

/// Largest overhang, as a fraction of the solid angle seen from the volume centroid, for which the
/// printed Sdq is computed.
inline constexpr double largest_measured_overhang = 0.01 * usual_overhang_limit_percent;

/// Three mutually perpendicular dimensions of a body, S <= I <= L; full lengths, not halves.
struct FormAxes {
  double shortest = 0.0;      ///< S
  double intermediate = 0.0;  ///< I
  double longest = 0.0;       ///< L
};

/// Ratios of the three dimensions; no units.
struct FormRatios {
  double aspect_ratio = 0.0;      ///< S/L, in (0, 1]
  double zingg_elongation = 0.0;  ///< I/L, in (0, 1] (Zingg 1935, Beitrag zur Schotteranalyse)
  double zingg_flatness = 0.0;    ///< S/I, in (0, 1] (Zingg 1935)
  /// (L - I)/L, in [0, 1) (Kong and Fonseca 2018, "Quantification of the morphology of shelly
  /// carbonate sands using 3D images", Geotechnique; read as SHAPE does: Angelidakis, Nadimi and
  /// Utili 2021, Comput. Phys. Commun. 265, 107983).
  double kong_fonseca_elongation = 0.0;
  double kong_fonseca_flatness = 0.0;  ///< (I - S)/I, in [0, 1) (Kong and Fonseca 2018)
  /// Intercept sphericity (I S / L^2)^(1/3), in (0, 1] (Krumbein 1941, J. Sediment. Petrol. 11,
  /// 64-72).
  double krumbein_sphericity = 0.0;
};

/// Distances across a body (see feret_diameters); lengths.
struct FeretDiameters {
  double largest = 0.0;       ///< between two points of the body; L of NIST
  double smallest = 0.0;      ///< between two parallel planes that enclose the body
  double width_across = 0.0;  ///< longest chord perpendicular to the largest diameter; W of NIST
  double thickness_across = 0.0;  ///< longest chord perpendicular to both; T of NIST
};

/// A sphere inside a body, and an upper bound for the largest such sphere.
struct InscribedSphere {
  Vector3 centre = Vector3::Zero();  ///< length
  double radius = 0.0;               ///< length; the sphere lies inside
  double upper_bound = 0.0;          ///< length; no sphere inside is larger than this
};

/// Surface orientation tensor of Orosz, Angelidakis and Bagi (2021), "Surface orientation tensor to
/// predict preferred contact orientation and characterise the form of individual particles", Powder
/// Technology, 312-325, doi 10.1016/j.powtec.2021.08.054: f = (1/A) sum A_k n_k (x) n_k over the
/// faces, A_k their areas and n_k their unit normals. No unit; trace 1; eigenvalues f1 >= f2 >= f3.
/// The three measures add up to 1.
struct OrientationTensor {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  Vector3 eigenvalues = Vector3::Zero();  ///< f1, f2, f3
  double compactness = 0.0;               ///< f3 / f1, 1 for a sphere or a cube
  double flakiness = 0.0;                 ///< (f1 - f2) / f1, towards 1 for a plate
  double rodness = 0.0;                   ///< (f2 - f3) / f1, towards 1 for a rod
};

/// Wadell's roundness of a body; wadell_roundness has the formula and the convention of its mean.
struct Roundness {
  /// In (0, 1]; 1 if there are no corners, NaN if the mesh is too coarse.
  double roundness = 1.0;
  double ball_radius = 0.0;  ///< of the balls in which curvature was measured; length
  /// Radius of the sharpest corners that the balls can resolve, over the inscribed radius; no unit.
  double smallest_radius = 0.0;
};

/// Height parameters after ISO 25178-2. The reference surface is the surface without waves shorter
/// than the cut-off length (surface_roughness), and A is its area. The heights z are measured from
/// it, minus their mean.
struct Roughness {
  double cutoff = 0.0;     ///< nesting index of the L-filter: a wavelength; length
  double sa = 0.0;         ///< (1/A) integral |z| dA; length
  double sq = 0.0;         ///< ((1/A) integral z^2 dA)^(1/2); length
  double ssk = 0.0;        ///< (1/A) integral z^3 dA / Sq^3; no unit, 0 for symmetric heights
  double sku = 0.0;        ///< (1/A) integral z^4 dA / Sq^4; no unit, 3 for normal heights
  double form_leak = 0.0;  ///< estimated part of Sq that is curved form, not roughness; length
};

/// Every shape descriptor of a closed, outward mesh. Formula and source are here or in
/// descriptor_steps.h. lib/doc/descriptors.md lists all in one table.
struct DetailedDescriptors {
  ShapeDescriptors basic;
  /// Diameter of the sphere of equal volume, (6 V / pi)^(1/3): the nominal diameter of Wadell
  /// (1932); length.
  double equivalent_diameter = 0.0;
  /// Full axes of the inertia ellipsoid, twice ShapeDescriptors::inertia_semi_axes.
  FormAxes inertia_axes;
  FormRatios inertia_ratios;  ///< their ratios; sources at FormRatios
  FormAxes box_axes;          ///< edges of the smallest oriented box
  FormRatios box_ratios;
  FeretDiameters feret;
  double mean_curvature_integral = 0.0;  ///< of (k1 + k2) / 2 over the surface; length
  /// V / volume of the convex hull, in (0, 1]; no unit. As in SHAPE (Angelidakis, Nadimi
  /// and Utili 2021; see FormRatios). Hull by convex_hull.
  double convexity = 0.0;
  InscribedSphere inscribed_sphere;
  OrientationTensor orientation;
  Roundness roundness;
  /// Whether roughness exists: false if the mesh's edges are too long for the cut-off.
  /// roughness.cutoff is always set.
  bool has_roughness = false;
  double least_cutoff = 0.0;  ///< smallest cut-off that the mesh's edges allow; length
  Roughness roughness;
  double overhang_fraction =
      0.0;  ///< overhang as a fraction of 4 pi, seen from the volume centroid
  /// Whether the printed Sdq exists: false if the volume centroid is outside the body or the
  /// overhang exceeds largest_measured_overhang. With less overhang it uses the outermost surface.
  bool has_radius = false;
  double printed_sdq = 0.0;  ///< the paper's eq. 17, in the mesh's own pose; no unit (printed_sdq)
};

/// Measures a closed outward mesh as checked by check_mesh, in about a second for 100,000 faces.
/// Throws Error(InvalidInput) if the volume is not positive or an option is out of range;
/// Error(NumericalFailure) if a ray from the volume centroid meets no face or the equations of the
/// surface filter have no solution; Error(Cancelled).
DetailedDescriptors describe_shape_in_detail(const IndexedMesh& mesh,
                                             const DetailedOptions& options,
                                             const Execution& execution);

}  // namespace wscvt
