#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes one self-contained wheel of the module for the Pythons of Debian 12 and 13.

    lib/python/make_wheel.py BUILD OUTPUT_FOLDER

BUILD is a configured build folder, build/release for example. The wheel contains a module for each Python,
the shared libraries that they need except those of every Linux (libc, libstdc++), and all licence texts.
Needs g++, patchelf, and Debian's archive for the headers of the other Python.
"""
import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
OTHER_PYTHONS = {"trixie": "libpython3.13-dev"}  # of which Debian suite which package
# The wheel's promise to pip. The check below rejects newer symbols.
PLATFORM = "manylinux_2_36_x86_64"
NEWEST_SYMBOLS = {"GLIBC": (2, 36), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13)}
OF_EVERY_LINUX = re.compile(r"(libc|libm|libstdc\+\+|libgcc_s|ld-linux-x86-64)\.so\.\d+$")
# Packages with code in the modules, in addition to the bundled libraries.
HEADERS_OF = ["libcgal-dev", "libboost1.74-dev", "libeigen3-dev", "libopenmesh-dev",
              "nlohmann-json3-dev", "libstb-dev", "pybind11-dev"]
METADATA = """Metadata-Version: 2.1
Name: wscvt
Version: {version}
Summary: Remeshing of scanned grains to an exact number of nodes
License: GPL-3.0-or-later
Requires-Python: >=3.11
Requires-Dist: numpy
Description-Content-Type: text/markdown

"""
WHEEL = "Wheel-Version: 1.0\nGenerator: make_wheel.py\nRoot-Is-Purelib: false\n"


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def build_modules(build):
    """Builds the module for each Python and returns their folder."""
    folders = []
    for suite, package in OTHER_PYTHONS.items():
        folders.append(build.parent / f"python-headers-{suite}")
        subprocess.run([HERE / "get_headers.sh", folders[-1], suite, package, "pybind11-dev"],
                       check=True)
    subprocess.run(["cmake", "-S", PROJECT, "-B", build, "-DWSCVT_BUILD_PYTHON=ON",
                    "-DWSCVT_PYTHON_OTHER_HEADERS=" + ";".join(map(str, folders))],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build, "--target", "wscvt_pythons"], check=True)
    return build / "lib" / "python" / "wscvt"


def libraries_of(module):
    """Returns the paths of the shared libraries to be bundled with a module."""
    lines = re.findall(r"(\S+) => (\S+)", output_of("ldd", module))
    return {name: pathlib.Path(path).resolve() for name, path in lines
            if not OF_EVERY_LINUX.match(name)}


def copyright_of(package):
    file = pathlib.Path("/usr/share/doc") / package / "copyright"
    if not file.is_file():
        sys.exit(f"There is no {file}, the licence of a library in the wheel. Install {package}.")
    return file.read_text(encoding="utf-8")


def package_of(library):
    """Returns the Debian package of a library."""
    for path in (library, pathlib.Path("/", *library.parts[2:])):  # /lib is /usr/lib
        said = subprocess.run(["dpkg", "-S", path], capture_output=True, text=True).stdout
        if said:
            return said.split(":")[0]
    sys.exit(f"No Debian package has {library}, so its licence is unknown.")


def check_symbols(file):
    for name, version in re.findall(r"\b(GLIBC|GLIBCXX|CXXABI)_([\d.]+)", output_of("objdump", "-T", file)):
        if tuple(map(int, version.split("."))) > NEWEST_SYMBOLS[name]:
            sys.exit(f"{file} needs {name}_{version}, which is newer than {PLATFORM} allows. "
                     "Build on Debian 12.")


def fill(package, licences, modules):
    """Copies modules, libraries and licence texts into the wheel's folder."""
    package.mkdir(parents=True)
    licences.mkdir(parents=True)
    for name in ("__init__.py", "__init__.pyi", "py.typed"):
        shutil.copy(modules / name, package)
    found = sorted(modules.glob("_wscvt.cpython-*.so"))
    libraries = {}
    for module in found:
        libraries.update(libraries_of(module))
        shutil.copy(module, package)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN/libs", package / module.name], check=True)
    (package / "libs").mkdir()
    for name, path in libraries.items():
        copy = package / "libs" / name
        shutil.copy(path, copy)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", copy], check=True)
    for file in package.rglob("*.so*"):
        subprocess.run(["strip", "--strip-unneeded", file], check=True)
        check_symbols(file)
    shutil.copy(PROJECT / "LICENSE", licences / "LICENSE")
    for owner in HEADERS_OF + sorted({package_of(path) for path in libraries.values()}):
        (licences / f"{owner}.txt").write_text(copyright_of(owner), encoding="utf-8")
    return [re.search(r"cpython-(\d+)", module.name)[1] for module in found]


def write_wheel(folder, wheel, info):
    """Packs the folder. Equal files give equal bytes."""
    rows = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as packed:
        def add(name, content, mode=0o644):
            entry = zipfile.ZipInfo(name, date_time=(2022, 7, 1, 0, 0, 0))
            entry.external_attr = mode << 16
            packed.writestr(entry, content, zipfile.ZIP_DEFLATED)

        for file in sorted(path for path in folder.rglob("*") if path.is_file()):
            name, content = file.relative_to(folder).as_posix(), file.read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            rows.append(f"{name},sha256={digest},{len(content)}\n")
            add(name, content, 0o755 if ".so" in name else 0o644)
        add(f"{info}/RECORD", "".join(rows) + f"{info}/RECORD,,\n")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    build, output = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    for tool in ("cmake", "patchelf", "strip", "objdump"):
        if not shutil.which(tool):
            sys.exit(f"{tool} is missing. Run: apt-get install cmake patchelf binutils")
    modules = build_modules(build)
    version = re.search(r"project\(wscvt VERSION ([\d.]+)", (PROJECT / "CMakeLists.txt").read_text())[1]
    info = f"wscvt-{version}.dist-info"
    folder = output / "wheel.part"
    shutil.rmtree(folder, ignore_errors=True)
    pythons = fill(folder / "wscvt", folder / info / "licenses", modules)
    abis = ".".join(f"cp{python}" for python in pythons)
    (folder / info / "METADATA").write_text(METADATA.format(version=version) + (HERE / "README.md").read_text())
    (folder / info / "WHEEL").write_text(WHEEL + "".join(
        f"Tag: cp{python}-cp{python}-{PLATFORM}\n" for python in pythons))
    wheel = output / f"wscvt-{version}-{abis}-{abis}-{PLATFORM}.whl"
    write_wheel(folder, str(wheel) + ".part", info)
    os.replace(str(wheel) + ".part", wheel)
    shutil.rmtree(folder)
    print(f"{wheel} is {wheel.stat().st_size / 1e6:.1f} MB, for Python "
          + " and ".join(f"{python[0]}.{python[1:]}" for python in pythons) + ".")


if __name__ == "__main__":
    main()
