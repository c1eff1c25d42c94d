// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/templates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "toolbox/sample/nonnegative_minimum.h"
#include "toolbox/sample/random_stream.h"
#include "toolbox/sample/sample_comparison.h"
#include "wscvt/base/error.h"

namespace wscvt {

namespace {

constexpr const char* stage = "Choosing templates";
constexpr std::size_t levels = 100;     ///< points at which distribution functions are compared
constexpr std::size_t candidates = 24;  ///< random grains; the one in largest demand is tried
constexpr int swaps_per_template = 100;
constexpr int least_swaps = 2000;
constexpr int absolute_rounds = 12;  ///< rounds from least squares to least absolute differences
constexpr int random_choices = 20;
/// Weight of the equation that the weights sum to 1, relative to a descriptor's.
constexpr double sum_weight = 1e3;

using Index = Eigen::Index;

/// Distribution functions of all descriptors at `levels` points each, of the sample by number and
/// by mass. A grain's own function is a step at its rank, so the product of two is a sum over the
/// points from the larger rank on.
class StepFunctions {
 public:
  StepFunctions(const Eigen::MatrixXd& standard, const std::vector<double>& masses)
      : ranks_(standard.rows(), standard.cols()) {
    const auto grains = static_cast<std::size_t>(standard.rows());
    for (Index j = 0; j < standard.cols(); ++j) {
      std::vector<double> sorted(grains);
      for (std::size_t i = 0; i < grains; ++i) sorted[i] = standard(i, j);
      std::sort(sorted.begin(), sorted.end());
      std::vector<double> places;
      for (std::size_t q = 0; q < levels; ++q)
        places.push_back(sorted[q * (grains - 1) / (levels - 1)]);
      places.erase(std::unique(places.begin(), places.end()), places.end());
      std::vector<double> number(places.size(), 0.0), mass(places.size(), 0.0),
          width(places.size());
      for (std::size_t i = 0; i < grains; ++i) {
        const auto place = std::lower_bound(places.begin(), places.end(), standard(i, j));
        const auto rank = static_cast<std::size_t>(place - places.begin());
        ranks_(i, j) = static_cast<int>(rank);
        number[rank] += 1.0 / static_cast<double>(grains);
        mass[rank] += masses[i];
      }
      std::partial_sum(number.begin(), number.end(), number.begin());
      std::partial_sum(mass.begin(), mass.end(), mass.begin());
      for (std::size_t q = 0; q < places.size(); ++q) {
        width[q] = 0.5 * (places[std::min(q + 1, places.size() - 1)] - places[q == 0 ? 0 : q - 1]);
      }
      widths_.push_back(std::move(width));
      targets_[0].push_back(std::move(number));
      targets_[1].push_back(std::move(mass));
    }
  }

  Index descriptors() const { return ranks_.cols(); }
  std::size_t grains() const { return static_cast<std::size_t>(ranks_.rows()); }
  const std::vector<std::vector<double>>& widths() const { return widths_; }
  const std::vector<double>& target(int which, Index j) const { return targets_[which][j]; }
  int rank(std::size_t grain, Index j) const { return ranks_(grain, j); }

 private:
  Eigen::MatrixXi ranks_;
  std::vector<std::vector<double>> widths_;
  std::vector<std::vector<double>> targets_[2];  ///< by number, by mass
};

/// The squared differences of distribution functions, summed with weights per point, as a quadratic
/// form of the grains' weights.
class Fit {
 public:
  Fit(const StepFunctions& steps, int which, const std::vector<std::vector<double>>& widths)
      : steps_(steps) {
    for (Index j = 0; j < steps.descriptors(); ++j) {
      const std::vector<double>& width = widths[j];
      std::vector<double> tail(width.size() + 1, 0.0), product(width.size() + 1, 0.0);
      for (std::size_t q = width.size(); q > 0; --q) {
        tail[q - 1] = tail[q] + width[q - 1];
        product[q - 1] = product[q] + width[q - 1] * steps.target(which, j)[q - 1];
      }
      tails_.push_back(std::move(tail));
      products_.push_back(std::move(product));
    }
  }

  double entry(std::size_t a, std::size_t b) const {
    double sum = sum_weight;
    for (Index j = 0; j < steps_.descriptors(); ++j) {
      sum += tails_[j][std::max(steps_.rank(a, j), steps_.rank(b, j))];
    }
    return sum;
  }
  double right_side(std::size_t a) const {
    double sum = sum_weight;
    for (Index j = 0; j < steps_.descriptors(); ++j) {
      sum += products_[j][steps_.rank(a, j)];
    }
    return sum;
  }

