// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "wscvt/base/option.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

/// By what a remesh's error is told; each in % of the scan's own.
enum class ErrorMeasure {
  Volume,      ///< of the volume
  Area,        ///< of the area
  Sphericity,  ///< of Wadell's sphericity
  Inertia,     ///< inertia_error_percent
  Distance,    ///< two-sided rms distance, in % of the equivalent radius
};

template <>
struct EnumerationTable<ErrorMeasure> {
  static constexpr std::string_view key = "target-measure";
  static constexpr std::string_view subject = "measure of the error target";
  static constexpr Enumerator<ErrorMeasure> rows[] = {
      {ErrorMeasure::Volume, "volume", "volume"},
      {ErrorMeasure::Area, "area", "area"},
      {ErrorMeasure::Sphericity, "sphericity", "sphericity", "Wadell's"},
      {ErrorMeasure::Inertia, "inertia", "inertia", "the inertia tensor"},
      {ErrorMeasure::Distance, "distance", "RMS distance",
       "two-sided, in % of the equivalent radius"},
  };
};

/// A remesh's error against the original by a measure, in %, >= 0. `distances` between the two are
/// needed for Distance only and are lengths like the descriptors'. Throws Error(InvalidInput) when
/// they are needed and missing.
double error_percent(ErrorMeasure measure, const ShapeDescriptors& remesh,
                     const ShapeDescriptors& original,
                     const std::optional<MeshDistances>& distances);

}  // namespace wscvt
