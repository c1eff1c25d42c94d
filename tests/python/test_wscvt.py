# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python module: arrays in and out, options by name, reports, progress, errors."""
import ast
import base64
import gc
import html
import json
import math
import os
import pathlib
import pickle
import re
import shutil
import subprocess
import sys
import threading
import warnings
import zlib

import numpy as np
import pytest

import wscvt

MESHES = pathlib.Path(os.environ["WSCVT_MESHES_DIR"])


@pytest.fixture(scope="module")
def scan():
    return wscvt.read_mesh(str(MESHES / "sand_7228.ply"))


def volume(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0


def test_remesh_gives_arrays_of_exactly_n_nodes(scan):
    vertices, faces = scan
    result = wscvt.remesh(vertices, faces, nodes=300, distances=True, source="sand")
    assert result.vertices.shape == (300, 3) and result.vertices.dtype == np.float64
    assert result.faces.shape == (596, 3) and result.faces.dtype == np.int32
    assert volume(result.vertices, result.faces) == pytest.approx(volume(vertices, faces), rel=1e-9)
    assert result.cell_areas.shape == result.vertex_distances.shape == (300,)
    np.testing.assert_allclose(np.linalg.norm(result.vertices - result.centre, axis=1),
                               result.radial_distances, rtol=1e-12)
    # Cells cover the surface; the scan is rougher than its remesh.
    assert result.cell_areas.sum() == pytest.approx(result.report["descriptors"]["area"]["scan"],
                                                    rel=0.05)
    assert result.report["source"] == "sand"
    assert result.report["result"] == {"vertices": 300, "faces": 596}
    inside, outside = result.vertex_distances.min(), result.vertex_distances.max()
    assert result.report["distances"]["largest"] >= max(-inside, outside) and inside < 0.0 < outside
    assert "300 nodes, 596 faces" in str(result)


def test_the_module_needs_no_library_of_the_formats_of_volumes():
    module = wscvt._wscvt.__file__
    read = subprocess.run(["readelf", "-d", module], capture_output=True, text=True, check=True).stdout
    needed = re.findall(r"NEEDED.*\[lib(.+)\.so", read)
    assert "c" in needed
    # Whoever has arrays should not need them.
    assert not {"tiff", "png", "png16", "lz4", "bz2", "minizip", "niftiio", "nifti2", "expat"} & set(needed)
    assert not [name for name in needed if name.startswith("hdf5")]


def test_arrays_outlive_what_they_came_from(scan):
    result = wscvt.remesh(*scan, nodes=60)
    vertices, copy = result.vertices, result.vertices.copy()
    del result
    gc.collect()
    np.testing.assert_array_equal(vertices, copy)


def test_it_is_the_remesh_of_the_program(scan, tmp_path):
    wscvt.write_mesh(str(tmp_path / "ours.ply"), *(lambda r: (r.vertices, r.faces))(
        wscvt.remesh(*scan, nodes=100, weighting="wscvt-c", threads=1)))
    said = subprocess.run([os.environ["WSCVT_PROGRAM"], MESHES / "sand_7228.ply", tmp_path / "its.ply", "-n", "100",
                           "-w", "wscvt-c", "-v"], check=True, capture_output=True, text=True)
    assert (tmp_path / "ours.ply").read_bytes() == (tmp_path / "its.ply").read_bytes()
    ours = [line for line in str(wscvt.remesh(*scan, nodes=100, weighting="wscvt-c")).splitlines()
            if not line.startswith("Warning ")]
    # The program adds files, time and verdict.
    assert said.stdout.splitlines()[:len(ours)] == ours


def test_names_are_taken_in_capitals_too(scan):
    for given in [{"weighting": "WSCVT-C"}, {"method": "As-Published", "weighting": "WSCVT-D"},
                  {"error_measure": "Volume", "placement": "ON-SURFACE"}]:
        options = wscvt.remesh(*scan, nodes=60, **given).report["options"]
        for name, value in given.items():
            assert options[name.replace("_", "-")] == value.lower()
    assert wscvt.options("AS-PUBLISHED") == wscvt.options("as-published")
    grain = wscvt.create("Ellipsoid", semi_axes=(1, 0.8, 0.7), nodes=60)
    assert (grain.node_table(frame="Principal") == grain.node_table(frame="principal")).all()


def test_inputs_of_other_libraries(scan):
    vertices, faces = scan
    expected = wscvt.remesh(vertices, faces, nodes=60).vertices
    for given in [(np.asfortranarray(vertices), np.asfortranarray(faces.astype(np.uint64))),
                  (vertices.tolist(), faces.tolist()),
                  (vertices[::1], faces[:, ::-1][:, ::-1].astype(np.int64))]:
        np.testing.assert_array_equal(wscvt.remesh(*given, nodes=60).vertices, expected)
    floats = vertices.astype(np.float32)  # as PyVista has them
    np.testing.assert_allclose(wscvt.remesh(floats, faces, nodes=60).vertices.mean(axis=0),
                               expected.mean(axis=0), atol=1e-2)
    points = wscvt.remesh(vertices, None, nodes=60, points=True)
    assert any("points" in warning for warning in points.warnings)



class TrimeshLike:
    def __init__(self, vertices, faces):
        self.vertices, self.faces = vertices, faces


class PyVistaLike:
    def __init__(self, vertices, faces):
        self.points, self.regular_faces = vertices, faces
        self.faces = np.hstack([np.full((len(faces), 1), 3), faces]).ravel()  # as PyVista's
        self.vertices = None


def test_a_mesh_may_be_a_path_or_an_object(scan, tmp_path):
    vertices, faces = scan
    expected = wscvt.remesh(vertices, faces, nodes=60)
    path = MESHES / "sand_7228.ply"
    for result in [wscvt.remesh(vertices, faces, 60), wscvt.remesh(path, 60), wscvt.remesh(scan, 60),
                   wscvt.remesh(str(path), nodes=60), wscvt.remesh(TrimeshLike(*scan), 60),
                   wscvt.remesh(PyVistaLike(*scan), np.int64(60))]:
        np.testing.assert_array_equal(result.vertices, expected.vertices)
    assert wscvt.remesh(path, 60).report["source"] == "sand_7228.ply"
    assert repr(expected).startswith("<wscvt.Remesh of 60 nodes and 116 faces, ")
    wscvt.write_mesh(tmp_path / "small.ply", expected)
    np.testing.assert_array_equal(wscvt.read_mesh(tmp_path / "small.ply")[0], expected.vertices)
    assert wscvt.describe(tmp_path / "small.ply")["descriptors"]["volume"] == pytest.approx(
        wscvt.describe(expected.vertices, expected.faces)["descriptors"]["volume"])


@pytest.mark.parametrize("method", ["on-scan", "as-published"])
def test_every_option_reaches_the_report(method):
    grain = wscvt.create("ellipsoid", semi_axes=(1, 0.8, 0.7), nodes=400, method="as-published")
    report = wscvt.remesh(grain, nodes=60, method=method).report["options"]
    defaults = wscvt.options(method)
    assert {name.replace("_", "-") for name in defaults} - {"handles"} == {
        key for key, value in report.items() if value is not None}
    choices = {"weighting": "wscvt-c", "sampling": "fibonacci", "handles": "keep",
               "placement": "on-surface" if method == "as-published" else "fitted",
               "error_measure": "volume"}
    for name, value in defaults.items():
        if name == "method":
            continue
        if isinstance(value, bool):
            other = not value
        elif isinstance(value, str):
            other = choices[name]
        else:
            other = {"max_error": 30.0, "degree": 4, "nodes": 61, "edge_ratio": 1.3,
                     "max_overhang": 1.5, "max_repaired_area": 12.5,
                     "shrink_wrap": 4.0}.get(name, value / 2 or 1)
            other = type(value)(other)
        made = wscvt.remesh(grain, **{"nodes": 60, "method": method, name: other})
        assert made.report["options"][name.replace("_", "-")] == other, name


@pytest.mark.parametrize("given, part", [
    ({"refine": 60}, "There is no option refine"), ({"sampling": "fibonacci"}, "as-published"), ({"method": "as-published", "edge_ratio": 1.2}, "on-scan")])
def test_unknown_options_and_those_of_the_other_method_are_refused(scan, given, part):
    with pytest.raises(TypeError, match=part):
        wscvt.remesh(*scan, **given)


@pytest.mark.parametrize("given, part", [
    ({"weighting": "area"}, "as-published"), ({"weighting": "radial-distance"}, "wscvt-d"),
    ({"weighting": "error-adaptive"}, "wscvt-d with edge_ratio=1.4")])
def test_values_that_are_gone_and_those_of_the_other_method_are_refused(scan, given, part):
    with pytest.raises(wscvt.Error, match=part):
        wscvt.remesh(*scan, **given)


def keywords_of_the_stub(function):
    stub = pathlib.Path(wscvt.__file__).with_name("__init__.pyi").read_text()
    node = next(n for n in ast.parse(stub).body if getattr(n, "name", "") == function)
    return {a.arg: ast.unparse(a.annotation) for a in node.args.args + node.args.kwonlyargs}


def help_of_options(function):
    listed = re.findall(r"^    (\w+): (.*(?:\n {8}.*)*)", function.__doc__.split("Options:")[1], re.M)
    return {name: re.sub(r"\s+", " ", text) for name, text in listed}


@pytest.mark.parametrize("function", ["remesh", "create"])
def test_the_stub_has_all_options_with_their_types(function):
    keywords = keywords_of_the_stub(function)
    both = {name: value for name, value in {**wscvt.options(), **wscvt.options("as-published")}.items()
            if name in help_of_options(getattr(wscvt, function))}
    for name, value in both.items():
        if isinstance(value, str):
            refused = [str(pytest.raises(wscvt.Error, wscvt.remesh, np.zeros((4, 3)), None,
                                         **{"method": method, name: "no such"}).value)
                       for method in ("on-scan", "as-published") if name in wscvt.options(method)]
            for choice in re.findall(r"'([^']+)'", keywords[name]):
                assert any(choice.lower() in text for text in refused)
            assert repr(value) in keywords[name]
        else:
            assert keywords[name] == type(value).__name__, name
    signature = getattr(wscvt, function).__doc__
    for name in set(keywords) - set(both):
        assert f"{name}:" in signature


def masked(numbers):
    """An array without its first number, as from netCDF4."""
    return np.ma.masked_array(numbers, np.arange(numbers.size).reshape(numbers.shape) == 0)


def test_what_is_refused(scan):
    vertices, faces = scan
    for call, code, part in [
            (lambda: wscvt.remesh(vertices, faces, nodes=3), "invalid-input", "4 to 1000000"),
            (lambda: wscvt.remesh(vertices, faces, weighting="no"), "invalid-input", "wscvt-c"),
            (lambda: wscvt.remesh(vertices, faces + 1), "invalid-input", "has the vertex 7228, but"),
            (lambda: wscvt.remesh(vertices, faces - 1), "invalid-input", "-1"),
            (lambda: wscvt.remesh(vertices.ravel(), faces), "invalid-input", "(n, 3)"),
            (lambda: wscvt.remesh(vertices, faces.ravel()), "invalid-input", "regular_faces"),
            (lambda: wscvt.remesh(vertices * np.nan, faces), "invalid-input", "finite"),
            (lambda: wscvt.remesh(vertices, faces, threads=-1), "invalid-input", "thread"),
            (lambda: wscvt.remesh(masked(vertices), faces), "invalid-input", "vertices.filled(VALUE)"),
            (lambda: wscvt.extract(masked(np.ones((5, 5, 5), np.uint8))), "invalid-input", "labels.filled(VALUE)"),
            (lambda: wscvt.write_mesh("m.ply", masked(vertices), faces), "invalid-input", "vertices.filled"),
            (lambda: wscvt.write_mesh("m.ply", *scan, vertex_attributes={"q": masked(vertices[:, 0])}),
             "invalid-input", "vertex_attributes.filled(VALUE)"),
            (lambda: wscvt.carry_attributes((masked(vertices), faces), scan, {"q": vertices[:, 0]}),
             "invalid-input", "scan.filled(VALUE)"),
            (lambda: wscvt.templates(masked(vertices), np.ones(len(vertices)), 5), "invalid-input",
             "descriptors.filled"),
            (lambda: wscvt.remesh(MESHES, 60), "invalid-input", "wscvt.batch"),
            (lambda: wscvt.tetrahedra([]), "invalid-input", "no bodies"),
            (lambda: wscvt.extract(np.uint8(3)), "invalid-input", "one number"),
            (lambda: wscvt.extract(np.ones((5, 5), np.uint8)), "invalid-input", "an array of 5 x 5"),
            (lambda: wscvt.read_mesh("no.ply"), "input-output", "no.ply"),
            (lambda: wscvt.create("cube"), "invalid-input", "superellipsoid")]:
        with pytest.raises(wscvt.Error) as refused:
            call()
        assert refused.value.code == code
        assert part in str(refused.value)
        own = ValueError if code == "invalid-input" else FileNotFoundError
        assert isinstance(refused.value, RuntimeError) and isinstance(refused.value, own)
    for call, part in [(lambda: wscvt.remesh(vertices, faces, nodse=3), "nodse"),
                       (lambda: wscvt.remesh(vertices, faces, nodes=2.5), "whole number"),
                       (lambda: wscvt.remesh(vertices, faces, nodes="many"), "many"),
                       (lambda: wscvt.remesh(vertices, faces, nodes=10**30), "4 to 1000000"),
                       (lambda: wscvt.remesh(vertices, faces.astype(float)), "whole numbers"),
                       (lambda: wscvt.batch([scan], 60, output="out"), "grains are files"),
                       (lambda: wscvt.write_mesh("m.ply", object()), "wrong type: .*vertices is object"),
                       (lambda: wscvt.remesh(vertices, faces, weighting=3), "wscvt-c")]:
        with pytest.raises(TypeError, match=part):
            call()


@pytest.mark.parametrize("reference", [3, (1.0,), ("a", "b"), {"vertices": 1}, object()])
def test_a_reference_of_another_type_is_a_type_error(scan, reference):
    with pytest.raises(TypeError, match=r"\(vertices, faces\)"):
        wscvt.describe(*scan, reference)


@pytest.mark.parametrize("answer", ["stop", [], np.zeros(3), object()])
def test_an_answer_of_another_type_is_a_type_error(scan, answer):
    with pytest.raises(TypeError, match=f"{type(answer).__name__}. Return True, or False"):
        wscvt.remesh(*scan, nodes=60, progress=lambda fraction, stage: answer)


def test_answers_that_are_true_or_false_count(scan):
    for answer in [None, True, np.True_, 1]:
        wscvt.remesh(*scan, nodes=60, progress=lambda fraction, stage: answer)
    for answer in [False, np.False_, 0]:
        with pytest.raises(wscvt.Error) as cancelled:
            wscvt.remesh(*scan, nodes=60, progress=lambda fraction, stage: answer)
        assert cancelled.value.code == "cancelled"


def test_memory_that_is_refused_is_a_memory_error():
    # 10 MB more than the interpreter has; the nodes alone take more.
    code = ("import resource, wscvt\n"
            "pages = int(open('/proc/self/statm').read().split()[0])\n"
            "most = pages * resource.getpagesize() + 10 ** 7\n"
            "resource.setrlimit(resource.RLIMIT_AS, (most, most))\n"
            "try:\n"
            "    wscvt.create('ellipsoid', nodes=1000000, threads=1)\n"
            "except MemoryError as error:\n"
            "    print(error)\n")
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300)
    assert "fewer nodes" in ended.stdout, ended.stderr


