#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What voxels do, on bodies whose true shape is known: its own, rounded polyhedra with waves, seen from their centre.

nodes WSCVT            how many nodes the voxels resolve
coverage WSCVT DAT...  how many intervals contain the true value: of 6 bodies of its own and of real particles (spherical
                       harmonics), in eight poses from exact labels, and in four from grey values with blur and noise
again WSCVT DAT...     how much of the error of scans the smoothing of `segment` tells, done once more on the blurred image
                       of the labels; every second body, of 12 of its own and of real particles, gives the gains, the
                       others judge
"""

import csv
import gzip
import json
import math
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


class Particle:
    """The radius of a particle of spherical harmonics (.dat: n m Re Im) in each direction, by a table of degrees."""

    def __init__(self, path):
        from scipy.special import sph_harm
        polar, around = np.radians(np.arange(181)), np.radians(np.arange(361))
        self.table = np.zeros((181, 361))
        for n, m, real, imaginary in np.loadtxt(path):
            along = complex(real, imaginary) * sph_harm(int(m), int(n), 0.0, polar)
            self.table += np.outer(along, np.exp(1j * m * around)).real
        self.axes = np.ones(3)

    def radius(self, directions):
        from scipy.ndimage import map_coordinates
        polar = np.degrees(np.arccos(np.clip(directions[:, 2], -1, 1)))
        around = np.degrees(np.arctan2(directions[:, 1], directions[:, 0])) % 360
        return map_coordinates(self.table, np.array([polar, around]), order=3, mode="nearest")

    mesh = Body.mesh
    inside = Body.inside


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


def volume(points, faces=FACES):
    return np.einsum("ij,ij->i", points[faces[:, 0]], np.cross(points[faces[:, 1]], points[faces[:, 2]])).sum() / 6


def write_off(path, points, faces=FACES):
    with open(path, "w", encoding="ascii") as stream:
        stream.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        np.savetxt(stream, points, "%.9g")
        np.savetxt(stream, np.c_[np.full(len(faces), 3), faces], "%d")


def placed(body, across, seed):
    """Returns which voxels have their centres inside the body, the true mesh in voxels, and the test of points in voxels."""
    points = body.mesh(SPHERE)
    scale = across / (6 * volume(points) / np.pi) ** (1 / 3)
    draw = np.random.default_rng(seed)
    turn = np.linalg.qr(draw.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    true = points * scale @ turn.T
    low = true.min(0) - 6 - draw.uniform(0, 1, 3)
    counts = np.ceil(true.max(0) - low).astype(int) + 6
    grid = np.stack(np.meshgrid(*[np.arange(n) + 0.5 for n in counts], indexing="ij"), -1).reshape(-1, 3)

    def inside(at):
        return body.inside((at + low) @ turn / scale)

    return inside(grid).reshape(counts), true - low, inside


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
            inside, true, _ = placed(Body(seed), across, 100 * seed + across)
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


KEYS = ("area", "sphericity_wadell", "convexity", "roundness_wadell", "aspect_ratio_inertia", "axis_s_box", "feret_max",
        "feret_min", "mean_curvature_integral", "sdq_invariant")
POSES = 8


def rms(values):
    return math.sqrt(np.nanmean(values ** 2))


def grey_of(labels, inside):
    """Returns grey values of the body: what part of a voxel is inside, blurred by .7 voxel."""
    from scipy.ndimage import binary_dilation, binary_erosion, gaussian_filter
    grey = labels.astype(float)
    near = np.argwhere(binary_dilation(labels, iterations=2) & ~binary_erosion(labels, iterations=2))
    parts = np.stack(np.meshgrid(*[[1 / 6, 1 / 2, 5 / 6]] * 3), -1).reshape(-1, 3)
    at = (near[:, None] + parts).reshape(-1, 3)
    grey[tuple(near.T)] = inside(at).reshape(len(near), -1).mean(1)
    return gaussian_filter(grey, 0.7)


def side_by_side(volumes):
    """Returns one volume of all of them along x."""
    counts = np.max([one.shape for one in volumes], 0)
    return np.concatenate([np.pad(one, [(0, n - m) for n, m in zip(counts, one.shape)])
                           for one in volumes])


def shapes(program, labels):
    """Returns the rows of the grains of labels."""
    call(program, "extract", labels, "out", "-q", "--describe")
    with open("out/shape.csv", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def coverage(program, *files):
    sphere, faces = cube_sphere(100)  # the truth has chords of a 150th of a diameter
    bodies = [Body(seed) for seed in range(201, 207)] + [Particle(file) for file in files]
    found = {}
    for number, body in enumerate(bodies):
        write_off("true.off", body.mesh(sphere), faces)
        true = report(program, "describe", "true.off")["descriptors"]
        for across in (10, 15, 20, 30, 40):
            size = (6 * volume(body.mesh(SPHERE)) / np.pi) ** (1 / 3) / across  # as in placed
            placings = [placed(body, across, 10000 * number + 100 * across + pose)[::2] for pose in range(POSES)]
            draw = np.random.default_rng(number)
            for kind in ("labels", "grey values"):
                if kind == "labels":
                    save("labels.npy", side_by_side([(k + 1) * labels for k, (labels, _) in enumerate(placings)]))
                else:
                    grey = side_by_side([grey_of(*one) for one in placings[::2]])
                    save("scan.npy", grey + draw.normal(0, 0.1, grey.shape), np.float32)  # a tenth of the step
                    call(program, "segment", "scan.npy", "labels.nrrd", "--separate", 0, "-q")
                for row in shapes(program, "labels.npy" if kind == "labels" else "labels.nrrd"):
                    if row["status"] != "done":
                        continue
                    cells = {name.split(" [")[0]: cell for name, cell in row.items()}
                    units = {name[5:].split(" [")[0]: name[:-1].split(" [")[-1] for name in row if name.startswith("scan.")}
                    for key in KEYS:
                        unit = {"length": 1, "length^2": 2}.get(units.get(key), 0)
                        values = [float(cells[name] or "nan") * size ** unit for name in
                                  (f"scan.{key}", *(f"resolution.{key}.{end}" for end in ("corrected", "low", "high")))]
                        found.setdefault((kind, key, across), []).append((true[key], *values))
        print(f"body {number + 1} of {len(bodies)}", file=sys.stderr, flush=True)
    print_coverage(found)


def print_coverage(found):
    print("from | descriptor | voxels across | rows | resolved % | raw error % | corrected error % | half width % | covered %")
    for (kind, key, across), rows in sorted(found.items(), key=lambda one: (one[0][0] != "labels", KEYS.index(one[0][1]), one[0][2])):
        truth, raw, corrected, low, high = np.array(rows).T
        of = 1 if key.startswith("roundness") else np.abs(truth)
        good = np.isfinite(corrected)
        cells = [f"{100 * good.mean():.0f}", f"{100 * rms((raw - truth) / of):.2f}"]
        if good.any():
            cells += [f"{100 * rms(((corrected - truth) / of)[good]):.2f}", f"{100 * ((high - low) / 2 / of)[good].mean():.2f}",
                      f"{100 * ((low <= truth) & (truth <= high))[good].mean():.1f}"]
        print(f"{kind} | {key} | {across} | {len(rows)} | " + " | ".join(cells))


def marked(mask, count):
    """Returns a mask of so many bodies, as in side_by_side, with their numbers from 1."""
    return np.where(mask, np.repeat(np.arange(1, count + 1), len(mask) // count)[:, None, None], 0)


def by_segment(program, grey):
    save("scan.npy", grey, np.float32)
    call(program, "segment", "scan.npy", "labels.nrrd", "--separate", 0, "-q")
    head, _, body = pathlib.Path("labels.nrrd").read_bytes().partition(b"\n\n")
    words = dict(line.split(": ", 1) for line in head.decode().splitlines() if ": " in line)
    kind = {"uint8": np.uint8, "uint16": "<u2", "uint32": "<u4"}[words["type"]]
    return np.frombuffer(gzip.decompress(body), kind).reshape(grey.shape[::-1]).transpose(2, 1, 0) > 0


def level_mask(grey, blur, medians):
    """Returns what level_mask.cpp makes of grey values from 0 to 1, smoothed by so many medians, with a known blur."""
    from scipy.ndimage import binary_dilation, binary_erosion, laplace, median_filter, uniform_filter
    for _ in range(medians):
        grey = median_filter(grey, 3)
    mean = uniform_filter(np.clip(grey, 0, 1), 3)
    mask = mean >= 0.5
    beside = binary_dilation(mask) & ~binary_erosion(mask)
    return np.where(beside, mean - 1.3 * (blur ** 2 + (1 + medians) * 2 / 3) * laplace(mean) >= 0.5, mask)


def sizes_of(points, faces):
    """Returns area, sphericity and convexity."""
    from scipy.spatial import ConvexHull
    corners = points[faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    inside = volume(points, faces)
    return np.array([area, (36 * np.pi * inside ** 2) ** (1 / 3) / area, inside / ConvexHull(points).volume])


def surfaces(program, labels, count):
    """Returns sizes_of of the surfaces of labels 1 to count; NaN without one."""
    save("labels.npy", labels)
    call(program, "extract", "labels.npy", "out", "-q", "--format", "obj", "--smallest", 30)
    sizes = np.full((count, 3), np.nan)
    for path in pathlib.Path("out").glob("*.obj"):
        lines = [line.split() for line in path.read_text(encoding="ascii").splitlines()]
        points = np.array([line[1:4] for line in lines if line[:1] == ["v"]], float)
        faces = np.array([[cell.split("/")[0] for cell in line[1:4]] for line in lines if line[:1] == ["f"]], int) - 1
        sizes[int(path.stem) - 1] = sizes_of(points, faces)
    return sizes


def again(program, *files):
    from scipy.ndimage import gaussian_filter
    sphere, faces = cube_sphere(60)
    bodies = [Body(seed) for seed in range(301, 313)] + [Particle(file) for file in files]
    judges = np.arange(len(bodies)) % 2 == 1
    print("labels | voxels across | descriptor | raw error %, rms | corrected error %, rms | gain | covered %")
    blur = 0.7
    for across in (15, 20, 30, 40):
        scale = [across / (6 * volume(body.mesh(SPHERE)) / np.pi) ** (1 / 3) for body in bodies]  # as in placed
        true = np.array([sizes_of(one * body.mesh(sphere), faces) for one, body in zip(scale, bodies)])
        scans = [grey_of(*placed(body, across, 1000 * number + across)[::2]) for number, body in enumerate(bodies)]
        clean = side_by_side(scans)
        for noise in (0.1, 0.2):
            grey = clean + np.random.default_rng(across).normal(0, noise, clean.shape)
            for medians, name_of in ((1, "segment"), (0, "without a median")):
                mask = by_segment(program, grey) if medians else level_mask(grey, blur, 0)
                seen = surfaces(program, marked(mask, len(bodies)), len(bodies))
                mask = level_mask(gaussian_filter(mask.astype(float), blur), blur, medians)
                second = surfaces(program, marked(mask, len(bodies)), len(bodies))
                for k, name in enumerate(("area", "sphericity", "convexity")):
                    error = true[:, k] / seen[:, k] - 1
                    terms = np.array([np.ones(len(bodies)), 1 - second[:, k] / seen[:, k]]).T
                    gives = ~judges & np.isfinite(error + terms[:, 1])
                    judge = judges & np.isfinite(error + terms[:, 1])
                    found = np.linalg.lstsq(terms[gives], error[gives], rcond=None)[0]
                    left = error - terms @ found
                    covered = np.abs(left[judge]) <= 2 * rms(left[gives])
                    print(f"{name_of}, noise {noise} | {across} | {name} | {100 * rms(error[judge]):.2f} | "
                          f"{100 * rms(left[judge]):.2f} | {found[1]:.2f} | {100 * covered.mean():.0f}", flush=True)


if __name__ == "__main__":
    wscvt = pathlib.Path(sys.argv[2]).resolve()
    command = {"nodes": nodes, "coverage": coverage, "again": again}[sys.argv[1]]
    given = [pathlib.Path(name).resolve() for name in sys.argv[3:]]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        command(wscvt, *given)
