"""Shapes, places, threads: what goes in comes out as it lay, and nothing else is touched."""
import copy
import pickle
import threading
import unittest

import numpy as np
import OpenImageIO as oiio

import scotopic
from scenes import STAGES, night


class Arrays(unittest.TestCase):
    def test_a_stack_is_one_image_after_the_other(self):
        stack = np.stack([[night(9, 11, seed=10 * i + j) for j in range(3)] for i in range(2)])
        made = scotopic.apply(stack, **STAGES["everything"])
        self.assertEqual(made.shape, stack.shape)
        for i, j in np.ndindex(2, 3):
            self.assertEqual(made[i, j].tobytes(), scotopic.apply(stack[i, j], **STAGES["everything"]).tobytes())

    def test_a_colour_and_a_row_of_colours_are_an_image(self):
        rows = night(4, 9)
        image = scotopic.apply(rows, adaptation=0.01)
        self.assertEqual(scotopic.apply(rows[1], adaptation=0.01).tobytes(), image[1].tobytes())
        self.assertEqual(scotopic.apply(rows[1, 2], adaptation=0.01).tobytes(), image[1, 2].tobytes())
        self.assertEqual(scotopic.apply([0.1, 0.1, 0.1], adaptation=0.01).dtype, np.float64)

    def test_no_pixels_give_no_pixels(self):
        for shape in ((0, 3), (0, 5, 4), (5, 0, 3), (0, 4, 4, 3)):
            self.assertEqual(scotopic.apply(np.zeros(shape, "float32"), adaptation=0.01).shape, shape)

    def test_an_image_may_be_changed_in_its_place(self):
        for stage, parameters in STAGES.items():
            for dtype in ("float32", "float64"):
                rgb = night(33, 41, 4, dtype)
                expected = scotopic.apply(rgb, **parameters)
                self.assertIs(scotopic.apply(rgb, out=rgb, **parameters), rgb)
                self.assertEqual(rgb.tobytes(), expected.tobytes(), stage)

    def test_an_output_that_overlaps_the_input_gets_the_same(self):
        parameters = STAGES["everything"]
        room = np.zeros((50, 41, 3), "float32")
        rgb = night(33, 41)
        expected = scotopic.apply(rgb, **parameters)
        for first, second in ((slice(0, 33), slice(5, 38)), (slice(0, 33), slice(32, None, -1))):
            room[first] = rgb
            scotopic.apply(room[first], out=room[second], **parameters)
            self.assertEqual(np.ascontiguousarray(room[second]).tobytes(), expected.tobytes())

    def test_threads_of_python_run_at_once_and_agree(self):
        moon = scotopic.Operator(**STAGES["everything"])
        rgb = night(65, 90)
        expected, made = moon.apply(rgb).tobytes(), [None] * 8

        def work(i):
            made[i] = moon.apply(rgb).tobytes()

        threads = [threading.Thread(target=work, args=(i,)) for i in range(len(made))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(made, [expected] * len(made))

    def test_one_thread_gives_the_same_bytes(self):
        rgb = night(65, 90)
        expected = scotopic.apply(rgb, **STAGES["everything"]).tobytes()
        try:
            scotopic.set_threads(1)
            self.assertEqual(scotopic.apply(rgb, **STAGES["everything"]).tobytes(), expected)
        finally:
            scotopic.set_threads(0)

    def test_python_goes_on_while_pixels_are_computed(self):
        big, ticks, done = np.full((1500, 1500, 3), 0.01, "float32"), [], threading.Event()

        def tick():
            while not done.wait(0.001):
                ticks.append(1)

        clock = threading.Thread(target=tick)
        clock.start()
        scotopic.apply(big, adaptation=0.01, acuity="global", ppd=20)
        done.set()
        clock.join()
        self.assertGreater(len(ticks), 3)

    def test_an_image_buffer_comes_back_as_one(self):
        pixels = night(13, 17)
        buffer = oiio.ImageBuf(oiio.ImageSpec(17, 13, 3, "float"))
        buffer.set_pixels(buffer.roi, pixels)
        made = scotopic.apply(buffer, adaptation=0.01)
        self.assertIsInstance(made, oiio.ImageBuf)
        self.assertEqual(made.get_pixels("float").tobytes(), scotopic.apply(pixels, adaptation=0.01).tobytes())

    def test_an_image_buffer_says_itself_whether_its_alpha_is_straight_and_how_wide_pixels_are(self):
        pixels = night(13, 17, 4)
        pixels[..., 3] = 0.25
        spec = oiio.ImageSpec(17, 13, 4, "float")
        spec.attribute("oiio:UnassociatedAlpha", 1)
        spec.attribute("PixelAspectRatio", 2.0)
        buffer = oiio.ImageBuf(spec)
        buffer.set_pixels(buffer.roi, pixels)
        asked = dict(adaptation=0.01, ppd=20, detail="bilateral")
        made = scotopic.apply(buffer, **asked).get_pixels("float")
        straight = scotopic.apply(pixels, alpha="straight", pixel_aspect=2, **asked)
        self.assertEqual(made.tobytes(), straight.tobytes())
        for other in (dict(pixel_aspect=2), dict(alpha="straight")):
            self.assertNotEqual(made.tobytes(), scotopic.apply(pixels, **other, **asked).tobytes())
        told = scotopic.apply(buffer, alpha="premultiplied", pixel_aspect=1, **asked).get_pixels("float")
        self.assertEqual(told.tobytes(), scotopic.apply(pixels, **asked).tobytes())


class Operators(unittest.TestCase):
    def test_equal_parameters_are_equal_operators(self):
        one, same = scotopic.Operator(adaptation=0.01, ppd=20), scotopic.Operator(ppd=20, adaptation=0.01)
        self.assertEqual(one, same)
        self.assertEqual(len({one, same, scotopic.Operator(adaptation=0.02)}), 2)
        self.assertEqual(repr(one), "Operator(adaptation='0.01', ppd='20')")
        with self.assertRaises(AttributeError):
            one.strength = 1

    def test_an_operator_can_be_sent_to_another_process(self):
        one = scotopic.Operator(adaptation=0.01, strength=0.5)
        rgb = night(5, 6)
        for other in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one)):
            self.assertEqual(other, one)
            self.assertEqual(other.apply(rgb).tobytes(), one.apply(rgb).tobytes())

    def test_what_is_assumed_is_logged(self):
        with self.assertLogs("scotopic", "INFO") as log:
            scotopic.apply(night(5, 6), adaptation=0.01)
        self.assertIn("adaptation 0.01 cd/m2 (--adaptation)", "\n".join(log.output))


if __name__ == "__main__":
    unittest.main()
