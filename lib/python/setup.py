# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the module with CMake. pyproject.toml describes the package."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = pathlib.Path(__file__).resolve().parent
INSIDE = HERE / "project"  # in an archive that sdist made
PROJECT = INSIDE if INSIDE.is_dir() else HERE.parents[1]
NEEDED = """
The build needs a C++17 compiler, CMake 3.22, pybind11, OpenMesh 9, Eigen 3.4, CGAL 5.5, Boost,
nlohmann-json and zlib; stb_image for pictures, ITK for segment. On Debian or Ubuntu run, as root or with sudo:
    apt-get install g++ cmake ninja-build pybind11-dev python3-dev libopenmesh-dev libeigen3-dev \\
      libcgal-dev libboost-dev nlohmann-json3-dev zlib1g-dev libstb-dev \\
      libinsighttoolkit5-dev
Or install the wheel, which needs no build: see lib/python/README.md."""


def fail(reason):
    sys.exit(f"wscvt cannot be built: {reason}\n{NEEDED}")


def run(command):
    """Runs a command. pip shows its output for -v and after failures."""
    try:
        subprocess.run(list(map(str, command)), check=True)
    except FileNotFoundError:
        fail(f"{command[0]} is missing.")
    except subprocess.CalledProcessError:
        fail(f"{command[0]} failed. Its last lines above say why.")


def run_with_progress(command):
    """Runs a build and prints its progress at each tenth, even if pip is silent."""
    try:
        terminal = open("/dev/tty", "w", encoding="utf-8")
    except OSError:  # no terminal
        terminal = None
    next_tenth = 10
    with subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True) as build:
        for line in build.stdout:
            print(line, end="", flush=True)
            ninja, make = re.match(r"\[(\d+)/(\d+)\]", line), re.match(r"\[ *(\d+)%\]", line)
            percent = (100 * int(ninja[1]) // int(ninja[2]) if ninja and int(ninja[2]) > 2
                       else int(make[1]) if make else 0)
            if terminal and percent >= next_tenth:
                terminal.write(f"\r  wscvt: {percent} % compiled\n")
                terminal.flush()
                next_tenth = percent // 10 * 10 + 10
    if terminal:
        terminal.close()
    if build.returncode:
        fail("a file does not compile. See the lines above.")


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        built = pathlib.Path(self.build_temp).resolve()
        folder = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        choices = ["-G", "Ninja"] if shutil.which("ninja") else []
        try:
            import pybind11  # from pip; otherwise CMake uses the system's
            choices.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ImportError:
            pass
        run(["cmake", "-S", PROJECT, "-B", built, *choices, "-DCMAKE_BUILD_TYPE=Release",
             f"-DPYTHON_EXECUTABLE={sys.executable}", "-DWSCVT_BUILD_PYTHON=ON",
             "-DWSCVT_QUICK_BUILD=ON", "-DWSCVT_BUILD_PROGRAM=OFF", "-DWSCVT_BUILD_TESTS=OFF"])
        run_with_progress(["cmake", "--build", built, "--target", "wscvt_python", "--parallel",
                           os.cpu_count()])
        made, = (built / "lib" / "python" / "wscvt").glob("_wscvt*.so")
        folder.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(made.with_name("__init__.pyi")), str(folder))
        self.copy_file(str(made), str(folder / pathlib.Path(self.get_ext_filename(ext.name)).name))


class SourceArchive(sdist):
    """Adds the sources of the library, which are not below this folder."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        inside = pathlib.Path(base_dir, INSIDE.name)
        shutil.copytree(PROJECT / "lib", inside / "lib",
                        ignore=shutil.ignore_patterns(pathlib.Path(base_dir).name, "build", "*.egg-info", "__pycache__"))
        for name in ("CMakeLists.txt", "LICENSE"):
            shutil.copy(PROJECT / name, inside)


version = re.search(r"project\(wscvt VERSION ([0-9.]+)", (PROJECT / "CMakeLists.txt").read_text())
setup(version=version[1], ext_modules=[Extension("wscvt._wscvt", sources=[])],
      cmdclass={"build_ext": CMakeBuild, "sdist": SourceArchive})
