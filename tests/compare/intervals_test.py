# SPDX-License-Identifier: BSD-2-Clause
"""Intervals hold the truth as often as they say, and ties are ties."""
import math
import unittest

import numpy as np

from compare.intervals import Estimate, Work, log_ratio, mean_estimate, student_quantile, tied_with_best, welch

MOST_Z = 5.0


def coverage_z(hits: int, runs: int, level: float = 0.95) -> float:
    return (hits / runs - level) / math.sqrt(level * (1 - level) / runs)


class StudentQuantile(unittest.TestCase):
    def test_is_that_of_the_tables(self):
        for freedom, level, expected in ((1, 0.95, 12.706204736), (3, 0.95, 3.182446305), (10, 0.95, 2.228138852), (30, 0.95, 2.042272456),
                                         (5, 0.99, 4.032142984), (2, 0.5, 0.816496581)):
            self.assertAlmostEqual(student_quantile(freedom, level), expected, places=7)

    def test_tends_to_the_normal_distribution(self):
        self.assertAlmostEqual(student_quantile(1e7), 1.959964, places=5)

    def test_is_infinite_without_freedom(self):
        self.assertEqual(student_quantile(0), math.inf)


class MeanEstimate(unittest.TestCase):
    def test_of_known_values(self):
        found = mean_estimate([1.0, 2.0, 3.0, 6.0])
        self.assertEqual(found.value, 3)
        self.assertAlmostEqual(found.error, math.sqrt(14 / 3 / 4))
        self.assertEqual(found.freedom, 3)

    def test_of_one_value_knows_no_error(self):
        self.assertEqual(mean_estimate([4.0]).half_width(), math.inf)

    def test_holds_the_mean_as_often_as_it_says(self):
        rng = np.random.default_rng(1)
        runs = 2000
        hits = sum(e.low() < 7 < e.high() for e in (mean_estimate(rng.normal(7, 2, 4)) for _ in range(runs)))
        self.assertLess(abs(coverage_z(hits, runs)), MOST_Z, hits)

    def test_negative_control_a_wrong_mean_is_missed_more_often(self):
        rng = np.random.default_rng(1)
        runs = 2000
        hits = sum(e.low() < 8 < e.high() for e in (mean_estimate(rng.normal(7, 2, 4)) for _ in range(runs)))
        self.assertGreater(abs(coverage_z(hits, runs)), MOST_Z, hits)


class Welch(unittest.TestCase):
    def test_adds_squared_errors(self):
        found = welch(Estimate(5, 3, 10), Estimate(2, 4, 10))
        self.assertEqual((found.value, found.error), (3, 5))
        self.assertAlmostEqual(found.freedom, 625 / (81 / 10 + 256 / 10))

    def test_of_a_certain_value_has_the_freedom_of_the_other(self):
        self.assertEqual(welch(Estimate(5, 3, 10), Estimate(2, 0, 1)).freedom, 10)


def random_work(rng: np.random.Generator, variance: float, cost: float, pairs: int, drift: np.ndarray | float = 1.0, freedom: int = 20) -> Work:
    """Chi-squared variances, costs that scatter by 5 %."""
    return Work(variance * rng.chisquare(freedom, pairs) / freedom, cost * drift * rng.normal(1, 0.05, pairs))


class WorkOfPairs(unittest.TestCase):
    def test_is_variance_times_cost(self):
        self.assertEqual(Work(np.array([1.0, 3.0]), np.array([5.0, 7.0])).value(), 12)

    def test_interval_holds_the_truth_as_often_as_it_says(self):
        rng = np.random.default_rng(2)
        runs = 1000
        hits = sum(low < 6 < high for low, high in (random_work(rng, 2, 3, 40).interval() for _ in range(runs)))
        self.assertLess(abs(coverage_z(hits, runs)), MOST_Z, hits)

    def test_without_noise_is_zero_and_certain(self):
        work = Work(np.zeros(4), np.ones(4))
        self.assertEqual((work.value(), work.interval()), (0, (0, 0)))

    def test_tells_when_one_pair_is_all(self):
        self.assertGreater(Work(np.array([1.0, 1, 98]), np.ones(3)).tail_share(), 0.9)
        self.assertAlmostEqual(Work(np.ones(4), np.ones(4)).tail_share(), 0.25)

    def test_drift_of_the_machine_cancels_in_ratios(self):
        rng = np.random.default_rng(3)
        drift = np.linspace(1, 3, 20)
        a, b = random_work(rng, 1, 1, 20, drift, 2000), random_work(rng, 1, 1, 20, drift, 2000)
        paired = log_ratio(a, b)
        apart = welch(a.log(), b.log())
        self.assertLess(paired.error, 0.5 * apart.error)
        self.assertLess(abs(paired.value), MOST_Z * paired.error)

    def test_ratio_of_unequal_counts_is_unpaired(self):
        rng = np.random.default_rng(4)
        found = log_ratio(random_work(rng, 2, 1, 50), random_work(rng, 1, 1, 30))
        self.assertLess(abs(found.value - math.log(2)), MOST_Z * found.error)
        self.assertGreater(found.freedom, 49)


class Ties(unittest.TestCase):
    def rejections(self, variances: list[float], runs: int) -> int:
        """Runs in which some setting was told from the best."""
        rng = np.random.default_rng(5)
        return sum(not all(tied_with_best([random_work(rng, v, 1, 16) for v in variances])[1]) for _ in range(runs))

    def test_equal_settings_are_rarely_told_apart(self):
        # The best of five is the smallest by chance, so that differences from it are larger than of two given ones.
        self.assertLess(self.rejections([1, 1, 1, 1, 1], 400), 0.05 * 400)

    def test_negative_control_a_setting_twice_as_bad_is_no_tie(self):
        self.assertEqual(self.rejections([1, 2], 100), 100)

    def test_the_best_is_its_own_tie(self):
        best, ties = tied_with_best([Work(np.array([4.0, 4.1]), np.ones(2)), Work(np.array([1.0, 1.1]), np.ones(2))])
        self.assertEqual((best, ties[1]), (1, True))

    def test_settings_without_noise_tie(self):
        certain = Work(np.zeros(4), np.ones(4))
        noisy = Work(np.array([1.0, 1.1, 0.9, 1]), np.ones(4))
        self.assertEqual(tied_with_best([noisy, certain, Work(np.zeros(4), 2 * np.ones(4))]), (1, [False, True, True]))


if __name__ == "__main__":
    unittest.main()
