# SPDX-License-Identifier: BSD-2-Clause
"""pbrt-compare as a whole, with the real renderer on a tiny scene. PBRT_MEDIA_BIN names the folder of pbrt and imgtool."""
import csv
import html
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

from compare.pictures import ImageTool

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "scripts"))
import benchmarks  # noqa: E402

BIN = Path(os.environ["PBRT_MEDIA_BIN"])
SCENE = """Integrator "volpath" "integer maxdepth" 8
Film "image" "integer xresolution" 12 "integer yresolution" 10
LookAt 0 -30 10  0 0 10  0 0 1
Camera "perspective" "float fov" 45
WorldBegin
LightSource "infinite" "rgb L" [ 1 1.2 1.5 ]
MakeNamedMedium "layers" "string type" "analytic" "string function" "sinesphere" "rgb sigma_a" [ .05 .05 .1 ] "rgb sigma_s" [ .2 .3 .6 ]
MediumInterface "layers" ""
Material ""
Translate 0 0 10
Shape "sphere" "float radius" 10
WorldEnd
"""
CASE = """title = "Tiny <scene>"
equal = "samples"
budget = 32
slices = 2
repeats = 2
threads = 1

[reference]
times = 4

[[scene]]
file = "tiny.pbrt"
rewrite = 'Film "image" "integer xresolution" 14'
{more}
[[setting]]
name = "ratio"
transmittance = "ratio"
sampler = "random"

[[setting]]
name = "thick"
transmittance = "ratio"
sampler = "random"
rewrite = 'MakeNamedMedium "layers" "rgb sigma_a" [ .4 .4 .4 ]'
"""


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def records(out: Path) -> list[Path]:
    """Of finished slices; a run that was killed may leave parts."""
    return [p for p in (out / "slices").glob("*.json") if not p.name.startswith("part-")]


