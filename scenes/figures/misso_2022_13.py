# SPDX-License-Identifier: BSD-2-Clause
from figurekit.catalogue import Figure
from figurekit.intervals import ratio
from figurekit.plotting import curve, legend_below, log_axes, panels
from figurekit.programs import Row
from figurekit.run import Run

FIGURE = Figure(
    title="Unbiased reciprocals",
    reported="Estimates of the reciprocal of a probability for specular manifold sampling by a Taylor series, by Bernoulli trials and by telescoping, at equal time; settings and "
             "numbers are not in the text.",
    settings="A problem of ours instead, without manifolds: 1/F of the integral F = 1 of four densities, control 1.5 times the largest; variance x seconds of single estimates.",
    seconds=15)

FUNCTIONS = ("composite-sine", "gaussian-m23", "step", "fractal-a")
ESTIMATORS = ("reciprocal-bernoulli", "reciprocal-p-cumulative", "reciprocal-taylor", "reciprocal-telescoping")


def work(row: Row, unit: str) -> tuple[float, float]:
    return float(row["variance"]) * float(row[unit]), float(row["variance_stderr"]) * float(row[unit])


def make(run: Run) -> None:
    rows = run.lab("estimate", quantity="reciprocal", estimator=list(ESTIMATORS), extinction=list(FUNCTIONS), depth=1, control=1.5, trials=run.pick(200_000, 20_000))
    run.unbiased(rows)
    run.table(rows)
    plot, axes = panels(2, 2, (3.9, 2.6), ["variance × look-ups", "variance × seconds"])
    for panel, unit in zip(axes, ("lookups", "seconds_per_estimate")):
        for index, name in enumerate(ESTIMATORS):
            found = [next(r for r in rows if r["estimator"] == name and r["extinction"] == f) for f in FUNCTIONS]
            curve(panel, list(range(len(FUNCTIONS))), [work(r, unit)[0] for r in found], index, name)
        panel.set_xticks(range(len(FUNCTIONS)), FUNCTIONS, fontsize=6.5)
        log_axes(panel, x=False)
    legend_below(plot, axes[0], 4, 0.3)
    run.plot(plot)
    for function in FUNCTIONS:
        cell = {str(r["estimator"]): r for r in rows if r["extinction"] == function}
        for name in ESTIMATORS[2:]:
            for word, unit in (("look-ups", "lookups"), ("seconds", "seconds_per_estimate")):
                run.claim(f"{function}: {name} is better than Bernoulli trials, variance x {word} of these over its", ratio(*work(cell[ESTIMATORS[0]], unit), *work(cell[name], unit)), above=1,
                          why="terms of the series take more time than trials, and on a density that jumps it needs many")
    run.untested("in specular manifold sampling", "no integrator of ours samples manifolds")
    run.time_twin(list(ESTIMATORS), quantity="reciprocal", extinction=["composite-sine", "step"], depth=1, control=1.5, doublings=run.pick(10, 7))
