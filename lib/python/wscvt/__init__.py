# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshing of scanned grains to an exact number of nodes.

>>> import wscvt
>>> result = wscvt.remesh("scan.ply", 1000)
>>> result.vertices.shape, result.faces.shape
((1000, 3), (1996, 3))

A mesh is two arrays (vertices, faces) or a pair of them, the path of a file, or a mesh of trimesh or
PyVista. Lengths are in the unit of the mesh. The stub next to this file lists the arguments, results and errors of
each function.
"""
import collections
import concurrent.futures
import html
import itertools
import numbers
import os
import pathlib
import re
import sys
import tempfile
import textwrap
import threading

import numpy

try:
    from ._wscvt import (Error, FileError, InputError, MissingFileError, Remesh, __version__,
                         options)
except ModuleNotFoundError:
    raise ImportError(
        "This copy of wscvt has no module for Python {}.{}. It has {}. Use a Python of these, or build the module with yours "
        "in a clone of wscvt: pip install ./lib/python".format(*sys.version_info[:2], ", ".join(
            sorted(file.name for file in pathlib.Path(__file__).parent.glob("_wscvt.*"))) or "none")) from None
from . import _wscvt

__all__ = ["Error", "FileError", "InputError", "MissingFileError", "Remesh", "batch",
           "carry_attributes", "clump", "convex", "create", "describe", "distance_grid", "extract",
           "fabric", "fragment", "grow", "options", "read_attributes", "read_mesh", "read_table", "remesh",
           "sample", "segment", "signed_distances", "templates", "tetrahedra", "write_mesh"]


def _refuse_masked(argument, value):
    """Raises InputError for an array with a mask, also in a pair or a dictionary."""
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, tuple) else (value,)
    if any(numpy.ma.is_masked(part) for part in parts):
        raise InputError(f"The argument {argument} is a masked array, whose mask would be lost. Give "
                         f"{argument}.filled(VALUE), with the value for what is masked.")


def _call(function, /, *arguments, **options):
    """Calls a function of _wscvt. pybind11's own message about a wrong argument prints whole arrays."""
    name = function.__name__.strip("_").replace("_files", "")
    signature = function.__doc__.partition("\n")[0]
    known = re.findall(r"(\w+): ", signature)
    for option in options:
        if option not in known and "**kwargs" not in signature:
            raise TypeError(f"There is no option {option} of {name}. help(wscvt.{name}) lists the options.")
    for argument, value in [*zip(known, arguments), *options.items()]:
        _refuse_masked(argument, value)
    try:
        return function(*arguments, **options)
    except TypeError as error:
        if "incompatible function arguments" not in str(error):
            raise
    types = ", ".join(f"{argument} is {type(value).__name__}"
                      for argument, value in [*zip(known, arguments), *options.items()])
    raise TypeError(f"An argument of {name} has a wrong type: {types}. help(wscvt.{name}) says what they are.")


def _faces_before(name, number, faces, options):
    """Adds a given number to the options and returns the faces: f("scan.ply", 500) means
    f("scan.ply", None, 500)."""
    if isinstance(faces, numbers.Integral) and number is None:
        faces, number = None, faces
    if number is not None:
        options[name] = number
    return faces


def _along_axes(voxel_size):
    """Returns a voxel's size along x, y and z, of one length or of three."""
    return (voxel_size,) * 3 if isinstance(voxel_size, numbers.Real) else voxel_size


def _arrays(mesh, faces=None):
    """Returns the vertices and faces of any kind of mesh."""
    if faces is not None:
        return mesh, faces
    if isinstance(mesh, tuple) and len(mesh) == 2:
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        if os.path.isdir(mesh):
            raise InputError(f'"{os.fspath(mesh)}" is a folder, but one mesh is needed. wscvt.batch takes '
                             "a folder.")
        return read_mesh(mesh)
    if hasattr(mesh, "regular_faces"):  # PyVista
        return mesh.points, mesh.regular_faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh
        return mesh.vertices, mesh.faces
    return mesh, None


