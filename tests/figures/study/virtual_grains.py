#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of virtual_grains.md: wscvt grow on a population of real grains.

    tests/figures/study/virtual_grains.py PROGRAM FOLDER [--seed 1] [--grown 1000] [--splits 4]

FOLDER contains SH coefficients (*.dat, `n m Re Im`). Half of the grains, drawn by the seed, are the
sample. The others judge the result. The script repeats two published generators with the same sample: a
Gaussian of principal components with 95 % of the variance, and a Nataf transform of all coefficients.
With --splits the table has only `wscvt grow`, for the seeds 1, 2, ... and their medians. Needs
python3-numpy, python3-scipy and python3-sklearn, and ten minutes of processor time.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import tempfile

os.environ.setdefault("OMP_NUM_THREADS", "1")
import numpy
from scipy.spatial import ConvexHull
from scipy.special import lpmv
from scipy.stats import ks_2samp, norm, rankdata, wasserstein_distance
from sklearn.ensemble import ExtraTreesClassifier, HistGradientBoostingClassifier
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import roc_auc_score
from sklearn.model_selection import StratifiedKFold, cross_val_predict
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

DEGREE = 20
DEGREES = numpy.repeat(numpy.arange(DEGREE + 1), 2 * numpy.arange(DEGREE + 1) + 1)


def lattice(count):
    i = numpy.arange(count) + 0.5
    azimuth, z = numpy.pi * (1 + 5 ** 0.5) * i, 1 - 2 * i / count
    sine = numpy.sqrt(1 - z * z)
    return numpy.c_[sine * numpy.cos(azimuth), sine * numpy.sin(azimuth), z]


def basis(u):
    """Real orthonormal harmonics with the Condon-Shortley phase, a row per direction."""
    azimuth = numpy.arctan2(u[:, 1], u[:, 0])
    columns = []
    for n in range(DEGREE + 1):
        for m in range(-n, n + 1):
            k = abs(m)
            scale = (2 * n + 1) / (4 * numpy.pi)
            for i in range(n - k + 1, n + k + 1):
                scale /= i
            value = numpy.sqrt(scale) * lpmv(k, n, u[:, 2])
            if m != 0:
                value = value * 2 ** 0.5 * (numpy.cos if m > 0 else numpy.sin)(k * azimuth)
            columns.append(value)
    return numpy.array(columns).T


POINTS = lattice(1500)
BASIS = basis(POINTS)
TRIANGLES = ConvexHull(POINTS).simplices
CORNERS = POINTS[TRIANGLES]
INWARD = numpy.linalg.det(CORNERS) < 0
TRIANGLES[INWARD] = TRIANGLES[INWARD][:, ::-1]
LOW = DEGREES <= 6


def moments(r):
    weight = 4 * numpy.pi / len(r)
    volume = (r ** 3).sum() * weight / 3
    centroid = (r[:, None] ** 4 * POINTS).sum(0) * weight / 4 / volume
    second = (POINTS * (r ** 5)[:, None]).T @ POINTS * weight / 5 / volume
    return volume, centroid, second - numpy.outer(centroid, centroid)


def read(path):
    """The coefficients of a file about the origin, real."""
    c = numpy.zeros(len(DEGREES))
    for n, m, re, im in numpy.loadtxt(path, ndmin=2):
        n, m = int(n), int(m)
        if n <= DEGREE and m >= 0:
            k = n * n + n
            c[k + m] = re * (2 ** 0.5 if m else 1)
            if m:
                c[k - m] = -im * 2 ** 0.5
    # Y_n,m = sqrt 2 Re and Im of the complex ones: a sum a Y over both signs of m is this.
    return c


