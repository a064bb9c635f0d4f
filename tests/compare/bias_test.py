# SPDX-License-Identifier: BSD-2-Clause
"""Bias is told from noise, that of the reference included."""
import unittest

import numpy as np

from compare.bias import gram, mean_signed, pair_mean, squared_bias, squared_distance

SHAPE = (12, 10, 3)


def noisy(rng: np.random.Generator, count: int, truth: np.ndarray, sigma: float = 1.0) -> list[np.ndarray]:
    return [(truth + rng.normal(0, sigma, SHAPE)).astype(np.float32) for _ in range(count)]


class SquaredBias(unittest.TestCase):
    def setUp(self):
        self.rng = np.random.default_rng(1)
        self.truth = self.rng.uniform(0.5, 2, SHAPE)

    def test_of_images_without_noise_is_exact(self):
        images = [np.full(SHAPE, v, np.float32) for v in (1.5, 1.5, 1.5)]
        found = squared_bias(images, [np.full(SHAPE, 1.0, np.float32)] * 3)
        self.assertAlmostEqual(found.value, 0.25, places=6)
        self.assertAlmostEqual(found.error, 0, places=6)

    def test_is_the_mean_over_pairs_of_slices(self):
        images, references = noisy(self.rng, 4, self.truth), noisy(self.rng, 3, self.truth)
        a, b = np.array(images, float), np.array(references, float)
        direct = ((a.mean(0) - b.mean(0))**2 - a.var(0, ddof=1) / 4 - b.var(0, ddof=1) / 3).mean()
        products = gram([*images, *references], self.truth)
        self.assertAlmostEqual(squared_distance(products, 4), direct, places=10)

    def test_pairs_leave_the_diagonal_out(self):
        self.assertEqual(pair_mean(np.array([[100.0, 2], [4, 100]])), 3)

    def test_without_bias_is_zero_within_its_error(self):
        z = [squared_bias(noisy(self.rng, 8, self.truth), noisy(self.rng, 8, self.truth, 0.5)).z() for _ in range(200)]
        self.assertLess(max(abs(v) for v in z), 5)
        # The jackknife is on the safe side where there is no bias.
        self.assertLess(np.std(z), 1.1)
        self.assertLess(abs(np.mean(z)) * np.sqrt(200), 5)

    def test_negative_control_a_bias_that_cancels_in_the_mean_is_found(self):
        pattern = np.indices(SHAPE).sum(axis=0) % 2 - 0.5
        images, references = noisy(self.rng, 16, self.truth + pattern, 0.5), noisy(self.rng, 16, self.truth, 0.5)
        found = squared_bias(images, references)
        self.assertGreater(found.z(), 5)
        self.assertLess(abs(found.value - 0.25), 5 * found.error)
        self.assertLess(abs(mean_signed(images, references).z()), 5)

    def test_a_reference_of_one_image_counts_with_its_noise(self):
        found = squared_bias(noisy(self.rng, 16, self.truth, 0.1), noisy(self.rng, 1, self.truth, 1.0))
        self.assertAlmostEqual(found.value, 1, delta=0.4)


class MeanSigned(unittest.TestCase):
    def test_has_the_error_of_both(self):
        rng = np.random.default_rng(2)
        z = []
        for _ in range(200):
            found = mean_signed(noisy(rng, 6, np.ones(SHAPE)), noisy(rng, 6, np.ones(SHAPE)))
            self.assertLess(abs(found.value), 1)
            z.append(found.value / np.sqrt(2 / 6 / np.prod(SHAPE)))
        self.assertLess(abs(np.var(z) - 1), 5 * np.sqrt(2 / 200))

    def test_finds_a_difference(self):
        rng = np.random.default_rng(3)
        found = mean_signed(noisy(rng, 6, np.full(SHAPE, 1.5)), noisy(rng, 6, np.ones(SHAPE)))
        self.assertLess(abs(found.value - 0.5), 5 * found.error)
        self.assertGreater(found.z(), 5)


if __name__ == "__main__":
    unittest.main()
