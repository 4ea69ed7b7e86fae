"""Renders a street under a moon, calibrated: value 1 is 10 cd/m2 (whiteLuminance), Rec.709 linear, half EXR.

blender -b -P scripts/night_scene.py -- OUT.exr [SAMPLES [WIDTH [SECONDS]]]   (defaults 1024, 1280, no limit)

Needs Blender 3.4 or newer (Cycles, CPU, no denoiser) and oiiotool. Same seed, same picture.
Licence of the script's output: CC0.
Scene: metres, x right, y ahead, z up. Photometric light: cd/m2 of an emitter, cd of a lamp, lx of the moon.
Lamps light the street by spots of I cd; the lens seen has I / area cd/m2 and lights nothing (less noise).
"""
import math
import os
import random
import subprocess
import sys
import tempfile

import bpy

WHITE = 10.0  # cd/m2 of image value 1
CHART = """115 82 68 194 150 130 98 122 157 87 108 67 133 128 177 103 189 170
214 126 44 80 91 166 193 90 99 94 60 108 157 188 64 224 163 46
56 61 150 70 148 73 175 54 60 231 199 31 187 86 149 8 133 161 243 243 242 200 200 200
160 160 160 122 122 121 85 85 85 52 52 52"""  # ColorChecker 24, sRGB codes as its maker publishes them


def luminance(rgb):
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]


def unit(rgb):
    """The colour at luminance 1."""
    return tuple(c / luminance(rgb) for c in rgb)


def from_xy(x, y):
    """Rec.709 linear at luminance 1; what is outside the gamut is clipped."""
    X, Z = x / y, (1 - x - y) / y
    rgb = (3.2406 * X - 1.5372 - 0.4986 * Z, -0.9689 * X + 1.8758 + 0.0415 * Z,
           0.0557 * X - 0.2040 + 1.0570 * Z)
    return unit([max(c, 0.0) for c in rgb])


def linear(code):
    v = code / 255
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


SODIUM = from_xy(0.525, 0.415)  # high-pressure sodium, about 2000 K
LED = from_xy(0.380, 0.377)     # 4000 K
MOON = from_xy(0.376, 0.374)    # 4100 K
WINDOW = from_xy(0.460, 0.411)  # 2700 K
RED = unit((60, 2, 0.5))
BLUE = unit((0.03, 0.12, 1))


def material(name, rgb, roughness=0.9):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    b = m.node_tree.nodes["Principled BSDF"]
    b.inputs["Base Color"].default_value = (*rgb, 1)
    b.inputs["Roughness"].default_value = roughness
    return m


def emitter(name, rgb, cdm2):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    t = m.node_tree
    t.nodes.clear()
    e, out = t.nodes.new("ShaderNodeEmission"), t.nodes.new("ShaderNodeOutputMaterial")
    peak = max(rgb)
    e.inputs["Color"].default_value = (*[c / peak for c in rgb], 1)
    e.inputs["Strength"].default_value = cdm2 * peak / WHITE
    t.links.new(e.outputs[0], out.inputs["Surface"])
    if hasattr(m.cycles, "emission_sampling"):
        m.cycles.emission_sampling = "NONE"
    else:
        m.cycles.sample_as_light = False  # before Blender 3.5
    return m


def texture(m, kind, low, high, bump=0.0, **inputs):
    """Base colour between low and high by a procedural texture in object coordinates, and a bump of it."""
    t = m.node_tree
    b, x, where = t.nodes["Principled BSDF"], t.nodes.new(kind), t.nodes.new("ShaderNodeTexCoord")
    ramp = t.nodes.new("ShaderNodeValToRGB")
    for stop, rgb in zip(ramp.color_ramp.elements, (low, high)):
        stop.color = (*rgb, 1)
    for k, v in inputs.items():
        x.inputs[k.replace("_", " ")].default_value = v
    t.links.new(where.outputs["Object"], x.inputs["Vector"])
    t.links.new(x.outputs["Fac"], ramp.inputs[0])
    t.links.new(ramp.outputs[0], b.inputs["Base Color"])
    if bump:
        n = t.nodes.new("ShaderNodeBump")
        n.inputs["Strength"].default_value = bump
        n.inputs["Distance"].default_value = 0.02
        t.links.new(x.outputs["Fac"], n.inputs["Height"])
        t.links.new(n.outputs[0], b.inputs["Normal"])
    return m


