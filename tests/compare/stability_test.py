# SPDX-License-Identifier: BSD-2-Clause
"""Stiff and extreme media: docs/stability.md says what the renderer does, and how that is judged."""
import math
import os
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "bench"))
import stability  # noqa: E402

CSV = ROOT / "docs" / "stability.csv"


class Judging(unittest.TestCase):
    def test_mean_within_its_errors_is_ok_and_beyond_is_wrong(self):
        pixels = [.9, 1.1] * 50  # standard error .01
        self.assertEqual(stability.judged(pixels, 1.04, 0)[0], "ok")
        self.assertEqual(stability.judged(pixels, 1.06, 0)[0], "wrong")
        self.assertEqual(stability.judged(pixels, 1.06, .02)[0], "ok")

    def test_noise_and_what_is_no_number_are_told(self):
        self.assertEqual(stability.judged([0, 2] * 50, 1, 0)[0], "noisy")
        self.assertEqual(stability.judged([1, math.nan], 1, 0)[0], "broken")
        self.assertEqual(stability.judged([1, math.inf], 1, 0)[0], "broken")

    def test_h_function_is_that_of_the_tables(self):
        # Chandrasekhar 1960, table XI: 1.2513 at albedo 0.5, 2.9078 for the conservative one.
        self.assertAlmostEqual(stability.h_function(.5), 1.2513, delta=2e-4)
        self.assertAlmostEqual(stability.h_function(1 - 1e-12), 2.9078, delta=5e-4)


class Page(unittest.TestCase):
    def test_page_is_made_of_the_numbers(self):
        self.assertEqual((ROOT / "docs" / "stability.md").read_text(), stability.docs_of(stability.read_csv(CSV)))

    def test_nothing_is_wrong_in_silence(self):
        rows = stability.read_csv(CSV)
        self.assertGreater(len(rows), 400)
        for row in rows:
            self.assertNotIn(row["verdict"], stability.FAULTS, row)
            if row["verdict"] in ("told", "refused"):
                self.assertTrue(row["message"], row)


class Renders(unittest.TestCase):
    def test_every_verdict_holds(self):
        done = subprocess.run([sys.executable, str(ROOT / "bench" / "stability.py"), "--bin", os.environ["PBRT_MEDIA_BIN"], "--check", str(CSV)],
                              capture_output=True, text=True, timeout=1200)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
