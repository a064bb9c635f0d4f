# SPDX-License-Identifier: BSD-2-Clause
"""Exact moments against ones that are known otherwise."""
import math
import unittest

import numpy as np

from figurekit.closed_forms import (Roulette, bk_variance, certain_levels, cmf_moments, cmf_reach, fitted_lookups, poisson, ratio_variance, teeth, tracking_variance,
                                    ubk_variance)
from figurekit.known import rows_of
from figurekit.printed import disagreement


class ClosedFormsTest(unittest.TestCase):
    def test_poisson_is_a_law(self):
        law = poisson(7, 80)
        self.assertAlmostEqual(law.sum(), 1, places=12)
        self.assertAlmostEqual((law * np.arange(81)).sum(), 7, places=10)

    def test_ratio_tracking_has_its_variance_under_proportional_controls(self):
        self.assertAlmostEqual(tracking_variance(lambda x: np.full_like(x, 2.0), 1, 3), ratio_variance(2, 3), places=12)

    def test_ratio_tracking_that_meets_its_lower_control_has_none(self):
        self.assertAlmostEqual(tracking_variance(lambda x: np.full_like(x, 2.0), 1, 3, 2), 0, places=14)

    def test_p_series_cmf_has_the_moments_of_its_prefix_sums(self):
        # A constant medium of T = 0.5 under a control of tau / 0.475: 2.5e-10 at 6.25 look-ups, by an independent calculation.
        second, lookups = cmf_moments(math.log(2) / 0.475, 0.525, 0.525**2)
        self.assertAlmostEqual(second - 0.25, 2.5e-10, delta=1e-11)
        self.assertAlmostEqual(lookups, 6.25, delta=0.01)
        rng, control = np.random.default_rng(5), 1.7
        found = []
        for _ in range(20_000):  # factors of 0.2 and 0.9
            total, term, k = 1.0, 1.0, 0
            while True:
                k += 1
                if k > 6 and rng.random() > min(1, control / k):  # Pr{Poisson(1.7) <= 4} < 0.99 <= Pr{... <= 5}
                    break
                term *= rng.choice((0.2, 0.9)) * control / k / (min(1, control / k) if k > 6 else 1)
                total += term
            found.append(total * math.exp(-control))
        second, _ = cmf_moments(control, 0.55, (0.04 + 0.81) / 2)
        squares = np.square(found)
        self.assertLess(abs(squares.mean() - second), 4 * squares.std() / math.sqrt(len(squares)))

    def test_p_series_cmf_evaluates_the_levels_of_its_table(self):
        for row in rows_of("level_counts"):
            control = float(row["control"])
            for law, is_printed in (("printed", True), ("code", False)):
                self.assertEqual(certain_levels(control, is_printed), int(row[f"certain_{law}"]), control)
                self.assertLessEqual(disagreement(row[f"lookups_{law}"], cmf_reach(control, is_printed)[1:].sum()), 1, control)
            self.assertEqual(fitted_lookups(control), int(row["fit"]), control)

    def test_combs_have_the_teeth_of_their_tables(self):
        for row in rows_of("canonical_lines"):
            self.assertEqual(teeth(-math.log(float(row["T"])) / float(row["ratio"]), Roulette(2, 0.9)), int(row["teeth"]), row)

    def test_the_roulette_has_its_mean_number_of_terms(self):
        self.assertAlmostEqual(Roulette(1).mean_orders(), math.e - 1, places=12)
        self.assertAlmostEqual(Roulette(2, 0.9).mean_orders(), 0.1 * (2 + (math.exp(2) - 5) / 2), places=12)

    def test_one_factor_more_than_needed_has_no_variance_at_the_true_pivot(self):
        for variance in (bk_variance, ubk_variance):
            self.assertAlmostEqual(variance(Roulette(2), -1.5, 0, 0, 1.5), 0, places=14)

    def test_symmetrisation_does_nothing_to_factors_that_do_not_vary(self):
        for delta in (-1.0, 0.3, 1.0):
            self.assertAlmostEqual(bk_variance(Roulette(2), -1 - delta, delta, 0, 1) / ubk_variance(Roulette(2), -1 - delta, delta, 0, 1), 1, places=9)

    def test_moments_are_those_of_a_simulation(self):
        rng, roulette = np.random.default_rng(11), Roulette(1)
        weights, pivot, found = roulette.weights(), -1.2, {bk_variance: [], ubk_variance: []}
        for _ in range(20_000):
            u, n = rng.random(), 0
            while roulette.reach[n + 1] > u:
                n += 1
            factors = 0.2 + 0.5 * rng.standard_normal(n)
            means = [1.0] + [0.0] * n  # elementary symmetric means
            for i, x in enumerate(factors, 1):
                for k in range(min(i, n), 0, -1):
                    means[k] += k / i * (means[k - 1] * x - means[k])
            products = np.concatenate([[1.0], np.cumprod(factors)])
            found[bk_variance].append(math.exp(pivot) * float(weights[:n + 1] @ products))
            found[ubk_variance].append(math.exp(pivot) * float(weights[:n + 1] @ np.array(means)))
        for variance, values in found.items():
            squares = (np.array(values) - math.exp(-1))**2
            self.assertLess(abs(squares.mean() - variance(roulette, pivot, 0.2, 0.25, 1)), 5 * squares.std() / math.sqrt(len(squares)))
            self.assertLess(abs(np.mean(values) - math.exp(-1)), 5 * np.std(values) / math.sqrt(len(values)))

    def test_known_tables_are_met(self):
        roulette = Roulette(2)
        for row in rows_of("fluctuating_media"):
            spread, delta = float(row["s2"]), float(row["delta"])
            for key, variance in (("bk", bk_variance), ("ubk", ubk_variance)):
                self.assertLessEqual(disagreement(row[key], variance(roulette, -1 - delta, delta, spread, 1)), 1, (row, key))
