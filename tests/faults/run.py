#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts faults into the sources, one at a time, and checks that the tests notice them.

  tests/faults/run.py [--check] [--changed COMMIT] [--build DIRECTORY] [--jobs NUMBER] [WORD ...]

faults.txt lists the faults. WORDs keep faults whose folder, title or file contains one of them.
--changed keeps faults in files that differ from a commit. The script puts each fault into a copy of
the sources under DIRECTORY (build/faults), builds what its tests need, runs the tests of the same
subject, and removes the fault. It only reads the tree itself, so an interruption changes nothing
there. A fault is killed if a test fails, crashes, or takes ten times as long as without it.

A fault whose text is gone, because the source has changed, is printed as one that no longer applies,
and is skipped. Correct it or delete it in faults.txt. --check prints these and tries none.

Exit code 0: every fault that applies is killed, or survives for the reason in faults.txt. A run takes
as long as a build and half a minute per fault: a night. --jobs makes and builds several copies: use it
only with ccache, which the script uses if it is installed. The results are printed and kept nowhere.
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
FIELDS = {"file", "find", "replace", "tests", "elsewhere", "survives"}


class Tests:
    """A line "PROGRAM [FILTER]": a test program and its filter, or "ctest:TARGET,... REGEX": the
    tests of ctest whose names the regular expression finds, and what they need built."""

    def __init__(self, line):
        self.program, _, self.names = line.partition(" ")
        self.uses_ctest = self.program.startswith("ctest:")
        self.targets = (self.program.partition(":")[2].split(",") if self.uses_ctest
                        else [self.program])
        if not self.uses_ctest:
            self.names = self.names or "*"

    def command(self, binaries):
        if self.uses_ctest:
            return ["ctest", "--test-dir", str(binaries), "-R", self.names, "--output-on-failure",
                    "--no-tests=error"]
        return [str(binaries / "tests" / self.folder / self.program),
                "--gtest_filter=" + self.names]

    @property
    def folder(self):
        return "host" if self.program == "host_tests" else "."


class Fault:
    def __init__(self, room, title, line):
        self.room, self.title, self.line = room, title, line
        self.file = self.find = self.tests = self.elsewhere = self.survives = None
        self.replace = ""

    def all_tests(self):
        """(tests, how a kill by them is told): first those of the fault's own subject."""
        yield Tests(self.tests), "killed by "
        if self.elsewhere:
            yield Tests(self.elsewhere), "killed elsewhere by "

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
            field = ""
            continue
        if line.startswith("  ") and faults and field:
            setattr(faults[-1], field, getattr(faults[-1], field) + "\n" + line.rstrip())
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
        self.seconds = {}  # see seconds_without
        self.source.mkdir(parents=True, exist_ok=True)
        copy_tree(self.source)
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        # One object a file: a fault then costs one file's compilation.
        options = ["-DWSCVT_QUICK_BUILD=OFF", "-DWSCVT_WARNINGS_AS_ERRORS=ON"]
        if (ROOT / "build" / "meshlab-source").is_dir():
            options.append("-DMESHLAB_SOURCE_DIR=%s" % (ROOT / "build" / "meshlab-source"))
        configured = self.run(["cmake", "--preset", "release"] + options + launcher, 600)
        if configured.returncode:
            sys.exit(configured.stdout)

    def run(self, command, seconds):
        # Tests print bytes of files, too.
        return subprocess.run(command, env=self.environment, cwd=self.source, timeout=seconds,
                              text=True, errors="replace", stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)

    def make(self, targets):
        return self.run(["cmake", "--build", str(self.binaries), "--target"] + targets, 3600)

    def test(self, tests, seconds):
        """Whether the tests pass, and the first that failed."""
        try:
            done = self.run(tests.command(self.binaries), seconds)
        except subprocess.TimeoutExpired:
            return False, "a run that does not end"
        failed = (re.search(r"\[  FAILED  \] ([\w./]+)", done.stdout) or
                  re.search(r"FAILED .*::(\w+)", done.stdout) or
                  re.search(r"Test +#\d+: (\S+) .*\*\*\*", done.stdout))
        none = re.search(r"^\[=+\] 0 tests from .* ran", done.stdout, re.MULTILINE)
        what = failed.group(1) if failed else "a crash" if done.returncode else ""
        return (False, "no such test") if none else (done.returncode == 0, what)

    def seconds_without(self, tests):
        """How long the tests take without any fault; a sentence where they do not pass then."""
        key = tests.program, tests.names
        if key not in self.seconds:
            made = self.make(tests.targets)
            if made.returncode:
                sys.exit(made.stdout + "\nThe sources do not build without any fault.")
            start = time.monotonic()
            passed, what = self.test(tests, 1200)
            self.seconds[key] = (time.monotonic() - start if passed else
                                 "without any fault %s %s: %s" % (tests.program, tests.names, what))
        return self.seconds[key]


