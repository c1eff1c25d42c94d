#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a large volume of labels and extracts its grains under a limit of memory.

    tests/figures/benchmarks/large_volume.py build/release/lib/wscvt WORK_FOLDER [--counts 2000 2000 1000]

The volume has 5,000 ellipsoids with waves on them, each in its own cell and rotated at random, as 16-bit
voxels: 8 GB. It is written slice by slice. The program may use no more than 4 GiB of address space. The
script prints the program's output, its time and its peak memory. It checks the number of meshes, and the
volume of some of them, and removes everything.
"""

import argparse
import json
import pathlib
import resource
import shutil
import subprocess
import sys
import time

import numpy as np

LIMIT = 4 << 30


def make(folder, counts, cells):
    """labels.raw, labels.json; the voxels of every label."""
    random = np.random.default_rng(1)
    size = np.array(counts) / np.array(cells)
    grains = []
    for cell in np.ndindex(*cells):
        turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
        axes = random.uniform(0.6, 0.94, 3) * size.min() / 2.0
        grains.append((np.array(cell) * size + size / 2.0, turn, axes, random.uniform(0, 6, 3)))
    voxels = np.zeros(len(grains) + 1, np.int64)
    starts = np.array([grain[0][2] - grain[2].max() * 1.06 for grain in grains])
    ends = np.array([grain[0][2] + grain[2].max() * 1.06 for grain in grains])
    with open(folder / "labels.raw", "wb") as file:
        for z in range(counts[2]):
            plane = np.zeros((counts[1], counts[0]), np.uint16)
            for k in np.nonzero((starts < z + 1) & (ends > z))[0]:
                middle, turn, axes, phase = grains[k]
                reach = axes.max() * 1.06
                x0, y0 = (max(0, int(c - reach)) for c in middle[:2])
                x1, y1 = (min(n, int(c + reach) + 2) for c, n in zip(middle[:2], counts[:2]))
                y, x = np.mgrid[y0:y1, x0:x1] + 0.5
                p = np.stack([x - middle[0], y - middle[1], np.full_like(x, z + 0.5 - middle[2])], -1)
                q = (p @ turn) / axes
                wave = 1.0 + 0.05 * np.sin(5.0 * q + phase).prod(-1)
                inside = (q * q).sum(-1) < wave * wave
                plane[y0:y1, x0:x1][inside] = k + 1
                voxels[k + 1] += inside.sum()
            file.write(plane.tobytes())
    (folder / "labels.json").write_text(json.dumps(
        {"dimensions": counts, "type": "uint16", "spacing": 0.01, "unit": "mm"}))
    return voxels


def volume_of(path):
    data = path.read_bytes()
    header = data[:data.index(b"end_header\n") + 11]
    vertices, faces = (int(line.split()[-1]) for line in header.split(b"\n")
                       if line.startswith(b"element"))
    points = np.frombuffer(data, "<f8", 3 * vertices, len(header)).reshape(-1, 3)
    triangles = np.frombuffer(data, np.dtype([("n", "u1"), ("v", "<i4", 3)]), faces,
                              len(header) + 24 * vertices)["v"]
    a, b, c = (points[triangles[:, k]] - points[0] for k in range(3))
    return (a * np.cross(b, c)).sum() / 6.0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--counts", type=int, nargs=3, default=[2000, 2000, 1000])
    parser.add_argument("--cells", type=int, nargs=3, default=[20, 25, 10])
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    parser.add_argument("--remesh", action="store_true", help="to 500 nodes, as published")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True)
    try:
        start = time.time()
        voxels = make(arguments.folder, arguments.counts, arguments.cells)
        print(f"made in {time.time() - start:.0f} s", flush=True)
        out = arguments.folder / "out"
        call = [arguments.program, "extract", arguments.folder / "labels.json", out]
        if arguments.remesh:
            call = [arguments.program, "batch", arguments.folder / "labels.json", "-o", out, "-n",
                    "500", "--method", "as-published"]
        start = time.time()
        child = subprocess.run(
            call + ["-t", str(arguments.threads)] if arguments.threads else call, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT)))
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = time.time() - start
        print(f"exit code {child.returncode}, {seconds:.2f} s, {voxels[1:].size / seconds:.0f} grains and "
              f"{np.prod(arguments.counts) / seconds / 1e6:.0f} million voxels a second, processor time "
              f"{used.ru_utime + used.ru_stime:.2f} s, peak {used.ru_maxrss / 1024:.0f} MiB")
        grains = np.prod(arguments.cells)
        meshes = list(out.glob("*.ply"))
        print(f"{len(meshes)} meshes of {grains} grains, "
              f"{sum(mesh.stat().st_size for mesh in meshes) / 1e9:.1f} GB")
        good = child.returncode == 0 and len(meshes) == grains
        for label in range(1, grains + 1, max(1, grains // 50)):
            if not arguments.remesh:
                made = volume_of(out / f"{label}.ply") / (voxels[label] * 1e-6)
                good = good and abs(made - 1.0) < 1e-9
        return 0 if good else 1
    finally:
        shutil.rmtree(arguments.folder)


sys.exit(main())
