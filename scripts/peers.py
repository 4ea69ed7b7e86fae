#!/usr/bin/python3
"""Other programs and formulas for night vision, beside this one, on the same picture: numbers, and with --write
docs/peers.md, docs/images/peers.jpg (colours, each at the original's exposure) and docs/images/peers_display.jpg (what a
display is sent).

peers.py [--write | --picture | --quick | --check] [SCOTOPIC]     (default build/release/src/cli/scotopic)

A program that is not installed is left out, and said; --write wants all of them (Debian: pfstmo pfstools darktable
opencolorio-tools; pcond of Radiance, which Debian has not). Processor time is of the process and its children, user and system; of two pictures, one four times
the other, so that starting up does not count.
"""
import argparse
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
NIGHT = '/usr/share/blender/datafiles/studiolights/world/night.exr'
LA = 0.05                       # cd/m2 that the eye is adapted to, 0.18 in the pictures
UNIT = LA / .18                 # cd/m2 of value 1
FOV = 40                        # degrees of the width
XYZ_FROM_RGB = numpy.array([[.4123908, .3575843, .1804808], [.2126390, .7151687, .0721923], [.0193308, .1191948, .9505322]])
RGB_FROM_XYZ = numpy.linalg.inv(XYZ_FROM_RGB)


def read(name):
    # Not ImageBuf, which remembers files by their names.
    file = oiio.ImageInput.open(name)
    pixels = file.read_image(oiio.FLOAT) if file else None
    if pixels is None:
        raise OSError(f'{name}: {oiio.geterror()}')
    return numpy.asarray(pixels)[..., :3]


def write(name, pixels, kind=oiio.FLOAT, attributes=()):
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, kind)
    for key, value in attributes:
        spec.attribute(key, value)
    out = oiio.ImageOutput.create(name)
    if not out or not out.open(name, spec) or not out.write_image(numpy.ascontiguousarray(pixels)) or not out.close():
        raise OSError(f'{name}: cannot be written')


def linear(encoded):
    return numpy.where(encoded <= .04045, encoded / 12.92, ((numpy.maximum(encoded, 0) + .055) / 1.055) ** 2.4)


class System:
    """One way to see a picture. `see` takes and gives linear Rec.709, shape (rows, columns, 3)."""
    needs = ()
    as_it_is = False            # a picture for a display, whose brightness is part of it

    def __init__(self, folder, program):
        self.folder = folder
        self.program = program
        self.seconds = 0.0

    def installed(self):
        return all(shutil.which(need) for need in self.needs)

    def file(self, name):
        return os.path.join(self.folder, name)

    def run(self, command, source=None, sink=None, **variables):
        """Standard output as text; the child's processor time is kept in self.seconds."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        environment = dict(os.environ, HOME=self.folder, OMP_NUM_THREADS='1', **variables)
        done = subprocess.run(command, check=True, stdin=open(source, 'rb') if source else subprocess.DEVNULL,
                              stdout=open(sink, 'wb') if sink else subprocess.PIPE, stderr=subprocess.PIPE, env=environment)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return '' if sink else done.stdout.decode(errors='replace') + done.stderr.decode(errors='replace')


class Scotopic(System):
    name = 'scotopic apply'
    options = ()
    adaptation = LA

    def see(self, rgb):
        write(self.file('in.exr'), rgb, attributes=[('compression', 'none')])
        self.run([self.program, 'apply', self.file('in.exr'), '-o', self.file('out.exr'), '-q', '--threads', '1',
                  '--adaptation', str(self.adaptation), '--white-luminance', str(UNIT), *self.options])
        return read(self.file('out.exr'))


class Night(System):
    """The whole: glare, what the eye sees, and the display stage."""
    name = 'scotopic apply, for a display'
    as_it_is = True

    def see(self, rgb):
        write(self.file('in.exr'), rgb, attributes=[('compression', 'none')])
        self.run([self.program, 'apply', self.file('in.exr'), '-o', self.file('out.tif'), '-d', 'uint16', '-q', '--threads', '1',
                  '--adaptation', str(LA), '--white-luminance', str(UNIT), '--fov', str(FOV)])
        return linear(read(self.file('out.tif')))


class Kirk(Scotopic):
    name = 'scotopic apply, kirk2011'
    options = ('--model', 'kirk2011')


class FilamentLike(Scotopic):
    """Filament's function adds what the rods add at full weight everywhere and leaves luminance and chroma to itself."""
    name = "Filament's function (by --weight global at 1e-4 cd/m2)"
    options = ('--weight', 'global', '--luminance', 'none', '--effects', 'shift', '--gamut', 'none')
    adaptation = 1e-4


