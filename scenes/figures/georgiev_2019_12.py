# SPDX-License-Identifier: BSD-2-Clause
import math

from compare.lab_plot import lab_figure
from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio
from figurekit.known import rows_of
from figurekit.plotting import curve, legend_below, log_axes, panels
from figurekit.programs import Row
from figurekit.run import Run

FIGURE = Figure(
    title="Convergence of ratio and p-series ratio tracking with stratified samples",
    reported="Latin hypercube samples gain a factor, Hammersley points improve the slope, and p-series ratio tracking gains more from both than ratio tracking.",
    settings="The cosine, (tau, control's depth) = (1, 2.22), (1, 10), (3, 6.67); the paper's pairs are unknown. Variance of the mean of N estimates; right over seconds.",
    seconds=60)

PAIRS = ((1, 2.2222), (1, 10), (3, 6.6667))
PATTERNS = ("independent", "latinhypercube", "hammersley")
ESTIMATORS = ("ratio", "p-series-ratio")
LARGEST = 2.0
# Slopes of the variance with Hammersley points from 16 to 1024 estimates, by estimator and pair.
SLOPES = {"ratio": ("-1.5", "-1.2", "-1.2"), "p-series-ratio": ("-1.6", "-1.8", "-1.4")}


def at(rows: list[Row], count: int) -> Row:
    return next(r for r in rows if int(float(r["samples"])) == count)


def square_error(row: Row) -> tuple[float, float]:
    return float(row["rmse"])**2, 2 * float(row["rmse"]) * float(row["rmse_stderr"])


def check_gains(run: Run, found: dict) -> None:
    """Slopes with Hammersley points, and what Latin hypercubes gain at 1024 estimates: the least and the most of all pairs and estimators."""
    gains = []
    for name, slopes in SLOPES.items():
        for (depth, control), printed in zip(PAIRS, slopes, strict=True):
            (few, few_error), (many, many_error) = (square_error(at(found[depth, control, "hammersley", name], n)) for n in (16, 1024))
            run.expect(f"slope of {name}, hammersley, {depth}, {control}", printed, math.log(many / few) / math.log(64), math.hypot(few_error / few, many_error / many) / math.log(64))
            (plain, plain_error), (cube, cube_error) = (square_error(at(found[depth, control, p, name], 1024)) for p in PATTERNS[:2])
            gains.append((plain / cube, plain / cube * math.hypot(plain_error / plain, cube_error / cube)))
    for what, printed, (gain, error) in (("least", "1.7", min(gains)), ("largest", "14", max(gains))):
        run.expect(f"{what} gain of Latin hypercubes", printed, gain, error)


def make(run: Run) -> None:
    trials, doublings = run.pick(512, 256), 10
    plot, axes = panels(3, 3, (2.6, 2.5), [f"tau {t:g}, control {c:.3g}" for t, c in PAIRS])
    found: dict = {}
    for (depth, control), panel in zip(PAIRS, axes):
        for pattern in PATTERNS:
            rows = run.lab("converge", estimator=list(ESTIMATORS), extinction="cosine", paper_depth=True, depth=depth, control=control / depth / LARGEST, pattern=pattern,
                           doublings=doublings, trials=trials)
            for name in ESTIMATORS:
                curve_rows = [r for r in rows if r["estimator"] == name]
                found[depth, control, pattern, name] = curve_rows
                index = ESTIMATORS.index(name) * 3 + PATTERNS.index(pattern)
                curve(panel, [float(r["samples"]) for r in curve_rows], [float(r["rmse"])**2 for r in curve_rows], index, f"{name}, {pattern}", marks="o" if name == "ratio" else "s")
        log_axes(panel)
        panel.set_xlabel("estimates in a mean", fontsize=7)
        panel.tick_params(labelsize=7)
    legend_below(plot, axes[0], 3)
    run.plot(plot)
    table = [r for rows in found.values() for r in rows]
    run.table(table)
    for known in rows_of("stratified_means"):
        for pattern in PATTERNS:
            for name, prefix in zip(ESTIMATORS, ("ratio", "p")):
                row = at(found[float(known["tau"]), float(known["control"]), pattern, name], int(known["n"]))
                square, error = square_error(row)
                run.expect(f"{name}, {pattern}, {known['tau']}, {known['control']}, N = {known['n']}", known[f"{prefix}_{pattern}"], square, error, 0.02 * square)
    check_gains(run, found)
    for depth, control in PAIRS:
        for name in ESTIMATORS:
            last = [found[depth, control, p, name][-1] for p in PATTERNS]
            gain = ratio(*(v for r in last[:2] for v in (float(r["rmse"])**2, 2 * float(r["rmse"]) * float(r["rmse_stderr"]))))
            run.claim(f"({depth:g}, {control:.3g}) {name}: Latin hypercube gains a factor, variance of independent samples over its", gain, above=1)
            slope = [2 * float(r["slope_samples"]) for r in last]
            error = 2 * float(last[2]["slope_samples_stderr"])
            run.claim(f"({depth:g}, {control:.3g}) {name}: Hammersley points improve the slope of the variance, less that of independent ones", Interval.of(slope[2] - slope[0], 1.5 * error),
                      below=0)
        pair = [found[depth, control, "hammersley", n][-1] for n in ESTIMATORS]
        run.claim(f"({depth:g}, {control:.3g}): p-series ratio tracking gains more, variance of ratio tracking with Hammersley points over its",
                  ratio(*(v for r in pair for v in (float(r["rmse"])**2, 2 * float(r["rmse"]) * float(r["rmse_stderr"])))), above=1)
    timed = [dict(r) for (d, c, p, n), rows in found.items() if (d, c) == PAIRS[0] and p != "latinhypercube" for r in rows]
    run.table(timed, "time")
    run.time_plot(lab_figure([{k: str(v) for k, v in r.items()} for r in timed], "seconds"))
