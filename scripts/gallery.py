#!/usr/bin/python3
"""Makes the pictures of docs/gallery.md, each by the scotopic program, and writes that page.

gallery.py [--check] [SCOTOPIC]   (default build/release/src/cli/scotopic)

--check makes them anew and compares with those in docs/gallery/: exit 1 where a picture is not what the program makes now.
Scenes: charts are spectral images made here from measured reflectances (tests/data) and lit by the program's own
illuminants; photographs are blender-data's (CC0), 0.18 being what the eye is adapted to.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
WORLDS = '/usr/share/blender/datafiles/studiolights/world/'
FOLDER = os.path.join(ROOT, 'docs/gallery')
# Codes of 8 bits, root of the mean square: JPEG alone makes 2 or 3 on grass.
CHECK_LIMIT = 4.0
LADDER = (10, 3, 1, .3, .1, .03, .01, .003, .001)


def read(name):
    # Not ImageBuf, which remembers files by their names.
    file = oiio.ImageInput.open(name)
    pixels = file.read_image(oiio.FLOAT) if file else None
    if pixels is None:
        raise OSError(f'{name}: {oiio.geterror()}')
    return numpy.asarray(pixels)


def write(name, pixels, channels=None, kind=oiio.FLOAT, attributes=()):
    height, width, count = pixels.shape
    spec = oiio.ImageSpec(width, height, count, kind)
    if channels:
        spec.channelnames = tuple(channels)
    for key, value in attributes:
        spec.attribute(key, value)
    out = oiio.ImageOutput.create(name)
    if not out or not out.open(name, spec) or not out.write_image(numpy.ascontiguousarray(pixels)) or not out.close():
        raise OSError(f'{name}: {out.geterror() if out else oiio.geterror()}')


class Studio:
    """Runs the program; scenes and results are float EXR in a folder that goes away."""

    def __init__(self, program, folder):
        self.program = program
        self.folder = folder
        self.made = 0

    def file(self, extension='.exr'):
        self.made += 1
        return os.path.join(self.folder, f'{self.made}{extension}')

    def scene(self, pixels):
        name = self.file()
        write(name, pixels)
        return name

    def seen(self, scene, options, verb='apply'):
        """Linear Rec.709 of what `scotopic apply SCENE OPTIONS` makes."""
        name = self.file()
        subprocess.run([self.program, verb, scene, '-o', name, '-q', '-d', 'float', *options.split()], check=True)
        return read(name)[..., :3]

    def chart(self):
        """The 24 patches as a spectral reflectance image, 5 nm bands, black between them."""
        rows = [line.split(',') for line in open(os.path.join(ROOT, 'tests/data/reflectances_macbeth.csv'))
                if line[0].isdigit()]
        table = numpy.array(rows, dtype=float)
        side, gap = 36, 4
        pixels = numpy.zeros((4 * side + 5 * gap, 6 * side + 7 * gap, len(table)), dtype=numpy.float32)
        for patch in range(24):
            y, x = (gap + (patch // 6) * (side + gap), gap + (patch % 6) * (side + gap))
            pixels[y:y + side, x:x + side] = table[:, 1 + patch]
        name = self.file()
        write(name, pixels, [f'T.{nm:.0f},0nm' for nm in table[:, 0]],
              attributes=[('spectralLayoutVersion', '1.0')])
        return name


def shown(linear, gain=1.0, roll_off=False):
    """8-bit sRGB. roll_off: above one half, as the config's " soft" views do it."""
    x = numpy.nan_to_num(linear * gain)
    if roll_off:
        x = numpy.where(x > .5, 1 - .5 * numpy.exp(1 - 2 * numpy.maximum(x, .5)), x)
    x = numpy.clip(x, 0, 1)
    x = numpy.where(x <= .0031308, 12.92 * x, 1.055 * numpy.maximum(x, 1e-9) ** (1 / 2.4) - .055)
    return numpy.round(255 * x).astype(numpy.uint8)


def tiled(rows, pad=6, ground=128):
    """Rows of pictures of one size, on grey."""
    height, width, _ = rows[0][0].shape
    out = numpy.full((len(rows) * (height + pad) + pad, max(map(len, rows)) * (width + pad) + pad, 3), ground, numpy.uint8)
    for i, row in enumerate(rows):
        for j, picture in enumerate(row):
            y, x = pad + i * (height + pad), pad + j * (width + pad)
            out[y:y + height, x:x + width] = picture
    return out


def cut(pixels, x, y, width, height, by=1):
    """A part, enlarged by a whole number without smoothing: what is computed is what is seen."""
    return pixels[y:y + height, x:x + width].repeat(by, 0).repeat(by, 1)


