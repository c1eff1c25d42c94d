#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""fabric_table.py WSCVT FOLDER: makes packings of known contacts in FOLDER, measures them by WSCVT, and prints
the table of fabric.md. The labels stay in FOLDER, such as dented_30.nrrd. 70 balls that overlap, whose contacts are discs, and 70 dented grains (balls with bumps
and dents of up to 30 %), 15, 30 and 60 voxels across. Exact: each voxel has the label of the grain at its
middle. Scan: grey values of the same grains, blurred, with noise of 5 %, labelled by wscvt segment. Of the
contacts count those with a radius above .12 of the grains'. SPAM's way: the normal is the least axis of the
centres of the faces between two labels, and each pair that touches is a contact."""
import csv
import gzip
import os
import subprocess
import sys

import numpy

COUNT, LEAST, VOID, GRAIN = 70, 0.12, 60, 180


def packing(seed, apart):
    """Centres and radii of balls that were pushed apart until few overlap by more than 1 - apart."""
    random = numpy.random.default_rng(seed)
    r = random.uniform(0.8, 1.2, COUNT)
    r *= (0.62 / (4 / 3 * numpy.pi * (r ** 3).sum())) ** (1 / 3)
    x = random.uniform(0, 1, (COUNT, 3))
    for _ in range(3000):
        d = x[:, None] - x[None]
        distance = numpy.linalg.norm(d, axis=2) + 9 * numpy.eye(COUNT)
        overlap = numpy.maximum(0, (r[:, None] + r[None]) * apart - distance)
        x += 0.3 * (d / distance[..., None] * overlap[..., None]).sum(1)
        x += 0.3 * (numpy.maximum(0, r[:, None] * 0.2 - x) - numpy.maximum(0, x - (1 - r[:, None] * 0.2)))
    return x, r


class Balls:
    name = "balls"

    def __init__(self):
        self.x, self.r = packing(3, 0.97)
        self.reach = self.r

    def value(self, k, d):
        """Below 0 inside. Where two are below 0 the smaller one has the point."""
        return (d * d).sum(-1) - self.r[k] ** 2

    def near(self):
        return 0.15 * self.r.mean() ** 2


class Dented:
    name = "dented"

    def __init__(self):
        self.x, self.r = packing(5, 0.99)
        self.reach = 1.6 * self.r
        random = numpy.random.default_rng(6)
        self.places = random.normal(size=(COUNT, 7, 3))
        self.places /= numpy.linalg.norm(self.places, axis=2)[..., None]
        self.heights = random.uniform(-0.3, 0.3, (COUNT, 7))

    def value(self, k, d):
        length = numpy.sqrt((d * d).sum(-1)) + 1e-12
        u = d / length[..., None]
        radius = numpy.ones(length.shape)
        for place, height in zip(self.places[k], self.heights[k]):
            radius += height * numpy.exp(-(1 - u @ place) / 0.12)
        return length - self.r[k] * radius

    def near(self):
        return 0.15 * self.r.mean()


def points(low, high, h):
    return numpy.stack(numpy.meshgrid(*[numpy.arange(a, b + h, h) for a, b in zip(low, high)], indexing="ij"), -1)


def labels_of(grains, h, shift, multiple):
    """Labels of voxels of the size h, and the middle of the first."""
    reach = grains.reach[:, None]
    low, high = (grains.x - reach).min(0) - 4 * h, (grains.x + reach).max(0) + 4 * h
    n = numpy.ceil((high - low) / h / multiple).astype(int) * multiple
    origin = low + shift * h
    best, labels = numpy.zeros(n, numpy.float32), numpy.zeros(n, numpy.uint16)
    for k in range(COUNT):
        a = numpy.maximum(numpy.floor((grains.x[k] - grains.reach[k] - origin) / h).astype(int) - 1, 0)
        b = numpy.minimum(numpy.ceil((grains.x[k] + grains.reach[k] - origin) / h).astype(int) + 2, n)
        axes = [origin[d] + h * numpy.arange(a[d], b[d]) - grains.x[k, d] for d in range(3)]
        value = grains.value(k, numpy.stack(numpy.meshgrid(*axes, indexing="ij"), -1)).astype(numpy.float32)
        box = tuple(slice(a[d], b[d]) for d in range(3))
        inside = value < best[box]
        best[box][inside] = value[inside]
        labels[box][inside] = k + 1
    return labels, origin


def contacts_of(grains):
    """Area and normal of each contact, by a sum over fine points near the border of both."""
    found = {}
    fine = grains.r.mean() / 50
    for i in range(COUNT):
        for j in range(i + 1, COUNT):
            low = numpy.maximum(grains.x[i] - grains.reach[i], grains.x[j] - grains.reach[j])
            high = numpy.minimum(grains.x[i] + grains.reach[i], grains.x[j] + grains.reach[j])
            if (high <= low).any():
                continue
            p = points(low, high, 3 * fine)
            near = numpy.maximum(grains.value(i, p - grains.x[i]), grains.value(j, p - grains.x[j])) < grains.near()
            if not near.any():
                continue
            p = points(p[near].min(0) - 3 * fine, p[near].max(0) + 3 * fine, fine)
            u, v = grains.value(i, p - grains.x[i]), grains.value(j, p - grains.x[j])
            gradient = numpy.stack(numpy.gradient(u - v, fine), -1)
            slope = numpy.linalg.norm(gradient, axis=-1)
            width = 1.5 * fine * slope
            layer = numpy.where(abs(u - v) < width, (1 + numpy.cos(numpy.pi * (u - v) / width)) / (2 * width), 0)
            layer *= (u + v < 0) * fine ** 3
            area = (layer * slope).sum()
            if area > 0 and numpy.maximum(u, v).min() < 0:
                normal = (layer[..., None] * gradient).sum((0, 1, 2))
                found[i, j] = area, normal / numpy.linalg.norm(normal)
    return found


def blurred(values, deviation):
    reach = int(4 * deviation + 1)
    weights = numpy.exp(-numpy.arange(-reach, reach + 1) ** 2 / (2 * deviation ** 2))
    for axis in range(3):
        padded = numpy.pad(numpy.moveaxis(values, axis, 0), ((reach, reach), (0, 0), (0, 0)), "edge")
        count = values.shape[axis]
        values = numpy.moveaxis(sum(w * padded[k:k + count] for k, w in enumerate(weights / weights.sum())), 0, axis)
    return values


def write(path, values):
    kind = {1: "uchar", 2: "ushort"}[values.dtype.itemsize]
    with open(path, "wb") as file:
        file.write(("NRRD0004\ntype: %s\ndimension: 3\nencoding: raw\nendian: little\nsizes: %d %d %d\n"
                    "spacings: 1 1 1\n\n" % (kind, *values.shape)).encode())
        file.write(values.transpose(2, 1, 0).tobytes())


def read(path):
    with open(path, "rb") as file:
        head, voxels = file.read().split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in head.decode().split("\n") if ": " in line)
    if fields["encoding"].startswith("gz"):
        voxels = gzip.decompress(voxels)
    kind = {"uint8": 1, "uchar": 1, "unsigned char": 1, "uint16": 2, "ushort": 2, "unsigned short": 2}
    sizes = [int(n) for n in fields["sizes"].split()]
    return numpy.frombuffer(voxels, "<u%d" % kind.get(fields["type"], 4)).reshape(sizes[::-1]).transpose(2, 1, 0)


def least_axes(labels):
    """For each pair of labels the least axis of the centres of the faces between them."""
    centres = {}
    for axis in range(3):
        moved = numpy.moveaxis(labels, axis, 0)
        a, b = moved[:-1], moved[1:]
        faces = (a != b) & (a > 0) & (b > 0)
        place = numpy.argwhere(faces).astype(float)
        place[:, 0] += 0.5
        order = [axis] + [k for k in range(3) if k != axis]
        for p, x, y in zip(place[:, numpy.argsort(order)], a[faces], b[faces]):
            centres.setdefault((min(x, y), max(x, y)), []).append(p)
    axes = {}
    for pair, p in centres.items():
        axes[pair] = numpy.linalg.svd(numpy.array(p) - numpy.mean(p, axis=0))[2][2]
    return axes


def degrees(a, b):
    return numpy.degrees(numpy.arccos(min(1.0, abs(float(a @ b)))))


def row(program, folder, grains, truth, across, blur):
    h = 2 * grains.r.mean() / across
    kind = "" if blur is None else "_blurred_%s" % blur
    path = os.path.join(folder, "%s_%d%s.nrrd" % (grains.name, across, kind))
    call = [program, "describe", path, "-o", os.path.join(folder, "out"), "-q"]
    if blur is None:
        labels, _ = labels_of(grains, h, numpy.random.default_rng(across).uniform(-0.5, 0.5, 3), 1)
        write(path, labels)
        of_grain = numpy.arange(1, COUNT + 1)
    else:
        parts = 3 if across < 60 else 2
        labels, origin = labels_of(grains, h / parts, numpy.zeros(3), parts)
        n = numpy.array(labels.shape) // parts
        grey = (labels > 0).astype(numpy.float32).reshape(n[0], parts, n[1], parts, n[2], parts).mean((1, 3, 5))
        grey = blurred(grey, blur) + numpy.random.default_rng(1).normal(0, 0.05, n)
        scan = os.path.join(folder, "scan.nrrd")
        write(scan, numpy.clip(VOID + (GRAIN - VOID) * grey, 0, 255).round().astype(numpy.uint8))
        subprocess.run([program, "segment", scan, path, "-q"], check=True)
        labels = read(path)
        place = numpy.round((grains.x - origin - (parts - 1) / 2 * h / parts) / h).astype(int)
        of_grain = labels[tuple(place.T)].astype(int)
        call.append(scan)
    subprocess.run(call, check=True)
    with open(os.path.join(folder, "out", "contacts.csv"), newline="") as file:
        found = {(int(r["first"]), int(r["second"])): r for r in csv.DictReader(file)}
    true = {}
    for (i, j), (area, normal) in truth.items():
        a, b = of_grain[i], of_grain[j]
        is_large = area > numpy.pi * (LEAST * (grains.r[i] + grains.r[j]) / 2) ** 2
        true[min(a, b), max(a, b)] = area / h ** 2, normal, is_large
    axes = least_axes(labels)
    areas, sums, ours, theirs, within = [], numpy.zeros(3), [], [], []
    for pair, (area, normal, is_large) in true.items():
        if pair not in found:
            continue
        r = {k: float(v) for k, v in found[pair].items() if k != "unit"}
        within.append(abs(r["area"] - area) <= 2 * r["area_uncertainty"])
        sums += area, max(0.0, r["area"]), r["raw_area"]
        if is_large:
            areas.append(r["area"] / area)
            ours.append(degrees(normal, numpy.array([r["normal_x"], r["normal_y"], r["normal_z"]])))
            theirs.append(degrees(normal, axes[pair]))
    contacts = [pair for pair in found if found[pair]["contact"] == "1"]
    print("| %s | %d | %s | %d | %d / %d | %d / %d | %.2f | %.3f | %.2f, %.2f to %.2f | %.2f | %.2f | %.0f %% |" % (
        grains.name, across, "exact" if blur is None else "scan, %g" % blur, len(true),
        len(set(contacts) - set(true)), len(set(found) - set(true)), len(set(true) - set(contacts)),
        len(set(true) - set(found)), sums[2] / sums[0], sums[1] / sums[0],
        *numpy.percentile(areas, [50, 10, 90]), numpy.median(ours), numpy.median(theirs),
        100 * numpy.mean(within)), flush=True)


def main():
    program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    print("| grains | across | labels | contacts | false: ours / touching | missed: ours / touching | raw sum | sum |"
          " single areas | normal | SPAM's way | within 2 u |\n|" + 12 * "---|")
    for grains in (Balls(), Dented()):
        truth = contacts_of(grains)
        for across, blur in ((15, None), (30, None), (60, None), (15, 0.8), (30, 0.8), (60, 0.8), (30, 0.5), (30, 1.3)):
            row(program, folder, grains, truth, across, blur)


if __name__ == "__main__":
    main()
