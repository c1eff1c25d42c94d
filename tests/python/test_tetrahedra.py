# SPDX-License-Identifier: GPL-3.0-or-later
"""Tetrahedra in a remesh."""
import importlib.util
import os
import pathlib
import subprocess
import sys

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


def test_a_packing_shares_its_walls(remesh, tmp_path):
    # Two boxes of voxels that touch, and one apart.
    labels = np.zeros((12, 12, 34), np.uint8)
    labels[2:10, 2:10, 2:10] = 4
    labels[2:10, 2:10, 10:20] = 7
    labels[2:10, 2:10, 24:32] = 9
    grains = wscvt.extract(labels, conforming=True, at_border=True)
    file = tmp_path / "packing.msh"
    body = wscvt.tetrahedra(grains, output=file)
    points, corners, of = body["vertices"], body["tetrahedra"], body["bodies"]
    assert set(of) == {4, 7, 9}
    volumes = volumes_of(points, corners)
    assert (volumes > 0).all()
    # The meshes have the volumes of the voxels but for rounding.
    for label, count in ((4, 512), (7, 640), (9, 512)):
        assert volumes[of == label].sum() == pytest.approx(count, rel=1e-9)
    shared = set(corners[of == 4].ravel()) & set(corners[of == 7].ravel())
    assert len(shared) > 3
    assert len(body["faces"]) < sum(len(faces) for _, faces in grains.values())
    assert '"wall_4_7"' in file.read_text()


def test_cohesive_elements_join_the_faces_of_two_grains(remesh, tmp_path):
    labels = np.zeros((12, 12, 24), np.uint8)
    labels[2:10, 2:10, 2:10] = 4
    labels[2:10, 2:10, 10:20] = 7
    common, apart = tmp_path / "common.inp", tmp_path / "apart.inp"
    wscvt.tetrahedra(wscvt.extract(labels, conforming=True), output=common)
    example = pathlib.Path(__file__).parents[2] / "lib" / "examples" / "cohesive.py"
    subprocess.run([sys.executable, example, common, apart], check=True)
    spec = importlib.util.spec_from_file_location("cohesive", example)
    cohesive = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(cohesive)
    places, bodies, surfaces = cohesive.read(apart)
    at = {node: np.array([float(x) for x in place.split(",")]) for node, place in places.items()}
    joints = bodies.pop("joints_4_7").values()
    assert len(joints) == len(surfaces["wall_4_7"])
    below, above = ({node for element in bodies[name].values() for node in element}
                    for name in ("grain_4", "grain_7"))
    assert not below & above and below | above == set(at)
    for corners in joints:
        first, second = corners[:3], corners[3:]
        assert set(first) <= below and set(second) <= above
        for one, other in zip(first, second):
            np.testing.assert_array_equal(at[one], at[other])
        a, b, c = (at[node] for node in first)
        # The second grain is on the side of larger x.
        assert np.cross(b - a, c - a)[0] > 0


def test_fragments_are_numbered_as_their_files(remesh):
    pieces, _ = wscvt.fragment(remesh, count=3, nodes=60)
    body = wscvt.tetrahedra(pieces)
    volumes = volumes_of(body["vertices"], body["tetrahedra"])
    for k, (points, faces) in enumerate(pieces, 1):
        a, b, c = (points[faces[:, n]] - points[0] for n in range(3))
        whole = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        assert volumes[body["bodies"] == k].sum() == pytest.approx(whole, rel=1e-9)


def test_what_is_refused(remesh, tmp_path):
    with pytest.raises(wscvt.InputError, match=r"\.vtu"):
        wscvt.tetrahedra(remesh, output=tmp_path / "body.stl")
    with pytest.raises(wscvt.InputError, match="edge"):
        wscvt.tetrahedra(remesh, edge_length=-1.0)
    with pytest.raises(wscvt.Error):
        wscvt.tetrahedra(remesh.vertices, remesh.faces[1:])
    assert not list(tmp_path.iterdir())
