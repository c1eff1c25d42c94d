# SPDX-License-Identifier: GPL-3.0-or-later
"""Advice of the program, followed: for each message that names an option or a command, an input that causes
it, the command that it names, and what must come of it."""
import os
import pathlib
import re
import struct
import subprocess

import numpy as np
import pytest

import wscvt

MESHES = pathlib.Path(os.environ["WSCVT_MESHES_DIR"])
LIBRARY = MESHES.parent / "lib"


# Inputs. Each maker writes into the folder where the program runs.

def balls(middles, counts=(24, 24, 40), labels=None):
    """Labels (nz, ny, nx) of balls (x, y, z, radius)."""
    z, y, x = np.indices(counts) + 0.5
    volume = np.zeros(counts, np.uint16)
    for k, (a, b, c, r) in enumerate(middles):
        volume[(x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2 < r * r] = k + 1 if labels is None else labels[k]
    return volume


TWO = [(10, 12, 12, 7), (29, 12, 12, 8)]


def grey(volume, values=(60, 160), noise=5.0):
    """Blurred grey values of labels: values[label], with noise."""
    scan = np.asarray(values, float)[volume]
    for axis in range(3):
        scan = (np.roll(scan, 1, axis) + 2 * scan + np.roll(scan, -1, axis)) / 4
    return (scan + np.random.default_rng(5).normal(0, noise, volume.shape)).astype(np.float32)


def npy(name, make):
    return lambda folder: np.save(folder / name, make())


def text(name, content):
    return lambda folder: (folder / name).write_text(content)


def two_sizes(folder):
    (folder / "v.nrrd").write_bytes(b"NRRD0004\ntype: uint16\ndimension: 3\nsizes: 40 24 24\nspacings: 1 1 9\n"
                                    b"endian: little\nencoding: raw\n\n" + balls(TWO).astype("<u2").tobytes())


def two_units(folder):
    (folder / "v.nrrd").write_bytes(b"NRRD0004\ntype: uint16\ndimension: 3\nsizes: 40 24 24\nspacings: 1 1 1\n"
                                    b'units: "mm" "um" "um"\nendian: little\nencoding: raw\n\n'
                                    + balls(TWO).astype("<u2").tobytes())


def two_arrays(folder):
    np.savez(folder / "v.npz", ids=balls(TWO), grey=grey(np.minimum(balls(TWO), 1)))


def white_is_0(folder):
    """A TIFF of pages that show 0 as white; the grain is 0, the space around it 255."""
    pages = [(255 - 255 * page.astype(np.uint8)).tobytes() for page in balls(TWO[:1])]
    first = 8 + sum(map(len, pages))
    length = 2 + 12 * 9 + 4
    directories = b""
    for k, page in enumerate(pages):
        tags = [(256, 40), (257, 24), (258, 8), (259, 1), (262, 0), (273, 8 + k * len(page)), (277, 1), (278, 24),
                (279, len(page))]
        following = first + (k + 1) * length if k + 1 < len(pages) else 0
        directories += struct.pack("<H", len(tags))
        directories += b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in tags)
        directories += struct.pack("<I", following)
    (folder / "v.tif").write_bytes(struct.pack("<2sHI", b"II", 42, first) + b"".join(pages) + directories)


def mesh(name, source="sand_5658.ply", change=None):
    def make(folder):
        vertices, faces = wscvt.read_mesh(MESHES / source)
        if change:
            vertices, faces = change(np.array(vertices), np.array(faces))
        wscvt.write_mesh(folder / name, vertices, faces)
    return make


def ellipsoid(name, axes, nodes=500):
    def make(folder):
        made = wscvt.create("ellipsoid", semi_axes=axes, nodes=nodes)
        wscvt.write_mesh(folder / name, made.vertices, made.faces)
    return make


def extracted(name, volume, smoothing=20):
    """The mesh of a volume with one grain, which touches no border."""
    def make(folder):
        (vertices, faces), = wscvt.extract(volume(), smallest=1, smoothing=smoothing).values()
        wscvt.write_mesh(folder / name, vertices, faces)
    return make


