# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the Blender add-on that needs no Blender."""
import importlib.util
import os
import pathlib
import threading

import numpy as np
import pytest

import wscvt

MESHES = pathlib.Path(os.environ["WSCVT_MESHES_DIR"])
FILE = MESHES.parent / "filter_wscvt" / "host_blender" / "wscvt_remesh" / "grain.py"
SPEC = importlib.util.spec_from_file_location("grain", FILE)
grain = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(grain)

CORNERS = np.array([[[1.0, 0.0, 2.0], [4.0, 1.0, 0.0], [0.0, 3.0, 5.0]]])


def test_the_choices_are_those_of_the_library():
    for name, choices in (("weighting", grain.WEIGHTINGS), ("placement", grain.PLACEMENTS)):
        for key, _, _ in choices:
            report = wscvt.create("ellipsoid", nodes=60, **{name: key}).report
            assert report["options"][name] == key


def test_laws_have_the_settings_of_the_readme():
    text = (MESHES.parent / "README.md").read_text()
    for law, row in {"surface": "the deepest node against the other grain's surface",
                     "nodes": "the deepest of the nodes of both grains",
                     "wall": "the deepest node against a flat wall",
                     "areas": "a sum over nodes, weighted by their areas",
                     "triangles": "the triangles themselves, or only shape and volume"}.items():
        placement, edge_ratio, radius = grain.LAWS[law][2:]
        words = [f"--edge-ratio {edge_ratio}"] if edge_ratio != 1.1 else []
        words += [f"-p {placement}"] if placement != "fitted" else []
        words += [f"--contact-radius {radius:g}"] if radius != 0.4 else []
        options = f"`{' '.join(words)}`" if words else "the defaults"
        assert f"\n| {row} | {options} |" in text


def test_distances_are_red_outside_and_blue_inside():
    colours = grain.distance_colours(np.array([2.0, 0.0, -1.0]))
    np.testing.assert_allclose(colours, [[1, 0, 0, 1], [1, 1, 1, 1], [0.5, 0.5, 1, 1]])
    np.testing.assert_array_equal(grain.distance_colours(np.zeros(2)), np.ones((2, 4)))


def test_weights_are_barycentric():
    wanted = np.array([[0.2, 0.3, 0.5], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.6, 0.4]])
    corners = np.repeat(CORNERS, len(wanted), axis=0)
    points = np.einsum("ij,ijk->ik", wanted, corners)
    np.testing.assert_allclose(grain.corner_weights(points, corners), wanted, atol=1e-12)


def test_weights_off_a_triangle_and_of_a_flat_one_are_shares():
    weights = grain.corner_weights(CORNERS[:, 0] - 5.0, CORNERS)
    assert weights.min() >= 0.0 and weights.sum() == pytest.approx(1.0)
    flat = np.array([[[1.0, 2.0, 3.0], [1.0, 2.0, 3.0], [4.0, 0.0, 1.0]]])
    np.testing.assert_array_equal(grain.corner_weights(flat[:, 0], flat), [[1.0, 0.0, 0.0]])


def test_a_mirror_turns_faces():
    vertices, faces = CORNERS[0], np.array([[0, 1, 2]])
    for scale, order in ((np.diag([2.0, 1.0, 3.0]), [0, 1, 2]), (np.diag([2.0, -1.0, 3.0]), [2, 1, 0])):
        moved, turned = grain.transformed(vertices, faces, scale)
        np.testing.assert_array_equal(moved, vertices * np.diag(scale))
        np.testing.assert_array_equal(turned, [order])


def test_a_scale_of_0_is_refused():
    matrix = np.diag([2.0, 1e-3, 5.0, 1.0])
    matrix[:3, 3] = 7.0
    np.testing.assert_array_equal(grain.scale_and_rotation(matrix), matrix[:3, :3])
    matrix[1, 1] = 0.0
    with pytest.raises(ValueError, match="scale is 0"):
        grain.scale_and_rotation(matrix)


def test_a_job_ends_with_a_result_or_an_error():
    scan = wscvt.read_mesh(MESHES / "sand_7228.ply")
    job = grain.Job(wscvt.remesh, *scan, {"nodes": 60})
    job.wait()
    assert job.is_done() and len(job.result.vertices) == 60 and job.fraction == 1.0
    failed = grain.Job(wscvt.remesh, *scan, {"nodes": 2})
    failed.wait()
    assert failed.result is None and failed.error.code == "invalid-input"


def test_a_job_is_cancelled():
    begun, go_on = threading.Event(), threading.Event()

    def work(vertices, faces, progress):
        begun.set()
        go_on.wait(10.0)
        return progress(0.5, "stage")

    job = grain.Job(work, None, None, {})
    begun.wait(10.0)
    assert not job.is_done()
    job.cancel()
    go_on.set()
    job.wait()
    assert job.result is False and job.fraction == 0.5


def test_properties_and_rows_say_what_the_report_says():
    report = wscvt.remesh(MESHES / "sand_7228.ply", 60).report
    values = grain.properties(report)
    assert all(isinstance(value, (int, float, str)) for value in values.values())
    assert values["wscvt_area_error_percent"] == report["descriptors"]["area"]["error_percent"]
    assert values["wscvt_warnings"].splitlines() == report["warnings"]
    rows = {label: (value, error) for label, value, error in grain.rows(values)}
    assert rows["Volume"] == (f"{report['descriptors']['volume']['remesh']:.4g}", "exact")
    assert rows["Area"][1] == f"{report['descriptors']['area']['error_percent']:+.2f} %"
    assert rows["Nodes"][0] == "60" and len(rows) == 10
