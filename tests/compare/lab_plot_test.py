# SPDX-License-Identifier: BSD-2-Clause
"""Tables of the lab become pictures that show what is in them."""
import io
import tempfile
import unittest
from contextlib import redirect_stderr
from pathlib import Path

from compare.lab_plot import lab_figure, log_bar, main, read_rows
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

    def test_the_program_writes_a_picture(self):
        self.assertEqual(main([str(self.folder / "c.csv")]), 0)
        self.assertEqual((self.folder / "c.png").read_bytes()[:4], b"\x89PNG")
        said = io.StringIO()
        with redirect_stderr(said):
            self.assertEqual(main([str(self.folder / "c.csv"), "-o", "c.jpg"]), 1)
        self.assertIn("expected a name ending in .png", said.getvalue())


if __name__ == "__main__":
    unittest.main()
