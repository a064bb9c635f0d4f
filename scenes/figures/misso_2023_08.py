# SPDX-License-Identifier: BSD-2-Clause
import math

from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio
from figurekit.known import rows_of
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Adaptive ratio tracking",
    reported="A rate that follows the null extinction last seen is always better than ratio tracking, by a factor that stays the same at every number of samples.",
    settings="Control 1.5 times the largest extinction, tau = 1, four functions; squared error x look-ups of the mean of N estimates.",
    seconds=40)


def make(run: Run) -> None:
    plot, axes = panels(4, 4, (1.9, 2.4), [k["function"] for k in rows_of("adaptive_ratio")])
    table = []
    for panel, known in zip(axes, rows_of("adaptive_ratio")):
        function = known["function"]
        rows = run.lab("estimate", estimator=["ratio", "adaptive-ratio"], extinction=function, depth=1, control=1.5, trials=run.pick(4_000_000, 200_000))
        run.unbiased(rows)
        for row, name in zip(rows, ("ratio", "adaptive")):
            errors = float(row["variance_stderr"]), math.sqrt(4 * float(row["lookups"]) / float(row["trials"]))
            run.expect(f"variance of {name} on {function}", known[f"{name}_mse"], float(row["variance"]), errors[0], errors[0] / 3)
            run.expect(f"look-ups of {name} on {function}", known[f"{name}_cost"], float(row["lookups"]), errors[1])
        gain = ratio(*(float(r[c]) * float(r["lookups"]) for r in rows for c in ("variance", "variance_stderr")))
        products = [float(r["variance"]) * float(r["lookups"]) for r in rows]
        shares = [math.hypot(float(r["variance_stderr"]) / float(r["variance"]), math.sqrt(4 / (float(r["lookups"]) * float(r["trials"])))) for r in rows]
        for name, product, share in zip(("ratio", "adaptive"), products, shares, strict=True):
            run.expect(f"variance x look-ups of {name} on {function}", known[f"{name}_product"], product, product * share, product * share / 3)
        factor, share = products[0] / products[1], math.hypot(*shares)
        run.expect(f"gain of adaptive on {function}", known["gain"], factor, share * factor, share * factor / 3)
        run.claim(f"{function}: variance x look-ups of ratio tracking over adaptive's", gain, above=1)
        run.claim(f"{function}: the same in run time", ratio(*(float(r[c]) * float(r["seconds_per_estimate"]) for r in rows for c in ("variance", "variance_stderr"))), above=1,
                  why="a step of changing rate costs more than the look-ups it saves")
        curves = run.lab("converge", estimator=["ratio", "adaptive-ratio"], extinction=function, depth=1, control=1.5, doublings=run.pick(14, 10), trials=run.pick(256, 64))
        table += curves
        for index, name in enumerate(("ratio", "adaptive-ratio")):
            found = [r for r in curves if r["estimator"] == name]
            curve(panel, [float(r["samples"]) for r in found], [float(r["rmse"])**2 * float(r["lookups"]) / float(r["samples"]) for r in found], index, name)
            slope, error = float(found[0]["slope_samples"]), float(found[0]["slope_samples_stderr"])
            run.claim(f"{function}: slope of the squared error of {name}", Interval.of(2 * slope, 2 * error), above=-1.15, below=-0.85)
        log_axes(panel)
        panel.set_xlabel("samples", fontsize=7)
        panel.tick_params(labelsize=7)
    axes[0].set_ylabel("squared error × look-ups of one", fontsize=7)
    axes[0].legend(fontsize=6.5, frameon=False)
    run.plot(plot)
    run.table(table)
    run.time_twin(["ratio", "adaptive-ratio"], extinction=["composite-sine", "linear-up"], depth=1, control=1.5)
