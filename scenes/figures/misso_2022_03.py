# SPDX-License-Identifier: BSD-2-Clause
import time

import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Integrals of power laws",
    reported="The mean of x^-alpha at uniform points converges with a slope of -1/2 while the variance is finite (alpha below 1/2) and of -(1 - alpha) above.",
    settings="medialab power-law: alpha = 0.4, 0.6, 0.8, 0.9; means of 1 to 2^18 points (the paper: 2^14 to 2^21), mean relative error of 1000 trials, slopes of the larger half of "
             "the sizes. Over time: the seconds that numpy takes to draw as many points.",
    seconds=40)

ALPHAS = (0.4, 0.6, 0.8, 0.9)


def seconds_of_a_point(count: int = 1 << 20) -> float:
    rng, begin = np.random.default_rng(1), time.process_time()
    np.power(1 - rng.random(count), -0.5).sum()
    return (time.process_time() - begin) / count


def make(run: Run) -> None:
    rows = run.lab("power-law", alpha=ALPHAS, doublings=run.pick(18, 13), trials=run.pick(1000, 250))
    plot, (panel,) = panels(1, 1, (5, 3.2))
    twin, (timed,) = panels(1, 1, (5, 3.2))
    seconds = seconds_of_a_point()
    for index, alpha in enumerate(ALPHAS):
        found = [r for r in rows if r["alpha"] == alpha]
        sizes, errors, expected = [float(r["samples"]) for r in found], [float(r["error"]) for r in found], float(found[0]["expected_slope"])
        slope = Interval.of(float(found[0]["slope"]), float(found[0]["slope_stderr"]))
        curve(panel, sizes, errors, index, f"alpha = {alpha:g}: {slope.value:.2f}", [float(r["error_stderr"]) for r in found])
        curve(timed, [seconds * n for n in sizes], errors, index, f"alpha = {alpha:g}")
        panel.plot(sizes, [errors[-1] * (n / sizes[-1])**expected for n in sizes], ":", color="#999999", linewidth=0.8)
        run.expect(f"slope, alpha = {alpha:g}", f"{max(-0.5, alpha - 1):.1f}", float(found[0]["slope"]), float(found[0]["slope_stderr"]))
        run.claim(f"alpha = {alpha:g}: slope {expected:g}, ours", slope, above=expected - 0.1, below=expected + 0.1, why="means of few trials lack the largest values")
    for axes, name in ((panel, "points"), (timed, "CPU seconds")):
        log_axes(axes)
        axes.set_xlabel(name)
        axes.set_ylabel("mean relative error")
        axes.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.time_plot(twin)
    run.table([{**r} for r in rows])
