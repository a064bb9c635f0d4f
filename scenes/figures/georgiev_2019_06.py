# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.closed_forms import poisson, tracking_variance
from figurekit.intervals import Interval, ratio
from figurekit.plotting import curve, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Which terms ratio and residual ratio tracking pick",
    reported="Single-term estimators pick term k by a Poisson law; residual ratio tracking's is much closer to where the terms are than ratio tracking's.",
    settings="Extinction 15 (1 + 0.2 cos(20 x + 0.8)) (the paper's sinusoid is unknown), control 18, lower control 12: the terms have mean 3, ratio tracking picks "
             "with mean 18, residual with mean 6. Over time: both.",
    seconds=8)


def extinction(x: np.ndarray) -> np.ndarray:
    return 15 * (1 + 0.2 * np.cos(20 * x + 0.8))


def make(run: Run) -> None:
    x = np.linspace(0, 1, 2001)
    table = run.text_file("sinusoid.csv", "x,density\n" + "".join(f"{a:.17g},{b:.17g}\n" for a, b in zip(x, extinction(x))))
    k = np.arange(41)
    laws = {"terms (mean 3)": poisson(3, 40), "ratio tracking (mean 18)": poisson(18, 40), "residual ratio tracking (mean 6)": poisson(6, 40)}
    plot, (left, right) = panels(2, 2, titles=["extinction and controls", "probability of k"])
    left.plot(x, extinction(x), color="#444444", linewidth=1.3)
    for level, name in ((18, "upper"), (12, "lower")):
        left.axhline(level, color="#d55e00", linewidth=1, linestyle="--")
        left.text(1, level + 0.2, name, ha="right", fontsize=7)
    left.set_ylim(0, 20)
    for index, (name, law) in enumerate(laws.items()):
        curve(right, list(k), list(law), index, name)
    right.set_xlabel("k")
    right.set_ylim(0, 0.34)
    right.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table([{"k": int(i), **{name: law[i] for name, law in laws.items()}} for i in k])
    target, wide, close = laws.values()
    overlap = [float(np.minimum(target, law).sum()) for law in (wide, close)]
    run.claim("residual tracking overlaps the terms more, shared probability over ratio tracking's", Interval.exact(overlap[1] / overlap[0]), above=1)
    depth = float(np.trapezoid(extinction(x), x) if hasattr(np, "trapezoid") else np.trapz(extinction(x), x))
    top, bottom = float(extinction(x).max()), float(extinction(x).min())
    problem = {"files": [table], "extinction": str(table), "depth": depth, "control": 18 / float(extinction(x).max()), "lower": 12 / float(extinction(x).min())}
    exact = [tracking_variance(extinction, 1, 18), tracking_variance(extinction, 1, 18, 12)]
    # Ratio tracking's own variance lies in events of some 1e-6, which no run of this size sees.
    row, = run.lab("estimate", trials=run.pick(2_000_000, 200_000), estimator="residual-ratio", **problem)
    run.expect("variance of residual-ratio", f"{exact[1]:.4e}", float(row["variance"]), float(row["variance_stderr"]))
    run.expect("look-ups of residual-ratio", "6.00", float(row["lookups"]), math.sqrt(6 / float(row["trials"])))
    run.claim("variance of ratio tracking (exact) over residual ratio tracking's", ratio(exact[0], 0, float(row["variance"]), float(row["variance_stderr"])), above=1)
    run.time_twin(["ratio", "residual-ratio"], doublings=run.pick(12, 8), **problem)