class WithProgram(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.begin(Path(folder.name))

    def begin(self, folder: Path) -> None:
        self.folder = folder
        self.tool = ImageTool(BIN)
        (folder / "tiny.pbrt").write_text(SCENE)

    def write_case(self, more: str = "", settings: str = "") -> None:
        (self.folder / "case.toml").write_text(CASE.format(more=more) + settings)

    def run_program(self, *words: str) -> subprocess.CompletedProcess:
        return subprocess.run([ROOT / "pbrt-compare", *words, "--bin", BIN], cwd=self.folder, capture_output=True, text=True, check=False)

    def compare(self, out: str = "out", status: int = 0) -> Path:
        done = self.run_program("case.toml", "--out", out)
        self.assertEqual(done.returncode, status, done.stderr)
        self.error = done.stderr
        return self.folder / out

    def report(self, out: Path) -> dict:
        return json.loads((out / "report.json").read_text())["scenes"][0]

    def setting(self, out: Path, name: str) -> dict:
        return next(s for s in self.report(out)["settings"] if s["setting"] == name)


class Program(WithProgram):
    def test_errors_are_those_of_imgtool(self):
        subprocess.run([BIN / "pbrt", "tiny.pbrt", "--spp", "64", "--seed", "999", "--outfile", "given.pfm", "--quiet"], cwd=self.folder, check=True)
        self.write_case(more='reference = "given.pfm"\n')
        text = (self.folder / "case.toml").read_text()
        (self.folder / "case.toml").write_text(text.replace("rewrite = 'Film \"image\" \"integer xresolution\" 14'\n", ""))
        out = self.compare()
        slices = [r for r in rows(out / "slices.csv") if r["setting"] == "thick" and r["repeat"] == "1" and r["alone"] == "False"]
        self.assertEqual([r["spp"] for r in slices], ["16", "16"])
        self.tool.run("merge", *(out / "slices" / r["image"] for r in slices), "-o", self.folder / "merged.exr")
        expected = json.loads(self.tool.run("diff", self.folder / "merged.exr", self.folder / "given.pfm", "--json"))
        found = next(r for r in rows(out / "curves.csv") if r["setting"] == "thick" and r["repeat"] == "1" and r["slices"] == "2")
        for ours, theirs in (("mse", "mse"), ("relmse", "relativeMse"), ("relmse_robust", "relativeMseRobust"), ("smape", "smape"),
                             ("mean_signed", "meanSigned")):
            self.assertAlmostEqual(float(found[ours]) / expected[theirs], 1, places=5)
        self.assertEqual(float(found["spp"]), 32)

    def test_another_program_and_one_that_fails(self):
        command = f"{BIN}/pbrt - --seed {{seed}} --outfile {{outfile}} --nthreads {{threads}} --quiet"
        sampler = """rewrite = 'Sampler "random" "integer pixelsamples" {spp}'"""
        other = f'\n[[setting]]\nname = "other"\ncommand = "{command}"\nimage = "pfm"\n{sampler}\n'
        seedless = other.replace("other", "seedless").replace("--seed {seed}", "--seed 5")
        self.write_case(settings=other + seedless + '\n[[setting]]\nname = "wrong"\ntransmittance = "ratoi"\n')
        out = self.compare(status=1)
        self.assertIn('unknown estimator "ratoi"', self.error)
        report = self.report(out)
        self.assertEqual({s["setting"] for s in report["settings"]}, {"ratio", "thick", "other"})
        self.assertIn("ratoi", report["failures"]["wrong"])
        found = self.setting(out, "other")
        self.assertIsNone(found["variance_x_lookups"])
        self.assertLess(abs(found["mean_signed"]), 5 * found["mean_signed_error"])
        self.assertIn("no {seed}", report["failures"]["seedless"])
        self.assertIn("is left out", (out / "report.html").read_text())

    def test_a_comparison_needs_no_file(self):
        done = self.run_program("tiny.pbrt", "--transmittance", "ratio,unbiased-ray-marching", "--freeflight", "delta", "--equal", "samples", "--budget", "64",
                                "--quick")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = rows(self.folder / "tiny-compare" / "summary.csv")
        self.assertEqual({r["setting"] for r in summary}, {"ratio", "unbiased-ray-marching"})
        # What scripts/benchmarks.py makes tables of.
        self.assertTrue(all(float(r["variance_x_seconds"]) > 0 for r in benchmarks.from_renders(summary)))
        self.assertEqual([r["relative_seconds"] for r in benchmarks.from_comparison(summary)].count("1"), 1)
        self.assertRegex(done.stdout, r"(?m)^setting +variance x seconds")

    def test_seconds_of_other_threads_are_measured_anew(self):
        def records(threads: str) -> int:
            done = self.run_program("tiny.pbrt", "--transmittance", "ratio", "--equal", "samples", "--budget", "16", "--quick", "--threads", threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            return len(list((self.folder / "tiny-compare" / "slices").glob("*.json")))
        once = records("1")
        self.assertEqual(records("1"), once)
        self.assertEqual(records("2"), 2 * once)

    def test_a_scene_of_two_worlds_is_refused(self):
        world = SCENE[SCENE.index("WorldBegin"):]
        (self.folder / "two.pbrt").write_text(SCENE + world)
        done = self.run_program("two.pbrt", "--equal", "samples", "--budget", "4")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the scene has 2 worlds", done.stderr)

    def test_mistakes_of_the_command_line_are_told(self):
        done = self.run_program("none.pbrt")
        self.assertEqual(done.returncode, 1)
        self.assertIn("pbrt-compare: error: command line: scene 1: no scene", done.stderr)


class OneComparison(WithProgram):
    """What is asked of one and the same comparison, made once."""
    shared: tempfile.TemporaryDirectory

    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.shared.cleanup)

    def setUp(self):
        self.begin(Path(self.shared.name))
        self.whole = self.folder / "whole"
        if not self.whole.exists():
            self.write_case()
            self.compare("whole")

    def test_another_medium_is_a_bias_and_the_same_one_is_none(self):
        out = self.whole
        fair, thick = self.setting(out, "ratio"), self.setting(out, "thick")
        self.assertLess(abs(fair["mean_signed"]), 5 * fair["mean_signed_error"])
        self.assertGreater(abs(thick["mean_signed"]), 5 * thick["mean_signed_error"])
        self.assertGreater(thick["squared_bias"], 5 * thick["squared_bias_error"])
        self.assertGreater(thick["flip_at_budget"], fair["flip_at_budget"])
        for name in ("report.html", "curves.csv", "slices.csv", "summary.csv", "tiny-mse-cpu.png", "tiny-mse-lookups.png"):
            self.assertGreater((out / name).stat().st_size, 100, name)

    def test_a_worst_pixel_is_rendered_again_bit_for_bit(self):
        out = self.whole
        for worst in self.setting(out, "thick")["worstPixels"][:2]:
            command = worst["again"].replace("pixel.exr", str(self.folder / "pixel.exr"))
            subprocess.run(command, shell=True, check=True)
            pixel = self.tool.read(self.folder / "pixel.exr")
            self.assertEqual(pixel.shape, (1, 1, 3))
            np.testing.assert_array_equal(pixel[0, 0], np.array(worst["value"], np.float32))

    def test_killed_at_any_moment_it_goes_on_to_the_same_numbers(self):
        whole = self.whole
        count = len(records(whole))
        for wanted in (1, count // 2, count - 2):
            out = self.folder / f"killed{wanted}"
            words = [ROOT / "pbrt-compare", "case.toml", "--out", out, "--bin", BIN]
            with subprocess.Popen(words, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True) as process:
                limit = time.monotonic() + 60
                while len(records(out)) < wanted and time.monotonic() < limit:
                    time.sleep(0.002)
                os.killpg(process.pid, signal.SIGKILL)
            if wanted == 1:
                self.assertFalse((out / "report.html").exists())
            before = {p: p.stat().st_mtime_ns for p in records(out)}
            self.assertGreaterEqual(len(before), wanted)
            self.compare(out.name)
            for path, written in before.items():
                self.assertEqual(path.stat().st_mtime_ns, written, "a slice was rendered again")
            pairs = list(zip(rows(whole / "curves.csv"), rows(out / "curves.csv"), strict=True))
            self.assertTrue(pairs)
            for a, b in pairs:
                for column in ("setting", "repeat", "slices", "spp", "lookups", "mse", "relmse", "smape", "mean_signed"):
                    self.assertEqual(a[column], b[column], column)

    def test_the_page_needs_no_network_and_shows_its_pictures(self):
        page = self.whole / "report.html"
        text = page.read_text()
        self.assertIn("Tiny &lt;scene&gt;", text)
        self.assertNotIn("@", re.sub(r"<script.*?</script>|<style>.*?</style>|<svg.*?</svg>", "", text, flags=re.DOTALL))
        self.assertIsNone(re.search(r"""(src|href)=["']?(?!#)|url\((?!#)|@import|fetch\(""", re.sub(r'xlink:href="#', "", text)))
        if not shutil.which("chromium"):
            self.skipTest("no Chromium: the page is not opened")
        shown = self.opened(page)
        # The reference and two settings; each with a picture that was drawn, wider than a canvas that nobody touched.
        panes = re.findall(r'<div class="pane">.*?<canvas width="(\d+)"', shown, flags=re.DOTALL)
        self.assertEqual(len(panes), 3)
        self.assertTrue(all(int(width) > 0 and int(width) != 300 for width in panes), panes)
        self.assertEqual(len(re.findall(r'<div class="plot on"', shown)), 1)

    def test_every_button_of_the_page_works(self):
        if not shutil.which("chromium"):
            self.skipTest("no Chromium: the page is not opened")
        clicks = """<script>
const problems = [], drawn = [];
window.onerror = (message) => problems.push(message);
window.onunhandledrejection = (event) => problems.push(String(event.reason));
const pause = () => new Promise((done) => setTimeout(done, 150));
(async () => {
  await pause();
  for (const button of document.querySelectorAll("button, th")) { button.click(); await pause(); drawn.push(document.querySelectorAll(".pane").length); }
  const slider = document.querySelector("input");
  slider.value = 2; slider.oninput(); await pause();
  const canvas = document.querySelector(".pane canvas"), at = {clientX: 300, clientY: 500, deltaY: -300, pointerId: 1};
  canvas.setPointerCapture = () => {};
  for (const kind of ["pointerdown", "pointermove", "pointerup"]) canvas.dispatchEvent(new PointerEvent(kind, at));
  canvas.dispatchEvent(new WheelEvent("wheel", at));
  document.body.dataset.clicked = JSON.stringify({problems, drawn, where: document.querySelector(".where").textContent});
})();
</script></body>"""
        page = self.folder / "clicked.html"
        page.write_text((self.whole / "report.html").read_text().replace("</body>", clicks))
        found = re.search(r'<body data-clicked="([^"]*)"', self.opened(page))
        self.assertIsNotNone(found, "the script did not come to its end")
        said = json.loads(html.unescape(found[1]))
        self.assertEqual(said["problems"], [])
        # Pictures have the reference too, maps two panes, the slider one.
        self.assertEqual(set(said["drawn"]), {1, 2, 3})

    def opened(self, page: Path) -> str:
        """The page as it is after its scripts, in headless Chromium."""
        words = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1400,1000", "--virtual-time-budget=20000",
                 f"--user-data-dir={self.folder}/profile", "--dump-dom", page.as_uri()]
        return subprocess.run(words, capture_output=True, text=True, timeout=120, check=True).stdout


if __name__ == "__main__":
    unittest.main()
