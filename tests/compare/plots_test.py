# SPDX-License-Identifier: BSD-2-Clause
"""All words of a plot are in its picture."""
import unittest

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from compare.analysis import AXES, CurvePoint, SceneResult, SettingResult
from compare.case import Setting
from compare.intervals import Estimate
from compare.metrics import METRICS, Reference
from compare.plots import METRIC_TITLES, error_figure
from compare.schedule import Entry


def scene(errors: list[float]) -> SceneResult:
    """One setting whose error after 1, 2, ... seconds is given."""
    curve = [CurvePoint(False, i, {a: float(i) for a in AXES}, {m: Estimate(e, 0.01 * e, 3) for m in METRICS}, []) for i, e in enumerate(errors, 1)]
    return SceneResult("s", Reference(np.ones((2, 2, 3)), None), "given", [SettingResult("a", Entry(Setting("a"), None), curve)], {})


class Plots(unittest.TestCase):
    def test_axes_have_numbers_and_no_word_is_cut_off(self):
        for errors in ([2.6e-12, 1.3e-12], [2.6e-3, 1.3e-3], [1e-1, 1e-9], [3000.0, 1500.0]):
            for metric in METRIC_TITLES:
                figure = error_figure(scene(errors), {"a": 0}, "cpu", metric)
                canvas = FigureCanvasAgg(figure)
                canvas.draw()
                axes = figure.axes[0]
                for line in (axes.xaxis, axes.yaxis):
                    self.assertGreaterEqual(len(line.get_ticklocs()), 2, f"{metric} {errors}")
                    labels = [t.get_text() for t in line.get_ticklabels()]
                    self.assertEqual(len(labels), len(set(labels)), f"{metric} {errors}")
                    box = line.get_tightbbox(canvas.get_renderer())
                    self.assertGreaterEqual(box.x0, 0, f"{metric} {errors}")
                    self.assertGreaterEqual(box.y0, 0, f"{metric} {errors}")


if __name__ == "__main__":
    unittest.main()