def test_progress_tells_and_cancels(scan):
    told = []
    wscvt.remesh(*scan, nodes=60, progress=lambda fraction, stage: told.append((fraction, stage)))
    assert told[-1] == (1.0, "Done")
    assert all(0.0 <= fraction <= 1.0 for fraction, _ in told)
    with pytest.raises(wscvt.Error) as cancelled:
        wscvt.remesh(*scan, nodes=60, progress=lambda fraction, stage: fraction < 0.2)
    assert cancelled.value.code == "cancelled"
    with pytest.raises(ZeroDivisionError):
        wscvt.remesh(*scan, nodes=60, progress=lambda fraction, stage: 1 / 0)


def test_handlers_of_signals_run_within_the_work():
    # A timer's handler that is called only when the work is done is called once.
    code = ("import signal, wscvt\n"
            "calls = []\n"
            "def handler(*_):\n"
            "    calls.append(1)\n"
            "    if len(calls) == 3: raise RuntimeError('the third call')\n"
            "signal.signal(signal.SIGALRM, handler)\n"
            "signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)\n"
            "wscvt.create('ellipsoid', nodes=200000)\n"
            "signal.setitimer(signal.ITIMER_REAL, 0.0)\n"
            "print('to the end')\n")
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert "the third call" in ended.stderr
    assert "to the end" not in ended.stdout


