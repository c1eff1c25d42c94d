// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/study/contact_samplings.h"

namespace wscvt::study {

namespace {

RemeshOptions published(Weighting weighting, Sampling sampling = Sampling::Weighted) {
  AsPublishedOptions method;
  method.weighting = weighting;
  method.sampling = sampling;
  method.placement = PublishedPlacement::Surface;
  RemeshOptions options;
  options.method = method;
  return options;
}

RemeshOptions on_scan(CellWeighting weighting, ScanPlacement placement,
                      double edge_ratio = default_edge_ratio) {
  OnScanOptions method;
  method.weighting = weighting;
  method.placement = placement;
  method.edge_ratio = edge_ratio;
  RemeshOptions options;
  options.method = method;
  return options;
}

}  // namespace

std::vector<ContactSampling> contact_samplings() {
  const auto contact = [](double ball_radius) {
    RemeshOptions options = on_scan(CellWeighting::Area, ScanPlacement::ContactFit, 1.4);
    std::get<OnScanOptions>(options.method).contact_radius = ball_radius;
    return options;
  };
  return {{"WSCVT-D", published(Weighting::RadialDistance)},
          {"WSCVT-C", published(Weighting::Curvature)},
          {"constant", published(Weighting::Constant)},
          {"Fibonacci", published(Weighting::Constant, Sampling::Fibonacci)},
          {"on the scan", on_scan(CellWeighting::Area, ScanPlacement::OnSurface)},
          {"fitted", on_scan(CellWeighting::Area, ScanPlacement::Fitted)},
          {"fitted, close", on_scan(CellWeighting::Area, ScanPlacement::Fitted, 1.4)},
          {"contact 0.4", contact(0.4)},
          {"contact 1.3", contact(1.3)},
          {"contact 5", contact(5.0)}};
}

}  // namespace wscvt::study
