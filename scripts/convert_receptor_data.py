#!/usr/bin/python3
"""Writes src/receptors/tables/*.csv and tests/data/reflectances_*.csv from Debian's psychtoolbox-3-common.

Needs python3-scipy, only to read the .mat files; building the project does not run this. The output is a
function of the package's files alone: the same bytes every time.

usage: convert_receptor_data.py [--source DIR] [--output DIR] [--reflectances DIR]
"""

import argparse
import pathlib
import sys

SOURCE = "/usr/share/psychtoolbox-3/PsychColorimetricData/PsychColorimetricMatFiles"
PACKAGE = "Psychtoolbox-3 (Debian psychtoolbox-3-common), {}, licence Expat"
HOUSER = (
    "Houser, Wei, David, Krames, Shen: Review of measures for light-source color rendition, "
    "Optics Express 21(8), 10393-10411 (2013), data set of 401 spectra"
)

# file name: what it is, source, units, column names, .mat file, variable, which columns or labels of it
TABLES = {
    "cones_stockman_sharpe_2000_2deg.csv": (
        "Cone fundamentals for 2 degrees, per unit of energy, each with peak 1",
        "Stockman and Sharpe, Vision Research 40, 1711-1737 (2000); CIE 170-1:2006; table of CVRL",
        "nm; relative to the peak", ("l", "m", "s"), "T_cones_ss2", None),
    "scotopic_cie_1951.csv": (
        "Scotopic luminous efficiency V'(lambda), peak 1",
        "CIE 1951; CIE S 010/ISO 23539; table of CVRL",
        "nm; relative to the peak", ("v_prime",), "T_rods", None),
    "xyz_cie_1931_2deg.csv": (
        "Colour-matching functions of the 2 degree standard observer; y is V(lambda)",
        "CIE 1931; CIE 015:2018; table of CVRL",
        "nm; relative to the peak of y", ("x", "y", "z"), "T_xyz1931", None),
    "illuminant_cie_d65.csv": (
        "Daylight illuminant D65", "CIE 015:2018; ISO 11664-2",
        "nm; relative spectral power, 100 at 560 nm", ("d65",), "spd_D65", None),
    "illuminant_cie_a.csv": (
        "Tungsten illuminant A", "CIE 015:2018; ISO 11664-2",
        "nm; relative spectral power, 100 at 560 nm", ("a",), "spd_CIEA", None),
    "daylight_components_cie.csv": (
        "Mean and the two components of daylight", "CIE 015:2018; Judd, MacAdam, Wyszecki (1964)",
        "nm; relative spectral power, s0 is 100 at 560 nm", ("s0", "s1", "s2"), "B_cieday", None),
    "lamps_houser_2013.csv": (
        "High-pressure sodium (NIST 9: HPS), LED near 3000 K (NIST 125: Cree F2), "
        "LED near 4000 K (MCRI-55: WR4k, white and red)",
        HOUSER, "nm; relative spectral power, peak 1", ("hps", "led3000", "led4000"), "spd_houser",
        ("NIST 9: HPS", "NIST 125: Cree F2", "MCRI-55: WR4k")),
}

# file name: what it is, source, .mat file, first and last wavelength measured, step to keep
REFLECTANCES = {
    "reflectances_macbeth.csv": (
        "Macbeth ColorChecker, 24 patches in order", "Psychtoolbox", "sur_macbeth", (390, 730, 5)),
    "reflectances_munsell.csv": (
        "462 Munsell papers", "Nickerson (1957), via Psychtoolbox", "sur_nickerson", (400, 700, 10)),
    "reflectances_vrhel.csv": (
        "170 natural and man-made objects",
        "Vrhel, Gershon, Iwan, Color Research and Application 19, 4-9 (1994)", "sur_vrhel", (390, 730, 10)),
    "reflectances_krinov.csv": (
        "191 natural formations, measured outdoors",
        "Krinov, Spectral reflectance properties of natural formations (1947)", "sur_krinov", (400, 650, 10)),
}


def curves(data, matrix, sampling, labels, wanted):
    """The sampled curves as rows of floats, whichever way round the file keeps them."""
    count = int(data[sampling][0][2])
    values = data[matrix]
    rows = values if values.shape[1] == count else values.T
    if wanted is not None:
        names = [str(label[0]) for label in data[labels][0]]
        rows = [rows[names.index(name)] for name in wanted]
    return [[float(value) for value in row] for row in rows]


def table_text(spec, source):
    import scipy.io

    title, publication, units, columns, stem, wanted = spec
    data = scipy.io.loadmat(f"{source}/{stem}.mat")
    sampling = next(name for name in data if name.startswith("S_") and data[name].shape == (1, 3))
    first, step, count = (int(value) for value in data[sampling][0])
    matrix = next(name for name in data if not name.startswith(("_", "S_", "labels")))
    rows = curves(data, matrix, sampling, sampling.replace("S_", "labels_", 1), wanted)
    if wanted is not None:
        rows = [[value / max(row) for value in row] for row in rows]
    if len(rows) != len(columns) or any(len(row) != count for row in rows):
        sys.exit(f"{stem}: not {len(columns)} curves of {count} samples")
    lines = [f"# {title}", f"# {publication}", f"# {PACKAGE.format(stem + '.mat')}", f"# {units}",
             "nm," + ",".join(columns)]
    for index in range(count):
        values = ",".join(format(row[index], ".9g") for row in rows)
        lines.append(f"{first + step * index},{values}")
    return "\n".join(lines) + "\n"


def reflectance_text(spec, source):
    import scipy.io

    title, publication, stem, (first, last, step) = spec
    data = scipy.io.loadmat(f"{source}/{stem}.mat")
    sampling = stem.replace("sur_", "S_", 1)
    rows = curves(data, stem, sampling, None, None)
    file_first, file_step, _ = (int(value) for value in data[sampling][0])
    lines = [f"# {title}", f"# {publication}", f"# {PACKAGE.format(stem + '.mat')}",
             "# nm; reflectance, 1 is a perfect white; the range that was measured",
             "nm," + ",".join(f"r{index + 1}" for index in range(len(rows)))]
    for nm in range(first, last + 1, step):
        index, rest = divmod(nm - file_first, file_step)
        if rest:
            sys.exit(f"{stem}: no sample at {nm} nm")
        lines.append(f"{nm}," + ",".join(format(row[index], ".4g") for row in rows))
    return "\n".join(lines) + "\n"


def write(folder, name, text):
    (folder / name).write_text(text, encoding="ascii", newline="\n")


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--source", default=SOURCE, help="folder of the .mat files")
    parser.add_argument("--output", default=root / "src/receptors/tables", type=pathlib.Path)
    parser.add_argument("--reflectances", default=root / "tests/data", type=pathlib.Path)
    options = parser.parse_args()
    for name, spec in TABLES.items():
        write(options.output, name, table_text(spec, options.source))
    for name, spec in REFLECTANCES.items():
        write(options.reflectances, name, reflectance_text(spec, options.source))


if __name__ == "__main__":
    main()
