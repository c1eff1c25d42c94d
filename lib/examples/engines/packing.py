# SPDX-License-Identifier: GPL-3.0-or-later
"""What the examples beside this file share: their arguments, scans of a folder, calls of wscvt, the places
that grains are dropped from, and a picture of the packing."""
import math
import os
import pathlib
import random
import subprocess
import sys

WSCVT = os.environ.get("WSCVT", "wscvt")
ENDINGS = (".ply", ".stl", ".obj", ".off", ".vtp")


def arguments(usage, count):
    """The folder of scans and the number of grains that a script was called with; or its usage, and the
    end. The count is the number without a second argument."""
    words = sys.argv[1:]
    if 1 <= len(words) <= 2 and pathlib.Path(words[0]).is_dir() and (words[1:] or ["1"])[0].isdigit():
        folder, count = pathlib.Path(words[0]), int((words + [count])[1])
        if folder.resolve() == pathlib.Path.cwd():
            leave("Run this in another folder than that of the scans, because it writes meshes.")
        if count > 0:
            return folder, count
    leave(usage.strip() + "\n\nSCANS is a folder that holds meshes (%s)." % " ".join(ENDINGS))


def leave(sentence):
    """Ends the script with exit code 2, in Yade as well, which keeps sys.exit from its caller."""
    print(sentence, file=sys.stderr, flush=True)
    os._exit(2)


def wscvt(*words):
    try:
        subprocess.run([WSCVT, *map(str, words), "-q"], check=True)
    except OSError:
        leave("\"%s\" does not run. Set the variable WSCVT to the path of wscvt." % WSCVT)


def of_each(folder, make):
    """make(number, scan) for each mesh of a folder, in the order of their names. A scan that wscvt refuses
    is left out, with a line."""
    made = []
    for scan in sorted(p for p in folder.iterdir() if p.suffix.lower() in ENDINGS):
        try:
            made.append(make(len(made), scan))
        except subprocess.CalledProcessError:
            print("Left out: %s" % scan, file=sys.stderr)
    if not made:
        leave("%s holds no scan that wscvt takes." % folder)
    return made


def drops(count, diameter, width, seed=1):
    """Places (x, y, z) above the ground in a box about the z axis, layer on layer, and unit quaternions
    (w, x, y, z) of random turns. Grains so far apart do not touch."""
    step = 1.5 * diameter
    side = max(1, int(width / step))
    chance = random.Random(seed)
    for k in range(count):
        i, j, layer = k % side, k // side % side, k // side ** 2
        place = [(i - (side - 1) / 2) * step, (j - (side - 1) / 2) * step, (layer + 0.8) * step]
        turn = [chance.gauss(0, 1) for _ in range(4)]
        size = math.sqrt(sum(q * q for q in turn))
        yield place, [q / size for q in turn]


def read_obj(path):
    """Vertices and triangles of an OBJ file, whose faces name vertices alone."""
    vertices, faces = [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(w) - 1 for w in words[1:4]])
    return vertices, faces


def sphere_mesh(spheres):
    """Vertices and triangles of spheres (x, y, z, radius)."""
    import numpy as np

    polar, turn = np.meshgrid(np.linspace(0, np.pi, 5), np.linspace(0, 2 * np.pi, 9), indexing="ij")
    ball = np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], -1)
    ball = ball.reshape(-1, 3)
    corners = [9 * i + j for i in range(4) for j in range(8)]
    faces = np.array([face for a in corners for face in ([a, a + 9, a + 10], [a, a + 10, a + 1])])
    return (np.concatenate([np.asarray(sphere[:3]) + sphere[3] * ball for sphere in spheres]),
            np.concatenate([faces + k * len(ball) for k in range(len(spheres))]))


def turned(vertices, place, turn):
    """Vertices turned by a unit quaternion (w, x, y, z) and moved to a place."""
    import numpy as np

    w, x, y, z = turn
    matrix = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                       [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                       [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    return np.asarray(vertices) @ matrix.T + np.asarray(place)


def picture(path, grains, width):
    """A picture of grains, each (vertices, faces), in a box of that width about the z axis."""
    import matplotlib
    matplotlib.use("Agg")
    import numpy as np
    from matplotlib import pyplot
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    axes = pyplot.figure(figsize=(8, 8)).add_subplot(projection="3d")
    for k, (vertices, faces) in enumerate(grains):
        colour = pyplot.cm.tab20(k % 20)
        axes.add_collection3d(Poly3DCollection(np.asarray(vertices)[np.asarray(faces)], facecolor=colour,
                                               edgecolor=(0, 0, 0, 0.3), linewidth=0.2))
    axes.set(xlim=(-width / 2, width / 2), ylim=(-width / 2, width / 2), zlim=(0, width))
    axes.set_box_aspect((1, 1, 1))
    pyplot.savefig(path, dpi=100)