def brick_wall():
    """Large bricks, 360 x 120 mm, and light mortar: courses are 10 pixels high on the end wall."""
    m = material("brick", (0.2, 0.1, 0.07))
    t = m.node_tree
    b, x = t.nodes["Principled BSDF"], t.nodes.new("ShaderNodeTexBrick")
    where = t.nodes.new("ShaderNodeTexCoord")
    x.inputs["Color1"].default_value = (0.17, 0.080, 0.055, 1)
    x.inputs["Color2"].default_value = (0.25, 0.120, 0.080, 1)
    x.inputs["Mortar"].default_value = (0.50, 0.45, 0.40, 1)
    for k, v in {"Scale": 1, "Brick Width": 0.36, "Row Height": 0.12, "Mortar Size": 0.012}.items():
        x.inputs[k].default_value = v
    split, join = t.nodes.new("ShaderNodeSeparateXYZ"), t.nodes.new("ShaderNodeCombineXYZ")
    add = t.nodes.new("ShaderNodeMath")
    t.links.new(where.outputs["Object"], split.inputs[0])
    t.links.new(split.outputs["X"], add.inputs[0])
    t.links.new(split.outputs["Y"], add.inputs[1])
    t.links.new(add.outputs[0], join.inputs["X"])
    t.links.new(split.outputs["Z"], join.inputs["Y"])
    t.links.new(join.outputs[0], x.inputs["Vector"])
    t.links.new(x.outputs["Color"], b.inputs["Base Color"])
    n = t.nodes.new("ShaderNodeBump")
    n.invert = True
    n.inputs["Strength"].default_value = 0.5
    n.inputs["Distance"].default_value = 0.01
    t.links.new(x.outputs["Fac"], n.inputs["Height"])
    t.links.new(n.outputs[0], b.inputs["Normal"])
    return m


def mesh(name, vertices, faces, m):
    d = bpy.data.meshes.new(name)
    d.from_pydata(vertices, [], faces)
    d.materials.append(m)
    o = bpy.data.objects.new(name, d)
    bpy.context.scene.collection.objects.link(o)
    return o


def box(name, low, high, m, bevel=0.0):
    v = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    f = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    o = mesh(name, v, f, m)
    if bevel:
        b = o.modifiers.new("bevel", "BEVEL")
        b.width, b.segments = bevel, 3
    return o


def seen_only(o):
    """Seen by the camera, lights nothing, shades nothing."""
    o.visible_diffuse = o.visible_glossy = o.visible_transmission = o.visible_shadow = False
    return o


def panel(name, low, high, rgb, cdm2, share):
    """A glowing box that is seen, and an area light before its face that has that share of its light."""
    seen_only(box(name, low, high, emitter(name, rgb, cdm2)))
    if not share:
        return
    w, h, peak = high[0] - low[0], high[2] - low[2], max(rgb)
    a = bpy.data.lights.new(name, "AREA")
    a.shape, a.size, a.size_y = "RECTANGLE", w, h
    a.color = [c / peak for c in rgb]
    a.energy = share * 4 * w * h * cdm2 * peak / WHITE  # Cycles: radiance of an area light is W / (4 area)
    o = bpy.data.objects.new(name + " light", a)
    o.location = ((low[0] + high[0]) / 2, low[1] - 0.06, (low[2] + high[2]) / 2)
    o.rotation_euler = (-math.pi / 2, 0, 0)
    o.visible_camera = False
    bpy.context.scene.collection.objects.link(o)


