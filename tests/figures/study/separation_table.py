#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""separation_table.py WSCVT FOLDER: labels grains that touch in scans of known packings, by WSCVT and by recipes
of scikit-image (apt-get install python3-skimage), and prints the table of separation.md. The packings, 18 voxels
across: 70 balls and 70 dented grains of fabric_table.py, and 70 ellipsoids. Where two overlap, the one has a point
that is deeper in it. Scan: 60 in the void, 180 in grains, a blur of .8 voxels, noise as a share of the contrast;
hardened: the grey values of grains fall towards the middle of the scan, by 30 % of the contrast, as by beam
hardening.

The recipes begin with a median of 3 x 3 x 3 voxels and Otsu's threshold, and fill holes, as wscvt does. Then the
distance to the void is flooded from markers:
  peaks: all local maxima of it within 3 x 3 x 3 voxels, as in scikit-image's example;
  distance k: peak_local_max with min_distance=k;
  h-maxima h: h_maxima, the regional maxima higher by h than a way to a higher one;
  MorphoLibJ: its Distance Transform Watershed 3D by the same steps, with its defaults: dynamic 2, 6 neighbours.
The distance is Euclidean; MorphoLibJ's is a chamfer's, which differs by some per cent.
For `distance` and `h-maxima` the row has the value that found most grains, of those of the packing at hand: a
user does not know it."""
import os
import subprocess
import sys

import numpy
from scipy import ndimage
from skimage import feature, filters, morphology, segmentation

from fabric_table import COUNT, Balls, Dented, blurred, labels_of, packing, read, write

ACROSS, PARTS, VOID, GRAIN = 18, 3, 60, 180
DISTANCES, HEIGHTS = (3, 5, 7), (0.5, 1.0, 2.0)


class Long:
    """Ellipsoids 1.35 : .85 : .65 in all directions."""
    name = "long"

    def __init__(self):
        self.x, self.r = packing(9, 1.0)
        self.reach = 1.4 * self.r
        self.axes = numpy.array([1.35, 0.85, 0.65])
        random = numpy.random.default_rng(10)
        self.turns = numpy.linalg.qr(random.normal(size=(COUNT, 3, 3)))[0]

    def value(self, k, d):
        return numpy.linalg.norm(d @ self.turns[k] / (self.axes * self.r[k]), axis=-1) - 1


def shares(grains, across=ACROSS):
    """The share of grains in each voxel, and the grain at its middle (0: none)."""
    h = 2 * grains.r.mean() / across
    labels, _ = labels_of(grains, h / PARTS, numpy.zeros(3), PARTS)
    n = numpy.array(labels.shape) // PARTS
    cells = labels.reshape(n[0], PARTS, n[1], PARTS, n[2], PARTS)
    return (cells > 0).astype(numpy.float32).mean((1, 3, 5)), cells[:, PARTS // 2, :, PARTS // 2, :, PARTS // 2]


def scene(grains, noise, hardened):
    """Grey values, and the grain of each voxel (0: none)."""
    share, truth = shares(grains)
    n = numpy.array(share.shape)
    grey = blurred(share, 0.8)
    if hardened:
        x, y = (numpy.indices(n[:2]) + 0.5) / n[:2, None, None] * 2 - 1
        grey *= (1 - 0.3 * numpy.clip(1 - x * x - y * y, 0, 1))[..., None]
    grey += numpy.random.default_rng(1).normal(0, noise, n)
    return numpy.clip(VOID + (GRAIN - VOID) * grey, 0, 255).round().astype(numpy.uint8), truth, share.sum()


def score(labels, truth, volume):
    """Grains found one to one (a label has more than half of the grain, and the grain of it), labels that have more
    than half of two grains or more, grains of which two labels or more have a tenth, error of the volume."""
    table = numpy.zeros((COUNT + 1, int(labels.max()) + 1))
    numpy.add.at(table, (truth.ravel(), labels.ravel()), 1)
    of_grain, of_label = table.sum(1), table.sum(0)
    inner = table[1:, 1:]
    holds = inner > 0.5 * of_grain[1:, None]
    one_to_one = (holds & (inner > 0.5 * of_label[None, 1:])).sum()
    merged = (holds.sum(0) > 1) @ holds.sum(0)
    mostly = inner > 0.5 * of_label[None, 1:]
    cut = ((mostly & (inner > 0.1 * of_grain[1:, None])).sum(1) > 1).sum()
    return one_to_one, merged, cut, 100 * (of_label[1:].sum() / volume - 1)


def flooded(distance, markers, mask):
    return segmentation.watershed(-distance, markers, mask=mask)


def by_peaks(distance, mask, **options):
    places = feature.peak_local_max(distance, labels=ndimage.label(mask)[0], **options)
    markers = numpy.zeros(distance.shape, int)
    markers[tuple(places.T)] = 1 + numpy.arange(len(places))
    return flooded(distance, markers, mask)


def by_height(distance, mask, height, neighbours):
    maxima = morphology.h_maxima(distance, height, footprint=neighbours)
    return flooded(distance, ndimage.label(maxima, neighbours)[0], mask)


def recipes(grey):
    smooth = ndimage.median_filter(grey, 3)
    mask = ndimage.binary_fill_holes(smooth > filters.threshold_otsu(smooth))
    distance = ndimage.distance_transform_edt(mask).astype(numpy.float32)
    faces, all_sides = ndimage.generate_binary_structure(3, 1), numpy.ones((3, 3, 3))
    yield "scikit-image, peaks", [("", by_peaks(distance, mask, footprint=all_sides))]
    yield "scikit-image, distance", [(k, by_peaks(distance, mask, min_distance=k)) for k in DISTANCES]
    yield "scikit-image, h-maxima", [(h, by_height(distance, mask, h, all_sides)) for h in HEIGHTS]
    yield "MorphoLibJ", [("", by_height(distance, mask, 2, faces))]


def by_wscvt(program, folder, grey):
    scan, path = os.path.join(folder, "scan.nrrd"), os.path.join(folder, "labels.nrrd")
    write(scan, grey)
    subprocess.run([program, "segment", scan, path, "-q"], check=True)
    return read(path)


def main():
    program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    print("| grains | noise | | one to one | merged | cut | volume |\n|" + 7 * "---|")
    for grains in (Balls(), Dented(), Long()):
        for noise, hardened in ((0.05, False), (0.15, False), (0.3, False), (0.05, True)):
            grey, truth, volume = scene(grains, noise, hardened)
            rows = [("wscvt segment", [("", by_wscvt(program, folder, grey))])] + list(recipes(grey))
            for name, tried in rows:
                scores = [(value, score(labels, truth, volume)) for value, labels in tried]
                value, (one_to_one, merged, cut, error) = max(scores, key=lambda one: one[1][0])
                print("| %s | %g%s | %s | %d of %d | %d | %d | %+.1f %% |" % (
                    grains.name, noise, ", hardened" if hardened else "", f"{name} {value}".strip(), one_to_one, COUNT,
                    merged, cut, error), flush=True)


if __name__ == "__main__":
    main()
