# SPDX-License-Identifier: BSD-2-Clause
"""Exponents of debiased photon mapping, against sums over levels and photons that are drawn."""
import math
import unittest

import numpy as np

from figurekit.photon_series import CODE, PRINTED, Series, why_no_mean

PHOTONS = 60.0


def power(values: np.ndarray, x: np.ndarray) -> float:
    return float(np.diff(np.log(values))[0] / np.diff(np.log(x))[0])


def cone(radius: float, distance: np.ndarray) -> np.ndarray:
    return np.maximum(0, 1 - distance / radius) * 3 / (math.pi * radius * radius)


class SeriesTest(unittest.TestCase):
    def test_corrections_grow_by_level_as_their_exponent_says(self):
        levels = np.array([1e6, 1e9])
        for alpha in (0.5, 2 / 3, 0.8):
            for c in (0.3, CODE, 0.8, PRINTED):
                series = Series(c, alpha)
                sizes = series.size_of_correction(levels, PHOTONS)
                self.assertAlmostEqual(power(sizes, levels), series.noise_power(), places=5)
                self.assertAlmostEqual(power(sizes * series.probability(levels), levels), series.mean_power(), places=5)

    def test_probabilities_have_the_sum_one(self):
        self.assertAlmostEqual(float(Series(1).probability(np.arange(1, 100_001)).sum()), 1 - 100_001**(-1 / 3), places=10)

    def test_a_mean_needs_c_below_one_and_a_mean_cost_c_above_whatever_alpha(self):
        for alpha in (0.3, 2 / 3, 0.9):
            for c in (0.2, 0.999, 1.001, 2):
                self.assertEqual(Series(c, alpha).mean_power() < -1, c < 1)
                self.assertEqual(Series(c, alpha).photon_mean_power() < -1, c > 1)

    def test_the_size_of_a_correction_is_the_spread_of_drawn_ones(self):
        # Uniform photons in the first kernel, as many as Poisson's law has it: level 3 of alpha = 2/3.
        rng, runs, level, series = np.random.default_rng(3), 40_000, 3, Series(CODE)
        outer, inner = level**(-1 / 6), (level + 1)**(-1 / 6)
        mean = PHOTONS * (level + 1)**(1 - CODE * 2 / 3)
        counts = rng.poisson(mean, runs)
        distance = np.sqrt(rng.random(int(counts.sum())))
        weights = (cone(inner, distance) - cone(outer, distance)) * math.pi / mean
        found = np.add.reduceat(weights, np.concatenate(([0], np.cumsum(counts)[:-1]))) / (level**(-1 / 3) - (level + 1)**(-1 / 3))
        exact = float(series.size_of_correction(np.array([float(level)]), PHOTONS)[0])
        kurtosis = float(((found - found.mean())**4).mean() / found.var()**2)
        self.assertLess(abs(found.var() / exact**2 - 1), 5 * math.sqrt((kurtosis - 1) / runs))
        self.assertLess(abs(found.mean()), 5 * exact / math.sqrt(runs))

    def test_the_mean_size_is_the_sum_over_levels(self):
        levels = np.arange(1.0, 200_001)
        for c in (CODE, PRINTED):
            series = Series(c)
            exact = float((series.probability(levels) * series.size_of_correction(levels, PHOTONS)).sum())
            self.assertAlmostEqual(series.mean_size(200_000, PHOTONS) / exact, 1, places=6)

    def test_the_mean_size_grows_without_end_for_the_printed_c_and_settles_for_that_of_the_code(self):
        def growth(c: float) -> float:
            sizes = [Series(c).mean_size(most, PHOTONS) for most in (1e6, 1e9, 1e12)]
            return (sizes[2] - sizes[1]) / (sizes[1] - sizes[0])
        self.assertAlmostEqual(growth(PRINTED), 1, delta=0.01)  # as much for each three powers of ten
        self.assertAlmostEqual(growth(CODE), 10**(3 * (CODE - 1) / 3), delta=0.001)

    def test_errors_of_means_of_such_tails_fall_as_the_exponent_says(self):
        rng = np.random.default_rng(4)
        for c in (0.7, 1.2):
            series = Series(c)

            def typical(count: int) -> float:
                level = rng.random((4000, count))**-3.0
                return float(np.median(np.abs((rng.standard_normal(level.shape) * level**series.noise_power()).mean(axis=1))))
            self.assertAlmostEqual(math.log(typical(1024) / typical(64)) / math.log(16), series.error_power(), delta=0.05)

    def test_slopes_over_photons(self):
        self.assertAlmostEqual(Series(PRINTED).slope(), 0.001)
        self.assertAlmostEqual(Series(CODE).slope(), -0.5 / 2.002)
        self.assertAlmostEqual(Series(0.5).slope(), -1 / 4)
        self.assertAlmostEqual(Series(2 / 3).progressive_slope(), -1 / 5)
        self.assertTrue(all(Series(c / 100).slope() >= -1 / 4 for c in range(1, 200)))

    def test_the_reason_names_its_exponents(self):
        self.assertIn("n^-0.9997, which is infinite", why_no_mean(PRINTED))
