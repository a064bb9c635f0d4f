# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.closed_forms import Roulette, bk_variance, ubk_variance
from figurekit.intervals import Interval, ratio
from figurekit.known import rows_of
from figurekit.plotting import curve, legend_below, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Bhanot and Kennedy's estimator and its symmetrised form in fluctuating media",
    reported="The symmetrised form (U-BK) is never above; the plain one's best pivot moves right when factors vary more, U-BK's stays at tau and is flat around it.",
    settings="c = K = 2, exact, tau = 1 (tau = 4 is the same times e^-6), variance of one factor 0, 1e-4, 1e-2, 0.1, 1 (the paper's are unknown); measured on "
             "2 x, tau = 1, where a factor has the variance 1/3.",
    seconds=30)

ROULETTE = Roulette(2)
SPREADS = (0.0, 1e-4, 1e-2, 0.1, 1.0)


def make(run: Run) -> None:
    fine = np.linspace(-1.0, 2.0, 61)
    plot, axes = panels(2, 2, titles=["Bhanot-Kennedy", "U-BK"])
    table, best = [], {}
    for panel, (name, variance) in zip(axes, (("bhanot-kennedy", bk_variance), ("u-bk", ubk_variance))):
        for index, spread in enumerate(SPREADS):
            values = [variance(ROULETTE, -1 - d, d, spread, 1.0) for d in fine]
            table += [{"estimator": name, "factor_variance": spread, "delta": d, "variance": v} for d, v in zip(fine, values)]
            best[name, spread] = float(fine[int(np.argmin(values))])
            curve(panel, list(fine), [max(v, 1e-30) for v in values], index, f"{spread:g}", marks="")
            panel.plot([best[name, spread]], [max(min(values), 1e-9)], "ko", markersize=3.5)
        panel.set_ylim(1e-9, 10)
        log_axes(panel, x=False)
        panel.set_xlabel("delta: pivot - tau", fontsize=8)
    axes[0].set_ylabel("variance", fontsize=8)
    legend_below(plot, axes[0], 5, 0.3)
    run.plot(plot)
    run.table(table)
    for known in rows_of("fluctuating_media"):
        for law, variance in (("bk", bk_variance), ("ubk", ubk_variance)):
            run.expect(f"{law}, s2 = {known['s2']}, delta = {known['delta']}", known[law],
                       variance(ROULETTE, -1 - float(known["delta"]), float(known["delta"]), float(known["s2"]), 1.0))
    for law in (bk_variance, ubk_variance):
        run.expect("variance at tau = 4 over that at 1", "2.479e-3", law(ROULETTE, -4.3, 0.3, 0.1, 4.0) / law(ROULETTE, -1.3, 0.3, 0.1, 1.0))
    worst = max(ubk_variance(ROULETTE, -1 - d, d, s, 1.0) / bk_variance(ROULETTE, -1 - d, d, s, 1.0) for s in SPREADS[1:] for d in fine)
    run.claim("U-BK is never above, largest variance over the plain one's", Interval.exact(worst), below=1 + 1e-9)
    run.claim("the plain one's best pivot moves right, at factor variance 1", Interval.exact(best["bhanot-kennedy", 1.0]), above=0.05, unit="beyond tau")
    for spread in (1e-2, 1.0):
        loss = ubk_variance(ROULETTE, -1, 0, spread, 1.0) / min(ubk_variance(ROULETTE, -1 - d, d, spread, 1.0) for d in fine)
        run.claim(f"U-BK stays best at tau, factor variance {spread:g}: its variance there over the least of all pivots", Interval.exact(loss), below=1.1,
                  why="where factors vary as much as tau, pivots right of tau are better")
    names = ["bhanot-kennedy:pivot=fixed:pivotdepth={}:expansion=2", "u-bk:pivot=fixed:pivotdepth={}:expansion=2:tuplesize=1"]
    for pivot in (0.7, 1.0, 1.5):
        rows = run.lab("estimate", estimator=[n.format(pivot) for n in names], extinction="linear-up", depth=1, trials=run.pick(1_000_000, 100_000))
        for row, variance in zip(rows, (bk_variance, ubk_variance)):
            exact = variance(ROULETTE, -pivot, pivot - 1, 1 / 3, 1.0)
            run.expect(f"measured {row['estimator']}", f"{exact:.5e}", float(row["variance"]), float(row["variance_stderr"]))
    run.claim("in run time at the true pivot, on 2 x: variance x seconds of the plain one over U-BK's",
              time_gain(run, [n.format(1) for n in names]), above=1)
    run.time_twin([n.format(1) for n in names], extinction="linear-up", depth=1)


def time_gain(run: Run, estimators: list[str]) -> Interval:
    rows = run.lab("estimate", estimator=estimators, extinction="linear-up", depth=1, trials=run.pick(1_000_000, 100_000), seed=5)
    return ratio(*(float(r[k]) * float(r["seconds_per_estimate"]) for r in rows for k in ("variance", "variance_stderr")))