def lamp(name, x, y, arm, rgb, candela, lens, metal):
    """A post with an arm towards the road and a lens that sends light down, cut off at 50 degrees."""
    height, side = 6.0, math.copysign(1, arm)
    box(name + " post", (x - 0.06, y - 0.06, 0), (x + 0.06, y + 0.06, height), metal)
    box(name + " arm", (min(x, x + arm), y - 0.04, height), (max(x, x + arm), y + 0.04, height + 0.08), metal)
    cx, (w, d) = x + arm + side * lens[0] / 2, lens
    box(name + " head", (cx - w / 2 - 0.04, y - d / 2 - 0.04, height),
        (cx + w / 2 + 0.04, y + d / 2 + 0.04, height + 0.12), metal)
    glow = emitter(name, rgb, candela / (w * d))
    seen_only(box(name + " lens", (cx - w / 2, y - d / 2, height - 0.08),
                  (cx + w / 2, y + d / 2, height - 0.001), glow))
    for _ in range(2):  # in halves, as the moon is in parts
        spot(name, (cx, y, height - 0.1), (0, 0, 0), rgb, candela / 2, 100)


def spot(name, where, turn, rgb, candela, degrees):
    s = bpy.data.lights.new(name, "SPOT")
    peak = max(rgb)
    s.color = [c / peak for c in rgb]
    s.energy = 4 * math.pi * candela * peak / WHITE  # Cycles: W of a point or spot are 4 pi times its W/sr
    s.spot_size, s.spot_blend, s.shadow_soft_size = math.radians(degrees), 0.35, 0.06
    o = bpy.data.objects.new(name, s)
    o.location, o.rotation_euler = where, turn
    bpy.context.scene.collection.objects.link(o)


def grass(low, high, blades, m):
    """Thin triangles; further ones are wider, as fewer are needed there."""
    rng, v, f = random.Random(18), [], []
    for _ in range(blades):
        y = low[1] + (high[1] - low[1]) * rng.random() ** 2
        x, turn, tall = rng.uniform(low[0], high[0]), rng.uniform(0, 6.283), rng.uniform(0.04, 0.13)
        wide = 0.006 + 0.0012 * (y - low[1])
        dx, dy = wide * math.cos(turn), wide * math.sin(turn)
        i = len(v)
        v += [(x - dx, y - dy, 0.02), (x + dx, y + dy, 0.02),
              (x + rng.gauss(0, 0.03), y + rng.gauss(0, 0.03), tall)]
        f.append((i, i + 1, i + 2))
    return mesh("grass", v, f, m)


def ground():
    asphalt = texture(material("asphalt", (0.1,) * 3, 0.8), "ShaderNodeTexNoise", (0.07, 0.07, 0.072),
                      (0.13, 0.13, 0.125), 0.4, Scale=60.0, Detail=6.0)
    slabs = texture(material("pavement", (0.3,) * 3), "ShaderNodeTexNoise", (0.26, 0.25, 0.23),
                    (0.36, 0.35, 0.32), 0.1, Scale=9.0, Detail=8.0)
    gravel = texture(material("gravel", (0.4,) * 3), "ShaderNodeTexNoise", (0.32, 0.31, 0.28),
                     (0.5, 0.48, 0.44), 0.3, Scale=25.0, Detail=8.0)
    box("road", (-3, -30, -0.3), (3, 120, 0), asphalt)
    for x in (-5, 3):
        box("kerb", (x, -30, -0.3), (x + 2, 120, 0.12), slabs, 0.02)
    box("forecourt", (5, -30, -0.3), (60, 2, 0.1), gravel)
    soil = texture(material("soil", (0.2, 0.25, 0.1)), "ShaderNodeTexNoise", (0.22, 0.28, 0.11),
                   (0.34, 0.42, 0.18), 0.3, Scale=6.0, Detail=8.0)
    box("lawn", (5, 2, -0.3), (60, 120, 0.06), soil)
    blade = grass((5.1, 2.1), (22, 22), 60000, material("blade", (0.40, 0.54, 0.18)))
    blade.location.z = 0.05
    line = material("line", (0.6,) * 3)
    for y in range(-12, 90, 6):
        box("line", (-0.06, y, 0), (0.06, y + 2.5, 0.004), line)


