# SPDX-License-Identifier: GPL-3.0-or-later
"""The parameters of the panel, one set per scene, and the progress of the work."""
import bpy
from bpy.props import (BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty,
                       StringProperty)

from . import grain

NAMES = ("nodes", "edge_ratio", "weighting", "placement", "contact_radius", "shrink_wrap", "distances")
CHOICES = ("law", "weighting", "placement")


def set_by_law(self, context):
    """Sets what the contact law needs. Each can be changed afterwards."""
    self.placement, self.edge_ratio, self.contact_radius = grain.LAWS[self.law][2:]


class GrainSettings(bpy.types.PropertyGroup):
    nodes: IntProperty(
        name="Nodes", default=1000, min=4, max=1000000, soft_max=20000,
        description="Exact number of nodes of the remesh")
    law: EnumProperty(
        name="Contact law", default="triangles", update=set_by_law,
        items=[(key, name, text) for key, (name, text, *_) in grain.LAWS.items()],
        description="What touches in the simulation. Sets the placement, the edge ratio and the ball radius")
    weighting: EnumProperty(
        name="Weighting", items=grain.WEIGHTINGS, default="wscvt-d",
        description="Where the Voronoi cells are smaller")
    placement: EnumProperty(
        name="Nodes are", items=grain.PLACEMENTS, default="fitted",
        description="Where the nodes are put")
    edge_ratio: FloatProperty(
        name="Edge ratio", default=1.1, min=1.08, max=1.6, precision=3, step=1,
        description="Mean of longest / shortest edge of the triangles. Larger values give a smaller "
                    "distance to the scan and less even triangles")
    contact_radius: FloatProperty(
        name="Ball radius", default=0.4, min=0.01, max=100.0, precision=2,
        description="Of the contact fit, in equivalent radii")
    shrink_wrap: FloatProperty(
        name="Shrink-wrap", default=0.0, min=0.0, max=50.0, precision=1, subtype="PERCENTAGE",
        description="Remesh the outer surface of a porous or faulty scan. Pores narrower than this are "
                    "closed. In % of the bounding-box diagonal. 0: off")
    distances: BoolProperty(
        name="Distances to the scan", default=False,
        description="Measure the distance of each node to the scan, as the attribute wscvt_distance "
                    "of the result, and show it in red outside and blue inside")

    def options(self):
        """The settings as arguments of wscvt.remesh."""
        values = {name: getattr(self, name) for name in NAMES}
        # Blender stores single precision: 1.1 is 1.10000002.
        return {name: round(value, 6) if isinstance(value, float) else value
                for name, value in values.items()}


def add():
    bpy.types.Scene.wscvt = PointerProperty(type=GrainSettings)
    # In the window manager, to keep them out of the file and of undo.
    bpy.types.WindowManager.wscvt_progress = FloatProperty(
        name="Progress", min=0.0, max=100.0, subtype="PERCENTAGE")
    bpy.types.WindowManager.wscvt_at_work = StringProperty()


def remove():
    del bpy.types.WindowManager.wscvt_at_work
    del bpy.types.WindowManager.wscvt_progress
    del bpy.types.Scene.wscvt
