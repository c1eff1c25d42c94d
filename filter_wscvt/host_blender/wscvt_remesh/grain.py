# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's code without Blender: options, work in a thread, rows of results, transfers."""
import threading

import numpy as np

# Values of the library's options, with label and tooltip.
WEIGHTINGS = (
    ("wscvt-d", "WSCVT-D", "Cells of equal area"),
    ("wscvt-c", "WSCVT-C", "Smaller cells where the surface bends"),
)
PLACEMENTS = (
    ("fitted", "Fitted", "Triangles closest to the scan, exactly its volume. Nodes are near the surface"),
    ("on-surface", "On the surface", "Nodes on the scan, for contact laws that sum over nodes"),
    ("contact-fit", "Contact fit", "Nodes for contact laws that use the deepest node"),
)
# README.md's settings by contact law: placement, edge ratio and contact radius of each.
LAWS = {
    "triangles": ("Triangles, or shape only", "The triangles themselves touch", "fitted", 1.1, 0.4),
    "areas": ("Sum over the nodes", "A sum over nodes, weighted by their areas", "on-surface", 1.1, 0.4),
    "surface": ("Deepest node, surface", "The deepest node against the other grain's surface",
                "contact-fit", 1.4, 0.4),
    "nodes": ("Deepest node of both", "The deepest of the nodes of both grains", "contact-fit", 1.4, 1.3),
    "wall": ("Deepest node, wall", "The deepest node against a flat wall", "contact-fit", 1.4, 5.0),
}
FORM = (  # descriptors in the panel, in this order
    "volume", "area", "sphericity_wadell", "aspect_ratio_inertia",
    "axis_s_inertia", "axis_i_inertia", "axis_l_inertia")


class Job:
    """A remesh in its own thread. `result` or `error` is set when it is done."""

    def __init__(self, remesh, vertices, faces, options):
        self.fraction = 0.0
        self.result = None
        self.error = None
        self._cancelled = False
        self._thread = threading.Thread(
            target=self._run, args=(remesh, vertices, faces, options), daemon=True)
        self._thread.start()

    def _run(self, remesh, vertices, faces, options):
        try:
            self.result = remesh(vertices, faces, progress=self._progress, **options)
        except Exception as error:  # any error: the operator reports it
            self.error = error

    def _progress(self, fraction, stage):
        self.fraction = fraction
        return not self._cancelled

    def cancel(self):
        """Asks the work to stop soon. `error` is then set by the library."""
        self._cancelled = True

    def is_done(self):
        return not self._thread.is_alive()

    def wait(self):
        self._thread.join()


def scale_and_rotation(matrix):
    """Returns rotation and scale (3, 3) of a matrix (4, 4). Raises ValueError if a scale is 0."""
    linear = np.array(matrix, dtype=float)[:3, :3]
    lengths = np.linalg.norm(linear, axis=0)
    if lengths.min() == 0.0 or abs(np.linalg.det(linear)) < 1e-9 * lengths.prod():
        raise ValueError("The object's scale is 0 along an axis. Give it another scale.")
    return linear


def transformed(vertices, faces, linear):
    """Transforms vertices and faces by a matrix (3, 3). A mirror reverses faces, to keep them outward."""
    vertices = vertices @ linear.T
    return vertices, faces[:, ::-1] if np.linalg.det(linear) < 0.0 else faces


def corner_weights(points, corners):
    """Returns barycentric weights (n, 3), 0 to 1, of points (n, 3) on triangles with corners (n, 3, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    square = np.einsum("ij,ij->i", normal, normal)
    flat = square == 0.0  # such triangles use their first corner
    square[flat] = 1.0
    weight_b = np.einsum("ij,ij->i", np.cross(points - a, c - a), normal) / square
    weight_c = np.einsum("ij,ij->i", np.cross(b - a, points - a), normal) / square
    weight_b[flat] = weight_c[flat] = 0.0
    weights = np.clip(np.stack([1.0 - weight_b - weight_c, weight_b, weight_c], axis=1), 0.0, 1.0)
    return weights / weights.sum(axis=1, keepdims=True)


def distance_colours(distances):
    """Returns colours (n, 4) of signed distances (n,): red outside, blue inside, white at 0."""
    largest = np.abs(distances).max(initial=0.0)
    shares = distances / largest if largest > 0.0 else distances
    lost = np.stack([np.maximum(-shares, 0.0), np.abs(shares), np.maximum(shares, 0.0)], axis=1)
    return np.column_stack([1.0 - lost, np.ones(len(shares))])


def properties(report):
    """Returns the custom properties of a result: numbers and texts by name."""
    values = {
        "wscvt_scan": report["source"],
        "wscvt_made_by": report["made_by"],
        "wscvt_nodes": report["result"]["vertices"],
        "wscvt_rms_distance": report["rms_distance"]["two_sided"],
        "wscvt_rms_distance_percent": report["rms_distance"]["percent_of_equivalent_radius"],
        "wscvt_smallest_angle": report["quality"]["remesh"]["smallest_angle_degrees"],
        "wscvt_mean_edge_ratio": report["quality"]["remesh"]["edge_ratio"]["mean"],
        "wscvt_warnings": "\n".join(report["warnings"]),
    }
    for key, row in report["descriptors"].items():
        values[f"wscvt_{key}"] = row["remesh"]
        values[f"wscvt_{key}_error_percent"] = row["error_percent"]
    return {name: value for name, value in values.items() if value is not None}


def percent(value):
    if abs(value) < 1e-9:
        return "exact"
    text = f"{value:+.2f} %"
    return text.lstrip("+-") if abs(value) < 0.005 else text


def rows(values):
    """Returns the panel's rows for a result's properties: label, value, error."""
    found = [
        ("Nodes", str(values["wscvt_nodes"]), ""),
        ("RMS dist.", f"{values['wscvt_rms_distance_percent']:.2f} % of radius", ""),
        ("Min. angle", f"{values['wscvt_smallest_angle']:.1f}\N{DEGREE SIGN}", ""),
    ]
    labels = {"volume": "Volume", "area": "Area", "sphericity_wadell": "Sphericity",
              "aspect_ratio_inertia": "S/L", "axis_s_inertia": "Axis S",
              "axis_i_inertia": "Axis I", "axis_l_inertia": "Axis L"}
    for key in FORM:
        if f"wscvt_{key}" in values:
            error = values.get(f"wscvt_{key}_error_percent")
            found.append((labels[key], f"{values[f'wscvt_{key}']:.4g}",
                          "" if error is None else percent(error)))
    return found