def remesh(vertices, faces=None, nodes=None, **options):
    """Remeshes a dense scan to exactly N nodes and returns a Remesh.

    remesh("scan.ply", 500), remesh(mesh, 500), remesh(vertices, faces, nodes=500)

    vertices: (n, 3) numbers in any unit of length, a path, a pair (vertices, faces), or a mesh of
        trimesh or PyVista.
    faces: (m, 3) whole numbers, counted from 0, counter-clockwise from outside. None with
        points=True, for points without faces.
    nodes: N, 4 to 1000000; 1000 by default.
    threads: 0 uses all. They do not change the result.
    progress: called with the fraction done, 0 to 1, and the stage. If it returns False or raises,
        the work is cancelled.
    source: name of the scan in the report; the file's name by default.
    keep_scan: keep the repaired scan for HTML reports and grids. On by default.
    All other options have the names and values of options(). They are listed at the end.

    Raises Error (code "invalid-input", "not-star-shaped", "numerical-failure", "input-output" or
    "cancelled"): InputError, a ValueError, for unusable input; FileError, an OSError, for a file;
    MissingFileError, a FileNotFoundError. Raises TypeError for unknown options.
    """
    faces = _faces_before("nodes", nodes, faces, options)
    if isinstance(vertices, (str, os.PathLike)):
        options.setdefault("source", os.path.basename(vertices))
    return _call(_wscvt.remesh, *_arrays(vertices, faces), **options)


def _with_options(function):
    """Adds a line for each option of its remesh to the help of a function."""
    lines = [textwrap.fill(f"{name}: {line}", 92, initial_indent="    ", subsequent_indent=" " * 8)
             for name, line in _wscvt._option_help(function.__name__).items()]
    function.__doc__ = function.__doc__.rstrip() + "\n\n    Options:\n\n" + "\n".join(lines) + "\n"


def create(surface, **options):
    """Makes a mesh of N nodes of an analytic or SH surface and returns a Remesh.

    create("ellipsoid", semi_axes=(1.0, 0.8, 0.6), nodes=500)

    surface: "ellipsoid", "superellipsoid" or "harmonics".
    semi_axes: three lengths > 0; (1, 1, 1) by default.
    exponents: two, of a superellipsoid, from pole to pole and around the equator, 0.1 to 2. (1, 1)
        is an ellipsoid, the default.
    coefficients_file: for harmonics, a path that ends in .dat, .sh or .json.
    degree: at which the series of a .dat or .sh file is cut; -1, the default, keeps all.
    threads: as for remesh.
    progress: as for remesh.
    All other options are those of remesh, without those of a scan. They are listed at the end. By
        default, nodes are on the surface.

    Raises Error, and TypeError for unknown options.
    """
    return _call(_wscvt.create, surface, **options)


def batch(scans, nodes=None, *, output=None, threads=0, **options):
    """Remeshes many grains, one per thread, and yields (name, Remesh) in the order of the scans. Or
    remeshes files into a folder, as "wscvt batch" does.

    for name, result in wscvt.batch("scans", 500):
        if not isinstance(result, wscvt.Error):
            wscvt.write_mesh(f"{name}.ply", result)

    scans: a folder, read in the order of the file names; a dictionary of meshes by name; or an
        iterable of meshes, as for remesh or as pairs (vertices, faces). Files have their name
        without ending, other meshes their number, from 0.
    threads: 0 uses all. keep_scan: off by default. All other options are as for remesh, except
        progress.

    A grain that fails yields its Error instead of a Remesh. TypeError is raised. A few grains are
    read and remeshed in advance. Leaving the loop cancels them.

    wscvt.batch("scans", [100, 500], output="out", frame="principal", node_table=["csv"])

    output: folder of the meshes, grains.csv, shape.csv and the summary, with the bytes of "wscvt
        batch". After an interruption, the same call continues.
    scans: then one or more files, folders, patterns, volumes of labels,
        or "@FILE" with one of these per line.
    nodes: then one number, or a list of numbers, each with a folder of its own.
    shard: "I/N" takes part I of N of the grains, by their names.
    format: ending of the meshes, "ply" by default.
    describe: "both" (default), "scan", "remesh" or "none": the columns of shape.csv; "contacts"
        also measures the errors of first contact.
    frame: of the meshes and of the files below: "input" (default), "centred" or "principal".
    size: equivalent diameter of each grain in these files. scale: factor of all lengths.
    node_table: endings of files of nodes in output/node-table: "csv", "vtp", "shp".
    sdf: endings of files of signed distances to the repaired scan, in output/sdf: "npy", "vti", "json".
    sdf_spacing: length between the grid's points; 0, the default, chooses one.
    voxel_size: length, or three along x, y and z. The default is the one of the file.
    smallest, smoothing, background, at_border: of a volume, as for extract.
    parts: each part of a label, and each body of a mesh, is a grain.
    separate: separate grains of a mask that touch: the widest neck between two, such as 0.85.
    progress: as for remesh.

    Returns a dictionary with the numbers of "grains" and of those that "failed", which also are
    UserWarnings. Raises Error if nothing can be begun or the machine refuses to go on.
    """
    if output is not None:
        if not isinstance(nodes, numbers.Integral) and nodes is not None:
            options["levels"] = sorted(nodes)
            if not options["levels"]:
                raise InputError("The list nodes is empty. Give a number of nodes.")
            nodes = options["levels"][-1]
        if nodes is not None:
            options["nodes"] = nodes
        if "voxel_size" in options:
            options["voxel_size"] = _along_axes(options["voxel_size"])
        return _call(_wscvt._batch, _inputs(scans), output, threads=threads, **options)
    return _batch(scans, nodes, threads, options)


