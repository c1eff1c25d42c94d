# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex parts, and what a scan carries."""
import json
import os
import pathlib
import subprocess
import sys
import warnings
import xml.etree.ElementTree

import numpy as np
import pytest

import wscvt

MESHES = pathlib.Path(os.environ["WSCVT_MESHES_DIR"])


def test_colours_and_labels_are_carried_and_kept_by_ply(tmp_path):
    scan = wscvt.create("ellipsoid", nodes=400, semi_axes=(1.3, 1.0, 0.8))
    vertices, faces = scan.vertices, scan.faces
    red = np.round(100 + 60 * vertices[:, 1]).astype(np.uint8)
    label = np.where(vertices[faces].mean(axis=1)[:, 2] > 0, 12, -7).astype(np.int32)
    path = tmp_path / "coloured.ply"
    wscvt.write_mesh(path, vertices, faces, vertex_attributes={"red": red}, face_attributes={"label": label})
    of_vertices, of_faces = wscvt.read_attributes(path)
    assert of_vertices["red"].dtype == np.uint8 and of_faces["label"].dtype == np.int32
    np.testing.assert_array_equal(of_vertices["red"], red)
    np.testing.assert_array_equal(of_faces["label"], label)
    remesh = wscvt.remesh(path, 150)
    carried, labels = wscvt.carry_attributes(path, remesh)
    # Rounded twice; the nearest point lies within the distance of the remesh, some hundredths.
    assert np.abs(carried["red"] - (100 + 60 * remesh.vertices[:, 1])).max() < 1 + 60 * 0.05
    assert set(np.unique(labels["label"])) == {-7, 12}
    with pytest.raises(wscvt.Error, match="Give one each"):
        wscvt.carry_attributes((vertices, faces), remesh, {"red": red[1:]})


def test_a_texture_becomes_colours(tmp_path):
    scan = wscvt.create("ellipsoid", nodes=300, semi_axes=(1.3, 1.0, 0.8))
    vertices, faces = scan.vertices, scan.faces
    # 40 x 30 pixels of a TGA from the top, blue, green and red of each.
    pixels = np.zeros((30, 40, 3), np.uint8)
    pixels[:, :, 2] = 10 + 5 * np.arange(40)
    pixels[:, :, 1] = 7 * np.arange(30)[:, None]
    pixels[:, :, 0] = 99
    places = np.c_[0.5 + 0.3 * vertices[:, 0], 0.5 + 0.4 * vertices[:, 1]]
    lines = ["mtllib a.mtl", "usemtl stone"]
    lines += ["v %.17g %.17g %.17g" % tuple(v) for v in vertices] + ["vt %.9g %.9g" % tuple(p) for p in places]
    lines += ["f " + " ".join("%d/%d" % (i + 1, i + 1) for i in face) for face in faces]
    path = tmp_path / "a.obj"
    path.write_text("\n".join(lines) + "\n")
    (tmp_path / "a.mtl").write_text("newmtl stone\nmap_Kd a.tga\n")
    remesh = wscvt.remesh(path, 100)
    with pytest.warns(UserWarning, match="a.tga"):
        carried, _ = wscvt.carry_attributes(path, remesh)
    assert not carried
    (tmp_path / "a.tga").write_bytes(bytes([0, 0, 2] + 9 * [0] + [40, 0, 30, 0, 24, 0x20]) + pixels.tobytes())
    with warnings.catch_warnings(record=True) as told:
        carried, _ = wscvt.carry_attributes(path, remesh)
    if any("libstb-dev" in str(warning.message) for warning in told):
        pytest.skip("built without pictures")
    assert not told
    own, _ = wscvt.read_attributes(path)
    # Each rounded; the nearest point lies within the distance of the remesh, some hundredths.
    for colours, points, within in ((own, vertices, 1), (carried, remesh.vertices, 1 + 84 * 0.05)):
        assert colours["red"].dtype == np.uint8 and set(colours) == {"red", "green", "blue"}
        column, row = 40 * (0.5 + 0.3 * points[:, 0]) - 0.5, 30 * (0.5 - 0.4 * points[:, 1]) - 0.5
        assert np.abs(colours["red"] - (10.0 + 5 * column)).max() < within
        assert np.abs(colours["green"] - 7.0 * row).max() < within
        assert (colours["blue"] == 99).all()


def test_convex_parts_hold_the_grain():
    parts, report = wscvt.convex(MESHES / "sand_5658.ply", count=2, nodes=150)
    assert len(parts) == report["parts"] == 2
    for vertices, faces in parts:
        assert vertices.shape[1] == 3 and len(faces) == 2 * len(vertices) - 4 and len(faces) <= 255
    assert 0 < report["rms_distance"] < report["largest_distance"]
    assert report["mass_properties"]["volume"] > 0 and abs(report["excess_volume_percent"]) < 1e-9
    with pytest.raises(wscvt.Error, match="number of parts"):
        wscvt.convex(MESHES / "sand_5658.ply", count=0, nodes=150)


