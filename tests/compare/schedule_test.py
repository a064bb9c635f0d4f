# SPDX-License-Identifier: BSD-2-Clause
"""Settings take turns, budgets are met, and what is there is not rendered again."""
import dataclasses
import tempfile
import unittest
from pathlib import Path

import numpy as np

from compare.analysis import SceneAnalysis, group_sizes
from compare.case import Case, SceneCase, Setting
from compare.pictures import ImageTool, read_pfm, write_pfm
from compare.problems import CaseError
from compare.programs import Cost, RenderFailure
from compare.schedule import SEEDS_OF_A_RUN, Entry, Schedule
from compare.slices import SliceStore
from compare.terminal import terminal_table

TRUTH = np.random.default_rng(0).uniform(0.5, 1, (12, 14, 3))


class Killed(BaseException):
    """The program ends here, as under `kill -9`."""


class FakeRenderer:
    """Noise of a known variance and cost instead of a scene."""

    def __init__(self, case: Case, name: str, sigma: float = 1.0, cost: float = 0.01, bias: float = 0.0, log: list | None = None):
        self.case = case
        self.setting = Setting(name, image="pfm")
        self.scene = case.scenes[0]
        self.key = name
        self.sigma, self.cost, self.bias = sigma, cost, bias
        self.log = log if log is not None else []
        self.killed_after = 10**9
        self.fails = False

    def shell(self, seed: int, spp: int, outfile: str) -> str:
        return f"fake --seed {seed} --spp {spp} {outfile}"

    def run(self, seed: int, spp: int, outfile: Path):
        if self.fails:
            raise RenderFailure("no such estimator")
        rng = np.random.default_rng([seed, spp, *self.key.encode()])
        write_pfm(outfile, (TRUTH + self.bias + self.sigma / np.sqrt(spp) * rng.normal(size=TRUTH.shape)).astype(np.float32))
        if len(self.log) >= self.killed_after:
            raise Killed
        self.log.append((self.setting.name, seed, spp))
        return Cost(spp * self.cost, spp * self.cost, 0, spp * 100, spp, spp), {}


class FakeTool(ImageTool):
    """Without FLIP."""

    def flip(self, image: np.ndarray, reference: np.ndarray) -> tuple[float, np.ndarray]:
        return 0.0, np.zeros(image.shape[:2])


class WithRenderers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.case = Case("t", (SceneCase(Path("s.pbrt"), "s", 1.6),), (Setting("a"), Setting("b")), slices=4, repeats=3, reference_setting="a")
        self.log: list = []

    def fake(self, name: str, **kinds) -> FakeRenderer:
        return FakeRenderer(self.case, name, log=self.log, **kinds)

    def store(self) -> SliceStore:
        """As after a kill: nobody holds the folder."""
        if hasattr(self, "held"):
            self.held.close()
        self.held = SliceStore(self.folder)
        self.addCleanup(self.held.close)
        return self.held

    def schedule(self) -> Schedule:
        return Schedule(self.case, self.case.scenes[0], self.store(), lambda what, slice_: None)

    def entries(self, *renderers: FakeRenderer) -> list[Entry]:
        return [Entry(r.setting, r) for r in renderers]


