// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/grain_measures.h"

#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/scan/mesh_check.h"

namespace wscvt {

namespace {

/// Share of the solid angle in sheets beyond the first above which a reader is told: rays to less
/// than this are lost in what the mesh itself leaves out.
constexpr double told_folded_share = 0.01;

MeasuredGrain measured(NamedMesh grain, const DetailedOptions& options,
                       const Execution& execution) {
  try {
    CheckedMesh checked = check_mesh(std::move(grain.mesh), MeshCheckOptions(), execution);
    const DetailedDescriptors descriptors =
        describe_shape_in_detail(checked.mesh, options, execution);
    return {std::move(grain.name), std::move(checked), descriptors};
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    throw Error(error.code(), "'" + grain.name + "': " + error.what());
  }
}

void append_remarks(const MeasuredGrain& grain, std::vector<std::string>& sentences) {
  if (grain.checked.report.components > 1) {
    sentences.push_back("Only the largest of the " +
                        std::to_string(grain.checked.report.components) + " parts of '" +
                        grain.name + "' was measured.");
  }
  const MeshCheckReport& report = grain.checked.report;
  const double mended = report.flap_area_share + report.filled_area_share;
  if (mended > 0.0) {
    sentences.push_back("Holes and non-manifold edges of '" + grain.name +
                        "' were mended for the measurement, which changed " +
                        format_percent(mended) + " of its area.");
  }
  const DetailedDescriptors& descriptors = grain.descriptors;
  const std::string fold = "Seen from its centroid '" + grain.name +
                           "' folds over itself: sheets beyond the first fill " +
                           format_percent(descriptors.folded_share) + " of the solid angle";
  if (descriptors.has_radius) {
    if (descriptors.folded_share > told_folded_share) {
      sentences.push_back(fold + ". Roundness and roughness are those of its outermost layer.");
    }
  } else if (descriptors.folded_share < 1.0) {
    sentences.push_back(fold + ", more than " + format_percent(largest_measured_fold) +
                        ", so it has no roundness, no roughness and no Sdq as printed, which are "
                        "of a radius; Sdq in its invariant form is that of any body.");
  } else {
    sentences.push_back("The volume centroid of '" + grain.name +
                        "' lies outside it, so it has no roundness, no roughness and no Sdq as "
                        "printed, which are of a radius seen from there; Sdq in its invariant form "
                        "is that of any body.");
  }
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
                          DistanceOptions(), execution.part(0.8, 1.0));
  }
  return measures;
}

std::vector<DescriptorComparison> compare_descriptors(const GrainMeasures& measures) {
  return compare_descriptors(list_descriptors(measures.reference->descriptors),
                             list_descriptors(measures.grain.descriptors));
}

std::vector<std::string> remarks(const GrainMeasures& measures) {
  std::vector<std::string> sentences;
  append_remarks(measures.grain, sentences);
  if (measures.reference) append_remarks(*measures.reference, sentences);
  return sentences;
}

}  // namespace wscvt
