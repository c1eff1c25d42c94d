# SPDX-License-Identifier: GPL-3.0-or-later
"""The scripts of an engine's folder, beside a plain computation of the grains. Programs of a few lines stand for the
engines: they move nothing, or every sphere down by 1. tests/engines runs the engines themselves."""
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

import numpy as np
import pytest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "lib/toolbox/exchange/engines"
# Two spheres along x with volume and moments of their own: no formula of spheres gives them.
CLUMPS = {"long": ([[-0.6, 0, 0, 0.5], [0.6, 0.12345, 0, 0.43217]], 1.1, (0.1, 0.5, 0.55)),
          "round": ([[0, 0, 0, 0.7], [0.1, 0.2, 0.1, 0.65], [0, -0.1, 0.2, 0.6]], 1.7, (0.3, 0.32, 0.35))}
BOX = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.4, 0.4) for z in (-0.3, 0.3)])
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                  [0, 6, 4], [1, 5, 7], [1, 7, 3]])
DENSITY, GRAVITY = 2500.0, 8.0


def make_folder(folder, script=None, parts=False, container=("box", 0.0), size=0.0, scale=1.0, count=12, young=0.0):
    """Volumes and moments of the table are those of the scans; the files have the scale of the call."""
    folder.mkdir()
    shutil.copy(SCRIPTS / "packing.py", folder)
    if script:
        shutil.copy(SCRIPTS / script, folder / "run.py")
        (folder / "matplotlib.py").write_text("raise ImportError")  # a picture takes seconds
    (folder / "scene.json").write_text(json.dumps({
        "grains": count, "seed": 3, "container": {"shape": container[0], "width": container[1]}, "gravity": GRAVITY,
        "material": {"density": DENSITY, "young_modulus": young, "poisson_ratio": 0.25, "friction": 0.4,
                     "restitution": 0.3}, "size": size, "scale": scale}))
    bodies = {"box": (None, 0.96 * 0.5, (0.02, 0.03, 0.04))} if parts else CLUMPS
    rows = [["grain", "status", "volume"] + ["principal_moments." + k for k in ("least", "middle", "greatest")],
            ["lost.ply", "failed", "", "", "", ""]]
    files = [{"grain": "lost.ply", "file": "lost.csv"}]
    for name, (spheres, volume, moments) in bodies.items():
        rows.append([name + ".ply", "done", volume, *moments])
        files.append({"grain": name + ".ply", "file": name + (".obj" if parts else ".csv")})
        if parts:
            (folder / "box.obj").write_text("g one\n" + "".join("v %r %r %r\n" % tuple(map(float, v)) for v in scale * BOX) +
                                            "".join("f %d %d %d\n" % tuple(f + 1) for f in FACES))
        else:
            (folder / (name + ".csv")).write_text("x,y,z,r\n" + "".join("%r,%r,%r,%r\n" % tuple(map(float, s))
                                                                        for s in spheres))
    with open(folder / "grains.csv", "w", newline="") as table:
        csv.writer(table).writerows(rows)
    (folder / "shapes.json").write_text(json.dumps(files))
    return folder


@pytest.fixture
def load(monkeypatch):
    """Imports packing.py of a folder."""
    def imported(folder, *words):
        monkeypatch.syspath_prepend(folder)
        monkeypatch.setattr(sys, "argv", ["run.py", *words])
        sys.modules.pop("packing", None)
        import packing
        return packing
    yield imported
    sys.modules.pop("packing", None)


def run(folder, program=None, text=""):
    """Runs run.py with a Python text in place of a program; returns what it prints."""
    programs = folder / "programs"
    programs.mkdir()
    if program:
        (programs / program).write_text("#!%s\n%s" % (sys.executable, text))
        (programs / program).chmod(0o755)
    done = subprocess.run([sys.executable, "run.py"], cwd=folder, text=True, capture_output=True,
                          env={**os.environ, "PATH": "%s:%s" % (programs, os.environ["PATH"])})
    assert done.returncode == 0, done.stderr
    return done.stdout


