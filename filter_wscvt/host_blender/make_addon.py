#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the zip of the Blender add-on from the Python module of a wheel.

    filter_wscvt/host_blender/make_addon.py WHEEL OUTPUT_FOLDER

WHEEL is made by lib/python/make_wheel.py. The add-on works in the Pythons of the wheel.
"""
import os
import pathlib
import re
import sys
import zipfile

SOURCES = pathlib.Path(__file__).resolve().parent / "wscvt_remesh"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    wheel, output = map(pathlib.Path, sys.argv[1:])
    version = re.match(r"wscvt-([\d.]+)-", wheel.name)
    if not version:
        sys.exit(f"{wheel} is not a wheel of wscvt. Make one with lib/python/make_wheel.py.")
    output.mkdir(parents=True, exist_ok=True)
    made = output / f"wscvt-{version[1]}-blender.zip"
    part = f"{made}.part"
    with zipfile.ZipFile(wheel) as packed, zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as zipped:
        def add(name, content):
            zipped.writestr(zipfile.ZipInfo(f"wscvt_remesh/{name}", (2022, 7, 1, 0, 0, 0)), content,
                            zipfile.ZIP_DEFLATED)

        for file in sorted(SOURCES.glob("*.py")):
            add(file.name, file.read_bytes())
        for name in packed.namelist():
            if name.startswith("wscvt/"):
                add(name, packed.read(name))
            elif "/licenses/" in name:
                add("licenses/" + name.rsplit("/", 1)[1], packed.read(name))
    os.replace(part, made)
    print(f"{made} is {made.stat().st_size / 1e6:.1f} MB.")


if __name__ == "__main__":
    main()
