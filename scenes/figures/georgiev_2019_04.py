# SPDX-License-Identifier: BSD-2-Clause
import math
from decimal import Context, Decimal, localcontext

from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import curve, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Terms of the plain power series",
    reported="The terms of the series of exp(-tau) alternate and grow far beyond the sum before they fall; prefix sums converge late.",
    settings="Optical depths of T = 0.1 and T = 1e-10. Over time: series estimators with a control instead, a constant medium, T = 0.1, control 2 tau.",
    seconds=5)

# Transmittance, and the largest term of its series.
CASES = ((0.1, "2.65"), (1e-10, "8.3e8"))


def terms(depth: float, count: int) -> tuple[list[float], list[float]]:
    """Terms and their prefix sums, in 60 digits: in double precision the sum of 1e-10 drowns in the rounding of terms of 8e8."""
    with localcontext(Context(prec=60)):
        found, sums = [Decimal(1)], [Decimal(1)]
        for k in range(1, count):
            found.append(-found[-1] * Decimal(depth) / k)
            sums.append(sums[-1] + found[-1])
        return [float(t) for t in found], [float(s) for s in sums]


def make(run: Run) -> None:
    plot, axes = panels(2, 2, titles=[f"T = {t:g}" for t, _ in CASES])
    rows = []
    for panel, (transmittance, largest) in zip(axes, CASES):
        depth = -math.log(transmittance)
        series, sums = terms(depth, 200)
        rows += [{"transmittance": transmittance, "k": k, "term": series[k], "prefix_sum": sums[k]} for k in range(len(series))]
        shown = range(12 if depth < 10 else 80)
        curve(panel, list(shown), [series[k] for k in shown], 0, "term")
        curve(panel, list(shown), [sums[k] for k in shown], 1, "prefix sum")
        panel.set_xlabel("k")
        panel.legend(fontsize=7, frameon=False)
        if depth > 10:
            panel.set_yscale("symlog", linthresh=1e-2)
            panel.set_yticks([s * 10.0**e for s, e in ((-1, 8), (-1, 4), (-1, 0), (1, 0), (1, 4), (1, 8))])
        run.expect(f"largest term, T = {transmittance:g}", largest, max(map(abs, series)))
        first = next(k for k in range(len(sums)) if all(abs(s - transmittance) <= 0.1 * transmittance for s in sums[k:]))
        run.claim(f"T = {transmittance:g}: terms are larger than the sum, |largest| / T", Interval.exact(max(map(abs, series)) / transmittance), above=1)
        run.claim(f"T = {transmittance:g}: prefix sums are within 10 % of T only after k = tau, first such k / tau", Interval.exact(first / depth), above=1)
    run.table(rows)
    run.plot(plot)
    run.time_twin(["p-series-next-flight", "p-series-cumulative", "p-series-cmf", "ratio"], extinction="constant", depth=-math.log(0.1), control=2)
