# SPDX-License-Identifier: BSD-2-Clause

import numpy as np

from figurekit.catalogue import Figure
from figurekit.closed_forms import ratio_variance
from figurekit.intervals import Interval, ratio
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Three regimes of a control",
    reported="A control above the extinction makes weights decay, one between half and all of it makes them alternate and decay, a lower one alternate and grow.",
    settings="Constant extinction, controls 1.3, 0.7, 0.3 times it; right the variance of ratio tracking against distance for controls 2, 1, 0.7, 0.2, exact, marks "
             "measured. The rendered insets need assets that are not public.",
    seconds=10)


def make(run: Run) -> None:
    steps = np.arange(9)
    plot, (left, right) = panels(2, 2, titles=["weight after n look-ups", "variance against distance"])
    rows = []
    for index, control in enumerate((1.3, 0.7, 0.3)):
        weights = (1 - 1 / control)**steps
        curve(left, list(steps), list(weights), index, f"control {control:g}")
        rows += [{"control": control, "n": int(n), "weight": w} for n, w in zip(steps, weights)]
    left.set_yscale("symlog", linthresh=1)
    left.legend(fontsize=7, frameon=False)
    run.expect("factor at 0.7", "-0.43", 1 - 1 / 0.7)
    run.expect("factor at 0.3", "-2.33", 1 - 1 / 0.3)
    run.claim("1.3: weights decay, factor", Interval.exact(1 - 1 / 1.3), above=0, below=1)
    run.claim("0.7: weights alternate and decay, factor", Interval.exact(1 - 1 / 0.7), above=-1, below=0)
    run.claim("0.3: weights alternate and grow, factor", Interval.exact(1 - 1 / 0.3), below=-1)
    distances = np.linspace(0.1, 6, 60)
    for index, control in enumerate((2.0, 1.0, 0.7, 0.2)):
        curve(right, list(distances), [ratio_variance(d, control * d) for d in distances], index, f"control {control:g}", marks="")
        for depth in (0.5, 1.0, 2.0):
            row, = run.lab("estimate", estimator="ratio", extinction="constant", depth=depth, control=control, trials=run.pick(1_000_000, 100_000))
            right.plot([depth], [float(row["variance"])], "ks", markersize=2.5)
            run.unbiased([row])
            if control >= 0.7:  # below, the variance lies in rare events
                run.expect(f"variance, control {control}, distance {depth}", f"{ratio_variance(depth, control * depth):.5e}", float(row["variance"]), float(row["variance_stderr"]))
    log_axes(right, x=False)
    right.set_xlabel("distance", fontsize=8)
    right.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table(rows)
    for control, word, limits in ((0.7, "falls", {"below": 1}), (0.2, "grows", {"above": 1})):
        run.claim(f"control {control:g}: variance {word} with distance, that at 6 over that at 3", Interval.exact(ratio_variance(6, 6 * control) / ratio_variance(3, 3 * control)), **limits)
    pair = [run.lab("estimate", estimator="ratio", extinction="constant", depth=2, control=c, trials=run.pick(1_000_000, 100_000))[0] for c in (0.7, 2.0)]
    run.claim("in run time at distance 2: variance x seconds of control 0.7 over that of 2",
              ratio(*(float(r[c]) * float(r["seconds_per_estimate"]) for r in pair for c in ("variance", "variance_stderr"))), above=1)
    run.time_twin(["ratio"], extinction="constant", depth=2, control=[2, 1, 0.7, 0.3])