 private:
  const StepFunctions& steps_;
  std::vector<std::vector<double>> tails_;
  std::vector<std::vector<double>> products_;
};

/// A set of grains with their best weights.
struct Choice {
  std::vector<std::size_t> grains;
  std::array<Eigen::VectorXd, 2> weights;
  double cost = std::numeric_limits<double>::infinity();
};

void solve(const Fit (&fits)[2], const Eigen::MatrixXd& matrix, Choice& choice) {
  choice.cost = 0.0;
  Eigen::VectorXd right(choice.grains.size());
  for (int which = 0; which < 2; ++which) {
    for (std::size_t k = 0; k < choice.grains.size(); ++k) {
      right[k] = fits[which].right_side(choice.grains[k]);
    }
    const Eigen::VectorXd& before = choice.weights[which];
    std::vector<bool> start(choice.grains.size(), true);
    for (Index k = 0; k < before.size(); ++k) start[k] = before[k] > 0.0;
    Eigen::VectorXd w = nonnegative_minimum(matrix, right, start);
    choice.cost += w.dot(matrix * w) - 2.0 * right.dot(w);
    choice.weights[which] = std::move(w);
  }
}

Eigen::MatrixXd matrix_of(const Fit& fit, const std::vector<std::size_t>& grains) {
  Eigen::MatrixXd matrix(grains.size(), grains.size());
  for (std::size_t i = 0; i < grains.size(); ++i) {
    for (std::size_t k = 0; k < grains.size(); ++k) matrix(i, k) = fit.entry(grains[i], grains[k]);
  }
  return matrix;
}

/// Returns the demand for a grain beside the chosen ones: how much weight the sample's functions
/// would give it.
double demand(const Fit (&fits)[2], const Choice& choice, std::size_t grain) {
  double sum = 0.0;
  for (int which = 0; which < 2; ++which) {
    sum += fits[which].right_side(grain);
    for (std::size_t k = 0; k < choice.grains.size(); ++k) {
      sum -= choice.weights[which][k] * fits[which].entry(grain, choice.grains[k]);
    }
  }
  return sum;
}

std::vector<std::size_t> random_grains(std::size_t grains, std::size_t count,
                                       RandomStream& random) {
  std::vector<std::size_t> order(grains);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = 0; k < count; ++k) std::swap(order[k], order[k + random.below(grains - k)]);
  order.resize(count);
  return order;
}

Choice exchanged(const StepFunctions& steps, const TemplateOptions& options,
                 const Execution& execution) {
  const Fit fits[2] = {Fit(steps, 0, steps.widths()), Fit(steps, 1, steps.widths())};
  RandomStream random(options.seed, 0);
  Choice best;
  best.grains = random_grains(steps.grains(), static_cast<std::size_t>(options.count), random);
  Eigen::MatrixXd matrix = matrix_of(fits[0], best.grains);
  solve(fits, matrix, best);
  std::vector<bool> is_chosen(steps.grains(), false);
  for (const std::size_t grain : best.grains) is_chosen[grain] = true;
  const int swaps = best.grains.size() == steps.grains()
                        ? 0
                        : std::max(least_swaps, swaps_per_template * options.count);
  for (int swap = 0; swap < swaps; ++swap) {
    if (swap % 50 == 0) execution.report(static_cast<double>(swap) / swaps, stage);
    std::size_t wanted = steps.grains();
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < candidates; ++k) {
      const std::size_t grain = random.below(steps.grains());
      if (is_chosen[grain]) continue;
      const double value = demand(fits, best, grain);
      if (value > most) {
        most = value;
        wanted = grain;
      }
    }
    const std::size_t place = random.below(best.grains.size());
    if (wanted == steps.grains()) continue;
    Choice trial = best;
    const std::size_t left = trial.grains[place];
    trial.grains[place] = wanted;
    Eigen::MatrixXd changed = matrix;
    for (std::size_t k = 0; k < trial.grains.size(); ++k) {
      changed(place, k) = changed(k, place) = fits[0].entry(wanted, trial.grains[k]);
    }
    for (Eigen::VectorXd& weights : trial.weights) weights[place] = 1.0;
    solve(fits, changed, trial);
    if (trial.cost < best.cost - 1e-12) {
      best = std::move(trial);
      matrix = std::move(changed);
      is_chosen[left] = false;
      is_chosen[wanted] = true;
    }
  }
  return best;
}

