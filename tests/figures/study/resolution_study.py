#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the rows of resolution_study.

orders ROWS...  measures the orders, floors and widths, and prints the table of descriptor_orders.cpp
table ROWS...   prints errors, raw and corrected, and how often the intervals cover the true values
"""

import collections
import csv
import math
import sys

import numpy as np

BOUNDED = ("sphericity", "convexity", "aspect_ratio", "zingg", "krumbein", "kong_fonseca", "compactness",
           "flakiness", "rodness", "roundness", "orientation")
# Below so many voxels across the extrapolation of roundness gains nothing: rms .048 from .047 at 20 on the bodies of the
# orders, .026 from .034 at 40.
LEAST = {"roundness_wadell": 30}
# Their floor hides them: at 40 voxels across Sq reads .06 voxels on a smooth body, and all bodies of the orders have less
# than .12.
HIDDEN = ("sa", "sq", "sku")
# Lengths of the method, and numbers that depend on the pose.
OF_METHOD = ("roundness_smallest_radius", "roughness_cutoff", "sq_form_leak", "ssk", "sdq_clipped_fraction", "sdq_printed")
COVERED = 0.99  # of the rows by which widths are chosen: rows of one body fail together, and other bodies differ
SHOWN = ("area", "sphericity_wadell", "convexity", "aspect_ratio_inertia", "zingg_flatness_inertia", "axis_s_box",
         "sdq_invariant", "roundness_wadell", "sq")


def read(*paths):
    """Returns the rows of each descriptor as arrays."""
    rows = []
    for path in paths:
        with open(path, encoding="utf-8") as stream:
            rows += csv.DictReader(stream)
    names = ("across", "truth", "value", "coarse", "scatter", "corrected", "low", "high")
    found = collections.defaultdict(lambda: {name: [] for name in ("body", *names)})
    for row in rows:
        into = found[row["key"]]
        into["body"].append(row["body"])
        for name in names:
            into[name].append(float(row[name]))
    return {key: {name: np.array(column) for name, column in columns.items()} for key, columns in found.items()}


def size_of(rows):
    """The typical size of a descriptor of each body: bodies have different units of length."""
    return np.where(np.abs(rows["truth"]) > 0, np.abs(rows["truth"]), 1.0)


def fit(key, rows):
    """Returns order, floor, share and scatters of a descriptor, and the residual by voxels across."""
    least = LEAST.get(key, 10)
    good = np.isfinite(rows["value"] + rows["coarse"] + rows["scatter"] + rows["truth"]) & (rows["across"] >= least)
    if good.sum() < 40 or key in HIDDEN or key in OF_METHOD:
        return None
    of = {name: column[good] for name, column in rows.items()}
    size = np.ones(good.sum()) if key.startswith(BOUNDED) else size_of(of)
    change = (of["value"] - of["coarse"]) / size
    value = of["value"] / size
    error = (of["truth"] - of["value"]) / size
    weight = of["across"]  # errors fall with the number of voxels
    best = None
    for order in np.arange(0.5, 4.01, 0.1):
        a = 1.0 / (2.0 ** order - 1.0)
        rest = error - a * change
        floor = np.sum(weight * rest * value) / np.sum(weight * value * value)
        loss = np.sum(weight * np.abs(rest - floor * value))
        if best is None or loss < best[0]:
            best = (loss, order, floor)
    none = np.sum(weight * np.abs(error))
    loss, order, floor = best
    if loss > 0.95 * none:  # not worth a correction
        order, floor = math.inf, 0.0
    left = error - change / (2.0 ** order - 1.0) - floor * value
    # Shares of rows outside of each side: half of the rest.
    sides = (np.maximum(-left, 0.0), np.maximum(left, 0.0))
    covered = 1.0 - (1.0 - COVERED) / 2.0
    scatter = of["scatter"] / size
    near = np.abs(value) / of["across"]
    chosen = None
    for share in (0.0, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5):
        for scatters in (0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0):
            half = share * np.abs(change) + scatters * scatter
            for rest in (0.0, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32):
                if share + scatters + rest == 0.0:
                    continue
                whole = half + rest * near
                with np.errstate(divide="ignore", invalid="ignore"):
                    ratios = [np.where(whole > 0, side / whole, np.where(side > 0, np.inf, 0.0)) for side in sides]
                # Each number of voxels across is covered, not only all together.
                scales = [max(np.quantile(ratio[of["across"] == d], covered) for d in np.unique(of["across"]))
                          for ratio in ratios]
                if not np.all(np.isfinite(scales)) or scales[0] == 0.0:
                    continue
                width = sum(scales) * np.mean(whole * of["across"])
                if chosen is None or width < chosen[0]:
                    chosen = (width, scales[0] * share, scales[0] * scatters, scales[0] * rest, scales[1] / scales[0])
    _, share, scatters, rest, above = chosen
    return least, order, floor, share, scatters, rest, above, np.sum(weight * np.abs(left)) / none


def told(order):
    return "none" if math.isinf(order) else f"{order:.1f}"


def orders(paths):
    for key, rows in read(*paths).items():
        found = fit(key, rows)
        if found is None:
            print(f"    // {key}: no order")
            continue
        least, order, floor, share, scatters, rest, above, gain = found
        print(f'    {{"{key}", {0.95 * least:.1f}, {told(order)}, {floor:.4f}, {share:.2f}, {scatters:.2f}, {rest:.3f}, {above:.2f}}},'
              f"  // {gain:.2f}")


def percent(values):
    return f"{100 * values:.2f}"


def table(paths):
    print("descriptor | voxels across | rows | resolved % | raw error % | corrected error %, rms | largest body mean "
          "% | half width % | covered %")
    for key, rows in read(*paths).items():
        if key not in SHOWN:
            continue
        for across in np.unique(rows["across"]):
            at = (rows["across"] == across) & np.isfinite(rows["truth"])
            of = {name: column[at] for name, column in rows.items()}
            done = np.isfinite(of["corrected"])
            size = np.abs(of["truth"])
            if key.startswith("roundness"):
                size = np.ones(len(size))
            raw = (of["value"] - of["truth"]) / size
            if not done.any():
                print(f"{key} | {across:.0f} | {at.sum()} | 0 | {percent(math.sqrt(np.nanmean(raw ** 2)))} | | | |")
                continue
            error = ((of["corrected"] - of["truth"]) / size)[done]
            inside = ((of["low"] <= of["truth"]) & (of["truth"] <= of["high"]))[done]
            half = ((of["high"] - of["low"]) / 2 / size)[done]
            names = of["body"][done]
            worst = max(abs(error[names == name].mean()) for name in set(names))
            print(f"{key} | {across:.0f} | {at.sum()} | {100 * done.mean():.0f} | "
                  f"{percent(math.sqrt(np.nanmean(raw ** 2)))} | {percent(math.sqrt(np.mean(error ** 2)))} | "
                  f"{percent(worst)} | {percent(half.mean())} | {100 * inside.mean():.1f}")


if __name__ == "__main__":
    {"orders": orders, "table": table}[sys.argv[1]](sys.argv[2:])