class ScheduleTest(WithRenderers):
    def test_every_run_spends_its_budget_within_half_a_slice(self):
        entries = self.entries(self.fake("a"), self.fake("b", cost=0.003))
        self.schedule().compare(entries)
        for entry in entries:
            self.assertEqual(len(entry.runs), 3)
            for run in entry.runs:
                self.assertLess(abs(run.spent - 1.6), 0.5 * run.spent / len(run.slices) + 1e-9)
        self.assertEqual(entries[0].spp, 40)
        self.assertEqual([s.spp for s in entries[0].runs[2].ladder], [1, 2, 4, 8, 16, 32])

    def test_slices_alternate(self):
        self.schedule().compare(self.entries(self.fake("a"), self.fake("b")))
        slices = [name for name, seed, _ in self.log if seed % SEEDS_OF_A_RUN < 100]
        self.assertEqual(slices, ["a", "b"] * 12)

    def test_no_seed_is_used_twice_for_a_setting(self):
        entries = self.entries(self.fake("a"), self.fake("b"))
        schedule = self.schedule()
        schedule.compare(entries)
        reference = Entry(Setting("a", image="pfm"), self.fake("a"))
        schedule.reference(reference)
        used = [seed for name, seed, _ in self.log if name == "a"]
        self.assertEqual(len(used), len(set(used)))
        self.assertAlmostEqual(reference.runs[0].spent, 16 * 1.6, delta=1.6)

    def test_equal_samples_and_lookups_are_equal(self):
        for equal, budget in (("samples", 64), ("lookups", 6400)):
            case = dataclasses.replace(self.case, equal=equal, scenes=(dataclasses.replace(self.case.scenes[0], budget=budget),))
            entries = self.entries(self.fake(f"a{equal}"), self.fake(f"b{equal}", cost=1))
            Schedule(case, case.scenes[0], self.store(), lambda what, slice_: None).compare(entries)
            for entry in entries:
                self.assertEqual([[s.spp for s in run.slices] for run in entry.runs], [[16] * 4] * 3)

    def test_a_second_run_renders_nothing(self):
        self.schedule().compare(self.entries(self.fake("a")))
        count = len(self.log)
        again = self.entries(self.fake("a"))
        self.schedule().compare(again)
        self.assertEqual(len(self.log), count)
        self.assertEqual(len(again[0].runs[0].slices), 4)

    def test_killed_anywhere_it_goes_on_with_the_same_slices(self):
        whole = self.entries(self.fake("a"), self.fake("b", cost=0.02))
        self.schedule().compare(whole)
        expected = list(self.log)
        images = {s.image.name: read_pfm(s.image) for e in whole for s in e.slices()}
        for moment in range(0, len(expected), 7):
            with tempfile.TemporaryDirectory() as folder:
                self.folder = Path(folder)
                self.log.clear()
                for stop in (moment, 10**9):
                    entries = self.entries(self.fake("a"), self.fake("b", cost=0.02))
                    for entry in entries:
                        entry.renderer.killed_after = stop
                    try:
                        self.schedule().compare(entries)
                    except Killed:
                        self.assertEqual(stop, moment)
                self.assertEqual(self.log, expected)
                for entry in entries:
                    for slice_ in entry.slices():
                        np.testing.assert_array_equal(read_pfm(slice_.image), images[slice_.image.name])

    def test_an_image_without_its_record_is_rendered_again(self):
        entries = self.entries(self.fake("a"))
        self.schedule().compare(entries)
        lost = entries[0].runs[1].slices[2]
        lost.image.with_suffix(".json").unlink()
        self.log.clear()
        self.schedule().compare(self.entries(self.fake("a")))
        self.assertEqual([seed for _, seed, _ in self.log], [lost.seed])

    def test_two_do_not_work_in_one_folder(self):
        store = self.store()
        (self.folder / "part-a.exr").write_bytes(b"")
        with self.assertRaisesRegex(CaseError, "another pbrt-compare"):
            SliceStore(self.folder)
        self.assertTrue((self.folder / "part-a.exr").exists())
        store.close()
        self.store()
        self.assertFalse((self.folder / "part-a.exr").exists())

    def test_a_setting_that_fails_leaves_the_others(self):
        broken = self.fake("b")
        broken.fails = True
        entries = self.entries(self.fake("a"), broken)
        self.schedule().compare(entries)
        self.assertEqual(entries[1].failure, "no such estimator")
        self.assertEqual([len(run.slices) for run in entries[0].runs], [4, 4, 4])