def without_a_cap(share):
    """The scan without its faces near the top, where this share of its vertices is."""
    def change(vertices, faces):
        top = vertices[:, 2] > np.quantile(vertices[:, 2], 1 - share)
        return vertices, faces[~top[faces].all(axis=1)]
    return change


def points(name):
    def make(folder):
        vertices, _ = wscvt.read_mesh(MESHES / "sand_5658.ply")
        with open(folder / name, "w") as file:
            np.savetxt(file, vertices)
    return make


def ring(radius=12.0, thickness=4.0):
    z, y, x = np.indices((20, 44, 44)) - np.array([10, 22, 22])[:, None, None, None] + 0.5
    return ((np.sqrt(x * x + y * y) - radius) ** 2 + z * z < thickness ** 2).astype(np.uint8)


def dumbbell():
    """A body whose middle is a bent bow: its centroid lies outside."""
    volume = ring()
    volume[:, 22:, 16:28] = 0
    return volume


def mushroom():
    """A ball with a smaller one on a neck, which hides a part of it from the centroid."""
    z, y, x = np.indices((28, 28, 44)) + 0.5 - np.array([14, 14, 0])[:, None, None, None]
    r = np.sqrt(y * y + z * z)
    return ((np.hypot(r, x - 13) < 10) | (np.hypot(r, x - 32) < 6) | ((r < 3) & (x > 13) & (x < 32))).astype(np.uint8)


def two_bodies(folder):
    vertices, faces = wscvt.read_mesh(MESHES / "sand_5658.ply")
    wscvt.write_mesh(folder / "two.stl", np.vstack([vertices, vertices + [5, 0, 0]]),
                     np.vstack([faces, faces + len(vertices)]))


def scans(*sources):
    def make(folder):
        (folder / "scans").mkdir()
        for source in sources or ("sand_5658", "angular_6000"):
            wscvt.write_mesh(folder / "scans" / f"{source}.ply", *wscvt.read_mesh(MESHES / f"{source}.ply"))
    return make


def together(*makers):
    def make(folder):
        for one in makers:
            one(folder)
    return make


def after(command, *makers):
    """The inputs, and what a command makes of them."""
    def make(folder):
        together(*makers)(folder)
        run(folder, command)
    return make


def run(folder, command):
    done = subprocess.run(f"'{os.environ['WSCVT_PROGRAM']}' {command}", shell=True, cwd=folder, text=True,
                          capture_output=True, timeout=300)
    done.said = " ".join((done.stdout + "\n" + done.stderr).split())
    return done


class Advice:
    """`command` on `inputs` says `advice`, a regular expression; `followed`, with its groups, ends with `code`
    and says `then` and not `gone`, by default not the advice."""

    def __init__(self, name, inputs, command, advice, followed, then, gone=None, code=0):
        self.name, self.inputs, self.command, self.advice = name, inputs, command, advice
        self.followed, self.then, self.gone, self.code = followed, then, gone, code


