# SPDX-License-Identifier: BSD-2-Clause
"""Debiased photon mapping, taken apart: figures 10 and 11 of Misso et al. 2022."""
from dataclasses import dataclass
from typing import Any

import numpy as np

from .derivatives import signed
from .intervals import Interval, ratio_of_medians, slope_of_medians
from .photon_series import CODE, PRINTED, Series, why_no_mean
from .plotting import curve, log_axes, panels, pictures
from .run import Run

FIXED = {"debias": "progressive", "alpha": 0.999999}
"""A kernel that hardly shrinks: the first one for all iterations."""
GROUPS = 4
"""Of seeds, each of which makes an image of medians: as many independent values."""


@dataclass(frozen=True)
class Renders:
    """Of one setting, with seeds of its own for each number of iterations."""
    iterations: list[int]
    squares: np.ndarray      # mean squared errors [size, seed]
    seconds: list[float]     # of the processor, medians
    largest: np.ndarray      # the images of the most iterations [seed, row, column, channel]

    def typical(self) -> list[float]:
        return [float(v) for v in np.sqrt(np.median(self.squares, axis=1))]

    def slope(self) -> Interval:
        return slope_of_medians([np.full(row.shape, float(n)) for n, row in zip(self.iterations, self.squares, strict=True)], list(self.squares))

    def medians(self) -> list[np.ndarray]:
        """Pixel by pixel, of each group of seeds."""
        return [np.median(g, axis=0) for g in np.array_split(self.largest, GROUPS)]


def renders(run: Run, scene: str, define: dict[str, Any], truth: np.ndarray, iterations: list[int], repeats: int) -> Renders:
    squares, seconds, images = np.zeros((len(iterations), repeats)), [], []
    for at, count in enumerate(iterations):
        found = [run.render(scene, count, seed=1 + 1000 * at + r, define=define) for r in range(repeats)]
        images = [f.pixels for f in found]
        squares[at] = [float(((p - truth)**2).mean()) for p in images]
        seconds.append(float(np.median([f.processor_seconds for f in found])))
    return Renders(iterations, squares, seconds, np.array(images))


def signed_bias(run: Run, scene: str, biased: dict[str, Any], debiased: dict[str, Any], iterations: dict[str, list[int]], repeats: int, exposure: float) -> None:
    """The image, its biased part, the signed bias that is found with either c, that which there is, and what both make; error against iterations, and over time.
    `iterations`: of the biased part, and by c. All statistics are medians over seeds, as the law of corrections has no mean for the printed c."""
    truth = run.render(scene, run.pick(2048, 512), seed=977, define={"integrator": "bdpt"}).pixels
    names = {f"c {c:g}": c for c in (PRINTED, CODE)}
    part = renders(run, scene, biased, truth, iterations["biased"], repeats)
    middle = np.median(part.largest, axis=0)
    found = {name: renders(run, scene, {**debiased, "c": c}, truth, iterations[name], repeats) for name, c in names.items()}
    bias = truth - middle
    for name, c in names.items():
        same = renders(run, scene, biased, truth, iterations[name][-1:], repeats)
        judge(run, name, Series(c), same, found[name], truth, bias, debiased["debias"] == "progressive-unbiased")
    draw(run, {"biased": part, **found}, truth, middle, exposure)


def judge(run: Run, name: str, series: Series, biased: Renders, found: Renders, truth: np.ndarray, bias: np.ndarray, is_progressive: bool) -> None:
    """`biased`: of as many iterations as the last of `found`, which has more photons."""
    middle, count, of_median = truth - bias, found.iterations[-1], len(found.largest) // GROUPS
    run.claim(f"{name}: the correction is the bias: share of the bias, pixel by pixel, that it takes away, median over renders",
              Interval.median([float(((s - middle) * bias).sum() / (bias * bias).sum()) for s in found.largest]), above=0.75, below=1.25)
    run.claim(f"{name}: blur is traded for noise: squared distance of renders from their median, debiased over biased, {count} iterations, medians",
              ratio_of_medians(spreads(found.largest), spreads(biased.largest)), above=1)
    run.claim(f"{name}: taken together, debiased renders are better: squared error of the median of {of_median}, pixel by pixel, over that of as many biased ones",
              Interval.mean([float(((d - truth)**2).mean() / ((b - truth)**2).mean()) for d, b in zip(found.medians(), biased.medians(), strict=True)]), below=1,
              why="their noise is still more than the bias")
    limit = 2 * (series.progressive_error_power() if is_progressive else series.error_power())
    run.claim(f"{name}: the error of debiased renders falls on: slope of the median squared error over iterations ({limit:.2g} in the limit)", found.slope(), above=-1.5, below=-0.5,
              why=why_no_mean(series.c) if series.error_power() >= 0 else "")


def spreads(images: np.ndarray) -> list[float]:
    """Mean squared distances from the median, pixel by pixel."""
    return [float(v) for v in ((images - np.median(images, axis=0))**2).mean(axis=(1, 2, 3))]


def draw(run: Run, found: dict[str, Renders], truth: np.ndarray, middle: np.ndarray, exposure: float) -> None:
    plot, axes = panels(8, 4, (2.5, 2.5))
    bias = truth - middle
    most = float(np.quantile(np.abs(bias), 0.99))
    debiased = {name: np.median(r.largest, axis=0) for name, r in found.items() if name != "biased"}
    shown = [("right (bdpt)", truth), ("biased part", middle), *((f"sum of both, {n}", image) for n, image in debiased.items()),
             ("signed bias, right", bias), *((f"signed bias, found, {n}", image - middle) for n, image in debiased.items())]
    for panel, (title, image) in zip(axes, shown):
        if title.startswith("signed"):
            signed(panel, image, most, title)
        else:
            pictures(panel, image, exposure)
            panel.set_title(title, fontsize=7.5)
    twin, (timed,) = panels(1, 1, (5.5, 3))
    for index, (name, result) in enumerate(found.items()):
        curve(axes[-1], result.iterations, result.typical(), index, name)
        curve(timed, result.seconds, result.typical(), index, name)
    for panel, label in ((axes[-1], "iterations"), (timed, "CPU seconds")):
        log_axes(panel)
        panel.set_xlabel(label, fontsize=7)
        panel.tick_params(labelsize=6.5)
        panel.legend(fontsize=6.5, frameon=False)
    axes[-1].set_title("RMS error, median over renders", fontsize=7.5)
    timed.set_ylabel("RMS error, median over renders")
    run.plot(plot)
    run.time_plot(twin)
    run.table([{"setting": name, "iterations": n, "repeat": r, "mse": value, "cpu_seconds": result.seconds[at]}
               for name, result in found.items() for at, n in enumerate(result.iterations) for r, value in enumerate(result.squares[at])])