class Look(System):
    name = 'ocioconvert, baked look'
    needs = ('ocioconvert',)

    def see(self, rgb):
        config = self.file('config/config.ocio')
        if not os.path.exists(config):
            subprocess.run([self.program, 'bake', '-q', '--adaptation', str(LA), '--white-luminance', str(UNIT), '--config',
                            self.file('config')], check=True)
            text = open(config, encoding='utf-8').read()
            self.space = re.search(r'^    name: "?((?:Mesopic|Scotopic) [^"\n,]*)"?$', text, re.M).group(1)
        write(self.file('in.exr'), rgb, attributes=[('compression', 'none')])
        self.run(['ocioconvert', self.file('in.exr'), 'scene_linear', self.file('out.exr'), self.space], OCIO=config)
        return read(self.file('out.exr'))


class Pfs(System):
    """A tone mapper of pfstools: light in cd/m2 in, what a display shows out."""
    encoded = True
    command = ()

    def see(self, rgb):
        write(self.file('in.exr'), rgb, attributes=[('compression', 'none')])
        with open(self.file('in.pfs'), 'wb') as pfs:
            subprocess.run(['pfsinexr', self.file('in.exr')], check=True, stdout=pfs, stderr=subprocess.DEVNULL)
        self.run(self.command, self.file('in.pfs'), self.file('out.pfs'))
        seconds = self.seconds
        self.run(['pfsoutexr', '--float32', self.file('out.exr')], self.file('out.pfs'))
        self.seconds = seconds
        shown = read(self.file('out.exr'))
        return linear(shown) if self.encoded else shown


class Pattanaik(Pfs):
    name = 'pfstmo_pattanaik00'
    needs = ('pfstmo_pattanaik00', 'pfsinexr', 'pfsoutexr')
    command = ('pfstmo_pattanaik00', '--mul', str(UNIT), '--cone', str(LA), '--rod', str(LA))
    encoded = False


class Ferradans(Pfs):
    name = 'pfstmo_ferradans11'
    needs = ('pfstmo_ferradans11', 'pfsinexr', 'pfsoutexr')
    command = ('pfstmo_ferradans11',)


# Parameters of darktable's own preset "night street dark": blue shift, then its curve's six x and six y.
NIGHT_STREET_DARK = (40, 0, .15, .4, .6, .8, 1, 0, .02, .05, .2, .55, 1)