class Judgement(WithRenderers):
    """Numbers of renderers whose noise, cost and bias are known."""

    def judged(self, *renderers: FakeRenderer):
        case = dataclasses.replace(self.case, slices=8, repeats=4)
        entries = self.entries(*renderers)
        schedule = Schedule(case, case.scenes[0], self.store(), lambda what, slice_: None)
        schedule.compare(entries)
        reference = Entry(Setting("reference", image="pfm"), self.fake("reference", sigma=0.1))
        schedule.reference(reference)
        references = [read_pfm(s.image) for s in reference.slices()]
        return SceneAnalysis(case, "s", FakeTool(Path(".")), references, "reference").run(entries)

    def test_work_slope_and_bias_are_those_of_the_renderer(self):
        result = self.judged(self.fake("a", sigma=2, cost=0.01), self.fake("b", sigma=1, cost=0.01))
        self.assertEqual([r.name for r in result.results], ["b", "a"])
        for found, work in zip(result.results, (0.01, 0.04)):
            log = found.works["cpu"].log()
            self.assertLess(abs(log.value - np.log(work)), 5 * log.error)
            self.assertLess(abs(found.slope.value + 1), 5 * found.slope.error)
            self.assertFalse(found.bias.seen())
            self.assertIsNone(found.bias.flat_at)
        self.assertEqual([r.tied["cpu"] for r in result.results], [True, False])
        self.assertLess(abs(result.results[1].ratios["cpu"].value - np.log(4)), 5 * result.results[1].ratios["cpu"].error)

    def test_negative_control_bias_is_seen_and_flattens_the_curve(self):
        result = self.judged(self.fake("a", sigma=0.5), self.fake("b", sigma=0.5, bias=0.05))
        fair, biased = sorted(result.results, key=lambda r: r.name)
        self.assertFalse(fair.bias.seen())
        self.assertTrue(biased.bias.seen())
        self.assertLess(abs(biased.bias.signed.value - 0.05), 5 * biased.bias.signed.error)
        self.assertLess(abs(biased.bias.squared.value - 0.0025), 5 * biased.bias.squared.error)
        # Variance x seconds 0.25 * 0.01, squared bias 0.05^2.
        self.assertAlmostEqual(biased.bias.flat_at, 1, delta=0.3)
        self.assertGreater(biased.slope.value, fair.slope.value + 0.1)

    def test_a_biased_setting_is_not_the_best(self):
        result = self.judged(self.fake("a", sigma=0.5), self.fake("b", sigma=0.1, bias=0.05), self.fake("c", sigma=1))
        self.assertEqual([(r.name, r.biased(), r.tied.get("cpu")) for r in result.results], [("a", False, True), ("c", False, False), ("b", True, None)])
        self.assertEqual(result.results[0].ratios["cpu"].error, 0)
        self.assertLess(result.results[2].ratios["cpu"].value, 0)
        lines = terminal_table(self.case, result).splitlines()
        self.assertEqual([line.split()[0] for line in lines[1:]], ["s", "setting", "a", "c", "b"])
        self.assertIn("1 best", lines[3])
        self.assertIn("BIASED", lines[5])

    def test_a_reference_that_is_a_matter_of_luck_is_told(self):
        entries = self.entries(self.fake("a"))
        self.schedule().compare(entries)
        rng = np.random.default_rng(1)
        references = [(TRUTH + 0.02 * rng.normal(size=TRUTH.shape)).astype(np.float32) for _ in range(8)]
        tool = FakeTool(Path("."))
        self.assertEqual(SceneAnalysis(self.case, "s", tool, references, "r").run(entries).reference_warning(), "")
        noisy = [(r + rng.normal(size=TRUTH.shape)).astype(np.float32) for r in references]
        self.assertIn("more than a tenth", SceneAnalysis(self.case, "s", tool, noisy, "r").run(entries).reference_warning())
        references[3][5, 5] = -1e6
        result = SceneAnalysis(self.case, "s", tool, references, "r").run(entries)
        self.assertIn("heavy tail", result.reference_warning())
        self.assertIn("heavy tail", terminal_table(self.case, result))

    def test_equal_renderers_tie(self):
        result = self.judged(self.fake("a"), self.fake("b"))
        self.assertEqual([r.tied["cpu"] for r in result.results], [True, True])
        self.assertIn(" tie", terminal_table(self.case, result))

    def test_an_image_of_another_size_is_left_out_by_name(self):
        entries = self.entries(self.fake("a"))
        self.schedule().compare(entries)
        result = SceneAnalysis(self.case, "s", FakeTool(Path(".")), [np.ones((2, 2, 3), np.float32)], "given").run(entries)
        self.assertIn("14 x 12 pixels", result.failures["a"])

    def test_pixels_without_number_are_no_result(self):
        entries = self.entries(self.fake("a", bias=np.nan))
        self.schedule().compare(entries)
        result = SceneAnalysis(self.case, "s", FakeTool(Path(".")), [TRUTH.astype(np.float32)], "given").run(entries)
        self.assertIn("168 pixels are no numbers", result.failures["a"])


class GroupSizes(unittest.TestCase):
    def test_double_and_end_with_all(self):
        self.assertEqual([group_sizes(n) for n in (1, 2, 5, 8)], [[1], [1, 2], [1, 2, 4, 5], [1, 2, 4, 8]])


if __name__ == "__main__":
    unittest.main()