def test_ctrl_c_ends_the_work():
    # A shell's background job ignores the signal, and what it starts does too.
    code = ("import os, signal, threading, wscvt\n"
            "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
            "threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
            "wscvt.create('ellipsoid', nodes=200000)\n")
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert "KeyboardInterrupt" in ended.stderr


def test_other_threads_run_meanwhile(scan):
    stages = []
    start = threading.Event()

    def work():
        stages.append("begun")
        start.set()
        wscvt.remesh(*scan, nodes=2000)
        stages.append("done")

    worker = threading.Thread(target=work)
    worker.start()
    start.wait()
    ran = sum(1 for _ in range(1000))
    stages.append(ran)
    worker.join()
    assert stages == ["begun", 1000, "done"]


def test_create_and_describe_know_an_ellipsoid():
    made = wscvt.create("ellipsoid", semi_axes=(1.0, 0.8, 0.6), nodes=2000,
                        placement="fitted")
    exact = 4.0 / 3.0 * math.pi * 0.48
    assert volume(made.vertices, made.faces) == pytest.approx(exact, rel=1e-9)
    on = wscvt.create("ellipsoid", semi_axes=(1.0, 0.8, 0.6), nodes=100).vertices
    np.testing.assert_allclose(((on / [1.0, 0.8, 0.6]) ** 2).sum(axis=1), 1.0, rtol=1e-12)
    shape = wscvt.describe(made.vertices, made.faces)
    assert shape["descriptors"]["axis_l_box"] == pytest.approx(2.0, rel=1e-2)
    larger = wscvt.describe(1.1 * made.vertices, made.faces, (made.vertices, made.faces))
    assert larger["descriptors"]["volume"]["error_percent"] == pytest.approx(33.1, abs=1e-6)


def test_create_knows_the_two_exponents_of_a_superellipsoid():
    def exact(polar, azimuthal):
        def beta(a, b):
            return math.gamma(a) * math.gamma(b) / math.gamma(a + b)
        return 2 * 0.48 * polar * azimuthal * beta(polar / 2 + 1, polar) * beta(azimuthal / 2, azimuthal / 2)
    for polar, azimuthal in [(0.5, 1.0), (1.0, 0.5)]:
        made = wscvt.create("superellipsoid", semi_axes=(1.0, 0.8, 0.6),
                            exponents=(polar, azimuthal), nodes=1000, placement="fitted")
        assert volume(made.vertices, made.faces) == pytest.approx(exact(polar, azimuthal), rel=1e-3)


def test_clump_gives_spheres_and_their_errors():
    made = wscvt.create("ellipsoid", nodes=2000, semi_axes=(3, 2, 1))
    clump = wscvt.clump(made.vertices, made.faces, 12)
    assert clump["spheres"].shape == (12, 4) and clump["sphere_count"] == 12
    inside = wscvt.clump(made.vertices, made.faces, count=12, inside=True)
    radii = inside["spheres"][:, 3]
    depths = -wscvt.signed_distances(inside["spheres"][:, :3], made.vertices, made.faces)
    assert (depths >= radii).all()
    assert clump["rms_percent"] < inside["rms_percent"] < 20
    assert clump["options"]["count"] == 12
    with pytest.raises(wscvt.Error):
        wscvt.clump(made.vertices, made.faces, 0)
    # With an allowed error, a given number is the limit, as in the program.
    small = wscvt.create("ellipsoid", nodes=300, semi_axes=(3, 2, 1))
    loose = wscvt.clump(small, max_error=12.0)
    assert loose["rms_percent"] <= 12.0 and loose["sphere_count"] > 3
    assert wscvt.clump(small, 3, max_error=12.0)["sphere_count"] == 3


def test_describe_takes_its_ball_its_cut_off_and_a_progress():
    made = wscvt.create("ellipsoid", semi_axes=(1.0, 0.8, 0.6), nodes=2000)
    told = []
    usual, other = (wscvt.describe(made.vertices, made.faces, progress=lambda *now: told.append(now),
                                   **given)["descriptors"]
                    for given in ({}, {"roundness_ball": 0.5, "roughness_cutoff": 0.75}))
    assert told[-1][0] == 1.0
    assert other["roughness_cutoff"] == pytest.approx(0.75 * other["equivalent_diameter"] / 2)
    assert other["roughness_cutoff"] != usual["roughness_cutoff"]
    assert other["roundness_smallest_radius"] == pytest.approx(0.5 / 4, rel=1e-6)
    assert other["roundness_smallest_radius"] != usual["roundness_smallest_radius"]