def _inputs(scans):
    """Returns the names of files for a job."""
    names = [scans] if isinstance(scans, (str, os.PathLike)) else list(scans)
    if not all(isinstance(name, (str, os.PathLike)) for name in names):
        raise TypeError("With an output folder, grains are files. Give their names, or leave output out.")
    return [os.fspath(name) for name in names]


def _batch(scans, nodes, threads, options):
    options.setdefault("keep_scan", False)
    is_left = threading.Event()

    def work(scan):
        try:
            return remesh(scan, None, nodes, threads=1,
                          progress=lambda fraction, stage: not is_left.is_set(), **options)
        except Error as error:
            return error

    count = threads or len(os.sched_getaffinity(0))
    grains = _named(scans)
    with concurrent.futures.ThreadPoolExecutor(count) as pool:
        waiting = collections.deque()
        try:
            while True:
                for name, scan in itertools.islice(grains, 2 * count - len(waiting)):
                    waiting.append((name, pool.submit(work, scan)))
                if not waiting:
                    return
                name, future = waiting.popleft()
                yield name, future.result()
        finally:
            is_left.set()
            for _, future in waiting:
                future.cancel()


def _named(scans):
    """Yields the names and meshes of any kind of scans."""
    if isinstance(scans, (str, os.PathLike)):
        path = pathlib.Path(scans)
        scans = [path] if path.is_file() else sorted(
            one for one in path.iterdir() if _wscvt._is_mesh_file(str(one)))
    if hasattr(scans, "items"):
        yield from scans.items()
        return
    for number, scan in enumerate(scans):
        name = str(number)
        if isinstance(scan, (str, os.PathLike)):
            name = pathlib.Path(scan).name
            name = pathlib.Path(name[:-3] if name.lower().endswith(".gz") else name).stem
        yield name, scan


def segment(scan, voxel_size=1.0, **options):
    """Labels the grains of an array of grey values or a mask, as "wscvt segment" does.

    labels = wscvt.segment(tifffile.imread("scan.tif"), 0.012)["labels"]
    grains = wscvt.extract(labels, 0.012)

    scan: (nz, ny, nx), as returned by numpy.load and tifffile.imread. NaN was not scanned.
    voxel_size: length, or three along x, y and z. Grains are separated by lengths.
    threshold: the smallest grey value of the material (the largest if it is dark). None: half way
        between two peaks of the histogram, see phases.
    phases: number of peaks that are material, from the brightest on. None: all but one.
    dark: the material is darker than the rest. Off by default.
    separate: widest neck between two grains, as a fraction of the smaller one's width, 0 to 1;
        0.85 by default.
    smallest: min. number of voxels of a grain, 100 by default.
    threads: as for remesh.
    progress: as for remesh.

    Returns a dictionary: "labels" (nz, ny, nx) with grains from 1 and 0 between them, "grains",
    their number, "threshold" (None for a mask) and "peaks", the grey values of the histogram's
    peaks. Issues a UserWarning for each sign of a wrong result. Raises Error for a volume of one
    value and if no grain is left.
    """
    return _call(_wscvt.segment, scan, _along_axes(voxel_size), **options)


