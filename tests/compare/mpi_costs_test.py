# SPDX-License-Identifier: BSD-2-Clause
"""bench/mpi_costs.py as a whole, with the real renderer on tiny images, and the table of docs/scaling.md."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "bench"))
import mpi_costs  # noqa: E402

PBRT_MPI = Path(os.environ["PBRT_MEDIA_BIN"]) / "pbrt-mpi"


def table_of(page: str) -> list[list[str]]:
    text = page.split("<!-- table ranks -->\n")[1].split("<!-- end -->")[0]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()]


class MpiCosts(unittest.TestCase):
    @unittest.skipUnless(PBRT_MPI.exists() and shutil.which("mpirun"), "built without MPI (libopenmpi-dev)")
    def test_every_render_is_measured_on_every_rank(self):
        with tempfile.TemporaryDirectory() as name:
            page = Path(name) / "page.md"
            page.write_text("before\n<!-- table ranks -->\nold\n<!-- end -->\nafter\n")
            done = subprocess.run([sys.executable, str(ROOT / "bench" / "mpi_costs.py"), str(PBRT_MPI), "--ranks", "1", "3", "--edge", "12", "--spp", "4",
                                   "--page", str(page)], capture_output=True, text=True, timeout=200)
            self.assertIn("one rank has nobody to wait for", done.stderr)
            done = subprocess.run([sys.executable, str(ROOT / "bench" / "mpi_costs.py"), str(PBRT_MPI), "--ranks", "2", "3", "--edge", "12", "--spp", "4",
                                   "--page", str(page)], capture_output=True, text=True, timeout=200)
            self.assertEqual(done.returncode, 0, done.stderr)
            text = page.read_text()
        self.assertTrue(text.startswith("before\n") and text.endswith("<!-- end -->\nafter\n"), text)
        rows = table_of(text)
        self.assertEqual(rows[0], mpi_costs.COLUMNS)
        self.assertEqual([row[:2] for row in rows[2:]], [[render, ranks] for render in mpi_costs.RENDERS for ranks in ("2", "3")])
        for row in rows[2:]:
            for cell in (row[3], row[4], row[5], row[7]):
                self.assertEqual(len(cell.split(" / ")), int(row[1]), row)
            self.assertTrue(all(float(kb) > 0 for kb in row[3].split(" / ")), row)
        passes = {row[0]: int(row[2]) for row in rows[2:]}
        self.assertEqual(passes["learned bounds"], 4, "one sample of each pixel in a pass")

    def test_a_row_has_what_ranks_lose_in_a_pass(self):
        rank = {"passes": 4, "bytesSent": 8000, "secondsWaiting": .2, "secondsMoving": .1, "secondsLost": .3}
        other = {**rank, "secondsWaiting": 0, "secondsLost": .1}
        self.assertEqual(mpi_costs.row_of("fog", {"ranks": [rank, other], "seconds": {"render": {"wall": 2}}}),
                         ["fog", "2", "4", "2.0 / 2.0", "50.00 / 0.00", "25.00 / 25.00", "2.00", "15 / 5 %"])

    def test_the_page_has_the_table_of_the_program(self):
        rows = table_of((ROOT / "docs" / "scaling.md").read_text())
        self.assertEqual(rows[0], mpi_costs.COLUMNS)
        self.assertEqual([row[:2] for row in rows[2:]], [[render, ranks] for render in mpi_costs.RENDERS for ranks in ("2", "3", "4")])


if __name__ == "__main__":
    unittest.main()
