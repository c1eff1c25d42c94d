# SPDX-License-Identifier: GPL-3.0-or-later
"""Options have the names of the program's options, and no others."""
import ast
import os
import pathlib
import re
import subprocess

import numpy as np
import pytest

import wscvt

GRAIN = (np.zeros((4, 3)), np.zeros((2, 3), dtype=int))
VOLUME = np.zeros((2, 2, 2), dtype=int)

# Help, files and what is told: without them in memory. How long it takes.
COMMON = {"help", "help_all", "output", "report", "quiet", "verbose", "progress", "threads"}
# Which of the volumes in a file.
IN_FILES = {"select"}
# --max-handle-loop 0 keeps all handles; only a library's user refuses them.
OF_HANDLES = {"handles"}
# Of the functions of a Remesh.
OF_A_RESULT = {"coefficients", "node_table", "sdf", "sdf_spacing", "frame", "size", "scale"}


class Names:
    """A function, a call, its command, its names beside those of the command, and those that it does not have."""

    def __init__(self, call, command, own=(), missing=()):
        self.call, self.command, self.own, self.missing = call, command, set(own), set(missing)


NAMES = {
    "remesh": Names(lambda **o: wscvt.remesh(*GRAIN, **o), "remesh",
                    {"vertices", "faces", "source", "keep_scan"} | OF_HANDLES,
                    OF_A_RESULT | {"tetrahedra", "edge_length"}),
    "create": Names(lambda **o: wscvt.create("ellipsoid", **o), "create", {"surface", "coefficients_file"}),
    "batch": Names(lambda **o: wscvt.batch("scans", output="no", **o), "batch", {"scans", "keep_scan"} | OF_HANDLES,
                   IN_FILES | {"engine", "size_curve"}),
    "segment": Names(lambda **o: wscvt.segment(VOLUME, **o), "segment", {"scan"}, IN_FILES),
    "extract": Names(lambda **o: wscvt.extract(VOLUME, **o), "extract", {"labels", "conforming"},
                     IN_FILES | {"parts", "separate", "describe", "tetrahedra", "format", "shard"}),
    "fabric": Names(lambda **o: wscvt.fabric(VOLUME, **o), "describe", {"labels", "scan"},
                    IN_FILES | {"parts", "roundness_ball", "roughness_cutoff"}),
    "describe": Names(lambda **o: wscvt.describe(*GRAIN, **o), "describe", {"vertices", "faces", "reference"},
                      IN_FILES | {"parts", "background"}),
    "sample": Names(lambda **o: wscvt.sample({"volume": [1.0]}, **o), "sample", {"table", "other", "repetitions"}),
    "templates": Names(lambda **o: wscvt.templates([[1.0]], [1.0], **o), "grow", {"masses", "descriptors"},
                       {"templates", "format", "size_curve", "shard", "nodes", "degree"}),
    "grow": Names(lambda **o: wscvt.grow([], **{"count": 1, **o}), "grow", {"grains"},
                  {"templates", "format", "size_curve", "shard"}),
    "clump": Names(lambda **o: wscvt.clump(*GRAIN, **o), "clump", {"vertices", "faces"}, {"engine", "size_curve"}),
    # "faces" is the number of a part's.
    "convex": Names(lambda **o: wscvt.convex(*GRAIN, **o), "convex", OF_HANDLES, {"engine", "size_curve"}),
    "fragment": Names(lambda **o: wscvt.fragment(*GRAIN, **o), "fragment", {"vertices", "faces", "volumes"},
                      {"size_curve", "format", "density", "tetrahedra"}),
}
# Files of several grains, which the functions write with output=.
OF_A_FOLDER = {"clump": {"shard", "format", "frame", "scale", "size", "density"},
               "convex": {"shard", "format", "frame", "scale", "size", "density"}}


def names_of_program(command):
    text = subprocess.run([os.environ["WSCVT_PROGRAM"], command, "--help-all"], check=True, capture_output=True,
                          text=True).stdout
    return {name.replace("-", "_") for name in re.findall(r"^  (?:-\w,)?--([a-z-]+)", text, re.M)}


def names_of_stub(function):
    stub = pathlib.Path(wscvt.__file__).with_name("__init__.pyi").read_text()
    nodes = [node.args for node in ast.parse(stub).body if getattr(node, "name", "") == function]
    assert nodes
    return {one.arg for arguments in nodes for one in arguments.args + arguments.kwonlyargs}


@pytest.mark.parametrize("function", NAMES)
def test_options_have_the_names_of_the_program(function):
    names = NAMES[function]
    assert names_of_stub(function) - names.own - COMMON == names_of_program(names.command) - names.missing - COMMON


@pytest.mark.parametrize("function", NAMES)
def test_a_function_takes_the_options_of_its_stub_and_says_where_others_are(function):
    names = NAMES[function]
    in_memory = names_of_stub(function) - names.own - COMMON - OF_A_FOLDER.get(function, set())
    if function == "templates":
        in_memory.discard("descriptors")  # the first argument
    for name in sorted(in_memory):
        with pytest.raises(Exception) as refused:  # no option is such a thing
            names.call(**{name: object()})
        said = str(refused.value)
        assert "no option" not in said and "unexpected" not in said, (name, said)
    with pytest.raises(TypeError) as refused:
        names.call(no_such=np.zeros(1000))
    said = str(refused.value)
    assert "no_such" in said and len(said) < 120
    if function not in ("templates", "grow"):  # without keywords of the library
        assert said == f"There is no option no_such of {function}. help(wscvt.{function}) lists the options."


def test_tetrahedra_have_the_edge_length_of_the_program():
    assert names_of_stub("tetrahedra") - COMMON == {"vertices", "faces", "edge_length"}
    assert "edge_length" in names_of_program("remesh")


def test_a_value_of_a_wrong_type_is_told_without_arrays():
    for call in (lambda: wscvt.describe(*GRAIN, roundness_ball="large"), lambda: wscvt.extract(VOLUME, "large"),
                 lambda: wscvt.convex(*GRAIN, faces=GRAIN[1]), lambda: wscvt.remesh(*GRAIN, threads="all")):
        with pytest.raises(TypeError, match="An argument of .* has a wrong type: .* is .*help") as refused:
            call()
        assert len(str(refused.value)) < 250


def test_the_readme_names_every_function():
    table = "".join(line for line in pathlib.Path(os.environ["WSCVT_README"]).read_text().splitlines()
                    if line.startswith("| `"))
    missing = [name for name in wscvt.__all__ if not isinstance(getattr(wscvt, name), type)
               and f"`{name}`" not in table]
    assert missing == []
