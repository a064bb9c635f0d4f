# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.closed_forms import Roulette, bk_variance, ubk_variance
from figurekit.intervals import Interval
from figurekit.plotting import curve, legend_below, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Variance against the pivot for several c, little fluctuation",
    reported="The symmetrised form is never above the plain one and its range of good pivots widens with c.",
    settings="tau = 4, c = 1, 2, 4, 8, factors of variance 1e-4 (the paper's are unknown), pivots from 0 to 8, exact.",
    seconds=10)

DEPTH, SPREAD = 4.0, 1e-4
CS = (1, 2, 4, 8)


def make(run: Run) -> None:
    pivots = np.linspace(0, 8, 81)
    plot, axes = panels(2, 2, titles=["Bhanot-Kennedy", "U-BK"])
    table, curves = [], {}
    for panel, (name, variance) in zip(axes, (("bhanot-kennedy", bk_variance), ("u-bk", ubk_variance))):
        for index, c in enumerate(CS):
            values = np.array([variance(Roulette(c), -p, p - DEPTH, SPREAD, DEPTH) for p in pivots])
            curves[name, c] = values
            table += [{"estimator": name, "c": c, "pivot": p, "variance": v} for p, v in zip(pivots, values)]
            curve(panel, list(pivots), list(values), index, f"c = {c}", marks="")
            panel.plot([pivots[values.argmin()]], [values.min()], "ko", markersize=3.5)
        panel.set_ylim(1e-9, 10)
        log_axes(panel, x=False)
        panel.set_xlabel("pivot", fontsize=8)
    legend_below(plot, axes[0], 4, 0.3)
    run.plot(plot)
    run.table(table)
    run.claim("U-BK is never above, largest variance over the plain one's", Interval.exact(max(float((curves["u-bk", c] / curves["bhanot-kennedy", c]).max()) for c in CS)),
              below=1 + 1e-6)
    width = [float(np.ptp(pivots[curves["u-bk", c] < 1e-6])) if (curves["u-bk", c] < 1e-6).any() else 0.0 for c in CS]
    run.claim("the range of pivots with a variance below 1e-6 widens with c: its least growth from c to 2 c", Interval.exact(min(b - a for a, b in zip(width, width[1:]))), above=0)
    floors = [float(curves["u-bk", c].min()) for c in CS]
    run.claim("more factors pay even at the best pivot: least variance of U-BK, c = 8, over that of c = 1", Interval.exact(floors[3] / floors[0]), below=1)
    names = [f"u-bk:pivot=fixed:pivotdepth=4:expansion={c}:tuplesize=1" for c in CS]
    rows = run.lab("estimate", estimator=names, extinction="linear-up", depth=DEPTH, trials=run.pick(1_000_000, 100_000))
    for c, row in zip(CS[:3], rows):
        exact = ubk_variance(Roulette(c), -4, 0.0, DEPTH**2 / 3, DEPTH)
        if c > 1:  # below, the variance lies in rare events
            run.expect(f"measured U-BK on 8 x, c = {c}", f"{exact:.5e}", float(row["variance"]), float(row["variance_stderr"]))
    run.time_twin(names, extinction="linear-up", depth=DEPTH)
