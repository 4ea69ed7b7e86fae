#!/usr/bin/env python3
"""Mutation check: does the short test suite notice each fault of scripts/mutants.txt?

Copies the last commit, applies one fault after the other, builds, and runs the tests of the fault's own room and of those
above it (kernel, adaptation, stages, batch, the properties), stopping at the first that fails. Prints the score and the survivors; exits 1 below 95 %.

  scripts/mutation.py [--work DIR] [--jobs N] [--only REGEX] [--check]

  --only REGEX only faults whose line matches         --check  only look whether every fault still applies
  --work DIR   goes on where a run in DIR stopped: what was noticed once is not tried again
"""
import argparse
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The tests that know a room best come first: most faults never see the slow ones. Of a path the longest that fits.
CHAIN = ["kernel", "adaptation", "stages", "batch", "properties"]
TESTS_OF = {"src/kernel": CHAIN, "src/adaptation": CHAIN[1:], "src/stages": CHAIN[2:], "src/batch": CHAIN[3:],
            "src/adaptation/time": ["adaptation"], "src/stages/noise": ["noise", "batch"], "src/stages/contrast": ["contrast"],
            "src/stages/glare": ["glare"], "src/stages/display": ["batch"], "src/stages/display/local": ["display"]}
THRESHOLD = 0.95
# One SIMD target: that targets agree is tested elsewhere, and each costs time to compile. One of several lanes, SSE4 (for
# Highway SSE4.2, AES and PCLMUL): else it would be the scalar one, in which no pixel has neighbours.
FLAGS = "-O1 -msse4.2 -maes -mpclmul -DHWY_COMPILE_ONLY_STATIC"
# What nearly every file includes and no fault touches.
PRECOMPILED = """#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>
"""


def read_mutants():
    mutants = []
    for line in (ROOT / "scripts/mutants.txt").read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        path, rest = line.split(": ", 1)
        old, _, new = rest.partition(" ==>")
        mutants.append((path, old.strip(), new.strip(), line))
    return mutants


def tests_of(path):
    return TESTS_OF[max((room for room in TESTS_OF if path.startswith(room + "/")), key=len)]


def copy_tree(to):
    """The last commit, whole: what others are in the middle of is not judged. Files that are there already keep their
    time, so that a second run in the same folder builds little."""
    archive = subprocess.run(["git", "archive", "HEAD"], cwd=ROOT, check=True, capture_output=True).stdout
    with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
        for member in filter(tarfile.TarInfo.isfile, tar.getmembers()):
            file, content = to / member.name, tar.extractfile(member).read()
            if not file.exists() or file.read_bytes() != content:
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(content)
                file.chmod(member.mode)


def run(command, **options):
    return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options).returncode


def precompile(work):
    """The header with its precompiled forms, for libraries (pic) and programs (pie); GCC takes the one that fits."""
    header, forms = work / "precompiled.h", work / "precompiled.h.gch"
    if header.exists() and header.read_text() == PRECOMPILED:
        return header
    header.write_text(PRECOMPILED)
    forms.mkdir(exist_ok=True)
    for kind in ("PIC", "PIE"):
        subprocess.run(["g++", "-std=c++20", *FLAGS.split(), "-ffp-contract=off", f"-f{kind}", "-x", "c++-header",
                        header, "-o", forms / kind], check=True)
    return header


class Suite:
    def __init__(self, work, tree, jobs):
        self.build, self.jobs = work / "build", jobs
        linker = " -fuse-ld=gold" if shutil.which("ld.gold") else ""
        subprocess.run(["cmake", "-S", tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                        "-DCMAKE_CXX_COMPILER=g++", f"-DCMAKE_CXX_FLAGS={FLAGS} -include {precompile(work)}",
                        f"-DCMAKE_EXE_LINKER_FLAGS={linker}"], check=True, stdout=subprocess.DEVNULL)

    def killer(self, tests):
        """Name of the first test program that fails; None if all pass; "build" if one does not compile."""
        for test in tests:
            if run(["ninja", "-C", self.build, f"-j{self.jobs}", f"test_{test}"]):
                return "build"
            program = self.build / "tests" / f"test_{test}"
            try:
                failed = run([program, "--gtest_fail_fast"], timeout=600)
            except subprocess.TimeoutExpired:
                failed = True
            if failed:
                return test
        return None


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--work", type=pathlib.Path)
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--only", default="")
    options.add_argument("--check", action="store_true")
    options = options.parse_args()
    mutants = [m for m in read_mutants() if re.search(options.only, m[3])]
    stale = [m for m in mutants if (ROOT / m[0]).read_text().count(m[1]) != 1]
    for mutant in stale:
        print("does not apply:", mutant[3])
    if options.check or stale:
        return 1 if stale else 0

    work = options.work or pathlib.Path(tempfile.mkdtemp(prefix="mutation."))
    tree = work / "tree"
    copy_tree(tree)
    suite = Suite(work, tree, options.jobs)
    started = time.time()
    all_tests = list(dict.fromkeys(test for path, *_ in mutants for test in tests_of(path)))
    killer = suite.killer(all_tests)
    if killer:
        print("the suite fails without a fault:", killer)
        return 1
    print(f"without a fault all pass ({time.time() - started:.0f} s)", flush=True)
    killed, survivors, invalid = {test: 0 for test in all_tests}, [], []
    noticed = work / "noticed.txt"
    earlier = dict(x.split("\t", 1)[::-1] for x in noticed.read_text().splitlines()) if noticed.exists() else {}
    for number, (path, old, new, line) in enumerate(mutants, 1):
        if line in earlier:
            killed[earlier[line]] += 1
            continue
        file = tree / path
        text = file.read_text()
        file.write_text(text.replace(old, new))
        started = time.time()
        killer = suite.killer(tests_of(path))
        file.write_text(text)
        print(f"{number}/{len(mutants)} {killer or 'SURVIVED'} ({time.time() - started:.0f} s): {line}", flush=True)
        if killer == "build":
            invalid.append(line)
        elif killer:
            killed[killer] += 1
            with noticed.open("a") as file:
                file.write(f"{killer}\t{line}\n")
        else:
            survivors.append(line)
    valid = len(mutants) - len(invalid)
    score = sum(killed.values()) / max(1, valid)
    print(f"killed {sum(killed.values())} of {valid} ({100 * score:.1f} %):",
          ", ".join(f"{test} {count}" for test, count in killed.items()))
    for title, lines in (("survived", survivors), ("did not compile", invalid)):
        for line in lines:
            print(f"{title}: {line}")
    if not options.work:
        shutil.rmtree(work)
    return 0 if score >= THRESHOLD and not invalid else 1


if __name__ == "__main__":
    sys.exit(main())
