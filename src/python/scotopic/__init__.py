"""Images as the dark-adapted eye sees them: the operator of the program `scotopic`, on arrays.

>>> import numpy, scotopic
>>> lamp = numpy.float32([[[4.0, 1.0, 0.2], [0.02, 0.02, 0.02]]])
>>> scotopic.apply(lamp, adaptation=0.01).shape
(1, 2, 3)

Parameters have the names, ranges and defaults of the program's options (`--white-luminance` is
white_luminance). Results are the bytes that the program writes from OpenEXR to OpenEXR.
"""

import inspect as _inspect
import json as _json
import logging as _logging
from typing import NamedTuple as _NamedTuple

import numpy as _np

from . import _core
from ._photometry import (Mesopic, Thresholds, adaptation_track, adaptations, illuminant, illuminants, lmsr,
                          luminances, mes2, pupil, thresholds, trolands)

__version__ = _core.__version__
__all__ = ["Mesopic", "Operator", "Thresholds", "adaptation_track", "adaptations", "apply", "explain",
           "illuminant", "illuminants", "lmsr", "luminances", "mes2", "parameters", "pupil", "set_threads",
           "thresholds", "trolands"]

_log = _logging.getLogger("scotopic")
# Of the picture, not of the operator.
_OF_IMAGE = {"frame": None, "alpha": "premultiplied", "pixel_aspect": 1.0}


class Parameter(_NamedTuple):
    """A parameter of the operator: what it is called, takes and does."""
    name: str
    group: str
    takes: str
    sentence: str


def parameters():
    """All parameters of the operator, in the order of the program's help."""
    return [Parameter(*p) for p in _core.parameters()]


_NAMES = [p.name for p in parameters()]


def _text(value):
    """A value as the program's option takes it."""
    if isinstance(value, (bool, _np.bool_)):
        raise TypeError("takes no True or False")
    if isinstance(value, str):
        return value
    if isinstance(value, (int, _np.integer)):
        return str(int(value))
    if isinstance(value, (float, _np.floating)):
        return repr(float(value))
    if isinstance(value, (list, tuple)):
        return ",".join(_text(v) for v in value)
    if hasattr(value, "__fspath__"):
        return value.__fspath__()
    raise TypeError(f"takes a number, a text or several, not {type(value).__name__}")


def _texts(name, values):
    out = {}
    for key, value in values.items():
        if key not in _NAMES:
            raise TypeError(f"{name}() got an unexpected keyword argument '{key}'")
        if value is None:
            continue
        if key == "acuity" and isinstance(value, bool):
            value = "global" if value else "off"
        try:
            out[key] = _text(value)
        except TypeError as error:
            raise TypeError(f"{key} {error}") from None
    return out


def _image_arguments(values, buffer=None):
    usual = dict(_OF_IMAGE) if buffer is None else {**_OF_IMAGE, **_of_buffer(buffer.spec())}
    a = {key: values.pop(key, value) for key, value in usual.items()}
    if a["alpha"] not in ("premultiplied", "straight"):
        raise ValueError(f"alpha: '{a['alpha']}' is not one of premultiplied, straight")
    return a


def _of_buffer(spec):
    """What an ImageBuf says itself of its alpha and its pixels."""
    straight = spec.get_int_attribute("oiio:UnassociatedAlpha", 0)
    return {"alpha": "straight" if straight else "premultiplied",
            "pixel_aspect": spec.get_float_attribute("PixelAspectRatio", 1.0)}


def _frame(a, index=0):
    frame = None if a["frame"] is None else int(a["frame"]) + index
    return _core.FrameArguments(frame, a["alpha"] == "straight", float(a["pixel_aspect"]))


def _as_array(rgb):
    """Pixels, and how to give them back: arrays as they are, an OpenImageIO ImageBuf as one."""
    if hasattr(rgb, "get_pixels") and hasattr(rgb, "spec"):
        spec = rgb.spec()
        if spec.nchannels not in (3, 4):
            raise ValueError(f"the ImageBuf has {spec.nchannels} channels: R, G, B or R, G, B, A are needed")
        kind = "half" if str(spec.format) == "half" else "double" if str(spec.format) == "double" else "float"
        return rgb.get_pixels(kind), rgb
    return _np.asarray(rgb), None


def _as_buffer(pixels, like):
    module = __import__("OpenImageIO")
    spec = module.ImageSpec(like.spec())
    spec.set_format({"float16": "half", "float32": "float", "float64": "double"}[pixels.dtype.name])
    out = module.ImageBuf(spec)
    out.set_pixels(spec.roi, pixels)
    return out


