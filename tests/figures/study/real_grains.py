#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of remeshes of real scans, which are not in this repository.

    tests/figures/study/real_grains.py PROGRAM FOLDER [--nodes 100 500 1000 5000] [options of the program]

Remeshes every mesh file of FOLDER with PROGRAM (build/release/lib/wscvt) and prints one row per number of
nodes: mean edge ratio, coefficient of variation of the edge length, smallest angle, two-sided rms and
largest distance in % of the equivalent radius, errors of area and volume in %, intersecting
triangle pairs, seconds of the whole process with distances, and the number of warnings.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

MESHES = {".ply", ".stl", ".obj", ".off"}


def remesh(program, scan, nodes, options):
    """The report of a remesh and its seconds, or the sentence of a refusal."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        command = [program, scan, pathlib.Path(folder) / "remesh.ply", "-q", "-n", str(nodes)]
        start = time.monotonic()
        run = subprocess.run(
            [str(part) for part in command + ["--distances", "--report", report] + options],
            capture_output=True, text=True, check=False)
        seconds = time.monotonic() - start
        if run.returncode != 0:
            return None, run.stderr.strip().splitlines()[-1] if run.stderr.strip() else "no reason"
        return json.loads(report.read_text()), seconds


def row(name, nodes, report, seconds):
    quality = report["quality"]["remesh"]
    percent = 100.0 / report["input"]["equivalent_radius"]
    errors = report["descriptors"]
    return (f"| `{name}` | {nodes} | {quality['edge_ratio']['mean']:.3f} "
            f"| {quality['edge_variation']:.3f} | {quality['smallest_angle_degrees']:.1f} "
            f"| {percent * report['distances']['root_mean_square']:.3f} "
            f"| {percent * report['distances']['largest']:.2f} "
            f"| {errors['area']['error_percent']:+.2f} | {errors['volume']['error_percent']:+.0e} "
            f"| {report['on_scan']['self_intersections']} | {seconds:.2f} "
            f"| {len(report['warnings'])} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--nodes", type=int, nargs="+", default=[100, 500, 1000, 5000])
    arguments, options = parser.parse_known_args()
    scans = sorted(p for p in arguments.folder.iterdir() if p.suffix.lower() in MESHES)
    if not scans:
        sys.exit(f"{arguments.folder} holds no mesh file.")
    print("| scan | N | ratio | ECV | angle | rms | largest | area | volume | pairs | s "
          "| warnings |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for scan in scans:
        for nodes in arguments.nodes:
            report, told = remesh(arguments.program, scan, nodes, options)
            if report is None:
                print(f"| `{scan.name}` | {nodes} | refused: {told} |")
            else:
                print(row(scan.name, nodes, report, told), flush=True)


if __name__ == "__main__":
    main()
