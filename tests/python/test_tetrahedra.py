# SPDX-License-Identifier: GPL-3.0-or-later
"""Tetrahedra in a remesh."""
import os
import pathlib

import numpy as np
import pytest

import wscvt

GRAIN = pathlib.Path(os.environ["WSCVT_MESHES_DIR"]) / "angular_6000.ply"


@pytest.fixture(scope="module")
def remesh():
    result = wscvt.remesh(GRAIN, 120)
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
