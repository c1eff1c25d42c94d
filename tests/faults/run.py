#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts faults into the library, one at a time, and looks whether the tests notice.

  tests/faults/run.py [--check] [--table] [--build DIRECTORY] [--jobs NUMBER] [WORD ...]

faults.txt lists the faults; WORDs keep those whose room, title or file holds one of them. Each is
put into a copy of the sources under DIRECTORY (build/faults), the tests of its own subject are
built and run, and the fault is taken out again. The tree itself is only read, so that it is as it
was also after an interruption. A fault is killed when a test fails, crashes, or takes ten times as
long as without it. --check only tells whether every fault still finds its place; after a change of
the library that is to be mended in faults.txt. --table writes what came of them into README.md,
where the rows of faults that were not tried stay as they are.

Exit code 0: every fault is killed, or survives for the reason that faults.txt gives. A run takes as
long as a build and half a minute a fault. With --jobs there are several copies, each of which is
built: only worth it with ccache, which is used where it is installed.
"""

import argparse
import concurrent.futures
import filecmp
import os
import pathlib
import queue
import re
import shutil
import subprocess
import sys
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FIELDS = {"file", "find", "replace", "tests", "survives"}


class Fault:
    def __init__(self, room, title, line):
        self.room, self.title, self.line = room, title, line
        self.file = self.find = self.tests = None
        self.replace = ""
        self.survives = None

    @property
    def target(self):
        return self.tests.partition(" ")[0]

    @property
    def names(self):
        return self.tests.partition(" ")[2] or "*"

    def place(self, root):
        """The one file that the text to find stands in, once; a sentence where there is none."""
        places = [path for path in sorted(root.glob(self.file)) if self.find in path.read_text()]
        uses = sum(path.read_text().count(self.find) for path in places)
        if uses != 1:
            return None, "the text to find stands %d times in %s" % (uses, self.file)
        return places[0], ""


def read_faults(path):
    faults = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        head = re.fullmatch(r"\[(\w+)\] (.+)", line)
        if head:
            faults.append(Fault(head.group(1), head.group(2), number))
            continue
        field, _, value = line.partition(" ")
        if field not in FIELDS or not faults:
            sys.exit("%s:%d: no such field: %s" % (path, number, line))
        setattr(faults[-1], field, value.strip())
    for fault in faults:
        if not (fault.file and fault.find and fault.tests):
            sys.exit("%s:%d: a fault needs file, find and tests" % (path, fault.line))
    return faults


def copy_tree(to):
    """Brings the copy to the tree's present state; files that are the same keep their time."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.splitlines()
    kept = set()
    for name in listed:
        source, target = ROOT / name, to / name
        if not source.is_file():
            continue
        kept.add(target)
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.is_file() or not filecmp.cmp(source, target, shallow=False):
            shutil.copyfile(source, target)
            shutil.copymode(source, target)
    for path in to.rglob("*"):
        if path.is_file() and path not in kept and "build" not in path.relative_to(to).parts:
            path.unlink()


