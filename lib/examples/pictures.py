# SPDX-License-Identifier: GPL-3.0-or-later
"""pictures.py [SCAN [OUTPUT.png]]: a scan and its remeshes at 100 and 1000 nodes, and their distances.

Needs matplotlib.
"""
import pathlib
import sys

import matplotlib
import numpy as np

import wscvt

matplotlib.use("Agg")  # without a window
from matplotlib import pyplot as plt  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

MESHES = pathlib.Path(__file__).resolve().parent.parent.parent / "meshes"


def draw_mesh(axes, vertices, faces, title, edges):
    """Draws triangles with light from above."""
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    grey = 0.55 + 0.35 * normals @ np.array([0.3, -0.5, 0.81])
    axes.add_collection3d(Poly3DCollection(corners, facecolors=np.stack([grey] * 3, axis=1).clip(0, 1),
                                           edgecolors="black" if edges else "none", linewidths=0.2))
    middle, half = vertices.mean(axis=0), np.ptp(vertices, axis=0).max() / 2
    axes.set(xlim=middle[0] + [-half, half], ylim=middle[1] + [-half, half],
             zlim=middle[2] + [-half, half], title=title)
    axes.set_box_aspect((1, 1, 1), zoom=1.7)
    axes.set_axis_off()


def main():
    scan = sys.argv[1] if len(sys.argv) > 1 else MESHES / "sand_7228.ply"
    output = sys.argv[2] if len(sys.argv) > 2 else "pictures.png"
    vertices, faces = wscvt.read_mesh(scan)
    results = {nodes: wscvt.remesh(vertices, faces, nodes) for nodes in (100, 1000)}

    figure = plt.figure(figsize=(10, 7.5))
    draw_mesh(figure.add_subplot(2, 2, 1, projection="3d"), vertices, faces,
              f"scan, {len(vertices)} vertices", False)
    histogram = figure.add_subplot(2, 2, 4)
    for place, (nodes, result) in enumerate(results.items(), start=2):
        draw_mesh(figure.add_subplot(2, 2, place, projection="3d"), result.vertices, result.faces,
                  f"{nodes} nodes", True)
        distances = wscvt.signed_distances(vertices, result)
        histogram.hist(100 * distances / result.report["input"]["equivalent_radius"], bins=60,
                       histtype="step", density=True, label=f"{nodes} nodes")
    histogram.set(xlabel="distance of the scan's vertices, % of the equivalent radius", ylabel="density, 1/%")
    histogram.legend()
    figure.savefig(output, dpi=90)
    print(f"The pictures are in {output}.")


if __name__ == "__main__":
    main()