def test_describe_takes_the_voxel_of_a_scan(tmp_path):
    z, y, x = np.mgrid[:28, :36, :40]
    labels = ((x - 20) ** 2 / 16 ** 2 + (y - 18) ** 2 / 14 ** 2 + (z - 14) ** 2 / 11 ** 2 < 1).astype(np.uint8)
    mesh = wscvt.extract(labels, 0.5)[1]
    wscvt.write_mesh(tmp_path / "grain.ply", *mesh)
    described = wscvt.describe(*mesh, voxel_size=0.5)
    subprocess.run([os.environ["WSCVT_PROGRAM"], "describe", "grain.ply", "--voxel-size", "0.5", "--report", "grain.json", "-q"],
                   cwd=tmp_path, check=True)
    told = json.loads((tmp_path / "grain.json").read_text())
    assert described["resolution"] == told["resolution"]
    assert "resolution" not in wscvt.describe(*mesh)
    with pytest.raises(wscvt.InputError, match="voxel"):
        wscvt.describe(*mesh, voxel_size=0.0)


def test_grains_of_an_engine_find_places_in_a_narrow_cylinder(tmp_path):
    subprocess.run([os.environ["WSCVT_PROGRAM"], "clump", MESHES / "sand_5658.ply", MESHES / "angular_6000.ply", "-k", "4",
                    "-o", "out", "--size", "0.02", "--engine", "lammps", "-q"], cwd=tmp_path, check=True)
    places = """
import json, sys, packing
scene = packing.Scene()
print(json.dumps([[*g.place, g.radius] for g in scene.grains] + [[scene.width]]))
"""
    described = json.loads((tmp_path / "out" / "scene.json").read_text())
    widest = None
    for times in (1.0, 1.55, 1.8, 2.1, 2.4, 4.0):
        described["container"] = {"shape": "cylinder", "width": times * widest if widest else 1.0}
        (tmp_path / "out" / "scene.json").write_text(json.dumps(described))
        said = subprocess.run(["/usr/bin/python3", "-c", places, "9"], cwd=tmp_path / "out", check=True, timeout=60,
                              text=True, stdout=subprocess.PIPE).stdout
        *grains, (width,) = json.loads(said)
        widest = widest or 2 * max(row[3] for row in grains)
        assert len(grains) == 9
        for k, (x, y, z, r) in enumerate(grains):
            assert math.hypot(x, y) + r <= width / 2 and z - r >= 0
            assert all(math.dist((x, y, z), other[:3]) > r + other[3] for other in grains[:k])


def test_create_cuts_the_series_where_told(tmp_path):
    # Degrees 0, 1 and 2, each with a size of its own.
    file = tmp_path / "series.dat"
    file.write_text("0 0 10 0\n1 -1 -0.1 0.2\n1 0 0.5 0\n1 1 0.1 0.2\n"
                    "2 -2 0.3 0\n2 -1 0 0.1\n2 0 0.4 0\n2 1 0 0.1\n2 2 0.3 0\n")
    shapes = [wscvt.create("harmonics", coefficients_file=str(file), degree=degree,
                           nodes=200).vertices for degree in (0, 1, 2, -1)]
    radii = np.linalg.norm(shapes[0], axis=1)
    np.testing.assert_allclose(radii, 10.0 / math.sqrt(4.0 * math.pi), rtol=1e-9)
    np.testing.assert_array_equal(shapes[2], shapes[3])
    for a, b in [(0, 1), (1, 2)]:
        assert np.abs(np.linalg.norm(shapes[a], axis=1).max() -
                      np.linalg.norm(shapes[b], axis=1).max()) > 0.01


def test_the_readme_works(scan, tmp_path, monkeypatch, capsys):
    readme = pathlib.Path(os.environ["WSCVT_README"]).read_text()
    code, = re.findall(r"```python\n(.*?)```", readme, re.S)
    monkeypatch.chdir(tmp_path)
    wscvt.write_mesh("scan.ply", *scan)
    exec(code, {})
    vertices, faces = wscvt.read_mesh("remesh.stl")
    assert len(faces) == 996
    assert len(capsys.readouterr().out.splitlines()) == 3
    assert "scan" in pathlib.Path("remesh.html").read_text()


def test_the_example_with_pictures_draws(tmp_path):
    pytest.importorskip("matplotlib")
    example = MESHES.parent / "lib" / "examples" / "pictures.py"
    assert len(example.read_text().splitlines()) <= 60
    subprocess.run([sys.executable, example, MESHES / "angular_6000.ply", tmp_path / "grains.png"],
                   check=True, cwd=tmp_path)
    assert (tmp_path / "grains.png").read_bytes()[1:4] == b"PNG"


def test_what_is_odd_about_a_file_is_a_warning(scan, tmp_path):
    file = tmp_path / "tail.stl"
    wscvt.write_mesh(str(file), *scan)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        whole = wscvt.read_mesh(str(file))
    with open(file, "ab") as stream:
        stream.write(b"\r\n")
    with pytest.warns(UserWarning, match="2 bytes behind its last triangle"):
        tail = wscvt.read_mesh(str(file))
    np.testing.assert_array_equal(tail[0], whole[0])
    assert ".pcd" in wscvt.read_mesh.__doc__ and ".msh" in wscvt.write_mesh.__doc__


def test_paths_are_paths_everywhere(scan, tmp_path):
    file = tmp_path / "scan.ply"
    wscvt.write_mesh(file, *scan)
    ours = wscvt.describe(file, reference=file)["descriptors"]["volume"]
    assert ours["error_percent"] == 0.0
    assert wscvt.describe(*scan, reference=TrimeshLike(*scan))["descriptors"]["volume"] == ours
    with pytest.raises(wscvt.Error) as refused:
        wscvt.describe(*scan, reference=tmp_path / "no.ply")
    assert refused.value.code == "input-output"
    with pytest.raises(FileNotFoundError):
        wscvt.read_mesh(tmp_path / "nowhere" / "no.ply")
    (tmp_path / "folder.ply").mkdir()
    with pytest.raises(OSError) as refused:
        wscvt.read_mesh(tmp_path / "folder.ply")
    assert not isinstance(refused.value, FileNotFoundError)
    coefficients = tmp_path / "sphere.json"
    with pytest.raises(wscvt.Error, match="sphere.json"):
        wscvt.create("harmonics", coefficients_file=coefficients, nodes=60)


def test_a_batch_is_its_grains_in_order_and_errors_are_results(scan, tmp_path):
    small = wscvt.remesh(*scan, nodes=400)
    for name in ("b.ply", "a.stl"):
        wscvt.write_mesh(tmp_path / name, small)
    (tmp_path / "c.ply").write_text("no mesh")
    (tmp_path / "notes.txt").write_text("no scan")
    found = dict(wscvt.batch(tmp_path, 60, threads=2, edge_ratio=1.2))
    assert list(found) == ["a", "b", "c"]
    assert found["c"].code == "input-output" and isinstance(found["c"], wscvt.Error)
    expected = wscvt.remesh(tmp_path / "b.ply", 60, edge_ratio=1.2)
    np.testing.assert_array_equal(found["b"].vertices, expected.vertices)
    assert found["b"].report["source"] == "b.ply"
    with pytest.raises(wscvt.Error, match="keep_scan"):
        found["b"].write_report(tmp_path / "page.html")
    named = {"one": (small.vertices, small.faces), "two": small}
    assert [name for name, _ in wscvt.batch(named, 60)] == ["one", "two"]
    assert [name for name, _ in wscvt.batch([tmp_path / "a.stl", small], nodes=60)] == ["a", "1"]
    assert [name for name, _ in wscvt.batch(tmp_path / "a.stl", 60)] == ["a"]
    with pytest.raises(TypeError, match="nodse"):
        list(wscvt.batch([small], nodse=60))


