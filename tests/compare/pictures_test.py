# SPDX-License-Identifier: BSD-2-Clause
"""Images are read as they were written, and averaged by weight."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

from compare.pictures import read_pfm, weighted_mean, write_pfm
from compare.problems import CaseError


class Pfm(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "a.pfm"

    def test_round_trip(self):
        image = np.random.default_rng(1).normal(size=(5, 7, 3)).astype(np.float32)
        write_pfm(self.path, image)
        np.testing.assert_array_equal(read_pfm(self.path), image)

    def test_rows_begin_at_the_bottom_and_bytes_may_be_swapped(self):
        self.path.write_bytes(b"Pf\n1 2\n1.0\n" + np.array([1, 2], ">f4").tobytes())
        np.testing.assert_array_equal(read_pfm(self.path)[:, 0, :], [[2, 2, 2], [1, 1, 1]])

    def test_values_that_look_like_space_are_values(self):
        values = np.frombuffer(b"\n \t\n" * 3, "<f4")
        self.path.write_bytes(b"PF\n1 1\n-1.0\n" + values.tobytes())
        np.testing.assert_array_equal(read_pfm(self.path)[0, 0], values)

    def test_other_files_are_refused(self):
        for data in (b"", b"P6\n1 1\n255\n...", b"PF\n2 2\n-1.0\n1234", b"PF 1 1"):
            self.path.write_bytes(data)
            with self.assertRaises(CaseError):
                read_pfm(self.path)


class WeightedMean(unittest.TestCase):
    def test_weighs_by_samples(self):
        images = [np.full((1, 1, 3), v, np.float32) for v in (1, 4)]
        np.testing.assert_array_equal(weighted_mean(images, [3, 1]), np.full((1, 1, 3), 1.75))

    def test_of_one_image_is_that_image(self):
        image = np.random.default_rng(1).normal(size=(2, 2, 3)).astype(np.float32)
        np.testing.assert_allclose(weighted_mean([image], [7]), image, rtol=1e-15)

    def test_needs_a_weight_for_each_image(self):
        with self.assertRaises(ValueError):
            weighted_mean([np.ones((1, 1, 3))], [1, 2])
        with self.assertRaises(ValueError):
            weighted_mean([], [])


if __name__ == "__main__":
    unittest.main()