class Darktable(System):
    name = 'darktable, lowlight'
    needs = ('darktable-cli',)

    def sidecar(self):
        parameters = struct.pack('<13f', *NIGHT_STREET_DARK).hex()
        return ('<?xml version="1.0" encoding="UTF-8"?><x:xmpmeta xmlns:x="adobe:ns:meta/">'
                '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"><rdf:Description rdf:about="" '
                'xmlns:darktable="http://darktable.sf.net/" darktable:xmp_version="4" darktable:auto_presets_applied="1" '
                'darktable:history_end="1" darktable:iop_order_version="2"><darktable:history><rdf:Seq><rdf:li '
                'darktable:num="0" darktable:operation="lowlight" darktable:enabled="1" darktable:modversion="1" '
                f'darktable:params="{parameters}" darktable:multi_name="" darktable:multi_priority="0"/></rdf:Seq>'
                '</darktable:history></rdf:Description></rdf:RDF></x:xmpmeta>')

    def see(self, rgb):
        write(self.file('in.exr'), rgb, attributes=[('compression', 'none')])
        with open(self.file('in.xmp'), 'w', encoding='utf-8') as xmp:
            xmp.write(self.sidecar())
        if os.path.exists(self.file('out.tif')):
            os.remove(self.file('out.tif'))
        said = self.run(['darktable-cli', self.file('in.exr'), self.file('in.xmp'), self.file('out.tif'), '--icc-type',
                         'LIN_REC709', '--core', '--configdir', self.file('dt'), '--cachedir', self.file('dt'), '--library',
                         ':memory:', '-d', 'perf', '--conf', 'plugins/imageio/format/tiff/bpp=32', '-t', '1'])
        found = re.search(r'\(([0-9.]+) CPU\) \[export\] processed `lowlight', said)
        self.seconds = float(found.group(1)) if found else float('nan')
        return read(self.file('out.tif'))


class WardLarson(System):
    """Ward Larson, Rushmeier & Piatko 1997, colour alone: scotopic grey below .0056 cd/m2, photopic colour above 5.6, between
    them mixed in proportion to the luminance."""
    name = 'Ward Larson 1997, formula'

    def see(self, rgb):
        xyz = rgb @ XYZ_FROM_RGB.T
        x, y, z = (xyz[..., i:i + 1] for i in range(3))
        with numpy.errstate(all='ignore'):
            scotopic = y * (1.33 * (1 + (y + z) / x) - 1.68)
        white = 1.33 * (1 + (1 + 1.08883) / .95047) - 1.68
        photopic = numpy.clip((y * UNIT - .0056) / (5.6 - .0056), 0, 1)
        return photopic * rgb + (1 - photopic) * scotopic / white


class Pcond(System):
    """Radiance's human tone map: veil, acuity, colour and contrast of Ward Larson, Rushmeier & Piatko 1997."""
    name = 'pcond -h'
    needs = ('pcond',)
    as_it_is = True

    def see(self, rgb):
        write(self.file('plain.hdr'), rgb * UNIT / 179)     # lumens per watt of Radiance's white
        head, pixels = open(self.file('plain.hdr'), 'rb').read().split(b'\n\n', 1)
        height, width = rgb.shape[:2]
        view = f'\nVIEW= -vtv -vh {FOV} -vv {FOV * height / width:.3f}'.encode()
        with open(self.file('in.hdr'), 'wb') as hdr:
            hdr.write(head + view + b'\n\n' + pixels)
        self.run(['pcond', '-h', self.file('in.hdr')], sink=self.file('out.hdr'))
        return read(self.file('out.hdr'))


SYSTEMS = (Scotopic, Kirk, Look, FilamentLike, WardLarson, Pattanaik, Ferradans, Darktable, Night, Pcond)


def card():
    """Equal luminances of La on a ground of it: grey, red, green, blue; what becomes of each tells colour from luminance."""
    colours = numpy.array([[1, 1, 1], [1, .1, .1], [.1, 1, .1], [.1, .1, 1]], dtype=float)
    colours *= (.18 / (colours @ XYZ_FROM_RGB[1]))[:, None]
    rgb = numpy.full((64, 256, 3), .18, dtype=numpy.float32)
    for i, colour in enumerate(colours):
        rgb[8:56, 64 * i + 8:64 * i + 56] = colour
    return rgb


def chromaticity(rgb):
    xyz = XYZ_FROM_RGB @ rgb
    return numpy.array([4 * xyz[0], 9 * xyz[1]]) / (xyz[0] + 15 * xyz[1] + 3 * xyz[2])


def luminance(rgb):
    return rgb @ XYZ_FROM_RGB[1]


