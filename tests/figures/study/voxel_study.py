#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What voxels do, on bodies of its own whose true shape is known: rounded polyhedra with waves, seen from their centre.

nodes WSCVT [FOLDER]  how many nodes the voxels resolve; files are in the folder, which is a temporary one if not given
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np


class Body:
    """The radius of a body in each direction, stretched along three axes."""

    def __init__(self, seed):
        draw = np.random.default_rng(seed)
        faces = int(draw.integers(8, 40))
        self.normals = draw.normal(size=(faces, 3))
        self.normals /= np.linalg.norm(self.normals, axis=1)[:, None]
        self.distances = draw.uniform(0.8, 1.2, faces)
        self.sharpness = np.exp(draw.uniform(np.log(4), np.log(40)))
        self.axes = np.array([1.0, draw.uniform(0.6, 1.0), draw.uniform(0.4, 0.9)])
        lengths = np.exp(draw.uniform(np.log(3), np.log(30), 60))
        waves = draw.normal(size=(60, 3))
        self.waves = waves / np.linalg.norm(waves, axis=1)[:, None] * lengths[:, None]
        self.phases = draw.uniform(0, 2 * np.pi, 60)
        heights = lengths ** -draw.uniform(1, 2)
        self.heights = draw.uniform(0.01, 0.05) * heights / np.sqrt(np.sum(heights ** 2) / 2)

    def radius(self, directions):
        norm = 0.05 + (np.maximum(directions @ self.normals.T, 0) / self.distances) ** self.sharpness @ np.ones(len(self.distances))
        return norm ** (-1 / self.sharpness) * (1 + np.cos(directions @ self.waves.T + self.phases) @ self.heights)

    def mesh(self, sphere):
        return self.radius(sphere)[:, None] * sphere * self.axes

    def inside(self, points):
        scaled = points / self.axes
        lengths = np.linalg.norm(scaled, axis=1)
        return lengths < self.radius(scaled / np.maximum(lengths, 1e-9)[:, None])


def cube_sphere(count):
    """Returns directions and triangles of a sphere: six faces of count x count squares."""
    steps = np.tan(np.pi / 4 * (2 * np.arange(count + 1) / count - 1))
    places, points, faces = {}, [], []
    for axis in range(3):
        for side in (-1, 1):
            index = np.zeros((count + 1, count + 1), int)
            for i, x in enumerate(steps):
                for j, y in enumerate(steps):
                    point = np.zeros(3)
                    point[[axis, (axis + 1) % 3, (axis + 2) % 3]] = side, x, y
                    key = tuple(np.round(point, 9))
                    if key not in places:
                        places[key] = len(points)
                        points.append(point)
                    index[i, j] = places[key]
            for i in range(count):
                for j in range(count):
                    a, b, c, d = index[i, j], index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]
                    faces += [(a, b, c)[::side], (a, c, d)[::side]]
    points = np.array(points)
    return points / np.linalg.norm(points, axis=1)[:, None], np.array(faces)


SPHERE, FACES = cube_sphere(40)


def volume(points):
    return np.einsum("ij,ij->i", points[FACES[:, 0]], np.cross(points[FACES[:, 1]], points[FACES[:, 2]])).sum() / 6


def write_off(path, points):
    with open(path, "w", encoding="ascii") as stream:
        stream.write(f"OFF\n{len(points)} {len(FACES)} 0\n")
        np.savetxt(stream, points, "%.9g")
        np.savetxt(stream, np.c_[np.full(len(FACES), 3), FACES], "%d")


def placed(seed, across):
    """Returns which voxels have their centres inside the body, and the true mesh, in voxels."""
    body = Body(seed)
    points = body.mesh(SPHERE)
    scale = across / (6 * volume(points) / np.pi) ** (1 / 3)
    draw = np.random.default_rng(100 * seed + across)
    turn = np.linalg.qr(draw.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    true = points * scale @ turn.T
    low = true.min(0) - 6 - draw.uniform(0, 1, 3)
    counts = np.ceil(true.max(0) - low).astype(int) + 6
    grid = np.stack(np.meshgrid(*[np.arange(n) + 0.5 for n in counts], indexing="ij"), -1).reshape(-1, 3) + low
    return body.inside(grid @ turn / scale).reshape(counts), true - low


def save(path, array, kind=np.uint8):
    np.save(path, np.ascontiguousarray(array.transpose(2, 1, 0)).astype(kind))


def call(*words):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True).stdout


def report(program, *words):
    pathlib.Path("report.json").unlink(missing_ok=True)
    call(program, *words, "-q", "--report", "report.json")
    return json.loads(pathlib.Path("report.json").read_text(encoding="utf-8"))


def nodes(program):
    print("body | voxels across | rms of the scan, voxels | nodes: side of a node's cell in voxels, rms over the scan's")
    for seed in range(101, 105):
        for across in (12, 20, 40):
            inside, true = placed(seed, across)
            save("labels.npy", inside)
            write_off("true.off", true)
            call(program, "extract", "labels.npy", "scan", "-q")
            scan = report(program, "describe", "scan/1.ply", "true.off")
            rms = scan["distances"]["rms_distance"]
            cells = []
            for count in (50, 100, 200, 400, 800, 1600):
                call(program, "remesh", "scan/1.ply", "remesh.ply", "-n", count, "-q")
                made = report(program, "describe", "remesh.ply", "true.off")["distances"]["rms_distance"]
                side = np.sqrt(scan["descriptors"]["area"]["value"] / count)
                cells.append(f"{count}: {side:.2f}, {made / rms:.2f}")
            print(f"{seed} | {across} | {rms:.3f} | " + "; ".join(cells), flush=True)


if __name__ == "__main__":
    wscvt = pathlib.Path(sys.argv[2]).resolve()
    command = {"nodes": nodes}[sys.argv[1]]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(sys.argv[3] if len(sys.argv) > 3 else folder)
        command(wscvt)
