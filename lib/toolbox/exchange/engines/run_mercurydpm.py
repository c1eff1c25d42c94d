# SPDX-License-Identifier: GPL-3.0-or-later
"""Clumps of this folder in MercuryDPM:

    MERCURYDPM=SOURCE MERCURYDPM_BUILD=BUILD python3 run.py [COUNT]

SOURCE is MercuryDPM's source, and BUILD the folder where it was built. Compiles mercurydpm_settle.cpp against
them. See packing.py for scene.json.
"""
import os
import pathlib

import packing
from packing import np

source, build = (pathlib.Path(os.environ.get(name, "")) for name in ("MERCURYDPM", "MERCURYDPM_BUILD"))
header = source / "Drivers/Clump/ClumpHeaders/Mercury3DClump.h"
if not header.exists() or not (build / "Kernel/libMercuryBase.a").exists():
    packing.leave("Set MERCURYDPM to MercuryDPM's source, which has Drivers/Clump, and MERCURYDPM_BUILD to the "
                  "folder where it was built.")
scene = packing.Scene()
scene.write_clumps("packing.scene")
packing.run("g++", "-std=c++17", "-O2", "-I", source / "Kernel", "-I", build / "Kernel", "-I", header.parent,
            packing.FOLDER / "mercurydpm_settle.cpp", "-o", "mercurydpm_settle", build / "Kernel/libMercuryBase.a",
            build / "Kernel/Math/libLinearAlgebra.a", "-lgfortran")
rows, seconds = packing.outcome("./mercurydpm_settle")
spheres = np.array(rows["sphere"])
packing.finish("MercuryDPM", scene, [spheres[spheres[:, 0] == k, 1:] for k in range(len(scene.grains))], rows["grain"],
               rows["energy"], seconds)
