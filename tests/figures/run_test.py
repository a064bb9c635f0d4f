# SPDX-License-Identifier: BSD-2-Clause
"""What programs found is kept by all that decides about it; a run leaves all of a figure or fails."""
import json
import stat
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path

from figurekit.catalogue import Entry, Figure
from figurekit.intervals import Interval
from figurekit.main import make
from figurekit.plotting import panels
from figurekit.programs import FigureError, Programs, parse_rows
from figurekit.run import Run

LAB = """#!/bin/sh
echo "$@" >> calls
[ "$1" = broken ] && { echo "no such thing" >&2; exit 1; }
printf '# remark\\nestimator,extinction,depth,control,exact,mean,mean_stderr\\nratio,hole,1,1,0.5,0.52,0.01\\n'
"""
ENTRY = Entry("misso-2022-03", Figure("a title", "what was reported", "our settings"), lambda run: None, Path("scenes/figures/misso_2022_03.py"))


class RunTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.program = self.root / "medialab"
        self.program.write_text(LAB)
        self.program.chmod(self.program.stat().st_mode | stat.S_IXUSR)
        self.told = []
        self.run_ = self.fresh()

    def fresh(self, quick=False) -> Run:
        return Run(ENTRY, Programs(self.root, self.root / "kept", self.told.append), self.root / "out" / ENTRY.name, quick)

    def calls(self) -> int:
        return len((self.root / "kept" / "calls").read_text().splitlines())

    def plots(self, run: Run) -> None:
        plot, _ = panels(1)
        run.plot(plot)
        run.time_plot(plot)

    def test_tables_have_numbers_and_words(self):
        self.assertEqual(parse_rows("# r\na,b\n1e-3,x\n"), [{"a": 0.001, "b": "x"}])

    def test_what_was_found_is_not_measured_again(self):
        first = self.run_.lab("estimate", trials=10)
        self.assertEqual(first, self.fresh().lab("estimate", trials=10))
        self.assertEqual(self.calls(), 1)
        self.assertEqual(len(self.told), 1)

    def test_other_options_files_and_programs_are_measured_again(self):
        table = self.run_.text_file("line.csv", "0,1\n1,1\n")
        self.run_.lab("estimate", trials=10, files=[table])
        self.run_.lab("estimate", trials=11, files=[table])
        table.write_text("0,1\n1,2\n")
        self.run_.lab("estimate", trials=11, files=[table])
        self.program.write_text(LAB + "# another build\n")
        self.fresh().lab("estimate", trials=11, files=[table])
        self.assertEqual(self.calls(), 4)

    def test_what_nobody_asked_for_is_forgotten(self):
        first = self.fresh()
        first.lab("estimate", trials=10)
        first.lab("estimate", trials=11)
        again = self.fresh()
        again.lab("estimate", trials=11)
        again.programs.forget_others()
        self.assertEqual(len(list((self.root / "kept").iterdir())), 1)
        again.lab("estimate", trials=11)
        self.assertEqual(len(self.told), 2)
        again.lab("estimate", trials=10)
        self.assertEqual(len(self.told), 3)

    def test_options_become_words(self):
        self.run_.lab("estimate", control=[1, 2], top_efficiency=0.5, paper_depth=True, lower=None)
        self.assertTrue((self.root / "kept" / "calls").read_text().startswith("estimate --control 1,2 --top-efficiency 0.5 --paper-depth --format"))

    def test_a_program_that_fails_is_quoted_and_leaves_nothing(self):
        with self.assertRaisesRegex(FigureError, "no such thing"):
            self.run_.lab("broken")
        self.assertEqual(list((self.root / "kept").glob("*.csv")), [])

    def test_numbers_that_differ_are_told(self):
        self.run_.expect("a", "1.25", 1.255)
        self.run_.expect("b", "1.25", 1.3)
        self.assertEqual(self.run_.compared, 2)
        self.assertEqual(len(self.run_.mismatches), 1)
        self.assertTrue(self.run_.mismatches[0].startswith("b: 1.3"))

    def test_a_biased_mean_is_told(self):
        rows = self.run_.lab("estimate")
        self.run_.unbiased(rows)
        self.assertEqual(self.run_.mismatches, [])
        rows[0]["mean"] = 0.56
        self.run_.unbiased(rows)
        self.assertEqual(len(self.run_.mismatches), 1)
        self.run_.unbiased(rows, 0.1)
        self.assertEqual(len(self.run_.mismatches), 1)

    def test_a_figure_without_all_its_parts_is_not_finished(self):
        self.plots(self.run_)
        self.run_.table([{"a": 1}])
        with self.assertRaisesRegex(FigureError, "no verdict"):
            self.run_.finish()
        self.run_.claim("more", Interval.exact(2), above=1)
        self.run_.finish()
        result = json.loads((self.run_.folder / "result.json").read_text())
        self.assertEqual(result["verdicts"][0]["outcome"], "reproduced")

    def test_the_exit_status_is_about_known_numbers_and_not_about_verdicts(self):
        def script(value: float):
            def make_it(run: Run) -> None:
                self.plots(run)
                run.table([{"a": 1}])
                run.expect("a number", "1.25", value)
                run.claim("more", Interval.exact(0), above=1)  # not reproduced
            return make_it
        for value, status, told in ((1.25, 0, "1 of 1 known numbers agree"), (1.5, 1, "0 of 1 known numbers agree")):
            with redirect_stderr(StringIO()) as errors, redirect_stdout(StringIO()) as said:
                self.assertEqual(make([Entry(ENTRY.name, ENTRY.figure, script(value), ENTRY.script)], self.root / "all", self.root, True), status)
            self.assertIn("more: 0: not reproduced", said.getvalue())
            self.assertIn(f"1 of 1 figures were made, {told}", said.getvalue())
            self.assertEqual("a number: 1.5" in errors.getvalue(), status == 1)

    def test_one_broken_script_does_not_stop_the_others(self):
        def good(run: Run) -> None:
            self.plots(run)
            run.table([{"a": 1}])
            run.claim("more", Interval.exact(2), above=1)

        def broken(run: Run) -> None:
            raise ValueError("a mistake of the script")
        entries = [Entry("misso-2022-03", ENTRY.figure, broken, ENTRY.script), Entry("misso-2022-07", ENTRY.figure, good, ENTRY.script)]
        with redirect_stderr(StringIO()) as errors, redirect_stdout(StringIO()) as said:
            self.assertEqual(make(entries, self.root / "all", self.root, False), 1)
            self.assertEqual(make(entries[1:], self.root / "all", self.root, False), 0)
        self.assertIn("a mistake of the script", errors.getvalue())
        self.assertIn("more: 2: reproduced", said.getvalue())
        self.assertTrue((self.root / "all" / "misso-2022-07" / "result.json").is_file())
