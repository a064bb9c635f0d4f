# SPDX-License-Identifier: BSD-2-Clause
"""The page has every figure with its pictures, and they are small."""
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

from figurekit.catalogue import FOLDER, Entry, Figure, all_figures
from figurekit.not_there import NOT_THERE
from figurekit.page import MOST_BYTES, page_text
from figurekit.plotting import MOST_BYTES as MOST_OF_ONE
from figurekit.plotting import shrink

DOCS = FOLDER.parent.parent / "docs"


class PageTest(unittest.TestCase):
    def test_every_figure_is_on_the_page_with_both_pictures(self):
        page = (DOCS / "figures.md").read_text()
        wanted = set()
        for entry in all_figures():
            self.assertIn(f"### {entry.name}\n", page)
            for text in (entry.figure.title, entry.figure.reported, entry.figure.settings):
                self.assertIn(text, page, f"{entry.name}: run ./figures {entry.name}, then ./figures --docs")
            wanted |= {f"{entry.name}.png", f"{entry.name}-time.png"}
        self.assertEqual({p.name for p in (DOCS / "figures").iterdir()}, wanted)
        for name, why in NOT_THERE.items():
            self.assertIn(f"`{name}`", page)
            self.assertIn(why, page)

    def test_pictures_are_small(self):
        sizes = [p.stat().st_size for p in (DOCS / "figures").iterdir()]
        self.assertLessEqual(max(sizes), MOST_OF_ONE)
        self.assertLessEqual(sum(sizes), MOST_BYTES)

    def test_a_page_tells_claims_numbers_and_reasons(self):
        entry = Entry("misso-2022-03", Figure("a title", "What was reported.", "Our settings."), lambda run: None, Path("x.py"))
        verdicts = [{"claim": "it falls", "number": "2 (1 to 3)", "outcome": "reproduced", "why": ""},
                    {"claim": "it is best", "number": "0.5", "outcome": "not reproduced", "why": "another is"}]
        page = page_text([entry], {entry.name: {"compared": 3, "verdicts": verdicts}})
        for text in ("it falls. 2 (1 to 3): **reproduced**\n", "it is best. 0.5: **not reproduced**, because another is", "Compared with known numbers: 3.",
                     "1 figures, 2 claims: 1 reproduced, 1 not reproduced, 0 cannot be tested", "What was reported.", "figures/misso-2022-03-time.png"):
            self.assertIn(text, page)

    def test_a_large_picture_becomes_small_and_stays_a_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            noise, out = Path(folder) / "noise.png", Path(folder) / "small.png"
            Image.fromarray(np.random.default_rng(3).integers(0, 255, (300, 600, 3), dtype=np.uint8)).save(noise)
            out.write_bytes(shrink(noise))
            self.assertLessEqual(out.stat().st_size, MOST_OF_ONE)
            with Image.open(out) as small:
                self.assertAlmostEqual(small.width / small.height, 600 / 300, delta=0.05)
