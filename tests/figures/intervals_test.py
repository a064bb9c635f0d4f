# SPDX-License-Identifier: BSD-2-Clause
"""Intervals of medians cover them, also of laws without a mean, where those of means do not."""
import math
import unittest

import numpy as np

from figurekit.intervals import Interval, ratio_of_medians, slope_of_medians


class MedianTest(unittest.TestCase):
    def test_order_statistics_of_tables(self):
        # The largest k with 2 Pr{fewer than k of n below the median} <= 5 %: 4 of 16, 24 of 64.
        self.assertEqual(Interval.median([float(v) for v in range(16)]), Interval(7.5, 3, 12))
        self.assertEqual(Interval.median([float(v) for v in range(64)]), Interval(31.5, 23, 40))
        self.assertEqual(Interval.median([3.0, 1.0, 2.0]), Interval(2, 1, 3))

    def test_the_interval_covers_the_median_of_a_law_without_a_mean(self):
        rng, runs = np.random.default_rng(7), 4000
        covered = sum(found.low <= 0 <= found.high for found in (Interval.median(list(rng.standard_cauchy(32))) for _ in range(runs)))
        exact = 1 - 2 * sum(math.comb(32, k) for k in range(10)) / 2**32
        self.assertLess(abs(covered / runs - exact), 5 * math.sqrt(exact * (1 - exact) / runs))
        self.assertGreater(exact, 0.95)

    def test_means_of_that_law_do_not_settle_and_medians_do(self):
        rng = np.random.default_rng(8)
        few, many = (rng.standard_cauchy((2000, n)) for n in (16, 256))

        def spread(values: np.ndarray) -> float:
            return float(np.subtract(*np.quantile(values, (0.75, 0.25))))
        self.assertAlmostEqual(spread(many.mean(axis=1)) / spread(few.mean(axis=1)), 1, delta=0.2)
        self.assertAlmostEqual(spread(np.median(many, axis=1)) / spread(np.median(few, axis=1)), 1 / 4, delta=0.05)


class BootstrapTest(unittest.TestCase):
    def test_the_slope_of_a_power_law_without_noise_is_its_exponent(self):
        costs = [np.full(9, float(n)) for n in (1, 4, 16)]
        found = slope_of_medians(costs, [3 * c**-0.25 for c in costs])
        for value in (found.value, found.low, found.high):
            self.assertAlmostEqual(value, -0.25)

    def test_its_interval_covers_the_exponent_as_often_as_it_says(self):
        rng, runs, covered, width = np.random.default_rng(9), 60, 0, 0.0
        costs = [np.full(32, float(n)) for n in (1, 4, 16, 64)]
        for _ in range(runs):
            found = slope_of_medians(costs, [np.abs(rng.standard_cauchy(32)) * c**-0.5 for c in costs])
            covered += found.low <= -0.5 <= found.high
            width += (found.high - found.low) / runs
        self.assertGreater(covered, runs * 0.85)  # of 95 % so few have a chance of 1e-4
        self.assertLess(width, 0.5)

    def test_a_ratio_of_equal_samples_is_one_and_of_scaled_ones_the_scale(self):
        values = list(np.random.default_rng(10).exponential(1, 64))
        self.assertEqual(ratio_of_medians(values, values).value, 1)
        found = ratio_of_medians([7 * v for v in values], values)
        self.assertAlmostEqual(found.value, 7)
        self.assertTrue(1 < found.low < 7 < found.high)
