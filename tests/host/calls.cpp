// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"

#include <limits>

#include "sample_meshes.h"

namespace wscvt::host_test {

std::vector<Call> refused_calls() {
  return {
      {"NoMesh", std::nullopt, {}, {"no mesh"}},
      {"EmptyMesh", IndexedMesh{}, {}, {"empty"}},
      {"ThreePoints", IndexedMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}}, {}, {"points"}},
      {"PointsWithoutFaces",
       IndexedMesh{sphere().points, {}},
       {},
       {"no faces", "Rebuild the surface from the points"}},
      {"OpenMesh", without_a_patch(), {}, {"boundary"}},
      {"TwoHalves", two_grains(), {}, {"bodies"}},
      {"NoVolume", flat_grain(), {}, {"volume"}},
      {"CentreOutside", bent_grain(), {{"Method", "1"}}, {"outside", "\"Method: On the scan\""}},
      {"TooFewNodes", grain(), {{"NodeCount", "3"}}, {"NodeCount", "4"}},
      {"NegativeNodes", grain(), {{"NodeCount", "-7"}}, {"NodeCount", "4"}},
      {"TooManyNodes", grain(), {{"NodeCount", "1000001"}}, {"NodeCount", "1000000"}},
      {"DegreeNegative", grain(), {{"HarmonicDegree", "-1"}}, {"HarmonicDegree", "60"}},
      {"DegreeTooHigh", grain(), {{"HarmonicDegree", "61"}}, {"HarmonicDegree", "60"}},
      {"WeightingAboveRange", grain(), {{"Weighting", "5"}}, {"Weighting", "WSCVT-C"}},
      {"WeightingBelowRange", grain(), {{"Weighting", "-1"}}, {"Weighting", "WSCVT-C"}},
      {"PlacementOutOfRange", grain(), {{"Placement", "5"}}, {"Placement", "Contact"}},
      {"EdgeRatioOutOfRange", grain(), {{"EdgeRatio", "1"}}, {"EdgeRatio", "1.08"}},
      {"TargetMeasureOutOfRange", grain(), {{"TargetMeasure", "5"}}, {"TargetMeasure", "Inertia"}},
      {"ErrorTargetNegative", grain(), {{"ErrorTarget", "-1"}}, {"ErrorTarget"}},
      {"WeightingOfTheOtherMethod", grain(), {{"Weighting", "3"}}, {"Weighting", "As published"}},
      {"PlacementOfTheOtherMethod", grain(), {{"Placement", "0"}}, {"Placement", "As published"}},
      {"PlacementOfTheScan",
       grain(),
       {{"Method", "1"}, {"Placement", "2"}},
       {"Placement", "On the scan"}},
      {"EdgeRatioOfTheScan",
       grain(),
       {{"Method", "1"}, {"EdgeRatio", "1.2"}},
       {"EdgeRatio", "On the scan"}},
      {"OverhangOfTheOtherMethod", grain(), {{"FoldLimit", "7"}}, {"FoldLimit", "As published"}},
      {"ReportOfAnotherKind", grain(), {{"ReportFile", "report.pdf"}}, {"ReportFile", ".html"}},
      {"ReportWithoutExtension", grain(), {{"ReportFile", "report"}}, {"ReportFile", ".csv"}},
      {"ReportIntoNowhere", grain(), {{"ReportFile", "/no/folder/report.json"}}, {"folder"}},
      {"ReportIntoAFolder", grain(), {{"ReportFile", "/tmp/.."}}, {"ReportFile"}},
      {"ReportOverTheCoefficients",
       grain(),
       {{"ReportFile", "./one.json"}, {"CoefficientsFile", "one.json"}},
       {"ReportFile", "CoefficientsFile"}},
      {"CoefficientsOfAnotherKind",
       grain(),
       {{"CoefficientsFile", "coefficients.dat"}},
       {"CoefficientsFile", ".json"}},
      {"QualityOutOfRange", grain(), {{"Quality", "4"}}, {"Quality"}},
      {"AlphaOutOfRange", grain(), {{"CurvatureAlpha", "3.1"}}, {"CurvatureAlpha", "3.1"}},
      {"AlphaNotANumber", grain(), {{"CurvatureAlpha", "nan"}}, {"CurvatureAlpha"}},
      {"MendLimitNegative", grain(), {{"MendLimit", "-0.1"}}, {"MendLimit", "-0.1"}},
      {"MendLimitTooLarge", grain(), {{"MendLimit", "101"}}, {"MendLimit", "100"}},
      {"FoldLimitNegative", grain(), {{"FoldLimit", "-0.1"}}, {"FoldLimit", "-0.1"}},
      {"FoldLimitAll", grain(), {{"FoldLimit", "100"}}, {"FoldLimit", "99"}},
      {"FoldLimitInfinite", grain(), {{"FoldLimit", "inf"}}, {"FoldLimit"}},
      {"MethodOutOfRange", grain(), {{"Method", "2"}}, {"Method", "As published"}},
  };
}

std::vector<Call> unmeasurable_calls() {
  return {
      {"NoMesh", std::nullopt, {}, {"no mesh"}},
      {"EmptyMesh", IndexedMesh{}, {}, {"empty"}},
      {"PointsWithoutFaces", IndexedMesh{sphere().points, {}}, {}, {"faces"}},
      {"OpenMesh", without_a_patch(), {}, {"boundary"}},
      {"TwoHalves", two_grains(), {}, {"bodies"}},
      {"NoVolume", flat_grain(), {}, {"volume"}},
      {"UnknownLayer", grain(), {{"ReferenceLayer", "ghost"}}, {"'ghost'"}},
      {"BallOutOfRange", grain(), {{"RoundnessBall", "0"}}, {"RoundnessBall", "0.05"}},
  };
}

std::vector<Call> extreme_calls() {
  // These are repaired, or have no radius in each direction.
  const double infinity = std::numeric_limits<double>::infinity();
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  return {
      {"CentreOutsideOnTheScan", bent_grain(), {}, {}},
      {"NonManifoldEdge", with_non_manifold_edge(), {}, {}},
      {"NotANumber", with_coordinate(not_a_number), {}, {}},
      {"Infinite", with_coordinate(infinity), {}, {}},
      {"CurvatureOnASphere", sphere(), {{"Weighting", "2"}, {"NodeCount", "300"}}, {}},
      {"AMillionUnitsAway",
       moved(scaled(grain(), 100.0), Vector3(1e6, -1e6, 1e6)),
       {{"NodeCount", "300"}},
       {}},
      {"AMicrometreAcross", scaled(grain(), 0.5e-6), {{"NodeCount", "300"}}, {}},
      {"FourNodes", grain(), {{"NodeCount", "4"}}, {}},
      {"AsPublished", grain(), {{"NodeCount", "200"}, {"Method", "1"}, {"Weighting", "0"}}, {}},
      {"PointsWithoutFaces",
       IndexedMesh{sphere().points, {}},
       {{"NodeCount", "300"}, {"Points", "true"}},
       {}},
      {"Close",
       grain(),
       {{"NodeCount", "200"}, {"Placement", "2"}, {"EdgeRatio", "1.5"}, {"Quality", "3"}},
       {}},
      {"ForContacts", grain(), {{"NodeCount", "300"}, {"Weighting", "1"}, {"Placement", "3"}}, {}},
      {"OnTheOriginalMesh", grain(), {{"NodeCount", "500"}, {"Placement", "1"}}, {}},
  };
}

}  // namespace wscvt::host_test
