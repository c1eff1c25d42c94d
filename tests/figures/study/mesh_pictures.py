#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of scans beside their remeshes, on one sheet.

  tests/figures/study/mesh_pictures.py PROGRAM SHEET.png BODY ... [-- OPTION ...]
  tests/figures/study/mesh_pictures.py --bodies FOLDER

BODY is a mesh file, or plate10, plate30, plate100, needle10, needle30, torus or washer, which are
made here. Each is remeshed by PROGRAM with the OPTIONs, and drawn as scan and as remesh from the
same side, from near its shortest axis; the remesh with its edges. --bodies writes the bodies that
are made here into FOLDER. Needs numpy.
"""
import os
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np

CELL = 300  # pixels of one picture
ELLIPSOIDS = {"plate10": (10, 10, 1), "plate30": (30, 25, 1), "plate100": (100, 80, 1),
              "needle10": (10, 1, 1), "needle30": (30, 1, 1)}


def write_obj(path, points, faces):
    with open(path, "w") as out:
        for p in points:
            out.write("v %.9g %.9g %.9g\n" % tuple(p))
        for f in faces + 1:
            out.write("f %d %d %d\n" % tuple(f))


def read_obj(path):
    rows = [line.split() for line in open(path)]
    points = np.array([r[1:4] for r in rows if r and r[0] == "v"], float)
    faces = np.array([[c.split("/")[0] for c in r[1:4]] for r in rows if r and r[0] == "f"], int)
    return points, faces - 1


def ring(profile, around):
    """A closed profile (distance from the axis, height) turned about the axis."""
    count = len(profile)
    turn = 2 * np.pi * np.arange(around) / around
    points = np.stack([np.outer(np.cos(turn), profile[:, 0]), np.outer(np.sin(turn), profile[:, 0]),
                       np.tile(profile[:, 1], (around, 1))], 2).reshape(-1, 3)
    i, j = [a.ravel() for a in np.meshgrid(np.arange(around), np.arange(count), indexing="ij")]
    at = lambda k, l: (i + k) % around * count + (j + l) % count
    return points, np.concatenate([np.stack([at(0, 0), at(1, 0), at(1, 1)], 1),
                                   np.stack([at(0, 0), at(1, 1), at(0, 1)], 1)])


def rectangle(inner, outer, half, across, up):
    corners = [(inner, -half), (outer, -half), (outer, half), (inner, half)]
    sides = []
    for k, parts in enumerate([across, up, across, up]):
        a, b = np.array(corners[k]), np.array(corners[(k + 1) % 4])
        sides += [a + (b - a) * s / parts for s in range(parts)]
    return np.array(sides)


def ball(parts):
    """An octahedron's faces in parts * parts triangles each, on the unit sphere."""
    points, faces = [], []
    for signs in np.array(np.meshgrid([1, -1], [1, -1], [1, -1])).reshape(3, -1).T:
        start = len(points)
        at = lambda i, j: start + i * (2 * parts + 3 - i) // 2 + j
        for i in range(parts + 1):
            for j in range(parts + 1 - i):
                points.append(signs * np.array([i, j, parts - i - j]))
                if i + j < parts:
                    faces.append((at(i, j), at(i + 1, j), at(i, j + 1))[::signs.prod()])
                if i + j < parts - 1:
                    faces.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))[::signs.prod()])
    points, numbers = np.unique(np.array(points), axis=0, return_inverse=True)
    return points / np.linalg.norm(points, axis=1)[:, None], numbers.ravel()[np.array(faces)]


def make(body, path):
    if body in ELLIPSOIDS:
        points, faces = ball(70)
        write_obj(path, points * ELLIPSOIDS[body], faces)
    elif body == "torus":
        turn = 2 * np.pi * np.arange(80) / 80
        write_obj(path, *ring(np.stack([1 + 0.4 * np.cos(turn), 0.4 * np.sin(turn)], 1), 250))
    else:
        write_obj(path, *ring(rectangle(0.7, 1.3, 0.05, 24, 4), 260))


def view_of(points, faces):
    """Rows: right, up, towards the eye, tilted off the principal axes."""
    corners = points[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                           axis=1)
    middles = corners.mean(1)
    centre = np.average(middles, axis=0, weights=areas)
    axes = np.linalg.eigh(((middles - centre).T * areas) @ (middles - centre))[1].T[::-1]
    axes[2] = np.cross(axes[0], axes[1])
    tilt = lambda a: np.array([[1, 0, 0], [0, np.cos(a), np.sin(a)], [0, -np.sin(a), np.cos(a)]])
    return tilt(0.9) @ axes, centre


