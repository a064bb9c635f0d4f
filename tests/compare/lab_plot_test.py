# SPDX-License-Identifier: BSD-2-Clause
"""Tables of the lab become pictures that show what is in them."""
import io
import tempfile
import unittest
from contextlib import redirect_stderr
from pathlib import Path

from compare.lab_plot import lab_figure, main, read_rows
from compare.lab_tables import log_bar
from compare.problems import CaseError

CONVERGE = """# medialab converge
estimator,extinction,depth,control,pattern,samples,trials,lookups,rmse,rmse_stderr,slope_samples,slope_samples_stderr,slope_lookups,slope_lookups_stderr
ratio,cosine,1,1,independent,1,64,2,0.4,0.02,-0.5,0.01,-0.51,0.02
ratio,cosine,1,1,independent,2,64,4,0.28,0.014,-0.5,0.01,-0.51,0.02
ratio,cosine,4,1,independent,1,64,2,0.1,0.02,-0.5,0.01,-0.52,0.02
exact,cosine,1,1,independent,1,64,2,0,0,nan,nan,nan,nan
"""
ESTIMATE = """{"command": "medialab estimate", "rows": [
{"estimator": "good", "extinction": "hole", "depth": 1, "control": 2, "exact": 0.5, "mean": 0.5, "mean_stderr": 0.01, "variance": 0.1,
 "variance_stderr": 0.01, "inverse_efficiency_lookups": 0.3},
{"estimator": "crooked", "extinction": "hole", "depth": 1, "control": 2, "exact": 0.5, "mean": 0.6, "mean_stderr": 0.01, "variance": 0.2,
 "variance_stderr": 0.01, "inverse_efficiency_lookups": 0.1},
{"estimator": "certain", "extinction": "hole", "depth": 1, "control": 2, "exact": 0.5, "mean": 0.5, "mean_stderr": 0, "variance": 0,
 "variance_stderr": 0, "inverse_efficiency_lookups": 0}]}
"""
LEVELS = """# medialab levels
estimator,extinction,depth,coupling,level,teeth,trials,mean,mean_stderr,variance,variance_stderr,lookups,variance_lookups,probability
march,cosine,1,split,0,4,9,0.1,0.01,0.01,0.001,8,0.08,0.6
march,cosine,1,split,1,8,9,0.1,0.01,0.0001,0.00001,16,0.0016,0.2
march,cosine,4,split,0,4,9,0.1,0.01,0,0,8,0,0.6
march,cosine,1,independent,0,4,9,0.1,0.01,0.02,0.002,12,0.24,0.6
"""
RUNNING = """estimator,extinction,s,run,value
ratio,hole,0.5,exact,0.7
ratio,hole,1,exact,0.5
ratio,hole,0.5,mean,0.71
ratio,hole,1,mean,0.52
ratio,hole,0.5,stderr,0.01
ratio,hole,1,stderr,0.02
ratio,hole,0.5,1,0.9
ratio,hole,1,1,0.2
"""
POWER_LAW = """alpha,samples,trials,error,error_stderr,slope,slope_stderr,expected_slope
0.4,1,50,0.4,0.04,-0.48,0.025,-0.5
0.4,2,50,0.3,0.03,-0.48,0.025,-0.5
0.9,1,50,0.9,0.09,-0.11,0.025,-0.1
"""
PROGRESSIVE = """estimator,extinction,pass,repeats,exact,pass_mean,pass_mean_stderr,mean,mean_stderr,mse,mse_stderr,lookups,bounded_share,control_depth
ratio,hole,1,9,0.5,0.5,0.1,0.5,0.1,0.2,0.02,3,0.1,0.1
ratio,hole,2,9,0.5,0.5,0.1,0.5,0.1,0.1,0.01,3,0.2,0.1
march,step,1,9,0.5,0.5,0.1,0.5,0.1,0.3,0.03,3,0.1,0.1
"""
RED = "#b3261e"


def texts(figure) -> str:
    """All words of a figure."""
    out = io.StringIO()
    figure.savefig(out, format="svg")
    return out.getvalue()


