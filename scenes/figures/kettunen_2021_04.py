# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.closed_forms import Roulette, bk_variance
from figurekit.intervals import Interval, ratio
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Inverse efficiency of Bhanot and Kennedy's roulette against the pivot, several c",
    reported="A larger c widens the range of good pivots, and raising the mean number of terms improves efficiency for every pivot.",
    settings="Constant medium, c = 0.5, 1, 2, 4, 8 (the paper's are unknown); variance / T^2 times mean orders, exact; measured at four points.",
    seconds=15)

CS = (0.5, 1, 2, 4, 8)


def work(c: float, delta: float) -> float:
    return bk_variance(Roulette(c), -delta, delta, 0.0, 0.0) * Roulette(c).mean_orders()


def make(run: Run) -> None:
    fine = np.linspace(-3, 3, 61)
    plot, (panel,) = panels(1, 1, (5.2, 3.2), ["variance / T² × mean orders"])
    table = []
    for index, c in enumerate(CS):
        values = [work(c, d) for d in fine]
        table += [{"c": c, "delta": d, "inverse_efficiency": v} for d, v in zip(fine, values)]
        curve(panel, list(fine), [max(v, 1e-14) for v in values], index, f"c = {c:g}", marks="")
    panel.set_ylim(1e-8, 1e5)
    log_axes(panel, x=False)
    panel.set_xlabel("delta: pivot - tau")
    panel.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table(table)
    far = [d for d in fine if abs(d) > 0.15]
    worst = max(work(b, d) / work(a, d) for a, b in zip(CS[1:], CS[2:]) for d in far if work(a, d) > 1e-10)
    run.claim("every doubling of c from 1 on improves every pivot: largest inverse efficiency over that of half the c", Interval.exact(worst), below=1)
    width = [float(np.ptp([d for d in np.linspace(-4, 4, 401) if work(c, d) < 1e-2])) for c in (1, 2, 4, 8)]
    run.claim("the range of pivots with an inverse efficiency below 0.01 widens with c: least growth from c to 2 c", Interval.exact(min(b / a for a, b in zip(width, width[1:]))),
              above=1)
    rows = {c: run.lab("estimate", estimator=f"bhanot-kennedy:pivot=fixed:pivotdepth=4:expansion={c}", extinction="constant", depth=3,
                       trials=run.pick(2_000_000, 200_000))[0] for c in (1, 2, 4)}
    for c, row in rows.items():
        run.expect(f"measured inverse efficiency, c = {c}, delta = 1", f"{work(c, 1.0):.5e}", float(row["variance"]) * math.exp(6) * Roulette(c).mean_orders(),
                   float(row["variance_stderr"]) * math.exp(6) * Roulette(c).mean_orders())
    seconds = [float(rows[c]["seconds_per_estimate"]) for c in (1, 4)]
    run.claim("the same in run time at delta = 1: variance x seconds of c = 1 over that of c = 4",
              ratio(*(float(rows[c][k]) * s for c, s in zip((1, 4), seconds) for k in ("variance", "variance_stderr"))), above=1)
    run.time_twin([f"bhanot-kennedy:pivot=fixed:pivotdepth=4:expansion={c:g}" for c in CS], extinction="constant", depth=3)
