#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ct_volume.py VOLUME.npy: a made-up CT scan for the tutorial: 12 angular grains, some of which touch,
in 112 x 112 x 84 voxels (x, y, z), blurred and with noise. The same bytes on every run.
"""
import sys

import numpy

SHAPE = (84, 112, 112)  # z, y, x
random = numpy.random.default_rng(20)


def rotation():
    """A random rotation matrix."""
    q, r = numpy.linalg.qr(random.normal(size=(3, 3)))
    return q * numpy.sign(numpy.diag(r))


def inside(centre, radius):
    """Voxels of one grain: an ellipsoid, dented by waves and cut by planes."""
    points = numpy.moveaxis(numpy.indices(SHAPE), 0, -1) - centre
    axes = radius * numpy.array([1.25, 1.0, 0.8]) * random.uniform(0.93, 1.07, 3)
    local = points @ rotation() / axes
    size = numpy.linalg.norm(local, axis=-1)
    waves = sum(numpy.sin(local @ random.normal(0.0, 2.5, 3) + random.uniform(0, 6)) for _ in range(4))
    grain = size < 1.0 + 0.04 * waves
    for _ in range(5):
        normal = rotation()[0]
        grain &= local @ normal < random.uniform(0.75, 0.95)
    return grain


def blurred(values):
    """The mean over 3 voxels along each axis."""
    for axis in range(3):
        values = (numpy.roll(values, 1, axis) + values + numpy.roll(values, -1, axis)) / 3.0
    return values


def main():
    material = numpy.zeros(SHAPE)
    for z in (24, 59):
        for y in (28, 83):
            for x in (22, 56, 90):
                centre = numpy.array([z, y, x]) + random.uniform(-2, 2, 3)
                material[inside(centre, random.uniform(15.0, 18.0))] = 1.0
    grey = 60.0 + 110.0 * blurred(material) + random.normal(0.0, 6.0, SHAPE)
    numpy.save(sys.argv[1], numpy.clip(numpy.rint(grey), 0, 255).astype(numpy.uint8))


if __name__ == "__main__":
    main()
