#!/usr/bin/env python3
"""Line coverage (gcov) of the library's rooms by their own tests and the properties; exits 1 below 95 %.

  scripts/coverage.py [--work DIR] [--jobs N]     prints a table by file, and the lines that no test runs
"""
import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROOMS = ["receptors", "kernel", "adaptation", "appearance", "acuity", "scene"]
TESTS = ROOMS + ["properties"]
THRESHOLD = 95.0


def build_and_run(build, jobs):
    # One SIMD target: code for others is the same text, compiled again.
    flags = "--coverage -O0 -DHWY_COMPILE_ONLY_STATIC"
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                    f"-DCMAKE_CXX_FLAGS={flags}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", build, f"-j{jobs}", *(f"test_{t}" for t in TESTS)], check=True,
                   stdout=subprocess.DEVNULL)
    for test in TESTS:
        subprocess.run([build / "tests" / test / f"test_{test}"], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "SCOTOPIC_DRAWS": "2e4", "SCOTOPIC_STRIDE": "65536"})


def executed_lines(build):
    """{file: {line: times}}, over all objects that saw the file."""
    lines = collections.defaultdict(lambda: collections.defaultdict(int))
    for data in build.rglob("*.gcda"):
        out = subprocess.run(["gcov", "--json-format", "--stdout", data], cwd=build, capture_output=True, text=True)
        for report in filter(None, out.stdout.split("\n")):
            for file in json.loads(report)["files"]:
                path = pathlib.Path(build, file["file"]).resolve()
                if path.is_relative_to(ROOT / "src") and path.relative_to(ROOT / "src").parts[0] in ROOMS:
                    for line in file["lines"]:
                        lines[path.relative_to(ROOT)][line["line_number"]] += line["count"]
    return lines


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--work", type=pathlib.Path)
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options = options.parse_args()
    build = options.work or pathlib.Path(tempfile.mkdtemp(prefix="coverage."))
    build_and_run(build, options.jobs)
    total = run = 0
    for path, lines in sorted(executed_lines(build).items()):
        missed = sorted(number for number, count in lines.items() if count == 0)
        total += len(lines)
        run += len(lines) - len(missed)
        print(f"{100 * (1 - len(missed) / len(lines)):5.1f} % of {len(lines):4} {path}",
              "not run: " + " ".join(map(str, missed)) if missed else "")
    share = 100 * run / max(1, total)
    print(f"{share:5.1f} % of {total} lines")
    return 0 if share >= THRESHOLD else 1


if __name__ == "__main__":
    sys.exit(main())
