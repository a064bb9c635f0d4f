# SPDX-License-Identifier: BSD-2-Clause
"""Metrics of images small enough to reckon by hand."""
import unittest

import numpy as np

from compare.metrics import Reference, errors


def grey(*values: float) -> np.ndarray:
    return np.repeat(np.array(values, float)[None, :, None], 3, axis=2)


class Errors(unittest.TestCase):
    def test_by_hand(self):
        found = errors(grey(1, 3), Reference(grey(2, 1), None, epsilon=1))
        self.assertAlmostEqual(found["mse"], (1 + 4) / 2)
        self.assertAlmostEqual(found["relmse"], (1 / 5 + 4 / 2) / 2)
        self.assertAlmostEqual(found["relmse_robust"], 1 / 5)
        self.assertAlmostEqual(found["smape"], (1 / 1.5 + 2 / 2) / 2)
        self.assertAlmostEqual(found["mean_signed"], (-1 + 2) / 2)

    def test_of_equal_images_are_zero(self):
        self.assertEqual(set(errors(grey(0, 5), Reference(grey(0, 5), None)).values()), {0.0})

    def test_the_noise_of_the_reference_is_taken_out(self):
        rng = np.random.default_rng(1)
        truth = rng.uniform(1, 2, (64, 64, 3))
        image = truth + rng.normal(0, 0.1, truth.shape)
        noisy = truth + rng.normal(0, 0.2, truth.shape)
        found = errors(image, Reference(noisy, np.full(truth.shape, 0.04)))["mse"]
        # (a - b)^2 has the variance 2 (0.01 + 0.04)^2.
        deviation = np.sqrt(2 * 0.05**2 / truth.size)
        self.assertLess(abs(found - 0.01), 5 * deviation)
        self.assertGreater(abs(errors(image, Reference(noisy, None))["mse"] - 0.01), 5 * deviation)

    def test_robust_leaves_out_one_pixel_in_ten_thousand(self):
        reference = np.ones((100, 200, 3))
        image = reference.copy()
        image[3, 4] = image[50, 60] = 1e4
        self.assertEqual(errors(image, Reference(reference, None))["relmse_robust"], 0)
        image[70, 80] = 2
        self.assertGreater(errors(image, Reference(reference, None))["relmse_robust"], 0)


if __name__ == "__main__":
    unittest.main()
