# SPDX-License-Identifier: BSD-2-Clause
"""Printed numbers are as exact as their digits."""
import math
import unittest

from figurekit.printed import disagreement, last_digit


class PrintedTest(unittest.TestCase):
    def test_digits_tell_how_exact_a_number_is(self):
        self.assertAlmostEqual(last_digit("3.49e-2"), 1e-4)
        self.assertAlmostEqual(last_digit(".105"), 1e-3)
        self.assertAlmostEqual(last_digit("247"), 1)

    def test_a_number_agrees_within_a_digit_and_four_standard_errors(self):
        self.assertLessEqual(disagreement("1.25", 1.26), 1)
        self.assertGreater(disagreement("1.25", 1.261), 1)
        self.assertLessEqual(disagreement("1.25", 1.299, 0.01), 1)
        self.assertGreater(disagreement("1.25", 1.301, 0.01), 1)
        self.assertLessEqual(disagreement("1.25", 1.299, 0, 0.01), 1)

    def test_what_is_no_number_agrees_with_nothing(self):
        self.assertEqual(disagreement("1.25", math.nan), math.inf)
