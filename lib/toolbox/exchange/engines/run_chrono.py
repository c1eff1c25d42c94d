# SPDX-License-Identifier: GPL-3.0-or-later
"""Clumps of this folder in Project Chrono's core, which needs no graphics card:

    python3 run.py [COUNT]

Compiles chrono_settle.cpp by CMake, which finds Chrono where it is installed or by the variable Chrono_DIR: the
folder of its ChronoConfig.cmake. Chrono's contacts are made for metres and kilograms, so the model has grains of
0.2 m in the mean. See packing.py for scene.json.
"""
import pathlib

import packing
from packing import np

scene = packing.Scene()
length = 0.2 / scene.mean_diameter
scene.write_clumps("packing.scene", length)
pathlib.Path("chrono").mkdir(exist_ok=True)
pathlib.Path("chrono/CMakeLists.txt").write_text("""cmake_minimum_required(VERSION 3.18)
project(chrono_settle CXX)
find_package(Chrono CONFIG REQUIRED)
add_executable(chrono_settle "%s")
target_link_libraries(chrono_settle Chrono::Chrono_core)
""" % (packing.FOLDER / "chrono_settle.cpp").as_posix())
packing.run("cmake", "-S", "chrono", "-B", "chrono/build", "-DCMAKE_BUILD_TYPE=Release")
packing.run("cmake", "--build", "chrono/build")
rows, seconds = packing.outcome("chrono/build/chrono_settle")
for grain, row in zip(scene.grains, np.array(rows["grain"])):
    grain.place, grain.turn = row[:3] / length, row[3:]
packing.finish("Chrono", scene, [grain.spheres() for grain in scene.grains], [grain.place for grain in scene.grains],
               [(time / length ** 0.5, energy / length ** 4) for time, energy in rows["energy"]], seconds)
