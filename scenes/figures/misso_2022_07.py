# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from compare.slope import slope_of
from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio
from figurekit.plotting import curve, log_axes, panels
from figurekit.programs import Row
from figurekit.run import Run

FIGURE = Figure(
    title="Correlated corrections",
    reported="The variance of corrections between levels of a march falls like 1 / points when both are independent and like its square when one is read off the other's "
             "points; only so the work-normalised variance of the series stays finite.",
    settings="medialab levels: exp(-integral) of the cosine of mean 1 (the paper's noise is unknown), 2^j points at level j; independent marches, and odd and even halves of one set "
             "of random points or of one comb, which is drawn from 1e-16 on.",
    seconds=40)

INDEPENDENT, HALVES, COMB = "independent marches", "odd and even points", "one comb"


def corrections(run: Run, seed: int, trials: int, levels: int) -> dict[str, list[Row]]:
    """Rows of the levels, by kind."""
    found = {}
    for kind, comb, coupling in ((INDEPENDENT, "independent", "independent"), (HALVES, "independent", "split"), (COMB, "equidistant", "split")):
        rows = run.lab("levels", estimator=f"debiased-ray-marching:n=1:levels=0:comb={comb}", extinction="cosine", depth=1, levels=levels, trials=trials, seed=seed)
        found[kind] = [r for r in rows if r["coupling"] == coupling]
    return found


def points(rows: list[Row]) -> list[float]:
    """Of the finer march."""
    return [2 * float(r["teeth"]) for r in rows]


def work(row: Row) -> float:
    """What a level adds to the work-normalised variance."""
    return float(row["variance"]) * 2 * float(row["teeth"]) / float(row["probability"])


def make(run: Run) -> None:
    levels, trials = run.pick(9, 7), run.pick(40_000, 8_000)
    found = corrections(run, 1, trials, levels)
    plot, (left, right) = panels(2, 2, titles=["variance of the correction", "variance × points / probability of the level"])
    for index, (kind, rows) in enumerate(found.items()):
        curve(left, points(rows), [float(r["variance"]) for r in rows], index, kind)
        curve(right, points(rows), [work(r) for r in rows], index, kind)
    for panel in (left, right):
        log_axes(panel)
        panel.set_ylim(1e-16 if panel is left else 1e-10, None)
        panel.set_xlabel("points of the finer march", fontsize=8)
    left.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table([{"kind": kind, **row} for kind, rows in found.items() for row in rows])
    repeats = [corrections(run, seed, trials // 8, levels) for seed in range(2, 10)]
    for kind, slope, what in ((INDEPENDENT, -1, "independent: slope -1 of the variance over points"), (HALVES, -2, "read off the same points: slope -2")):
        slopes = [slope_of(points(r[kind])[2:], [float(row["variance"]) for row in r[kind]][2:]) for r in repeats]
        slopes = [s for s in slopes if s is not None]
        run.expect(f"slope of the variance, {kind}", f"{slope}.0", float(np.mean(slopes)), float(np.std(slopes, ddof=1)) / math.sqrt(len(slopes)))
        run.claim(what, Interval.mean(slopes), above=slope - 0.15, below=slope + 0.15)
    run.claim("one comb falls faster still: its variance at level 4 over that of random points",
              ratio(*(float(found[kind][4][c]) for kind in (COMB, HALVES) for c in ("variance", "variance_stderr"))), below=0.1)
    run.claim("independent: the work-normalised variance grows from level to level, last over first", Interval.exact(work(found[INDEPENDENT][-1]) / work(found[INDEPENDENT][0])), above=1)
    run.claim("one comb: it falls, last over first", Interval.exact(work(found[COMB][-1]) / work(found[COMB][0])), below=1)
    names = [f"debiased-ray-marching:levels=0:reuse={r}:comb={c}" for c, r in (("independent", "false"), ("independent", "true"), ("equidistant", "true"))]
    measured = run.lab("estimate", estimator=names, extinction="cosine", depth=1, trials=run.pick(1_000_000, 100_000))
    run.unbiased(measured)
    run.claim("in a whole estimator, variance x seconds without reading off (random points) over that with it",
              ratio(*(float(r[c]) * float(r["seconds_per_estimate"]) for r in measured[:2] for c in ("variance", "variance_stderr"))), above=1,
              why="its infinite variance lies in levels that no run of this size draws")
    run.time_twin(names, extinction="cosine", depth=1, doublings=run.pick(12, 8))
