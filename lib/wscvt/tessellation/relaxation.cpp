// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/relaxation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/tessellation/power_cells.h"

namespace wscvt {

namespace {

constexpr std::size_t seed_block = 4096;

/// Step factor towards the centroid. With momentum the limit of stability is 4/3, because the step
/// follows the gradient of an energy.
constexpr double over_relaxation = 1.2;

double mean_square(const std::vector<Vector3>& from, const std::vector<Vector3>& to,
                   const Execution& execution) {
  const double sum = execution.parallel_sum_of(
      from.size(), seed_block, 0.0,
      [&](std::size_t i, double& part) { part += (to[i] - from[i]).squaredNorm(); });
  return sum / static_cast<double>(from.size());
}

/// The cells of seeds at one position, compared with their targets.
class Evaluation {
 public:
  /// `triangulation` of the first seeds, if there is one.
  Evaluation(const SeedModel& model, const Execution& execution,
             std::optional<SphereTriangulation> triangulation)
      : model_(model), execution_(execution), triangulation_(std::move(triangulation)) {}

  /// Repairs or rebuilds the triangulation for `seeds` and computes the cells. Returns false,
  /// without cells, if the seeds have no triangulation at any weights.
  [[nodiscard]] bool try_at(const std::vector<Vector3>& seeds, RelaxationReport& report) {
    flips_ = 0;
    model_.weights(seeds, execution_, weights_);
    if (!triangulate(seeds, report)) return false;
    compute_power_cells(*triangulation_, seeds, weights_, execution_, cells_);
    compare(seeds);
    return true;
  }

  /// Does the same for seeds that cannot be replaced. Throws, with the reason, as
  /// SphereTriangulation.
  void at(const std::vector<Vector3>& seeds, RelaxationReport& report) {
    if (!try_at(seeds, report)) triangulation_.emplace(seeds);
  }

  /// Centroids seen from the origin; the caller normalizes them.
  const std::vector<Vector3>& centroids() const { return cells_.centroids; }
  const RelaxationStep& step() const { return step_; }
  SphereTriangulation take_triangulation() { return std::move(*triangulation_); }
  std::vector<double> take_areas() { return std::move(cells_.areas); }

 private:
  bool triangulate(const std::vector<Vector3>& seeds, RelaxationReport& report) {
    if (triangulation_) {
      const auto repair = triangulation_->restore_regular(seeds, weights_, execution_);
      flips_ = repair.flips;
      if (repair.complete) return true;
      ++report.rebuilds;
    }
    // A seed whose weight is too low has no cell. The differences between weights are then halved
    // until every seed has one; with equal weights every seed has one.
    constexpr int most_halvings = 10;
    double scale = 1.0;
    const Execution start = execution_.part(0.0, 0.0);
    triangulation_ = SphereTriangulation::try_build(seeds, weights_, start);
    for (int halvings = 0; !triangulation_ && !weights_.empty(); ++halvings) {
      scale *= 0.5;
      if (halvings == most_halvings) {
        weights_.clear();
        scale = 0.0;
      }
      for (double& weight : weights_) weight *= 0.5;
      triangulation_ = SphereTriangulation::try_build(seeds, weights_, start);
    }
    if (!triangulation_) return false;
    report.weight_scale = std::min(report.weight_scale, scale);
    return true;
  }

  // Computes h and the standard deviation of (cell area / target).
  void compare(const std::vector<Vector3>& seeds) {
    const std::size_t count = seeds.size();
    using Sums = Eigen::Vector2d;
    const Sums zero = Sums::Zero();
    const Sums sums =
        execution_.parallel_sum_of(count, seed_block, zero, [&](std::size_t i, Sums& part) {
          part += Sums(cells_.areas[i], weights_.empty() ? 0.0 : weights_[i]);
        });
    const double mean_area = sums[0] / static_cast<double>(count);
    const double mean_weight = sums[1] / static_cast<double>(count);
    const auto target = [&](std::size_t i) {
      if (weights_.empty()) return mean_area;
      return std::max(smallest_cell_share * mean_area,
                      mean_area + cell_area_per_weight * (weights_[i] - mean_weight));
    };
    const Sums ratios =
        execution_.parallel_sum_of(count, seed_block, zero, [&](std::size_t i, Sums& part) {
          const double ratio = cells_.areas[i] / target(i);
          part += Sums(ratio, ratio * ratio);
        });
    const double mean_ratio = ratios[0] / static_cast<double>(count);
    const double variance = ratios[1] / static_cast<double>(count) - mean_ratio * mean_ratio;
    step_.area_spread = std::sqrt(std::max(0.0, variance));
    step_.displacement = std::sqrt(mean_square(seeds, cells_.centroids, execution_) / mean_area);
    step_.flips = flips_;
  }

