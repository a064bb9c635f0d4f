# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio_of_means
from figurekit.particles import sweep
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Particle tracing in the analytic medium against the sampling extinction",
    reported="The adaptive scheme is never worse than the terminating and the non-terminating one; the error stops falling from a sampling extinction of 1 on, "
             "look-ups grow linearly, and the optimum is near 0.8, below the maximum.",
    settings="Equation 21, albedo 0.7, Rayleigh, under our evening sky (the paper's map is unknown); 16 paths a pixel, 40 x 40 pixels, 8 renders each; every scattering "
             "takes a light sample, whose look-ups count.",
    seconds=60)

MODELS = ("terminating", "nonterminating", "adaptive")
RATES = (0.6, 0.7, 0.8, 0.9, 1.0, 2.0)


def make(run: Run) -> None:
    found = sweep(run, "sine", MODELS, RATES, run.pick(16, 4))
    plot, (left, right) = panels(2, 2, titles=["RMSE", "squared error × look-ups"])
    for index, model in enumerate(MODELS):
        cells = [found.settings[f"{model} {r:g}"] for r in RATES]
        curve(left, RATES, [c.rmse() for c in cells], index, model)
        curve(right, RATES, [float(np.mean(c.work())) for c in cells], index, model)
    for panel in (left, right):
        log_axes(panel)
        panel.set_xlabel("sampling extinction", fontsize=8)
    left.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table(found.rows())
    run.render_twin({name: curve_ for name, curve_ in found.curves().items() if name.endswith((" 0.6", " 1"))})

    def errors(model: str, rate: float) -> list[float]:
        return found.settings[f"{model} {rate:g}"].errors
    for rate in (0.6, 0.8, 1.0):
        for other in MODELS[:2]:
            run.claim(f"adaptive is not worse than {other} at {rate:g}, squared error of adaptive over that", ratio_of_means(errors("adaptive", rate), errors(other, rate)),
                      below=1.15, why="")
    run.claim("the error stops falling from 1 on: squared error of adaptive at 2 over that at 1", ratio_of_means(errors("adaptive", 2.0), errors("adaptive", 1.0)), above=0.7, below=1.3)
    lookups = [float(np.mean(found.settings[f"adaptive {r:g}"].lookups)) for r in RATES]
    run.claim("look-ups grow linearly: those at 2 over those at 1", Interval.exact(lookups[-1] / lookups[-2]), above=1.8, below=2.2)
    run.claim("the optimum is below the maximum: squared error x look-ups of adaptive at 1 over that at 0.8", found.gain("adaptive 1", "adaptive 0.8"), above=1)
    run.claim("the same in run time", found.timed_gain("adaptive 1", "adaptive 0.8"), above=1, why="what a look-up does not cost is the same at every rate")
    run.claim("and 0.6 is beyond it: squared error x look-ups at 0.6 over that at 0.8", found.gain("adaptive 0.6", "adaptive 0.8"), above=1)
