# SPDX-License-Identifier: GPL-3.0-or-later
"""Fragments of a grain."""
import os
import pathlib

import numpy as np
import pytest

import wscvt

GRAIN = pathlib.Path(os.environ["WSCVT_MESHES_DIR"]) / "sand_5658.ply"


def volume_of(vertices, faces):
    a, b, c = (vertices[faces[:, k]] - vertices[0] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def test_fragments_fill_the_grain():
    whole = volume_of(*wscvt.read_mesh(GRAIN))
    fragments, report = wscvt.fragment(GRAIN, 9)
    assert len(fragments) == 9
    volumes = [volume_of(*one) for one in fragments]
    # Rounding of thousands of terms.
    np.testing.assert_allclose(volumes, report["volume"], rtol=1e-10)
    assert sum(volumes) == pytest.approx(whole, rel=1e-12)
    contacts = report["contacts"]
    assert len(contacts["fragments"]) == len(contacts["area"]) == len(contacts["normal"]) > 8
    for (first, second), normal in zip(contacts["fragments"], contacts["normal"]):
        assert normal @ (report["centroid"][second] - report["centroid"][first]) > 0
        shared = set(map(bytes, fragments[first][0])) & set(map(bytes, fragments[second][0]))
        assert len(shared) >= 3, "the corners of the wall, to the bit"


def test_volumes_and_points_steer_the_sizes():
    _, report = wscvt.fragment(GRAIN, count=3, volumes=[1, 2, 3])
    np.testing.assert_allclose(report["volume"] / report["volume"][0], [1, 2, 3], rtol=3e-3)
    vertices, faces = wscvt.read_mesh(GRAIN)
    _, report = wscvt.fragment(vertices, faces, 30, near=vertices[100], seed=4)
    away = np.linalg.norm(report["centroid"] - vertices[100], axis=1)
    assert report["volume"][away.argmax()] > 5 * report["volume"][away.argmin()]
    one, report = wscvt.fragment(vertices, faces, 1)
    assert len(one) == 1 and len(report["contacts"]["area"]) == 0


def test_remeshed_fragments_share_walls():
    grain = wscvt.remesh(GRAIN, 1000)
    whole = volume_of(grain.vertices, grain.faces)
    fragments, report = wscvt.fragment(grain, count=5, nodes=120)
    volumes = [volume_of(*one) for one in fragments]
    np.testing.assert_allclose(volumes, report["volume"], rtol=1e-10)
    assert sum(volumes) == pytest.approx(whole, rel=1e-10)
    corners = [{vertices[face].tobytes() for face in np.sort(faces)}
               for vertices, faces in fragments]
    for (first, second), area in zip(report["contacts"]["fragments"], report["contacts"]["area"]):
        if area > 0.01:
            assert corners[first] & corners[second], "triangles of the wall, to the bit"
    assert all(abs(len(vertices) - 120) < 30 for vertices, _ in fragments)
    by_edge, _ = wscvt.fragment(grain, count=5, edge_length=0.3)
    assert len(by_edge[0][0]) < 120


def test_wrong_arguments_are_refused():
    for wrong in ({"count": 0}, {"count": 1001}, {"count": 2, "volumes": [1]},
                  {"nodes": 100, "edge_length": 1}, {"edge_length": -1}):
        with pytest.raises(wscvt.Error):
            wscvt.fragment(GRAIN, **wrong)
    with pytest.raises(wscvt.Error, match="one of them"):
        wscvt.fragment(GRAIN, count=1, volumes=[1], near=[0, 0, 0])
