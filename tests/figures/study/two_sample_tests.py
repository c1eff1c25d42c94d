#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How often tests find a difference (p <= 0.05) between two samples of one population: permutation and bootstrap.

    tests/figures/study/two_sample_tests.py [--trials 1000]

Sizes are lognormal (deviation 0.4 of the logarithm), masses their cubes. Prints one row per number of
grains in a sample: the fraction of trials with p <= 0.05 by Wasserstein's and by Kolmogorov's distance,
once with random divisions of all grains (permutation, as in "wscvt sample"), once with two random samples
drawn with replacement from all grains (bootstrap). The right value is 0.05. Needs NumPy.
"""
import argparse

import numpy as np

REPETITIONS = 199


def distances(values, one, other):
    """Of rows of ascending values and the weights of two samples: Wasserstein's and Kolmogorov's."""
    below = [np.cumsum(w, -1) / w.sum(-1, keepdims=True) for w in (one, other)]
    difference = np.abs(below[0] - below[1])[:, :-1]
    gap = np.diff(values, axis=-1)
    return (difference * gap).sum(-1), np.where(gap > 0, difference, 0).max(-1)


def p_values(random, grains, by_mass):
    count = 2 * grains
    values = np.sort(np.exp(random.normal(0, 0.4, count)))
    weights = values**3 if by_mass else np.ones(count)
    is_one = (random.permutation(count) < grains)[None]
    own = distances(values[None], weights * is_one, weights * ~is_one)
    parted = np.argsort(random.random((REPETITIONS, count)), -1) < grains
    permuted = distances(np.broadcast_to(values, parted.shape), weights * parted, weights * ~parted)
    drawn = random.integers(0, count, (REPETITIONS, count))
    order = np.argsort(drawn, -1, kind="stable")
    drawn, first = np.take_along_axis(drawn, order, -1), order < grains
    booted = distances(values[drawn], weights[drawn] * first, weights[drawn] * ~first)
    return [(1 + (far >= limit * (1 - 1e-12)).sum()) / (REPETITIONS + 1)
            for made in (permuted, booted) for far, limit in zip(made, own)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trials", type=int, default=1000)
    trials = parser.parse_args().trials
    random = np.random.default_rng(1)
    print("| grains a sample | weight | permutation, W | K-S | bootstrap, W | K-S |\n|---|---|---|---|---|---|")
    for grains in (10, 30, 100):
        for by_mass in (False, True):
            p = np.array([p_values(random, grains, by_mass) for _ in range(trials)])
            cells = " | ".join(f"{fraction:.3f}" for fraction in (p <= 0.05).mean(0))
            print(f"| {grains} | by {'mass' if by_mass else 'number'} | {cells} |")


if __name__ == "__main__":
    main()
