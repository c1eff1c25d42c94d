#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the rows of resolution_study. Every second body of a file, from the first, gives the biases; the others judge.

biases ROWS...  prints the table of descriptor_biases.cpp for exact labels
scans ROWS...   prints the table as it is, with intervals that hold for all bodies of rows of exact labels and of segmented scans
table ROWS...   prints errors of the other bodies, raw and corrected, and how often the intervals cover the true values
each ROWS...    prints the error of area, raw and corrected, with each of all bodies left out of its own fit
judge ROWS...   prints the same errors, and widths of the intervals, of all bodies of rows by the table as it is
cutoff ROWS...  prints what a smallest volume leaves out of the bodies of rows made with --voxel, and what ours keeps
"""

import collections
import csv
import math
import pathlib
import re
import sys

import numpy as np

BOUNDED = ("sphericity", "convexity", "aspect_ratio", "zingg", "krumbein", "kong_fonseca", "compactness",
           "flakiness", "rodness", "roundness", "orientation")
# Below so many voxels across some bodies have no roundness, because their edges are too long.
LEAST = {"roundness_wadell": 15}
# Their floor hides them: at 40 voxels across Sq reads .06 voxels on a smooth body, and all bodies have less than .12.
HIDDEN = ("sa", "sq", "sku")
# Lengths of the method, and numbers that depend on the pose.
OF_METHOD = ("roundness_smallest_radius", "roughness_cutoff", "sq_form_leak", "ssk", "sdq_clipped_fraction", "sdq_printed")
COVERED = 0.97  # of the rows by which widths are chosen: rows of one body fail together, and other bodies differ
SHOWN = ("area", "sphericity_wadell", "convexity", "aspect_ratio_inertia", "zingg_flatness_inertia", "axis_s_box",
         "mean_curvature_integral", "sdq_invariant", "roundness_wadell", "sq")
NAMES = ("across", "truth", "value", "again", "scatter")


def read(paths, judging):
    """Returns the rows of each descriptor as arrays, of the bodies that judge or of the others; None: of all."""
    found = collections.defaultdict(lambda: {name: [] for name in ("body", *NAMES)})
    for path in paths:
        with open(path, encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
        bodies = list(dict.fromkeys(row["body"] for row in rows))
        for row in rows:
            if judging is not None and bodies.index(row["body"]) % 2 != judging:
                continue
            into = found[row["key"]]
            into["body"].append(path + row["body"])
            for name in NAMES:
                into[name].append(float(row[name]))
    return {key: {name: np.array(column) for name, column in columns.items()} for key, columns in found.items()}


def terms(rows, size):
    change = (rows["value"] - rows["again"]) / size
    value = rows["value"] / size
    u = 10.0 / rows["across"]
    return np.array([change, change * u, value, value * u]).T


def least_absolute(matrix, error, weight):
    """Returns the coefficients of the smallest weighted sum of absolute errors, by repeated least squares."""
    scale = weight
    for _ in range(30):
        root = np.sqrt(scale)[:, None]
        solved = np.linalg.lstsq(matrix * root, error * root[:, 0], rcond=1e-9)[0]
        scale = weight / np.maximum(np.abs(error - matrix @ solved), 1e-3)
    return solved


def widths(key_rows, left, size):
    """Returns share, scatters, rest and above of the narrowest intervals that cover the errors that are left."""
    change = np.abs(key_rows["value"] - key_rows["again"]) / size
    scatter = key_rows["scatter"] / size
    near = np.abs(key_rows["value"]) / size / key_rows["across"]
    sides = (np.maximum(-left, 0.0), np.maximum(left, 0.0))
    covered = 1.0 - (1.0 - COVERED) / 2.0  # half of the rest is outside of each side
    groups = key_rows["across"] + 1000 * key_rows.get("kind", 0)
    chosen = None
    for share in (0.0, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5):
        for scatters in (0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0):
            for rest in (0.0, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32):
                whole = share * change + scatters * scatter + rest * near
                with np.errstate(divide="ignore", invalid="ignore"):
                    ratios = [np.where(whole > 0, side / whole, np.where(side > 0, np.inf, 0.0)) for side in sides]
                # Each number of voxels across, and each file of `scans`, is covered, not only all together.
                scales = [max(np.quantile(ratio[groups == d], covered) for d in np.unique(groups)) for ratio in ratios]
                if not np.all(np.isfinite(scales)) or scales[0] == 0.0:
                    continue
                width = sum(scales) * np.mean(whole * key_rows["across"])
                if chosen is None or width < chosen[0]:
                    chosen = (width, scales[0] * share, scales[0] * scatters, scales[0] * rest, scales[1] / scales[0])
    return chosen[1:]


def size_of(key, rows):
    """Errors are relative to it: bodies have different units of length."""
    if key.startswith(BOUNDED):
        return np.ones(len(rows["truth"]))
    return np.where(np.abs(rows["truth"]) > 0, np.abs(rows["truth"]), 1.0)


def left_out(rows, matrix, error):
    """Returns the errors that are left with each body left out of its own fit; rows of more voxels count more."""
    left = np.zeros(len(error))
    for body in set(rows["body"]):
        own = rows["body"] == body
        left[own] = error[own] - matrix[own] @ least_absolute(matrix[~own], error[~own], rows["across"][~own])
    return left


def fit(key, rows):
    """Returns a row of the table, and the error that is left over the error without correction; None: no bias is known."""
    least = LEAST.get(key, 10)
    good = np.isfinite(rows["value"] + rows["again"] + rows["scatter"] + rows["truth"]) & (rows["across"] >= least)
    if good.sum() < 40 or key in HIDDEN or key in OF_METHOD:
        return None
    of = {name: column[good] for name, column in rows.items()}
    size = size_of(key, of)
    error = (of["truth"] - of["value"]) / size
    weight = of["across"]  # errors fall with the number of voxels
    matrix = terms(of, size)
    found = least_absolute(matrix, error, weight)
    # Each body is judged by the others, so that widths know what a new body will do.
    left = left_out(of, matrix, error)
    gain = np.sum(weight * np.abs(left)) / np.sum(weight * np.abs(error))
    if gain > 0.85:  # not worth a correction: what gained less here lost on other bodies
        found, left = np.zeros(4), error
    most = 1.0 if key.startswith(BOUNDED) else math.inf
    return (most, 0.95 * least, *found, *widths(of, left, size)), gain


def told(number):
    return "none" if math.isinf(number) else f"{number:.4g}"


def biases(paths):
    for key, rows in read(paths, False).items():
        found = fit(key, rows)
        if found is None:
            print(f"    // {key}: not known")
            continue
        print(f'    {{"{key}", ' + ", ".join(told(number) for number in found[0]) + f"}},  // {found[1]:.2f}")


def table_of_library():
    path = pathlib.Path(__file__).resolve().parents[3] / "lib/toolbox/resolution/descriptor_biases.cpp"
    rows = re.findall(r'\{"(\w+)",([^}]*)\}', path.read_text(encoding="utf-8"))
    return {key: [float(cell.replace("none", "inf")) for cell in cells.split(",")] for key, cells in rows}


def scans(paths):
    """A file whose name has the blur of its scan after a "_" is a kind of its own; see README.md."""
    kinds = sorted({pathlib.Path(path).stem.rsplit("_", 1)[-1] for path in paths})
    found = {}
    for number, kind in enumerate(kinds):
        for key, rows in read([path for path in paths if pathlib.Path(path).stem.rsplit("_", 1)[-1] == kind], None).items():
            found.setdefault(key, []).append({**rows, "kind": np.full(len(rows["truth"]), number)})
    all_rows = {key: {name: np.concatenate([one[name] for one in list_]) for name in list_[0]} for key, list_ in found.items()}
    # A volume that is off by 8 % is a scan whose threshold failed, as of single grains of 10 voxels with a blur of a voxel.
    failed = np.abs(all_rows["volume"]["value"] / all_rows["volume"]["truth"] - 1) > 0.08
    print(f"// {failed.sum()} of {len(failed)} scans failed")
    for key, bias in table_of_library().items():
        rows = all_rows[key]
        good = np.isfinite(rows["value"] + rows["again"] + rows["scatter"] + rows["truth"]) & ~failed & (rows["across"] >= bias[1])
        of = {name: column[good] for name, column in rows.items()}
        size = size_of(key, of)
        left = (of["truth"] - of["value"]) / size - terms(of, size) @ np.array(bias[2:6])
        share, scatters, rest, above = widths(of, left, size)
        parts = np.array([np.abs(of["value"] - of["again"]) / size, of["scatter"] / size, np.abs(of["value"]) / size / of["across"]])
        groups = of["across"] + 1000 * of["kind"]
        # No side becomes narrower than it was: the table was measured on other bodies.
        old, new = (np.array([(np.array(one) @ parts)[groups == d].mean() for d in np.unique(groups)])
                    for one in (bias[6:9], (share, scatters, rest)))
        below, beyond = max(1.0, np.max(old / new)), max(1.0, np.max(bias[9] * old / (above * new)))
        print(f'    {{"{key}", ' + ", ".join(told(number) for number in (
            *bias[:6], below * share, below * scatters, below * rest, above * beyond / below)) + "},")


def percent(values):
    return f"{100 * values:.2f}"


def corrected(key, bias, rows):
    """Returns corrected values, low and high, as resolution.cpp does."""
    most, least, gain, gain_u, floor, floor_u, share, scatters, rest, above = bias
    u = 10.0 / rows["across"]
    change = rows["value"] - rows["again"]
    value = (1.0 + floor + floor_u * u) * rows["value"] + (gain + gain_u * u) * change
    below = share * np.abs(change) + scatters * rows["scatter"] + rest * np.abs(rows["value"]) / rows["across"]
    value = np.where(rows["across"] < least, np.nan, value)
    return [np.clip(one, 0.0, most) for one in (value, value - below, value + above * below)]


def table(paths):
    print("descriptor | voxels across | bodies | rows | resolved % | raw error %, rms | corrected error %, rms | largest body "
          "mean % | half width % | covered %")
    fitted = read(paths, False)
    for key, rows in read(paths, True).items():
        if key not in SHOWN:
            continue
        bias = fit(key, fitted[key])
        for across in np.unique(rows["across"]):
            at = (rows["across"] == across) & np.isfinite(rows["truth"])
            of = {name: column[at] for name, column in rows.items()}
            size = np.ones(at.sum()) if key.startswith("roundness") else np.abs(of["truth"])
            raw = (of["value"] - of["truth"]) / size
            head = f"{key} | {across:.0f} | {len(set(of['body']))} | {at.sum()} | "
            if bias is None:
                print(head + f"0 | {percent(math.sqrt(np.nanmean(raw ** 2)))} | | | |")
                continue
            values, low, high = corrected(key, bias[0], of)
            done = np.isfinite(values)
            if not done.any():
                print(head + f"0 | {percent(math.sqrt(np.nanmean(raw ** 2)))} | | | |")
                continue
            error = ((values - of["truth"]) / size)[done]
            inside = ((low <= of["truth"]) & (of["truth"] <= high))[done]
            half = ((high - low) / 2 / size)[done]
            names = of["body"][done]
            worst = max(abs(error[names == name].mean()) for name in set(names))
            print(head + f"{100 * done.mean():.0f} | {percent(math.sqrt(np.mean(raw[done] ** 2)))} | "
                  f"{percent(math.sqrt(np.mean(error ** 2)))} | {percent(worst)} | {percent(half.mean())} | "
                  f"{100 * inside.mean():.1f}")


def judge(paths):
    print("descriptor | voxels across | rows | raw error %, mean, rms | corrected error %, mean, rms | low, high: % from the "
          "corrected value | covered %")
    biases_ = table_of_library()
    for key, rows in read(paths, None).items():
        if key not in (*SHOWN[:-1], "feret_max", "feret_min"):
            continue
        for across in np.unique(rows["across"]):
            of = {name: column[rows["across"] == across] for name, column in rows.items()}
            size = np.ones(len(of["truth"])) if key.startswith("roundness") else np.abs(of["truth"])
            value, low, high = corrected(key, biases_[key], of)
            errors = [(one - of["truth"]) / size for one in (of["value"], value)]
            errors = [f"{percent(one.mean())}, {percent(math.sqrt(np.mean(one ** 2)))}" for one in errors]
            covered = 100 * ((low <= of["truth"]) & (of["truth"] <= high)).mean()
            print(f"{key} | {across:.0f} | {len(value)} | " + " | ".join(errors) + f" | {percent(np.mean((low - value) / size))}, "
                  f"{percent(np.mean((high - value) / size))} | " + ("" if np.isnan(value).all() else f"{covered:.0f}"))


def each(paths):
    rows = read(paths, None)["area"]
    error = (rows["truth"] - rows["value"]) / rows["truth"]
    left = left_out(rows, terms(rows, rows["truth"]), error)
    print(f"{len(set(rows['body']))} bodies: voxels across | raw error %, rms | corrected error %, rms")
    for across in np.unique(rows["across"]):
        at = rows["across"] == across
        print(f"{across:.0f} | " + " | ".join(percent(math.sqrt(np.mean(one[at] ** 2))) for one in (error, left)))


def rank_correlation(one, other):
    return np.corrcoef(one.argsort().argsort(), other.argsort().argsort())[0, 1] if len(one) > 2 else math.nan


def cutoff(paths):
    print("bodies, voxels across | kept | bodies % | volume % | mean sphericity - that of all | correlation with size | true one")
    for path in paths:
        with open(path, encoding="utf-8") as stream:
            rows = [row for row in csv.DictReader(stream) if row["key"] in ("volume", "sphericity_wadell")]
        of = {(row["body"], row["key"]): row for row in rows}
        names = sorted({row["body"] for row in rows})

        def column(key, name):
            return np.array([float(of[body, key][name]) for body in names])

        across, volume = column("volume", "across"), column("volume", "truth")
        truth, raw = column("sphericity_wadell", "truth"), column("sphericity_wadell", "value")
        corrected = column("sphericity_wadell", "corrected")
        voxels = np.pi / 6 * across ** 3
        chosen = [("true", truth, voxels > 0)]
        chosen += [(f"raw, from {least} voxels on", raw, voxels >= least) for least in (100, 1000, 4000)]
        chosen += [("raw, resolved", raw, np.isfinite(corrected)), ("corrected, resolved", corrected, np.isfinite(corrected))]
        for name, values, kept in chosen:
            print(f"{len(names)}, {across.min():.1f} to {across.max():.1f} | {name} | {100 * kept.mean():.0f} | "
                  f"{100 * volume[kept].sum() / volume.sum():.0f} | {values[kept].mean() - truth.mean():+.4f} | "
                  f"{rank_correlation(across[kept], values[kept]):+.2f} | {rank_correlation(across[kept], truth[kept]):+.2f}")


if __name__ == "__main__":
    {"biases": biases, "scans": scans, "table": table, "judge": judge, "each": each, "cutoff": cutoff}[sys.argv[1]](sys.argv[2:])