/// Returns the distributions of the descriptors in the sample. They are sorted once, because a
/// sample may have 100,000 grains.
std::vector<Distribution> sample_distributions(const Eigen::MatrixXd& standard,
                                               const std::vector<double>& shares) {
  const Eigen::Map<const Eigen::VectorXd> weights(shares.data(), shares.size());
  std::vector<Distribution> sample;
  for (Index j = 0; j < standard.cols(); ++j) sample.emplace_back(standard.col(j), weights);
  return sample;
}

std::vector<double> distances(const Eigen::MatrixXd& standard,
                              const std::vector<Distribution>& sample,
                              const std::vector<std::size_t>& grains,
                              const std::vector<double>& weights) {
  const Eigen::Map<const Eigen::VectorXd> chosen_weights(weights.data(), weights.size());
  Eigen::VectorXd chosen(grains.size());
  std::vector<double> found;
  for (Index j = 0; j < standard.cols(); ++j) {
    for (std::size_t k = 0; k < grains.size(); ++k) chosen[k] = standard(grains[k], j);
    found.push_back(distance_between(Distribution(chosen, chosen_weights), sample[j]).wasserstein);
  }
  return found;
}

std::vector<double> scaled_to_one(const Eigen::VectorXd& weights) {
  std::vector<double> scaled;
  for (const double weight : weights) scaled.push_back(weight / weights.sum());
  return scaled;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Returns weights of least absolute differences, by least squares with smaller weights at points
/// where the functions are farther apart. The best of all rounds.
std::vector<double> absolute_weights(const StepFunctions& steps, int which,
                                     const Eigen::MatrixXd& standard,
                                     const std::vector<Distribution>& sample,
                                     const Choice& choice) {
  std::vector<double> best = scaled_to_one(choice.weights[which]);
  double least = sum_of(distances(standard, sample, choice.grains, best));
  std::vector<double> now = best;
  for (int round = 0; round < absolute_rounds; ++round) {
    std::vector<std::vector<double>> widths = steps.widths();
    for (Index j = 0; j < steps.descriptors(); ++j) {
      std::vector<double>& width = widths[j];
      std::vector<double> function(width.size(), 0.0);
      for (std::size_t k = 0; k < choice.grains.size(); ++k) {
        function[steps.rank(choice.grains[k], j)] += now[k];
      }
      std::partial_sum(function.begin(), function.end(), function.begin());
      for (std::size_t q = 0; q < width.size(); ++q) {
        width[q] /= std::max(std::abs(function[q] - steps.target(which, j)[q]), 2e-3);
      }
    }
    const Fit fit(steps, which, widths);
    Eigen::VectorXd right(choice.grains.size());
    for (std::size_t k = 0; k < choice.grains.size(); ++k) {
      right[k] = fit.right_side(choice.grains[k]);
    }
    now = scaled_to_one(nonnegative_minimum(matrix_of(fit, choice.grains), right,
                                            std::vector<bool>(choice.grains.size(), true)));
    const double sum = sum_of(distances(standard, sample, choice.grains, now));
    if (sum < least) {
      least = sum;
      best = now;
    }
  }
  return best;
}

/// Adds the sum and the difference of each two descriptors, as further descriptors: distributions
/// along the diagonals, which follow how two descriptors depend on each other. Each is divided by
/// its own deviation.
Eigen::MatrixXd with_pairs(const Eigen::MatrixXd& standard) {
  const Index count = standard.cols();
  Eigen::MatrixXd all(standard.rows(), count * count);
  all.leftCols(count) = standard;
  Index column = count;
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < i; ++j) {
      for (const double sign : {1.0, -1.0}) {
        const Eigen::VectorXd sum = standard.col(i) + sign * standard.col(j);
        const double deviation =
            std::sqrt(sum.squaredNorm() / static_cast<double>(standard.rows()));
        // Of a descriptor that is given twice the difference is nothing.
        all.col(column++) = deviation > 1e-6 ? Eigen::VectorXd(sum / deviation) : standard.col(i);
      }
    }
  }
  return all;
}

