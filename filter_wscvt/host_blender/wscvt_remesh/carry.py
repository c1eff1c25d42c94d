# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes between Blender and arrays, with the materials and colours of a scan."""
import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from . import grain


class Scan:
    """The mesh of an object with its modifiers applied, as arrays that outlive it.

    vertices (n, 3) and triangles (m, 3) are in the object's own coordinates. Raises ValueError if
    the object has no faces.
    """

    def __init__(self, context, scanned):
        evaluated = scanned.evaluated_get(context.evaluated_depsgraph_get())
        mesh = evaluated.to_mesh()
        try:
            self._read(mesh)
        finally:
            evaluated.to_mesh_clear()
        if len(self.triangles) == 0:
            raise ValueError("The object has no faces. Choose a mesh that is closed.")

    def _read(self, mesh):
        mesh.calc_loop_triangles()
        self.vertices = read(mesh.vertices, "co", 3, np.float32).astype(float)
        self.triangles = read(mesh.loop_triangles, "vertices", 3, np.int32)
        self._loops = read(mesh.loop_triangles, "loops", 3, np.int32)
        self._materials = read(mesh.polygons, "material_index", 1, np.int32)[
            read(mesh.loop_triangles, "polygon_index", 1, np.int32)]
        self._colours = [
            (colours.name, colours.data_type, colours.domain, read(colours.data, "color", 4, np.float32))
            for colours in mesh.color_attributes]
        self._shown_colours = mesh.color_attributes.active_color_index
        self._rendered_colours = mesh.color_attributes.render_color_index

    def carry_to(self, mesh):
        """Sets a mesh's material indices and colours from the nearest points of the scan."""
        if not self._colours and not self._materials.any():
            return  # building the tree of a large scan takes seconds
        tree = BVHTree.FromPolygons(self.vertices.tolist(), self.triangles.tolist())
        points = read(mesh.vertices, "co", 3, np.float32)
        if self._colours:
            at, triangles = nearest(tree, points)
            weights = grain.corner_weights(at, self.vertices[self.triangles[triangles]])
            for name, data_type, domain, values in self._colours:
                corners = (self.triangles if domain == "POINT" else self._loops)[triangles]
                carried = np.einsum("ij,ijk->ik", weights, values[corners])
                mesh.color_attributes.new(name, data_type, "POINT").data.foreach_set(
                    "color", carried.astype(np.float32).ravel())
            mesh.color_attributes.active_color_index = self._shown_colours
            mesh.color_attributes.render_color_index = self._rendered_colours
        if self._materials.any():
            corners = read(mesh.polygons, "vertices", 3, np.int32)
            _, triangles = nearest(tree, points[corners].mean(axis=1))
            mesh.polygons.foreach_set("material_index", self._materials[triangles])


def read(collection, name, width, kind):
    """Returns an attribute of all items: (n, width), or (n,) for a width of 1."""
    values = np.empty(len(collection) * width, dtype=kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def nearest(tree, points):
    """Returns the nearest points (n, 3) of a surface and their triangles (n,)."""
    found = [tree.find_nearest(point)[::2] for point in points.tolist()]
    return np.array([at for at, _ in found]), np.array([triangle for _, triangle in found])


def add_result(context, scanned, scan, result, linear, wants_distances):
    """Adds the remesh at the place of its scan, hides the scan, and returns the new object."""
    vertices, faces = grain.transformed(result.vertices, result.faces, np.linalg.inv(linear))
    name = f"{scanned.name} {len(vertices)} nodes"
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    for material in scanned.data.materials:
        mesh.materials.append(material)
    scan.carry_to(mesh)
    if wants_distances:
        mesh.attributes.new("wscvt_distance", "FLOAT", "POINT").data.foreach_set(
            "value", result.vertex_distances.astype(np.float32))
        colours = mesh.color_attributes.new("wscvt_distance_colour", "FLOAT_COLOR", "POINT")
        colours.data.foreach_set(
            "color", grain.distance_colours(result.vertex_distances).astype(np.float32).ravel())
        mesh.color_attributes.active_color = colours
    mesh.update()

    made = bpy.data.objects.new(name, mesh)
    for collection in scanned.users_collection:
        collection.objects.link(made)
    made.parent = scanned.parent
    made.matrix_parent_inverse = scanned.matrix_parent_inverse
    made.matrix_world = scanned.matrix_world
    for key, value in grain.properties(result.report).items():
        made[key] = value
    scanned.hide_set(True)
    scanned.hide_render = True
    return made
