"""The program as what the module is held against: arrays to a file, through the program, and back."""
import os
import subprocess
import tempfile

import numpy as np
import OpenImageIO as oiio

PROGRAM = os.environ["SCOTOPIC"]
FORMATS = {"float16": "half", "float32": "float"}


def options(parameters):
    """Keyword arguments as words of the command line."""
    return [f"--{name.replace('_', '-')}={value}" for name, value in parameters.items()]


def run(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True)


def write(path, pixels, straight=False, aspect=1.0):
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], FORMATS[pixels.dtype.name])
    if straight:
        spec.attribute("oiio:UnassociatedAlpha", 1)
    spec.attribute("PixelAspectRatio", aspect)
    out = oiio.ImageOutput.create(path)
    assert out.open(path, spec) and out.write_image(np.ascontiguousarray(pixels)) and out.close(), out.geterror()


def read(path, dtype):
    config = oiio.ImageSpec()
    config.attribute("oiio:UnassociatedAlpha", 1)
    image = oiio.ImageInput.open(path, config)
    pixels = image.read_image(FORMATS[dtype])
    image.close()
    return pixels


def apply(pixels, *, straight=False, aspect=1.0, frame=None, **parameters):
    """What the program makes of (height, width, 3 or 4) of float16 or float32."""
    with tempfile.TemporaryDirectory() as folder:
        extension = "tif" if straight else "exr"
        source, target, words = f"{folder}/in.{extension}", f"{folder}/out.{extension}", options(parameters)
        if frame is not None:
            source, target = f"{folder}/in.{frame:04}.exr", f"{folder}/out.{frame:04}.exr"
            words += ["--frames", str(frame)]
        write(source, pixels, straight, aspect)
        pattern = [name if frame is None else name.replace(f"{frame:04}", "####") for name in (source, target)]
        done = run("apply", pattern[0], "-o", pattern[1], *words)
        assert done.returncode == 0, done.stderr
        return read(target, pixels.dtype.name)