def shrunk(pixels, by):
    """Mean over squares: light, so that it may come before the operator."""
    height, width, count = pixels.shape
    pixels = pixels[:height - height % by, :width - width % by]
    return pixels.reshape(height // by, by, width // by, by, count).mean(axis=(1, 3))


def chart_lights(studio):
    chart = studio.chart()
    rows = []
    for light, la, gain in (('moon', .01, .9), ('hps', .1, .55), ('led4000', .1, .7)):
        lit = f'--illuminant {light} --white-luminance {la / .18:.6g} --output-colorspace scene_linear'
        day = studio.seen(chart, lit + ' --adaptation 1000')
        night = studio.seen(chart, lit + f' --adaptation {la}')
        rows.append([shown(day, gain), shown(night, gain / 8), shown(night, gain)])
    return tiled(rows)


def chart_ladder(studio):
    chart = studio.chart()
    charts = [shown(studio.seen(chart, f'--illuminant d65 --white-luminance {la / .18:.6g} --adaptation {la} '
                                       '--output-colorspace scene_linear'), .9) for la in LADDER]
    return tiled([charts[i:i + 3] for i in range(0, 9, 3)])


def night_scene(studio):
    """Trees, lamps and the glow of a town, 320 x 180: light averaged before anything is computed."""
    return studio.scene(shrunk(cut(read(WORLDS + 'night.exr')[..., :3], 0, 60, 640, 360), 2))


def sent(studio, picture, options):
    """What the program itself writes for a display: 8 bits, no exposure of ours."""
    name = studio.file('.png')
    subprocess.run([studio.program, 'apply', picture, '-o', name, '-q', '-d', 'uint8', *options.split()], check=True)
    return numpy.round(255 * read(name)[..., :3]).astype(numpy.uint8)


def night_ladder(studio):
    night = night_scene(studio)
    pictures = [sent(studio, night, f'--adaptation {la} --effects shift,luminance,chroma') for la in LADDER]
    return tiled([pictures[i:i + 3] for i in range(0, 9, 3)])


def lamps(studio):
    night = studio.scene(cut(read(WORLDS + 'night.exr')[..., :3], 20, 225, 150, 36))
    ways = ['--adaptation 1000 --white-luminance 1', '--adaptation .01 --white-luminance 1',
            '--adaptation .01 --white-luminance 1 --weight global']
    return tiled([[cut(shown(studio.seen(night, way), .25, True), 0, 0, 150, 36, 5)] for way in ways])


def silhouette(studio):
    yard = studio.scene(cut(read(WORLDS + 'courtyard.exr')[..., :3], 560, 200, 260, 180))
    colour = '--adaptation .003 --ppd 60'
    ways = [colour + ' --effects shift,luminance,chroma', colour + ' --acuity', colour + ' --acuity --acuity-range 1000']
    return tiled([[cut(shown(studio.seen(yard, way), 1.5, True), 0, 0, 260, 180, 2) for way in ways]])


def models(studio):
    night = night_scene(studio)
    ways = ['--adaptation 1000 --white-luminance .0556', '--adaptation .01',
            '--adaptation .01 --model kirk2011', '--adaptation .01 --model kirk2011 --effects shift --luminance none']
    pictures = [shown(studio.seen(night, way), 1.2, True) for way in ways]
    return tiled([pictures[:2], pictures[2:]])


def thesis(studio):
    chart = studio.chart()
    lit = '--illuminant d65 --white-luminance 0.0556 --output-colorspace scene_linear --adaptation .01 --model '
    ways = [lit + 'filament2021 --effects none', lit + 'filament2021', lit + 'safko2019 --safko-scale 1e6', lit + 'safko2019 --safko-scale 1']
    return tiled([[shown(studio.seen(chart, way), .5) for way in ways[:2]], [shown(studio.seen(chart, way), .5) for way in ways[2:]]])


def display(studio):
    """What the program itself sends to a display: 8 bits, no exposure of ours."""
    night = night_scene(studio)
    colour = '--adaptation .05 --effects shift,luminance,chroma '
    return tiled([[sent(studio, night, colour + '--display none'), sent(studio, night, colour),
                   sent(studio, night, colour + '--display Un-tone-mapped --tone local')]])


def effects(studio):
    night = night_scene(studio)
    ways = ['--adaptation 1000 --white-luminance .0556', *(f'--adaptation .01 --effects {e}' for e in
            ('shift', 'luminance', 'chroma'))]
    pictures = [shown(studio.seen(night, way), 1.2, True) for way in ways]
    return tiled([pictures[:2], pictures[2:]])


STREET = os.path.join(ROOT, 'tests/data/street.exr')


def street_ladder(studio):
    """The street as the program sends it to a display, everything on."""
    return tiled([[shrunk_codes(sent(studio, STREET, f'--adaptation {la}'), 2) for la in row]
                  for row in ((10, 1), (.1, .01), (.003, .001))])


def shrunk_codes(pixels, by):
    return numpy.round(shrunk(pixels.astype(float), by)).astype(numpy.uint8)


def glare_age(studio):
    """Three ages, and no glare; the middle of the street."""
    ways = ['--glare none', '--age 25', '--age 50', '--age 75']
    return tiled([[cut(sent(studio, STREET, '--adaptation .1 ' + way), 340, 130, 440, 420) for way in pair]
                  for pair in (ways[:2], ways[2:])])


def detail_ladder(studio):
    """The brick wall in the picture's left half: detail by contrast; colour and display alone beside it."""
    wall = lambda options: cut(sent(studio, STREET, options), 0, 40, 300, 420)
    ways = [f'--adaptation {la} --effects shift,luminance,chroma' for la in (1, .1, .01)]
    return tiled([[wall(way) for way in ways], [wall(way + ',detail') for way in ways]])


def starlight(studio):
    """Rod noise in three frames of a tenth of a second, four times enlarged."""
    sky = studio.scene(shrunk(cut(read(WORLDS + 'night.exr')[..., :3], 0, 60, 640, 360), 2))
    frames = []
    for frame in (1, 2, 3):
        pattern = sky[:-4] + '.#.exr'
        shutil.copy(sky, pattern.replace('#', str(frame)))
        name = studio.file('.png')
        out = name[:-4] + '.#.png'
        subprocess.run([studio.program, 'apply', pattern, '-o', out, '-q', '--frames', str(frame), '--fps', '10',
                        '--adaptation', '.0003', '--fov', '40', '--strength-display', '.6'], check=True)
        frames.append(cut(numpy.round(255 * read(out.replace('#', str(frame)))[..., :3]).astype(numpy.uint8), 60, 40, 150, 100, 2))
    return tiled([frames])


def garage(studio):
    """Out of a garage of 1000 cd/m2, ten minutes of it, into the street at 0.003."""
    seconds = (0, 1, 5, 10, 60, 300, 600, 1200)
    pictures = [shrunk_codes(sent(studio, STREET, f'--adaptation .003 --glare none --adaptation-history 1000:600,0.003:{t}'), 4)
                for t in seconds]
    return tiled([pictures[:4], pictures[4:]])


PICTURES = {'chart_lights.png': chart_lights, 'chart_ladder.png': chart_ladder, 'night_ladder.jpg': night_ladder,
            'lamps.jpg': lamps, 'silhouette.jpg': silhouette, 'models.jpg': models, 'effects.jpg': effects,
            'thesis.png': thesis, 'display.jpg': display, 'street_ladder.jpg': street_ladder, 'glare_age.jpg': glare_age,
            'detail_ladder.jpg': detail_ladder, 'starlight.jpg': starlight, 'garage.jpg': garage}


def keep(name, pixels):
    attributes = [('jpeg:subsampling', '4:4:4'), ('CompressionQuality', 90)] if name.endswith('.jpg') else \
        [('png:compressionLevel', 9)]
    write(os.path.join(FOLDER, name), pixels, kind=oiio.UINT8, attributes=attributes)


def difference(name, pixels):
    """Root mean square, codes of 8 bits."""
    kept = numpy.round(255 * read(os.path.join(FOLDER, name)))
    if kept.shape != pixels.shape:
        return float('inf')
    return float(numpy.sqrt(numpy.mean((kept - pixels.astype(float)) ** 2)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--check', action='store_true')
    parser.add_argument('--only', help='one picture, by its file name')
    parser.add_argument('program', nargs='?', default=os.path.join(ROOT, 'build/release/src/cli/scotopic'))
    arguments = parser.parse_args()
    os.makedirs(FOLDER, exist_ok=True)
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        studio = Studio(arguments.program, folder)
        for name, make in PICTURES.items():
            if arguments.only and name != arguments.only:
                continue
            pixels = make(studio)
            if not arguments.check:
                keep(name, pixels)
            off = difference(name, pixels)
            print(f'{name}: {pixels.shape[1]} x {pixels.shape[0]}, {off:.2f} codes from the file')
            if off > CHECK_LIMIT:
                wrong.append(name)
    if wrong:
        sys.exit(f'not what the program makes: {", ".join(wrong)}')


main()
