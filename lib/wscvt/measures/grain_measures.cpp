// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/grain_measures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/repair/coordinates.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/scan_advice.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

namespace {

/// Overhang, as a fraction of the solid angle, above which a warning is given. Less overhang is
/// smaller than the details that the mesh itself leaves out.
constexpr double told_folded_share = 0.01;

/// Fraction of form in Sq above which a warning is given, because the higher moments then describe
/// edges. Bodies without roughness have 0.85 to 1.05. Waves near the cut-off also count; on rough
/// grains they make 0.6 to 0.7.
constexpr double told_leak_share = 0.75;

std::string quoted(const std::string& name) { return "'" + name + "'"; }

MeasuredGrain measured(NamedMesh grain, const DetailedOptions& options,
                       const Execution& execution) {
  try {
    CheckedMesh checked = check_mesh(std::move(grain.mesh), MeshCheckOptions(), execution);
    const DetailedDescriptors descriptors =
        describe_shape_in_detail(checked.mesh, options, execution);
    const SurfaceTexture texture = surface_texture(checked.mesh);
    std::string crossings = crossing_sentence(
        crossing_pairs(checked.mesh, execution.part(1.0, 1.0)), quoted(grain.name));
    return {std::move(grain.name), std::move(checked), descriptors, texture, std::move(crossings)};
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    throw Error(error.code(), quoted(grain.name) + ": " + error.sentence());
  }
}

void append_detail_remarks(const std::string& grain, const DetailedDescriptors& descriptors,
                           bool all, std::vector<Sentence>& sentences) {
  const Roundness& roundness = descriptors.roundness;
  if (std::isnan(roundness.roundness)) {
    sentences.push_back(
        "The edges of " + grain + " are too long to measure roundness: they need balls of radius " +
        format_number(roundness.ball_radius, 3) + ", but the largest inscribed sphere has radius " +
        format_number(descriptors.inscribed_sphere.radius, 3) + ". Use a denser mesh.");
  } else if (roundness.roundness < roundness.smallest_radius) {
    sentences.push_back("The corners of " + grain +
                        " are sharper than its mesh resolves: roundness is below " +
                        format_number(roundness.smallest_radius, 3) + ".");
  }
  if (!all) return;
  const Roughness& roughness = descriptors.roughness;
  if (!descriptors.has_roughness) {
    sentences.push_back(
        "The edges of " + grain + " are too long to measure roughness: the cut-off length is " +
        format_number(roughness.cutoff, 3) + ", but edges of this length only show waves from " +
        format_number(descriptors.least_cutoff, 3) + " on. Use a denser mesh or a larger " +
        mention("roughness-cutoff") + ".");
  } else if (roughness.form_leak > told_leak_share * roughness.sq) {
    sentences.push_back("Up to " + format_number(roughness.form_leak, 3) + " of the roughness Sq " +
                        format_number(roughness.sq, 3) + " of " + grain +
                        " may be form: Ssk and Sku then describe edges more than roughness. " +
                        "Use a smaller " + mention("roughness-cutoff") + ".");
  }
  std::string clipped = sdq_clip_sentence(grain, descriptors.basic);
  if (!clipped.empty()) sentences.push_back(std::move(clipped));
  const std::string missing = ". Sdq as printed (eq. 17) needs a star-shaped grain and is left " +
                              std::string("empty. Sdq (invariant form) is valid.");
  if (!descriptors.has_radius && descriptors.overhang_fraction < 1.0) {
    sentences.push_back(grain + " is not star-shaped: overhangs cover " +
                        format_percent(descriptors.overhang_fraction) + " of the sphere (limit " +
                        format_percent(largest_measured_overhang) + ")" + missing);
  } else if (!descriptors.has_radius) {
    sentences.push_back(grain + " is not star-shaped: its volume centroid lies outside it" +
                        missing);
  } else if (descriptors.overhang_fraction > told_folded_share) {
    sentences.push_back("Overhangs of " + grain + " cover " +
                        format_percent(descriptors.overhang_fraction) +
                        " of the sphere. Sdq as printed describes only the outermost surface.");
  }
}

/// Appends what there is to say of a grain, under a name.
void append_remarks(const MeasuredGrain& grain, const std::string& name, bool all,
                    std::vector<Sentence>& sentences) {
  if (grain.checked.report.components > 1) {
    sentences.push_back("Only the largest of the " +
                        std::to_string(grain.checked.report.components) + " parts of " + name +
                        " was measured.");
  }
  const MeshCheckReport& report = grain.checked.report;
  // Its steps would be taken for voxels.
  const std::string far = single_precision_warning(grain.checked.mesh, name);
  if (!far.empty()) {
    sentences.push_back(far);
  } else if (grain.texture.kind != Texture::None) {
    sentences.push_back(texture_sentence(grain.texture, name));
  } else if (report.has_voxel_steps) {
    sentences.push_back(voxel_steps_advice(name));
  }
  if (!grain.crossing_remark.empty()) sentences.push_back(grain.crossing_remark);
  if (report.stray_distance > 0.0) {
    sentences.push_back(stray_vertex_sentence(report) + " Check that it belongs to the grain.");
  }
  if (report.merged_corners > 0) {
    sentences.push_back(merged_warning(report.merged_corners, report.merged_distance));
  }
  const double mended = report.flap_area_fraction + report.filled_area_fraction;
  if (mended > 0.0) {
    sentences.push_back("Holes and non-manifold edges of " + name +
                        " were repaired for the measurement. This changed " +
                        format_percent(mended) + " of its area.");
  }
  append_detail_remarks(name, grain.descriptors, all, sentences);
}

}  // namespace