e = "--smallest 1"
ALL = [
    # Volumes
    Advice("channel", npy("v.npy", lambda: np.stack([balls(TWO), balls(TWO[:1])], -1)), f"extract v.npy out {e}",
           "2 channels.*(--select) channel=1 to (channel=2)", f"extract v.npy out {e} \\1 \\2", "1 label"),
    Advice("time", npy("v.npy", lambda: np.stack([balls(TWO)] * 12)), f"extract v.npy out {e}",
           "12 frames.*(--select) time=1 to (time=12)", f"extract v.npy out {e} \\1 \\2", "2 labels: 2 written"),
    Advice("background value", npy("v.npy", lambda: balls(TWO).astype(np.int16) - (balls(TWO) == 0)),
           f"extract v.npy out {e}", "give (--background -1)", f"extract v.npy out {e} \\1", "2 labels: 2 written"),
    Advice("background", npy("v.npy", lambda: np.where(balls(TWO[:1]) > 0, 0.0, np.nan)), f"extract v.npy out {e}",
           "or give --background", f"extract v.npy out {e} --background nan", "1 label: 1 written"),
    Advice("labels at the border", npy("v.npy", lambda: balls(TWO)[:, :, 12:22]), f"extract v.npy out {e}",
           "Give (--at-border)\\.", f"extract v.npy out {e} \\1", "2 labels: 2 written"),
    Advice("small labels", npy("v.npy", lambda: balls([(10, 12, 12, 1.8), (25, 12, 12, 1.8)])),
           "extract v.npy out", "Give a smaller (--smallest)", "extract v.npy out \\1 20",
           "2 labels: 2 written"),
    Advice("background of a TIFF", white_is_0, f"extract v.tif out {e} --at-border",
           "Otherwise give --background", f"extract v.tif other {e} --background 255", "1 label: 1 written", gone="x^"),
    Advice("voxel-size", npy("v.npy", lambda: balls(TWO)), f"extract v.npy out {e}", "Give it by --voxel-size",
           f"extract v.npy other {e} --voxel-size 0.5um", "voxels of 0.5 x 0.5 x 0.5 um, from --voxel-size"),
    Advice("long voxels", two_sizes, f"extract v.nrrd out {e}", "9 times as long.*--voxel-size X,Y,Z",
           f"extract v.nrrd other {e} --voxel-size 1,1,2", "1 x 1 x 2", gone="as long"),
    Advice("units", two_units, f"extract v.nrrd out {e}", '"mm" and in "um".*--voxel-size',
           f"extract v.nrrd out {e} --voxel-size 2um", "2 x 2 x 2 um"),
    Advice("array", two_arrays, f"extract v.npz out {e}", '"(ids)".*(--select array=)NAME', f"extract v.npz out {e} \\2\\1",
           "2 labels: 2 written"),
    Advice("wrong array", two_arrays, f"extract v.npz out {e} --select array=labels", 'It has "(ids)".*Correct (--select array=)labels',
           f"extract v.npz out {e} \\2\\1", "2 labels: 2 written"),
    Advice("one array", npy("v.npy", lambda: balls(TWO)), f"extract v.npy out {e} --select array=a", "Leave --select array=a out",
           f"extract v.npy out {e}", "2 labels: 2 written"),
    Advice("smoothing", npy("v.npy", lambda: balls([(12, 12, 12, 7)]) + 2 * balls([(30.5, 12.5, 12.5, .5)])),
           f"extract v.npy out {e}", "fewer passes by --smoothing", f"extract v.npy other {e} --smoothing 0",
           "2 labels: 2 written"),
    Advice("parts", npy("v.npy", lambda: balls(TWO, labels=(1, 1))), f"extract v.npy out {e}",
           "To make each part a grain, use (--parts), and another output folder", f"extract v.npy other {e} \\1",
           "2 labels: 2 written"),
    Advice("parts of conforming grains", npy("v.npy", lambda: balls(TWO, labels=(1, 1))),
           f"extract v.npy out -n 100 {e}", "use (--parts), and another output folder",
           f"extract v.npy other -n 100 {e} \\1", "2 labels: 2 taken"),
    Advice("parts of a batch", npy("v.npy", lambda: balls(TWO, labels=(1, 1))), "batch v.npy -o out -n 60 --describe none",
           "use (--parts), and another output folder", "batch v.npy -o other -n 60 --describe none \\1", "2 grains: 2"),
    Advice("parts for clumps", npy("v.npy", lambda: balls(TWO, labels=(1, 1))), "clump v.npy -k 2 -o out",
           "call wscvt (extract) VOLUME OUT (--parts) first, and give OUT",
           "\\1 v.npy parts \\2 && \"$WSCVT_PROGRAM\" clump parts -k 2 -o other", "2 grains, 0 failed"),
    Advice("separate", npy("v.npy", lambda: balls([(10, 12, 12, 7), (21, 12, 12, 7), (33, 12, 12, 4)], labels=(1, 1, 1))),
           f"extract v.npy out {e}", "(--separate 0.85) also separates", f"extract v.npy other {e} \\1",
           "3 labels: 3 written"),
    Advice("separate labels", npy("v.npy", lambda: balls(TWO)), f"extract v.npy out {e} --separate 0.85",
           "--separate needs a mask with one label. Leave it out", f"extract v.npy out {e}", "2 labels: 2 written"),
    Advice("grey values", npy("v.npy", lambda: grey(np.minimum(balls(TWO), 1))), "extract v.npy out",
           "label the grains by (wscvt segment)", "segment v.npy labels.nrrd", "2 grains"),
    Advice("labels of wscvt segment", npy("v.npy", lambda: grey(np.minimum(balls(TWO), 1))), "segment v.npy labels.nrrd",
           "Then: wscvt (batch labels.nrrd -o out -n) 500", "\\1 100", "2 grains"),
    Advice("bodies", two_bodies, "two.stl r.ply -n 60", "wscvt batch MESH -o OUT (--parts)",
           "batch two.stl -o out -n 100 \\1", "2 grains"),
    Advice("bodies as they are", two_bodies, "two.stl r.ply -n 60", "wscvt (extract) MESH OUT", "\\1 two.stl out",
           "2 bodies: 2 written"),
    Advice("smallest body", two_bodies, "extract two.stl out --smallest 10", "Give a %: (--smallest 0.1%)",
           "extract two.stl out \\1", "2 bodies: 2 written"),
    # Segmentation
    Advice("dark", npy("v.npy", lambda: grey(np.minimum(balls(TWO), 1), (160, 60))), "segment v.npy l.nrrd",
           "give (--dark)", "segment v.npy l.nrrd \\1", "2 grains"),
    Advice("not dark", npy("v.npy", lambda: grey(np.minimum(balls(TWO), 1))), "segment v.npy l.nrrd --dark",
           "leave --dark out", "segment v.npy l.nrrd", "2 grains"),
    Advice("phases", npy("v.npy", lambda: grey(balls([(8, 12, 12, 6), (32, 12, 12, 6), (20, 12, 12, 5)], labels=(1, 1, 2)), (60, 110, 235))),
           "segment v.npy l.nrrd", "3 peaks.*give their number, such as (--phases 1)", "segment v.npy l.nrrd \\1", "1 grain,", gone="x^"),
    Advice("too many phases", npy("v.npy", lambda: grey(np.minimum(balls(TWO), 1))), "segment v.npy l.nrrd --phases 3",
           "at most (1) can be material.*lower --phases", "segment v.npy l.nrrd --phases \\1", "2 grains"),
    Advice("phases of a mask", npy("v.npy", lambda: np.minimum(balls(TWO), 1)), "segment v.npy l.nrrd --phases 2",
           "Leave --phases out", "segment v.npy l.nrrd", "2 grains"),
    Advice("phases and threshold", npy("v.npy", lambda: grey(np.minimum(balls(TWO), 1))),
           "segment v.npy l.nrrd --phases 1 --threshold 110", "Leave one of them out", "segment v.npy l.nrrd --threshold 110",
           "2 grains"),
    Advice("smallest", npy("v.npy", lambda: grey(np.minimum(balls([(12, 12, 12, 3)]), 1))),
           "segment v.npy l.nrrd --smallest 1000", "lower --smallest", "segment v.npy l.nrrd --smallest 50", "1 grain,"),
    Advice("labels already", npy("v.npy", lambda: balls(TWO)), "segment v.npy l.nrrd", "(extract) read labels directly",
           "\\1 v.npy out", "2 labels: 2 written"),
    Advice("one peak", npy("v.npy", lambda: grey(np.minimum(balls([(12, 12, 12, 4)]), 1))), "segment v.npy l.nrrd",
           "one peak.*Give (--threshold)", "segment v.npy l.nrrd \\1 110", "1 grain,", gone="x^"),
    Advice("one grain of several", npy("v.npy", lambda: grey(np.minimum(balls([(13, 12, 12, 8), (27, 12, 12, 8)]), 1))),
           "segment v.npy l.nrrd --separate 0.3", "larger (--separate)", "segment v.npy l.nrrd \\1 0.85", "2 grains"),
    # Contacts
    Advice("mask", npy("v.npy", lambda: balls([(13, 12, 12, 8), (27, 12, 12, 8)], labels=(1, 1))), "describe v.npy -o out",
           "Then (wscvt segment) labels its grains", "segment v.npy l.nrrd", "2 grains"),
    Advice("scan without edges",
           together(npy("v.npy", lambda: balls([(5, 5, 5, 3), (9.5, 5, 5, 3)], (10, 10, 15))),
                    npy("s.npy", lambda: grey(np.minimum(balls([(5, 5, 5, 3), (9.5, 5, 5, 3)], (10, 10, 15)), 1)))),
           "describe v.npy s.npy -o out", "Leave the scan out", "describe v.npy -o out", "contact"),
    # Meshes
    Advice("repaired area", mesh("s.ply", change=without_a_cap(0.1)), "s.ply r.ply -n 100",
           "Raise (--max-repaired-area) to ([0-9.]+) %", "s.ply r.ply -n 100 \\1 \\2", "100 nodes", gone="x^"),
    Advice("shrink-wrap", mesh("s.ply", change=without_a_cap(0.02)), "s.ply r.ply -n 100 --max-repaired-area 0.5", "by (--shrink-wrap [0-9.]+)",
           "s.ply r.ply -n 100 \\1", "100 nodes", gone="x^"),
    Advice("points", points("s.xyz"), "s.xyz r.ply -n 100", "build a surface from them: (--points)", "s.xyz r.ply -n 100 \\1",
           "100 nodes"),
    Advice("handles cut", extracted("s.ply", ring), "s.ply r.ply -n 300 --max-handle-loop 0", "has 1 handle",
           "s.ply r.ply -n 300 --max-handle-loop 100", "1 handle cut"),
    Advice("nodes of a handle", extracted("s.ply", ring), "s.ply r.ply -n 4 --max-handle-loop 0", "needs at least ([0-9]+) nodes",
           "s.ply r.ply -n 100 --max-handle-loop 0", "100 nodes"),
    Advice("star-shaped", extracted("s.ply", dumbbell), "s.ply r.ply -n 300 --method as-published", "Use (--method on-scan)",
           "s.ply r.ply -n 300 \\1", "300 nodes"),
    Advice("overhang", extracted("s.ply", mushroom), "s.ply r.ply -n 300 --method as-published --max-overhang 1",
           "Or raise (--max-overhang)", "s.ply r.ply -n 300 --method as-published \\1 50", "300 nodes"),
    Advice("error of the series", mesh("s.ply"), "s.ply r.ply -n 300 --method as-published -d 3 --max-error 0.5",
           "raise --degree, or use (--method on-scan)", "s.ply r.ply \\1 --max-error 2", "nodes"),
    Advice("limit of nodes", mesh("s.ply"), "s.ply r.ply -n 40 --max-error 2", "up to 40 .*larger (--nodes)",
           "s.ply r.ply --max-error 2 \\1 2000", "nodes"),
    Advice("limit of the error", mesh("s.ply"), "s.ply r.ply -n 40 --max-error 2", "or a larger (--max-error)",
           "s.ply r.ply -n 40 \\1 30", "nodes"),
    Advice("series off the scan", mesh("s.ply"), "s.ply r.ply -n 300 --method as-published -d 2", "Raise --degree",
           "s.ply r.ply -n 300 --method as-published -d 20", "300 nodes"),
    Advice("the other method", mesh("s.ply"), "s.ply r.ply -n 60 --sampling fibonacci", "use (--method as-published)",
           "s.ply r.ply -n 60 --sampling fibonacci \\1", "nodes"),
    Advice("a value of version 2", mesh("s.ply"), "s.ply r.ply -n 60 --weighting error-adaptive", "with (--edge-ratio 1.4)",
           "s.ply r.ply -n 60 \\1", "60 nodes"),
    Advice("a closer remesh", mesh("s.ply", "elongated_rough_8000.ply"), "s.ply r.ply -n 60 --placement on-surface",
           "or (--placement fitted)", "s.ply r.ply -n 60 \\1", "60 nodes"),
    Advice("edge ratio", mesh("s.ply", "elongated_rough_8000.ply"), "s.ply r.ply -n 60", "or (--edge-ratio 1.4)",
           "s.ply r.ply -n 60 \\1", "60 nodes"),
    Advice("a folder is no scan", scans(), "scans r.ply -n 60", "wscvt (batch)", "batch scans -o out -n 60", "2 grains"),
    Advice("a volume is no scan", npy("v.npy", lambda: balls(TWO)), "v.npy r.ply -n 60", "wscvt batch",
           "batch v.npy -o out -n 60", "2 grains"),
    # Batches and samples
    Advice("output", scans(), "batch scans -o scans -n 60", "another folder with (--output)", "batch scans \\1 out -n 60",
           "2 grains"),
    Advice("format", scans(), "batch scans -o scans -n 60", "or another (--format)", "batch scans -o scans -n 60 \\1 stl",
           "2 grains"),
    Advice("format of meshes", scans(), "batch scans -o out -n 60 --format xyz", "Give --format one of .*(stl)",
           "batch scans -o out -n 60 --format \\1", "2 grains"),
    Advice("begun", after("batch scans -o out -n 60", scans()), "batch scans -o out -n 80", "another folder with (--output)",
           "batch scans \\1 other -n 80", "2 grains"),
    Advice("error of several numbers", scans(), "batch scans -o out -n 60,80 --max-error 2", "--max-error needs a single number",
           "batch scans -o out -n 60,80", "2 grains"),
    Advice("sample of meshes", scans(), "sample scans", "(wscvt) (batch scans -o) FOLDER", "\\2 out -n 60", "2 grains"),
    Advice("sample without shapes", together(scans(), lambda folder: (folder / "out").mkdir()), "sample out",
           "that (wscvt) (batch) wrote without --describe none", "\\2 scans -o other -n 60", "2 grains"),
    Advice("parts of a sample", together(scans(), *[lambda folder, k=k: run(folder, "batch scans -o out -n 60 --shard %d/2" % k)
                                                    for k in (1, 2)]),
           "sample out", "The call of its parts, without (--shard), joins", "batch scans -o out -n 60", "2 grains"),
    Advice("size", text("t.csv", "grain,volume\na,1\nb,2\nc,3\n"), "sample t.csv --diameter feret-min", "Use (--diameter [a-z-]+)",
           "sample t.csv \\1", "grains"),
    Advice("descriptors", text("t.csv", "grain,file,volume,convexity,sphericity_wadell\na,a.ply,1,.9,.7\nb,b.ply,2,.9,.8\n"),
           "grow t.csv --templates=convexity -k 1 -o out", "others with (--templates=)NAMES",
           "grow t.csv -k 1 -n 60 -o out \\1sphericity_wadell", "", gone="x^", code=None),
    Advice("sizes of templates", together(scans(), text("s.csv", "1,0\n2,100\n")),
           "grow scans --templates -k 1 -n 60 -o out --size-curve s.csv", "Leave out --size-curve",
           "grow scans --templates -k 1 -n 60 -o out", "1 templates"),
    Advice("report", mesh("s.ply"), "describe s.ply -o out", "Give (--report)", "describe s.ply \\1 out.html", "sphericity"),
    # Clumps and parts
    Advice("spheres", mesh("s.ply"), "clump s.ply --max-error 0.1 -k 5 -o c.csv", "more spheres",
           "clump s.ply --max-error 3 -k 100 -o c.csv", "", ),
    Advice("inside", mesh("s.ply"), "clump s.ply -k 20 --inside --smallest-radius 90 -o c.csv",
           "smaller (--smallest-radius), or leave out --inside", "clump s.ply -k 20 --inside \\1 5 -o c.csv", ""),
    Advice("not inside", mesh("s.ply"), "clump s.ply -k 20 --inside --smallest-radius 90 -o c.csv", "leave out --inside",
           "clump s.ply -k 20 --smallest-radius 90 -o c.csv", "", gone="leave out"),
    Advice("inertia", ellipsoid("s.ply", (1.0, 0.8, 0.6)), "convex s.ply -k 1 -o g.xml --size 0.0005 --density 2650",
           "multiply --size or --scale by ([0-9]+), set (--density [0-9.e+-]+)", "convex s.ply -k 1 -o g.xml --size 0.5 \\2", ""),
    # Measures
    Advice("steps of voxels", together(npy("v.npy", lambda: balls(TWO[1:])), extracted("s.ply", lambda: balls(TWO[1:]), 0)),
           "describe s.ply", "steps of voxels.*(wscvt) (extract)", "\\2 v.npy out", "1 label: 1 written"),
    Advice("larger cut-off", ellipsoid("s.ply", (1.0, 0.9, 0.8), 200), "describe s.ply -v", "larger (--roughness-cutoff)",
           "describe s.ply -v \\1 2", "roughness Sq", gone="too long to measure roughness"),
    Advice("smaller cut-off", ellipsoid("s.ply", (1.0, 0.5, 0.4), 20000), "describe s.ply -v", "smaller (--roughness-cutoff)",
           "describe s.ply -v \\1 0.1", "roughness Sq"),
    Advice("grid", ellipsoid("s.ply", (1.0, 0.9, 0.8)), "s.ply r.ply -n 60 --sdf g.npy --sdf-spacing 0.0001",
           "Give ([0-9.]+) or more, or 0", "s.ply r.ply -n 60 --sdf g.npy --sdf-spacing 0", "60 nodes"),
]


