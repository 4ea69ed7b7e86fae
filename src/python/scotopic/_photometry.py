"""Light without an image: receptors, mesopic photometry, pupil, thresholds, adaptation in time."""

from typing import NamedTuple as _NamedTuple

import numpy as _np

from . import _core


class Mesopic(_NamedTuple):
    """What CIE 191:2010 (MES2) makes of a light."""
    coefficient: _np.ndarray
    luminance: _np.ndarray


class Thresholds(_NamedTuple):
    """What an adapted eye sees at least; see thresholds()."""
    difference: _np.ndarray
    rods: _np.ndarray
    cones: _np.ndarray
    both: _np.ndarray


def _text(value):
    return value if isinstance(value, str) else repr(float(value))


def _sampling(sampling):
    if sampling not in ("bin", "point"):
        raise ValueError(f"sampling: '{sampling}' is not one of bin, point")
    return sampling == "bin"


def lmsr(spectrum, wavelengths, *, sampling="bin"):
    """Signals of cones and rods: L, M, S, R in luminance units (D65 of 1 cd/m2: L + M = 1, R = 0.4986).

    spectrum: radiance in W/(m2 sr nm), bands along the last axis, any number of axes before it. wavelengths:
    band centres in nm, ascending. sampling: values are means over their bins (bin) or samples (point).
    Returns an array (..., 4). Cones of Stockman & Sharpe 2000 (2 degrees), rods of CIE 1951. Relative error
    1e-14 of the band model.

    >>> nm, d65 = illuminant("d65")
    >>> signals = lmsr(d65, nm)
    >>> round(float(signals[3] / (signals[0] + signals[1])), 4)
    0.4986
    """
    return _core.lmsr(spectrum, list(map(float, wavelengths)), _sampling(sampling))


def luminances(spectrum, wavelengths, *, sampling="bin"):
    """Photopic and scotopic luminance, cd/m2, of spectral radiance: CIE 1924 V, CIE 1951 V'.

    Arguments as for lmsr(). Returns an array (2, ...).

    >>> nm, sodium = illuminant("hps")
    >>> photopic, scotopic = luminances(sodium, nm)
    >>> round(float(scotopic / photopic), 2)
    0.65
    """
    return _np.moveaxis(_core.luminances(spectrum, list(map(float, wavelengths)), _sampling(sampling)), -1, 0)


def mes2(photopic, sp_ratio=2.4648):
    """Mesopic photometry by CIE 191:2010 (MES2): the adaptation coefficient m (1: cones alone, 0: rods alone)
    and the mesopic luminance, cd/m2.

    photopic: luminance in cd/m2; sp_ratio: scotopic over photopic luminance of the light, CIE D65's by
    default. Numbers or arrays that go together by numpy's rules; the results have their common shape.

    >>> mes2(0.1, 0.65).luminance < 0.1 < mes2(0.1, 1.72).luminance
    True
    """
    return Mesopic(_core.mes2_coefficient(photopic, sp_ratio), _core.mes2_luminance(photopic, sp_ratio))


def pupil(adaptation):
    """Diameter of the pupil in mm at an adaptation luminance in cd/m2, a number or an array: Watson &
    Yellott 2012, 60 degrees, both eyes, age 28.58.

    >>> round(pupil(1.0), 2)
    5.16
    """
    return _core.pupil(adaptation)


def trolands(adaptation):
    """Trolands per cd/m2 through that pupil, its area in mm2, at an adaptation luminance in cd/m2, a number
    or an array.

    >>> round(trolands(1.0), 2)
    20.91
    """
    return _core.trolands(adaptation)


def thresholds(luminance):
    """What an eye adapted to `luminance` cd/m2, a number or an array, sees at least; results have its shape.

    difference: least visible difference, cd/m2 (Ferwerda et al. 1996 as in Ward Larson et al. 1997). rods,
    cones, both: log10 of the threshold over the absolute one of rods.

    >>> t = thresholds([0.001, 100.0])
    >>> bool(t.rods[0] < t.cones[0]), bool(t.rods[1] < t.cones[1])
    (True, False)
    """
    values = _np.asarray(luminance, float)
    table = _np.array([_core.thresholds(float(v)) for v in values.ravel()]).reshape(values.shape + (4,))
    return Thresholds(*_np.moveaxis(table, -1, 0))


_TRACK = ("rod_bleached", "rod_product", "cone_bleached", "rod_neural", "cone_neural", "rod_luminance",
          "cone_luminance", "rods", "cones", "both", "exposure")


def adaptation_track(luminance, dt, history=None):
    """Adaptation in time: the eye's state and thresholds at each of the frames, `dt` seconds apart.

    luminance: adaptation luminance of each frame, cd/m2. history: before the first frame, as text
    "cdm2:seconds,..." or as pairs; None: adapted to the first. Returns a structured array: shares of bleached
    pigment, neural adaptation (cd/m2), equivalent luminances (cd/m2), log10 thresholds over the absolute one,
    and the exposure factor of the scene (1 once adapted).

    >>> dark = adaptation_track([0.01] * 3, 60.0, history=[(1000, 600)])
    >>> bool(dark["exposure"][0] < dark["exposure"][2] <= 1)
    True
    """
    if history is not None and not isinstance(history, str):
        history = ",".join(f"{_text(light)}:{_text(seconds)}" for light, seconds in history)
    values = [float(v) for v in _np.asarray(luminance, float).ravel()]
    table = _core.adaptation_track(values, float(dt), history or "")
    out = _np.empty(len(table), [(name, float) for name in _TRACK])
    for i, name in enumerate(_TRACK):
        out[name] = table[:, i]
    return out


def illuminants():
    """Kinds of light by name: (name, S/P ratio, description).

    >>> "hps" in [name for name, ratio, description in illuminants()]
    True
    """
    return _core.illuminants()


def illuminant(name):
    """Relative spectral power of a kind of light: wavelengths in nm (380 to 780 in steps of 5), values.

    >>> nm, power = illuminant("d65")
    >>> len(nm) == len(power) == 81
    True
    """
    return _core.illuminant(name)


def adaptations():
    """Adaptation luminances by name: (name, cd/m2, scene).

    >>> [luminance for name, luminance, scene in adaptations() if name == "moon"]
    [0.01]
    """
    return _core.adaptations()
