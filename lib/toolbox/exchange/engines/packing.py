# SPDX-License-Identifier: GPL-3.0-or-later
"""What run.py of this folder uses: the grains of scene.json, where they fall from, and what is said and drawn
of the packing. wscvt wrote it. Change scene.json, or run.py for the engine's own settings.

scene.json, lengths and masses in the units of the grains' files:
  grains                 number of grains in the packing
  seed                   of their order and turns
  container              shape: "box" or "cylinder"; width: of the square, or the diameter; 0: chosen
  gravity                downwards
  size, scale            as wscvt was called
  material               density; young_modulus (0: chosen so that the lowest grains give way little),
                         poisson_ratio, friction, restitution
shapes.json has the grains and a file each; wscvt writes it again when it adds grains.
sizes.csv, if there, has equivalent diameters and the percentage finer by mass. Without it each grain has
its shape's own size. templates.csv, if there, has the shapes' weights by number. Without it all are equal.
"""
import collections
import csv
import json
import math
import os
import pathlib
import random
import resource
import shutil
import subprocess
import sys

try:
    import numpy as np
except ImportError:
    sys.exit("This Python has no NumPy. Install it, or start run.py by the Python that has it: /usr/bin/python3 in Debian, "
             "with the package python3-numpy.")

FOLDER = pathlib.Path(__file__).resolve().parent


def leave(sentence, code=2):
    """Ends the script, in Yade as well, which keeps sys.exit from its caller."""
    print(sentence, file=sys.stderr if code else sys.stdout)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


class Shape:
    """A grain's body about its centroid in its principal axes, with volume, moments of unit density and
    radius about the origin. `spheres` has rows x, y, z, r; or `parts` has (vertices, faces), or the whole mesh of a
    level set. `rounding` is the radius of the sphere that rounds parts; they reach to the planes of the rounded faces."""

    def __init__(self, path, row, scene):
        values = {key.rpartition("mass_properties.")[2].rpartition("grain.")[2]: value for key, value in row.items()}
        volume = float(values["volume"])
        scale = scene["size"] / (6 * volume / math.pi) ** (1 / 3) if scene["size"] > 0 else scene["scale"]
        self.name, self.file = path.stem, path.name
        self.volume = volume * scale ** 3
        self.moments = scale ** 5 * np.array([float(values["principal_moments." + k])
                                              for k in ("least", "middle", "greatest")])
        self.diameter = (6 * self.volume / math.pi) ** (1 / 3)
        self.spheres, self.parts, self.rounding = None, None, 0.0
        if path.suffix == ".csv":
            self.spheres = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
            self.radius = (np.linalg.norm(self.spheres[:, :3], axis=1) + self.spheres[:, 3]).max()
        else:
            if path.suffix == ".shp":
                self.parts, self.rounding = read_rounded_parts(path)
            else:
                self.parts = read_parts(path)
            self.radius = max(np.linalg.norm(v, axis=1).max() for v, _ in self.parts)


class Grain:
    """A grain of the packing: a shape, `scale` times as large, at `place` with `turn` (w, x, y, z)."""

    def __init__(self, shape, scale, density):
        self.shape, self.scale = shape, scale
        self.mass = density * shape.volume * scale ** 3
        self.moments = density * shape.moments * scale ** 5
        self.diameter, self.radius = shape.diameter * scale, shape.radius * scale
        self.place, self.turn = np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])

    def spheres(self):
        rows = self.scale * self.shape.spheres
        rows[:, :3] = rows[:, :3] @ rotation(self.turn).T + self.place
        return rows

    def parts(self):
        return [(self.scale * v @ rotation(self.turn).T + self.place, f) for v, f in self.shape.parts]


