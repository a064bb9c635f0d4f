# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio
from figurekit.plotting import curve, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Taylor polynomials about two pivots",
    reported="An expansion of exp of the same order is much closer about a pivot near the point where it is wanted: an illustration of why pivots matter.",
    settings="Order 2 about -2.5 and -1.2, evaluated at -1. Over time: a series of three terms' mean length about these pivots, tau = 1.",
    seconds=5)

POINT, PIVOTS = -1.0, (-2.5, -1.2)


def polynomial(x: np.ndarray | float, pivot: float) -> np.ndarray | float:
    d = x - pivot
    return math.exp(pivot) * (1 + d + d * d / 2)


def make(run: Run) -> None:
    x = np.linspace(-4, 0.5, 91)
    plot, (panel,) = panels(1, 1, (5, 3))
    curve(panel, list(x), list(np.exp(x)), 7, "exp(x)", marks="")
    for index, pivot in enumerate(PIVOTS):
        curve(panel, list(x), list(polynomial(x, pivot)), index, f"order 2 about {pivot:g}", marks="")
        panel.plot([POINT], [polynomial(POINT, pivot)], "o", color="k", markersize=4)
    panel.axvline(POINT, color="#bbbbbb", linewidth=0.8)
    panel.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table([{"x": a, "exp": math.exp(a), **{f"about {p:g}": polynomial(a, p) for p in PIVOTS}} for a in map(float, x)])
    errors = [abs(polynomial(POINT, p) - math.exp(POINT)) for p in PIVOTS]
    run.claim("error of the polynomial about the far pivot over that about the near one", Interval.exact(errors[0] / errors[1]), above=10)
    names = [f"bhanot-kennedy:pivot=fixed:pivotdepth={-p:g}:expansion=2" for p in PIVOTS]
    rows = run.lab("estimate", estimator=names, extinction="constant", depth=-POINT, trials=run.pick(1_000_000, 100_000))
    run.claim("in a roulette about these pivots, variance x seconds of the far one over the near one's",
              ratio(*(float(r[k]) * float(r["seconds_per_estimate"]) for r in rows for k in ("variance", "variance_stderr"))), above=10)
    run.time_twin(names, extinction="constant", depth=-POINT)
