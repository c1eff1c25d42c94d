# SPDX-License-Identifier: GPL-3.0-or-later
"""one_grain.py [SCAN [OUTPUT]]: a scan to 500 nodes, its errors, and its nodes as NumPy arrays."""
import pathlib
import sys

import wscvt

MESHES = pathlib.Path(__file__).resolve().parent.parent.parent / "meshes"

scan = sys.argv[1] if len(sys.argv) > 1 else str(MESHES / "sand_7228.ply")
output = sys.argv[2] if len(sys.argv) > 2 else "one_grain.ply"
vertices, faces = wscvt.read_mesh(scan)
result = wscvt.remesh(vertices, faces, nodes=500)
wscvt.write_mesh(output, result.vertices, result.faces)

for name in ("volume", "area", "sphericity_wadell"):
    row = result.report["descriptors"][name]
    print(f"{name}: scan {row['scan']:.5g}, remesh {row['remesh']:.5g}")
print("nodes:", result.vertices.shape, "centroid:", result.vertices.mean(axis=0).round(3))
for warning in result.warnings:
    print("Warning:", warning)
