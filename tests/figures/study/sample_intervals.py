#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How often the 95 % intervals of "wscvt sample" (percentile bootstrap) hold the true size.

    tests/figures/study/sample_intervals.py [--trials 1000]

Sizes are lognormal (deviation 0.4 of the logarithm), masses their cubes. Quantiles are Hazen's, by number
and by mass. Prints a row per number of grains: the fraction of samples whose interval of D10, D50 and D90
holds that of the population. The right value is 0.95. Needs NumPy.
"""
import argparse

import numpy as np

REPETITIONS = 400
DEVIATION = 0.4
SHARES = (0.1, 0.5, 0.9)
NORMAL = np.array([-1.2815515655446004, 0.0, 1.2815515655446004])  # its quantiles at the shares


def quantiles(values, weights):
    """Of rows of ascending values."""
    middles = (np.cumsum(weights, -1) - 0.5 * weights) / weights.sum(-1, keepdims=True)
    rows = np.arange(len(values))
    found = []
    for share in SHARES:
        above = np.clip((middles < share).sum(-1), 1, values.shape[-1] - 1)
        low, high = middles[rows, above - 1], middles[rows, above]
        part = np.clip((share - low) / (high - low), 0, 1)
        found.append(values[rows, above - 1] + part * (values[rows, above] - values[rows, above - 1]))
    return np.array(found)


def holds(random, grains, by_mass):
    sizes = np.exp(random.normal(0, DEVIATION, grains))
    drawn = np.sort(sizes[random.integers(0, grains, (REPETITIONS, grains))], -1)
    low, high = np.quantile(quantiles(drawn, drawn**3 if by_mass else np.ones_like(drawn)), (0.025, 0.975),
                            axis=-1, method="hazen")
    # The mass of lognormal sizes is lognormal too.
    true = np.exp(DEVIATION * NORMAL + (3 * DEVIATION**2 if by_mass else 0))
    return (low <= true) & (true <= high)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trials", type=int, default=1000)
    trials = parser.parse_args().trials
    random = np.random.default_rng(1)
    print("| grains | weight | D10 | D50 | D90 |\n|---|---|---|---|---|")
    for grains in (10, 30, 100, 300, 1000):
        for by_mass in (False, True):
            held = np.mean([holds(random, grains, by_mass) for _ in range(trials)], axis=0)
            print(f"| {grains} | by {'mass' if by_mass else 'number'} | {' | '.join(f'{x:.2f}' for x in held)} |")


if __name__ == "__main__":
    main()
