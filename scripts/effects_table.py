#!/usr/bin/env python3
"""Writes docs/effects.md: eight real scenes from noon to starlight, which effects each calls for, why, and what they cost.

effects_table.py [BUILD]   default build/release; pictures: blender-data, CC0. What skipping saves is measured where BUILD has
bench_effects (-DSCOTOPIC_BUILD_BENCH=ON); else that part of the page stays as it is.
"""
import json
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
WORLDS = '/usr/share/blender/datafiles/studiolights/world/'
# Pictures hold no absolute luminance; the luminance adapted to is what such a scene has.
SCENES = [('courtyard', 3000, 'noon'), ('sunset', 60, 'after sunset'), ('interior', 20, 'lamplit room'),
          ('studio', 4.9, 'dim studio'), ('city', 1, 'lit street'), ('forest', 0.1, 'edge of a street lamp'),
          ('night', 0.01, 'full moon'), ('night', 0.001, 'starlight')]
PPD = 20
ROUNDS = '5'

HEAD = f"""# Effects that a scene calls for

`scotopic explain` decides for each effect whether a scene calls for it, and says why; `scotopic apply` follows (`--effects auto`,
the default). An effect that is not called for is not computed. `--effects` takes names instead (`glare,shift,luminance,chroma,detail,noise`;
`acuity` is an older word for detail), `all`, or `none`; what is named runs whether or not it is called for. Detail, glare and noise
need pixels per degree: `--ppd` or `--fov`, or what is assumed of a display.

| effect | not needed when |
|---|---|
| shift, chroma | the eye is adapted to 5 cd/m² or more, or every pixel is (Lloc = La + Y); pixels above are skipped one by one |
| luminance | the same, or no pixel's S/P ratio is further than .2 % from white's |
| glare | no pixel is brighter than what the display can show, or no veil comes to 1 % of what is under it ([glare.md](glare.md)) |
| detail | by contrast: no contrast needs to be 0.005 decades greater than on the display to be seen (from 1 cd/m² up at 4 cycles per degree); bilateral: ppd/2 ≤ R(La), the picture holds no more than the eye resolves |
| noise | from 0.0029756 cd/m² up; in a still unless `--effects` names it |
| time | the eye was always in this light, or all that past light has left is within 1 % |

Inside a picture pixels of Lloc ≥ 5 cd/m² are passed over a vector at a time, and pieces of 512 pixels of a row that are so from
end to end keep the file's very bytes. `scotopic bake` asks the same plan: a look that calls for nothing is a no-op, and
`--effects chroma --weight global`, which treats all pixels alike, is a matrix.

Skipping changes no bit where weights are 0. Where mesopic luminance is skipped because of S/P ratios the change is at most .05
dE00. A tolerance of 5 %, as one might think enough, would be seen: .65 dE00 for a bluish grey (tests/scene).

Eight scenes of blender-data (CC0; the luminance adapted to is assumed, as these files state none), {PPD} pixels per degree.
ns/px: what the pixel-local effects took together on the machine that wrote this, one thread, over samples of the scene; a
scene that calls for nothing is copied. Made by `scripts/effects_table.py`.

| scene | La, cd/m² | shift | luminance | chroma | detail | largest dE00 | ns/px | reason |
|---|---|---|---|---|---|---|---|---|
"""


def explain(program, name, adaptation):
    command = [program, 'explain', WORLDS + name + '.exr', '--adaptation', str(adaptation), '--ppd', str(PPD), '--json']
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def row(name, adaptation, what, report):
    effects = report['effects']
    share = lambda e: f"{100 * e['share']:.0f} %" if e['runs'] else 'no'
    local = [effects[e] for e in ('shift', 'luminance', 'chroma')]
    largest = max(e['largestDifference'] for e in local)
    cost = sum(e['nsPerPixel'] for e in local)
    reason = effects['shift']['reason'] + '; ' + effects['detail']['reason']
    return (f"| {name}, {what} | {adaptation} | {share(effects['shift'])} | {share(effects['luminance'])} | "
            f"{share(effects['chroma'])} | {'yes' if effects['detail']['runs'] else 'no'} | {largest:.3g} | {cost:.1f} | {reason} |\n")


SAVES = '## What skipping saves'


def saves(bench, page):
    """The section, measured; without the benchmark, as the page has it."""
    if not os.path.exists(bench):
        return page[page.index(SAVES):] if SAVES in page else ''
    figures = json.loads(subprocess.run([bench, ROUNDS, '--json'], check=True, capture_output=True, text=True).stdout)
    processor = next((line.split(':')[1].strip() for line in open('/proc/cpuinfo') if line.startswith('model name')), 'unknown')
    rows = ''.join(f"| {f['what']} | {f['median']:.3g} {f['unit']} | {f['against']:.3g} | {f['ratio']:.3f} |\n" for f in figures)
    return f"""{SAVES}

CPU time of one thread on {processor}, system load {os.getloadavg()[0]:.1f}; medians of {ROUNDS} rounds, each held to its
pair in the same round. A file is held to reading and writing it by OpenEXR's own calls, in the same bands; the program's start
is included. The picture is a night by formula. `build/release/tests/bench_effects {ROUNDS}` prints it.

| what | takes | against | ratio |
|---|---:|---:|---:|
{rows}
For scale: Radiance's `pcond` was measured at .27 s for a 1080p picture with all its effects, and .07 s with none, on another
machine.
"""


def main():
    build = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, 'build/release')
    program = os.path.join(build, 'src/cli/scotopic')
    path = os.path.join(ROOT, 'docs/effects.md')
    with open(path, encoding='utf-8') as old:
        page = old.read()
    rows = [row(*scene, explain(program, scene[0], scene[1])) for scene in SCENES]
    text = HEAD + ''.join(rows) + '\n' + saves(os.path.join(build, 'tests/bench_effects'), page)
    with open(path, 'w', encoding='utf-8') as out:
        out.write(text)


main()