def standing(c):
    """About the centroid, in the principal frame, of radius 1; None if it has no radius there."""
    r = BASIS @ c
    if r.min() <= 0:
        return None
    _, centroid, second = moments(r)
    axes = numpy.linalg.eigh(second)[1][:, ::-1]
    q = (POINTS * r[:, None] - centroid) @ axes
    sign = numpy.where((q ** 3).mean(0) >= 0, 1.0, -1.0)
    sign[2] *= numpy.linalg.det(axes * sign)
    q = q * sign
    radius = numpy.linalg.norm(q, axis=1)
    b = basis(q / radius[:, None])
    c = numpy.linalg.solve(b.T @ b + 1e-6 * numpy.eye(len(c)), b.T @ radius)
    r = BASIS @ c
    return None if r.min() <= 0 else c / (3 * moments(r)[0] / 4 / numpy.pi) ** (1 / 3)


def normals(mesh):
    a, b, c = (mesh[TRIANGLES[:, k]] for k in range(3))
    return numpy.cross(b - a, c - a) / 2


NAMES = (["sphericity", "I/L", "S/I", "convexity", "largest radius", "smallest radius",
          "skewness of ln r", "deviation of the white radius", "skewness of detail",
          "kurtosis of detail", "slope of detail", "kurtosis of bends"]
         + ["amplitude %d" % n for n in range(2, DEGREE + 1)])
EDGES = numpy.unique(numpy.sort(numpy.concatenate(
    [TRIANGLES[:, [0, 1]], TRIANGLES[:, [1, 2]], TRIANGLES[:, [2, 0]]]), axis=1), axis=0)


def bends(mesh):
    """Mean curvature at the points, by the umbrella of the edges over their mean square length."""
    difference = numpy.zeros_like(mesh)
    square = numpy.zeros(len(mesh))
    count = numpy.zeros(len(mesh))
    step = mesh[EDGES[:, 1]] - mesh[EDGES[:, 0]]
    for end, sign in ((0, 1), (1, -1)):
        numpy.add.at(difference, EDGES[:, end], sign * step)
        numpy.add.at(square, EDGES[:, end], (step ** 2).sum(1))
        numpy.add.at(count, EDGES[:, end], 1)
    normal = numpy.zeros_like(mesh)
    for k in range(3):
        numpy.add.at(normal, TRIANGLES[:, k], normals(mesh))
    area = numpy.linalg.norm(normal, axis=1)
    return -(difference * normal).sum(1) / area / (square / 4), area / area.sum()


def described(c):
    """Numbers of a grain of radius 1 in its principal frame; None if it is not star-shaped."""
    r = BASIS @ c
    if r.min() <= 0.02:
        return None
    volume, centroid, second = moments(r)
    spread, axes = numpy.linalg.eigh(second)
    s = numpy.sqrt(spread)
    mesh = POINTS * r[:, None]
    n = normals(mesh)
    area = numpy.linalg.norm(n, axis=1)
    solid = (mesh[TRIANGLES[:, 0]] * n).sum(1).sum() / 3
    white = numpy.linalg.norm((mesh - centroid) @ axes / s, axis=1)
    low = BASIS[:, LOW] @ c[LOW]
    smooth = normals(POINTS * low[:, None])
    cosine = (n * smooth).sum(1) / area / numpy.linalg.norm(smooth, axis=1)
    detail = r - low - (r - low).mean()
    ln = numpy.log(r) - numpy.log(r).mean()
    bend, share = bends(mesh)
    bend = bend - (share * bend).sum()
    amplitudes = numpy.sqrt(numpy.bincount(DEGREES, c * c))
    return numpy.r_[
        (36 * numpy.pi * solid ** 2) ** (1 / 3) / area.sum(), s[1] / s[2], s[0] / s[1],
        solid / ConvexHull(mesh).volume, r.max(), r.min(), (ln ** 3).mean() / ln.std() ** 3,
        numpy.log(white).std(), (detail ** 3).mean() / detail.std() ** 3,
        (detail ** 4).mean() / detail.std() ** 4,
        numpy.sqrt((area * (1 / numpy.clip(cosine, 0.2, 1) ** 2 - 1)).sum() / area.sum()),
        numpy.log((share * bend ** 4).sum() / (share * bend ** 2).sum() ** 2),
        numpy.log(amplitudes[2:])]


