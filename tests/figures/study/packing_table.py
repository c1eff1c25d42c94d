#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""packing_table.py FOLDER [REFERENCE]: prints the results of the packings of yade_packing.sh in FOLDER, one
row per choice of nodes: means over the seeds with their intervals of 95 % (Student's t). The solid fraction is that of the
grains as scanned, below the height that 70 % of their centres are under. The true overlap is that of the
deepest vertex of a scan in the other grain. The others' solid fractions are compared with REFERENCE, by
default 7,228 nodes on the scan, start by start. Last it says how much of the scatter of single packings is
noise: what remains if each packing is compared with the means of its nodes and of its start. Writes FOLDER/energies.csv, the means over the seeds
against time, with the halves of their intervals."""
import glob
import json
import os
import sys

import numpy

RADIUS, GRAVITY, DENSITY = 0.05, 9.81, 2650.0
# 97.5 % quantile of Student's t by the number of packings.
STUDENT = {2: 12.71, 3: 4.303, 4: 3.182, 5: 2.776, 6: 2.571, 7: 2.447, 8: 2.365, 9: 2.306, 10: 2.262}


class Distances:
    """Signed distances of a grain in its frame, linear between the points of the grid."""

    def __init__(self, path):
        with open(path + ".json") as file:
            description = json.load(file)
        self.values = numpy.load(path)
        self.origin = numpy.array([description["origin"][a] for a in "xyz"])
        self.spacing = description["spacing"]
        self.volume = description["mass"]["volume"]

    def __call__(self, points):
        place = (points - self.origin) / self.spacing
        cell = numpy.floor(place).astype(int)
        inside = numpy.all((cell >= 0) & (cell < numpy.array(self.values.shape) - 1), axis=1)
        result = numpy.full(len(points), numpy.inf)
        cell, share = cell[inside], (place - cell)[inside]
        sums = numpy.zeros(len(cell))
        for corner in numpy.ndindex(2, 2, 2):
            weight = numpy.prod(numpy.where(corner, share, 1 - share), axis=1)
            sums += weight * self.values[tuple((cell + corner).T)]
        result[inside] = sums
        return result


def turns(quaternions):
    """Matrices of rows w, x, y, z."""
    w, x, y, z = quaternions.T
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
                       ).transpose(2, 0, 1)


def solid_fraction(distances, reach, places, matrices, box):
    height = numpy.sort(places[:, 2])[len(places) * 7 // 10]
    points = numpy.random.RandomState(9).rand(100000, 3) * [box, box, height]
    filled = numpy.zeros(len(points), bool)
    for place, matrix in zip(places, matrices):
        near = numpy.flatnonzero(((points - place) ** 2).sum(axis=1) < reach ** 2)
        filled[near] |= distances((points[near] - place) @ matrix) < 0
    return filled.mean()


def true_overlaps(distances, vertices, reach, places, matrices):
    """Of the pairs that overlap, each seen by the vertices of both."""
    depths = []
    for i in range(len(places)):
        for j in range(i):
            if ((places[i] - places[j]) ** 2).sum() > 4 * reach ** 2:
                continue
            deepest = 0.0
            for a, b in ((i, j), (j, i)):
                points = vertices @ matrices[a].T + places[a] - places[b]
                points = points[(points ** 2).sum(axis=1) < reach ** 2]
                if len(points):
                    deepest = max(deepest, -distances(points @ matrices[b]).min())
            if deepest > 0:
                depths.append(deepest)
    return numpy.mean(depths) if depths else 0.0


def energies(packing):
    return numpy.genfromtxt(packing, delimiter=",", skip_header=1)


def measure(packing, distances, vertices):
    rows = energies(packing)
    poses = numpy.genfromtxt(packing + ".poses", delimiter=",", skip_header=1)
    with open(packing) as file:
        footer = file.read().rsplit("#", 1)[1].split()
    cost, box = float(footer[0]), float(footer[5])
    places, matrices = poses[:, :3], turns(poses[:, 3:])
    reach = numpy.sqrt((vertices ** 2).sum(axis=1).max())
    mass = distances.volume * DENSITY * len(places)
    return [cost, rows[-1, 1], rows[-1, 2], rows[-1, 3], rows[-1, 2] / (mass * GRAVITY) / RADIUS,
            100 * rows[-1, 4],
            100 * true_overlaps(distances, vertices, reach, places, matrices) / RADIUS,
            solid_fraction(distances, reach, places, matrices, box)]


def half_interval(values):
    """Over the first axis."""
    count = len(values)
    if count < 2:
        return numpy.full(numpy.shape(values)[1:], numpy.nan)
    return STUDENT.get(count, 1.96) * numpy.std(values, axis=0, ddof=1) / numpy.sqrt(count)


def mean_and_error(values):
    return "%.4g +- %.2g" % (numpy.mean(values), half_interval(values))


def noise(values):
    """Deviations of single packings, rows of one choice of nodes each, columns of one start each: the noise
    of packing, and the deviation between the choices without it (two-way analysis of variance)."""
    sets, starts = values.shape
    rest = values - values.mean(axis=1, keepdims=True) - values.mean(axis=0) + values.mean()
    within = (rest ** 2).sum() / ((sets - 1) * (starts - 1))
    between = values.mean(axis=1).var(ddof=1) - within / starts
    return numpy.sqrt(within), numpy.sqrt(max(0.0, between))


def print_noise(results):
    starts = sorted(set.intersection(*[set(seeds) for seeds in results.values()]))
    if len(results) < 2 or len(starts) < 2:
        return
    print()
    for name, k in (("kinetic, J", 1), ("potential, J", 2), ("mean height, R", 4), ("solid fraction", 7)):
        within, between = noise(numpy.array([[seeds[s][k] for s in starts] for seeds in results.values()]))
        print("%s: deviation by noise of packing %.3g, by the nodes %.3g" % (name, within, between))


def main():
    folder = sys.argv[1]
    reference = sys.argv[2] if len(sys.argv) > 2 else "on-surface_7228"
    sets = {}
    for packing in sorted(glob.glob(os.path.join(folder, "*.csv.poses"))):
        name, seed = os.path.basename(packing)[:-len(".csv.poses")].rsplit("_", 1)
        sets.setdefault(name, {})[seed] = packing[:-len(".poses")]
    distances = Distances(os.path.join(folder, "vertices.npy"))
    vertices = numpy.loadtxt(os.path.join(folder, "vertices.csv"), delimiter=",", skiprows=1,
                             usecols=(0, 1, 2))
    with open(os.path.join(folder, "energies.csv"), "w") as file:
        file.write("nodes,time,kinetic,potential,elastic,kinetic_95,potential_95,elastic_95\n")
        for name, seeds in sets.items():
            series = numpy.array([energies(path)[:, :4] for path in seeds.values()])
            for row in numpy.hstack([series.mean(axis=0), half_interval(series)[:, 1:]]):
                file.write(",".join([name] + ["%.6g" % value for value in row]) + "\n")
    results = {name: {seed: measure(path, distances, vertices) for seed, path in seeds.items()}
               for name, seeds in sets.items()}
    print("| nodes | seeds | ms a step | kinetic, J | potential, J | elastic, J | mean height, R | "
          "overlap, % of R | true overlap, % of R | solid fraction | against the reference, % |")
    print("|" + 11 * "---|")
    for name, seeds in sorted(results.items(), key=lambda item: (item[0].split("_")[0],
                                                                 int(item[0].split("_")[1]))):
        shared = [s for s in seeds if s in results.get(reference, {})]
        against = ([100 * (seeds[s][7] / results[reference][s][7] - 1) for s in shared]
                   if shared and name != reference else None)
        print("| %s | %d | %s | %s |" % (
            name, len(seeds), " | ".join(mean_and_error([row[k] for row in seeds.values()])
                                         for k in range(8)),
            mean_and_error(against) if against else ""))
    print_noise(results)


main()
