"""A night of numbers: lamps, dark ground, pixels that are no light."""
import numpy as np


def night(height, width, components=3, dtype="float32", seed=1):
    random = np.random.default_rng(seed)
    rgb = random.lognormal(-2.5, 1.5, (height, width, components))
    rgb[height // 3: height // 3 + 3, width // 4: width // 4 + 3, :3] = (60.0, 20.0, 4.0)
    rgb[height // 2, width // 2, :3] = (-0.01, 0.02, 0.3)
    rgb[0, 0, :3] = 0
    if components == 4:
        rgb[..., 3] = random.uniform(0, 1, (height, width))
        rgb[1, :, 3] = 1
        rgb[2, : width // 2, 3] = 0
    rgb = rgb.astype(dtype)
    rgb[height - 1, width - 1, 1] = np.nan
    rgb[height - 1, 0, 0] = np.inf
    return rgb


# Each with stages of its own, alone and together; keyword arguments.
STAGES = {
    "pixel stages": dict(adaptation=0.01),
    "another model": dict(adaptation=0.1, model="kirk2011", rods="quadratic"),
    "rods by level": dict(adaptation=0.1, model="cao2008"),
    "metered, a unit": dict(white_luminance=5),
    "metered on a region": dict(white_luminance=5, adaptation="auto:3,2,20,9"),
    "nothing called for": dict(adaptation=100),
    "strengths": dict(adaptation=0.03, strength=0.7, strength_shift=0.5, strength_chroma=0.25),
    "acuity": dict(adaptation=0.01, acuity="global", ppd=20),
    "local acuity": dict(adaptation=0.01, acuity="local", ppd=20),
    "loss of contrast": dict(adaptation=0.01, effects="detail", ppd=20),
    "noise": dict(adaptation=0.0005, effects="noise", ppd=30, seed=7),
    "an eye from daylight": dict(adaptation=0.01, adaptation_history="1000:600,0.01:20"),
    "a lamp adapted to": dict(adaptation=0.1, illuminant="hps", adapt_white="lamp"),
    "glare": dict(adaptation=0.05, effects="glare", ppd=10),
    "all the retina's light": dict(adaptation=0.05, glare="all", ppd=10, age=70),
    "everything": dict(adaptation=0.02, effects="all", fov=12),
    "display": dict(adaptation=0.05, display="night"),
    "display, all effects": dict(adaptation=0.05, display="night", effects="all", ppd=15),
    "tone map": dict(adaptation=0.05, tone="local"),
    "exposure": dict(adaptation=0.05, exposure=-1.5),
    "another space": dict(adaptation=0.05, colorspace="ACEScg"),
    "into a space": dict(adaptation=0.05, output_colorspace="ACEScct"),
    "cleaned": dict(adaptation=0.05, nonfinite="clean"),
    "in double": dict(adaptation=0.05, precision="double"),
    "through a LUT": dict(adaptation=0.05, precision="lut33"),
}
