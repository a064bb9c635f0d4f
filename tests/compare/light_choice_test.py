# SPDX-License-Identifier: BSD-2-Clause
"""bench/light_choice.py as a whole, with the real renderer, and its numbers against a render that is twice as noisy."""
import csv
import io
import os
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PBRT = str(Path(os.environ["PBRT_MEDIA_BIN"]) / "pbrt")


class LightChoice(unittest.TestCase):
    def rows(self, *options):
        done = subprocess.run([sys.executable, str(ROOT / "bench" / "light_choice.py"), PBRT, "--rounds", "3", *options], capture_output=True, text=True,
                              timeout=200)
        self.assertEqual(done.returncode, 0, done.stderr)
        return list(csv.DictReader(io.StringIO(done.stdout)))

    def test_every_scene_is_measured_with_every_strategy(self):
        rows = self.rows("--scenes", "surfaces-10,fog-1", "--strategies", "power,tree", "--before", PBRT, "--spp", "1")
        self.assertEqual([(r["scene"], r["program"], r["strategy"]) for r in rows],
                         [(s, *p) for s in ("surfaces-10", "fog-1") for p in (("before", "power"), ("now", "power"), ("now", "tree"))])
        for row in rows:
            self.assertGreater(float(row["variance"]), 0)
        for before, now in ((rows[0], rows[1]), (rows[3], rows[4])):
            self.assertEqual(before["variance"], now["variance"], "the same program")
        # One light: nothing is chosen.
        self.assertEqual(rows[4]["variance"], rows[5]["variance"])

    def test_a_tree_of_many_lamps_beats_their_power(self):
        power, tree = self.rows("--scenes", "surfaces-1000", "--strategies", "power,tree", "--spp", "2")
        self.assertLess(float(tree["variance"]), 0.5 * float(power["variance"]))
        self.assertLess(abs(float(tree["mean"]) - float(power["mean"])), 0.2 * float(power["mean"]))