def test_max_error_and_faces_are_those_of_the_parts(tmp_path):
    grain = wscvt.remesh(MESHES / "sand_5658.ply", 300)
    wscvt.write_mesh(tmp_path / "grain.ply", grain)
    subprocess.run([os.environ["WSCVT_PROGRAM"], "convex", tmp_path / "grain.ply", "-n", "100", "-q", "--max-error", "10",
                    "--faces", "40", "-o", tmp_path / "parts.obj", "--report", tmp_path / "parts.json"], check=True)
    # The triangles of the grain are not those of a part.
    parts, report = wscvt.convex(grain.vertices, grain.faces, nodes=100, max_error=10.0, faces=40)
    told = json.loads((tmp_path / "parts.json").read_text())
    assert report["parts"] == told["parts"] == len(parts) < 8
    assert all(len(faces) <= 40 for _, faces in parts)
    assert len(wscvt.convex(grain, 1, nodes=100)[0]) == 1
    for given in ({"edge_ratio": 1.2}, {"method": "as-published"}, {"sampling": "fibonacci"}, {"degree": 3},
                  {"distances": True}, {"frame": "principal"}):
        with pytest.raises(TypeError, match=f"There is no option {list(given)[0]} of convex"):
            wscvt.convex(grain, **given)


def test_files_for_engines_are_well_formed_and_name_their_parts(tmp_path):
    # Signs of markup, blanks and quotes in the name.
    stem = "a & b <c> \"d\" 'e'"
    subprocess.run([os.environ["WSCVT_PROGRAM"], "convex", MESHES / "sand_5658.ply", "-k", "2", "-n", "100", "-q",
                    "--density", "2650", "-o", tmp_path / (stem + ".urdf"), "-o", tmp_path / (stem + ".xml")], check=True)
    _, report = wscvt.convex(MESHES / "sand_5658.ply", count=2, nodes=100)
    mass = 2650 * report["mass_properties"]["volume"]
    robot = xml.etree.ElementTree.parse(tmp_path / (stem + ".urdf")).getroot()
    assert robot.get("name") == stem
    assert float(robot.find("link/inertial/mass").get("value")) == pytest.approx(mass, rel=1e-9)
    names = [mesh.get("filename") for mesh in robot.iterfind("link/collision/geometry/mesh")]
    assert names == [f"{stem}_1.obj", f"{stem}_2.obj"]
    assert all((tmp_path / name).stat().st_size > 0 for name in names)
    body = xml.etree.ElementTree.parse(tmp_path / (stem + ".xml")).getroot().find("worldbody/body")
    assert body.get("name") == stem
    assert float(body.find("inertial").get("mass")) == pytest.approx(mass, rel=1e-9)
    assert len(body.findall("geom")) == 2


def test_the_packing_of_level_sets_has_the_grains(tmp_path, monkeypatch):
    """The body of packing.py is the whole mesh, in the unit of the files, with its hollows."""
    subprocess.run([os.environ["WSCVT_PROGRAM"], "batch", MESHES / "sand_5658.ply", "-n", "200", "--scale", "2", "-q", "-o",
                    tmp_path, "--engine", "yade"], check=True)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "argv", ["run.py", "1"])
    sys.modules.pop("packing", None)
    import packing
    grain = packing.Scene().grains[0]
    sys.modules.pop("packing")
    (vertices, faces), = grain.parts()
    volume = np.linalg.det(vertices[faces] - grain.place).sum() / 6
    assert grain.shape.volume == pytest.approx(volume, rel=1e-6)
    assert grain.mass == pytest.approx(2650 * volume, rel=1e-6)
    points = grain.place + np.random.RandomState(1).uniform(-1, 1, (20000, 3)) * grain.radius
    share = volume / (2 * grain.radius) ** 3
    deviation = np.sqrt(share * (1 - share) / len(points))
    assert packing.is_inside(grain.parts(), points).mean() == pytest.approx(share, abs=4 * deviation)


def test_the_packing_of_rounded_parts_has_the_parts(tmp_path, monkeypatch):
    """packing.py of an engine's folder takes the parts of a Rockable shape out to their planes again."""
    program = os.environ["WSCVT_PROGRAM"]
    scans = tmp_path / "scans"
    scans.mkdir()
    (scans / "a grain.ply").write_bytes((MESHES / "angular_6000.ply").read_bytes())
    read = {}
    for engine in "rockable", "bullet":
        folder = tmp_path / engine
        subprocess.run([program, "convex", scans, "-k", "3", "-n", "200", "--faces", "40", "--size", "2", "-q", "-o",
                        folder, "--engine", engine], check=True)
        monkeypatch.syspath_prepend(folder)
        sys.modules.pop("packing", None)
        import packing
        monkeypatch.setattr(sys, "argv", ["run.py", "5"])
        scene = packing.Scene()
        assert len(scene.grains) == 5 and scene.grains[0].shape.name == "a grain"
        read[engine] = scene.grains[0].shape
    sys.modules.pop("packing")
    rounded, plain = read["rockable"], read["bullet"]
    assert 0 < rounded.rounding < 0.06 and plain.rounding == 0
    assert len(rounded.parts) == len(plain.parts) == 3
    for (vertices, faces), (corners, triangles) in zip(rounded.parts, plain.parts):
        np.testing.assert_array_equal(faces, triangles)
        a, b, c = (corners[triangles[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        # The planes come back, not the corners: of more than three faces one corner is not in all planes (seen here
        # are .12 and .028 of the sphere).
        off = np.abs(np.einsum("fi,fki->fk", normals, vertices[triangles] - corners[triangles]))
        assert off.max() < 0.15 * rounded.rounding and np.sqrt(np.mean(off ** 2)) < 0.03 * rounded.rounding