def extract(labels, voxel_size=1.0, **options):
    """Makes a mesh of each grain of a volume of labels and returns {label: (vertices, faces)}.

    for label, mesh in wscvt.extract(tifffile.imread("labels.tif"), 0.012).items():
        result = wscvt.remesh(*mesh, nodes=500)

    labels: (nz, ny, nx), as returned by numpy.load and tifffile.imread. Whole numbers, which may be
        floats and have 64 bits, as in a file for "wscvt extract". NaN is background.
    voxel_size: length, or three along x, y and z. Voxel (0, 0, 0) begins at the origin.
    background: the number of the background, such as -1 or nan. 0 by default.
    smallest: min. number of voxels of a grain, 100 by default.
    at_border: include grains that touch the border and are cut by it. Off by default.
    smoothing: passes that smooth the voxels' steps, 0 to 1000, 20 by default.
    conforming: remesh all grains at once. Grains that touch have the same vertices and faces on
        their wall, to the bit. Off by default.
    edge_length: of conforming grains, mean. 0 for three voxels.
    nodes: of conforming grains, about this number of each instead of one edge length.
    threads: as for remesh.
    progress: as for remesh.

    Issues a UserWarning for a grain in pieces, and keeps its largest piece. Issues a UserWarning
    for a grain that is too thin to be smoothed, and omits it. Each mesh is closed and has exactly
    the volume of its voxels, with pores filled. Raises Error, also for labels that are not whole
    numbers, and TypeError for what is no array of numbers.
    """
    return _call(_wscvt.extract, labels, _along_axes(voxel_size), **options)


def fabric(labels, voxel_size=1.0, *, scan=None, **options):
    """Measures the contacts of a volume of labels, as "wscvt describe" does, and returns a dictionary.

    result = wscvt.fabric(tifffile.imread("labels.tif"), 0.012, scan=tifffile.imread("scan.tif"))
    contacts = result["contacts"]
    areas = contacts["area"][contacts["contact"]]

    labels: (nz, ny, nx), as for extract.
    voxel_size: length, or three along x, y and z. Voxel (0, 0, 0) begins at the origin.
    scan: the grey values from which wscvt segment made the labels, (nz, ny, nx). Their blur then
        corrects areas and false contacts. None: the labels are exact.
    background: as for extract.
    progress: as for remesh.

    "contacts" and "grains" are dictionaries of arrays with one row per pair of labels that touch,
    and per label. Their names are the columns of contacts.csv and grains.csv, with "centre",
    "normal" and "branch" as (n, 3); "contact" is False for a narrow gap. "tensor" and
    "branch_tensor" are (3, 3). "anisotropy", "coordination" and "blur" (length, or None) are
    numbers. Raises Error as extract does.
    """
    return _call(_wscvt.fabric, labels, _along_axes(voxel_size), scan=scan, **options)


def clump(vertices, faces=None, count=None, *, output=None, **options):
    """Fits overlapping spheres to a grain, for engines with clumps.

    clump("scan.ply", 50), clump(mesh, count=50), clump(vertices, faces, 50)

    vertices, faces: as for remesh.
    count: number of spheres, 1 to 1000. 20 by default; with max_error at most this many, 200 by
        default.
    max_error: allowed error in %: the fewest spheres that meet it. 0, the default: count spheres.
    error_measure: "distance" (rms, in % of the equivalent radius), "volume" (not shared), "inertia" or
        "contact" (first contact, in % of the equivalent radius).
    smallest_radius: of a sphere, in % of the equivalent radius.
    inside: keep all spheres inside the scan.
    points, shrink_wrap, max_repaired_area: as for remesh.
    threads: as for remesh.
    progress: as for remesh.

    output: folder. Then `vertices` is one or more files, folders, patterns, or "@FILE" with one of
        these per line, and the files are those of "wscvt clump", with grains.csv: see batch. format:
        ending of the files, "csv" by default; shard, frame, size, scale: as for batch; density: for
        .molecule. Returns a dictionary with the numbers of "grains" and of those that "failed".

    The dictionary is the JSON report of "wscvt clump". Its "spheres" are an array (k, 4) of x, y, z
    and radius. Raises Error, and TypeError for unknown options.
    """
    faces = _faces_before("count", count, faces, options)
    if output is not None:
        return _call(_wscvt._clump_files, _inputs(vertices), output, **options)
    return _call(_wscvt.clump, *_arrays(vertices, faces), **options)


