# SPDX-License-Identifier: BSD-2-Clause
"""Slopes of power laws, and of errors that stop falling."""
import unittest

import numpy as np

from compare.slope import slope_estimate, slope_of

COSTS = [1.0, 2, 4, 8, 16, 32]


class Slope(unittest.TestCase):
    def test_of_a_power_law_is_its_exponent(self):
        self.assertAlmostEqual(slope_of(COSTS, [3 * c**-1.3 for c in COSTS]), -1.3)

    def test_needs_three_points(self):
        self.assertIsNone(slope_of([1, 2], [1, 0.5]))
        self.assertIsNone(slope_of([1, 1, 1], [1, 2, 3]))

    def test_leaves_out_what_has_no_logarithm(self):
        self.assertAlmostEqual(slope_of([*COSTS, 64, 0], [*[1 / c for c in COSTS], -0.01, 1]), -1)

    def test_of_noise_is_minus_one_within_its_interval(self):
        rng = np.random.default_rng(1)
        curves = []
        for _ in range(8):
            samples = rng.normal(0, 1, (4096, 32))
            curves.append((COSTS, [float((samples[:, :int(c)].mean(axis=1)**2).mean()) for c in COSTS]))
        found = slope_estimate(curves)
        self.assertLess(abs(found.value + 1), 5 * found.error)
        self.assertLess(found.error, 0.02)

    def test_negative_control_bias_makes_it_flatter(self):
        rng = np.random.default_rng(1)
        curves = []
        for _ in range(8):
            samples = rng.normal(0.3, 1, (4096, 32))
            curves.append((COSTS, [float((samples[:, :int(c)].mean(axis=1)**2).mean()) for c in COSTS]))
        found = slope_estimate(curves)
        self.assertGreater(found.value + 1, 5 * found.error)


if __name__ == "__main__":
    unittest.main()
