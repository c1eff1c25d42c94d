# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths are in the unit of the mesh. Whatever the library refuses or cannot do raises Error."""
from typing import Any, Callable, Literal, Optional, Tuple

import numpy as np
import numpy.typing as npt

__version__: str
__all__ = ["Error", "Remesh", "create", "describe", "options", "read_mesh", "remesh", "write_mesh"]

Vertices = npt.ArrayLike
"""(n, 3), numbers."""
Faces = npt.ArrayLike
"""(m, 3), whole numbers: indices of vertices, counted from 0, counter-clockwise from outside."""
Progress = Callable[[float, str], Optional[bool]]
"""Gets the share of the work done, 0 to 1, and the stage; False cancels, and so does an exception."""

class Error(RuntimeError):
    code: Literal["invalid-input", "not-star-shaped", "numerical-failure", "input-output", "cancelled"]

class Remesh:
    @property
    def vertices(self) -> npt.NDArray[np.float64]: ...  # (N, 3), length
    @property
    def faces(self) -> npt.NDArray[np.int32]: ...  # (2 N - 4, 3), counter-clockwise from outside
    @property
    def centre(self) -> npt.NDArray[np.float64]: ...  # (3,), length
    @property
    def radial_distances(self) -> npt.NDArray[np.float64]: ...  # (N,), length, from the centre
    @property
    def cell_areas(self) -> npt.NDArray[np.float64]: ...  # (N,), length^2
    @property
    def vertex_distances(self) -> npt.NDArray[np.float64]: ...  # (N,), length; of distances=True
    @property
    def warnings(self) -> list[str]: ...
    @property
    def report(self) -> dict[str, Any]: ...  # as the JSON report

def options() -> dict[str, Any]: ...
def remesh(
    vertices: Vertices,
    faces: Optional[Faces],
    *,
    threads: int = ...,
    progress: Optional[Progress] = ...,
    source: str = ...,
    nodes: int = ...,
    method: Literal["on-scan", "as-published"] = ...,
    target: float = ...,
    target_measure: Literal["volume", "area", "sphericity", "inertia", "distance"] = ...,
    largest: int = ...,
    sampling: Literal["weighted", "fibonacci", "equal-angle", "icosahedron"] = ...,
    weighting: Literal["constant", "radial-distance", "curvature", "area", "error-adaptive"] = ...,
    alpha: float = ...,
    curvature_source: Literal["series", "quadrics"] = ...,
    adaptive_exponent: float = ...,
    degree: int = ...,
    parametrization: Literal["auto", "radial", "spherical"] = ...,
    fold_limit: float = ...,
    points: bool = ...,
    metric: Literal["sphere", "surface"] = ...,
    placement: Literal["series", "scan", "least-squares"] = ...,
    refuse_self_intersections: bool = ...,
    refine: int = ...,
    refine_angle: float = ...,
    refine_tolerance: float = ...,
    seed_start: Literal["multilevel", "warped-lattice", "random"] = ...,
    seed: int = ...,
    iterations: int = ...,
    tolerance: float = ...,
    area_tolerance: float = ...,
    acceleration: bool = ...,
    over_relaxation: float = ...,
    coarsest_seeds: int = ...,
    coarsest_tolerance: float = ...,
    middle_tolerance: float = ...,
    distances: bool = ...,
    distance_samples: int = ...,
    advice: bool = ...,
    weld_tolerance: float = ...,
    mend_limit: float = ...,
    dropped_volume: float = ...,
    handle_length: float = ...,
) -> Remesh: ...
def create(
    surface: Literal["ellipsoid", "superellipsoid", "harmonics"],
    *,
    semi_axes: Tuple[float, float, float] = ...,
    polar_exponent: float = ...,
    azimuthal_exponent: float = ...,
    coefficients_file: str = ...,
    coefficient_degree: int = ...,
    threads: int = ...,
    progress: Optional[Progress] = ...,
    nodes: int = ...,
    method: Literal["on-scan", "as-published"] = ...,
    target: float = ...,
    target_measure: Literal["volume", "area", "sphericity", "inertia", "distance"] = ...,
    largest: int = ...,
    sampling: Literal["weighted", "fibonacci", "equal-angle", "icosahedron"] = ...,
    weighting: Literal["constant", "radial-distance", "curvature", "area", "error-adaptive"] = ...,
    alpha: float = ...,
    curvature_source: Literal["series", "quadrics"] = ...,
    adaptive_exponent: float = ...,
    degree: int = ...,
    parametrization: Literal["auto", "radial", "spherical"] = ...,
    fold_limit: float = ...,
    points: bool = ...,
    metric: Literal["sphere", "surface"] = ...,
    placement: Literal["series", "scan", "least-squares"] = ...,
    refuse_self_intersections: bool = ...,
    refine: int = ...,
    refine_angle: float = ...,
    refine_tolerance: float = ...,
    seed_start: Literal["multilevel", "warped-lattice", "random"] = ...,
    seed: int = ...,
    iterations: int = ...,
    tolerance: float = ...,
    area_tolerance: float = ...,
    acceleration: bool = ...,
    over_relaxation: float = ...,
    coarsest_seeds: int = ...,
    coarsest_tolerance: float = ...,
    middle_tolerance: float = ...,
    distances: bool = ...,
    distance_samples: int = ...,
    advice: bool = ...,
    weld_tolerance: float = ...,
    mend_limit: float = ...,
    dropped_volume: float = ...,
    handle_length: float = ...,
) -> Remesh: ...
def describe(
    vertices: Vertices,
    faces: Faces,
    reference: Optional[Tuple[Vertices, Faces]] = ...,
    *,
    roundness_degree: int = ...,
    roughness_degree: int = ...,
    threads: int = ...,
    progress: Optional[Progress] = ...,
) -> dict[str, Any]: ...
def read_mesh(path: str) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]: ...
def write_mesh(path: str, vertices: Vertices, faces: Faces) -> None: ...
