# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio
from figurekit.plotting import curve, legend_below, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Controls that do not bound, with table 2",
    reported="Below the extinction ratio tracking, next-flight and MIS explode, p-series cumulative alone does not blow up at a tenth, p-CMF is slightly worse.",
    settings="Instead of the paper's vase: canonical functions, T = 0.5, controls 0.1 to 5 times the largest extinction; variance times look-ups. Track-length "
             "needs bounds. The digits of table 2 are not compared: its text is corrupt.",
    seconds=60)

FRACTIONS = (0.1, 0.3, 0.6, 1.0, 1.5, 2.5, 5.0)
ESTIMATORS = ["track-length", "ratio", "next-flight", "unidirectional-mis", "bidirectional-mis", "p-series-cumulative", "p-series-cmf"]
FUNCTIONS = {"cosine": lambda x: (1 + np.cos(20 * x + 0.8)) / 1.0105719571588858, "gaussian": None, "linear-up": lambda x: 2 * x}
DEPTH = math.log(2)


def exact_ratio(function: str, fraction: float) -> float:
    """Variance of ratio tracking: exp(-bar + integral of (bar - mu)^2 / bar) - T^2."""
    x = (np.arange(400_000) + 0.5) / 400_000
    mu = DEPTH * FUNCTIONS[function](x)
    largest = {"cosine": 2 / 1.0105719571588858, "linear-up": 2}[function]
    bar = fraction * largest * DEPTH
    return math.exp(-bar + float(((bar - mu)**2).mean()) / bar) - 0.25


def make(run: Run) -> None:
    rows = run.lab("estimate", estimator=ESTIMATORS, extinction=list(FUNCTIONS), depth=DEPTH, control=FRACTIONS, trials=run.pick(400_000, 30_000))
    run.table(rows)
    plot, axes = panels(3, 3, (2.6, 2.5), list(FUNCTIONS))
    for panel, function in zip(axes, FUNCTIONS):
        for index, name in enumerate(ESTIMATORS):
            found = [r for r in rows if r["extinction"] == function and r["estimator"] == name and (name != "track-length" or float(r["control"]) >= 1)]
            curve(panel, [float(r["control"]) for r in found], [float(r["inverse_efficiency_lookups"]) for r in found], index, name)
        log_axes(panel)
        panel.set_xlabel("control / largest", fontsize=7)
        panel.tick_params(labelsize=7)
    axes[0].set_ylabel("variance × look-ups", fontsize=7)
    legend_below(plot, axes[0], 4)
    run.plot(plot)

    def row(name: str, function: str, fraction: float) -> dict:
        return next(r for r in rows if r["estimator"] == name and r["extinction"] == function and r["control"] == fraction)

    def against(name: str, function: str, fraction: float, other: float) -> Interval:
        """Variance x cost at one control over that at another."""
        a, b = row(name, function, fraction), row(name, function, other)
        return ratio(*(float(r[c]) * float(r["lookups"]) for r in (a, b) for c in ("variance", "variance_stderr")))
    for name in ("ratio", "next-flight", "unidirectional-mis", "p-series-cmf"):
        a, b = row(name, "cosine", 0.1), row("p-series-cumulative", "cosine", 0.1)
        run.claim(f"cosine, control a tenth of the largest extinction: {name} is worse than p-series cumulative, variance x look-ups over its",
                  ratio(*(float(r[c]) * float(r["lookups"]) for r in (a, b) for c in ("variance", "variance_stderr"))), above=1,
                  why="where the whole control is a fraction of a look-up, a series that certainly has some terms pays")
    for name in ("ratio", "next-flight", "unidirectional-mis", "p-series-cumulative"):
        run.claim(f"cosine: {name} {'does not blow up' if name == 'p-series-cumulative' else 'explodes'} at a tenth, variance x look-ups over that at 1",
                  against(name, "cosine", 0.1, 1), **({"below": 10} if name == "p-series-cumulative" else {"above": 10}),
                  why="at an optical depth of 0.7 ratio tracking's growth is mild: it is exponential in the depth")
    run.claim("no estimate is NaN or infinite, share", Interval.exact(sum(float(r["non_finite"]) for r in rows) / sum(float(r["trials"]) for r in rows)), below=1e-12)
    for function in ("cosine", "linear-up"):
        for fraction in (0.6, 1.0, 1.5, 2.5, 5.0):
            found = row("ratio", function, fraction)
            run.expect(f"variance of ratio tracking on {function}, control {fraction}", f"{exact_ratio(function, fraction):.4e}", float(found["variance"]),
                       float(found["variance_stderr"]))
    run.time_twin(ESTIMATORS[1:], extinction="cosine", depth=DEPTH, control=[0.3, 2.5], doublings=run.pick(10, 7))