def draw(points, faces, view, centre, scale, edges):
    q = (points - centre) @ view.T * scale
    picture = np.full((CELL, CELL), 255.0)
    depth = np.full((CELL, CELL), -1e30)
    x, y = q[:, 0] + CELL / 2, CELL / 2 - q[:, 1]
    light = np.array([-0.4, 0.5, 0.77])
    for f in faces:
        a, b, c = q[f]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if normal[2] <= 0 or length == 0:
            continue
        left, right = int(max(x[f].min(), 0)), int(min(x[f].max() + 1, CELL - 1))
        top, bottom = int(max(y[f].min(), 0)), int(min(y[f].max() + 1, CELL - 1))
        gx, gy = np.meshgrid(np.arange(left, right + 1), np.arange(top, bottom + 1))
        area = (x[f[1]] - x[f[0]]) * (y[f[2]] - y[f[0]]) - (x[f[2]] - x[f[0]]) * (y[f[1]] - y[f[0]])
        w = np.stack([(x[f[(k + 1) % 3]] - gx) * (y[f[(k + 2) % 3]] - gy) -
                      (x[f[(k + 2) % 3]] - gx) * (y[f[(k + 1) % 3]] - gy) for k in range(3)]) / area
        z = w[0] * a[2] + w[1] * b[2] + w[2] * c[2]
        cut = depth[top:bottom + 1, left:right + 1]
        seen = (w >= -1e-9).all(0) & (z > cut)
        grey = np.full(z.shape, 40 + 190 * max(normal @ light / length, 0))
        if edges:
            sides = [np.hypot(x[f[(k + 1) % 3]] - x[f[(k + 2) % 3]],
                              y[f[(k + 1) % 3]] - y[f[(k + 2) % 3]]) for k in range(3)]
            near = np.min([w[k] * abs(area) / max(sides[k], 1e-9) for k in range(3)], 0)
            grey = np.where(near < 0.5, grey * 0.35, grey)
        cut[seen] = z[seen]
        picture[top:bottom + 1, left:right + 1][seen] = grey[seen]
    return picture


def write_png(path, picture):
    rows = (np.clip(picture, 0, 255) / 16).astype(np.uint8)  # four bits a pixel
    packed = rows[:, 0::2] << 4 | rows[:, 1::2]
    data = b"".join(b"\0" + row.tobytes() for row in packed)
    chunk = lambda kind, body: (struct.pack(">I", len(body)) + kind + body +
                                struct.pack(">I", zlib.crc32(kind + body)))
    header = struct.pack(">IIBBBBB", picture.shape[1], picture.shape[0], 4, 0, 0, 0, 0)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                  chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))


def main():
    arguments = sys.argv[1:]
    options = arguments[arguments.index("--") + 1:] if "--" in arguments else []
    arguments = arguments[:len(arguments) - len(options) - ("--" in arguments)]
    if arguments[:1] == ["--bodies"] and len(arguments) == 2:
        for body in [*ELLIPSOIDS, "torus", "washer"]:
            make(body, os.path.join(arguments[1], body + ".obj"))
        return
    if len(arguments) < 3:
        sys.exit(__doc__)
    program, sheet, bodies = arguments[0], arguments[1], arguments[2:]
    pairs = []
    with tempfile.TemporaryDirectory() as folder:
        for body in bodies:
            scan, remesh = os.path.join(folder, "scan.obj"), os.path.join(folder, "remesh.obj")
            run = lambda *rest: subprocess.run(
                [program, "remesh", *rest, "-q"], check=True,
                stderr=subprocess.DEVNULL)
            if os.path.isfile(body):  # 12,000 nodes on it show a scan, in a format that is read here
                run(body, scan, "-n", "12000", "-p", "on-surface")
            else:
                make(body, scan)
            run(body if os.path.isfile(body) else scan, remesh, *options)
            nodes = read_obj(remesh)
            view, centre = view_of(*nodes)
            q = np.abs((nodes[0] - centre) @ view.T)
            scale = 0.47 * CELL / max(q[:, 0].max(), q[:, 1].max())
            pairs.append(np.hstack([draw(*read_obj(scan), view, centre, scale, False),
                                    draw(*nodes, view, centre, scale, True)]))
    if len(pairs) % 2:
        pairs.append(np.full_like(pairs[0], 255))
    write_png(sheet, np.vstack([np.hstack(pairs[i:i + 2]) for i in range(0, len(pairs), 2)]))


if __name__ == "__main__":
    main()
