#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes one self-contained wheel of the module for many Pythons and glibc 2.31 or later.

    lib/python/make_wheel.py BUILD OUTPUT_FOLDER

BUILD is a configured build folder of Debian 12, build/release for example. The wheel contains a module for each Python
with the library of C++ inside, the shared libraries that they need except those of every Linux, and all licence texts.
The headers of Python 3.9, 3.13, 3.14 and 3.15 are in Debian's archive. Those of 3.10 and 3.12 are not: the wheel serves
them if a program python3.10 or python3.12 is on PATH and has its headers. The last line says which Pythons it serves.
Needs g++, patchelf, and Debian's archive also for glibc 2.31 and, once, for ITK's sources, 280 MB.
"""
import base64
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
sys.path.insert(0, str(PROJECT / "packages"))
from make_static import SYSTEM, itk, openmesh  # noqa: E402

PYTHONS = [f"python3.{minor}" for minor in range(9, 16)]
# Which Debian suite has the headers of which Pythons, and a pybind11 that knows all of them.
OTHER_PYTHONS = {"bullseye": ["libpython3.9-dev"], "trixie": ["libpython3.13-dev"],
                 "forky": ["libpython3.14-dev", "libpython3.15-dev", "pybind11-dev"]}
# The C library that the modules are linked with. They load with every later one.
OLD_SUITE, OLD_LIBRARY = "bullseye", ["libc6", "libc6-dev"]
# The wheel's promise to pip. The check below rejects newer symbols.
PLATFORM = "manylinux_2_31_x86_64"
NEWEST_SYMBOLS = {"GLIBC": (2, 31)}
OF_EVERY_LINUX = re.compile(r"(libc|libm|libpthread|libgcc_s|ld-linux-x86-64)\.so\.\d+$")
# What GCC 12 asks of glibc 2.32 or later: whether there is one thread. "No" only costs time.
SINGLE_THREADED = '__attribute__((visibility("hidden"))) char __libc_single_threaded = 0;'
# Packages with code in the modules, in addition to the bundled libraries.
HEADERS_OF = ["libcgal-dev", "libboost1.74-dev", "libeigen3-dev", "libopenmesh-dev", "libinsighttoolkit5-dev",
              "libstdc++-12-dev", "nlohmann-json3-dev", "libstb-dev", "pybind11-dev", "zlib1g-dev"]
METADATA = """Metadata-Version: 2.1
Name: wscvt
Version: {version}
Summary: Remeshing of scanned grains to an exact number of nodes
License: GPL-3.0-or-later
Requires-Python: >=3.9
Requires-Dist: numpy
Description-Content-Type: text/markdown

