#!/usr/bin/env python3
"""Measures what accuracy costs and writes it into docs/accuracy.md, README.md and docs/images/accuracy.svg.

accuracy.py measure BUILD FOLDER [ROUNDS]
    BUILD is a Release build with -DSCOTOPIC_BUILD_BENCH=ON (the two benchmarks it runs need no package beyond those of
    scripts/install_packages.sh). Let the machine be idle: the load is kept with the figures.
accuracy.py write FOLDER [OTHER...]
    The tables of one run; of the others, made on other machines, only the one by vector instructions.
"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
TARGETS = {"AVX3": "AVX-512", "AVX3_DL": "AVX-512"}
INSTRUCTIONS = {
    "float": "operator, float",
    "double": "operator, double inside",
    "half": "operator, float, half planes in and out",
    "photopic": "operator, adapted to 10 cd/m²",
    "lit": "operator, adapted to .01 cd/m², every pixel beyond 5",
    "shift": "shift and projection alone",
    "kernel": "RGB to LMSR, kernel, back to RGB",
    "general": "operator, float, by code that asks which stages are on (global weight)",
}


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def digits(x, n=2):
    return "0" if x == 0 else f"{x:.{n}g}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def memory(size):
    return "" if size == 0 else f"{size / 1e6:.1f} MB" if size >= 1e6 else f"{size / 1e3:.0f} kB"


def way_row(way):
    error = way.get("error")
    row = [way["evaluator"], digits(way["nanosecondsPerPixel"], 3), digits(way["memcpyRatio"], 3)]
    if error:
        row += [digits(error["deltaE00"][k]) for k in ("mean", "p99", "max")] + [digits(error["relativePixel"]["max"])]
    else:
        row += [""] * 4
    baked = way["bakeSeconds"]
    return row + [memory(way["bytes"]), f"{baked:.2g} s" if way["bytes"] else "", "dominated" if way["dominated"] else ""]


def group_table(times, wanted):
    head = ["evaluator", "ns/pixel", "× memcpy", "ΔE00 mean", "99 %", "max", "of the pixel, max", "tables", "to bake", ""]
    return table(head, [way_row(w) for w in times["evaluators"] if wanted(w["group"])])


def target_table(times):
    targets = list(dict.fromkeys(t["target"] for t in times))
    cell = {(t["what"], t["target"]): t for t in times}
    names = list(dict.fromkeys(t["what"] for t in times))
    rows = [[name] + [f"{cell[name, t]['ratio']:.2f} ({cell[name, t]['ns']:.2f} ns)" for t in targets] for name in names]
    return table(["× memcpy (and ns per pixel)"] + [TARGETS.get(t, t) for t in targets], rows)


def exact_table(exact):
    rows = [[f"{e['adaptation']:g}", e["way"], digits(e["pixel"], 3), at(e["pixelAt"]), digits(e["ulps"], 3), at(e["ulpsAt"])]
            for e in exact]
    return table(["La, cd/m²", "way", "of the pixel", "at RGB", "float ulps of a component", "at RGB"], rows)


def at(rgb):
    return ", ".join(f"{x:.5g}" for x in rgb)


def count_instructions(build):
    if not shutil.which("valgrind"):
        return {}
    counts = {}
    for way, what in INSTRUCTIONS.items():
        out = subprocess.run(["sh", ROOT / "tests/instructions/count.sh", "valgrind",
                              build / "tests/instructions_workload", way, "999"],
                             capture_output=True, text=True).stdout
        counts[what] = out.split(": ")[1].split(" ")[0]
    return counts


def wrapped(part):
    return part if part[0] in "|#!" or "\n" in part else textwrap.fill(part, 110, break_on_hyphens=False)


def ratios(times, bench):
    ns = {(w["group"], w["evaluator"]): w["nanosecondsPerPixel"] for w in times["evaluators"]}
    error = {(w["group"], w["evaluator"]): w["error"]["deltaE00"]["max"] for w in times["evaluators"] if "error" in w}
    best = bench[0]["target"]
    cell = {t["what"]: t["ns"] for t in bench if t["target"] == best}
    op = "operator"
    # Runs of before 2026-11-25 have no naive kernel.
    naive = [[f"RGB→LMSR→kernel→RGB, float, against the formula as first written down, in double, with `{how}`",
              f"{cell[f'kernel, naive double, {name}'] / cell['kernel, float']:.1f} × faster"]
             for name, how in [("pow", "pow(x, -0.5)"), ("sqrt", "1/sqrt(x)")] if f"kernel, naive double, {name}" in cell]
    rows = naive + [
        ["RGB→LMSR→kernel→RGB, float, against the reference in scalar double",
         f"{cell['kernel, scalar double'] / cell['kernel, float']:.1f} × faster"],
        ["operator, float, against the same in scalar double",
         f"{cell['operator, scalar double'] / cell['operator, float']:.0f} × faster"],
        ["operator, float, against the 65³ LUT through OpenColorIO's CPU",
         f"{ns[op, 'lut65'] / ns[op, 'float']:.1f} × faster, {error[op, 'lut65'] / error[op, 'float']:.0f} × less error"],
        ["operator, double inside, against the same",
         f"{ns[op, 'lut65'] / ns[op, 'double']:.1f} × faster, {error[op, 'lut65'] / error[op, 'double']:.0f} × less error"],
        ["operator, float, two threads against one",
         f"{cell['operator, float'] / cell['operator, float, 2 threads']:.2f} × faster"],
        ["operator, double inside, two threads against one",
         f"{cell['operator, double inside'] / cell['operator, double inside, 2 threads']:.2f} × faster"],
    ]
    return table(["", ""], rows)


def processor(times):
    name, instructions = times["machine"].rsplit(", ", 1)
    return f"{name}, {TARGETS.get(instructions, instructions)}, {times['processors']} processors"


def machine(times):
    return (f"{processor(times)}, system load "
            f"{times['load']:.1f}, medians of {times['rounds']} rounds in which every way had its turn")


def target_section(times, bench):
    return f"On {machine(times)}:\n\n" + target_table(bench["times"]) + "\n\n" + ratios(times, bench["times"])


def section(times, bench, instructions, others):
    parts = [
        "## What accuracy costs",
        f"One run on {machine(times)}; OpenColorIO {times['openColorIO']}. Written by `scripts/accuracy.py`. "
        "Times are of one thread where nothing else is said.",
        "![Error against time](images/accuracy.svg)",
        "Every way is held to the same operator in double, over " + times["errorsOver"] + ". ΔE00 is CIEDE2000 after "
        "scaling both colours by what brings the right one to Y = .184, so that a dark pixel's error counts like a "
        "bright one's; *of the pixel* is the greatest error of a component over the pixel's largest component, in or "
        "out. *Dominated*: another way of the group is no slower and no less accurate. memcpy moves the same frame as "
        f"RGBA float; the frame is {times['picture']}, {times['pixels']} pixels (`scotopic time --rounds {times['rounds']}`).",
        "### The operator",
        group_table(times, lambda g: g.startswith("operator")),
        "LUTs are for programs that cannot run the operator. On a CPU, OpenColorIO 2.1 without its vector code takes longer "
        "for any LUT than the operator itself does in double. `apply --max-error` and `--budget` measure this on the spot.",
        "### In and out of files' pixels",
        group_table(times, lambda g: g == "files"),
        "The error of half is half's own rounding; its maximum is at subnormal halves, below 6e-5.",
        "### Rods, spectra, acuity",
        "Linear and quadratic rods, each against its own reference; 380 to 780 nm in bins or points, against 1 nm bins, for "
        "the built-in illuminants at a quarter, one and four times the adaptation luminance; acuity at σ = 8 pixels "
        "against the exact window.",
        group_table(times, lambda g: "rods" in g or g == "spectra" or g.startswith("acuity")),
        "### By vector instructions",
        "The same bits on every target: no operation is fused. `bench_appearance`, 3840 × 2160, planes unless RGBA is said; "
        "the kernel is RGB→LMSR→kernel→RGB in one pass.",
        "A ratio to memcpy says as much of the memory as of the code: where memory is twice as fast, it doubles.",
        *[target_section(t, b) for t, b, _ in [(times, bench, instructions)] + others],
        "### Against exact arithmetic",
        "20000 colours of Rec.709 over 28 stops against 256-bit arithmetic (GNU MPFR), the worst of each. Components "
        "that all but cancel have many ulps in float, and few of the pixel; in double inside they are the nearest float. "
        "Over every regime, from subnormals to 2^120, see [hard-cases.md](hard-cases.md).",
        exact_table(bench["exact"]),
    ]
    if instructions:
        parts += ["### Without clocks", "Instructions per pixel on the AVX2 target, counted by callgrind, the same from run to "
                  "run; `tests/instructions` holds them to ceilings.",
                  table(["", "instructions per pixel"], [[what, count] for what, count in instructions.items()])]
    return "\n\n".join(wrapped(p) for p in parts)


def summary(times):
    ways = {w["evaluator"]: w for w in times["evaluators"] if w["group"] == "operator"}
    rows = []
    for name in ("double", "float", "lut65", "lut33", "lut17"):
        w = ways[name]
        rows.append([f"`{name}`", digits(w["nanosecondsPerPixel"], 3), digits(w["error"]["deltaE00"]["mean"]),
                     digits(w["error"]["deltaE00"]["max"])])
    return f"On one thread ({processor(times)}):\n\n" + table(["`--precision`", "ns per pixel", "ΔE00 mean", "ΔE00 max"], rows)


def replace(path, mark, text):
    """Puts `text` between the marks; a file without them gets it at its end."""
    begin, end = f"<!-- {mark}: written by scripts/accuracy.py -->", f"<!-- end of {mark} -->"
    old = path.read_text()
    if begin in old:
        new = old[: old.index(begin)] + begin + "\n" + text + "\n" + old[old.index(end):]
    else:
        new = old.rstrip("\n") + f"\n\n{begin}\n{text}\n{end}\n"
    path.write_text(new)


def measure(build, folder, rounds):
    folder.mkdir(parents=True, exist_ok=True)
    times = json.loads(run(build / "src/cli/scotopic", "time", "--json", "-q", "--rounds", rounds))
    times["processors"] = os.cpu_count()
    (folder / "time.json").write_text(json.dumps(times))
    (folder / "bench.json").write_text(run(build / "tests/bench_appearance", rounds, "--json"))
    (folder / "instructions.json").write_text(json.dumps(count_instructions(build)))


def read(folder):
    def part(name):
        path = folder / f"{name}.json"
        return json.loads(path.read_text()) if path.exists() else {}

    return part("time"), part("bench"), part("instructions")


def draw(times, folder):
    """docs/images/accuracy.svg from the columns of `time --csv` that the plot reads."""
    rows = [["group", "evaluator", "ns_per_pixel", *[""] * 6, "de00_max", *[""] * 8, "dominated"]]
    for w in (w for w in times["evaluators"] if w["group"] == "operator"):
        error = w["error"]["deltaE00"]["max"] if "error" in w else ""
        rows.append([w["group"], w["evaluator"], w["nanosecondsPerPixel"], *[""] * 6, error, *[""] * 8, int(w["dominated"])])
    with open(folder / "time.csv", "w", newline="") as file:
        csv.writer(file).writerows(rows)
    run("gnuplot", "-c", ROOT / "scripts/plot/accuracy.gnuplot", folder / "time.csv", ROOT / "docs/images/accuracy.svg",
        f"{processor(times)}; OpenColorIO {times['openColorIO']}")


def write(folder, others):
    runs = [read(f) for f in [folder] + others]
    times, bench, _ = runs[0]
    instructions = next((r[2] for r in runs if r[2]), {})
    draw(times, folder)
    replace(ROOT / "docs/accuracy.md", "cost", section(times, bench, instructions, runs[1:]))
    replace(ROOT / "README.md", "cost", "![Error against time](docs/images/accuracy.svg)\n\n" + summary(times))


def main():
    match sys.argv[1:]:
        case ["measure", build, folder]:
            measure(pathlib.Path(build), pathlib.Path(folder), "11")
        case ["measure", build, folder, rounds]:
            measure(pathlib.Path(build), pathlib.Path(folder), rounds)
        case ["write", folder, *others]:
            write(pathlib.Path(folder), [pathlib.Path(f) for f in others])
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main()