GrainMeasures measure_grain(NamedMesh grain, std::optional<NamedMesh> reference,
                            const DetailedOptions& options, const Execution& execution) {
  const double share = reference ? 0.4 : 1.0;
  GrainMeasures measures;
  execution.report(0.0, "Measuring the grain");
  measures.grain = measured(std::move(grain), options, execution.part(0.0, share));
  if (reference) {
    execution.report(0.4, "Measuring the reference");
    measures.reference = measured(std::move(*reference), options, execution.part(0.4, 0.8));
    execution.report(0.8, "Measuring distances");
    measures.distances =
        measure_distances(measures.grain.checked.mesh, measures.reference->checked.mesh,
                          usual_distance_samples, execution.part(0.8, 1.0));
  }
  return measures;
}

std::vector<DescriptorComparison> compare_descriptors(const GrainMeasures& measures) {
  return compare_descriptors(list_descriptors(measures.reference->descriptors),
                             list_descriptors(measures.grain.descriptors));
}

std::vector<Sentence> remarks(const GrainMeasures& measures, bool all) {
  std::vector<Sentence> sentences;
  append_remarks(measures.grain, quoted(measures.grain.name), all, sentences);
  if (!measures.reference) return sentences;
  // What is true of both is said once.
  const std::vector<Sentence> of_grain = sentences;
  const std::string name = quoted(measures.reference->name);
  std::vector<Sentence> of_reference;
  std::vector<Sentence> under_same_name;
  append_remarks(*measures.reference, name, all, of_reference);
  append_remarks(*measures.reference, quoted(measures.grain.name), all, under_same_name);
  for (std::size_t k = 0; k < of_reference.size(); ++k) {
    const auto same = std::find(of_grain.begin(), of_grain.end(), under_same_name[k]);
    if (same == of_grain.end()) {
      sentences.push_back(of_reference[k]);
    } else if (!(of_reference[k] == under_same_name[k])) {
      sentences[static_cast<std::size_t>(same - of_grain.begin())] +=
          " The same is true of " + name + ".";
    }
  }
  return sentences;
}

}  // namespace wscvt
