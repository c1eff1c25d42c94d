# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on in Blender without a window, on real grains.

    blender --background --factory-startup --python-exit-code 1 --python in_background.py -- ZIP MESHES
"""
import pathlib
import sys
import tempfile

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

ZIP, MESHES = (pathlib.Path(one).resolve() for one in sys.argv[sys.argv.index("--") + 1:])
bpy.ops.preferences.addon_install(filepath=str(ZIP), overwrite=True)
bpy.ops.preferences.addon_enable(module="wscvt_remesh")
import wscvt_remesh.wscvt as wscvt  # noqa: E402: of the zip


def empty_scene():
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.context.scene.wscvt.nodes = 200


def add_scan(file, matrix=Matrix(), name="grain"):
    vertices, faces = wscvt.read_mesh(MESHES / file)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    scanned = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(scanned)
    scanned.matrix_world = matrix
    scanned.select_set(True)
    bpy.context.view_layer.objects.active = scanned
    bpy.context.view_layer.update()
    return scanned


def world(one):
    """Vertices and triangles of an object, modifiers applied, where they are in the scene."""
    mesh = one.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    vertices = np.array([one.matrix_world @ v.co for v in mesh.vertices])
    mesh.calc_loop_triangles()
    faces = np.array([t.vertices for t in mesh.loop_triangles])
    return vertices, faces


def volume(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0


def remeshed():
    assert bpy.ops.object.remesh_grain_wscvt() == {"FINISHED"}
    return bpy.context.view_layer.objects.active


def test_a_grain_beside_its_hidden_scan():
    scanned = add_scan("sand_7228.ply")
    made = remeshed()
    assert len(made.data.vertices) == 200 and len(made.data.polygons) == 396
    assert scanned.hide_get() and scanned.hide_render and not made.hide_get()
    assert made.users_collection == scanned.users_collection
    assert bpy.context.selected_objects == [made]
    # It is the mesh of the module, in the single precision of Blender.
    vertices, faces = world(scanned)
    expected = wscvt.remesh(vertices, faces, 200)
    np.testing.assert_allclose(world(made)[0], expected.vertices, atol=1e-6)
    assert made["wscvt_nodes"] == 200 and made["wscvt_scan"] == "grain"
    assert abs(made["wscvt_volume"] / volume(vertices, faces) - 1.0) < 1e-6
    assert made["wscvt_rms_distance"] == expected.report["rms_distance"]["two_sided"]


def test_transforms_are_those_of_the_scan():
    parent = bpy.data.objects.new("parent", None)
    bpy.context.collection.objects.link(parent)
    parent.location = (1.0, 2.0, -3.0)
    scale = Matrix.Diagonal(Vector((2.0, -0.7, 1.3, 1.0)))  # a mirror, and another length each way
    scanned = add_scan("angular_6000.ply",
                       Matrix.Translation((5, 6, 7)) @ Euler((0.3, 0.8, -1.1)).to_matrix().to_4x4() @ scale)
    scanned.parent = parent
    bpy.context.view_layer.update()
    made = remeshed()
    bpy.context.view_layer.update()
    np.testing.assert_allclose(np.array(made.matrix_world), np.array(scanned.matrix_world), atol=1e-6)
    assert made.parent == parent
    # The determinant is below 0: in the scene faces look inward, of the scan and so of the remesh.
    ours, its = volume(*world(made)), volume(*world(scanned))
    assert its < 0.0 and abs(ours / its - 1.0) < 1e-5
    assert volume(np.array([v.co for v in made.data.vertices]),
                  np.array([p.vertices for p in made.data.polygons])) > 0.0
    # Even where it stands in the scene, not in the coordinates before the scale.
    vertices, faces = world(made)
    edges = np.linalg.norm(vertices[faces] - vertices[np.roll(faces, 1, axis=1)], axis=2)
    assert (edges.max(axis=1) / edges.min(axis=1)).mean() < 1.15


def test_modifiers_are_applied():
    scanned = add_scan("sand_7228.ply")
    scanned.modifiers.new("larger", "DISPLACE").strength = 0.3
    shown = volume(*world(scanned))
    made = remeshed()
    assert not made.modifiers
    assert abs(volume(*world(made)) / shown - 1.0) < 1e-5
    assert shown > 1.3 * volume(np.array([v.co for v in scanned.data.vertices]),
                                np.array([p.vertices for p in scanned.data.polygons]))


def test_materials_and_colours_are_kept():
    scanned = add_scan("sand_7228.ply")
    for name in ("below", "above"):
        scanned.data.materials.append(bpy.data.materials.new(name))
    for polygon in scanned.data.polygons:
        polygon.material_index = int(polygon.center.x > 0.1)
    away = Vector((2.0, 2.5, 3.0))
    height = scanned.data.color_attributes.new("height", "FLOAT_COLOR", "POINT")
    corner = scanned.data.color_attributes.new("corner", "FLOAT_COLOR", "CORNER")
    for k, vertex in enumerate(scanned.data.vertices):
        height.data[k].color = (*(vertex.co + away), 1.0)  # none is below 0
    for k, loop in enumerate(scanned.data.loops):
        corner.data[k].color = height.data[loop.vertex_index].color
    scanned.data.color_attributes.render_color_index = 1
    scanned.data.color_attributes.active_color_index = 0
    scanned.data.update()
    made = remeshed()
    assert [one.name for one in made.data.materials] == ["below", "above"]
    for polygon in made.data.polygons:
        if abs(polygon.center.x - 0.1) > 0.05:
            assert polygon.material_index == int(polygon.center.x > 0.1)
    assert made.data.color_attributes.render_color_index == 1
    assert made.data.color_attributes.active_color_index == 0
    for name in ("height", "corner"):
        carried = made.data.color_attributes[name]
        assert carried.domain == "POINT"
        # A colour that is the place is that of the nearest point of the scan.
        for k, vertex in enumerate(made.data.vertices):
            found, at, _, _ = scanned.closest_point_on_mesh(vertex.co)
            np.testing.assert_allclose(carried.data[k].color[:3], at + away, atol=1e-4)


def test_several_grains_and_one_that_is_none():
    names = []
    for k, file in enumerate(("sand_7228.ply", "angular_6000.ply")):
        names.append(add_scan(file, Matrix.Translation((3.0 * k, 0, 0)), f"grain {k}").name)
    bare = bpy.data.objects.new("bare", bpy.data.meshes.new("bare"))
    bpy.context.collection.objects.link(bare)
    bare.select_set(True)
    remeshed()
    assert sorted(one["wscvt_scan"] for one in bpy.context.selected_objects) == names
    assert not bare.hide_get()


def test_what_cannot_be_remeshed_is_an_error_with_its_reason():
    for prepare, part in [(lambda one: one.data.clear_geometry(), "no faces"),
                          (lambda one: setattr(one, "scale", (1.0, 0.0, 1.0)), "scale is 0")]:
        empty_scene()
        scanned = add_scan("sand_7228.ply")
        prepare(scanned)
        bpy.context.view_layer.update()
        try:
            bpy.ops.object.remesh_grain_wscvt()
        except RuntimeError as error:
            assert part in str(error), error
        else:
            raise AssertionError("It did not fail.")
        assert not scanned.hide_get() and len(bpy.data.objects) == 1


def test_parameters_reach_the_library():
    scanned = add_scan("sand_7228.ply")
    settings = bpy.context.scene.wscvt
    settings.weighting, settings.placement = "wscvt-c", "on-surface"
    settings.edge_ratio, settings.distances = 1.3, True
    vertices, faces = world(scanned)
    made = remeshed()
    expected = wscvt.remesh(vertices, faces, 200, weighting="wscvt-c", placement="on-surface",
                            edge_ratio=1.3, distances=True)
    np.testing.assert_allclose(world(made)[0], expected.vertices, atol=1e-6)
    found = [one.value for one in made.data.attributes["wscvt_distance"].data]
    np.testing.assert_allclose(found, expected.vertex_distances, atol=1e-6)
    shown = made.data.color_attributes.active_color
    assert shown.name == "wscvt_distance_colour" and shown.domain == "POINT"
    for distance, colour in zip(found, shown.data):
        red, green, blue, _ = colour.color
        assert abs(green - 1.0 + abs(distance) / np.abs(found).max()) < 1e-5
        assert red - blue == 0.0 or (red > blue) == (distance > 0.0)
    # A law sets what README.md's table says.
    settings.law = "wall"
    options = settings.options()
    assert (options["placement"], options["edge_ratio"], options["contact_radius"]) == ("contact-fit", 1.4, 5.0)


def test_results_are_saved_with_the_file():
    add_scan("sand_7228.ply")
    name = remeshed().name
    with tempfile.TemporaryDirectory() as folder:
        file = str(pathlib.Path(folder) / "scene.blend")
        bpy.ops.wm.save_as_mainfile(filepath=file)
        bpy.ops.wm.open_mainfile(filepath=file)
    assert bpy.data.objects[name]["wscvt_nodes"] == 200
    assert bpy.context.scene.wscvt.nodes == 200


def test_the_add_on_goes():
    bpy.ops.preferences.addon_disable(module="wscvt_remesh")
    assert not hasattr(bpy.types.Scene, "wscvt")
    bpy.ops.preferences.addon_enable(module="wscvt_remesh")
    assert bpy.context.scene.wscvt.nodes == 200  # the scene keeps it


TESTS = [(name, test) for name, test in list(globals().items()) if name.startswith("test_")]
for test_name, one_test in TESTS:
    empty_scene()
    one_test()
    print("passed:", test_name)
print(f"{len(TESTS)} tests passed in Blender {bpy.app.version_string}.")
