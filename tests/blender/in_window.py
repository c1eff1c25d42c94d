# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on in a real window: Esc cancels, progress is shown, undo works; with a picture of the panel.

    xvfb-run blender --factory-startup --python in_window.py -- ZIP SCAN PICTURE
"""
import os
import pathlib
import subprocess
import sys
import time
import traceback

import bpy

ZIP, SCAN, PICTURE = (pathlib.Path(one).resolve() for one in sys.argv[sys.argv.index("--") + 1:])
bpy.ops.preferences.addon_install(filepath=str(ZIP), overwrite=True)
bpy.ops.preferences.addon_enable(module="wscvt_remesh")
import wscvt_remesh  # noqa: E402: of the zip
import wscvt_remesh.wscvt as wscvt  # noqa: E402


def view():
    """The 3D view, for what is called as from there."""
    window = bpy.context.window_manager.windows[0]
    area = next(one for one in window.screen.areas if one.type == "VIEW_3D")
    region = next(one for one in area.regions if one.type == "WINDOW")
    return dict(window=window, area=area, region=region)


def click(x, y):
    """Clicks at a place counted from the lower left corner of the window, as Blender counts."""
    height = view()["window"].height
    subprocess.run(["xdotool", "mousemove", str(x), str(height - y), "click", "1"], check=True)


def prepare():
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    vertices, faces = wscvt.read_mesh(SCAN)
    mesh = bpy.data.meshes.new(SCAN.stem)
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    mesh.materials.append(bpy.data.materials.new("sand"))
    scanned = bpy.data.objects.new(SCAN.stem, mesh)
    bpy.context.scene.collection.objects.link(scanned)
    bpy.context.view_layer.objects.active = scanned
    scanned.select_set(True)
    place = view()
    space = place["area"].spaces.active
    space.show_region_ui = True
    space.overlay.show_wireframes = True
    space.region_3d.view_distance = 5.0
    bpy.ops.ed.undo_push(message="The scan is there")
    return scanned.name


def draws_of_the_panel():
    """Counts how often the panel is drawn, which it is only when its tab is open."""
    panel, drawn = wscvt_remesh.panel.VIEW3D_PT_grain_settings, []
    draw = panel.draw

    def counting(self, context):
        drawn.append(context.window_manager.wscvt_progress)
        draw(self, context)

    panel.draw = counting
    return drawn


def steps():
    """The test; each yield lets Blender work for so many seconds."""
    yield 1.0
    name = prepare()
    drawn = draws_of_the_panel()
    yield 1.0
    sidebar = next(one for one in view()["area"].regions if one.type == "UI")
    for y in range(sidebar.y + sidebar.height - 20, sidebar.y, -25):
        if drawn:
            break
        click(sidebar.x + sidebar.width - 8, y)
        yield 0.5
    assert drawn, "The tab of the panel was not found."

    # Esc, in the midst of the work.
    settings = bpy.context.scene.wscvt
    settings.nodes = 50000
    with bpy.context.temp_override(**view()):
        assert bpy.ops.object.remesh_grain_wscvt("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield from until(lambda: max(drawn) > 5.0)  # the panel shows how far the work is
    assert bpy.context.window_manager.wscvt_at_work == f"Grain 1 of 1: {name}"
    subprocess.run(["xdotool", "mousemove", "300", "300", "key", "Escape"], check=True)
    yield from until(lambda: not bpy.context.window_manager.wscvt_at_work)
    assert list(bpy.data.objects.keys()) == [name] and not bpy.data.objects[name].hide_get()

    # Of two grains, the second in the midst of its work: the first stays.
    settings.nodes = 500
    second = bpy.data.objects[name].copy()
    second.name = "second"
    bpy.context.scene.collection.objects.link(second)
    second.modifiers.new("finer", "SUBSURF").levels = 4  # takes seconds
    second.select_set(True)
    with bpy.context.temp_override(**view()):
        bpy.ops.object.remesh_grain_wscvt("INVOKE_DEFAULT")
    yield from until(lambda: len(bpy.data.objects) == 3)  # the first is there
    subprocess.run(["xdotool", "key", "Escape"], check=True)
    yield from until(lambda: not bpy.context.window_manager.wscvt_at_work)
    made = next(one for one in bpy.data.objects if "wscvt_nodes" in one)
    assert made["wscvt_scan"] == name and len(bpy.data.objects) == 3
    assert bpy.data.objects[name].hide_get() and not second.hide_get()
    for one in (made, second):
        bpy.data.objects.remove(one)
    bpy.data.objects[name].hide_set(False)
    bpy.data.objects[name].select_set(True)
    bpy.context.view_layer.objects.active = bpy.data.objects[name]
    bpy.ops.ed.undo_push(message="The scan is there again")

    # To the end.
    settings.nodes = 1000
    with bpy.context.temp_override(**view()):
        bpy.ops.object.remesh_grain_wscvt("INVOKE_DEFAULT")
    yield from until(lambda: len(bpy.data.objects) == 2)
    yield 1.0
    assert bpy.data.objects[name].hide_get()
    with bpy.context.temp_override(**view()):
        bpy.ops.screen.screenshot(filepath=str(PICTURE))
    yield 0.5

    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo()
    yield 0.5
    assert list(bpy.data.objects.keys()) == [name], "Undo did not take the result away."
    assert not bpy.data.objects[name].hide_get(), "Undo did not show the scan again."


def until(is_so):
    before = time.monotonic()
    while not is_so():
        assert time.monotonic() - before < 120.0, "It took more than two minutes."
        yield 0.05


def run(work):
    try:
        return next(work)
    except StopIteration:
        print("The window's test passed.", flush=True)
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        with bpy.context.temp_override(**view()):
            bpy.ops.screen.screenshot(filepath=str(PICTURE.with_name("failed.png")))
        os._exit(1)


the_steps = steps()
bpy.app.timers.register(lambda: run(the_steps), first_interval=1.0)