  const SeedModel& model_;
  const Execution& execution_;
  std::optional<SphereTriangulation> triangulation_;
  std::vector<double> weights_;
  PowerCells cells_;
  RelaxationStep step_;
  int flips_ = 0;
};

/// Evaluates at `seeds`, with halved steps as long as they have no triangulation. This happens to a
/// handful of seeds on a long grain if a full step leaves them in one hemisphere. Returns false if
/// only the old positions are possible; the seeds then have these.
bool try_evaluation(Evaluation& evaluation, const std::vector<Vector3>& before,
                    std::vector<Vector3>& seeds, RelaxationReport& report) {
  constexpr int halvings = 6;
  for (int attempt = 0;; ++attempt) {
    if (evaluation.try_at(seeds, report)) return true;
    if (attempt == halvings) break;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      seeds[i] = (seeds[i] + before[i]).normalized();
    }
  }
  seeds = before;
  evaluation.at(seeds, report);
  return false;
}

/// Returns why a relaxation ends at `step`; empty if it continues.
std::optional<RelaxationOutcome> outcome_at(const RelaxationStep& step,
                                            const RelaxationOptions& options, int iterations) {
  if (step.displacement < options.displacement_tolerance &&
      step.area_spread < options.area_tolerance) {
    return RelaxationOutcome::Converged;
  }
  // Below this fraction of the tolerance, seeds are at rest.
  constexpr double rest = 0.01;
  if (step.displacement < rest * options.displacement_tolerance) return RelaxationOutcome::Settled;
  if (iterations >= options.maximum_iterations) return RelaxationOutcome::IterationLimit;
  return std::nullopt;
}

}  // namespace

RelaxationResult relax(std::vector<Vector3> seeds, const SeedModel& model,
                       const RelaxationOptions& options, const Execution& execution,
                       std::optional<SphereTriangulation> triangulation) {
  const std::size_t count = seeds.size();
  if (count < 4) refuse("Relaxation needs at least 4 seeds, not " + std::to_string(count) + ".");
  RelaxationReport report;
  Evaluation evaluation(model, execution, std::move(triangulation));
  evaluation.at(seeds, report);

  // `seeds`: positions of the evaluated cells; `arrived`: end of the last plain step.
  std::vector<Vector3> arrived = seeds;
  std::vector<Vector3> stepped(count);
  Momentum momentum;
  StallWatch stall;
  while (true) {
    report.history.push_back(evaluation.step());
    const RelaxationStep& step = evaluation.step();
    if (const auto outcome = outcome_at(step, options, report.iterations)) {
      report.outcome = *outcome;
      break;
    }
    if (stall.stalled_at(step.displacement)) {
      report.outcome = RelaxationOutcome::Settled;
      break;
    }
    ++report.iterations;
    execution.report(static_cast<double>(report.iterations) / (report.iterations + 50.0),
                     "Relaxing the seeds");

    const std::vector<Vector3>& centroids = evaluation.centroids();
    const double uphill =
        execution.parallel_sum_of(count, seed_block, 0.0, [&](std::size_t i, double& part) {
          stepped[i] = (seeds[i] + over_relaxation * (centroids[i] - seeds[i])).normalized();
          part += (seeds[i] - stepped[i]).dot(stepped[i] - arrived[i]);
        });
    // `uphill` compares the last step with the current pull of the cells: the gradient test of
    // O'Donoghue and Candes, which needs no energy. Momentum that is never dropped oscillates about
    // the end and needs more than twice the steps.
    const double carry = momentum.carry(uphill > 0.0);
    execution.parallel_for_each(count, seed_block, [&](std::size_t i) {
      const Vector3 moved = (stepped[i] + carry * (stepped[i] - arrived[i])).normalized();
      arrived[i] = seeds[i];
      seeds[i] = moved;
    });
    if (!try_evaluation(evaluation, arrived, seeds, report)) {
      report.outcome = RelaxationOutcome::Stuck;
      break;
    }
    arrived.swap(stepped);
  }
  return {std::move(seeds), evaluation.take_triangulation(), evaluation.take_areas(),
          std::move(report)};
}

}  // namespace wscvt