/// Scales columns to mean 0 and deviation 1. Throws for unusable inputs.
Eigen::MatrixXd standardised(const Eigen::MatrixXd& descriptors, const std::vector<double>& masses,
                             const TemplateOptions& options) {
  require_in_range(options.count, template_count_option);
  if (descriptors.cols() == 0)
    refuse("There is no descriptor to choose templates with. Give at least one.");
  if (descriptors.rows() == 1) {
    refuse(
        "The sample has one grain, so there is nothing to choose. Give at least two grains. To "
        "remesh one grain, use wscvt remesh.");
  }
  if (descriptors.rows() < options.count) {
    refuse("The sample has " + std::to_string(descriptors.rows()) + " grains, fewer than the " +
           std::to_string(options.count) +
           " templates. Choose fewer templates, or give more grains.");
  }
  if (masses.size() != static_cast<std::size_t>(descriptors.rows())) {
    refuse("There are " + std::to_string(masses.size()) + " masses for " +
           std::to_string(descriptors.rows()) + " grains. Give one each.");
  }
  for (const double mass : masses) {
    if (!(mass > 0.0 && std::isfinite(mass))) refuse("A mass is not above 0. Correct the table.");
  }
  if (!descriptors.allFinite()) refuse("A descriptor is not a number. Leave the grain out.");
  Eigen::MatrixXd standard = descriptors.rowwise() - descriptors.colwise().mean();
  for (Index j = 0; j < standard.cols(); ++j) {
    const double deviation =
        std::sqrt(standard.col(j).squaredNorm() / static_cast<double>(standard.rows()));
    if (!(deviation > 1e-12 * std::max(1e-300, descriptors.col(j).cwiseAbs().maxCoeff()))) {
      refuse("Descriptor " + std::to_string(j + 1) +
             " is equal for all grains, so it cannot choose templates. Leave it out.");
    }
    standard.col(j) /= deviation;
  }
  return standard;
}

TemplateDistances random_distances(const Eigen::MatrixXd& standard,
                                   const std::vector<Distribution>& by_number,
                                   const std::vector<Distribution>& by_mass,
                                   const TemplateOptions& options) {
  const auto descriptors = static_cast<std::size_t>(standard.cols());
  TemplateDistances mean{std::vector<double>(descriptors, 0.0),
                         std::vector<double>(descriptors, 0.0)};
  const std::vector<double> weights(static_cast<std::size_t>(options.count), 1.0);
  for (int choice = 0; choice < random_choices; ++choice) {
    RandomStream random(options.seed, 1, static_cast<std::uint64_t>(choice));
    const std::vector<std::size_t> grains = random_grains(
        static_cast<std::size_t>(standard.rows()), static_cast<std::size_t>(options.count), random);
    const std::vector<double> number = distances(standard, by_number, grains, weights);
    const std::vector<double> mass = distances(standard, by_mass, grains, weights);
    for (std::size_t j = 0; j < descriptors; ++j) {
      mean.by_number[j] += number[j] / random_choices;
      mean.by_mass[j] += mass[j] / random_choices;
    }
  }
  return mean;
}

}  // namespace

SampleTemplates choose_templates(const Eigen::MatrixXd& descriptors,
                                 const std::vector<double>& masses, const TemplateOptions& options,
                                 const Execution& execution) {
  const Eigen::MatrixXd standard = standardised(descriptors, masses, options);
  const std::vector<double> equal(masses.size(), 1.0 / static_cast<double>(masses.size()));
  std::vector<double> mass_shares = masses;
  const double whole = sum_of(masses);
  for (double& mass : mass_shares) mass /= whole;
  const std::vector<Distribution> sample_by_number = sample_distributions(standard, equal);
  const std::vector<Distribution> sample_by_mass = sample_distributions(standard, mass_shares);
  SampleTemplates templates;
  if (masses.size() == static_cast<std::size_t>(options.count)) {
    templates.grains.resize(masses.size());
    std::iota(templates.grains.begin(), templates.grains.end(), std::size_t{0});
    templates.by_number = equal;
    templates.by_mass = mass_shares;
  } else {
    const Eigen::MatrixXd all = with_pairs(standard);
    const StepFunctions steps(all, mass_shares);
    const Choice choice = exchanged(steps, options, execution);
    const std::vector<double> number =
        absolute_weights(steps, 0, all, sample_distributions(all, equal), choice);
    const std::vector<double> mass =
        absolute_weights(steps, 1, all, sample_distributions(all, mass_shares), choice);
    std::vector<std::size_t> order(choice.grains.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t k) { return choice.grains[i] < choice.grains[k]; });
    for (const std::size_t k : order) {
      templates.grains.push_back(choice.grains[k]);
      templates.by_number.push_back(number[k]);
      templates.by_mass.push_back(mass[k]);
    }
  }
  templates.reached = {distances(standard, sample_by_number, templates.grains, templates.by_number),
                       distances(standard, sample_by_mass, templates.grains, templates.by_mass)};
  templates.random = random_distances(standard, sample_by_number, sample_by_mass, options);
  templates.stands_for.resize(masses.size());
  for (std::size_t i = 0; i < masses.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < templates.grains.size(); ++k) {
      const double square = (standard.row(i) - standard.row(templates.grains[k])).squaredNorm();
      if (square < least) {
        least = square;
        templates.stands_for[i] = k;
      }
    }
  }
  return templates;
}

}  // namespace wscvt