def of_card(system):
    """Tint of the grey (u'v' from D65), luminance of red and blue over grey's, chroma of red that is left (u'v' from the grey)."""
    source = card()
    seen = system.see(source).astype(float)
    middle = [(32, 64 * i + 32) for i in range(4)]
    grey, red, _, blue = (seen[y, x] for y, x in middle)
    before = [source[y, x].astype(float) for y, x in middle]
    whole = numpy.linalg.norm(chromaticity(before[1]) - chromaticity(before[0]))
    return (numpy.linalg.norm(chromaticity(grey) - chromaticity(before[0])), luminance(red) / luminance(grey),
            luminance(blue) / luminance(grey), numpy.linalg.norm(chromaticity(red) - chromaticity(grey)) / whole)


def of_nan(system, night):
    """Pixels that change when one becomes a NaN: share of all others, and of them that are not finite."""
    part = night[200:264, 100:228].copy()
    clean = system.see(part)
    part[32, 64, 0] = numpy.nan
    try:
        broken = system.see(part)
    except subprocess.CalledProcessError as error:
        # A shell's exit code 128 + n is a signal, too.
        signal = -error.returncode if error.returncode < 0 else error.returncode - 128
        return f'the program ends by signal {signal}' if signal > 0 else 'the file is refused'
    others = numpy.ones(part.shape[:2], dtype=bool)
    others[32, 64] = False
    with numpy.errstate(all='ignore'):
        moved = ~numpy.isclose(broken, clean, rtol=1e-3, atol=1e-5).all(axis=-1) & others
    lost = ~numpy.isfinite(broken).all(axis=-1) & others
    itself = 'stays one' if not numpy.isfinite(broken[32, 64]).all() else f'becomes {broken[32, 64].max():.2g}'
    return f'{itself}; {100 * moved.sum() / others.sum():.3g} % of the others change, {lost.sum()} are lost'


def of_scale(system, night):
    """Whether light ten times as much looks different, exposure apart: median ratio of u'v' chroma, of what each gives."""
    part = night[200:264, 100:228]
    def chroma(rgb):
        xyz = rgb.reshape(-1, 3).astype(float) @ XYZ_FROM_RGB.T
        total = xyz @ [1, 15, 3]
        keep = (total > 1e-6) & (xyz[:, 1] > 1e-6)
        uv = numpy.stack([4 * xyz[keep, 0], 9 * xyz[keep, 1]], 1) / total[keep, None]
        return float(numpy.median(numpy.linalg.norm(uv - [.1978, .4683], axis=1)))
    return chroma(system.see(part)), chroma(system.see(10 * part))


def cost(system, night):
    """Nanoseconds of processor time per pixel."""
    small = night
    large = numpy.concatenate([numpy.concatenate([night, night], 0)] * 2, 1)
    times = []
    for picture in (small, large):
        system.see(picture)
        times.append(system.seconds)
    return 1e9 * (times[1] - times[0]) / (large.shape[0] * large.shape[1] - small.shape[0] * small.shape[1])


def shown(rgb, white):
    x = numpy.clip(numpy.nan_to_num(rgb.astype(float)) / white, 0, 1)
    x = numpy.where(x <= .0031308, 12.92 * x, 1.055 * numpy.maximum(x, 1e-9) ** (1 / 2.4) - .055)
    return numpy.round(255 * x).astype(numpy.uint8)


