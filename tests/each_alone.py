#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""each_alone.py BUILD FOLDER...: parses every source below the folders with its compile command in BUILD,
without making an object. It finds sources that need a precompiled header, or a file that is compiled
together with them. BUILD is configured with WSCVT_QUICK_BUILD=OFF, and need not be built."""
import concurrent.futures
import json
import os
import shlex
import subprocess
import sys

build = sys.argv[1]
folders = tuple(os.path.realpath(folder) + os.sep for folder in sys.argv[2:])


def complaints(command):
    words = shlex.split(command["command"])
    # Neither an object nor a list of what it depends on.
    words = words[:words.index("-o")] + words[words.index("-o") + 2:] + ["-fsyntax-only"]
    done = subprocess.run(words, cwd=command["directory"], capture_output=True, text=True)
    return done.stderr if done.returncode else ""


with open(os.path.join(build, "compile_commands.json")) as file:
    # The Python module compiles some files of the library once more.
    commands = {command["file"]: command for command in reversed(json.load(file))
                if os.path.realpath(command["file"]).startswith(folders)}
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    said = [text for text in pool.map(complaints, commands.values()) if text]
print("".join(said), end="")
print("%d of %d files stand alone." % (len(commands) - len(said), len(commands)))
sys.exit(1 if said or not commands else 0)
