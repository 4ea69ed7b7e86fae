"""Light without an image: against values of the literature, and against sums worked out here."""
import unittest

import numpy as np

import scotopic

class Photometry(unittest.TestCase):
    def test_d65_has_the_rods_signal_it_is_defined_by(self):
        nm, d65 = scotopic.illuminant("d65")
        signals = scotopic.lmsr(d65, nm)
        self.assertAlmostEqual(signals[3] / (signals[0] + signals[1]), 0.4986, 3)

    def test_sp_ratios_of_spectra_are_those_of_the_names(self):
        for name, ratio, _ in scotopic.illuminants():
            photopic, scotopic_ = scotopic.luminances(scotopic.illuminant(name)[1], scotopic.illuminant(name)[0])
            self.assertLess(abs(scotopic_ / photopic / ratio - 1), 0.01, name)  # the moon is daylight of 4490 K

    def test_signals_add_up_and_scale_over_any_axes(self):
        nm = np.arange(400, 701, 10.0)
        spectra = np.random.default_rng(3).uniform(0, 1, (4, 5, nm.size))
        signals = scotopic.lmsr(spectra, nm)
        self.assertEqual(signals.shape, (4, 5, 4))
        one_by_one = np.eye(nm.size)
        by_bands = np.einsum("ijb,bs->ijs", spectra, scotopic.lmsr(one_by_one, nm))
        np.testing.assert_allclose(signals, by_bands, rtol=1e-13)
        self.assertTrue((scotopic.lmsr(spectra, nm, sampling="point") != signals).any())

    def test_a_watt_at_555_nm_has_683_lumens(self):
        nm = np.arange(380, 781, 1.0)
        line = np.where(nm == 555, 1.0, 0.0)
        photopic, _ = scotopic.luminances(line, nm, sampling="point")
        self.assertAlmostEqual(photopic / 683.002, 1, 3)

    def test_mesopic_luminance_is_the_fixed_point_of_the_standard(self):
        photopic, ratio = np.meshgrid(np.logspace(-4, 2, 25), [0.25, 0.65, 1.0, 1.72, 2.4648, 4.0])
        m, luminance = scotopic.mes2(photopic, ratio)
        c = 683 / 1699  # CIE 191:2010: Lmes by m, and m by Lmes, held to 0 ... 1
        np.testing.assert_allclose(luminance, (m + (1 - m) * c * ratio) / (m + (1 - m) * c) * photopic, rtol=1e-14)
        np.testing.assert_allclose(m, np.clip(0.767 + 0.3334 * np.log10(luminance), 0, 1), atol=1e-12)
        self.assertGreater(((m > 0) & (m < 1)).mean(), 0.3)

    def test_a_light_of_the_standards_ratio_keeps_its_luminance_by_day(self):
        found = scotopic.mes2([10.0, 100.0], 1.0)
        np.testing.assert_array_equal(found.luminance, [10.0, 100.0])
        np.testing.assert_array_equal(found.coefficient, [1.0, 1.0])

    def test_pupil_and_trolands_agree_and_shrink(self):
        light = np.logspace(-4, 4, 50)
        diameter = scotopic.pupil(light)
        self.assertTrue((np.diff(diameter) < 0).all())
        np.testing.assert_allclose(scotopic.trolands(light), np.pi / 4 * diameter**2, rtol=1e-14)
        self.assertAlmostEqual(scotopic.trolands(0.01), 39.76, 2)

    def test_rods_see_less_light_than_cones_only_at_night(self):
        found = scotopic.thresholds(np.logspace(-5, 3, 9))
        self.assertTrue((np.diff(found.both) > 0).all())
        np.testing.assert_array_equal(found.both, np.minimum(found.rods, found.cones))
        self.assertTrue(found.rods[0] < found.cones[0] and found.rods[-1] > found.cones[-1])

    def test_ten_minutes_of_daylight_are_remembered_as_the_model_says(self):
        # Scene exposure after 10 min at 1000 cd/m2 for a scene of 0.01: 1, 10, 60 s, 5 min (docs/model.md).
        track = scotopic.adaptation_track([0.01] * 301, 1.0, history="1000:600")
        for second, expected in ((1, 0.52149), (10, 0.60667), (60, 0.79388), (300, 0.83716)):
            self.assertAlmostEqual(track["exposure"][second], expected, 4)
        adapted = scotopic.adaptation_track([0.01] * 3, 1 / 24)
        np.testing.assert_array_equal(adapted["exposure"], 1)
        by_pairs = scotopic.adaptation_track([0.01] * 301, 1.0, history=[(1000, 600)])
        np.testing.assert_array_equal(by_pairs, track)

    def test_what_is_no_light_is_refused(self):
        nm = [400.0, 500.0, 600.0]
        for call in (lambda: scotopic.mes2(-1.0), lambda: scotopic.mes2(1.0, 0.0), lambda: scotopic.pupil(np.nan),
                     lambda: scotopic.lmsr([1.0, 2.0], nm), lambda: scotopic.lmsr([1.0, 2.0, 3.0], nm[::-1]),
                     lambda: scotopic.lmsr([1.0, 2.0, 3.0], nm, sampling="mean"),
                     lambda: scotopic.illuminant("neon"), lambda: scotopic.adaptation_track([], 1.0),
                     lambda: scotopic.adaptation_track([1.0], 0.0), lambda: scotopic.thresholds(-1.0),
                     lambda: scotopic.adaptation_track([1.0], 1.0, history="noon")):
            with self.assertRaises(ValueError):
                call()


if __name__ == "__main__":
    unittest.main()