def describe(vertices, faces=None, reference=None, **options):
    """Returns size, form, roundness, roughness and orientation of a closed mesh as a dictionary.

    vertices, faces: as for remesh. Lengths are in the unit of the mesh.
    reference: a mesh to measure against, as a pair (vertices, faces), a path, or a mesh of trimesh
        or PyVista. The dictionary then has errors in % and distances too.
    roundness_ball, roughness_cutoff: as for "wscvt describe".
    voxel_size: of the scan, length. The dictionary then has the values without the voxels' error,
        with intervals. None, the default, leaves them out.
    threads: as for remesh.
    progress: as for remesh.

    The dictionary is the JSON report of "wscvt describe". Raises Error, and TypeError for a
    reference of another type.
    """
    if reference is not None:
        mesh = _arrays(reference)
        reference = reference if mesh[1] is None else mesh
    return _call(_wscvt.describe, *_arrays(vertices, faces), reference, **options)


def signed_distances(points, vertices, faces=None, **options):
    """Returns the exact distances (n,) of points (n, 3) to a closed mesh, negative inside; length.

    vertices, faces: as for remesh. threads, progress: as for remesh. Raises Error, also for points
    that are not finite.
    """
    return _call(_wscvt.signed_distances, points, *_arrays(vertices, faces), **options)


def distance_grid(vertices, faces=None, spacing=0.0, **options):
    """Computes signed distances to a closed mesh on a grid along the axes: a level set.

    vertices, faces: as for remesh.
    spacing: length; 0 means 1/50 of the equivalent diameter.
    threads: as for remesh.
    progress: as for remesh.

    Returns (values, origin, spacing): values (nx, ny, nz), length, negative inside; values[i, j, k]
    is at origin + spacing * (i, j, k). Raises Error, also for more than 20 million points.
    """
    return _call(_wscvt.distance_grid, *_arrays(vertices, faces), spacing, **options)


def _table_parts(table):
    """Returns the grains, files, columns, numbers and failures of any kind of table."""
    if isinstance(table, (str, os.PathLike)):
        return _wscvt.read_table(_table_file(table))
    if hasattr(table, "to_records"):  # pandas
        table = table.to_records(index=False)
    if hasattr(table, "dtype"):
        names = table.dtype.names or ()
    else:
        names = list(table)
    columns = {}
    for name in names:
        column = numpy.asarray(table[name])
        if column.ndim == 2 and column.shape[1] == 3:  # a point or a direction, as of fabric
            columns.update((f"{name}_{axis}", column[:, k]) for k, axis in enumerate("xyz"))
        elif column.ndim == 1:
            columns[name] = column
        else:
            raise InputError(f'The column "{name}" has the shape {column.shape}. Give one number '
                             f"for each grain.")
    texts = {name: [str(text) for text in columns.pop(name)]
             for name in list(columns) if columns[name].dtype.kind not in "biuf"}
    if not columns:
        raise TypeError("The table has no numeric columns. Give a structured array, a DataFrame, a "
                        "dictionary of arrays, or a path.")
    matrix = numpy.column_stack([column.astype(float) for column in columns.values()])
    grains = texts.get("grain") or [str(row) for row in range(len(matrix))]
    # Files have units in their headings, arrays have only names.
    return grains, texts.get("file", []), [(name, "") for name in columns], matrix, 0


def _table_file(path):
    files = _wscvt.sample_files(str(path))
    if len(files) > 1:
        raise InputError(f'The folder "{path}" is from a batch with several numbers of nodes. Give '
                         f'the folder of one number, such as "{pathlib.Path(files[0]).parent}".')
    return files[0]


def read_table(path):
    """Reads a table of grains, such as shape.csv of "wscvt batch", as a structured array.

    path: a .csv file, or the folder of a batch.

    The fields are "grain", "file" if the table has it, and the numeric columns under their names
    without units, as float64. Missing numbers are NaN. pandas.DataFrame(table) makes a DataFrame.
    Failed grains are omitted. Raises Error with the number of the wrong line.
    """
    grains, files, columns, values, _ = _wscvt.read_table(_table_file(path))
    fields = {"grain": numpy.array(grains)}
    if files:
        fields["file"] = numpy.array(files)
    fields.update((name, values[:, k]) for k, (name, _) in enumerate(columns))
    table = numpy.empty(len(grains), [(name, column.dtype) for name, column in fields.items()])
    for name, column in fields.items():
        table[name] = column
    return table