class LabPlot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "c.csv").write_text(CONVERGE)
        (self.folder / "e.json").write_text(ESTIMATE)

    def test_curves_have_a_panel_for_each_problem_and_slopes(self):
        figure = lab_figure(read_rows(self.folder / "c.csv"), "lookups")
        self.assertEqual([a.get_title(loc="left") for a in figure.axes], ["cosine, depth 1, control 1", "cosine, depth 4, control 1"])
        words = texts(figure)
        for part in ("ratio  -0.51 ± 0.04", "ratio  -0.52 ± 0.04", "without error: exact", "density look-ups"):
            self.assertIn(part, words)

    def test_bars_are_two_standard_errors_and_never_reach_zero(self):
        low, high = log_bar(1.0, 0.01)
        self.assertAlmostEqual(low, 0.0194, places=3)
        self.assertAlmostEqual(high, 0.0198, places=3)
        self.assertLess(log_bar(1.0, 5.0)[0], 1)

    def test_estimates_are_sorted_and_biased_ones_red(self):
        figure = lab_figure(read_rows(self.folder / "e.json"), "lookups")
        axes = figure.axes[0]
        self.assertEqual([t.get_text() for t in axes.get_yticklabels()], ["good", "crooked"])
        colours = [bars.lines[0].get_color() for bars in axes.containers]
        self.assertNotEqual(colours[0], RED)
        self.assertEqual(colours[1], RED)
        self.assertIn("without variance: certain", texts(figure))

    def test_other_files_and_missing_columns_are_errors(self):
        (self.folder / "x.csv").write_text("a,b\n1,2\n")
        (self.folder / "x.json").write_text("[]")
        (self.folder / "b.csv").write_bytes(b"\xff\xfe")
        for name in ("x.csv", "x.json", "b.csv", "none.csv"):
            with self.assertRaises(CaseError):
                read_rows(self.folder / name)
        with self.assertRaisesRegex(CaseError, "no seconds"):
            lab_figure(read_rows(self.folder / "c.csv"), "seconds")

    def figure_of(self, table: str):
        (self.folder / "t.csv").write_text(table)
        return lab_figure(read_rows(self.folder / "t.csv"))

    def test_levels_fall_with_their_lookups(self):
        figure = self.figure_of(LEVELS)
        self.assertEqual([a.get_title(loc="left") for a in figure.axes], ["cosine, depth 1", "cosine, depth 4"])
        split, independent = figure.axes[0].containers
        self.assertEqual((split.get_label(), independent.get_label()), ("march, split", "march, independent"))
        self.assertEqual([list(split.lines[0].get_data()[k]) for k in (0, 1)], [[8, 16], [.01, .0001]])
        self.assertEqual(figure.axes[0].get_yscale(), "log")
        self.assertEqual(len(figure.axes[1].containers), 0)  # no variance, no logarithm

    def test_runs_stand_behind_their_mean_and_the_exact_line(self):
        axes = self.figure_of(RUNNING).axes[0]
        lines = {line.get_label(): list(line.get_ydata()) for line in axes.lines}
        self.assertEqual((lines["ratio"], lines["exact"]), ([.71, .52], [.7, .5]))
        self.assertIn([.9, .2], lines.values())
        band = axes.collections[0].get_paths()[0].vertices
        self.assertAlmostEqual(band[:, 1].max(), .71 + 1.96 * .01)
        self.assertAlmostEqual(band[:, 1].min(), .52 - 1.96 * .02)

    def test_power_laws_tell_slopes(self):
        figure = self.figure_of(POWER_LAW)
        self.assertEqual(len(figure.axes), 1)
        words = texts(figure)
        for part in ("0.4:  -0.48 ± 0.05, expected -0.50", "0.9:  -0.11 ± 0.05, expected -0.10"):
            self.assertIn(part, words)

    def test_progressive_tables_have_a_panel_for_each_line(self):
        figure = self.figure_of(PROGRESSIVE)
        self.assertEqual([a.get_title(loc="left") for a in figure.axes], ["hole", "step"])
        self.assertEqual(list(figure.axes[0].containers[0].lines[0].get_ydata()), [.2, .1])

    def test_tables_of_one_axis_take_no_other(self):
        (self.folder / "t.csv").write_text(PROGRESSIVE)
        with self.assertRaisesRegex(CaseError, "one axis only"):
            lab_figure(read_rows(self.folder / "t.csv"), "seconds")

    def test_the_program_writes_a_picture(self):
        self.assertEqual(main([str(self.folder / "c.csv")]), 0)
        self.assertEqual((self.folder / "c.png").read_bytes()[:4], b"\x89PNG")
        said = io.StringIO()
        with redirect_stderr(said):
            self.assertEqual(main([str(self.folder / "c.csv"), "-o", "c.jpg"]), 1)
        self.assertIn("expected a name ending in .png", said.getvalue())


if __name__ == "__main__":
    unittest.main()
