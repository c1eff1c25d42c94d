# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the sidebar of the 3D view: parameters, and results of the active object."""
import textwrap

import bpy

from . import grain, operator, settings


class GrainPanel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Grain"


class VIEW3D_PT_grain_settings(GrainPanel, bpy.types.Panel):
    bl_label = "Remesh Grain (WSCVT)"

    def draw(self, context):
        layout, manager = self.layout, context.window_manager
        if operator.MISSING:
            draw_text(layout, context, operator.MISSING, "ERROR")
            return
        if manager.wscvt_at_work:
            layout.label(text=manager.wscvt_at_work)
            layout.prop(manager, "wscvt_progress", slider=True)
            layout.label(text="Esc cancels", icon="CANCEL")
            return
        column = layout.column()
        for name in ("law", *settings.NAMES):
            if name in settings.CHOICES:
                # A narrow sidebar would cut off a label next to its choice.
                column.label(text=context.scene.wscvt.bl_rna.properties[name].name + ":")
                column.prop(context.scene.wscvt, name, text="")
            else:
                column.prop(context.scene.wscvt, name)
        count = sum(one.type == "MESH" for one in context.selected_objects)
        layout.operator(operator.OBJECT_OT_remesh_grain_wscvt.bl_idname, icon="MOD_REMESH",
                        text=f"Remesh {count} Grains" if count > 1 else "Remesh Grain")


class VIEW3D_PT_grain_result(GrainPanel, bpy.types.Panel):
    bl_label = "Result"

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and "wscvt_nodes" in context.active_object

    def draw(self, context):
        values = context.active_object
        self.layout.label(text=values["wscvt_scan"], icon="MESH_DATA")
        column = self.layout.column(align=True)
        for label, value, error in grain.rows(dict(values.items())):
            left = column.split(factor=0.4)
            left.label(text=label)
            right = left.split(factor=0.48) if error else left
            right.label(text=value)
            if error:
                right.label(text=error)
        for warning in values["wscvt_warnings"].splitlines():
            draw_text(self.layout, context, warning, "ERROR")


def draw_text(layout, context, text, icon):
    """Draws a text in lines as wide as the sidebar, because Blender does not wrap labels."""
    width = max(20, int(context.region.width / (7.0 * context.preferences.system.ui_scale)))
    column = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(text, width)):
        column.label(text=line, icon="NONE" if number else icon)


def draw_menu(menu, context):
    menu.layout.separator()
    menu.layout.operator(operator.OBJECT_OT_remesh_grain_wscvt.bl_idname, icon="MOD_REMESH")