def test_a_batch_of_a_volume_is_that_of_the_program(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    z, y, x = np.indices((24, 24, 40)) + 0.5
    for name, radius in (("a", 7), ("b", 8)):
        volume = np.zeros((24, 24, 40), np.uint16)
        volume[(x - 10) ** 2 + (y - 12) ** 2 + (z - 12) ** 2 < radius ** 2] = 3
        volume[(x - 29) ** 2 + (y - 12) ** 2 + (z - 12) ** 2 < radius ** 2] = 4
        np.save(f"{name}.npy", volume)
    subprocess.run([os.environ["WSCVT_PROGRAM"], "batch", "a.npy", "b.npy", "-o", "program", "-q", "-n", "60",
                    "--voxel-size", "0.5", "--smoothing", "10"], check=True)
    counts = wscvt.batch(["a.npy", "b.npy"], 60, output="python", voxel_size=0.5, smoothing=10)
    assert counts == {"grains": 4, "failed": 0}
    names = sorted(path.name for path in pathlib.Path("program").iterdir())
    assert "a-3.ply" in names and "b-4.ply" in names and "labels.csv" in names
    assert sorted(path.name for path in pathlib.Path("python").iterdir()) == names
    for name in names:
        assert pathlib.Path("python", name).read_bytes() == pathlib.Path("program", name).read_bytes(), name
    # As VTK packs it: number and sizes of blocks, then the blocks, each in base64.
    packed = zlib.compress(volume.tobytes())
    data = b"".join(base64.b64encode(part) for part in (
        np.array([1, volume.nbytes, 0, len(packed)], "<u4").tobytes(), packed))
    pathlib.Path("b.vti").write_bytes(
        b'<VTKFile type="ImageData" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">'
        b'<ImageData WholeExtent="0 40 0 24 0 24" Origin="0 0 0" Spacing=".5 .5 .5"><Piece Extent="0 40 0 24 0 24">'
        b'<CellData><DataArray type="UInt16" Name="labels" format="binary">' + data +
        b"</DataArray></CellData></Piece></ImageData></VTKFile>")
    wscvt.batch("b.vti", 60, output="vti", smoothing=10)
    assert pathlib.Path("vti/4.ply").read_bytes() == pathlib.Path("python/b-4.ply").read_bytes()
    # The module has no library of this format; what it says was done above.
    pathlib.Path("a.tif").write_bytes(b"II*\0")
    with pytest.raises(OSError, match="as Python's module always is. Save the volume as .nrrd or .npy"):
        wscvt.batch(["a.tif"], 60, output="tiff")


def test_a_batch_into_a_folder_is_that_of_the_program(scan, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    small = wscvt.remesh(*scan, nodes=300)
    (tmp_path / "scans").mkdir()
    for name in ("a.ply", "b.stl"):
        wscvt.write_mesh(tmp_path / "scans" / name, small)
    (tmp_path / "scans" / "c.ply").write_text("no mesh")
    subprocess.run([os.environ["WSCVT_PROGRAM"], "batch", "scans", "-o", "program", "-q", "-n", "60,80",
                    "--describe", "remesh", "--frame", "principal", "--size", "2", "--node-table", "csv",
                    "--sdf", "npy", "--sdf-spacing", "0.2"], check=False)
    same = dict(describe="remesh", frame="principal", size=2.0, node_table=["csv"], sdf=["npy"],
                sdf_spacing=0.2)
    seen = []
    with pytest.warns(UserWarning, match="scans/c.ply"):
        counts = wscvt.batch("scans", [80, 60], output="python", threads=1,
                             progress=lambda fraction, stage: seen.append((fraction, stage)), **same)
    assert counts == {"grains": 3, "failed": 1}
    assert seen[-1][1].endswith(" of 3 grains")

    def files(folder):
        return {path.relative_to(folder): path.read_bytes()
                for path in pathlib.Path(folder).rglob("*") if path.is_file()}

    made = files("program")
    assert pathlib.Path("n60/sdf/b.npy") in made and pathlib.Path("n80/mass.csv") in made
    assert files("python") == made
    # It goes on where it was cut, and takes parts; a cancelled one stops.
    table = tmp_path / "python/n60/grains.csv"
    table.write_bytes(table.read_bytes()[:-40])
    with pytest.warns(UserWarning, match="c.ply"):
        wscvt.batch(["scans"], [60, 80], output="python", **same)
    assert files("python") == made
    for part in ("1/2", "2/2"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            wscvt.batch("scans", 60, output="parts", shard=part, describe="none")
    rows = sorted(row for part in (1, 2)
                  for row in (tmp_path / f"parts/grains-{part}-of-2.csv").read_text().splitlines()[1:])
    assert [row.split(",")[0] for row in rows] == ["scans/a.ply", "scans/b.stl", "scans/c.ply"]
    with pytest.raises(wscvt.Error, match="other options"):
        wscvt.batch("scans", [60, 80], output="python", describe="none")
    with pytest.raises(wscvt.Error, match="(?i)cancelled"):
        wscvt.batch("scans", 60, output="cancelled", progress=lambda fraction, stage: False)
    with pytest.raises(TypeError, match="nodse"):
        wscvt.batch("scans", output="wrong", nodse=60)


def test_clumps_and_parts_of_a_folder_are_those_of_the_program(scan, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scans").mkdir()
    small = wscvt.remesh(*scan, nodes=200)
    for name in ("a.ply", "b.ply"):
        wscvt.write_mesh(tmp_path / "scans" / name, small)
    for call in (["clump", "-k", "3", "--format", "molecule"],
                 ["convex", "-k", "2", "-n", "100", "--format", "urdf", "--frame", "principal"]):
        subprocess.run([os.environ["WSCVT_PROGRAM"], call[0], "scans", "-o", call[0], "-q", "--density", "2",
                        *call[1:]], check=True)
    for part in ("1/2", "2/2", "1/1"):
        wscvt.clump("scans", 3, output=f"clump{part[2:]}", shard=part, format="molecule", density=2.0)
        wscvt.convex(["scans"], count=2, nodes=100, output=f"convex{part[2:]}", shard=part, format="urdf",
                     density=2.0, frame="principal")
    for kind, ending in (("clump", "molecule"), ("convex", "urdf")):
        for name in ("grains.csv", "call.json", f"a.{ending}", f"b.{ending}"):
            made = (tmp_path / kind / name).read_bytes()
            assert (tmp_path / f"{kind}1" / name).read_bytes() == made, name
            if name.startswith(("a", "b")):
                assert (tmp_path / f"{kind}2" / name).read_bytes() == made, name
        assert (tmp_path / f"{kind}2" / "grains-2-of-2.csv").exists()
    with pytest.raises(wscvt.Error, match="other options"):
        wscvt.clump("scans", count=4, output="clump1", format="molecule", density=2.0)


def test_a_batch_reads_a_few_in_advance_and_ends_where_it_is_left(scan):
    asked = []

    def scans():
        for k in range(50):
            asked.append(k)
            yield scan

    for name, _ in wscvt.batch(scans(), 60, threads=1):
        if name == "2":
            break
    assert len(asked) <= 5


def test_extract_is_that_of_the_program(tmp_path):
    z, y, x = np.indices((24, 30, 40))
    labels = np.zeros((24, 30, 40), dtype=np.uint16)
    labels[(x - 12) ** 2 / 60 + (y - 14) ** 2 / 90 + (z - 11) ** 2 / 40 < 1] = 7
    labels[(x - 30) ** 2 + (y - 15) ** 2 + (z - 12) ** 2 < 50] = 300
    labels[:3, :6, :6] = 9  # at the border
    labels[:5, 20:26, 2:8] = 11  # at the border z = 0 only
    labels[12, 2, 12] = 4  # too small
    np.save(tmp_path / "labels.npy", labels)
    found = wscvt.extract(labels, 0.25)
    assert list(found) == [7, 300]
    subprocess.run([os.environ["WSCVT_PROGRAM"], "extract", tmp_path / "labels.npy", tmp_path / "out",
                    "--voxel-size", "0.25", "-q"], check=True)
    for label, mesh in found.items():
        its = wscvt.read_mesh(tmp_path / "out" / f"{label}.ply")
        np.testing.assert_array_equal(mesh[0], its[0])
        np.testing.assert_array_equal(mesh[1], its[1])
    stretched = wscvt.extract(np.asfortranarray(labels), (0.5, 1.0, 2.0), smoothing=0)
    assert volume(*stretched[300]) == pytest.approx((labels == 300).sum())
    assert np.ptp(stretched[300][0], axis=0) == pytest.approx([7.5, 15.0, 30.0])
    with pytest.warns(UserWarning, match="label 4: .*fewer passes by smoothing"):
        assert list(wscvt.extract(labels, at_border=True, smallest=1)) == [7, 9, 11, 300]
    assert list(wscvt.extract(labels, smallest=1, smoothing=0)) == [4, 7, 300]
    assert list(wscvt.extract(labels, background=7, at_border=True)) == [0, 9, 11, 300]


def test_what_extract_refuses_and_warns_of():
    labels = np.zeros((9, 20, 10), dtype=int)
    labels[2:7, 2:8, 2:8] = labels[2:5, 10:18, 2:8] = 3
    with pytest.warns(UserWarning, match="label 3 is in 2 pieces"):
        assert list(wscvt.extract(labels)) == [3]
    with pytest.raises(TypeError, match="no array of numbers"):
        wscvt.extract(labels.astype(str))
    with pytest.warns(UserWarning, match="25 times as long in one direction"):
        wscvt.extract(labels, (25, 1, 1), smallest=200)
    for given in [dict(labels=labels[0]), dict(labels=labels, smoothing=-1),
                  dict(labels=labels, voxel_size=0.0), dict(labels=labels, smallest=0),
                  dict(labels=0 * labels), dict(labels=labels[:0])]:
        with pytest.raises(wscvt.Error) as refused:
            wscvt.extract(**given)
        assert refused.value.code == "invalid-input"


def box_volumes(meshes):
    """The boxes of the grains in voxels, by their volume: other numbers of the same grains are equal."""
    return sorted((round(volume(*mesh)), *np.ptp(mesh[0], axis=0).round(6)) for mesh in meshes)


@pytest.mark.parametrize("case", ["uint8", "int16", ">i4", "int64", "float32", ">f8", "bool", "fortran", "ones",
                                  "nan", "minus one", "minus one is not given", "64 bits", "a half", "too large",
                                  "infinite", "channels", "frames", "half precision", "one image"])
def test_extract_of_an_array_takes_and_refuses_what_the_program_does(case, tmp_path):
    labels = np.zeros((12, 14, 16), dtype=np.int64)
    labels[2:8, 2:9, 2:10] = 1
    labels[3:10, 3:10, 11:15] = 2
    options = {}
    if case in ("uint8", "int16", ">i4", "int64", "float32", ">f8", "bool"):
        labels = labels.astype(case)
    elif case == "fortran":
        labels = np.asfortranarray(labels)
    elif case == "ones":
        labels = labels[..., np.newaxis]
    elif case == "nan":
        labels = np.where(labels == 0, np.nan, labels)
    elif case.startswith("minus one"):
        labels[labels == 0] = -1
        options = {} if case.endswith("given") else {"background": -1}
    elif case == "64 bits":
        labels[labels > 0] += 2 ** 40
    elif case == "a half":
        labels = labels + 0.5
    elif case == "too large":
        labels = labels * 1e12
    elif case == "infinite":
        labels = np.where(labels == 2, np.inf, labels)
    elif case == "channels":
        labels = np.stack([labels] * 2, axis=-1)
    elif case == "frames":
        labels = np.stack([labels] * 9)
    elif case == "half precision":
        labels = labels.astype(np.float16)
    elif case == "one image":
        labels = labels[5:6]
    np.save(tmp_path / "labels.npy", labels)
    call = [os.environ["WSCVT_PROGRAM"], "extract", "labels.npy", "out", "--smallest", "1", "--smoothing", "0"]
    call += [f"--background={value}" for value in options.values()]
    program = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True)
    refused = case in ("minus one is not given", "a half", "too large", "infinite", "channels", "frames",
                       "half precision", "one image")
    # A mask is in two parts, of which one is left out.
    assert program.returncode == (1 if refused else 3 if case == "bool" else 0), program.stderr
    if not refused:
        found = wscvt.extract(labels, smallest=1, smoothing=0, **options)
        its = [wscvt.read_mesh(file) for file in (tmp_path / "out").glob("*.ply")]
        assert box_volumes(found.values()) == box_volumes(its) and len(its) == (1 if case == "bool" else 2)
        numbers = np.unique(labels[np.isfinite(labels) & (labels > 0)])
        assert list(found) == list(numbers) and all(type(number) is int for number in found)
        return
    with pytest.raises(wscvt.InputError) as error:
        wscvt.extract(labels, smallest=1, smoothing=0, **options)
    if case in ("channels", "frames"):  # of an array, Python says how to take one
        taken = "labels[..., 0]" if case == "channels" else "labels[0]"
        assert taken in str(error.value)
        assert len(wscvt.extract(eval(taken), smallest=1)) == 2
    else:
        said = re.findall(r"holds \S+ at the voxel|0 on|whole numbers|one image|64 bits|grey values as float32",
                          program.stderr)
        assert said, program.stderr
        for text in said:
            assert text in str(error.value)


def test_labels_of_all_64_bits_and_labels_in_crumbs():
    labels = np.zeros((20, 20, 20), np.uint64)
    labels[3:9, 3:9, 3:9] = 2 ** 64 - 1
    labels[3:9, 3:9, 9:15] = 2 ** 63 + 5
    labels[3:9, 9:15, 3:9] = 7
    contacts = wscvt.fabric(labels)["contacts"]
    assert list(contacts["first"]) == [7, 2 ** 63 + 5] and list(contacts["second"]) == [2 ** 64 - 1] * 2
    crumbs = np.zeros((20, 20, 20), np.uint16)
    crumbs[3:7, 3:7, 3:7] = crumbs[10:14, 10:14, 10:14] = 1
    crumbs[3:9, 12:18, 3:9] = 2
    with pytest.warns(UserWarning, match="The label 1: The label is in 2 pieces, and the largest has too few"):
        assert list(wscvt.extract(crumbs)) == [2]


def test_a_point_that_is_not_finite_has_no_distance(scan):
    with pytest.raises(wscvt.Error, match="Point 1 is not finite"):
        wscvt.signed_distances([[0, 0, 0], [np.nan, 0, 0]], *scan)


def test_whole_numbers_stay_whole(scan, tmp_path):
    vertices = scan[0]
    labels = np.where(vertices[:, 0] > vertices[:, 0].mean(), 7, 2)
    remesh = wscvt.remesh(*scan, nodes=100)
    for kind in (np.int64, np.uint64, ">i4", np.int16, bool):
        given = (labels > 2) if kind is bool else labels.astype(kind)
        carried, _ = wscvt.carry_attributes(scan, remesh, {"label": given})
        assert set(carried["label"]) == set(np.unique(given).astype(int)), kind
        assert carried["label"].dtype.kind in "iu"
    carried, _ = wscvt.carry_attributes(scan, remesh, {"label": labels * 500_000_000})
    assert carried["label"].dtype == np.uint32
    with pytest.raises(wscvt.Error, match="beyond 32 bits"):
        wscvt.carry_attributes(scan, remesh, {"label": labels * 5_000_000_000})
    for wrong in (np.float32(60.9), np.array([60.9]), 60.5):
        with pytest.raises(TypeError):
            wscvt.remesh(*scan, nodes=wrong)
        with pytest.raises(TypeError):
            wscvt.clump(*scan, count=wrong)
        with pytest.raises(TypeError):
            wscvt.batch([], [wrong], output=tmp_path / "out")
    assert len(wscvt.remesh(*scan, nodes=np.uint8(60)).vertices) == 60


def test_a_file_is_not_replaced_by_what_cannot_be_read(scan, tmp_path):
    for name in ("w.ply", "w.stl", "w.ascii.stl"):
        wscvt.write_mesh(tmp_path / name, *scan)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    for name in ("grain id", "grain\nid", ""):
        with pytest.raises(wscvt.Error, match="name of PLY"):
            wscvt.write_mesh(tmp_path / "w.ply", *scan, vertex_attributes={name: np.zeros(len(scan[0]))})
    with pytest.raises(wscvt.Error, match="uses for the mesh"):
        wscvt.write_mesh(tmp_path / "w.ply", *scan, vertex_attributes={"x": np.zeros(len(scan[0]))})
    for name in ("w.stl", "w.ascii.stl"):
        with pytest.raises(wscvt.Error, match="only triangles"):
            wscvt.write_mesh(tmp_path / name, scan[0])
    assert before == {path.name: path.read_bytes() for path in tmp_path.iterdir()}


def test_a_batch_has_each_number_of_nodes_once(scan, tmp_path):
    wscvt.write_mesh(tmp_path / "a.ply", *scan)
    for nodes, said in (([60, 60], "twice"), ([], "is empty")):
        with pytest.raises(wscvt.Error, match=said) as refused:
            wscvt.batch(tmp_path / "a.ply", nodes, output=tmp_path / "out")
        assert refused.value.code == "invalid-input"
        assert not (tmp_path / "out").exists()


def test_signed_distances_are_exact_and_negative_inside():
    box = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 2.0) for z in (0.0, 3.0)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
             [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    points = [[0.5, 1.0, 1.0], [0.5, 1.0, 3.25], [4.0, 6.0, 3.0], [0.9, 1.0, 1.5]]
    wanted = [-0.5, 0.25, 5.0, -0.1]
    np.testing.assert_allclose(wscvt.signed_distances(points, box, faces), wanted, atol=1e-12)
    values, origin, spacing = wscvt.distance_grid(box, faces, 0.5)
    assert spacing == 0.5 and values.ndim == 3
    i, j, k = (np.array(values.shape) - [1, 2, 3]).clip(0)
    np.testing.assert_allclose(values[i, j, k], wscvt.signed_distances(
        [origin + spacing * np.array([i, j, k])], box, faces)[0], atol=1e-12)
    with pytest.raises(wscvt.Error, match="20000000|20 million|spacing"):
        wscvt.distance_grid(box, faces, 1e-4)


def test_node_table_and_files_of_a_result(scan, tmp_path):
    result = wscvt.remesh(*scan, nodes=60, source="sand")
    table = result.node_table()
    assert table.shape == (60,) and table.dtype.names == ("x", "y", "z", "nx", "ny", "nz", "area")
    np.testing.assert_array_equal(np.stack([table[k] for k in "xyz"], axis=1), result.vertices)
    assert table["area"].sum() == pytest.approx(result.report["descriptors"]["area"]["remesh"])
    larger = result.node_table(frame="principal", size=2.0)
    assert np.ptp(larger["x"]) > np.ptp(larger["y"]) > np.ptp(larger["z"])
    vertices, faces = result.in_frame("principal", size=2.0)
    np.testing.assert_array_equal(vertices, np.stack([larger[k] for k in "xyz"], axis=1))
    np.testing.assert_array_equal(faces, result.faces)
    np.testing.assert_array_equal(result.in_frame()[0], result.vertices)
    result.write_node_table(tmp_path / "nodes.csv", frame="principal", size=2.0)
    written = np.genfromtxt(tmp_path / "nodes.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(written["nz"], larger["nz"])

    result.write_signed_distances(tmp_path / "grid.npy", 0.2)
    grid = np.load(tmp_path / "grid.npy")
    np.testing.assert_allclose(grid, wscvt.distance_grid(*scan, 0.2)[0], atol=1e-9)
    result.write_signed_distances(str(tmp_path / "own.npy"), 0.2, surface="remesh")
    np.testing.assert_allclose(np.load(tmp_path / "own.npy"),
                               wscvt.distance_grid(result, spacing=0.2)[0], atol=1e-9)

    for name in ("report.html", "report.json", "report.csv"):
        result.write_report(tmp_path / name)
    assert json.loads((tmp_path / "report.json").read_text()) == result.report
    assert "sand" in (tmp_path / "report.html").read_text()
    bare = wscvt.remesh(*scan, nodes=60, keep_scan=False)
    bare.write_report(tmp_path / "bare.json")
    for write in [lambda: bare.write_report(tmp_path / "bare.html"),
                  lambda: bare.write_signed_distances(tmp_path / "bare.npy")]:
        with pytest.raises(wscvt.Error, match="keep_scan=True"):
            write()
    with pytest.raises(wscvt.Error, match="principal"):
        result.node_table(frame="no such")
    with pytest.raises(TypeError, match="in_frame"):
        wscvt.remesh(*scan, nodes=60, frame="principal")


def test_results_pickle(scan):
    result = wscvt.remesh(*scan, nodes=60, distances=True, source="sand")
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result))))
    for name in ("vertices", "faces", "centre", "radial_distances", "cell_areas", "vertex_distances"):
        np.testing.assert_array_equal(getattr(again, name), getattr(result, name))
    assert (again.report, again.warnings) == (result.report, result.warnings)
    assert (str(again), repr(again)) == (str(result), repr(result))
    np.testing.assert_array_equal(again.node_table(), result.node_table())
    for call in [lambda: again.write_report("page.html"), lambda: again.node_table(frame="principal"),
                 lambda: again.in_frame("centred"),
                 lambda: again.write_node_table("nodes.csv"), lambda: again.write_signed_distances("a.npy")]:
        with pytest.raises(wscvt.Error, match="before it is pickled"):
            call()