def sample(table, other=None, *, report=(), density=None, **options):
    """Returns statistics of a sample by number and by mass, or compares two samples.

    sizes = wscvt.sample("out", density=2650.0)["samples"][0]["size"]["by_mass"]

    table: the folder of a batch, a .csv file, a structured array (read_table), a DataFrame of
        pandas or a dictionary of arrays, with columns named as in shape.csv. A batch with several
        numbers of nodes also gives "levels", the errors against the number of nodes.
    other: a second sample to compare with.
    report: path or paths of reports to write, ending in .html, .json or .csv.
    diameter: "sieve", "equivalent-diameter", "feret-max" or "feret-min".
    describe: "scan" (default) or "remesh", the mesh whose statistics are computed.
    density: mass / volume, or a pair for two samples. By default the table's column "mass" or
        "density", else 1.
    max_error: in %, for "levels". They list the number of nodes from which 90 % of the grains have
        a smaller error. 1 by default.
    seed, repetitions: for the 95 % intervals and p; 1 and 1000 by default.
    threads: as for remesh.
    progress: as for remesh.

    The dictionary is the JSON report of "wscvt sample". Raises Error, and TypeError for other types
    of table.
    """
    samples = []
    for number, one in enumerate([table] if other is None else [table, other]):
        if isinstance(one, (str, os.PathLike)):
            samples.append((pathlib.Path(one).name, str(one), None))
        else:
            samples.append((f"sample {number + 1}", "", _table_parts(one)))
    reports = [report] if isinstance(report, (str, os.PathLike)) else report
    densities = [] if density is None else numpy.atleast_1d(density).tolist()
    if len(densities) > 1 and len(densities) != len(samples):
        raise TypeError(f"{len(densities)} densities are given for {len(samples)} samples. Give one "
                        "density, or one per sample.")
    return _call(_wscvt.sample, samples, [str(path) for path in reports], density=densities, **options)


def convex(vertices, triangles=None, /, count=None, *, output=None, **options):
    """Divides a grain into at most `count` convex parts, for physics engines.

    convex("scan.ply", 4), convex(mesh, count=4, faces=60), convex(vertices, triangles, 4)

    vertices, triangles: the grain, as vertices and faces of remesh; not by name. The parts are
        hulls of pieces of the grain, scaled together so that they keep the grain's volume.
    count: max. number of parts, 1 to 1000; 8 by default.
    faces: max. number of triangles of a part, 255 by default.
    max_error: fewer parts if no hull is farther than this from the grain, % of the equivalent
        radius; 0.5 by default.
    threads, progress: as for remesh.
    All other options are of the grain's repair and of the remesh on which the cuts are chosen. They
        are listed at the end.
    output: folder. Then `vertices` is one or more files, folders, patterns, or "@FILE" with one of
        these per line, and the files are those of "wscvt convex", with grains.csv: see batch. format:
        ending of the files, "obj" by default; shard, frame, size, scale: as for batch; density: for
        mass and inertia. Returns a dictionary with the numbers of "grains" and of those that "failed".

    Returns a list with a pair (vertices, faces) for each part, and a dictionary: distances from the
    grain, volume, and the grain's mass properties at unit density. Raises Error, and TypeError for
    unknown options.
    """
    triangles = _faces_before("count", count, triangles, options)
    if output is not None:
        return _call(_wscvt._convex_files, _inputs(vertices), output, **options)
    return _call(_wscvt.convex, *_arrays(vertices, triangles), **options)


for _function in (remesh, create, convex):
    _with_options(_function)


def fragment(vertices, faces=None, count=None, *, near=None, **options):
    """Divides a grain into exactly `count` closed fragments that fill it, for breakage.

    fragment("grain.ply", 50), fragment(mesh, count=50), fragment(vertices, faces, 50)

    vertices, faces: as for remesh.
    count: number of fragments, 1 to 1000; 20 by default.
    near: points (n, 3) near which fragments are smaller, such as contacts.
    volumes: relative volumes, one per fragment; about equal by default. Not together with near.
    seed: the same seed gives the same fragments; 1 by default.
    nodes: about so many of each fragment, or edge_length: remeshes the fragments with even edges and
        common walls. By default they keep all points of the grain's surface.
    threads, progress: as for remesh.

    Returns a list with a pair (vertices, faces) for each fragment, and a dictionary:
    volume, centroid, surface_area (of the grain's surface) and hull_excess_percent (of the convex
    hull over the fragment) are arrays with a row per fragment. contacts has a row per wall:
    fragments (pairs of numbers from 0), area, centre, and normal from the first to the second.
    moved_pieces and moved_percent (of the volume) say what joined a neighbour because a cell had
    several pieces. Two neighbours have the same triangles on their wall. Raises Error.
    """
    faces = _faces_before("count", count, faces, options)
    if near is not None:
        options["near"] = numpy.atleast_2d(numpy.asarray(near, dtype=float))
    return _call(_wscvt.fragment, *_arrays(vertices, faces), **options)


