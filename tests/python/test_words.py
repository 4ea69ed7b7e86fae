"""Words are the program's: errors, reports, LUTs, stubs; and the documents' examples run."""
import doctest
import filecmp
import inspect
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import program
import scotopic
from scenes import night

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Parameters, exception, and where the program has no such mistake the text.
MISTAKES = [
    (dict(adaptation=-1), ValueError, None),
    (dict(adaptation="mon"), ValueError, None),
    (dict(adaptation="nan"), ValueError, None),
    (dict(adaptation=0.1, strength=2), ValueError, None),
    (dict(adaptation=0.1, ppd=0), ValueError, None),
    (dict(adaptation=0.1, ppd=3, fov=4), ValueError, None),
    (dict(adaptation=0.1, effects="shift,blur"), ValueError, None),
    (dict(adaptation=0.1, colorspace="no such space"), ValueError, None),
    (dict(adaptation=0.1, config="/no/such/config.ocio"), ValueError, None),
    (dict(adaptation=0.1, display="no such view"), ValueError, None),
    (dict(adaptation=0.1, peak=200), ValueError, None),
    (dict(adaptation=0.1, max_memory=50000, glare="all", effects="glare", ppd=10), MemoryError, None),
    (dict(adaptation=0.1, acuity="global"), ValueError, None),
    (dict(), ValueError, None),
    (dict(adaptation=0.1, nonfinite="error"), ValueError, None),
    (dict(adaptation=""), ValueError, "--adaptation: '' is not a value: it is empty"),
    (dict(adaptation=0.1, strength=""), ValueError, "--strength: '' is not a value: it is empty"),
    (dict(adaptation=True), TypeError, "adaptation takes no True or False"),
    (dict(adaptation=0.1, ppd=1j), TypeError, "ppd takes a number, a text or several, not complex"),
    (dict(adaptation=0.1, strenght=1), TypeError, "apply() got an unexpected keyword argument 'strenght'"),
    (dict(adaptation=0.1, layer="left"), TypeError, "apply() got an unexpected keyword argument 'layer'"),
    (dict(adaptation=0.1, alpha="none"), ValueError, "alpha: 'none' is not one of premultiplied, straight"),
    (dict(adaptation=0.1, fps=-1), ValueError, None),
]
IMAGES = [
    (np.zeros((4, 4, 2), "float32"), ValueError, "rgb must end in 3 components"),
    (np.float32(1), ValueError, "rgb must end in 3 components"),
    (np.zeros((4, 4, 3), "int32"), TypeError, "rgb must be of float16, float32 or float64, not int32"),
    (np.zeros((4, 4, 3), ">f4"), TypeError, "rgb must be of float16, float32 or float64, not >f4"),
    (np.zeros((4, 4, 3), "longdouble"), TypeError, "rgb must be of float16, float32 or float64"),
]


def said_by_program(rgb, parameters):
    """What the program says of the same mistake, without its name and the file's."""
    with tempfile.TemporaryDirectory() as folder:
        program.write(f"{folder}/in.exr", rgb)
        done = program.run("apply", f"{folder}/in.exr", "-o", f"{folder}/out.exr", "-q", *program.options(parameters))
        said = re.sub(r"^scotopic: |\S*in\.exr: | \(nothing written\)", "", done.stderr.strip().splitlines()[-1])
        return without_links(said)


def without_links(text):
    """Program and module may find the shipped config by different links."""
    return re.sub(r"\S*/config\.ocio", lambda path: os.path.realpath(path[0]), text)


