// SPDX-License-Identifier: GPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/nodes/fit_steps.h"

namespace wscvt {

namespace {

/// Evenness of the first leading round, and the limits of its control. Rims and ridges keep uneven
/// triangles, so that many bodies miss the wanted ratio. With a limit of 8 for them, stiff springs
/// tear the rows of nodes from the ridges of washers and mica (rms of a washer .37 instead of .15
/// %).
constexpr double leading_share = 0.2;
constexpr double least_evenness = 1e-6;
constexpr double most_evenness = 2.0;
/// Gain of the control of the evenness by the mean ratio.
constexpr double steering = 0.5;
/// Degrees: smallest angle of the result.
constexpr double smallest_angle = 30.0;
/// Margin above the least angle below which angles have a price, early and late.
constexpr double early_margin = 1.0;
constexpr double late_margin = 0.5;
constexpr double mending_margin = 0.3;
/// Price of a triangle with an angle of 0 in the last rounds, in mean errors of a triangle; 1 in
/// the first round.
constexpr double last_price = 200.0;
/// Factor of the price with each late round.
constexpr double late_growth = 2.0;
constexpr double valence_price = 0.01;
/// First round with relocations, and the number of last rounds without.
constexpr int first_relocation = 2;
constexpr int rounds_without_relocation = 8;

/// Intersections are looked for in every fourth round, in the last two, and after a round that had
/// any; the next look mends what is left. Single nodes are moved in every fourth round and in the
/// last four. In all rounds, this takes half of the time at ratio 1.6 and gains nothing.
constexpr int rounds_a_look = 4;
constexpr int last_polishes = 4;

double cosine_of_degrees(double degrees) { return portable::cos(degrees * pi / 180.0); }

class SurfaceFit {
 public:
  SurfaceFit(FitState& state, const Execution& execution)
      : state_(state), dial_(state.dial), execution_(execution), evenness_(dial_.start_evenness) {}

  SurfaceFitReport run() {
    for (int round = 0; round < dial_.rounds; ++round) {
      execution_.report(static_cast<double>(round) / dial_.rounds, "Fitting the nodes");
      begin_round(round);
      if (relocates(round)) report_.relocations += relocate_nodes(state_, execution_);
      if (flips(round)) report_.flips += flip_for_fit(state_);
      move_nodes(state_, fit_step(state_, execution_), execution_);
      state_.place_samples(execution_);
      if (polishes(round)) report_.polished += polish_nodes(state_, 1);
      ++report_.rounds;
    }
    mend_below(smallest_angle);
    return report_;
  }

 private:
  /// Returns the evenness of a round. The leading rounds bring it from `leading_share`, so that
  /// nodes find ridges, to the dial's start. Then it is controlled so that the mean ratio, which
  /// falls by `ratio_slope` as the evenness grows by a factor e, ends at the wanted ratio.
  double lead(int round) {
    double part = round / dial_.lead_rounds;
    if (dial_.heats > 1 && part < 1.0) part = std::fmod(part * dial_.heats, 1.0);
    const double rise = (portable::log(leading_share) - portable::log(dial_.start_evenness)) *
                        std::max(0.0, 1.0 - part);
    if (round >= dial_.first_steering) {
      const double off = mean_edge_ratio(state_.mesh) - dial_.ratio;
      const double led = evenness_ * portable::exp(steering * (off / dial_.ratio_slope + rise));
      evenness_ = std::clamp(led, least_evenness, std::max(evenness_, most_evenness));
    }
    return evenness_ * portable::exp(rise);
  }

  void begin_round(int round) {
    FitRound& now = state_.round;
    const int first_late = dial_.rounds - dial_.late_rounds;
    now.late = round >= first_late;
    now.checks_pairs = state_.had_pairs || round % rounds_a_look == 0 || round >= dial_.rounds - 2;
    if (now.checks_pairs) state_.had_pairs = false;
    now.evenness = lead(round);
    now.valence = valence_price * std::min(1.0, now.evenness);
    now.least_angle = dial_.least_angle;
    now.early_sharpness = cosine_of_degrees(dial_.early_angle);
    now.sharpness_limit = now.late ? cosine_of_degrees(dial_.least_angle) : now.early_sharpness;
    now.goal_cosine =
        cosine_of_degrees(dial_.least_angle + (now.late ? late_margin : early_margin));
    const double part = std::min(1.0, static_cast<double>(round) / std::max(1, first_late));
    double price = portable::pow(last_price, part);
    if (now.late) price *= portable::pow(late_growth, round - first_late);
    now.price = price * state_.mean_square * static_cast<double>(state_.mesh.points.size()) /
                static_cast<double>(state_.mesh.triangles.size());
  }

  bool relocates(int round) const {
    return round >= first_relocation && round < dial_.rounds - rounds_without_relocation;
  }
  bool polishes(int round) const {
    return dial_.polishes && (round % rounds_a_look == 0 || round >= dial_.rounds - last_polishes);
  }
  bool flips(int round) const { return round > 0 && round < dial_.rounds - 1; }

  bool has_angles_below(double degrees) const {
    const double limit = cosine_of_degrees(degrees);
    std::size_t t = 0;
    while (t < state_.mesh.triangles.size() && state_.mesh.sharpness(t) <= limit) ++t;
    return t < state_.mesh.triangles.size();
  }

  /// Repairs remaining small angles at a rising price, and from the third pass on at any price.
  void mend_below(double degrees) {
    constexpr int most_passes = 10;
    constexpr int passes_of_polish = 3;
    constexpr int first_forced = 2;
    constexpr double growth = 4.0;
    state_.round.late = true;
    state_.round.checks_pairs = true;
    for (int pass = 0; pass < most_passes && has_angles_below(degrees); ++pass) {
      execution_.report(1.0, "Fitting the nodes");
      state_.place_samples(execution_);
      state_.edge = mean_edge_length(state_.mesh);
      state_.build_hash();
      state_.round.price = growth * std::max(state_.round.price, state_.mean_square);
      state_.round.goal_cosine = cosine_of_degrees(degrees + mending_margin);
      report_.flips += flip_for_fit(state_);
      if (pass < passes_of_polish) report_.polished += polish_nodes(state_, 3);
      if (pass >= first_forced) {
        state_.place_samples(execution_);
        mend_angles(state_, degrees);
      }
    }
  }

  FitState& state_;
  const FitDial dial_;
  const Execution& execution_;
  double evenness_;
  SurfaceFitReport report_;
};

}  // namespace

SurfaceFitReport fit_to_samples(FitState& state, const Execution& execution) {
  return SurfaceFit(state, execution).run();
}

}  // namespace wscvt
