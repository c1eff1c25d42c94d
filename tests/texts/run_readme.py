#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""run_readme.py SOURCE BINARY FOLDER [TEXT ...]: runs the commands of every README.md, or of the
TEXTs named by their path in SOURCE, word for word and in their order, as a user would after README.md's
first command. Each text has its own folder in FOLDER, with links to the project and its build, a
scan.ply, and small volumes scan.tif and labels.tif.

It does not run a block of commands below the line <!-- by hand -->, nor a text that begins with this line.

Exit code 0 if each command ends with 0, and each file is there that a command names after -o, --report,
--node-table or --sdf, or as the output of wscvt.
"""
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys

# Commands that set up or test, and so take minutes; tests/run_all.sh and its step debian12 run them.
SETUP = {"filter_wscvt/demo.sh", "tests/run_all.sh"}
# How a command begins; other indented lines are what a program prints.
STARTS = ("build/", "filter_wscvt/", "tests/", "lib/", "packages/", "python3 ", "xvfb-run ", "PYTHONPATH=",
          "cmake ", "wscvt ", "pip ", "sudo ")
BY_HAND = "<!-- by hand -->"


def commands_of(text):
    """The indented lines that are commands, without those that are marked."""
    if text.startswith(BY_HAND):
        return []
    commands = []
    before, mark_above, is_marked = "", False, False
    # Not those of listings, which stand between fences.
    for line in re.sub(r"^```.*?^```", "", text.replace("\\\n", " "), flags=re.M | re.S).splitlines():
        if line.startswith("    "):
            if not before.startswith("    "):
                is_marked = mark_above
            if not is_marked and line.strip() not in SETUP and line.strip().startswith(STARTS):
                commands.append(line.strip())
        if line.strip():
            mark_above = line.strip() == BY_HAND
        before = line
    return commands


def outputs_of(command):
    words = command.split()
    named = [words[i + 1] for i, word in enumerate(words)
             if word in ("-o", "--report", "--node-table", "--sdf")]
    meshes = [word for word in words if re.fullmatch(r"[\w./]+\.(ply|stl|obj|off)", word)]
    if len(meshes) == 2 and " compare " not in command:
        named.append(meshes[1])
    return named


def tiff(values):
    """Two balls of radius 12 that touch, in 60 x 32 x 32 voxels: a page per slice, a byte per voxel."""
    width, height, depth = 60, 32, 32
    data, entries = b"II*\0\0\0\0\0", []
    for z in range(depth):
        strip = len(data)
        data += bytes(values[1 if (x - 17) ** 2 + (y - 15) ** 2 + (z - 16) ** 2 < 144 else
                             2 if (x - 40) ** 2 + (y - 16) ** 2 + (z - 15) ** 2 < 144 else 0]
                      for y in range(height) for x in range(width))
        entries.append(len(data))
        tags = [(256, width), (257, height), (258, 8), (259, 1), (262, 1), (273, strip), (278, height),
                (279, width * height)]
        data += struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", tag, 4, 1, value)
                                                         for tag, value in tags) + b"\0\0\0\0"
    data = bytearray(data)
    for place, entry in zip([4] + [entry + 2 + 8 * 12 for entry in entries], entries):
        data[place:place + 4] = struct.pack("<I", entry)
    return bytes(data)


def run(text, commands, source, binary, folder):
    (folder / "build").mkdir(parents=True)
    for name in ("meshes", "filter_wscvt", "lib", "tests"):
        (folder / name).symlink_to(source / name)
    (folder / "build" / "release").symlink_to(binary)
    shutil.copy(source / "meshes" / "sand_7228.ply", folder / "scan.ply")
    (folder / "scan.tif").write_bytes(tiff((20, 200, 200)))
    (folder / "labels.tif").write_bytes(tiff((0, 1, 2)))
    # Debian's programs, Python above all, as a newcomer has them, after those that were built.
    path = f"{binary}/lib:{binary}/filter_wscvt/stage/bin:/usr/bin:/bin"
    for command in commands:
        done = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True,
                              check=False, env=dict(os.environ, PATH=path))
        missing = [name for name in outputs_of(command) if not (folder / name).exists()]
        if done.returncode != 0 or missing:
            sys.exit(f"{text}: {command}\nended with {done.returncode}; missing: {missing}\n"
                     f"{done.stdout}{done.stderr}")
        print(f"{text}: {command}\n{done.stdout[-200:]}", flush=True)


def main():
    source, binary, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    shutil.rmtree(folder, ignore_errors=True)
    texts = sys.argv[4:] or sorted(
        path.relative_to(source).as_posix()
        for pattern in ("README.md", "[!.]*/README.md", "[!.]*/[!.]*/README.md")
        for path in source.glob(pattern) if "build" not in path.relative_to(source).parts)
    count = 0
    for text in texts:
        commands = commands_of((source / text).read_text())
        count += len(commands)
        if commands:
            run(text, commands, source, binary, folder / text.replace("/", "_"))
    if count < 6:
        sys.exit(f"{texts} have {count} commands to run, fewer than 6.")


if __name__ == "__main__":
    main()