def test_a_repr_says_what_it_is(scan):
    text = repr(wscvt.remesh(*scan, nodes=60, source="sand"))
    assert text.startswith("<wscvt.Remesh of 60 nodes and 116 faces, of 'sand', rms distance ")
    assert text.endswith(" % of R, 1 warning>")
    assert "of ''" not in repr(wscvt.remesh(*scan, nodes=60))


def test_help_has_the_values_of_both_methods_and_says_whose_an_option_is():
    lines = help_of_options(wscvt.remesh)
    for name, values in (("weighting", ("wscvt-d", "constant", "area")), ("placement", ("fitted", "sh-surface")),
                         ("sampling", ("weighted", "fibonacci"))):
        assert all(f'"{value}"' in lines[name] for value in values), name
    scan, published = wscvt.options(), wscvt.options("as-published")
    assert set(lines) == {*scan, *published}
    for name, line in lines.items():
        having = [method for method, own in (("on-scan", scan), ("as-published", published)) if name in own]
        methods = re.findall(r"\((on-scan|as-published)\):", line)
        assert methods == (having if len(having) == 1 or name in ("weighting", "placement") else []), name
    assert lines["points"].startswith("True or False. Default: False. Ignore faces and build a star-shaped surface")
    assert "Measure distances from remesh to scan and back, and report them." in lines["distances"]
    # Options and defaults are those of the function.
    created, parts = help_of_options(wscvt.create), help_of_options(wscvt.convex)
    assert set(created) == set(lines) - {"points", "shrink_wrap", "max_repaired_area", "degree", "max_overhang", "handles",
                                         "max_handle_loop"}
    assert 'Default: "on-surface".' in created["placement"]
    assert set(parts) == {"nodes", "points", "shrink_wrap", "max_repaired_area", "handles", "max_handle_loop"}
    assert "Default: 500." in parts["nodes"]