"""
WHEEL = "Wheel-Version: 1.0\nGenerator: make_wheel.py\nRoot-Is-Purelib: false\n"


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def packages_of(folder, suite, packages):
    """Unpacks packages of another Debian into a folder once, and returns it."""
    subprocess.run([HERE / "get_headers.sh", folder, suite, *packages], check=True)
    return folder


def configure(build, *choices):
    subprocess.run(["cmake", "-S", PROJECT, "-B", build, "-DWSCVT_BUILD_PYTHON=ON", *choices],
                   check=True, stdout=subprocess.DEVNULL)


def headers_on_path(python):
    """Returns the folder of Python.h of a program on PATH, or nothing."""
    if shutil.which(python):
        said = subprocess.run([python, "-c", "import sysconfig; print(sysconfig.get_path('include'))"],
                              capture_output=True, text=True).stdout.strip()
        if pathlib.Path(said, "Python.h").is_file():
            return pathlib.Path(said)


def build_modules(build):
    """Builds the module for each Python and returns the files."""
    configure(build, "-UWSCVT_PYTHON_OTHER_HEADERS")  # of an earlier wheel
    own = re.search(r"^PYTHON_MODULE_EXTENSION.*cpython-3(\d+)", (build / "CMakeCache.txt").read_text(), re.M)[1]
    archive = [packages_of(build.parent / f"python-headers-{suite}", suite, packages) / "usr" / "include"
               for suite, packages in OTHER_PYTHONS.items()]
    headers = {path.name: path for folder in archive for path in folder.glob("python3.*")}
    headers.update((python, path) for python in PYTHONS if python not in headers and (path := headers_on_path(python)))
    headers.pop(f"python3.{own}", None)
    configure(build, "-DWSCVT_PYTHON_OTHER_HEADERS=" + ";".join(map(str, headers.values())),
              f"-DWSCVT_PYTHON_OTHER_PYBIND11={archive[-1]}")
    subprocess.run(["cmake", "--build", build, "--target", "wscvt_pythons"], check=True)
    folder = build / "lib" / "python" / "wscvt"
    minors = sorted(int(minor) for minor in [own, *(name.split(".")[1] for name in headers)])
    return [next(folder.glob(f"_wscvt.cpython-3{minor}-*.so")) for minor in minors]


def link_for_old_linux(build, module, made):
    """Links a module once more, with the old C library, and with that of C++, OpenMesh and ITK inside."""
    root = packages_of(build.parent / f"glibc-{OLD_SUITE}", OLD_SUITE, OLD_LIBRARY)
    libraries = root / "lib" / SYSTEM.name
    # Debian's link to the loader is an absolute one.
    loader = root / "lib64" / "ld-linux-x86-64.so.2"
    if loader.is_symlink() and not loader.exists():
        loader.unlink()
        loader.symlink_to(next(libraries.glob("ld-2*.so")))
    words = shlex.split(output_of("ninja", "-C", build, "-t", "commands", "-s",
                                  module.relative_to(build)).splitlines()[-1])
    own = [build / word for word in words if word.endswith((".o", ".a")) and not word.startswith("/")]
    work = build / "static"
    work.mkdir(exist_ok=True)
    (work / "single_threaded.c").write_text(SINGLE_THREADED)
    single_threaded = work / "single_threaded.o"
    output_of("cc", "-c", "-fPIC", work / "single_threaded.c", "-o", single_threaded)
    built = openmesh(work) + (itk(work) if any("libITK" in word for word in words) else [])
    # Nobody else sees what is inside: another module may have another library of C++.
    output_of("c++", "-shared", "-s", f"--sysroot={root}", f"-L{root}/usr/lib/{SYSTEM.name}", f"-L{libraries}", "-o",
              made, "-static-libstdc++", "-Wl,--exclude-libs,ALL", "-Wl,--gc-sections", "-Wl,--as-needed", *own,
              single_threaded, "-Wl,--start-group", *built, "-Wl,--end-group", SYSTEM / "libmpfr.so",
              SYSTEM / "libgmp.so", SYSTEM / "libz.a", libraries / "libpthread.so.0", libraries / "libdl.so.2")


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


def check_symbols(file, newest):
    """Ends the program if a file needs a newer version of a library than `newest`, or one that is not in there."""
    for name, version in re.findall(r"\b(GLIBC|GLIBCXX|CXXABI)_([\d.]+)", output_of("objdump", "-T", file)):
        if tuple(map(int, version.split("."))) > newest.get(name, (0,)):
            sys.exit(f"{file} needs {name}_{version}, which its users may not have. Build on Debian 12.")


def version_of(module):
    """The Python of a module, such as "311"."""
    return re.search(r"cpython-(\d+)", module.name)[1]


def fill(package, licences, modules, build):
    """Copies modules, libraries and licence texts into the wheel's folder."""
    package.mkdir(parents=True)
    licences.mkdir(parents=True)
    for name in ("__init__.py", "__init__.pyi", "py.typed"):
        shutil.copy(modules[0].with_name(name), package)
    libraries = {}
    for module in modules:
        link_for_old_linux(build, module, package / module.name)
        libraries.update(libraries_of(package / module.name))
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN/libs", package / module.name], check=True)
    (package / "libs").mkdir()
    for name, path in libraries.items():
        copy = package / "libs" / name
        shutil.copy(path, copy)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", copy], check=True)
    for file in package.rglob("*.so*"):
        subprocess.run(["strip", "--strip-unneeded", file], check=True)
        check_symbols(file, NEWEST_SYMBOLS)
    shutil.copy(PROJECT / "LICENSE", licences / "LICENSE")
    for owner in HEADERS_OF + sorted({package_of(path) for path in libraries.values()}):
        (licences / f"{owner}.txt").write_text(copyright_of(owner), encoding="utf-8")
    return [version_of(module) for module in modules]


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
    for tool in ("cmake", "ninja", "patchelf", "strip", "objdump"):
        if not shutil.which(tool):
            sys.exit(f"{tool} is missing. Run: apt-get install cmake ninja-build patchelf binutils")
    modules = build_modules(build)
    version = re.search(r"project\(wscvt VERSION ([\d.]+)", (PROJECT / "CMakeLists.txt").read_text())[1]
    info = f"wscvt-{version}.dist-info"
    folder = output / "wheel.part"
    shutil.rmtree(folder, ignore_errors=True)
    pythons = fill(folder / "wscvt", folder / info / "licenses", modules, build)
    abis = ".".join(f"cp{python}" for python in pythons)
    (folder / info / "METADATA").write_text(METADATA.format(version=version) + (HERE / "README.md").read_text())
    (folder / info / "WHEEL").write_text(WHEEL + "".join(
        f"Tag: cp{python}-cp{python}-{PLATFORM}\n" for python in pythons))
    wheel = output / f"wscvt-{version}-{abis}-{abis}-{PLATFORM}.whl"
    write_wheel(folder, str(wheel) + ".part", info)
    os.replace(str(wheel) + ".part", wheel)
    shutil.rmtree(folder)
    served = [f"python{python[0]}.{python[1:]}" for python in pythons]
    print(f"{wheel} is {wheel.stat().st_size / 1e6:.1f} MB, for {', '.join(served)}.")
    for python in PYTHONS:
        if python not in served:
            print(f"It does not serve {python}. Put a program {python} with its headers on PATH and make the wheel again.")


if __name__ == "__main__":
    main()
