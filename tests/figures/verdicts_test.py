# SPDX-License-Identifier: BSD-2-Clause
"""A verdict needs all of the interval."""
import math
import unittest

from figurekit.intervals import Interval, ratio, ratio_of_means
from figurekit.verdicts import NOT_REPRODUCED, REPRODUCED, UNTESTED, judge


class VerdictsTest(unittest.TestCase):
    def test_all_of_the_interval_decides(self):
        self.assertEqual(judge("c", Interval(2, 1.5, 3), above=1).outcome, REPRODUCED)
        self.assertEqual(judge("c", Interval(2, 1.5, 3), above=3, why="so").outcome, NOT_REPRODUCED)
        self.assertEqual(judge("c", Interval(2, 1.5, 3), above=2).outcome, UNTESTED)
        self.assertEqual(judge("c", Interval(2, 1.5, 3), above=1, below=2.5).outcome, UNTESTED)
        self.assertEqual(judge("c", Interval(2, 1.5, 3), above=1, below=4).outcome, REPRODUCED)

    def test_a_failure_tells_why_and_a_success_does_not(self):
        self.assertEqual(judge("c", Interval.exact(2), above=3, why="so").why, "so")
        self.assertEqual(judge("c", Interval.exact(4), above=3, why="so").why, "")
        self.assertIn("cannot be tested", judge("c", Interval(2, 1, 3), above=2).line())

    def test_no_number_is_no_verdict(self):
        self.assertEqual(judge("c", Interval.exact(math.nan), above=3).outcome, UNTESTED)

    def test_a_ratio_has_the_interval_of_its_logarithm(self):
        found = ratio(2, 0.1, 1, 0.05)
        self.assertAlmostEqual(found.value, 2)
        self.assertAlmostEqual(math.log(found.high / 2), 1.96 * math.hypot(0.05, 0.05))
        self.assertAlmostEqual(found.high / 2, 2 / found.low)

    def test_a_ratio_of_nothing_known_tells_nothing(self):
        self.assertEqual(ratio(1, 0.1, 0, 0.1).high, math.inf)
        self.assertEqual(ratio(1, math.inf, 1, 0.1).low, 0)

    def test_a_ratio_of_few_values_is_wide(self):
        few, many = ratio_of_means([1, 1.2], [2, 2.4]), ratio_of_means([1, 1.2] * 10, [2, 2.4] * 10)
        self.assertAlmostEqual(few.value, 0.5)
        self.assertGreater(math.log(few.high / few.low), 3 * math.log(many.high / many.low))