def house_left(dark):
    box("house", (-14, 2, 0), (-5, 24, 7.5), brick_wall())
    mesh("roof", [(-14.4, 1.6, 7.4), (-4.6, 1.6, 7.4), (-9.5, 1.6, 11), (-14.4, 24.4, 7.4),
                  (-4.6, 24.4, 7.4), (-9.5, 24.4, 11)],
         [(0, 1, 2), (3, 5, 4), (1, 4, 5, 2), (0, 2, 5, 3), (0, 3, 4, 1)], dark)
    box("chimney", (-8, 6, 9), (-7.2, 7, 12), dark)
    # The end wall looks at the camera: a lit window in it, unlit ones above the street.
    panel("lit window", (-7.2, 1.97, 4.3), (-6.2, 2.02, 5.5), WINDOW, 60, 0)
    for x in (-7.2, -6.7, -6.2):
        box("bar", (x - 0.03, 1.93, 4.25), (x + 0.03, 1.97, 5.55), dark)
    box("bar", (-7.2, 1.93, 4.95), (-6.2, 1.97, 5.0), dark)
    for y in (4, 8, 12, 16, 20):
        box("window", (-5.02, y, 4.2), (-4.98, y + 1.2, 5.8), material("pane", (0.02, 0.02, 0.03), 0.1))
    box("sign box", (-5, 6.0, 2.7), (-3.7, 6.15, 3.5), dark)
    panel("sign", (-4.95, 5.97, 2.75), (-3.75, 6.0, 3.45), BLUE, 60, 0.04)
    text = bpy.data.curves.new("name", "FONT")
    text.body, text.size, text.align_x, text.offset = "BAR", 0.5, "CENTER", 0.012
    o = bpy.data.objects.new("name", text)
    o.location, o.rotation_euler = (-4.35, 5.96, 2.93), (math.pi / 2, 0, 0)
    text.materials.append(dark)
    bpy.context.scene.collection.objects.link(o)


def houses_far(dark):
    for x, y, w, h in ((12, 30, 9, 5), (24, 34, 8, 6), (-14, 32, 9, 6), (-4, 90, 14, 7)):
        box("far house", (x, y, 0), (x + w, y + 8, h), dark)
        mesh("far roof", [(x - 0.4, y - 0.4, h), (x + w + 0.4, y - 0.4, h), (x + w + 0.4, y + 8.4, h),
                          (x - 0.4, y + 8.4, h), (x + w / 2, y - 0.4, h + 3), (x + w / 2, y + 8.4, h + 3)],
             [(0, 1, 4), (1, 2, 5, 4), (2, 3, 5), (3, 0, 4, 5)], dark)


def car(x, y, dark):
    paint = material("paint", (0.03, 0.035, 0.05), 0.25)
    box("body", (x - 0.88, y, 0.32), (x + 0.88, y + 4.3, 0.95), paint, 0.12)
    cabin = [(x + half * side, y + along, z)
             for half, front, back, z in ((0.78, 0.35, 3.2, 0.9), (0.6, 0.85, 2.4, 1.45))
             for side, along in ((-1, front), (1, front), (1, back), (-1, back))]
    mesh("cabin", cabin, [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7)], paint)
    for side in (-0.75, 0.55):
        for along in (0.5, 3.2):
            bpy.ops.mesh.primitive_cylinder_add(radius=0.32, depth=0.2,
                                                location=(x + side + 0.1, y + along + 0.3, 0.32),
                                                rotation=(0, math.pi / 2, 0))
            bpy.context.object.data.materials.append(dark)
    for side, share in ((-0.82, 0), (0.60, 0.08)):
        panel("tail lamp", (x + side, y - 0.02, 0.72), (x + side + 0.22, y + 0.02, 0.80), RED, 60, share)
    box("plate", (x - 0.26, y - 0.02, 0.45), (x + 0.26, y + 0.01, 0.56), material("plate", (0.6, 0.6, 0.55)))


