#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the files of a release from a build folder.

    packages/make_release.py BUILD OUTPUT_FOLDER

OUTPUT_FOLDER gets the Debian packages, the Python wheel, the Blender add-on, an archive with all of it whose program
runs on any Linux x86-64, a Containerfile, and SHA256SUMS.
BUILD is a build folder on Debian 12, build/release for example. The archive has a plugin for each MeshLab whose
sources BUILD knows: tests/run_all.sh release adds those of 2022.02 and 2025.07.
"""
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent
sys.path.insert(0, str(PROJECT / "lib" / "python"))
sys.path.insert(0, str(HERE))
from make_static import make_static  # noqa: E402
from make_wheel import HEADERS_OF, check_symbols, copyright_of, output_of, package_of  # noqa: E402

# What else the static program holds.
OF_STATIC = {"libcli11-dev", "libc6-dev"}
# Debian's MeshLab brings all but these.
OF_PLUGIN = re.compile(r"lib(gmp|mpfr)\.so\.\d+$")
DEBIAN_12 = {"GLIBC": (2, 36), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13)}


def run(*command):
    subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)


def value_in_cache(build, name):
    found = re.search(rf"^{name}:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.MULTILINE)
    return found[1] if found else ""


def plugins_of(build):
    """Builds everything; returns the plugin's file for each version of MeshLab."""
    sources = value_in_cache(build, "MESHLAB_SOURCE_DIR")
    if not sources:
        sys.exit(f"{build} has no plugin. Configure it with MESHLAB_SOURCE_DIR.")
    versions = [(pathlib.Path(folder) / "ML_VERSION").read_text().split()[0]
                for folder in value_in_cache(build, "MESHLAB_OTHER_SOURCE_DIRS").split(";") if folder]
    targets = ["filter_wscvt_" + version.replace(".", "_") for version in versions]
    # Where the tests have the plugin for double, Debian's MeshLab wants the one for float.
    known = output_of("cmake", "--build", build, "--target", "help")
    targets = [target + "_float" * (target + "_float" in known) for target in targets]
    run("cmake", "--build", build, "--target", "wscvt", "wscvt_program_texts", "wscvt_python",
        "filter_wscvt", *targets)
    first = (pathlib.Path(sources) / "ML_VERSION").read_text().split()[0]
    plugins = {first: build / "filter_wscvt" / "libfilter_wscvt.so"}
    for version, target in zip(versions, targets):
        plugins[version] = build / "tests" / "host" / f"lib{target}.so"
    return plugins


def libraries_of(file, wanted):
    """The shared libraries of a file whose names are wanted: name and path."""
    pairs = re.findall(r"(\S+) => (/\S+)", output_of("ldd", file))
    return {name: pathlib.Path(path).resolve() for name, path in pairs if wanted(name)}


def bundle(file, target, libraries_folder, wanted):
    """Copies a program or plugin to `target` and what it needs to a folder; returns the libraries."""
    target.parent.mkdir(parents=True, exist_ok=True)
    libraries_folder.mkdir(parents=True, exist_ok=True)
    libraries = libraries_of(file, wanted)
    shutil.copy(file, target)
    up = "../" * (len(target.parts) - 1 - len(libraries_folder.parent.parts))
    copies = {target: f"$ORIGIN/{up}{libraries_folder.name}"}
    for name, path in libraries.items():
        copies[libraries_folder / name] = "$ORIGIN"
        shutil.copy(path, libraries_folder / name)
    for copy, search_path in copies.items():
        run("patchelf", "--set-rpath", search_path, copy)
        run("strip", "--strip-unneeded", copy)
        check_symbols(copy, DEBIAN_12)
    return libraries


