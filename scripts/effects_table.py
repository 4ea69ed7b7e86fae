#!/usr/bin/env python3
"""Writes docs/effects.md: eight real scenes from noon to starlight, which effects each calls for, why, and what they cost.

effects_table.py [SCOTOPIC]   (default build/release/src/cli/scotopic); pictures: blender-data, CC0
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

HEAD = f"""# Effects that a scene calls for

`scotopic explain` decides for each effect whether a scene calls for it, and says why; `scotopic apply` follows (`--effects auto`,
the default). An effect that is not called for is not computed:

| effect | not needed when |
|---|---|
| shift, chroma | the eye is adapted to 5 cd/m² or more, or every pixel is (Lloc = La + Y); pixels above are skipped one by one |
| luminance | the same, or no pixel's S/P ratio is further than .2 % from white's |
| acuity | the picture holds no more cycles per degree than the eye resolves (ppd/2 ≤ R(La)) |

Skipping changes no bit where weights are 0. Where mesopic luminance is skipped because of S/P ratios the change is at most .05
dE00. A tolerance of 5 %, as one might think enough, would be seen: .65 dE00 for a bluish grey (tests/scene).

Eight scenes of blender-data (CC0; the luminance adapted to is assumed, as these files state none), {PPD} pixels per degree.
ns/px: what the pixel-local effects took together on the machine that wrote this, one thread, over samples of the scene; a
scene that calls for nothing is copied. Made by `scripts/effects_table.py`.

| scene | La, cd/m² | shift | luminance | chroma | acuity | largest dE00 | ns/px | reason |
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
    reason = effects['shift']['reason'] + '; ' + effects['acuity']['reason']
    return (f"| {name}, {what} | {adaptation} | {share(effects['shift'])} | {share(effects['luminance'])} | "
            f"{share(effects['chroma'])} | {'yes' if effects['acuity']['runs'] else 'no'} | {largest:.3g} | {cost:.1f} | {reason} |\n")


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, 'build/release/src/cli/scotopic')
    rows = [row(*scene, explain(program, scene[0], scene[1])) for scene in SCENES]
    with open(os.path.join(ROOT, 'docs/effects.md'), 'w', encoding='utf-8') as out:
        out.write(HEAD + ''.join(rows))


main()
