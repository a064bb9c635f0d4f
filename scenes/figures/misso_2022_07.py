# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from compare.slope import slope_of
from figurekit.catalogue import Figure
from figurekit.closed_forms import cosine
from figurekit.intervals import Interval, ratio
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Correlated corrections",
    reported="The variance of corrections between levels of a march falls like 1 / points when both are independent and like its square when one is read off the other's "
             "points; only so the work-normalised variance of the series stays finite.",
    settings="exp(-integral) of the cosine of mean 1 (the paper's noise is unknown), 2^j points at level j; independent marches, and odd and even halves of one set "
             "of random points or of one comb. Drawn here in Python; over time the estimators of medialab.",
    seconds=20)

RATE = 0.65


def depths(rng: np.random.Generator, trials: int, count: int, comb: bool) -> np.ndarray:
    """Terms of marches, [trial, point]."""
    at = (np.arange(count) + rng.random((trials, 1))) / count if comb else rng.random((trials, count))
    return cosine(at)


def corrections(rng: np.random.Generator, trials: int, level: int, kind: str) -> np.ndarray:
    count = 2**level
    fine = depths(rng, trials, 2 * count, kind == "one comb")
    if kind == "independent marches":
        return np.exp(-fine.mean(axis=1)) - np.exp(-depths(rng, trials, count, False).mean(axis=1))
    halves = [np.exp(-fine[:, k::2].mean(axis=1)) for k in (0, 1)]
    return np.exp(-fine.mean(axis=1)) - (halves[0] + halves[1]) / 2


def make(run: Run) -> None:
    levels, trials = range(run.pick(9, 7)), run.pick(40_000, 8_000)
    plot, (left, right) = panels(2, 2, titles=["variance of the correction", "variance × points / probability of the level"])
    rows, found = [], {}
    for index, kind in enumerate(("independent marches", "odd and even points", "one comb")):
        rng = np.random.default_rng([3, index])
        values = []
        for level in levels:
            drawn = corrections(rng, trials, level, kind)
            values.append(float(drawn.var()))
            rows.append({"kind": kind, "level": level, "points": 2**(level + 1), "variance": values[-1], "mean": float(drawn.mean()), "mean_stderr": float(drawn.std() / np.sqrt(trials))})
        found[kind] = values
        points = [2.0**(level + 1) for level in levels]
        curve(left, points, [max(v, 1e-22) for v in values], index, kind)
        curve(right, points, [max(v, 1e-22) * p / (RATE * (1 - RATE)**level) for v, p, level in zip(values, points, levels)], index, kind)
    for panel in (left, right):
        log_axes(panel)
        panel.set_ylim(1e-16 if panel is left else 1e-10, None)
        panel.set_xlabel("points of the finer march", fontsize=8)
    left.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table(rows)
    points = [2.0**(level + 1) for level in levels]
    groups = {}
    for kind in ("independent marches", "odd and even points"):
        slopes = []
        for seed in range(8):
            rng = np.random.default_rng([5, seed])
            slope = slope_of(points[2:], [float(corrections(rng, max(500, trials // 8), level, kind).var()) for level in levels][2:])
            assert slope is not None
            slopes.append(slope)
        groups[kind] = Interval.mean(slopes)
    run.claim("independent: slope -1 of the variance over points", groups["independent marches"], above=-1.15, below=-0.85)
    run.claim("read off the same points: slope -2", groups["odd and even points"], above=-2.15, below=-1.85)
    comb = [v for v in found["one comb"] if v > 1e-30]
    run.claim("one comb falls faster still: its variance at level 4 over that of random points", Interval.exact((comb[4] if len(comb) > 4 else 0) / found["odd and even points"][4]), below=0.1)
    # A level's share of the work-normalised variance grows like 2^j (1 - r)^-j times the variance.
    growth = [v * p / (1 - RATE)**level for v, p, level in zip(found["independent marches"], points, levels)]
    run.claim("independent: the work-normalised variance grows from level to level, last over first", Interval.exact(growth[-1] / growth[0]), above=1)
    growth = [v * p / (1 - RATE)**level for v, p, level in zip(found["one comb"], points, levels)]
    run.claim("one comb: it falls, last over first", Interval.exact(growth[-1] / growth[0]), below=1)
    names = [f"debiased-ray-marching:levels=0:reuse={r}:comb={c}" for c, r in (("independent", "false"), ("independent", "true"), ("equidistant", "true"))]
    measured = run.lab("estimate", estimator=names, extinction="cosine", depth=1, trials=run.pick(1_000_000, 100_000))
    run.unbiased(measured)
    run.claim("in a whole estimator, variance x seconds without reading off (random points) over that with it",
              ratio(*(float(r[c]) * float(r["seconds_per_estimate"]) for r in measured[:2] for c in ("variance", "variance_stderr"))), above=1,
              why="its infinite variance lies in levels that no run of this size draws")
    run.time_twin(names, extinction="cosine", depth=1, doublings=run.pick(12, 8))
