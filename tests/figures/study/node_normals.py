#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do normals of nodes gain if they are taken from the scan? Compares three normals of a node: the remesh's, the mean
of the scan's over the node's cell, weighted by area, and the scan's at the point nearest to the node.

  tests/figures/study/node_normals.py SCAN...

A SCAN is a closed mesh without faults. Prints a line per scan, number of nodes and question: median and 90 % of the
angle to the true normal, in degrees. The last lines are the means of these numbers over the scans. Needs the module wscvt (PYTHONPATH=build/release/lib/python), numpy and scipy.

The true normal at a point is the mean of the scan's within 0.03 equivalent radii, weighted by area. That of a first
contact of two equal scans, in random poses along random lines, is the mean of both scans' own. The samples of a scan
are its triangles, divided until they are 40,000 or more.
"""
import pathlib
import sys

import numpy
import wscvt
from scipy.ndimage import map_coordinates
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

CONTACTS = 400
SAMPLES = 40000
PATCH = 0.03


def unit(vectors):
    return vectors / numpy.maximum(numpy.linalg.norm(vectors, axis=-1, keepdims=True), 1e-300)


def area_vectors(corners):
    return 0.5 * numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def angles(first, second):
    return numpy.degrees(numpy.arccos(numpy.clip((first * second).sum(-1), -1, 1)))


class Scan:
    """A scan of equivalent radius 1 about its centroid: samples, and distances on a grid."""

    def __init__(self, points, faces):
        corners = points[faces]
        volumes = numpy.linalg.det(corners) / 6
        centroid = volumes @ corners.sum(1) / (4 * volumes.sum())
        self.points, self.faces = (points - centroid) / (0.75 / numpy.pi * volumes.sum()) ** (1 / 3), faces
        corners = self.points[faces]
        while len(corners) < SAMPLES:
            middles = 0.5 * (corners + numpy.roll(corners, -1, axis=1))
            corners = numpy.concatenate(
                [middles] + [numpy.stack([corners[:, k], middles[:, k], middles[:, k - 1]], 1) for k in range(3)])
        self.places = corners.mean(1)
        self.areas = area_vectors(corners)
        self.tree = cKDTree(self.places)
        self.reach = 1.05 * numpy.linalg.norm(self.places, axis=1).max()
        self.values, self.corner, self.spacing = wscvt.distance_grid(self.points, faces, 0.02, threads=1)

    def distance(self, points):
        """Linear in each cell of the grid; outside of it a lower bound."""
        place = ((points - self.corner) / self.spacing).T
        within = numpy.clip(place, 0, numpy.array(self.values.shape)[:, None] - 1.0)
        outside = self.spacing * numpy.sqrt(((place - within) ** 2).sum(0))
        return numpy.where(outside > 0, outside + 1e-3, map_coordinates(self.values, within, order=1))

    def normals(self, points):
        """The true ones at the samples nearest to points."""
        near = self.places[self.tree.query(points)[1]]
        return unit(numpy.array([self.areas[found].sum(0) for found in self.tree.query_ball_point(near, PATCH)]))

    def first_touch(self, points, turn, way):
        """Of points with this scan, turned, which comes against `way`: the point, and the distance of the centres."""
        start = 2 * self.reach
        along = turn @ way
        index = numpy.flatnonzero(points @ way > 0)
        turned, come = points[index] @ turn.T, numpy.zeros(len(index))
        best, touching = start, 0
        while len(index):
            distance = self.distance(turned - (start - come)[:, None] * along)
            touch = distance < 1e-5
            if touch.any() and come[touch].min() < best:
                best = come[touch].min()
                touching = index[touch][numpy.argmin(come[touch])]
            come += numpy.maximum(distance, 0) / 1.01  # interpolated distances are a little steeper than 1
            keep = ~touch & (come < best)
            index, turned, come = index[keep], turned[keep], come[keep]
        return touching, start - best

    def normal_against(self, point, turn, way, distance):
        """This scan's own normal, by the slope of its distances, where such a point touches it; outward of the other."""
        steps = 1e-3 * self.spacing * numpy.concatenate([numpy.eye(3), -numpy.eye(3)])
        values = self.distance(turn @ point - distance * (turn @ way) + steps)
        return -turn.T @ unit(values[:3] - values[3:])


def line(name, nodes, question, spreads):
    return "%s %d %s: %s" % (name, nodes, question, "; ".join("%s %.1f, %.1f" % (key, *one) for key, one in spreads.items()))


def study(name, scan, contacts, true_normals, nodes, results):
    remesh = wscvt.remesh(scan.points, scan.faces, nodes, threads=1)
    points, faces, table = remesh.vertices, remesh.faces, remesh.node_table()
    cells = numpy.zeros((nodes, 3))
    numpy.add.at(cells, cKDTree(points).query(scan.places)[1], scan.areas)
    at_nodes = scan.normals(points)
    normals = {"remesh": numpy.stack([table[k] for k in ("nx", "ny", "nz")], 1), "cell": unit(cells), "nearest": at_nodes}

    def tell(question, errors):
        spreads = {key: numpy.quantile(one, (0.5, 0.9)).round(1) for key, one in errors.items()}
        results.setdefault((nodes, question), []).append(spreads)
        print(line(name, nodes, question, spreads), flush=True)

    tell("nodes", {key: angles(normals[key], at_nodes) for key in ("remesh", "cell")})

    def at_contacts(question, places, choices):
        touches = [scan.first_touch(places, *contact) for contact in contacts]
        touching = [touch for touch, _ in touches]
        other = numpy.array([scan.normal_against(places[touch], *contact, distance)
                             for (touch, distance), contact in zip(touches, contacts)])
        found = {key: one[touching] for key, one in choices.items()}
        found["other scan"] = other
        found["remesh + other scan"] = unit(found["remesh"] + other)
        found["cell + other scan"] = unit(found["cell"] + other)
        tell(question, {key: angles(one, true_normals) for key, one in found.items()})

    at_contacts("first node on the other scan", points, normals)
    steps = max(3, int(numpy.sqrt(SAMPLES / nodes / 2)))
    weights = numpy.array([(a, b, steps - a - b) for a in range(steps + 1) for b in range(steps + 1 - a)]) / steps

    def over_faces(values):
        return numpy.einsum("wk,fkx->fwx", weights, values[faces]).reshape(-1, 3)
    choices = {key: unit(over_faces(one)) for key, one in normals.items()}
    choices["triangle"] = numpy.repeat(unit(area_vectors(points[faces])), len(weights), 0)
    at_contacts("first point of the remesh on the other scan", over_faces(points), choices)


def main():
    results = {}
    for path in sys.argv[1:]:
        scan = Scan(*wscvt.read_mesh(path))
        turns = Rotation.random(2 * CONTACTS, random_state=1).as_matrix()
        contacts = [(turns[2 * k], turns[2 * k + 1][:, 0]) for k in range(CONTACTS)]
        own, others = [], []
        for turn, way in contacts:
            touching, distance = scan.first_touch(scan.places, turn, way)
            own.append(scan.places[touching])
            others.append(turn @ scan.places[touching] - distance * (turn @ way))
        turned = numpy.einsum("cji,cj->ci", turns[::2], scan.normals(numpy.array(others)))
        true_normals = unit(scan.normals(numpy.array(own)) - turned)
        for nodes in (200, 500, 1000):
            study(pathlib.Path(path).stem, scan, contacts, true_normals, nodes, results)
    for (nodes, question), scans in results.items():
        print(line("mean", nodes, question, {key: sum(one[key] for one in scans) / len(scans) for key in scans[0]}))


main()
