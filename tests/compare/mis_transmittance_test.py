# SPDX-License-Identifier: BSD-2-Clause
"""bench/mis_transmittance.py: its numbers are what they say, and the page is made of them."""
import argparse
import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "bench"))
import mis_transmittance as bench  # noqa: E402

OPTIONS = argparse.Namespace(spp=8, renders=12)


def run_of(pixels: list, lookups: float = 1, seconds: float = 1) -> tuple:
    return [float(p) for p in pixels], lookups, seconds


class MisTransmittance(unittest.TestCase):
    def test_variance_is_between_renders(self):
        # Pixels 1, 3 and 2, 2: variances 2 and 0.
        self.assertAlmostEqual(bench.variance_of([[1, 2], [3, 2]]), 1)
        found = bench.measured([run_of([1, 2], 10, .5), run_of([3, 2], 30, 1.5)])
        self.assertEqual((found["mean"], found["lookups"], found["seconds"]), (2, 20, 1))

    def test_ratios_are_of_variance_times_cost(self):
        base = [run_of([1, 2]), run_of([3, 2]), run_of([2, 2])]
        runs = [run_of([2 + (p - 2) / 2 for p in pixels], 3, 5) for pixels, _, _ in base]
        found = bench.ratios(runs, base)
        self.assertAlmostEqual(found["variance_lookups"], 3 / 4)
        self.assertAlmostEqual(found["variance_seconds"], 5 / 4)
        self.assertGreater(found["variance_lookups_error"], 0)

    def test_the_page_is_that_of_the_table(self):
        page, table = ROOT / "docs" / "mis-transmittance.md", ROOT / "docs" / "mis-transmittance.csv"
        rows = []
        if table.exists():
            with table.open(newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([r["case"] for r in rows[::len(bench.MODES)]], list(bench.CASES))
        with tempfile.TemporaryDirectory() as name:
            bench.write_docs(Path(name) / "page.md", rows, OPTIONS)
            self.assertEqual((Path(name) / "page.md").read_text(), page.read_text(), "run bench/mis_transmittance.py --from-csv")

    def test_weights_save_where_the_page_says(self):
        """One case, made anew: what does not depend on the machine."""
        with tempfile.TemporaryDirectory() as name:
            table = Path(name) / "table.csv"
            done = subprocess.run([sys.executable, str(ROOT / "bench" / "mis_transmittance.py"), "--bin", os.environ["PBRT_MEDIA_BIN"], "--only",
                                   "window, dense", "--renders", "4", "--csv", str(table)], capture_output=True, text=True, timeout=200)
            self.assertEqual(done.returncode, 0, done.stderr)
            with table.open(newline="") as file:
                rows = {r["weights"]: r for r in csv.DictReader(file)}
        for weights in ("bounds", "joint"):
            self.assertLess(float(rows[weights]["variance_lookups"]), .5, rows[weights])


if __name__ == "__main__":
    unittest.main()