def tetrahedra(vertices, faces=None, **options):
    """Fills a closed mesh with tetrahedra for finite elements, by Gmsh, and returns a dictionary.

    wscvt.tetrahedra(wscvt.remesh("scan.ply", 1000), output="body.inp")
    wscvt.tetrahedra(wscvt.extract(labels, conforming=True), output="packing.msh")
    wscvt.tetrahedra(wscvt.fragment("grain.ply", 20, nodes=200)[0], output="pieces.msh")

    vertices, faces: a closed mesh or a Remesh, as for remesh. Its points and triangles are kept.
        Or several bodies: a dictionary of pairs (vertices, faces) by label, or a list of pairs.
        Walls that two of them share are in the result once.
    edge_length: the longest wanted edge inside, in the mesh's unit. 0, the default: as on the surface.
        A body with an angle below 12 degrees is filled again with shorter ones, up to three times.
    output: also write this file: .vtu (ParaView), .msh (Gmsh) or .inp (Abaqus, CalculiX).
    threads, progress: as for remesh.

    vertices (n, 3): the mesh's, then the inner ones; tetrahedra (m, 4), the fourth corner sees the
    others counter-clockwise; faces: the mesh's; smallest_dihedral_degrees and
    largest_dihedral_degrees: angles between faces of a tetrahedron; mean_edge. Of several bodies
    also bodies (m,): the label of each tetrahedron's, or its number in the list, from 1. Raises Error
    if Gmsh is not there or cannot fill the mesh.
    """
    if isinstance(vertices, (dict, list)) and faces is None:
        is_packing = isinstance(vertices, dict)
        names = list(vertices) if is_packing else list(range(1, len(vertices) + 1))
        meshes = [tuple(pair) for pair in (vertices.values() if is_packing else vertices)]
        if not meshes:
            raise InputError("There are no bodies. Give one or more.")
        result = _call(_wscvt.tetrahedra_of_bodies, meshes, "grain" if is_packing else "fragment",
                       [str(name) for name in names], **options)
        result["bodies"] = numpy.array(names)[result["bodies"]]
        return result
    return _call(_wscvt.tetrahedra, *_arrays(vertices, faces), **options)


def read_mesh(path):
    return _wscvt.read_mesh(path)


def write_mesh(path, vertices, faces=None, *, vertex_attributes=None, face_attributes=None):
    _call(_wscvt.write_mesh, path, *_arrays(vertices, faces), vertex_attributes or {}, face_attributes or {})


def read_attributes(path):
    """Returns the attributes of vertices and faces of a PLY file, such as red, quality or label,
    and the vertex colours of an OBJ file. A texture becomes vertex colours.

    The result is two dictionaries of arrays (n,), for vertices and faces. Both are empty for other
    formats. Warns of missing pictures. Raises Error.
    """
    return _wscvt.read_attributes(os.fspath(path))


def carry_attributes(scan, mesh, vertex_attributes=None, face_attributes=None, *, threads=0):
    """Transfers the attributes of a scan to another mesh at the same place, from the nearest point.

    scan, mesh: (vertices, faces), a path, or a mesh of trimesh or PyVista.
    vertex_attributes, face_attributes: dictionaries of arrays (n,), a number for each vertex or
        face of the scan. Without both, the scan must be a path: the file's attributes are used,
        with its texture as red, green and blue of the vertices.

    Returns two dictionaries with the same names. Whole numbers stay whole, of up to 32 bits; a mask
    becomes 0 and 1. Warns of missing pictures. Raises Error.
    """
    if vertex_attributes is None and face_attributes is None:
        return _wscvt.carry_attributes_of_file(os.fspath(scan), _arrays(mesh), threads=threads)
    return _call(_wscvt.carry_attributes, _arrays(scan), _arrays(mesh), vertex_attributes or {},
                 face_attributes or {}, threads=threads)


for _function in (read_mesh, write_mesh):
    _function.__doc__ = getattr(_wscvt, _function.__name__).__doc__
del _function