def _images(array):
    """The array as images (height, width, components), one after the other; a row of pixels is one image."""
    if array.ndim == 0 or array.shape[-1] not in (3, 4):
        raise ValueError(f"rgb must end in 3 components (R, G, B) or 4 (alpha); its shape is {array.shape}")
    if array.dtype.kind != "f" or array.dtype.itemsize > 8 or not array.dtype.isnative:
        raise TypeError(f"rgb must be of float16, float32 or float64, not {array.dtype}")
    while array.ndim < 3:
        array = array[_np.newaxis]
    for index in _np.ndindex(array.shape[:-3]):
        yield array[index]


def _target(array, out):
    if out is None:
        return _np.empty(array.shape, array.dtype)
    if not isinstance(out, _np.ndarray):
        raise TypeError("out must be an array")
    if out.shape != array.shape or out.dtype != array.dtype:
        raise ValueError(f"out must be of shape {array.shape} and {array.dtype}, as rgb; "
                         f"it is {out.shape}, {out.dtype}")
    return out


def _same_place(a, b):
    return (a.__array_interface__["data"][0] == b.__array_interface__["data"][0] and a.strides == b.strides)


class Operator:
    """The operator with its parameters: understood once, for any number of images and threads.

    Immutable and hashable; two operators are equal if their parameters are. Parameters are those of apply().

    >>> moon = Operator(adaptation="moon", effects="shift,luminance")
    >>> moon == Operator(adaptation="moon", effects=["shift", "luminance"])
    True
    >>> moon.parameters["effects"]
    'shift,luminance'
    """

    __slots__ = ("_parameters", "_cores")

    def __init__(self, **parameters):
        object.__setattr__(self, "_parameters", tuple(sorted(_texts("Operator", parameters).items())))
        object.__setattr__(self, "_cores", {})
        self._core("float32")

    def __setattr__(self, name, value):
        raise AttributeError("an Operator does not change: make another one")

    def __eq__(self, other):
        return isinstance(other, Operator) and self._parameters == other._parameters

    def __hash__(self):
        return hash(self._parameters)

    def __repr__(self):
        return "Operator(" + ", ".join(f"{name}={value!r}" for name, value in self._parameters) + ")"

    def __reduce__(self):
        return _operator, (dict(self._parameters),)

    @property
    def parameters(self):
        """Those that were given, each as the text that the program's option takes."""
        return dict(self._parameters)

    def _core(self, dtype):
        chosen = self.parameters
        if dtype == "float64" and not {"precision", "max_error", "budget"} & chosen.keys():
            chosen["precision"] = "double"
        key = chosen.get("precision")
        if key not in self._cores:
            self._cores[key] = _core.Operator(chosen)
        return self._cores[key]

    def apply(self, rgb, *, out=None, **image):
        """See scotopic.apply(); `image` are frame, alpha and pixel_aspect."""
        array, buffer = _as_array(rgb)
        a = _image_arguments(image, buffer)
        if image:
            raise TypeError(f"Operator.apply() got an unexpected keyword argument '{next(iter(image))}'")
        images = list(_images(array))
        target = _target(array, out)
        if target is not array and not _same_place(target, array) and _np.may_share_memory(target, array):
            images = [image.copy() for image in images]
        core = self._core(array.dtype.name)
        for index, (image, made) in enumerate(zip(images, _images(target))):
            if image.size == 0:
                continue
            for detail, line in core.apply(image, made, _frame(a, index)):
                _log.log(_logging.DEBUG if detail else _logging.INFO, line)
        return _as_buffer(target, buffer) if buffer is not None and out is None else target

    def _of_one(self, rgb, image, name):
        array, buffer = _as_array(rgb)
        a = _image_arguments(image, buffer)
        if image:
            raise TypeError(f"Operator.{name}() got an unexpected keyword argument '{next(iter(image))}'")
        images = list(_images(array))
        if len(images) != 1 or images[0].size == 0:
            raise ValueError(f"{name}() takes one image with pixels")
        return _json.loads(getattr(self._core(images[0].dtype.name), name)(images[0], _frame(a)))

    def explain(self, rgb, **image):
        """See scotopic.explain()."""
        return self._of_one(rgb, image, "explain")

    def plan(self, rgb, **image):
        """Which effects would run on the image, and why: a dict by effect. No pixel is changed."""
        return self._of_one(rgb, image, "plan")

    def bake(self, path, *, size=33, max_error=None):
        """Writes the pixel stages as a LUT, as `scotopic bake -o` does: .clf, .ctf, .spi3d or .cube.

        size: nodes a side, 17, 33, 65 or 129. max_error: ValueError, and no file, if the worst colour is
        further off (CIEDE2000). Needs adaptation=; stages that look at neighbours are in no LUT. Returns what
        was measured: a list with one dict.
        """
        text = "" if max_error is None else _text(max_error)
        return _json.loads(self._core("float32").bake(_text(path), _text(size), text))

    def shader(self, language):
        """The pixel stages, exact, as the text of a shader: dctl, glsl, blink, hlsl or osl.

        As `scotopic bake --shader` writes it: adaptation, white luminance and strengths are sliders. With
        display="night" the display stage is in it.

        >>> "vec3 scotopic(vec3" in Operator(adaptation="moon").shader("glsl")
        True
        """
        return self._core("float32").shader(_text(language))