class Scene:
    """The scene of this folder: `grains` in their places above the ground, `shape` and `width` of the
    container about the z axis, `top` of the column, `gravity`, and `material`."""

    def __init__(self):
        scene = json.loads((FOLDER / "scene.json").read_text())
        self.material, self.gravity = scene["material"], scene["gravity"]
        count = int(sys.argv[1]) if len(sys.argv) > 1 else scene["grains"]
        chance = random.Random(scene["seed"])
        shapes = read_shapes(scene)
        weights = read_weights(shapes)
        chosen = [shapes[k] for k in np.searchsorted(np.cumsum(weights), quantiles(count))]
        chance.shuffle(chosen)
        if (FOLDER / "sizes.csv").exists():
            sizes = [diameter(q, read_curve(FOLDER / "sizes.csv")) for q in quantiles(count)]
            chance.shuffle(sizes)
        else:
            sizes = [shape.diameter for shape in chosen]
        density = self.material["density"]
        self.grains = [Grain(shape, size / shape.diameter, density) for shape, size in zip(chosen, sizes)]
        for grain in self.grains:
            turn = np.array([chance.gauss(0, 1) for _ in range(4)])
            grain.turn = turn / np.linalg.norm(turn)
        self.mean_diameter = float(np.mean(sizes))
        solid = sum(grain.mass for grain in self.grains) / density
        self.shape, self.width = scene["container"]["shape"], scene["container"]["width"]
        if self.shape not in ("box", "cylinder"):
            leave("scene.json: the container is a \"box\" or a \"cylinder\".")
        largest = 2 * max(grain.radius for grain in self.grains)
        if self.width <= 0:  # as wide as a packing with a porosity of .45 is high
            self.width = max((solid / 0.55) ** (1 / 3), 2.5 * largest)
        if self.width < 1.5 * largest:
            leave("scene.json: the container is too narrow for the largest grain.")
        if self.material["young_modulus"] <= 0:
            height = solid / 0.55 / self.area()
            self.material["young_modulus"] = 3000 * density * self.gravity * max(height, self.mean_diameter)
        self.top = self.put_above_each_other()

    def write_clumps(self, path, length=1.0):
        """Writes the scene for a program that packs clumps: sides of the container and half its width, longest
        time, time of the fall, energy at rest, gravity, and the material; of each grain mass, moments, place, turn,
        and the number of its spheres, with x, y, z, r of each. Lengths are `length` times as large, with the same
        density and gravity: times are length^.5 times as long, energies length^4 times as large."""
        pace, material = math.sqrt(length), self.material
        with open(path, "w") as file:
            print(4 if self.shape == "box" else 32, length * self.width / 2, pace * self.longest_time(),
                  pace * self.fall_time(), length ** 4 * self.energy_at_rest(), self.gravity, material["density"],
                  length * material["young_modulus"], material["poisson_ratio"], material["friction"],
                  material["restitution"], file=file)
            for grain in self.grains:
                print(length ** 3 * grain.mass, *(length ** 5 * grain.moments), *(length * grain.place), *grain.turn,
                      len(grain.shape.spheres), *(length * grain.scale * grain.shape.spheres).ravel(), file=file)

    def area(self):
        return self.width ** 2 * (1 if self.shape == "box" else math.pi / 4)

    def put_above_each_other(self):
        """Puts grains row by row and layer by layer, so that none touches another. Returns the height."""
        gap, half = 0.05 * self.mean_diameter, self.width / 2
        x, y, z, row, layer, used = -half, -half, 0.0, 0.0, 0.0, False
        for grain in self.grains:
            step = 2 * grain.radius + gap
            while True:
                if x + step > half:
                    x, y, row = -half, y + row, 0.0
                if y + step > half and not used:  # no square of a row is within the cylinder
                    x, y, middle = half, half, (0.0, 0.0)
                    break
                if y + step > half:
                    x, y, z, row, layer, used = -half, -half, z + layer, 0.0, 0.0, False
                row, layer = max(row, step), max(layer, step)
                middle = (x + step / 2, y + step / 2)
                x += step
                if self.shape == "box" or math.hypot(*middle) + step / 2 <= half:
                    break
            used = True
            grain.place = np.array([*middle, z + step / 2])
        return z + layer

    def longest_time(self):
        """The time in which the column has fallen and the packing has come to rest."""
        return 2 * math.sqrt(2 * self.top / self.gravity) + 60 * math.sqrt(self.mean_diameter / self.gravity)

    def fall_time(self):
        return 1.2 * math.sqrt(2 * self.top / self.gravity)

    def energy_at_rest(self):
        """A kinetic energy below which the packing is at rest: 1e-5 of that of a fall by a grain."""
        return 1e-5 * self.gravity * sum(grain.mass * grain.diameter for grain in self.grains)