def chart(x, y, z, dark):
    """24 patches of 110 mm, on a board that looks at the camera, away from the moon."""
    codes = [linear(int(c)) for c in CHART.split()]
    box("board", (x, y, z), (x + 0.84, y + 0.03, z + 0.58), material("board", (0.03,) * 3))
    for leg in (0.05, 0.75):
        box("leg", (x + leg, y + 0.03, 0), (x + leg + 0.04, y + 0.07, z), dark)
    for i in range(24):
        px, pz = x + 0.03 + 0.133 * (i % 6), z + 0.44 - 0.137 * (i // 6)
        m = material("patch %d" % (i + 1), codes[3 * i:3 * i + 3], 1.0)
        m.node_tree.nodes["Principled BSDF"].inputs[spec_name(m)].default_value = 0
        box("patch", (px, y - 0.004, pz), (px + 0.11, y, pz + 0.11), m)


def spec_name(m):
    """Blender 4 renamed the input."""
    names = m.node_tree.nodes["Principled BSDF"].inputs.keys()
    return "Specular" if "Specular" in names else "Specular IOR Level"


def sky():
    """Moon: 0.32 lx across its light, 50 degrees up, on the right, a little ahead.
    Sky: 0.012 cd/m2 at the horizon, down to 0.005."""
    peak, parts = max(MOON), 3  # Cycles picks lights evenly: in 3 parts the moon is picked more often
    for _ in range(parts):
        s = bpy.data.lights.new("moon", "SUN")
        s.color, s.energy, s.angle = [c / peak for c in MOON], 0.32 / parts * peak / WHITE, math.radians(0.53)
        o = bpy.data.objects.new("moon", s)
        o.rotation_euler = (math.radians(-40), 0, math.radians(-80))
        bpy.context.scene.collection.objects.link(o)
    w = bpy.data.worlds.new("sky")
    bpy.context.scene.world = w
    w.use_nodes = True
    t = w.node_tree
    back, where = t.nodes["Background"], t.nodes.new("ShaderNodeTexCoord")
    split, ramp = t.nodes.new("ShaderNodeSeparateXYZ"), t.nodes.new("ShaderNodeValToRGB")
    for stop, k in zip(ramp.color_ramp.elements, (1.0, 0.4)):  # by the sine of the height
        stop.color = (*[k * c / 1.5 for c in unit((0.8, 1.0, 1.45))], 1)
    ramp.color_ramp.elements[1].position = 0.6
    back.inputs["Strength"].default_value = 1.5 * 0.012 / WHITE
    t.links.new(where.outputs["Generated"], split.inputs[0])
    t.links.new(split.outputs["Z"], ramp.inputs[0])
    t.links.new(ramp.outputs[0], back.inputs["Color"])


def stars(eye, distance=300.0, size=0.15):
    """Stars of magnitude 1.5 to 5, 3.2 times as many a magnitude, as squares of less than a pixel."""
    rng = random.Random(5)
    for step in range(8):
        magnitude = 1.5 + step / 2
        lux = 2.54e-6 * 10 ** (-0.4 * magnitude)
        glow = emitter("star", unit((1, 1, 1)), lux * (distance / size) ** 2)
        v, f = [], []
        for _ in range(round(2 * 10 ** (step / 4))):
            turn, rise, h = math.radians(rng.uniform(-35, 35)), math.asin(rng.uniform(0.03, 0.42)), size / 2
            x = eye[0] + distance * math.cos(rise) * math.sin(turn)
            y = eye[1] + distance * math.cos(rise) * math.cos(turn)
            z = eye[2] + distance * math.sin(rise)
            f.append(tuple(range(len(v), len(v) + 4)))
            v += [(x - h, y, z - h), (x + h, y, z - h), (x + h, y, z + h), (x - h, y, z + h)]
        seen_only(mesh("stars", v, f, glow))


def camera():
    c = bpy.data.cameras.new("camera")
    c.angle, c.clip_end = math.radians(54), 1000
    o = bpy.data.objects.new("camera", c)
    o.location, o.rotation_euler = (0.6, -14, 1.65), (math.radians(94.5), 0, math.radians(1))
    bpy.context.scene.collection.objects.link(o)
    bpy.context.scene.camera = o
    stars(o.location)


def settings(out, samples, width, seconds):
    s = bpy.context.scene
    s.render.engine = "CYCLES"
    s.render.resolution_x, s.render.resolution_y, s.render.resolution_percentage = width, width * 9 // 16, 100
    c = s.cycles
    c.samples, c.use_adaptive_sampling, c.use_denoising, c.seed = samples, False, False, 18
    c.max_bounces, c.diffuse_bounces, c.glossy_bounces = 2, 2, 1
    c.sample_clamp_indirect, c.filter_width = 0.03, 1.5  # 0.3 cd/m2 a bounced sample: biased, no fireflies
    c.light_sampling_threshold = 0  # its default of 0.01 plays dice with what is dim here
    c.time_limit = seconds  # stops there with the samples done so far; 0 is no limit
    c.caustics_reflective = c.caustics_refractive = False
    s.render.image_settings.file_format = "OPEN_EXR"
    s.render.image_settings.color_mode, s.render.image_settings.color_depth = "RGB", "32"
    s.render.filepath = out


def build():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    dark = material("dark", (0.03, 0.03, 0.035))
    metal = material("metal", (0.08,) * 3, 0.5)
    ground()
    house_left(dark)
    houses_far(dark)
    car(1.75, -1.0, dark)
    chart(-2.95, -6.5, 0.75, dark)
    lamp("sodium", -3.4, 7, 1.0, SODIUM, 120, (0.12, 0.07), metal)
    lamp("led", 3.4, 16, -1.0, LED, 120, (0.12, 0.06), metal)
    lamp("sodium far", -3.4, 30, 1.0, SODIUM, 120, (0.12, 0.07), metal)
    spot("yard lamp out of the frame", (-9.0, -3.0, 3.5), (math.pi / 2, 0, 0), LED, 60, 120)  # the end wall's
    sky()
    camera()


def finish(raw, out):
    """Half floats and the attributes that state what the values are."""
    primaries = "0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329"
    comment = "scripts/night_scene.py: a street under a moon; value 1 is 10 cd/m2"
    subprocess.run(["oiiotool", raw, "-d", "half", "--compression", "zip",
                    "--attrib:type=float", "whiteLuminance", str(WHITE),
                    "--attrib:type=float[8]", "chromaticities", primaries,
                    "--attrib", "owner", "CC0 1.0, no rights reserved", "--attrib", "comment", comment,
                    "-o", out], check=True)


def main():
    args = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if not args:
        sys.exit("blender -b -P scripts/night_scene.py -- OUT.exr [SAMPLES [WIDTH [SECONDS]]]")
    samples, width, seconds = (int(a) for a in (args[1:] + ["1024", "1280", "0"][len(args) - 1:])[:3])
    with tempfile.TemporaryDirectory() as folder:
        raw = os.path.join(folder, "raw.exr")
        build()
        settings(raw, samples, width, seconds)
        bpy.ops.render.render(write_still=True)
        finish(raw, args[0])


main()