def side_by_side(pictures, columns=3, pad=6):
    height, width, _ = pictures[0].shape
    rows = -(-len(pictures) // columns)
    out = numpy.full((rows * (height + pad) + pad, columns * (width + pad) + pad, 3), 128, numpy.uint8)
    for i, picture in enumerate(pictures):
        y, x = pad + i // columns * (height + pad), pad + i % columns * (width + pad)
        out[y:y + height, x:x + width] = picture
    return out


def measure(system, night, quick):
    tint, red, blue, left = of_card(system)
    dark, bright = of_scale(system, night)
    ns = float('nan') if quick or isinstance(system, WardLarson) else cost(system, night)
    return {'name': system.name, 'tint': tint, 'red': red, 'blue': blue, 'left': left, 'dark': dark, 'bright': bright,
            'nan': of_nan(system, night), 'ns': ns}


def table(rows):
    head = ('| | grey\'s tint | red over grey | blue over grey | red\'s chroma left | chroma of the night, and of ten times as '
            'much light | a NaN | ns/pixel |\n|---|---:|---:|---:|---:|---:|---|---:|\n')
    def line(r):
        ns = '' if r['ns'] != r['ns'] else f'{r["ns"]:.3g}'
        return (f'| {r["name"]} | {r["tint"]:.4f} | {r["red"]:.2f} | {r["blue"]:.2f} | {100 * r["left"]:.0f} % | '
                f'{r["dark"]:.3f}, {r["bright"]:.3f} | {r["nan"]} | {ns} |\n')
    return head + ''.join(map(line, rows))


def part_of(rgb):
    """Trees, lamps and the glow of a town, at half the size."""
    part = rgb[60:420, :640].astype(float)
    return part.reshape(180, 2, 320, 2, 3).mean(axis=(1, 3))


def write_table(rows):
    page = os.path.join(ROOT, 'docs/peers.md')
    text = open(page, encoding='utf-8').read()
    begin, end = '<!-- measured: written by scripts/peers.py -->\n', '<!-- end of measured -->'
    before, after = text.split(begin)[0], text.split(end)[1]
    open(page, 'w', encoding='utf-8').write(before + begin + table(rows) + end + after)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--write', action='store_true')
    parser.add_argument('--quick', action='store_true', help='no times')
    parser.add_argument('--check', action='store_true', help="scotopic's rows alone, no times; exit 1 where they are not as docs/peers.md says")
    parser.add_argument('--picture', action='store_true', help='write the pictures alone')
    parser.add_argument('program', nargs='?', default=os.path.join(ROOT, 'build/release/src/cli/scotopic'))
    arguments = parser.parse_args()
    night = read(NIGHT)
    original = shown(part_of(night), 1)
    rows, pictures, for_displays, missing = [], [original], [original], []
    for kind in SYSTEMS[:3] if arguments.check else SYSTEMS:
        with tempfile.TemporaryDirectory() as folder:
            system = kind(folder, os.path.abspath(arguments.program))
            if not system.installed():
                missing.append(f'{system.name}: not installed ({", ".join(system.needs)}), left out')
                print(missing[-1], file=sys.stderr)
                continue
            if not arguments.picture:
                rows.append(measure(system, night, arguments.quick or arguments.check))
                print(table(rows[-1:]).splitlines()[-1], flush=True)
            if arguments.picture or arguments.write:
                seen = part_of(system.see(night))
                if system.as_it_is or isinstance(system, Pfs):
                    for_displays.append(shown(seen, 1))
                if system.as_it_is:
                    continue
                # One exposure for all: the median of what each makes is as bright as the original's.
                pictures.append(shown(seen, numpy.median(luminance(seen)) / numpy.median(luminance(part_of(night)))))
    if missing and (arguments.picture or arguments.write):
        sys.exit('nothing is written: ' + '; '.join(missing))
    if arguments.picture or arguments.write:
        for name, parts in (('peers', pictures), ('peers_display', for_displays)):
            write(os.path.join(ROOT, f'docs/images/{name}.jpg'), side_by_side(parts), oiio.UINT8,
                  [('jpeg:subsampling', '4:4:4'), ('CompressionQuality', 88)])
    if arguments.write:
        write_table(rows)
    if not arguments.check:
        return
    exact, look = rows[0], rows[-1]
    if not (exact['red'] < .8 and exact['blue'] > 1.5 and exact['tint'] < .03 and
            exact['nan'].startswith('stays one; 0 %') and look['nan'].startswith('becomes 0; 0 %') and
            all(abs(exact[k] - look[k]) < .01 for k in ('tint', 'red', 'blue', 'left'))):
        sys.exit('scotopic and its look are not as docs/peers.md says')


main()
