#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the force on an elastic ball between two rigid plates, by finite elements in two dimensions.

    pressed_ball.py

The body is that of lib/examples/compression.py: radius 1, modulus 1, Poisson's ratio .25, small
displacements. Rings of four nodes around the axis have a side of 1/40 of Hertz's contact radius. The
upper half is enough. tetrahedra.md has the results.
"""
import numpy
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import spsolve

POISSON = 0.25


def growing(first, total, count):
    """Returns the sums of `count` growing steps, about `first` at the start, up to `total`."""
    ratios = numpy.linspace(1.0001, 2.0, 100000)
    ratio = ratios[numpy.searchsorted(first * (ratios**count - 1.0) / (ratios - 1.0), total)]
    sums = numpy.cumsum(ratio ** numpy.arange(count))
    return sums * (total / sums[-1])


def ball(contact, fine):
    """Returns the nodes (distance from the axis, height) on circles and rays."""
    angles = 1.5 * contact * numpy.linspace(0.0, 1.0, fine + 1)
    angles = numpy.append(angles, angles[-1] + growing(angles[1], numpy.pi / 2.0 - angles[-1], fine))
    depths = numpy.append(0.0, growing(angles[1], 0.999, 5 * fine // 3))  # a pore at the centre
    radii = (1.0 - depths)[:, None]
    return numpy.stack([radii * numpy.sin(angles), radii * numpy.cos(angles)], axis=-1)


def stiffness(points, cells):
    """Returns the stiffness matrix; the cells are quadrilaterals of the half plane."""
    elastic = numpy.full((3, 3), POISSON) + (1.0 - 2.0 * POISSON) * numpy.eye(3)
    elastic = numpy.pad(elastic, (0, 1))
    elastic[3, 3] = 0.5 - POISSON
    elastic /= (1.0 + POISSON) * (1.0 - 2.0 * POISSON)
    corners = numpy.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    local = numpy.zeros((len(cells), 8, 8))
    for place in corners / numpy.sqrt(3.0):
        factors = 1.0 + corners * place
        slopes = numpy.stack([corners[:, 0] * factors[:, 1], corners[:, 1] * factors[:, 0]]) / 4.0
        jacobian = slopes @ points[cells]
        slopes = numpy.linalg.solve(jacobian, numpy.broadcast_to(slopes, (len(cells), 2, 4)))
        shape = factors.prod(axis=1) / 4.0
        radius = points[cells][:, :, 0] @ shape
        strain = numpy.zeros((len(cells), 4, 8))
        strain[:, 0, 0::2] = strain[:, 3, 1::2] = slopes[:, 0]
        strain[:, 2, 1::2] = strain[:, 3, 0::2] = slopes[:, 1]
        strain[:, 1, 0::2] = shape / radius[:, None]
        weight = 2.0 * numpy.pi * radius * numpy.abs(numpy.linalg.det(jacobian))
        local += weight[:, None, None] * (strain.transpose(0, 2, 1) @ elastic @ strain)
    numbers = (2 * cells[:, :, None] + [0, 1]).reshape(-1, 8)
    return csr_matrix((local.ravel(), (numpy.repeat(numbers, 8), numpy.tile(numbers, 8).ravel())))


def force(share, rough, fine=60):
    """Returns the force at a compression of `share` of the height, and the contact's radius."""
    grid = ball(numpy.sqrt(share), fine)
    points = grid.reshape(-1, 2)
    number = numpy.arange(len(points)).reshape(grid.shape[:2])
    cells = numpy.stack([number[1:, :-1], number[1:, 1:], number[:-1, 1:], number[:-1, :-1]], axis=-1)
    matrix = stiffness(points, cells.reshape(-1, 4))
    surface = number[0]
    way = 1.0 - share - points[surface, 1]  # of a node that touches
    touches = way < 0.0
    while True:
        moved = numpy.zeros(2 * len(points))
        moved[2 * surface[touches] + 1] = way[touches]
        held = [2 * number[:, 0], 2 * number[:, -1] + 1, 2 * surface[touches] + 1]
        if rough:
            held.append(2 * surface[touches])
        free = numpy.setdiff1d(numpy.arange(len(moved)), numpy.concatenate(held))
        moved[free] = spsolve(matrix[free][:, free].tocsc(), -(matrix @ moved)[free])
        upward = (matrix @ moved)[2 * surface + 1]
        changes = ~touches & (moved[2 * surface + 1] > way + 1e-9)
        if not changes.any():
            changes = touches & (upward > 0.0)
        if not changes.any():
            return -upward[touches].sum(), points[surface[touches], 0].max()
        touches ^= changes


if __name__ == "__main__":
    for compression in (0.1, 0.05, 0.025, 0.001):
        hertz = 4.0 / 3.0 / (1.0 - POISSON**2) * compression**1.5
        for is_rough in (True, False):
            value, reach = force(compression, is_rough)
            print(f"by {100 * compression:g} %, {'rough' if is_rough else 'smooth'} plates: force {value:.4g}, "
                  f"{value / hertz:.3f} of Hertz's; contact radius {reach:.3f}")
