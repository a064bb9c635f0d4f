# SPDX-License-Identifier: BSD-2-Clause
"""The page has every figure with its pictures, and they are small."""
import json
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

from figurekit.catalogue import FOLDER, PAPERS, Entry, Figure, all_figures
from figurekit.not_there import NOT_THERE
from figurekit.page import MOST_BYTES, Part, page_text, parts_of, verdict_lines, write_page
from figurekit.plotting import MOST_BYTES as MOST_OF_ONE
from figurekit.plotting import shrink
from figurekit.programs import FigureError

DOCS = FOLDER.parent.parent / "docs"


def result(*outcomes: str) -> dict:
    return {"compared": 0, "verdicts": [{"claim": "c", "number": "1", "outcome": o, "why": ""} for o in outcomes]}


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
        page = page_text([entry], {entry.name: Part.made(entry, {"compared": 3, "verdicts": verdicts})})
        for text in ("it falls. 2 (1 to 3): **reproduced**\n", "it is best. 0.5: **not reproduced**, because another is", "Compared with known numbers: 3.",
                     "1 figures, 2 claims: 1 reproduced, 1 not reproduced, 0 cannot be tested", "What was reported.", "figures/misso-2022-03-time.png"):
            self.assertIn(text, page)

    def test_verdicts_are_counted_from_the_page(self):
        entries = [Entry(name, Figure("a | title", "Reported.", "Ours."), lambda run: None, Path("x.py")) for name in ("misso-2022-03", "misso-2023-09")]
        outcomes = {"misso-2022-03": ["reproduced", "not reproduced", "reproduced"], "misso-2023-09": ["cannot be tested"]}
        page = page_text(entries, {e.name: Part.made(e, result(*outcomes[e.name])) for e in entries})
        lines = verdict_lines(page, entries)
        self.assertRegex(lines[0], r"^misso-2022-03 +2 reproduced, 1 not reproduced +a \| title$")
        self.assertRegex(lines[1], r"^misso-2023-09 +1 cannot be tested +a \| title$")
        self.assertIn("misso-2022: 1 figures, 3 claims: 2 reproduced, 1 not reproduced, 0 cannot be tested", lines)
        self.assertEqual(lines[-1], "all: 2 figures, 4 claims: 2 reproduced, 1 not reproduced, 1 cannot be tested")
        with self.assertRaisesRegex(FigureError, "misso-2022-04"):
            verdict_lines(page, [Entry("misso-2022-04", entries[0].figure, lambda run: None, Path("x.py"))])

    def test_the_page_is_made_of_what_it_has(self):
        entries, page = all_figures(), (DOCS / "figures.md").read_text()
        self.assertEqual(page_text(entries, parts_of(page)), page)

    def test_figures_that_were_not_made_stay_as_they_are(self):
        entries = [Entry(name, Figure("A title", "Reported.", "Ours."), lambda run: None, Path("x.py")) for name in ("misso-2022-03", "misso-2023-09")]
        with tempfile.TemporaryDirectory() as name:
            out, docs = Path(name) / "out", Path(name) / "docs"
            docs.mkdir()

            def leave(entry: Entry, shade: int, *outcomes: str) -> None:
                (out / entry.name).mkdir(parents=True, exist_ok=True)
                (out / entry.name / "result.json").write_text(json.dumps(result(*outcomes)))
                for suffix in ("", "-time"):
                    Image.new("L", (8, 8), shade).save(out / entry.name / f"{entry.name}{suffix}.png")
            leave(entries[1], 10, "reproduced")
            with self.assertRaisesRegex(FigureError, "run ./figures misso-2022-03"):
                write_page(entries, out, docs)
            leave(entries[0], 10, "not reproduced")
            self.assertEqual(write_page(entries, out, docs)[1], [])
            before = {p.name: p.read_bytes() for p in (docs / "figures").iterdir()}

            shutil.rmtree(out / entries[0].name)
            leave(entries[1], 200, "reproduced", "cannot be tested")
            self.assertEqual(write_page(entries, out, docs)[1], [entries[0].name])
            self.assertEqual(verdict_lines((docs / "figures.md").read_text(), entries)[-1], "all: 2 figures, 3 claims: 1 reproduced, 1 not reproduced, 1 cannot be tested")
            after = {p.name: p.read_bytes() for p in (docs / "figures").iterdir()}
            self.assertEqual(set(after), set(before))
            self.assertEqual([n for n in before if after[n] != before[n]], [n for n in before if n.startswith(entries[1].name)])

    def test_the_command_tells_what_the_page_sums_up(self):
        entries = all_figures()
        page = (DOCS / "figures.md").read_text()
        lines = verdict_lines(page, entries)
        self.assertEqual(len(lines), len(entries) + len(PAPERS) + 1)
        self.assertIn(lines[-1].removeprefix("all: ") + ".\n", page)

    def test_a_large_picture_becomes_small_and_stays_a_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            noise, out = Path(folder) / "noise.png", Path(folder) / "small.png"
            Image.fromarray(np.random.default_rng(3).integers(0, 255, (300, 600, 3), dtype=np.uint8)).save(noise)
            out.write_bytes(shrink(noise))
            self.assertLessEqual(out.stat().st_size, MOST_OF_ONE)
            with Image.open(out) as small:
                self.assertAlmostEqual(small.width / small.height, 600 / 300, delta=0.05)

    def test_colours_of_thin_lines_stay_apart_beside_a_picture_of_many_shades(self):
        lines = {20: (31, 119, 180), 40: (90, 90, 90), 60: (44, 160, 44)}
        shades = np.arange(200)
        pixels = np.full((300, 600, 3), 255, dtype=np.uint8)
        pixels[:, :200, 0] = 255 - shades // 4
        pixels[:, :200, 1] = pixels[:, :200, 2] = shades[::-1]
        for row, colour in lines.items():
            pixels[row, 300:500] = colour
        with tempfile.TemporaryDirectory() as folder:
            source, out = Path(folder) / "plot.png", Path(folder) / "small.png"
            Image.fromarray(pixels).save(source)
            out.write_bytes(shrink(source))
            with Image.open(out) as small:
                found = np.asarray(small.convert("RGB"), dtype=int)
        for row, colour in lines.items():
            self.assertLess(np.abs(found[row, 300:500] - colour).max(), 20, f"the line of {colour} is drawn as {found[row, 400]}")
