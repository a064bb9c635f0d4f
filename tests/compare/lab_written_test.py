# SPDX-License-Identifier: BSD-2-Clause
"""What the lab writes is what lab_plot_test.py takes for its tables."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from compare.lab_plot import main, read_rows
from compare.lab_tables import KINDS, kind_of


class LabWritten(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_the_lab_writes_what_is_drawn(self):
        lab = Path(os.environ["PBRT_MEDIA_BIN"]) / "medialab"
        for command, words in {"levels": ["--trials", "40"], "running": ["--runs", "4"], "power-law": ["--trials", "20"],
                               "progressive": ["--passes", "4", "--repeats", "8"]}.items():
            table = self.folder / f"{command}.csv"
            done = subprocess.run([str(lab), command, "--quiet", "-o", str(table), *words], capture_output=True, text=True, timeout=100)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIs(kind_of(read_rows(table)[0]), KINDS[command])
            self.assertEqual(main([str(table)]), 0, command)


if __name__ == "__main__":
    unittest.main()
