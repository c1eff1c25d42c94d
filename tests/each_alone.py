#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""each_alone.py BUILD FOLDER...: parses every source below the folders with its compile command in BUILD,
without making an object. It finds sources that need a precompiled header, or a file that is compiled
together with them. BUILD is configured with WSCVT_QUICK_BUILD=OFF, and need not be built.

The large headers of other projects that sources include anyway, themselves or by headers of ours, are
precompiled once for all that include the same ones. This saves a third of the time."""
import collections
import concurrent.futures
import functools
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

build = sys.argv[1]
folders = tuple(os.path.realpath(folder) + os.sep for folder in sys.argv[2:])
LARGE = re.compile(r"(functional|memory|string|vector|Eigen/(Core|Geometry)|nlohmann/json\.hpp|(CLI|pybind11)/.+)$")
FEWEST_SOURCES = 4  # for which headers are precompiled
include_line = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]', re.MULTILINE)


@functools.lru_cache(None)
def includes(path):
    """Returns the files of ours and the other headers that a file names."""
    ours, others = set(), set()
    with open(path, errors="replace") as file:
        for bracket, name in include_line.findall(file.read()):
            places = [os.path.join(folder, name) for folder in (os.path.dirname(path), "lib", "tests/grains", "tests")]
            found = [place for place in places if bracket == '"' and os.path.exists(place)]
            (ours if found else others).add(found[0] if found else name)
    return ours, others


def large_headers(source):
    reached, ahead, large = {source}, [source], set()
    while ahead:
        ours, others = includes(ahead.pop())
        large.update(filter(LARGE.match, others))
        ahead += ours - reached
        reached |= ours
    return tuple(sorted(large))


def run(words, folder):
    return subprocess.run(words, cwd=folder, capture_output=True, text=True)


def complaints(command, words, header):
    words = words + ["-fsyntax-only"] + (["-Winvalid-pch", "-include", header] if header else []) + [command["file"]]
    done = run(words, command["directory"])
    return done.stderr if done.returncode else ""


def check(pool, commands, precompiled):
    alike = collections.defaultdict(list)
    for command in commands:
        words = shlex.split(command["command"])
        # Neither an object nor a list of what it depends on.
        words = words[:words.index("-o")]
        alike[tuple(words), large_headers(command["file"])].append(command)
    headers = {}
    for number, ((words, large), same) in enumerate(alike.items()):
        if large and len(same) >= FEWEST_SOURCES:
            header = os.path.join(precompiled, "%d.h" % number)
            with open(header, "w") as file:
                file.writelines("#include <%s>\n" % name for name in large)
            headers[words, large] = header
    made = [pool.submit(run, [*key[0], "-x", "c++-header", header, "-o", header + ".gch"], alike[key][0]["directory"])
            for key, header in headers.items()]
    for one in made:
        if one.result().returncode:
            sys.exit(one.result().stderr)
    said = [pool.submit(complaints, command, list(key[0]), headers.get(key))
            for key, same in alike.items() for command in same]
    return [one.result() for one in said if one.result()]


with open(os.path.join(build, "compile_commands.json")) as file:
    # The Python module compiles some files of the library once more.
    commands = {command["file"]: command for command in reversed(json.load(file))
                if os.path.realpath(command["file"]).startswith(folders)}
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool, tempfile.TemporaryDirectory() as precompiled:
    said = check(pool, commands.values(), precompiled)
print("".join(said), end="")
print("%d of %d files stand alone." % (len(commands) - len(said), len(commands)))
sys.exit(1 if said or not commands else 0)
