#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says which files "cmake --install" wants that filter_wscvt/demo.sh does not build.

    demo_installs.py SOURCE_FOLDER BUILD_FOLDER
"""
import pathlib
import re
import subprocess
import sys

source, build = (pathlib.Path(one).resolve() for one in sys.argv[1:])
lines = re.findall(r"^ *build (\w.*)$", (source / "filter_wscvt" / "demo.sh").read_text(), re.M)
targets = sorted({target for line in lines for target in line.split()})
commands = subprocess.run(["ninja", "-C", build, "-t", "commands", *targets], check=True, capture_output=True,
                          text=True).stdout
# Files that the configuration makes have no command.
configured = re.compile(r"cmake_install\.cmake$|/CMakeFiles/|Config(Version)?\.cmake$|^documents/|^\$")
# Below tests/ other builds have scripts of their own.
parts = [part for part in build.glob("**/cmake_install.cmake") if build / "tests" not in part.parents]
wanted = {file.rstrip("/") for part in parts
          for file in re.findall(f'"{re.escape(str(build))}/([^"]+)"', part.read_text())}
missing = sorted(file for file in wanted if not configured.search(file) and file not in commands)
print(f"{len(wanted)} files and scripts to install, {len(missing)} that demo.sh does not build:", *missing)
sys.exit(1 if missing or len(wanted) < 10 else 0)