def _matrix(descriptors):
    """Returns an array (n, d), also from the fields of a structured array."""
    _refuse_masked("descriptors", descriptors)
    descriptors = numpy.asarray(descriptors)
    if descriptors.dtype.names:
        descriptors = numpy.column_stack([descriptors[name] for name in descriptors.dtype.names])
    return numpy.asarray(descriptors, dtype=float)


def templates(descriptors, masses, count=20, *, seed=1, threads=0, progress=None):
    """Chooses `count` grains with weights that represent a sample: (table, distances).

    descriptors: an array (n, d), or a structured array with a field per descriptor. masses: n
    numbers. table is a structured array with the fields grain, weight_by_number and weight_by_mass.
    distances is a dictionary: the Wasserstein distance of each descriptor in standard deviations of
    the sample (by_number, by_mass), the same for random grains (random_by_number, random_by_mass),
    and stands_for, for each grain the nearest row of the table.
    """
    parts = _wscvt.templates_of(_matrix(descriptors), list(masses), count, seed, threads, progress)
    table = numpy.array([*zip(parts["grains"], parts["by_number"], parts["by_mass"])],
                        [("grain", "i8"), ("weight_by_number", "f8"), ("weight_by_mass", "f8")])
    return table, {"by_number": parts["distance_by_number"], "by_mass": parts["distance_by_mass"],
                   "random_by_number": parts["random_by_number"],
                   "random_by_mass": parts["random_by_mass"], "stands_for": parts["stands_for"]}


def grow(grains, count, *, nodes=500, degree=20, seed=1, threads=0, progress=None):
    """Makes virtual grains with the statistics of real grains: (meshes, table).

    grains: 8 or more meshes, as for remesh, arrays of SH coefficients, or a folder of meshes. meshes
    is a list of `count` pairs (vertices, faces) in their principal frames. table is a structured
    array with the fields equivalent_diameter, base_grain, nearest_grain, nearest_distance (rms of the
    radius at radius 1), collage and redraws. Grains are numbered from 0.
    """
    real = []
    for _, grain in _named(grains):
        if isinstance(grain, numpy.ndarray) and grain.ndim == 1:
            real.append(grain.tolist())
        else:
            real.append(tuple(_arrays(grain)))
    rows = _wscvt.grow_of(real, count, nodes, degree, seed, threads, progress)
    table = numpy.array([row[2:] for row in rows],
                        [("equivalent_diameter", "f8"), ("base_grain", "i8"),
                         ("nearest_grain", "i8"), ("nearest_distance", "f8"), ("collage", "f8"),
                         ("redraws", "i4")])
    return [row[:2] for row in rows], table


def _to_trimesh(self):
    """Returns a trimesh.Trimesh with the same vertices and faces. Needs trimesh."""
    import trimesh
    return trimesh.Trimesh(self.vertices, self.faces, process=False)


def _to_pyvista(self):
    """Returns a pyvista.PolyData with the same vertices and faces. Needs PyVista."""
    import pyvista
    return pyvista.PolyData.from_regular_faces(self.vertices, self.faces)


def _plot(self, axes=None):
    """Draws the mesh with matplotlib and returns the axes. axes: 3D axes; None makes a figure."""
    if axes is None:
        import matplotlib.pyplot
        axes = matplotlib.pyplot.figure().add_subplot(projection="3d")
    vertices = self.vertices
    axes.plot_trisurf(*vertices.T, triangles=self.faces, color="lightgrey", edgecolor="black",
                      linewidth=0.2)
    axes.set_box_aspect(numpy.ptp(vertices, axis=0))
    return axes


def _repr_html_(self):
    """Returns the report as HTML, which notebooks show: pictures that turn, errors, warnings. A
    result without its scan, or one that was pickled, shows its log."""
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "report.html")
        try:
            self.write_report(page)
        except InputError:
            return f"<pre>{html.escape(str(self))}</pre>"
        text = pathlib.Path(page).read_text(encoding="utf-8")
    return (f'<iframe srcdoc="{html.escape(text)}" title="{html.escape(repr(self))}" '
            'style="width: 100%; height: 40em; border: 0"></iframe>')


for _method in (_to_trimesh, _to_pyvista, _plot):
    _method.__name__ = _method.__name__[1:]
    _method.__qualname__ = "Remesh." + _method.__name__
    setattr(Remesh, _method.__name__, _method)
Remesh._repr_html_ = _repr_html_
