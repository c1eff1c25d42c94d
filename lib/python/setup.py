# SPDX-License-Identifier: GPL-3.0-or-later
"""Has CMake build the module; what the package is stands in pyproject.toml."""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = pathlib.Path(__file__).resolve().parents[2]


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        built = pathlib.Path(self.build_temp).resolve()
        folder = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        subprocess.run(
            ["cmake", "-S", PROJECT, "-B", built, "-DCMAKE_BUILD_TYPE=Release",
             f"-DPYTHON_EXECUTABLE={sys.executable}", "-DWSCVT_BUILD_PYTHON=ON",
             "-DWSCVT_BUILD_PROGRAM=OFF", "-DWSCVT_BUILD_TESTS=OFF"], check=True)
        subprocess.run(["cmake", "--build", built, "--target", "wscvt_python", "--parallel",
                        str(os.cpu_count())], check=True)
        made, = (built / "lib" / "python" / "wscvt").glob("_wscvt*.so")
        folder.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(made.with_name("__init__.pyi")), str(folder))
        self.copy_file(str(made), str(folder / pathlib.Path(self.get_ext_filename(ext.name)).name))


version = re.search(r"project\(wscvt VERSION ([0-9.]+)", (PROJECT / "CMakeLists.txt").read_text())
setup(version=version[1], ext_modules=[Extension("wscvt._wscvt", sources=[])],
      cmdclass={"build_ext": CMakeBuild})
