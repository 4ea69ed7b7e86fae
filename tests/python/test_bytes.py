"""Pixels are those that the program writes: stages x types x shapes x strides, byte for byte."""
import unittest

import numpy as np

import program
import scotopic
from scenes import STAGES, night


def strided(rgb):
    """The same pixels, lying in memory in other ways."""
    height, width, components = rgb.shape
    tall = np.zeros((2 * height, 3 * width, components), rgb.dtype)
    tall[::2, ::3] = rgb
    wide = np.zeros((height, width, components + 2), rgb.dtype)
    wide[..., 1:-1] = rgb
    planes = np.ascontiguousarray(np.moveaxis(rgb, -1, 0))
    odd = np.frombuffer(b"x" + rgb.tobytes(), np.uint8)[1:].view(rgb.dtype).reshape(rgb.shape)
    return {
        "packed": np.ascontiguousarray(rgb),
        "by columns": np.asfortranarray(rgb),
        "planes": np.moveaxis(planes, 0, -1),
        "upside down": np.ascontiguousarray(rgb[::-1])[::-1],
        "mirrored": np.ascontiguousarray(rgb[:, ::-1])[:, ::-1],
        "components reversed": np.ascontiguousarray(rgb[..., ::-1])[..., ::-1],
        "part of more components": wide[..., 1:-1],
        "every second row, every third column": tall[::2, ::3],
        "unaligned": odd,
    }


class Bytes(unittest.TestCase):
    def assert_same(self, made, expected):
        self.assertEqual(made.dtype, expected.dtype)
        self.assertEqual(made.shape, expected.shape)
        self.assertEqual(made.tobytes(), np.ascontiguousarray(expected).tobytes())

    def test_every_stage_type_and_number_of_components_is_as_the_program_has_it(self):
        compared = 0
        for stage, parameters in STAGES.items():
            for dtype in ("float16", "float32"):
                for components in (3, 4):
                    with self.subTest(stage=stage, dtype=dtype, components=components):
                        rgb = night(37, 53, components, dtype)
                        before = rgb.tobytes()
                        made = scotopic.apply(rgb, **parameters)
                        self.assert_same(made, program.apply(rgb, **parameters))
                        self.assertEqual(rgb.tobytes(), before)
                        compared += made.size
        print(f"compared with the program: {len(STAGES)} settings, {compared} values, all bytes equal")

    def test_strides_change_nothing(self):
        for stage in ("pixel stages", "everything", "display, all effects"):
            for dtype in ("float16", "float32", "float64"):
                rgb = night(19, 31, 4, dtype)
                expected = scotopic.apply(rgb, **STAGES[stage])
                for name, view in strided(rgb).items():
                    with self.subTest(stage=stage, dtype=dtype, strides=name):
                        self.assert_same(scotopic.apply(view, **STAGES[stage]), expected)
                        out = strided(np.zeros_like(rgb))[name]
                        if out.flags.writeable:
                            self.assertIs(scotopic.apply(rgb, out=out, **STAGES[stage]), out)
                            self.assert_same(out, expected)

    def test_sizes_from_one_pixel_to_wider_than_a_piece_are_as_the_program_has_them(self):
        for shape in ((1, 1, 3), (1, 700, 3), (700, 1, 4), (3, 1030, 3), (130, 131, 4)):
            for stage in ("pixel stages", "everything"):
                with self.subTest(shape=shape, stage=stage):
                    rgb = night(*shape) if min(shape[:2]) > 2 else np.full(shape, 0.25, "float32")
                    self.assert_same(scotopic.apply(rgb, **STAGES[stage]), program.apply(rgb, **STAGES[stage]))

    def test_straight_alpha_is_a_tiff_of_straight_alpha(self):
        rgb = night(37, 53, 4)
        for stage in ("pixel stages", "everything"):
            made = scotopic.apply(rgb, alpha="straight", **STAGES[stage])
            expected = program.apply(rgb, straight=True, display="none", colorspace="Linear Rec.709 (sRGB)",
                                     **STAGES[stage])
            self.assert_same(made, expected)

    def test_frames_of_a_sequence_are_as_the_program_has_them(self):
        rgb, seen = np.full((33, 41, 3), 0.3, "float32"), set()
        parameters = dict(adaptation=0.0005, effects="all", ppd=30, adaptation_history="1000:600", fps=12)
        for frame in (0, 1, 24):
            made = scotopic.apply(rgb, frame=frame, **parameters)
            self.assert_same(made, program.apply(rgb, frame=frame, **parameters))
            seen.add(made.tobytes())
        self.assertEqual(len(seen), 3)
        stack = scotopic.apply(np.stack([rgb, rgb]), frame=0, **parameters)
        self.assertEqual({image.tobytes() for image in stack} - seen, set())

    def test_pixels_that_are_not_square_are_as_the_program_has_them(self):
        rgb = night(37, 53)
        parameters = dict(adaptation=0.01, acuity="global", ppd=20)
        self.assert_same(scotopic.apply(rgb, pixel_aspect=2.0, **parameters),
                         program.apply(rgb, aspect=2.0, **parameters))

    def test_doubles_are_computed_in_double_and_keep_their_digits_where_nothing_changes(self):
        rgb = night(37, 53).astype("float64") + 1e-12
        made = scotopic.apply(rgb, adaptation=0.01)
        expected = program.apply(rgb.astype("float32"), adaptation=0.01, precision="double")
        self.assert_same(made.astype("float32"), expected)
        day = scotopic.apply(rgb, adaptation=100)
        self.assert_same(day, rgb)
        self.assertTrue((rgb.astype("float32").astype("float64") != rgb).any())
        self.assert_same(scotopic.apply(rgb, adaptation=0.01, precision="float").astype("float32"),
                         program.apply(rgb.astype("float32"), adaptation=0.01))

    def test_doubles_beyond_float_are_infinite(self):
        rgb = np.array([[[1e300, -1e300, 1.0], [0.5, 0.5, 0.5]]])
        made = scotopic.apply(rgb, adaptation=0.01)
        self.assert_same(made[:, :1], rgb[:, :1])
        self.assertTrue((made[:, 1:] != rgb[:, 1:]).any())


if __name__ == "__main__":
    unittest.main()