def table_of(grains):
    rows = [described(c) for c in grains]
    return numpy.array([row for row in rows if row is not None])


def gaussian(sample, count, rng):
    """Principal components with 95 % of the variance, each normal."""
    mean = sample.mean(0)
    _, s, v = numpy.linalg.svd(sample - mean, full_matrices=False)
    kept = int((numpy.cumsum(s ** 2) / (s ** 2).sum() < 0.95).sum()) + 1
    return mean + (rng.standard_normal((count, kept)) * s[:kept] / (len(sample) - 1) ** 0.5) @ v[:kept]


def nataf(sample, count, rng):
    """Each coefficient by its own distribution, correlated by a normal copula."""
    scores = norm.ppf((rankdata(sample, axis=0) - 0.5) / len(sample))
    _, s, v = numpy.linalg.svd(scores - scores.mean(0), full_matrices=False)
    z = (rng.standard_normal((count, len(s))) * s / (len(sample) - 1) ** 0.5) @ v
    part = norm.cdf(z) * len(sample) - 0.5
    ordered = numpy.sort(sample, axis=0)
    return numpy.array([numpy.interp(part[:, k], numpy.arange(len(sample)), ordered[:, k])
                        for k in range(sample.shape[1])]).T


CLASSIFIERS = [
    make_pipeline(StandardScaler(), LogisticRegression(C=0.1, max_iter=2000)),
    ExtraTreesClassifier(300, min_samples_leaf=3, random_state=1),
    HistGradientBoostingClassifier(max_iter=80, learning_rate=0.07, max_leaf_nodes=8, random_state=1)]


def separability(made, real):
    """Areas under the curve of three classifiers, five-fold, on as many grains of both."""
    count = min(len(made), len(real))
    x, y = numpy.r_[made[:count], real[:count]], numpy.repeat([0, 1], count)
    folds = StratifiedKFold(5, shuffle=True, random_state=1)
    return [roc_auc_score(y, cross_val_predict(c, x, y, cv=folds, method="predict_proba")[:, 1])
            for c in CLASSIFIERS]


def show(name, made, real):
    distances = [ks_2samp(made[:, k], real[:, k]).statistic for k in range(real.shape[1])]
    cells = ["%.3f" % d for d in distances[:4]] + ["%.3f" % numpy.mean(distances)]
    print("| %s | %s | %s |" % (name, " | ".join(cells),
                                " / ".join("%.2f" % a for a in separability(made, real))), flush=True)


def grow(arguments, files, folder):
    names = pathlib.Path(folder) / "sample.txt"
    names.write_text("".join("%s\n" % file for file in files))
    out = pathlib.Path(folder) / "grown"
    run = subprocess.run(
        [arguments.program, "grow", "@%s" % names, "-k", str(arguments.grown), "-o", out,
         "--format", "json", "--seed", str(arguments.seed)],
        stdout=subprocess.PIPE, text=True, check=False)
    grains = []
    for file in sorted(out.glob("*.json")):
        c = numpy.array(json.loads(file.read_text())["coefficients"])
        grains.append(c / (3 * moments(BASIS @ c)[0] / 4 / numpy.pi) ** (1 / 3))
    return grains, [line for line in run.stdout.splitlines() if "istance" in line or "Collage" in line]


