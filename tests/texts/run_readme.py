#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""run_readme.py SOURCE BINARY FOLDER [TEXT ...]: runs the commands of README.md, or of the TEXTs named
by their path in SOURCE, word for word and in their order, as somebody would after README's first command,
in FOLDER, which gets links to the project and its build.

Exit code 0 if each command ends with 0, each file that one names after -o, --report, --node-table or
--sdf, or as the output of wscvt, is there, and the text says nothing of the project that is not run.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

# What sets up or tests, and so takes minutes; tests/run_all.sh and its step debian12 run these.
SETUP = {"filter_wscvt/demo.sh", "tests/run_all.sh"}

# How a command begins; other indented lines are what a program prints.
STARTS = ("build/", "filter_wscvt/", "tests/", "lib/", "python3 ", "xvfb-run ", "PYTHONPATH=", "cmake ")


def commands_of(text):
    return [line[4:].strip() for line in text.splitlines() if line.startswith("    ")]


def outputs_of(command):
    words = command.split()
    named = [words[i + 1] for i, word in enumerate(words)
             if word in ("-o", "--report", "--node-table", "--sdf")]
    meshes = [word for word in words if re.fullmatch(r"[\w./]+\.(ply|stl|obj|off)", word)]
    if len(meshes) == 2 and " compare " not in command:
        named.append(meshes[1])
    return named


def main():
    source, binary, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "build").mkdir(parents=True)
    for name in ("meshes", "filter_wscvt", "lib", "tests"):
        (folder / name).symlink_to(source / name)
    (folder / "build" / "release").symlink_to(binary)
    texts = sys.argv[4:] or ["README.md"]
    commands = [one for text in texts for one in commands_of((source / text).read_text())
                if one.startswith(STARTS) and one not in SETUP]
    if len(commands) < 6:
        sys.exit(f"{texts} have {len(commands)} commands to run, fewer than 6: {commands}")
    for command in commands:
        # Debian's programs, Python above all, as a newcomer has them.
        run = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True,
                             check=False, env=dict(os.environ, PATH="/usr/bin:/bin"))
        missing = [name for name in outputs_of(command) if not (folder / name).exists()]
        if run.returncode != 0 or missing:
            sys.exit(f"{command}\nended with {run.returncode}; missing: {missing}\n"
                     f"{run.stdout}{run.stderr}")
        print(f"{command}\n{run.stdout[-200:]}")


if __name__ == "__main__":
    main()
