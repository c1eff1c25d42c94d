#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Presses a grain between two rigid plates and prints the force, with CalculiX.

    wscvt remesh scan.ply grain.ply -n 2000 --frame principal --tetrahedra grain.inp
    compression.py grain.inp --by 5

The plates are normal to z and rough: a node that touches a plate sticks to it, so that the grain
does not tilt. The body is linear elastic, and displacements are small. The contact is found in
steps: nodes that are behind a plate are put on it, then nodes that it pulls are released, until no
node is either. "ccx" must be on the
path (Debian: calculix-ccx).
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

MOST_STEPS = 30
# A node is behind a plate if it is by more than this share of the plate's way. Without it, nodes at
# the edge of a rough contact come and go for ever.
SLACK = 0.01


def body_of(path):
    """Returns the coordinates of the nodes by number, the numbers of the surface's nodes, and the
    surface's triangles as indices of those."""
    corners = {"S1": (0, 1, 2), "S2": (0, 1, 3), "S3": (1, 2, 3), "S4": (2, 0, 3)}
    nodes, elements, faces, last, block = {}, {}, [], 0, ""
    for line in path.read_text(encoding="utf-8").splitlines():
        words = [word.strip() for word in line.split(",")]
        if line.startswith("*"):
            block = words[0].upper()
        elif block == "*NODE":
            nodes[int(words[0])] = [float(word) for word in words[1:]]
        elif block == "*ELEMENT":
            elements[int(words[0])] = [int(word) for word in words[1:]]
        elif block == "*NSET":
            last = int(words[1])
        elif block == "*SURFACE":
            faces.append([elements[int(words[0])][k] - 1 for k in corners[words[1]]])
    return nodes, range(1, last + 1), faces


def solve(mesh, folder, fixed, modulus, poisson):
    """Returns the displacements in z and the forces in z of the nodes. fixed: z by node."""
    lines = [f"*INCLUDE, INPUT={mesh}", "*MATERIAL, NAME=stone", "*ELASTIC", f"{modulus}, {poisson}",
             "*SOLID SECTION, ELSET=grain, MATERIAL=stone", "*STEP", "*STATIC", "*BOUNDARY"]
    for node, height in fixed.items():
        # CalculiX reads 20 characters of a number.
        lines += [f"{node}, 1, 2, 0", f"{node}, 3, 3, {height:.11e}"]
    lines += ["*NODE PRINT, NSET=grain_nodes", "U, RF", "*NODE FILE", "U", "*EL FILE", "S", "*END STEP"]
    (folder / "press.inp").write_text("\n".join(lines) + "\n", encoding="utf-8")
    done = subprocess.run(["ccx", "press"], cwd=folder, capture_output=True, text=True)
    results = folder / "press.dat"
    if done.returncode or not results.exists():
        sys.exit(f"CalculiX failed:\n{done.stdout[-2000:]}{done.stderr}")
    values = {"displacements": {}, "forces": {}}
    kind = None
    for line in results.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and not words[0].isdigit():
            kind = words[0]
        elif words:
            values[kind][int(words[0])] = float(words[3])
    return values["displacements"], values["forces"]


def press(mesh, body, share, modulus=1.0, poisson=0.25, keep=None):
    """Returns the force on the upper plate, that on the lower, the nodes that touch, and the
    displacements in z by node.

    mesh: the file; body: what body_of returns of it. share: the compression over the grain's height. modulus: of elasticity, force / length^2.
    """
    nodes, surface, _ = body
    heights = [nodes[n][2] for n in surface]
    low, high = min(heights), max(heights)
    move = share * (high - low) / 2.0
    low, high = low + move, high - move  # where the plates end
    touching = {n for n in surface if not low <= nodes[n][2] <= high}
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(keep or scratch)
        for _ in range(MOST_STEPS):
            plate = {n: high if nodes[n][2] > (low + high) / 2.0 else low for n in touching}
            moved, forces = solve(mesh.resolve(), folder,
                                  {n: plate[n] - nodes[n][2] for n in sorted(touching)},
                                  modulus, poisson)
            pulled = {n for n in touching if forces[n] * (1.0 if plate[n] == low else -1.0) < 0.0}
            behind = {n for n in surface if n not in touching
                      and not low - SLACK * move <= nodes[n][2] + moved[n] <= high + SLACK * move}
            if not pulled and not behind:
                upper = -sum(forces[n] for n in touching if plate[n] == high)
                lower = sum(forces[n] for n in touching if plate[n] == low)
                return upper, lower, touching, moved
            touching = touching | behind if behind else touching - pulled
    sys.exit(f"The contact was not found in {MOST_STEPS} steps.")


def draw(body, touching, moved, path):
    """Draws the surface by the displacement in z, and the nodes that touch."""
    import matplotlib.pyplot
    import numpy
    from matplotlib.tri import Triangulation
    nodes, surface, faces = body
    points = numpy.array([nodes[n] for n in surface])
    figure = matplotlib.pyplot.figure(figsize=(6, 6))
    axes = figure.add_subplot(projection="3d", elev=10)
    values = numpy.array([moved[n] for n in surface])[numpy.array(faces)].mean(axis=1)
    drawn = axes.plot_trisurf(Triangulation(points[:, 0], points[:, 1], faces), points[:, 2],
                              cmap="coolwarm", edgecolor="black", linewidth=0.1)
    drawn.set_array(values)
    axes.scatter(*numpy.array([nodes[n] for n in touching]).T, color="black", s=8, depthshade=False)
    axes.set_box_aspect(numpy.ptp(points, axis=0))
    figure.colorbar(drawn, label="displacement along z", shrink=0.6)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", type=pathlib.Path, help="tetrahedra as .inp, from --tetrahedra")
    parser.add_argument("--by", type=float, default=5.0, help="compression in %% of the height (default 5)")
    parser.add_argument("--modulus", type=float, default=1.0, help="modulus of elasticity (default 1)")
    parser.add_argument("--poisson", type=float, default=0.25, help="Poisson's ratio (default 0.25)")
    parser.add_argument("--picture", help="picture of the surface with its displacements (matplotlib)")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for CalculiX's files")
    given = parser.parse_args()
    if given.keep:
        given.keep.mkdir(parents=True, exist_ok=True)
    body = body_of(given.mesh)
    upper, lower, touching, moved = press(given.mesh, body, given.by / 100.0, given.modulus, given.poisson,
                                          given.keep)
    print(f"force {upper:.4g} on the upper plate, {lower:.4g} on the lower, {len(touching)} nodes touch")
    if given.picture:
        draw(body, touching, moved, given.picture)


if __name__ == "__main__":
    main()
