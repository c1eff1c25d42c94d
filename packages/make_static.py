#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Links the program of a build once more, as one file without any shared library.

    packages/make_static.py BUILD OUTPUT_FILE

The file runs on every Linux of x86-64, of any age and C library. BUILD is a build folder of Debian 12, whose object
files it takes. OpenMesh and ITK have no static library in Debian: they are built in BUILD/static, once, from Debian's
sources, of which ITK's are 280 MB.
"""
import pathlib
import shlex
import shutil
import subprocess
import sys

PROJECT = pathlib.Path(__file__).resolve().parent.parent
SYSTEM = pathlib.Path("/usr/lib/x86_64-linux-gnu")
# What the static libraries of the formats need in their turn; of their shared ones the loader knows it.
BEHIND = ["znz", "jpeg", "lzma", "zstd", "jbig", "deflate", "webp", "Lerc", "sz", "aec", "z"]
ITK = ["ITKCommon", "itkvnl_algo", "itkvnl", "itksys"]


def run(*command, **more):
    done = subprocess.run(list(map(str, command)), check=False, capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{shlex.join(map(str, command))}\nfailed:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def openmesh(work):
    """The static library of OpenMesh's core."""
    library = work / "libOpenMeshCore.a"
    if not library.exists():
        source = work / "openmesh"
        run(PROJECT / "packages" / "debian_source.sh", "openmesh", source)
        objects = work / "openmesh-objects"
        objects.mkdir(exist_ok=True)
        run("sh", "-c", 'ls "$1"/src/OpenMesh/Core/*/*.cc | xargs -P "$(nproc)" -n 4 c++ -O2 -fPIC -w -I "$1/src" -c',
            "sh", source, cwd=objects)
        run("ar", "rcs", library, *sorted(objects.glob("*.o")))
    return [library]


def itk(work):
    """The static libraries of ITK's common part, and of those that it brings along."""
    built = work / "itk-build"
    if not (built / "whole").exists():
        source = work / "itk"
        run(PROJECT / "packages" / "debian_source.sh", "insighttoolkit5", source)
        run("cmake", "-S", source, "-B", built, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_SHARED_LIBS=OFF",
            "-DCMAKE_POSITION_INDEPENDENT_CODE=ON", "-DBUILD_TESTING=OFF", "-DBUILD_EXAMPLES=OFF",
            "-DITK_BUILD_DEFAULT_MODULES=OFF", "-DModule_ITKCommon=ON", "-DITK_USE_SYSTEM_EIGEN=ON",
            "-DITK_FORBID_DOWNLOADS=ON")
        run("cmake", "--build", built, "--target", *ITK)
        shutil.rmtree(source)
        (built / "whole").touch()
    return sorted((built / "lib").glob("*.a"))


def static_of(library):
    """The static library beside a shared one of Debian."""
    name = library.name.split(".so")[0].replace("libhdf5", "libhdf5_serial")
    found = SYSTEM / f"{name}.a"
    if not found.exists():
        sys.exit(f"There is no static library {found} for {library}.")
    return found


def make_static(build, output):
    """Returns the static libraries of Debian that are in the file."""
    run("cmake", "--build", build, "--target", "wscvt_program")
    work = build / "static"
    work.mkdir(exist_ok=True)

    # What the shared program is linked of.
    words = shlex.split(run("ninja", "-C", build, "-t", "commands", "-s", "lib/wscvt").splitlines()[-1])
    own = [build / word for word in words if word.endswith((".o", ".a")) and not word.startswith("/")]
    shared = [pathlib.Path(word) for word in words if ".so" in word and word.startswith("/")]
    built = openmesh(work) + (itk(work) if any("ITK" in path.name for path in shared) else [])
    of_debian = [static_of(path) for path in shared if not path.name.lower().startswith(("libitk", "libopenmesh"))]
    of_debian += [pathlib.Path(word) for word in words if word.endswith(".a") and word.startswith("/")]
    of_debian += [SYSTEM / f"lib{name}.a" for name in BEHIND]
    part = output.with_name(output.name + ".part")
    run("c++", "-static", "-s", "-o", part, *own, "-Wl,--start-group", *built, *of_debian,
        "-Wl,--end-group")
    if "NEEDED" in run("readelf", "-d", part):
        sys.exit(f"{part} needs shared libraries.")
    part.rename(output)
    return of_debian


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    make_static(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:]))