class Words(unittest.TestCase):
    def test_a_mistake_is_told_as_by_the_program(self):
        rgb = night(9, 9)
        for parameters, kind, text in MISTAKES:
            with self.subTest(parameters=parameters), self.assertRaises(kind) as caught:
                scotopic.apply(rgb, **parameters)
            said = without_links(str(caught.exception).removeprefix("rgb: "))
            self.assertEqual(said, text or said_by_program(rgb, parameters), parameters)

    def test_an_array_that_is_no_image_is_refused(self):
        for array, kind, text in IMAGES:
            with self.assertRaisesRegex(kind, re.escape(text)):
                scotopic.apply(array, adaptation=0.1)

    def test_an_output_that_does_not_fit_is_refused(self):
        rgb = np.zeros((4, 5, 3), "float32")
        read_only = np.zeros_like(rgb)
        read_only.flags.writeable = False
        for out, kind in ((np.zeros((5, 4, 3), "float32"), ValueError), (np.zeros((4, 5, 3)), ValueError),
                          ([], TypeError), (read_only, ValueError)):
            with self.assertRaises(kind):
                scotopic.apply(rgb, out=out, adaptation=0.1)

    def test_explain_says_what_the_program_says(self):
        rgb = night(20, 30)
        for parameters in (dict(white_luminance=5), dict(adaptation=0.01, ppd=20, effects="all")):
            with tempfile.TemporaryDirectory() as folder:
                program.write(f"{folder}/in.exr", rgb)
                done = program.run("explain", f"{folder}/in.exr", "--json", "-q", *program.options(parameters))
            expected = json.loads(done.stdout.splitlines()[-1])
            found = scotopic.explain(rgb, **parameters)
            for report in (expected, found):
                report.pop("input")
                for effect in report["effects"].values():
                    effect.pop("nsPerPixel", None)  # measured on the clock
            self.assertEqual(found, expected)

    def test_a_plan_names_the_effects_and_leaves_pixels_alone(self):
        rgb = night(20, 30)
        before = rgb.tobytes()
        plan = scotopic.Operator(adaptation=100).plan(rgb)
        self.assertFalse(any(effect["runs"] for effect in plan.values()))
        plan = scotopic.Operator(adaptation=0.01).plan(rgb)
        self.assertTrue(plan["shift"]["runs"] and plan["shift"]["reason"])
        self.assertEqual(rgb.tobytes(), before)

    def test_a_lut_is_the_programs_to_the_byte(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, parameters in (("a.clf", dict(adaptation=0.01)),
                                     ("b.cube", dict(adaptation="street", colorspace="ACEScct"))):
                made, expected = f"{folder}/{name}", f"{folder}/of_program_{name}"
                report = scotopic.Operator(**parameters).bake(made, size=17)
                self.assertEqual(program.run("bake", "-o", expected, "--size", "17",
                                             *program.options(parameters)).returncode, 0)
                self.assertTrue(filecmp.cmp(made, expected, shallow=False), name)
                self.assertGreater(report[0]["max"], 0)
            with self.assertRaisesRegex(ValueError, "largest error"):
                scotopic.Operator(adaptation=0.01).bake(f"{folder}/c.clf", size=17, max_error=1e-6)
            self.assertFalse(os.path.exists(f"{folder}/c.clf"))
            with self.assertRaises(OSError):
                scotopic.Operator(adaptation=0.01).bake(f"{folder}/no/such/folder/c.clf", size=17)

    def test_a_shader_is_the_programs_text(self):
        with tempfile.TemporaryDirectory() as folder:
            for language, parameters in (("dctl", dict(adaptation=0.01)), ("glsl", dict(adaptation="street", strength=0.5))):
                expected = f"{folder}/s.txt"
                done = program.run("bake", "--shader", language, "-o", expected, *program.options(parameters))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(scotopic.Operator(**parameters).shader(language), pathlib.Path(expected).read_text())
        with self.assertRaisesRegex(ValueError, "--shader: 'cg' is not one of"):
            scotopic.Operator(adaptation=0.01).shader("cg")

    def test_parameters_are_those_of_the_programs_help(self):
        words = set(re.findall(r"--([a-z0-9-]+)", program.run("apply", "--help").stdout))
        names = [p.name for p in scotopic.parameters()]
        self.assertGreater(len(names), 40)
        self.assertEqual([n for n in names if n.replace("_", "-") not in words], [])

    def test_signature_stub_and_docstring_name_every_parameter(self):
        names = [p.name for p in scotopic.parameters()]
        stub = (pathlib.Path(scotopic.__file__).parent / "__init__.pyi").read_text()
        compile(stub, "__init__.pyi", "exec")
        for function in (scotopic.apply, scotopic.explain, scotopic.Operator):
            self.assertLessEqual(set(names), set(inspect.signature(function).parameters))
        self.assertNotIn("# PARAMETERS", stub)
        for name in names:
            self.assertEqual(len(re.findall(rf"^ +{name}: .* \| None = \.\.\.,$", stub, re.M)), 3, name)
            self.assertIn(f"\n      {name}", scotopic.apply.__doc__)
        for public in scotopic.__all__:
            self.assertTrue(getattr(scotopic, public).__doc__, public)
            self.assertRegex(stub, rf"(def|class) {public}\b")


class Documents(unittest.TestCase):
    def test_docstrings_run(self):
        for module, least in ((scotopic, 7), (scotopic._photometry, 15)):
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0)
            self.assertGreaterEqual(result.attempted, least)

    def test_the_examples_of_the_document_run(self):
        text = (ROOT / "docs" / "python.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```(?:\n+```text\n(.*?)```)?", text, re.S)
        self.assertGreater(len(blocks), 3)
        code = "\n".join(block for block, _ in blocks)
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True,
                                  env={**os.environ, "MPLBACKEND": "Agg"})
            self.assertEqual(done.returncode, 0, done.stderr)
            for _, printed in blocks:
                self.assertIn(printed, done.stdout)


if __name__ == "__main__":
    unittest.main()