def _operator(parameters):
    return Operator(**parameters)


def apply(rgb, *, out=None, **parameters):
    """An image as the dark-adapted eye sees it.

    rgb: array (..., 3) or (..., 4) of float16, float32 or float64, of any strides, or an OpenImageIO ImageBuf.
    Linear light in the config's working space, or in `colorspace`; value 1 stands for `white_luminance` cd/m2.
    A fourth component is alpha. The last three axes are (height, width, components): an array of more is a
    stack of images, one after the other; one of fewer is a row of pixels.

    out: array of the same shape and type that takes the result; may be rgb itself, the only way in which rgb is
    ever changed. After an exception its values are undefined.

    frame: number of the (first) image in a sequence, for what moves; None: stills. alpha: premultiplied
    (default) or straight. pixel_aspect: width over height of a pixel. An ImageBuf tells the last two itself.

    Returns an array of the same shape and type (an ImageBuf for an ImageBuf). float64 is computed in double
    from values rounded to float; values that no stage changes keep all their digits.

    Raises ValueError with the program's own words for a value that is not understood, TypeError for a name
    that is none. What is assumed goes to the logger "scotopic" (INFO).
    """
    image = {name: parameters.pop(name) for name in list(parameters) if name in _OF_IMAGE}
    return Operator(**_checked("apply", parameters)).apply(rgb, out=out, **image)


def explain(rgb, **parameters):
    """What light an image holds and what it calls for: the object that `scotopic explain --json` prints.

    Arguments as for apply(); luminances in cd/m2, shares from 0 to 1.

    >>> scotopic = __import__("scotopic")
    >>> light = scotopic.explain(_np.full((8, 8, 3), 0.5, "float32"), adaptation=0.01, white_luminance=0.1)
    >>> round(light["photopic"]["mean"], 6), light["effects"]["shift"]["runs"]
    (0.05, True)
    """
    image = {name: parameters.pop(name) for name in list(parameters) if name in _OF_IMAGE}
    return Operator(**_checked("explain", parameters)).explain(rgb, **image)


def _checked(name, parameters):
    for key in parameters:
        if key not in _NAMES:
            raise TypeError(f"{name}() got an unexpected keyword argument '{key}'")
    return parameters


def set_threads(count):
    """Threads that apply() uses, for all operators; 0: as many as the machine has."""
    _core.set_threads(int(count))


def _describe():
    """Signatures and docstrings name every parameter, from the program's own table."""
    kind = _inspect.Parameter.KEYWORD_ONLY
    operator = [_inspect.Parameter(name, kind, default=None) for name in _NAMES]
    image = [_inspect.Parameter(name, kind, default=usual) for name, usual in _OF_IMAGE.items()]
    rgb = _inspect.Parameter("rgb", _inspect.Parameter.POSITIONAL_OR_KEYWORD)
    out = _inspect.Parameter("out", kind, default=None)
    apply.__signature__ = _inspect.Signature([rgb, out, *operator, *image])
    explain.__signature__ = _inspect.Signature([rgb, *operator, *image])
    Operator.__signature__ = _inspect.Signature(operator)
    lines, group = ["", "    Parameters of the operator:"], None
    for p in parameters():
        if p.group != group:
            lines.append(f"\n    {p.group}")
            group = p.group
        lines.append(f"      {p.name} ({p.takes}): {p.sentence}" if p.takes else f"      {p.name}: {p.sentence}")
    apply.__doc__ += "\n".join(lines) + "\n"


_describe()