def rotation(turn):
    w, x, y, z = turn
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def quantiles(count):
    return (np.arange(count) + 0.5) / count


def read_parts(path):
    """Vertices and triangles of each group of an OBJ file, or of the whole, with numbers from 0 in the group."""
    parts, before = [([], [])], 0
    for line in open(path):
        words = line.split()
        if not words:
            continue
        if words[0] == "g" and parts[-1][0]:
            before += len(parts[-1][0])
            parts.append(([], []))
        elif words[0] == "v":
            parts[-1][0].append([float(w) for w in words[1:4]])
        elif words[0] == "f":
            parts[-1][1].append([int(w) - 1 - before for w in words[1:4]])
    return [(np.array(vertices), np.array(faces)) for vertices, faces in parts]


def read_rounded_parts(path):
    """Vertices and triangles of the convex parts of a Rockable shape, out to the planes of the rounded faces,
    and the radius of the sphere."""
    words = path.read_text().split()

    def rows(word, width):
        first = words.index(word) + 2
        return np.array(words[first:first + width * int(words[first - 1])], float).reshape(-1, width)

    vertices, faces = rows("nv", 3), rows("nf", 4)[:, 1:].astype(int)
    radius, part = float(words[words.index("radius") + 1]), np.arange(len(vertices))
    while (part[faces] != part[faces[:, :1]]).any():  # each part by its first vertex
        np.minimum.at(part, faces, part[faces].min(1)[:, None])
    parts = []
    for k in np.unique(part):
        own = np.flatnonzero(part == k)
        f = np.searchsorted(own, faces[part[faces[:, 0]] == k])
        a, b, c = (vertices[own][f[:, j]] for j in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        around = [normals[(f == v).any(1)] for v in range(len(own))]
        moves = [np.linalg.lstsq(n, np.ones(len(n)), rcond=1e-3)[0] for n in around]
        parts.append((vertices[own] + radius * np.array(moves), f))
    return parts, radius


def read_shapes(scene):
    table = FOLDER / "mass.csv"
    if table.exists():  # in the unit of the files
        scene = {"size": 0.0, "scale": 1.0}
    else:
        table = FOLDER / "grains.csv"
    rows = {row["grain"]: row for row in csv.DictReader(open(table, newline=""))}
    files = json.loads((FOLDER / "shapes.json").read_text())
    shapes = [Shape(FOLDER / one["file"], rows[one["grain"]], scene) for one in files
              if rows.get(one["grain"], {}).get("status") == "done"]
    return shapes or leave("grains.csv has no grain that is done.")


def read_weights(shapes):
    weights = np.ones(len(shapes))
    if (FOLDER / "templates.csv").exists():
        rows = csv.DictReader(open(FOLDER / "templates.csv", newline=""))
        given = {pathlib.Path(row["file"]).stem: float(row["weight_by_number"]) for row in rows}
        weights = np.array([given[shape.name] for shape in shapes])
    return weights / weights.sum()


def read_curve(path):
    """Diameters and fractions finer by mass."""
    rows = [row for row in csv.reader(open(path, newline="")) if row]
    try:
        float(rows[0][0])
    except ValueError:
        rows = rows[1:]
    return [(float(a), float(b) / 100) for a, b, *_ in rows]


def diameter(fraction, curve):
    """The diameter below which a fraction of the grains lies, by number. The mass is even over the logarithm
    of the diameter between two points of the curve."""
    parts = [(a, b, (q - p) / math.log(b / a) * (a ** -3 - b ** -3)) for (a, p), (b, q) in zip(curve, curve[1:])]
    left = fraction * sum(number for _, _, number in parts)
    for a, b, number in parts:
        if left <= number and number > 0:
            return (a ** -3 - left / number * (a ** -3 - b ** -3)) ** (-1 / 3)
        left -= number
    return curve[-1][0]


def processor_time():
    """Of the programs that were started here and have ended, in seconds."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def program(name):
    """The path of a program; or the end, if it is not installed."""
    return shutil.which(name) or leave("\"%s\" is not installed, or not in a folder of PATH." % name)


def run(name, *words):
    """Runs a program; what it prints is in packing.out, but for its errors."""
    try:
        with open("packing.out", "w") as output:
            subprocess.run([program(name), *words], check=True, stdout=output)
    except subprocess.CalledProcessError:
        leave("\"%s\" failed; the lines above or packing.out say why." % name)


def outcome(name, *words):
    """Runs a program that prints lines of a word and numbers. Returns the rows of each word, and the processor
    time that it took."""
    before, rows = processor_time(), collections.defaultdict(list)
    run(name, *words)
    for line in open("packing.out"):
        word, *numbers = line.split() or [""]
        if word in ("energy", "grain", "sphere", "contact"):
            rows[word].append([float(v) for v in numbers])
    return rows, processor_time() - before


def touching(bodies):
    """Pairs of grains, given as spheres, that touch."""
    middles = [rows[:, :3].mean(0) for rows in bodies]
    reach = [(np.linalg.norm(rows[:, :3] - m, axis=1) + rows[:, 3]).max() for rows, m in zip(bodies, middles)]
    pairs = []
    for i in range(len(bodies)):
        for k in range(i):
            if np.linalg.norm(middles[i] - middles[k]) < reach[i] + reach[k]:
                apart = np.linalg.norm(bodies[i][:, None, :3] - bodies[k][None, :, :3], axis=2)
                if (apart < bodies[i][:, None, 3] + bodies[k][None, :, 3]).any():
                    pairs.append((i, k))
    return pairs


def is_inside(body, points):
    """Whether points lie in a body of spheres or of closed meshes, by the solid angle of each mesh (Van Oosterom and
    Strackee 1983)."""
    inside = np.zeros(len(points), bool)
    if isinstance(body, np.ndarray):
        for *c, r in body:
            inside |= ((points - c) ** 2).sum(1) < r * r
        return inside
    for vertices, faces in body:
        angle = np.zeros(len(points))
        for corners in vertices[faces]:
            a, b, c = (corner - points for corner in corners)
            la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
            ab, bc, ca = ((v * w).sum(1) for v, w in ((a, b), (b, c), (c, a)))
            angle += 2 * np.arctan2((a * np.cross(b, c)).sum(1), la * lb * lc + ab * lc + bc * la + ca * lb)
        inside |= np.abs(angle) > 2 * math.pi
    return inside


def porosity(scene, bodies, heights):
    """Fraction of pores in the lower half of the packing, the walls' gaps included: below the mean height of
    the mass, at 20,000 random places."""
    masses = [grain.mass for grain in scene.grains]
    high = float(np.average(heights, weights=masses))
    points = np.random.RandomState(1).uniform(-0.5, 0.5, (20000, 3)) * [scene.width, scene.width, high]
    points[:, 2] += high / 2
    if scene.shape == "cylinder":
        points = points[np.hypot(points[:, 0], points[:, 1]) < scene.width / 2]
    solid = np.zeros(len(points), bool)
    for body in bodies:
        corners = body[:, :3] if isinstance(body, np.ndarray) else np.concatenate([v for v, _ in body])
        more = body[:, 3].max() if isinstance(body, np.ndarray) else 0.0
        near = ((points > corners.min(0) - more) & (points < corners.max(0) + more)).all(1) & ~solid
        if near.any():
            solid[near] |= is_inside(body, points[near])
    return 1 - solid.mean()


def finish(engine, scene, bodies, places, kinetic, seconds, contacts=None):
    """Prints what the packing is, writes packing.csv and packing.png, and ends the script. `bodies` are
    arrays of spheres x, y, z, r or lists of (vertices, faces), `places` the centroids, `kinetic` pairs
    (time, kinetic energy), and `seconds` the time of the engine."""
    places = np.asarray(places)
    contacts = touching(bodies) if contacts is None else contacts
    weight = scene.gravity * np.array([grain.mass for grain in scene.grains])
    energy = float(weight @ places[:, 2])
    count = len(scene.grains)
    at_rest = kinetic[-1][1] < scene.energy_at_rest()
    with open("packing.csv", "w") as table:
        rows = csv.writer(table, lineterminator="\n")
        rows.writerow(["grain", "equivalent_diameter", "x", "y", "z"])
        for grain, place in zip(scene.grains, places):
            rows.writerow([grain.shape.name, *("%.9g" % v for v in (grain.diameter, *place))])
    print("%s: %d grains %s after %.3g s: porosity %.3f, coordination %.2f, height %.3g, potential energy %.4g, "
          "kinetic energy %.2g, %.3g s of processor" %
          (engine, count, "at rest" if at_rest else "still moving", kinetic[-1][0], porosity(scene, bodies, places[:, 2]),
           2 * len(set(map(tuple, map(sorted, contacts)))) / count, 2 * energy / weight.sum(), energy,
           kinetic[-1][1], seconds))
    try:
        draw("packing.png", scene, bodies, kinetic)
    except ImportError:
        print("No picture: matplotlib is not installed.")
    leave("", 0)


def draw(path, scene, bodies, kinetic):
    """A picture of the packing, and its kinetic energy over time."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    size = 640
    ahead = np.array([0.45, 0.8, -0.4])
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, [0, 0, 1])
    right /= np.linalg.norm(right)
    view = np.stack([right, np.cross(right, ahead), ahead])
    reach = max(0.85 * scene.width, 0.6 * max(
        float((b[:, 2] + b[:, 3]).max() if isinstance(b, np.ndarray) else max(v[:, 2].max() for v, _ in b))
        for b in bodies))
    middle = np.array([0, 0, 0.75 * reach])
    depth, image = np.full((size, size), np.inf), np.ones((size, size, 3))
    light = np.array([-0.4, 0.7, -0.6])

    def fill(rows, columns, near, far_z, normals, colour):
        window = depth[rows, columns]
        nearer = near & (far_z < window)
        window[nearer] = far_z[nearer]
        shade = 0.35 + 0.65 * np.clip(normals @ light, 0, 1)
        image[rows, columns][nearer] = (np.ones(near.shape + (1,)) * shade[..., None] * colour)[nearer]

    def window_of(low, high):
        a = np.clip(np.floor(low), 0, size).astype(int)
        b = np.clip(np.ceil(high) + 1, 0, size).astype(int)
        x, y = np.meshgrid(np.arange(a[0], b[0]) + 0.5, np.arange(a[1], b[1]) + 0.5)
        return slice(a[1], b[1]), slice(a[0], b[0]), x, y

    def on_screen(points):
        seen = (points - middle) @ view.T / reach
        return np.stack([(0.5 + 0.5 * seen[:, 0]) * size, (0.5 - 0.5 * seen[:, 1]) * size, seen[:, 2] * size / 2], 1)

    for k, body in enumerate(bodies):
        colour = np.array(pyplot.cm.tab20(k % 20)[:3])
        if isinstance(body, np.ndarray):
            for (cx, cy, cz), r in zip(on_screen(body[:, :3]), body[:, 3] / reach * size / 2):
                rows, columns, x, y = window_of((cx - r, cy - r), (cx + r, cy + r))
                dx, dy = (x - cx) / r, (y - cy) / r
                height = np.sqrt(np.clip(1 - dx * dx - dy * dy, 0, None))
                fill(rows, columns, height > 0, cz - r * height, np.stack([dx, -dy, -height], -1), colour)
            continue
        for vertices, faces in body:
            seen = on_screen(vertices)
            for a, b, c in seen[faces]:
                normal = np.cross(b - a, c - a) * [1, -1, 1]
                normal /= np.linalg.norm(normal) + 1e-300
                normal = normal if normal[2] < 0 else -normal
                rows, columns, x, y = window_of(np.minimum(np.minimum(a, b), c)[:2], np.maximum(np.maximum(a, b), c)[:2])
                whole = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
                if abs(whole) < 1e-9:
                    continue
                v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / whole
                w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / whole
                near = (v >= 0) & (w >= 0) & (v + w <= 1)
                fill(rows, columns, near, a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]),
                     np.broadcast_to(normal, x.shape + (3,)), colour)
    figure, (left, other) = pyplot.subplots(1, 2, figsize=(11, 5.5), gridspec_kw={"width_ratios": [1.2, 1]})
    left.imshow(image)
    left.axis("off")
    other.semilogy(*zip(*[(t, e) for t, e in kinetic if e > 0]))
    other.axhline(scene.energy_at_rest(), color="0.6", linestyle="--")
    other.set(xlabel="time", ylabel="kinetic energy (dashed: at rest)")
    figure.tight_layout()
    figure.savefig(path, dpi=90)