def templates(arguments, files, folder):
    """Distances of the four descriptors by which templates are chosen, and of all others, in standard deviations."""
    names = pathlib.Path(folder) / "all.txt"
    names.write_text("".join("%s\n" % file for file in files))
    known = described_files(files)
    others = numpy.array(list(known.values()))[:, 4:]
    place, rng = {file.name: k for k, file in enumerate(known)}, numpy.random.default_rng(arguments.seed)

    def distance(chosen, weights=None):
        return numpy.mean([wasserstein_distance(column[chosen], column, weights) / column.std() for column in others.T])

    print("\n| K | by number | random | by mass | random | others by number | random |\n|---|---|---|---|---|---|---|")
    for count in (10, 20, 50):
        out = pathlib.Path(folder) / ("templates%d" % count)
        subprocess.run([arguments.program, "grow", "--templates", "@%s" % names, "-k", str(count), "-n", "100",
                        "-o", out, "-q", "--seed", str(arguments.seed)], check=False)
        with open(out / "distances.csv", newline="") as table:
            row = list(csv.DictReader(table))[-1]
        with open(out / "templates.csv", newline="") as table:
            chosen = [t for t in csv.DictReader(table) if t["source"] in place]
        cells = [float(row[k]) for k in ("by_number", "random_by_number", "by_mass", "random_by_mass")]
        cells.append(distance([place[t["source"]] for t in chosen], [float(t["weight_by_number"]) for t in chosen]))
        cells.append(numpy.mean([distance(rng.choice(len(others), count, False)) for _ in range(100)]))
        print("| %d | %s |" % (count, " | ".join("%.3f" % cell for cell in cells)), flush=True)


def described_files(files):
    rows = {file: described(c) for file, c in ((file, standing(read(file))) for file in files)
            if c is not None}
    return {file: row for file, row in rows.items() if row is not None}


def halves(files, rng):
    """The sample and the grains to judge by; a random half each."""
    order = rng.permutation(len(files))
    return [[files[k] for k in part] for part in (order[:len(files) // 2], order[len(files) // 2:])]


def distances_of(made, real):
    return numpy.array([ks_2samp(made[:, k], real[:, k]).statistic for k in range(4)])


def cells_of(*groups):
    return " | ".join(" ".join("%.3f" % d for d in group) for group in groups)


def splits(arguments, files):
    rows = described_files(files)
    print("| split | floor | to unseen grains | to the sample | AUC |\n|---|---|---|---|---|")
    table = []
    for seed in range(1, arguments.splits + 1):
        arguments.seed = seed
        fit, judge = halves(files, numpy.random.default_rng(seed))
        sample, unseen = (numpy.array([rows[file] for file in half if file in rows])
                          for half in (fit, judge))
        with tempfile.TemporaryDirectory() as folder:
            made = table_of(grow(arguments, fit, folder)[0])
        table.append([distances_of(sample, unseen), distances_of(made, unseen),
                      distances_of(made, sample)])
        print("| %d | %s | %s |" % (seed, cells_of(*table[-1]), " / ".join(
            "%.2f" % a for a in separability(made, unseen))), flush=True)
    print("| median | %s | |" % cells_of(*numpy.median(table, axis=0)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--grown", type=int, default=1000)
    parser.add_argument("--splits", type=int, default=0)
    arguments = parser.parse_args()
    rng = numpy.random.default_rng(arguments.seed)
    files = sorted(arguments.folder.rglob("*.dat"))
    if arguments.splits:
        splits(arguments, files)
        return
    fit, judge = halves(files, rng)
    sample, unseen = ([c for c in (standing(read(file)) for file in half) if c is not None]
                      for half in (fit, judge))
    real = table_of(unseen)
    matrix = numpy.array(sample)
    print("| grains | sphericity | I/L | S/I | convexity | mean of %d | AUC |" % len(NAMES))
    print("|---|---|---|---|---|---|---|")
    show("the sample itself (floor)", table_of(sample), real)
    show("Gaussian, 95 % of the variance", table_of(gaussian(matrix, arguments.grown, rng)), real)
    show("Nataf, all coefficients", table_of(nataf(matrix, arguments.grown, rng)), real)
    with tempfile.TemporaryDirectory() as folder:
        grains, lines = grow(arguments, fit, folder)
        show("`wscvt grow`", table_of(grains), real)
        print("\n" + "\n".join(lines))
        templates(arguments, files, folder)


if __name__ == "__main__":
    main()
