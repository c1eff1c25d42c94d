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


ANGULAR = pathlib.Path(os.environ["WSCVT_MESHES_DIR"]) / "angular_6000.ply"


@pytest.fixture(scope="module")
def remesh():
    result = wscvt.remesh(ANGULAR, 120)
    try:
        wscvt.tetrahedra(result)
    except wscvt.InputError as error:
        if "Gmsh" in str(error):
            pytest.skip(str(error))
        raise
    return result


def volumes_of(points, corners):
    a, b, c, d = (points[corners[:, k]] for k in range(4))
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6


def angles_of(points, corners):
    """The dihedral angles of each tetrahedron, by the heights over its edges."""
    angles = []
    for i, j, k, l in ((0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 0, 2), (2, 3, 0, 1)):
        a, b, c, d = (points[corners[:, n]] for n in (i, j, k, l))
        along = (b - a) / np.linalg.norm(b - a, axis=1)[:, None]
        c, d = (x - a - np.einsum("ij,ij->i", x - a, along)[:, None] * along for x in (c, d))
        cosines = np.einsum("ij,ij->i", c, d) / np.linalg.norm(c, axis=1) / np.linalg.norm(d, axis=1)
        angles.append(np.degrees(np.arccos(cosines)))
    return np.array(angles)


def test_tetrahedra_fill_the_remesh_and_keep_it(remesh, tmp_path):
    file = tmp_path / "body.vtu"
    body = wscvt.tetrahedra(remesh, output=file)
    points, corners = body["vertices"], body["tetrahedra"]
    np.testing.assert_array_equal(points[:120], remesh.vertices)
    np.testing.assert_array_equal(body["faces"], remesh.faces)
    volumes = volumes_of(points, corners)
    assert (volumes > 0).all()
    # Rounding of some hundred terms.
    assert volumes.sum() == pytest.approx(remesh.report["descriptors"]["volume"]["remesh"], rel=1e-12)
    angles = angles_of(points, corners)
    assert body["smallest_dihedral_degrees"] == pytest.approx(angles.min(), rel=1e-9)
    assert body["largest_dihedral_degrees"] == pytest.approx(angles.max(), rel=1e-9)
    pairs = {tuple(sorted((t[i], t[j]))) for t in corners.tolist() for i in range(4) for j in range(i)}
    edges = [np.linalg.norm(points[a] - points[b]) for a, b in pairs]
    assert body["mean_edge"] == pytest.approx(np.mean(edges), rel=1e-12)
    assert f'NumberOfCells="{len(corners)}"' in file.read_text()


def test_a_shorter_edge_gives_more_tetrahedra(remesh):
    usual = wscvt.tetrahedra(remesh)
    finer = wscvt.tetrahedra(remesh.vertices, remesh.faces, edge_length=usual["mean_edge"] / 2)
    assert len(finer["tetrahedra"]) > 2 * len(usual["tetrahedra"])
    assert finer["mean_edge"] < usual["mean_edge"]


def test_what_is_refused(remesh, tmp_path):
    with pytest.raises(wscvt.InputError, match=r"\.vtu"):
        wscvt.tetrahedra(remesh, output=tmp_path / "body.stl")
    with pytest.raises(wscvt.InputError, match="edge"):
        wscvt.tetrahedra(remesh, edge_length=-1.0)
    with pytest.raises(wscvt.Error):
        wscvt.tetrahedra(remesh.vertices, remesh.faces[1:])
    assert not list(tmp_path.iterdir())
