# SPDX-License-Identifier: BSD-2-Clause
"""bench/option_costs.py as a whole, with the real renderer on a tiny scene."""
import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "bench"))
import option_costs  # noqa: E402

PBRT = str(Path(os.environ["PBRT_MEDIA_BIN"]) / "pbrt")
SCENE = """Film "image" "integer xresolution" 8 "integer yresolution" 8
Sampler "random"
Integrator "volpath"
WorldBegin
LightSource "infinite"
WorldEnd
"""


class OptionCosts(unittest.TestCase):
    def test_every_option_is_measured_in_every_round(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "a.pbrt").write_text(SCENE)
            done = subprocess.run([sys.executable, str(ROOT / "bench" / "option_costs.py"), PBRT, "--scene", str(folder / "a.pbrt"), "--spp", "2",
                                   "--rounds", "2", "--before", PBRT, "-o", str(folder / "costs.csv")], capture_output=True, text=True, timeout=200)
            self.assertEqual(done.returncode, 0, done.stderr)
            with (folder / "costs.csv").open(newline="") as file:
                rows = list(csv.DictReader(file))
        known = list(option_costs.settings_of(Path("."), 1))
        self.assertEqual([r["option"] for r in rows][:len(known)], known)
        self.assertTrue(rows[-1]["option"].startswith("commit "))
        for row in rows:
            low, ratio, high = (float(row[c]) for c in ("low", "ratio", "high"))
            self.assertTrue(0 < low <= ratio <= high, row)

    def test_intervals_cover_the_median_as_they_say(self):
        # P(median below the k-th or above the (n + 1 - k)-th of n) by the binomial distribution.
        self.assertEqual(option_costs.interval(list(range(9))), (1, 7))
        self.assertEqual(option_costs.interval(list(range(5))), (0, 4))
        self.assertEqual(option_costs.interval(list(range(15))), (3, 11))


if __name__ == "__main__":
    unittest.main()
