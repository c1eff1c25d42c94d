#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Four pictures of a packing on one sheet: contacts, surfaces that touch, fragments, tetrahedra.

  tests/figures/study/packing_pictures.py PROGRAM LABELS SCAN GRAIN SHEET.png

SCAN is that of lib/examples/ct_volume.py, LABELS what wscvt segment made of it (.nrrd), GRAIN a mesh. Needs
numpy and matplotlib.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

COLOURS = matplotlib.colormaps["tab20"].colors


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def read_obj(path):
    rows = [line.split() for line in path.read_text().splitlines()]
    points = np.array([row[1:4] for row in rows if row and row[0] == "v"], float)
    faces = np.array([row[1:4] for row in rows if row and row[0] == "f"], int) - 1
    return points[faces]


def read_inp(path):
    """Returns the corners of the tetrahedra of each set, (m, 4, 3)."""
    nodes, sets, block = [], {}, ""
    for line in path.read_text().splitlines():
        words = [word.strip() for word in line.split(",")]
        if line.startswith("*"):
            block = words[0]
            name = words[-1].split("=")[-1]
        elif block == "*NODE":
            nodes.append([float(word) for word in words[1:]])
        elif block == "*ELEMENT":
            sets.setdefault(name, []).append([int(word) - 1 for word in words[1:]])
    return {name: np.array(nodes)[corners] for name, corners in sets.items()}


def axes_at(figure, place, title):
    axes = figure.add_subplot(2, 2, place, projection="3d", elev=18, azim=-62)
    axes.set_title(title)
    axes.set_axis_off()
    return axes


def draw(axes, bodies, opacity=1.0):
    """bodies: triangles (m, 3, 3) and a colour of each."""
    light = np.array([0.3, -0.8, 0.5]) / np.linalg.norm([0.3, -0.8, 0.5])
    triangles = np.concatenate([body for body, _ in bodies])
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    shade = 0.55 + 0.45 * np.clip(normals @ light / np.linalg.norm(normals, axis=1), 0, 1)
    colours = np.concatenate([np.tile(colour, (len(body), 1)) for body, colour in bodies])
    colours = np.column_stack([colours * shade[:, None], np.full(len(colours), opacity)])
    axes.add_collection3d(Poly3DCollection(triangles, facecolors=colours, edgecolors="black",
                                           linewidths=0.12 * opacity))
    low, high = triangles.reshape(-1, 3).min(0), triangles.reshape(-1, 3).max(0)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_zlim(low[2], high[2])
    axes.set_box_aspect(high - low, zoom=1.25)


def draw_contacts(axes, bodies, folder):
    """Lines between the centres of touching grains, and the contacts' places."""
    draw(axes, [(body, (0.6, 0.6, 0.6)) for body, _ in bodies], 0.07)
    at = {row["label"]: [float(row[k]) for k in "xyz"] for row in table(folder / "grains.csv")}
    for row in table(folder / "contacts.csv"):
        is_contact = row["contact"] == "1"
        axes.plot(*np.array([at[row["first"]], at[row["second"]]]).T, color="firebrick" if is_contact else "steelblue",
                  linestyle="-" if is_contact else ":", linewidth=1.5, marker="o", markersize=3)
        if is_contact:
            axes.scatter(*[float(row[k]) for k in "xyz"], s=2 * float(row["area"]), color="firebrick", alpha=0.5)


def main():
    program, labels, scan, grain, sheet = sys.argv[1:]

    def run(*words):
        subprocess.run([program, *map(str, words)], check=True, stdout=subprocess.DEVNULL)
    figure = matplotlib.pyplot.figure(figsize=(10, 10))
    with tempfile.TemporaryDirectory() as scratch:
        made = pathlib.Path(scratch)
        run("describe", labels, scan, "-o", made / "contacts")
        run("extract", labels, made / "walls", "--at-border", "--edge-length", "4", "--format", "obj",
            "--tetrahedra", made / "packing.inp")
        grains = sorted((made / "walls").glob("*.obj"), key=lambda path: int(path.stem))
        bodies = [(read_obj(path), COLOURS[int(path.stem) % 20]) for path in grains]
        draw_contacts(axes_at(figure, 1, "contacts (dotted: narrow gaps)"), bodies, made / "contacts")
        draw(axes_at(figure, 2, "surfaces that touch"), bodies)
        run("fragment", grain, "-k", "20", "-o", made / "pieces", "-n", "200", "--format", "obj")
        pieces = [read_obj(path) for path in sorted((made / "pieces").glob("*.obj"))]
        draw(axes_at(figure, 3, "fragments, apart"),
             [(p + 0.35 * p.mean((0, 1)), COLOURS[k]) for k, p in enumerate(pieces)])
        halves = []
        for name, corners in read_inp(made / "packing.inp").items():
            middle = np.median(corners[:, :, 1])
            cut = corners[corners.mean(1)[:, 1] > middle]
            halves.append((cut[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3, 3),
                           COLOURS[int(name.split("_")[-1]) % 20]))
        draw(axes_at(figure, 4, "tetrahedra, cut"), halves)
    figure.tight_layout()
    figure.savefig(sheet, dpi=80)


if __name__ == "__main__":
    main()