def test_help_has_every_option_with_its_default():
    text = re.sub(r"\s+", " ", wscvt.remesh.__doc__.split("Options:")[1])
    for name, default in {**wscvt.options("as-published"), **wscvt.options()}.items():
        found = re.search(rf" {name}: (.*?) Default: (.*?)\. ", text)
        assert found, name
        shown = f'"{default}"' if isinstance(default, str) else str(default)
        assert found.group(2) in (shown, re.sub(r"\.0$", "", shown)), name


def test_a_notebook_shows_the_report(scan):
    result = wscvt.remesh(*scan, nodes=60, source="a <b>")
    frame = re.fullmatch(r'<iframe srcdoc="([^"]*)" title="([^"]*)" style="[^"]*"></iframe>',
                         result._repr_html_())
    page = html.unescape(frame.group(1))
    assert page.startswith("<!DOCTYPE html>") and 'id="views"' in page and "a &lt;b&gt;" in page
    assert html.unescape(frame.group(2)) == repr(result)
    for other in (pickle.loads(pickle.dumps(result)), wscvt.remesh(*scan, nodes=60, keep_scan=False)):
        assert html.unescape(other._repr_html_()) == f"<pre>{other}</pre>"


def test_a_plot_has_the_triangles(scan):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    result = wscvt.remesh(*scan, nodes=60)
    axes = result.plot()
    drawn = axes.collections[0]
    axes.figure.canvas.draw()
    assert len(drawn.get_facecolor()) == len(result.faces)
    low, high = result.vertices.min(axis=0), result.vertices.max(axis=0)
    for limits, a, b in zip((axes.get_xlim(), axes.get_ylim(), axes.get_zlim()), low, high):
        assert limits[0] <= a and limits[1] >= b
    assert result.plot(axes) is axes and len(axes.collections) == 2


