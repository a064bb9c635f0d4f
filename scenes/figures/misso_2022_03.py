# SPDX-License-Identifier: BSD-2-Clause
import time

import numpy as np

from compare.slope import slope_of
from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Integrals of power laws",
    reported="The mean of x^-alpha at uniform points converges with a slope of -1/2 while the variance is finite (alpha below 1/2) and of -(1 - alpha) above.",
    settings="alpha = 0.4, 0.6, 0.8, 0.9; means of 2^10 to 2^18 points (the paper: 2^14 to 2^21), mean relative error of 256 trials, relative to the first.",
    seconds=20)

ALPHAS = (0.4, 0.6, 0.8, 0.9)
FIRST = 10


def errors(alpha: float, trials: int, doublings: int) -> tuple[np.ndarray, np.ndarray]:
    """Relative errors of the means of 2^FIRST ... points, [trial, size], and seconds of each size."""
    exact, found, seconds = 1 / (1 - alpha), np.zeros((trials, doublings + 1)), np.zeros(doublings + 1)
    for trial in range(trials):
        rng, total, count = np.random.default_rng([7, trial, round(alpha * 100)]), 0.0, 0
        begin = time.process_time()
        for step in range(doublings + 1):
            size = 2**(FIRST + step) - count
            # 1 - u is never 0.
            total += float(np.power(1 - rng.random(size), -alpha).sum())
            count += size
            found[trial, step] = abs(total / count - exact) / exact
            seconds[step] += (time.process_time() - begin) / trials
    return found, seconds


def make(run: Run) -> None:
    trials, doublings = run.pick((256, 8), (64, 7))
    sizes = [2.0**(FIRST + s) for s in range(doublings + 1)]
    plot, (panel,) = panels(1, 1, (5, 3.2))
    twin, (timed,) = panels(1, 1, (5, 3.2))
    rows = []
    for index, alpha in enumerate(ALPHAS):
        found, seconds = errors(alpha, trials, doublings)
        mean = found.mean(axis=0)
        rows += [{"alpha": alpha, "points": n, "relative_error": e, "stderr": s} for n, e, s in zip(sizes, mean, found.std(axis=0, ddof=1) / np.sqrt(trials))]
        # Groups of trials are independent, points of one trial are not.
        groups = np.array_split(found, 16)
        slopes = [s for g in groups if (s := slope_of(sizes, list(g.mean(axis=0)))) is not None]
        expected = -min(0.5, 1 - alpha)
        slope = Interval.mean(slopes)
        curve(panel, sizes, list(mean / mean[0]), index, f"alpha = {alpha:g}: {slope.value:.2f}")
        curve(timed, list(seconds), list(mean), index, f"alpha = {alpha:g}")
        guide = [(n / sizes[0])**expected for n in sizes]
        panel.plot(sizes, guide, ":", color="#999999", linewidth=0.8)
        run.claim(f"alpha = {alpha:g}: slope {expected:g}, ours", slope, above=expected - 0.1, below=expected + 0.1, why="means of few trials lack the largest values")
    for axes, name in ((panel, "points"), (timed, "CPU seconds")):
        log_axes(axes)
        axes.set_xlabel(name)
        axes.legend(fontsize=7, frameon=False)
    panel.set_ylabel("error / first error")
    timed.set_ylabel("mean relative error")
    run.plot(plot)
    run.time_plot(twin)
    run.table(rows)