class Build:
    def __init__(self, directory):
        # Built where a checkout is built, so that ccache knows what has not changed.
        self.source, self.binaries = directory, directory / "build" / "release"
        self.environment = dict(os.environ, CCACHE_BASEDIR=str(self.source))
        self.source.mkdir(parents=True, exist_ok=True)
        copy_tree(self.source)
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        self.run(["cmake", "--preset", "release", "-DWSCVT_WARNINGS_AS_ERRORS=ON"] + launcher,
                 600).check_returncode()

    def run(self, command, seconds):
        return subprocess.run(command, env=self.environment, cwd=self.source, timeout=seconds,
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def make(self, target):
        return self.run(["cmake", "--build", str(self.binaries), "--target", target], 3600)

    def test(self, target, names, seconds):
        """Whether the tests pass, how many ran, and the first that failed."""
        command = [str(self.binaries / "tests" / target), "--gtest_filter=" + names]
        try:
            done = self.run(command, seconds)
        except subprocess.TimeoutExpired:
            return False, 0, "does not end"
        ran = re.search(r"\[=+\] (\d+) tests? from .* ran", done.stdout)
        failed = re.search(r"\[  FAILED  \] ([\w./]+)", done.stdout)
        what = failed.group(1) if failed else "crash" if done.returncode else ""
        return done.returncode == 0, int(ran.group(1)) if ran else 0, what


def try_faults(build, faults):
    """Yields each fault, what came of it, and whether that is as it should be."""
    target = faults[0].target
    made = build.make(target)
    if made.returncode:
        sys.exit(made.stdout + "\nThe library does not build without any fault.")
    seconds = {}
    for names in sorted({fault.names for fault in faults}):
        start = time.monotonic()
        passed, ran, what = build.test(target, names, 1200)
        seconds[names] = time.monotonic() - start
        if not passed or not ran:
            sys.exit("Without any fault: %s %s: %s" % (target, names, what or "no such test"))
    for fault in faults:
        path, _ = fault.place(build.source)
        text = path.read_text()
        path.write_text(text.replace(fault.find, fault.replace))
        try:
            made = build.make(target)
            if made.returncode:
                error = re.search(r"error: .*", made.stdout)
                yield fault, "does not compile: " + (error.group(0) if error else ""), False
                continue
            passed, _, what = build.test(target, fault.names, 60 + 10 * seconds[fault.names])
        finally:
            path.write_text(text)
        verdict = "SURVIVES" if passed else "killed by " + what
        if fault.survives is not None:
            verdict += " (expected to survive: %s)" % fault.survives
        yield fault, verdict, passed == (fault.survives is not None)


def write_table(verdicts):
    """Puts (fault, verdict) into the table of README.md, in the order of faults.txt."""
    path = HERE / "README.md"
    head, mark, old = path.read_text().partition("| room | fault | what came of it |\n|---|---|---|\n")
    rows = {}
    for line in old.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 3:
            rows[cells[0], cells[1]] = cells[2]
    rows.update({(fault.room, fault.title): verdict for fault, verdict in verdicts})
    faults = read_faults(HERE / "faults.txt")
    path.write_text(head + mark + "".join(
        "| %s | %s | %s |\n" % (fault.room, fault.title,
                                rows.get((fault.room, fault.title), "not tried"))
        for fault in faults))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "faults")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("words", nargs="*")
    arguments = parser.parse_args()

    faults = [fault for fault in read_faults(HERE / "faults.txt")
              if not arguments.words or any(word in " ".join((fault.room, fault.title, fault.file))
                                            for word in arguments.words)]
    lost = 0
    for fault in faults:
        path, why = fault.place(ROOT)
        if path is None:
            lost += 1
            print("faults.txt:%d: [%s] %s: %s" % (fault.line, fault.room, fault.title, why))
    if arguments.check or lost:
        print("%d of %d faults find their place" % (len(faults) - lost, len(faults)))
        return 1 if lost else 0

    # Test program by test program, so that each is built by one worker only.
    groups = {}
    for fault in faults:
        groups.setdefault(fault.target, []).append(fault)
    waiting = queue.Queue()
    for group in groups.values():
        waiting.put(group)
    verdicts = []
    one_at_a_time = threading.Lock()

    def work(number):
        build = Build(arguments.build.resolve() / str(number))
        while True:
            try:
                group = waiting.get_nowait()
            except queue.Empty:
                return
            for fault, verdict, good in try_faults(build, group):
                with one_at_a_time:
                    verdicts.append((fault, verdict, good))
                    if arguments.table:  # at once: a run may be ended before its end
                        write_table([(each, what) for each, what, _ in verdicts])
                print("%s %-12s %-72s %s" % (" " if good else "!", fault.room, fault.title, verdict),
                      flush=True)

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as workers:
        for done in [workers.submit(work, number) for number in range(arguments.jobs)]:
            done.result()
    killed = sum(verdict.startswith("killed") for _, verdict, _ in verdicts)
    surviving = sum(verdict.startswith("SURVIVES") for _, verdict, _ in verdicts)
    wrong = sum(not good for _, _, good in verdicts)
    print("%d faults: %d killed, %d surviving, %d not as they should be"
          % (len(faults), killed, surviving, wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