def finer(diameters, curve):
    """Fractions of the mass of spheres up to each diameter of a curve."""
    cubes = np.sort(diameters) ** 3
    return [cubes[:np.searchsorted(np.sort(diameters), d, "right")].sum() / cubes.sum() for d in curve]


def turned(turn, vectors):
    """By the formula of Hamilton, v + 2 w (u x v) + 2 u x (u x v)."""
    w, u = turn[0], np.asarray(turn[1:], float)
    across = np.cross(u, vectors)
    return vectors + 2 * w * across + 2 * np.cross(u, across)


def test_sizes_follow_the_curve_by_mass_and_shapes_their_weights(tmp_path, load):
    folder = make_folder(tmp_path / "a")
    (folder / "sizes.csv").write_text("diameter,finer\n0.5,0\n1,20\n1.5,70\n4,100\n")
    (folder / "templates.csv").write_text("grain,file,weight_by_number\na,round.csv,0.3\nb,long.csv,0.1\n")
    scene = load(folder, "20000").Scene()
    diameters = [g.diameter for g in scene.grains]
    np.testing.assert_allclose(finer(diameters, [1, 1.5]), [0.2, 0.7], atol=2e-3)
    # Even over the logarithm: the middle of 1 and 1.5 on it has half of their 50 %.
    np.testing.assert_allclose(finer(diameters, [math.sqrt(1.5)]), [0.45], atol=2e-3)
    assert min(diameters) >= 0.5 and max(diameters) <= 4
    assert sum(g.shape.name == "long" for g in scene.grains) == 5000
    for grain in scene.grains[:20]:
        volume, moments = CLUMPS[grain.shape.name][1:]
        length = grain.diameter / (6 * volume / math.pi) ** (1 / 3)
        assert grain.mass == pytest.approx(DENSITY * math.pi / 6 * grain.diameter ** 3)
        np.testing.assert_allclose(grain.moments, DENSITY * length ** 5 * np.array(moments))
    # Neither the sizes nor the shapes come in their order.
    assert abs(np.corrcoef(diameters, range(20000))[0, 1]) < 0.05
    assert abs(np.corrcoef([g.shape.name == "long" for g in scene.grains], range(20000))[0, 1]) < 0.05


@pytest.mark.parametrize("size, scale", [(0.004, 1.0), (0.0, 1e-3)])
def test_grains_have_the_size_or_the_scale_of_the_call(tmp_path, load, size, scale):
    scene = load(make_folder(tmp_path / "a", size=size, scale=scale)).Scene()
    assert len(scene.grains) == 12 and {g.shape.name for g in scene.grains} == {"long", "round"}
    for grain in scene.grains:
        volume, moments = CLUMPS[grain.shape.name][1:]
        length = size / (6 * volume / math.pi) ** (1 / 3) if size else scale
        assert grain.mass == pytest.approx(DENSITY * volume * length ** 3)
        np.testing.assert_allclose(grain.moments, DENSITY * length ** 5 * np.array(moments))
        if size:
            assert grain.diameter == pytest.approx(size)


@pytest.mark.parametrize("shape", ["box", "cylinder"])
def test_the_column_stands_in_the_container_and_no_grains_touch(tmp_path, load, shape):
    scene = load(make_folder(tmp_path / "a", container=(shape, 7.5), count=60)).Scene()
    bodies = [np.column_stack([turned(g.turn, np.array(CLUMPS[g.shape.name][0])[:, :3]) + g.place,
                               np.array(CLUMPS[g.shape.name][0])[:, 3]]) for g in scene.grains]
    for body, grain in zip(bodies, scene.grains):
        np.testing.assert_allclose(grain.spheres(), body, atol=1e-12)
        away = np.abs(body[:, :2]).max(1) if shape == "box" else np.hypot(body[:, 0], body[:, 1])
        assert (away + body[:, 3] <= 3.75).all()
        assert (body[:, 2] >= body[:, 3]).all() and (body[:, 2] + body[:, 3] <= scene.top).all()
    rows = np.concatenate(bodies)
    owner = np.repeat(range(60), [len(b) for b in bodies])
    gaps = np.linalg.norm(rows[:, None, :3] - rows[None, :, :3], axis=2) - rows[:, None, 3] - rows[None, :, 3]
    assert gaps[owner[:, None] != owner[None, :]].min() > 0
    assert scene.area() == pytest.approx(7.5 ** 2 if shape == "box" else math.pi * 3.75 ** 2)
    # The lowest grains bear the column and give way little.
    height = sum(g.mass for g in scene.grains) / DENSITY / 0.55 / scene.area()
    assert scene.material["young_modulus"] == pytest.approx(3000 * DENSITY * GRAVITY * height)
    assert scene.fall_time() == pytest.approx(1.2 * math.sqrt(2 * scene.top / GRAVITY))