def try_fault(build, fault):
    """What came of a fault, and whether that is as it should be."""
    path, _ = fault.place(build.source)
    for tests, _ in fault.all_tests():
        seconds = build.seconds_without(tests)
        if isinstance(seconds, str):
            return seconds, False
    text = path.read_text()
    path.write_text(text.replace(fault.find, fault.replace))
    verdict = "SURVIVES"
    try:
        for tests, killed in fault.all_tests():
            made = build.make(tests.targets)
            if made.returncode:
                error = re.search(r"error: .*", made.stdout)
                return "does not compile: " + (error.group(0) if error else ""), False
            passed, what = build.test(tests, 60 + 10 * build.seconds_without(tests))
            if not passed:
                verdict = killed + what
                break
    finally:
        path.write_text(text)
    if fault.survives is not None:
        verdict += " (expected to survive: %s)" % fault.survives
    return verdict, verdict.startswith("SURVIVES") == (fault.survives is not None)


def changed_since(commit):
    """Files that differ from a commit, also those that are not committed."""
    listed = subprocess.run(["git", "diff", "--name-only", commit], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.splitlines()
    return set(listed)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--changed", metavar="COMMIT")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "faults")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("words", nargs="*")
    arguments = parser.parse_args()

    faults = [fault for fault in read_faults(HERE / "faults.txt")
              if not arguments.words or any(word in " ".join((fault.room, fault.title, fault.file))
                                            for word in arguments.words)]
    changed = changed_since(arguments.changed) if arguments.changed else None
    lost = 0
    kept = []
    for fault in faults:
        path, why = fault.place(ROOT)
        if path is None:
            lost += 1
            print("no longer applies: faults.txt:%d: [%s] %s: %s"
                  % (fault.line, fault.room, fault.title, why))
        elif changed is None or str(path.relative_to(ROOT)) in changed:
            kept.append(fault)
    print("%d of %d faults apply" % (len(faults) - lost, len(faults)), flush=True)
    if arguments.check:
        return 0

    faults = kept
    # Test program by test program, so that each is built by one worker only.
    groups = {}
    for fault in faults:
        groups.setdefault(Tests(fault.tests).program, []).append(fault)
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
            for fault in group:
                verdict, good = try_fault(build, fault)
                with one_at_a_time:
                    verdicts.append((fault, verdict, good))
                print("%s %-12s %-72s %s" % (" " if good else "!", fault.room, fault.title, verdict),
                      flush=True)

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as workers:
        for done in [workers.submit(work, number) for number in range(arguments.jobs)]:
            done.result()
    killed = sum(verdict.startswith("killed") for _, verdict, _ in verdicts)
    surviving = sum(verdict.startswith("SURVIVES") for _, verdict, _ in verdicts)
    wrong = sum(not good for _, _, good in verdicts)
    print("%d faults: %d killed, %d surviving, %d not as they should be"
          % (len(verdicts), killed, surviving, wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