def fill_archive(folder, build, plugins, output):
    """Puts the files of the archive into a folder."""
    (folder / "bin").mkdir(parents=True)
    inside = make_static(build, folder / "bin" / "wscvt")
    used = {}
    for version, plugin in plugins.items():
        place = folder / "meshlab" / version
        used.update(bundle(plugin, place / "libfilter_wscvt.so", place / "wscvt-libraries", OF_PLUGIN.match))
    for script in (PROJECT / "filter_wscvt").glob("*.mlx"):
        shutil.copy(script, folder / "meshlab")
    texts = build / "lib" / "program_texts"
    shutil.copytree(texts / "man", folder / "share" / "man" / "man1")
    completions = folder / "share" / "bash-completion" / "completions"
    completions.mkdir(parents=True)
    shutil.copy(texts / "wscvt", completions)
    for made, place in ((".whl", "python"), (".zip", "blender")):
        (folder / place).mkdir()
        for file in output.glob("*" + made):
            shutil.copy(file, folder / place)
    shutil.copy(HERE / "README.txt", folder)
    for name in ("LICENSE", "CHANGELOG.md", "CITATION.cff", "meshes/sand_7228.ply"):
        (folder / name).parent.mkdir(exist_ok=True)
        shutil.copy(PROJECT / name, folder / name)
    for name, source in (("program", "lib"), ("meshlab", "filter_wscvt"), ("python", "lib/python"),
                         ("blender", "filter_wscvt/host_blender")):
        (folder / "doc").mkdir(exist_ok=True)
        shutil.copy(PROJECT / source / "README.md", folder / "doc" / f"{name}.md")
    (folder / "licences").mkdir()
    owners = {package_of(path) for path in [*used.values(), *inside]} - set(HEADERS_OF)
    for owner in HEADERS_OF + sorted(owners | OF_STATIC):
        (folder / "licences" / f"{owner}.txt").write_text(copyright_of(owner), encoding="utf-8")


def write_archive(folder, archive):
    """Packs the folder; the same files make the same bytes."""
    def plain(entry):
        entry.uid = entry.gid = 0
        entry.uname = entry.gname = "root"
        entry.mtime = 1656633600
        entry.mode = 0o755 if entry.mode & 0o100 else 0o644
        return entry

    with tarfile.open(archive, "w:xz", preset=6) as packed:
        for path in [folder, *sorted(folder.rglob("*"))]:
            packed.add(path, path.relative_to(folder.parent).as_posix(), recursive=False, filter=plain)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    build, output = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    for tool in ("cmake", "cpack", "patchelf", "strip", "objdump"):
        if not shutil.which(tool):
            sys.exit(f"{tool} is missing. Run: apt-get install cmake patchelf binutils")
    shutil.rmtree(output, ignore_errors=True)
    output.mkdir(parents=True)
    plugins = plugins_of(build)
    part = output / "part"
    subprocess.run(["cpack", "-G", "DEB", "-B", part / "deb"], check=True, cwd=build,
                   stdout=subprocess.DEVNULL)
    for package in (part / "deb").glob("*.deb"):
        shutil.move(package, output)
    run(PROJECT / "lib" / "python" / "make_wheel.py", build, output)
    run(PROJECT / "filter_wscvt" / "host_blender" / "make_addon.py", next(output.glob("*.whl")), output)
    version = value_in_cache(build, "CMAKE_PROJECT_VERSION")
    folder = part / f"wscvt-{version}-linux-x86_64"
    fill_archive(folder, build, plugins, output)
    write_archive(folder, output / f"{folder.name}.tar.xz")
    shutil.rmtree(part)
    shutil.copy(HERE / "Containerfile", output)
    files = sorted(output.iterdir())
    (output / "SHA256SUMS").write_text("".join(
        f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in files))
    for file in files:
        print(f"{file.stat().st_size / 1e6:8.1f} MB  {file.name}")
    print(f"Plugins for MeshLab {', '.join(sorted(plugins))}.")
    if "@example.org" in value_in_cache(build, "WSCVT_MAINTAINER"):
        print("The Debian packages name no maintainer who can be reached. Before you distribute them, configure "
              "with -DWSCVT_MAINTAINER=\"Name <address>\".")


if __name__ == "__main__":
    main()