def test_a_container_without_a_width_is_as_wide_as_the_packing_is_high(tmp_path, load):
    scene = load(make_folder(tmp_path / "a"), "500").Scene()
    solid = sum(g.mass for g in scene.grains) / DENSITY
    assert solid / (scene.width ** 2 * scene.width) == pytest.approx(0.55)


def test_a_scene_in_another_unit_is_the_same_scene(tmp_path, load):
    folder = make_folder(tmp_path / "a", young=1e6)
    scene = load(folder).Scene()
    tables = []
    for length in 1.0, 9.0:
        scene.write_clumps(folder / "scene", length)
        tables.append([list(map(float, line.split())) for line in (folder / "scene").read_text().splitlines()])
    plain, large = tables
    assert plain[0] == pytest.approx([4, scene.width / 2, scene.longest_time(), scene.fall_time(),
                                      scene.energy_at_rest(), GRAVITY, DENSITY, 1e6, 0.25, 0.4, 0.3])
    # Lengths, times and energies; a modulus is a density times g times a length.
    assert large[0] == pytest.approx(np.array(plain[0]) * [1, 9, 3, 3, 9 ** 4, 1, 1, 9, 1, 1, 1])
    for grain, one, other in zip(scene.grains, plain[1:], large[1:]):
        spheres = np.array(CLUMPS[grain.shape.name][0])
        assert one == pytest.approx([grain.mass, *grain.moments, *grain.place, *grain.turn, len(spheres),
                                     *spheres.ravel()])
        factors = [9 ** 3] + 3 * [9 ** 5] + 3 * [9] + 5 * [1] + 4 * len(spheres) * [9]
        assert other == pytest.approx(np.array(one) * factors)


