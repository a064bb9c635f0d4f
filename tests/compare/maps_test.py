# SPDX-License-Identifier: BSD-2-Clause
"""Maps of images whose noise and bias are known."""
import unittest

import numpy as np

from compare.maps import make_maps, worst_pixels
from compare.metrics import Reference
from compare.programs import Cost
from compare.slices import Slice

SHAPE = (6, 8, 3)


class PixelMaps(unittest.TestCase):
    def setUp(self):
        self.rng = np.random.default_rng(1)
        self.truth = np.ones(SHAPE)

    def test_of_known_noise_and_bias(self):
        sigma = np.ones(SHAPE)
        sigma[0] = 3
        bias = np.zeros(SHAPE)
        bias[:, 0] = 2
        images = list(self.truth + bias + sigma * self.rng.normal(size=(4000, *SHAPE)))
        merged = [np.mean(images[i:i + 1000], axis=0) for i in range(0, 4000, 1000)]
        maps = make_maps(images, merged, Reference(self.truth, None), 1000, 0.5, np.zeros(SHAPE[:2]))
        np.testing.assert_allclose(maps.variance, sigma.mean(axis=2)**2 / 1000, rtol=5 * np.sqrt(2 / 12000))
        np.testing.assert_allclose(maps.work, maps.variance * 1000 * 0.5)
        np.testing.assert_allclose(maps.bias, bias.mean(axis=2), atol=5 * 3 / np.sqrt(12000))
        np.testing.assert_allclose(maps.error[:, 0], 2, atol=0.3)
        self.assertGreater(maps.bias_z[3, 0], 5)
        self.assertLess(np.abs(maps.bias_z[:, 1:]).max(), 5)

    def test_variance_of_two_slices_is_half_their_squared_difference(self):
        images = [self.truth, self.truth + 2]
        maps = make_maps(images, [self.truth + 1], Reference(self.truth, None), 2, 3.0, np.zeros(SHAPE[:2]))
        np.testing.assert_allclose(maps.variance, 1)
        np.testing.assert_allclose(maps.work, 6)
        np.testing.assert_allclose(maps.bias_z, 1)

    def test_worst_pixels_name_the_slice(self):
        images = [self.truth.copy() for _ in range(3)]
        images[2][4, 5] = 11
        images[1][1, 7] = 3
        slices = [Slice(10 + i, 4, Cost(1, 1, 0, None, None, 4), None) for i in range(3)]
        found = worst_pixels(images, slices, self.truth)
        self.assertEqual([(w.x, w.y, w.slice.seed) for w in found], [(5, 4, 12), (7, 1, 11)])
        self.assertAlmostEqual(found[0].share, 100 / 104)
        self.assertEqual((found[0].value, found[0].reference), ((11, 11, 11), (1, 1, 1)))


if __name__ == "__main__":
    unittest.main()