def test_results_become_meshes_of_other_libraries(scan):
    result = wscvt.remesh(*scan, nodes=60)
    trimesh = pytest.importorskip("trimesh")
    mesh = result.to_trimesh()
    assert isinstance(mesh, trimesh.Trimesh) and mesh.is_watertight
    np.testing.assert_array_equal(mesh.vertices, result.vertices)
    np.testing.assert_array_equal(mesh.faces, result.faces)
    pytest.importorskip("pyvista")
    np.testing.assert_array_equal(result.to_pyvista().points, result.vertices)
    np.testing.assert_array_equal(result.to_pyvista().regular_faces, result.faces)


def test_the_stub_exports_what_the_module_does():
    stub = pathlib.Path(wscvt.__file__).with_name("__init__.pyi").read_text()
    listed = re.search(r"__all__ = (\[.*?\])", stub, re.S).group(1)
    assert sorted(ast.literal_eval(listed)) == sorted(wscvt.__all__)


def test_each_function_says_its_arguments():
    for name in wscvt.__all__:
        text = getattr(wscvt, name).__doc__
        assert text and len(text) > 60, name
    for name in ("remesh", "batch", "extract", "describe", "distance_grid"):
        for keyword in set(keywords_of_the_stub(name)) - set(wscvt.options()) - set(
                wscvt.options("as-published")):
            assert keyword in getattr(wscvt, name).__doc__, (name, keyword)


def test_extract_of_conforming_grains_shares_their_wall():
    z, y, x = np.mgrid[:40, :40, :50] + 0.5
    first = np.sqrt((x - 15) ** 2 + (y - 20) ** 2 + (z - 20) ** 2) - 12
    second = np.sqrt((x - 36) ** 2 + (y - 20.3) ** 2 + (z - 19.6) ** 2) - 12
    labels = np.where(np.minimum(first, second) > 0, 0, np.where(first < second, 3, 7))
    meshes = wscvt.extract(labels, conforming=True, nodes=150)
    assert sorted(meshes) == [3, 7]
    corners = []
    for vertices, faces in meshes.values():
        assert abs(len(vertices) - 150) < 15
        corners.append({tuple(sorted(map(tuple, vertices[face]))) for face in faces})
    assert len(corners[0] & corners[1]) > 10  # to the bit
    with pytest.raises(wscvt.Error, match="conforming=True"):
        wscvt.extract(labels, edge_length=3)


def test_a_copy_for_other_pythons_says_for_which(tmp_path):
    folder = pathlib.Path(wscvt.__file__).parent
    (tmp_path / "wscvt").mkdir()
    shutil.copy(folder / "__init__.py", tmp_path / "wscvt")
    (tmp_path / "wscvt" / "_wscvt.cpython-38-x86_64-linux-gnu.so").touch()
    ended = subprocess.run([sys.executable, "-c", "import wscvt"], capture_output=True, text=True, cwd=tmp_path,
                           env={**os.environ, "PYTHONPATH": ""})
    version = "{}.{}".format(*sys.version_info[:2])
    assert ended.returncode == 1 and f"no module for Python {version}. It has _wscvt.cpython-38-" in ended.stderr
    assert "pip install ./lib/python" in ended.stderr
