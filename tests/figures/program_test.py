# SPDX-License-Identifier: BSD-2-Clause
"""Two figures with the real programs. PBRT_MEDIA_BIN names their folder."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NAMES = ("georgiev-2019-10", "kettunen-2021-04")


class ProgramTest(unittest.TestCase):
    def figures(self, *words: str) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, "-B", "-m", "figurekit", *words, "--bin", os.environ["PBRT_MEDIA_BIN"]], capture_output=True, text=True, check=False, cwd=ROOT)

    def test_figures_are_made_agree_with_known_numbers_and_go_on_where_they_stopped(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            first = self.figures(*NAMES, "--quick", "--out", folder)
            self.assertEqual(first.returncode, 0, first.stdout + first.stderr)
            self.assertIn("left] georgiev-2019-10: medialab estimate", first.stderr)
            for name in NAMES:
                result = json.loads((out / name / "result.json").read_text())
                self.assertGreater(result["compared"], 0)
                self.assertEqual(result["mismatches"], [])
                self.assertGreater(sum(v["outcome"] == "reproduced" for v in result["verdicts"]), 0)
                for suffix in (".png", ".pdf", "-time.png", "-time.pdf"):
                    self.assertGreater((out / name / f"{name}{suffix}").stat().st_size, 1000)
            tables = [(out / n / "data.csv").read_bytes() for n in NAMES]
            again = self.figures(*NAMES, "--quick", "--out", folder)
            self.assertEqual(again.stderr, "")  # no program was started
            self.assertEqual(again.stdout, first.stdout)
            self.assertEqual(tables, [(out / n / "data.csv").read_bytes() for n in NAMES])
