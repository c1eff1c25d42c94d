# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender add-on: remeshes scans of grains to an exact number of nodes."""
bl_info = {
    "name": "Remesh Grain (WSCVT)",
    "description": "Remeshes scans of grains to an exact number of nodes",
    "author": "The maintainers of wscvt",
    "version": (3, 0, 0),
    "blender": (3, 4, 0),
    "location": "Object > Remesh Grain (WSCVT), sidebar > Grain",
    "category": "Object",
}

import bpy  # noqa: E402: Blender wants bl_info first

from . import operator, panel, settings  # noqa: E402

CLASSES = (settings.GrainSettings, operator.OBJECT_OT_remesh_grain_wscvt,
           panel.VIEW3D_PT_grain_settings, panel.VIEW3D_PT_grain_result)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    settings.add()
    bpy.types.VIEW3D_MT_object.append(panel.draw_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(panel.draw_menu)
    settings.remove()
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
