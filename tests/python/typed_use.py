# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses of the module for a type checker: mypy accepts all lines but those marked as errors.

    MYPYPATH=build/release/lib/python mypy --strict --warn-unused-ignores tests/python/typed_use.py
"""
import pathlib
from typing import Any, Dict, Iterator, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

import wscvt


class TrimeshLike:
    vertices = np.zeros((4, 3))
    faces = np.zeros((4, 3), dtype=int)


class PyVistaLike:
    points = np.zeros((4, 3))
    regular_faces = np.zeros((4, 3), dtype=int)


def progress(fraction: float, stage: str) -> Optional[bool]:
    return fraction < 0.5


def check(scan: pathlib.Path) -> None:
    vertices, faces = wscvt.read_mesh(scan)
    ours: npt.NDArray[np.float64] = vertices
    result: wscvt.Remesh = wscvt.remesh(ours, faces, nodes=500, edge_ratio=1.2, weighting="wscvt-d",
                                        progress=progress, keep_scan=False)
    wscvt.remesh("scan.ply", 500, weighting="WSCVT-C")
    wscvt.remesh(vertices, faces, 500)
    wscvt.remesh(scan, nodes=500)
    wscvt.remesh(TrimeshLike(), 500)
    wscvt.remesh(PyVistaLike(), 500)
    wscvt.remesh([[0.0, 0.0, 0.0]], None, points=True)
    areas: npt.NDArray[np.float64] = result.cell_areas
    report: Dict[str, Any] = result.report
    warnings: List[str] = result.warnings
    table = result.node_table(frame="principal", scale=2.0)
    result.write_report(scan.with_suffix(".html"))
    result.write_node_table("nodes.csv")
    result.write_signed_distances("grid.npy", 0.1, surface="remesh")
    made: Iterator[Tuple[str, Union[wscvt.Remesh, wscvt.Error]]] = wscvt.batch(scan, 500, threads=2)
    wscvt.batch({"one": (vertices, faces), "two": "scan.ply"}, alpha=0.5)
    wscvt.batch([scan, TrimeshLike()])
    counts: Dict[str, int] = wscvt.batch(scan, [100, 500], output="out", node_table=["csv"], shard="1/2")
    wscvt.batch([scan], 500, output=pathlib.Path("out"), frame="principal", alpha=0.5)
    for label, mesh in wscvt.extract(np.zeros((3, 3, 3), dtype=int), 0.5, smallest=10).items():
        wscvt.write_mesh(f"{label}.ply", *mesh)
    wscvt.segment(np.zeros((3, 3, 3)), 0.5, phases=1)["labels"]
    wscvt.fabric(np.zeros((3, 3, 3), dtype=int), (0.5, 0.5, 1.0), scan=np.zeros((3, 3, 3)))["contacts"]
    distances: npt.NDArray[np.float64] = wscvt.signed_distances(vertices, result)
    values, origin, spacing = wscvt.distance_grid(result, spacing=0.1)
    wscvt.describe(scan, reference=(vertices, faces), roundness_ball=0.1)
    wscvt.create("ellipsoid", semi_axes=(1.0, 2.0, 3.0), nodes=60, placement="sh-surface")
    wscvt.create("harmonics", coefficients_file=scan, degree=3)
    wscvt.clump(scan, 20, max_error=3.0)["spheres"]
    wscvt.convex(scan, 8, faces=60)
    wscvt.convex(vertices, faces, count=8, faces=60, max_error=1.0, nodes=300, handles="keep")
    grains: Dict[str, int] = wscvt.convex([scan], 4, output="out", shard="1/2")
    wscvt.fragment(result, 20, edge_length=0.1)
    try:
        pass
    except wscvt.Error as error:
        assert error.code == "cancelled"
    print(areas, report, warnings, table, made, grains, distances, values.shape, origin, spacing * 2.0)

    # Each line below is wrong in one way.
    wscvt.remesh(scan, nodse=500)  # type: ignore[call-arg]
    wscvt.remesh(scan, nodes="many")  # type: ignore[arg-type]
    wscvt.remesh(scan, weighting="area of cells")  # type: ignore[arg-type]
    wscvt.remesh(scan, progress=lambda fraction: True)  # type: ignore
    wscvt.batch(scan, 500, progress=progress)  # type: ignore[call-overload]
    wscvt.convex(scan, edge_ratio=1.2)  # type: ignore[call-overload]
    wscvt.create("ellipsoid", handles="keep")  # type: ignore[call-arg]
    wscvt.extract(vertices, "large")  # type: ignore[arg-type]
    result.node_table(frame="tilted")  # type: ignore[arg-type]
    result.vertices = vertices  # type: ignore[misc]
    result.noddes  # type: ignore[attr-defined]