@pytest.mark.parametrize("kind", ["spheres", "parts"])
def test_the_last_line_is_the_packing(tmp_path, kind):
    """64 balls that touch, of two sizes, or boxes, in two pairs of layers: between them is nothing."""
    folder = make_folder(tmp_path / "a", parts=kind == "parts", container=("box", 4.4), count=64)
    (folder / "run.py").write_text("""
import packing
from packing import np
scene = packing.Scene()
places = [(x - 1.5, y - 1.5, z) for z in (0.6, 1.6, 30.6, 31.6) for y in range(4) for x in range(4)]
if %r == "spheres":
    large = [(round(x + y + z + 3) %% 2) for x, y, z in places]
    # With a speck above each, whose ball about the grain reaches grains that it does not touch.
    bodies = [np.array([[*p, 0.400001 + 0.2 * k], [*p[:2], p[2] + 0.9, 0.01]]) for p, k in zip(places, large)]
else:
    turn = packing.rotation(np.array([0.8, 0.0, 0.48, 0.36]))  # a box about a part is larger than the part
    bodies = [[(0.7 * v @ turn.T + p, f) for v, f in scene.grains[0].shape.parts] for p in places]
contacts = None if %r == "spheres" else [(0, 1), (1, 0), (2, 5)]
packing.finish("Test", scene, bodies, places, [(1.5, 1e9), (2.5, 0.5 * scene.energy_at_rest())], 7, contacts)
""" % (kind, kind))
    line = run(folder).splitlines()[0]
    assert (folder / "packing.png").stat().st_size > 5000
    numbers = dict(re.findall(r"(porosity|coordination|height|potential energy) ([0-9.e+-]+)", line))
    assert line.startswith("Test: 64 grains at rest after 2.5 s: ")
    with open(folder / "packing.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert [float(rows[5][k]) for k in "xyz"] == [-0.5, -0.5, 0.6] and len(rows) == 64
    masses = DENSITY * math.pi / 6 * np.array([float(row["equivalent_diameter"]) for row in rows]) ** 3
    heights = np.array([float(row["z"]) for row in rows])
    middle = masses @ heights / masses.sum()
    assert float(numbers["potential energy"]) == pytest.approx(GRAVITY * (masses @ heights), rel=1e-3)
    assert float(numbers["height"]) == pytest.approx(2 * middle, rel=1e-2)
    # Below the mean height are two layers. Of 20,000 random places the porosity has a deviation of .0017.
    solid = 4 / 3 * math.pi * (0.6 ** 3 + 0.4 ** 3) / 2 if kind == "spheres" else 0.7 ** 3 * 1.0 * 0.8 * 0.6
    assert float(numbers["porosity"]) == pytest.approx(1 - 32 * solid / (4.4 ** 2 * middle), abs=0.006)
    contacts = 4 * 24 + 2 * 16 if kind == "spheres" else 2
    assert float(numbers["coordination"]) == pytest.approx(2 * contacts / 64, abs=0.005)


def scene_of(folder, load):
    """The scene that run.py has made, with the files that it has read."""
    return load(folder).Scene()


def expect_places(folder, places):
    with open(folder / "packing.csv", newline="") as table:
        found = [[float(row[k]) for k in "xyz"] for row in csv.DictReader(table)]
    np.testing.assert_allclose(found, places, rtol=1e-5, atol=1e-8)


FAKE_LAMMPS = """
lines = open("packing.data").read().split("Atoms\\n\\n")[1].split("\\n\\n")[0].splitlines()
atoms = [line.split() for line in lines]
with open("packing.spheres", "w") as dump:
    for down in (900.0, 1.0):
        print("ITEM: TIMESTEP\\n1\\nITEM: ATOMS id x y z radius", file=dump)
        for k, _, d, _, x, y, z in atoms:
            print(k, x, y, float(z) - down, float(d) / 2, file=dump)
bodies = [line.split() for line in open("packing.bodies").read().splitlines()[1:]]
with open("packing.grains", "w") as dump:
    print("ITEM: TIMESTEP\\n1\\nITEM: ENTRIES index c[1]", file=dump)
    for k, row in reversed(list(enumerate(bodies))):
        print(k + 1, row[0], row[2], row[3], float(row[4]) - 1, *row[1:2], *row[5:8], file=dump)
print("Step Time c_kinetic\\n0 0 5\\n100 2.5 1e-30")
"""


def test_lammps_gets_the_mass_and_the_moments_of_the_grains(tmp_path, load):
    folder = make_folder(tmp_path / "a", "run_lammps.py", young=1e6)
    out = run(folder, "lmp", FAKE_LAMMPS)
    assert out.startswith("LAMMPS: 12 grains at rest after 2.5 s")
    assert 0.5 < float(re.search("porosity ([0-9.]+)", out)[1]) < 0.95  # at first all are far below
    scene = scene_of(folder, load)
    text = (folder / "packing.data").read_text()
    atoms = np.array([line.split() for line in text.split("Atoms\n\n")[1].split("\n\n")[0].splitlines()], float)
    owners = np.array([line.split() for line in text.split("Molecules\n\n")[1].splitlines()], int)[:, 1]
    bodies = [line.split() for line in (folder / "packing.bodies").read_text().splitlines()[1:]]
    for k, grain in enumerate(scene.grains):
        own = atoms[owners == k + 1]
        # Each sphere has the mass of the grain, for the contacts.
        np.testing.assert_allclose(own[:, 3] @ own[:, 2] ** 3 * math.pi / 6, grain.mass)
        np.testing.assert_allclose(np.column_stack([own[:, 4:], own[:, 2] / 2]), grain.spheres(), rtol=1e-9)
        number, mass, x, y, z, xx, yy, zz, xy, xz, yz = map(float, bodies[k][:11])
        assert (number, mass) == (k + 1, grain.mass)
        np.testing.assert_allclose([x, y, z], grain.place)
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        for axis, moment in enumerate(grain.moments):
            along = turned(grain.turn, np.eye(3)[axis])
            np.testing.assert_allclose(tensor @ along, moment * along, atol=1e-9 * moment)
    expect_places(folder, [grain.place - [0, 0, 1] for grain in scene.grains])
    script = (folder / "packing.in").read_text()
    shear, least = 1e6 / 2.5, min(s[3] for spheres, _, _ in CLUMPS.values() for s in spheres)
    step = float(re.search(r"^timestep (\S+)", script, re.M)[1])
    rayleigh = math.pi * least * math.sqrt(DENSITY / shear) / (0.1631 * 0.25 + 0.8766)
    assert step == pytest.approx(0.15 * rayleigh)
    assert int(re.search(r"^run (\d+)$", script, re.M)[1]) * step >= scene.fall_time()


FAKE_LIGGGHTS = """
import re, collections
script = open("packing.in").read()
count = int(re.search("particles_in_region (\\\\d+)", script)[1])
shares = [float(v) for v in re.search("numberbased \\\\d+ \\\\d+(.*)", script)[1].split()[1::2]]
number = 0
with open("packing.spheres", "w") as dump:
    print("ITEM: TIMESTEP\\n1000\\nITEM: ATOMS id", file=dump)
    for k, share in enumerate(shares):
        for _ in range(round(share * count)):
            number += 1
            for row in open("template_%d.spheres" % k):
                x, y, z, r = map(float, row.split())
                print(100 - number, x + 10 * number, y, z, r, 0, 0, 0, file=dump)
"""


def test_liggghts_gets_a_template_of_each_shape_and_size(tmp_path, load):
    folder = make_folder(tmp_path / "a", "run_liggghts.py", young=1e6, count=20)
    (folder / "templates.csv").write_text("grain,file,weight_by_number\na,round.csv,0.75\nb,long.csv,0.25\n")
    assert run(folder, "liggghts", FAKE_LIGGGHTS).startswith("LIGGGHTS: 20 grains at rest")
    script = (folder / "packing.in").read_text()
    found = {}
    for k, line in enumerate(re.findall(r"^fix t\d+ .*", script, re.M)):
        words = line.split()
        spheres = np.loadtxt(folder / ("template_%d.spheres" % k))
        name = "long" if len(spheres) == 2 else "round"
        np.testing.assert_allclose(spheres, CLUMPS[name][0])
        assert int(words[words.index("nspheres") + 1]) == len(spheres)
        # LIGGGHTS refuses templates and regions below it, or below 1e-12.
        assert 0 < float(words[words.index("volume_limit") + 1]) < 4 / 3 * math.pi * spheres[:, 3].min() ** 3
        assert float(words[words.index("mass") + 1]) == pytest.approx(DENSITY * CLUMPS[name][1])
        at = words.index("inertia_tensor")
        tensor = [float(v) for v in words[at + 1:at + 7]]
        i, j, k = DENSITY * np.array(CLUMPS[name][2])
        assert tensor == pytest.approx([i, 0, 0, j, 0, k])
        found[name] = words[1]
    mixture = re.search(r"numberbased \d+ \d+(.*)", script)[1].split()
    assert dict(zip(mixture[::2], map(float, mixture[1::2]))) == {found["round"]: 0.75, found["long"]: 0.25}
    with open(folder / "packing.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert sorted(row["grain"] for row in rows) == 5 * ["long"] + 15 * ["round"]
    # Each grain is where its own spheres are.
    for row in rows:
        spheres = np.array(CLUMPS[row["grain"]][0])
        middle = np.average(spheres[:, :3], weights=spheres[:, 3] ** 3, axis=0)
        assert float(row["y"]) == pytest.approx(middle[1]) and float(row["z"]) == pytest.approx(middle[2])


def test_liggghts_has_five_sizes_that_keep_the_mass(tmp_path, load):
    folder = make_folder(tmp_path / "a", "run_liggghts.py", young=1e6, count=50)
    (folder / "sizes.csv").write_text("1,0\n2,100\n")
    run(folder, "liggghts", FAKE_LIGGGHTS)
    with open(folder / "packing.csv", newline="") as table:
        sizes = [float(row["equivalent_diameter"]) for row in csv.DictReader(table)]
    assert len(set(sizes)) == 5
    own = [grain.diameter for grain in scene_of(folder, load).grains]
    assert np.sum(np.array(sizes) ** 3) == pytest.approx(np.sum(np.array(own) ** 3))


FAKE_MUJOCO = """
import xml.etree.ElementTree as xml
import numpy as np

class MjModel:
    @staticmethod
    def from_xml_path(path):
        model = MjModel()
        model.bodies = xml.parse(path).getroot().findall("worldbody/body")
        model.geom_bodyid = [k + 1 for k, body in enumerate(model.bodies) for _ in body.findall("geom")]
        model.ngeom = len(model.geom_bodyid)
        return model

class MjData:
    def __init__(self, model):
        rows = [[float(v) for v in (b.get("pos") + " " + b.get("quat")).split()] for b in model.bodies]
        self.qpos, self.time, self.energy, self.contact = np.array(rows).ravel(), 0.0, [0.0, 0.0], []

def mj_step(model, data):
    data.time += 0.0015
"""


def test_mujoco_gets_a_model_of_decimetres_and_gives_grains_of_the_folder(tmp_path, load):
    folder = make_folder(tmp_path / "a", "run_mujoco.py", parts=True, scale=0.01)
    (folder / "mujoco.py").write_text(FAKE_MUJOCO)
    assert run(folder).startswith("MuJoCo: 12 grains at rest")
    scene = scene_of(folder, load)
    model = xml.etree.ElementTree.parse(folder / "packing.xml").getroot()
    bodies = model.findall("worldbody/body")
    length = 0.2 / scene.mean_diameter
    vertices = np.array(model.find("asset/mesh").get("vertex").split(), float).reshape(-1, 3)
    np.testing.assert_allclose(np.ptp(vertices, axis=0), length * 0.01 * np.array([1, 0.8, 0.6]), rtol=1e-6)
    for body, grain in zip(bodies, scene.grains):
        inertial = body.find("inertial")
        # Of quartz, 2650, whatever the density of the grains.
        assert float(inertial.get("mass")) == pytest.approx(2650 * grain.shape.volume * length ** 3)
        moments = np.array(inertial.get("diaginertia").split(), float)
        np.testing.assert_allclose(moments, 2650 * 1e-10 * length ** 5 * np.array([0.02, 0.03, 0.04]), rtol=1e-6)
        np.testing.assert_allclose(np.array(body.get("pos").split(), float), length * grain.place, rtol=1e-6, atol=1e-6)
    expect_places(folder, [grain.place for grain in scene.grains])


FAKE_ROCKABLE = """
import pathlib, sys, time
text = pathlib.Path(sys.argv[1]).read_text()
pathlib.Path("kineticEnergy.txt").write_text("1 9 0\\n99 0 0\\n100 0 0\\n")
pathlib.Path("conf2").write_text(text + "Interactions 2\\n5 6 0 0\\n0 5 0 0\\n")
time.sleep(30)
"""


def test_rockable_gets_the_grains_within_walls_that_look_outwards(tmp_path, load):
    folder = make_folder(tmp_path / "a", "run_rockable.py", parts=True, container=("box", 3.0), young=1.0)
    # A box that a sphere of .1 rounds.
    corners = BOX - 0.1 * np.sign(BOX)
    shape = "<\nname box\nradius 0.1\npreCompDone y\nnv 8\n%s\nne 0\nnf 12\n%s\nvolume 1\n>\n" % (
        "\n".join("%r %r %r" % tuple(map(float, v)) for v in corners),
        "\n".join("3 %d %d %d" % tuple(f) for f in FACES))
    (folder / "box.shp").write_text(shape)
    shapes = (folder / "shapes.json").read_text()
    (folder / "shapes.json").write_text(shapes.replace("box.obj", "box.shp"))
    out = run(folder, "rockable", FAKE_ROCKABLE)
    assert out.startswith("Rockable: 12 grains at rest after 99 s") and "coordination 0.17," in out  # 2 / 12
    scene = scene_of(folder, load)
    rows = [line.split() for line in (folder / "input.txt").read_text().split("Particles 17\n")[1].splitlines()]
    names = [row[0] for row in rows]
    assert names == 5 * ["wall"] + 12 * ["grain_0"]
    thickness = 0.05 * scene.mean_diameter
    for row in rows[:5]:
        place, turn = np.array(row[4:7], float), np.array(row[13:17], float)
        outwards = turned(turn, np.array([0, 0, 1.0]))
        if place[2] < 0:  # the floor
            np.testing.assert_allclose(place, [0, 0, -thickness])
        else:
            # Its surface, a thickness inwards, is the side of the container.
            assert place @ outwards - thickness == pytest.approx(1.5) and abs(outwards[2]) < 1e-12
    assert len({tuple(np.round(np.array(row[4:7], float), 6)) for row in rows[:5]}) == 5
    for row, grain in zip(rows[5:], scene.grains):
        np.testing.assert_allclose(np.array(row[3:7], float), [grain.scale, *grain.place])
        np.testing.assert_allclose(np.array(row[13:17], float), grain.turn)
    expect_places(folder, [grain.place for grain in scene.grains])
    values = dict(re.findall(r"^(\w+) (\S+)$", (folder / "input.txt").read_text(), re.M))
    # The fastest fall gives way to half of the rounding at most: m v^2 / 2 < k x^2 / 2.
    laws = dict(re.findall(r"^(\w+Contact) 1 1 (\S+)$", (folder / "input.txt").read_text(), re.M))
    mass, speed = max(g.mass for g in scene.grains), math.sqrt(2 * GRAVITY * scene.top)
    assert float(laws["knContact"]) * 0.05 ** 2 >= mass * speed ** 2 * (1 - 1e-9)
    assert float(laws["en2Contact"]) == pytest.approx(0.3 ** 2) and float(laws["muContact"]) == 0.4
    least = min(g.mass for g in scene.grains)
    assert float(values["dt"]) == pytest.approx(0.05 * math.sqrt(least / float(laws["knContact"])))


def test_yade_gets_a_level_set_of_each_size_in_any_unit(tmp_path, load):
    """Scans in nanometres with a curve in metres are 1e9 times smaller in the packing, each by its own number."""
    folder = make_folder(tmp_path / "run", "run_yade.py", parts=True, scale=1e9)
    (folder / "sizes.csv").write_text("diameter,finer\n1,0\n3,100\n")
    # Names of Yade that take anything; the script ends where the engine would begin.
    names = sorted({*re.findall(r"\b(?:[A-Z]\w+|O)\b", (folder / "run.py").read_text()), "geom", "log", "polyhedra_utils",
                    "utils"})
    (folder / "yade.py").write_text("from unittest.mock import MagicMock\n__all__ = %r\n"
                                    "globals().update((name, MagicMock()) for name in __all__)\n"
                                    "O.run.side_effect = SystemExit\n" % names)
    (folder / "yade_level_sets.py").write_text("from unittest.mock import MagicMock\nGrainContacts = MagicMock()\n\n\n"
                                               "def Grain(nodes, grid, scale):\n    print(scale)\n    return MagicMock()\n")
    assert list(map(float, run(folder).split())) == [grain.scale for grain in load(folder).Scene().grains]