@pytest.mark.parametrize("advice", ALL, ids=lambda advice: advice.name.replace(" ", "-"))
def test_advice_works_when_it_is_followed(advice, tmp_path):
    advice.inputs(tmp_path)
    said = run(tmp_path, advice.command).said
    found = re.search(advice.advice, said)
    assert found, said
    done = run(tmp_path, found.expand(advice.followed))
    assert advice.code is None or done.returncode == advice.code, done.said
    assert re.search(advice.then, done.said), done.said
    assert not re.search(advice.gone or advice.advice, done.said), done.said


def test_each_option_that_a_message_names_is_followed():
    # threads: a lack of memory; degree of a sample: grains with walls as thin as the waves of their series.
    not_here = {"threads", "degree"}
    named = set()
    for source in LIBRARY.rglob("*.cpp"):
        named |= set(re.findall(r'mention\("([a-z-]+)"', source.read_text()))
    followed = " ".join(advice.advice + " " + advice.followed for advice in ALL)
    assert len(named) > 20
    assert sorted(name for name in named - not_here if "--" + name not in followed) == []


def test_python_says_the_same_in_its_own_words():
    labels = balls(TWO).astype(int) - (balls(TWO) == 0)
    with pytest.raises(wscvt.InputError, match="give background=-1"):
        wscvt.extract(labels)
    assert list(wscvt.extract(labels, background=-1)) == [1, 2]
    with pytest.raises(wscvt.InputError, match="or give background"):
        wscvt.extract(np.where(balls(TWO[:1]) > 0, 0.0, np.nan))
    assert list(wscvt.extract(np.where(balls(TWO[:1]) > 0, 0.0, np.nan), background=np.nan)) == [0]
    with pytest.raises(wscvt.Error, match="points=True"):
        wscvt.remesh(wscvt.read_mesh(MESHES / "sand_5658.ply")[0], None, nodes=60)
    assert len(wscvt.remesh(wscvt.read_mesh(MESHES / "sand_5658.ply")[0], None, nodes=60, points=True).vertices) == 60


def test_taubins_filter_smooths_steps_as_the_advice_says():
    (vertices, faces), = wscvt.extract(balls([(20, 20, 20, 12)], (40, 40, 40)), smoothing=0).values()
    report = wscvt.describe(vertices, faces)
    assert "Taubin" in " ".join(report["warnings"])
    ends = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    for step in (0.5, -0.53) * 10:  # MeshLab's defaults
        sums, counts = np.zeros_like(vertices), np.zeros(len(vertices))
        np.add.at(sums, ends[:, 0], vertices[ends[:, 1]])
        np.add.at(counts, ends[:, 0], 1)
        vertices = vertices + step * (sums / counts[:, None] - vertices)
    smoothed = wscvt.describe(vertices, faces)
    assert "Taubin" not in " ".join(smoothed["warnings"])
    sphericity = [one["descriptors"]["sphericity_wadell"] for one in (report, smoothed)]
    assert sphericity[0] < 0.7 and sphericity[1] > 0.97
