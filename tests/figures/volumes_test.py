# SPDX-License-Identifier: BSD-2-Clause
"""What scripts make themselves: volumes, and meshes that close."""
import re
import unittest
from collections import Counter

import numpy as np

from figurekit import chess, volumes


class VolumesTest(unittest.TestCase):
    def test_volumes_are_densities_of_mean_one(self):
        for found in (volumes.smoke(), volumes.cloud()):
            self.assertEqual((found.shape, found.dtype), ((volumes.SIZE,) * 3, np.float32))
            self.assertGreaterEqual(float(found.min()), 0)
            self.assertLess(float(found.max()), 40)
        self.assertAlmostEqual(float(volumes.smoke().mean()), 1, delta=1e-4)
        self.assertEqual(float(np.abs(volumes.cloud()[0]).max()), 0)  # the box holds it
        np.testing.assert_array_equal(volumes.smoke(), volumes.smoke())


class ChessTest(unittest.TestCase):
    def meshes(self) -> list[tuple[np.ndarray, np.ndarray]]:
        found = re.findall(r'"integer indices" \[ ([^\]]*) \]\s+"point P" \[ ([^\]]*) \]', chess.game())
        return [(np.array(p.split(), float).reshape(-1, 3), np.array(i.split(), int).reshape(-1, 3)) for i, p in found]

    def test_every_mesh_closes_and_its_normals_are_outward(self):
        self.assertEqual(len(self.meshes()), chess.FIELDS**2 + len(chess.GAME))
        for points, faces in self.meshes():
            edges = Counter((int(f[k]), int(f[(k + 1) % 3])) for f in faces for k in range(3))
            self.assertEqual(set(edges.values()), {1})
            self.assertEqual({(b, a) for a, b in edges}, set(edges))
            a, b, c = (points[faces[:, k]] for k in range(3))
            self.assertGreater(float((np.cross(a, b) * c).sum() / 6), 0.01)  # the volume

    def test_no_two_boundaries_touch(self):
        boxes = [(p.min(axis=0), p.max(axis=0)) for p, _ in self.meshes()]
        for i, (low, high) in enumerate(boxes):
            for other_low, other_high in boxes[:i]:
                self.assertTrue((low > other_high + 0.005).any() or (other_low > high + 0.005).any())
