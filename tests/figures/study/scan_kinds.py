#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""scan_kinds.py WSCVT FOLDER: labels the 70 dented grains of fabric_table.py, 22 voxels across, by wscvt segment in
scans of many kinds, and prints the table of scan_kinds.md: grains found one to one as separation_table.py counts
them (needs python3-skimage), the error of the volume of all labels, and the first words of each line of the log that
asks to look. Follows an advice where ADVICE has one: the row "then". Scan: 60 in the void, 180 in grains, unless a
kind says otherwise, a blur of .8 voxels, noise of 6."""
import os
import subprocess
import sys

import numpy
from scipy import ndimage

from fabric_table import COUNT, Dented, read, write
from separation_table import GRAIN, VOID, score, shares

ACROSS, NOISE, WORDS = 22, 6, 7


def kinds(share, truth, random):
    """Yields names and grey values without noise; `share`: of grains in a voxel."""
    def grey(values, blur=0.8):
        return ndimage.gaussian_filter(values.astype(float), blur)

    def of(inside, outside=VOID, blur=0.8):
        return grey(outside + (inside - outside) * share, blur)

    x, y, z = (numpy.indices(share.shape) + 0.5) / numpy.array(share.shape)[:, None, None, None]
    plain = of(GRAIN)
    minerals = random.uniform(120, 230, COUNT + 1)
    minerals[0] = VOID
    field = ndimage.gaussian_filter(random.normal(size=share.shape), 1.5)
    bubbles = ndimage.gaussian_filter(random.normal(size=share.shape), 5)
    beside = ndimage.distance_transform_edt(truth == 0) < 3
    yield "plain", plain
    yield "phase contrast", plain - 6 * ndimage.gaussian_laplace(plain, 1.5)
    yield "sharpened", plain + 2 * (plain - ndimage.gaussian_filter(plain, 2))
    yield "blur of 2 voxels", of(GRAIN, blur=2)
    yield "blur of 3 voxels", of(GRAIN, blur=3)
    yield "porous grains", grey(numpy.where(field < numpy.quantile(field, 0.8), VOID + 120 * share, VOID))
    yield "resin with bubbles", of(210, numpy.where(bubbles > numpy.quantile(bubbles, 0.8), 40, 110))
    yield "water in one half", of(GRAIN, numpy.where(z > 0.5, 110, VOID))
    yield "water beside grains", of(GRAIN, numpy.where(beside, 110, VOID))
    yield "many minerals", grey(minerals[truth])
    yield "dark grains", of(VOID, GRAIN)
    yield "drift along z", plain * (0.8 + 0.4 * z)
    yield "stripes", plain + 25 * numpy.sin(40 * (0.76 * x + 0.64 * y))
    yield "slices that jump", plain + random.normal(0, 25, share.shape[2])
    lost = plain.copy()
    lost[:, :, 40:42] = numpy.nan
    yield "two slices lost", lost
    yield "texture", plain + 25 * share * ndimage.gaussian_filter(random.normal(size=share.shape), 2) / 0.05


# What the log says to do, as options and as a function of the scan.
ADVICE = {"resin with bubbles": (["--phases", "1"], None), "dark grains": (["--dark"], None),
          "porous grains": ([], lambda scan: ndimage.grey_closing(ndimage.median_filter(scan, 3), 5)),
          "two slices lost": ([], lambda scan: numpy.concatenate(
              [scan[:, :, :40], scan[:, :, 39:40], scan[:, :, 39:40], scan[:, :, 42:]], 2)),
          "water in one half": ([], lambda scan: ndimage.white_tophat(scan, 35))}


def main():
    program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    share, truth = shares(Dented(), ACROSS)

    def labelled(scan, *options):
        file, path = os.path.join(folder, "scan.nrrd"), os.path.join(folder, "labels.nrrd")
        write(file, scan)
        log = subprocess.run([program, "segment", file, path, *options], check=True, capture_output=True, text=True)
        looks = [" ".join(line.split()[1:1 + WORDS]) for line in log.stdout.split("\n") if line.startswith("Look: ")]
        one_to_one, _, _, error = score(read(path), truth, share.sum())
        return "%d of %d | %+.1f %% | %s |" % (one_to_one, COUNT, error, "; ".join(looks))

    print("| scan | one to one | volume | look |\n|" + 4 * "---|")
    for name, grey in kinds(share, truth, numpy.random.default_rng(7)):
        noisy = grey + numpy.random.default_rng(1).normal(0, NOISE, grey.shape)
        scan = numpy.nan_to_num(numpy.clip(noisy, 0, 65535)).round().astype(numpy.uint16)
        print("| %s | %s" % (name, labelled(scan)), flush=True)
        if name in ADVICE:
            options, change = ADVICE[name]
            print("| then | %s" % labelled(change(scan) if change else scan, *options), flush=True)


if __name__ == "__main__":
    main()
