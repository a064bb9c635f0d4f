# SPDX-License-Identifier: BSD-2-Clause
"""Debiased photon mapping, taken apart: figures 10 and 11 of Misso et al. 2022."""
from typing import Any

import numpy as np

from .derivatives import Errors, errors, signed
from .intervals import Interval, ratio_of_means
from .plotting import curve, log_axes, panels, pictures
from .run import Run

FIXED = {"debias": "progressive", "alpha": 0.999999}
"""A kernel that hardly shrinks: the first one for all iterations."""


def signed_bias(run: Run, scene: str, biased: dict[str, Any], debiased: dict[str, Any], iterations: list[int], repeats: int, exposure: float) -> None:
    """The image, its biased part, the signed bias that is found, that which there is, and what both make; error against iterations, and over time."""
    truth = run.render(scene, run.pick(2048, 512), seed=977, define={"integrator": "bdpt"}).pixels
    found = {name: errors(run, scene, define, truth, iterations, repeats) for name, define in (("biased", biased), ("debiased", debiased))}

    def images(define: dict[str, Any]) -> list[np.ndarray]:
        return [run.render(scene, iterations[-1], seed=1 + r, define=define).pixels for r in range(repeats)]
    part, singles = np.mean(images(biased), axis=0), images(debiased)
    whole, bias = np.mean(singles, axis=0), truth - part
    draw(run, found, [truth, part, whole - part, bias, whole], exposure)
    biased_errors, debiased_errors = found["biased"], found["debiased"]
    run.claim("the correction is the bias: share of the bias, pixel by pixel, that it takes away",
              Interval.mean([float(((s - part) * bias).sum() / (bias * bias).sum()) for s in singles]), above=0.75, below=1.25)
    run.claim("blur is traded for noise: squared error of one debiased render over that of a biased one, few iterations",
              ratio_of_means(list(debiased_errors.squares[:, 0]), list(biased_errors.squares[:, 0])), above=1)
    run.claim(f"averaged, debiased renders are better: squared error of {repeats} of them over that of as many biased ones",
              Interval.exact(float(((whole - truth)**2).mean() / (bias * bias).mean())), below=1, why="their noise is still more than the bias")
    run.claim("error of debiased renders falls on: slope of the squared error", debiased_errors.slope(), above=-1.35, below=-0.4,
              why="single corrections have a tail like a Cauchy law's under the paper's c, see figure 12, so that rare ones hold most of the error")


def draw(run: Run, found: dict[str, Errors], shown: list[np.ndarray], exposure: float) -> None:
    plot, axes = panels(6, 6, (1.75, 2.0))
    most = float(np.quantile(np.abs(shown[3]), 0.99))
    for panel, image, title in zip(axes, shown, ("right (bdpt)", "biased part", "signed bias, found", "signed bias, right", "sum of both")):
        if title.startswith("signed"):
            signed(panel, image, most, title)
        else:
            pictures(panel, image, exposure)
            panel.set_title(title, fontsize=7.5)
    twin, (timed,) = panels(1, 1, (5.5, 3))
    for index, (name, result) in enumerate(found.items()):
        values = [float(v) for v in np.sqrt(result.squares.mean(axis=0))]
        curve(axes[-1], result.samples, values, index, name)
        curve(timed, result.seconds, values, index, name)
    for panel, label in ((axes[-1], "iterations"), (timed, "CPU seconds")):
        log_axes(panel)
        panel.set_xlabel(label, fontsize=7)
        panel.tick_params(labelsize=6.5)
        panel.legend(fontsize=6.5, frameon=False)
    axes[-1].set_title("RMS error", fontsize=7.5)
    timed.set_ylabel("RMS error")
    run.plot(plot)
    run.time_plot(twin)
    run.table([{"setting": name, "iterations": n, "repeat": r, "mse": e.squares[r, i], "cpu_seconds": e.seconds[i]}
               for name, e in found.items() for i, n in enumerate(e.samples) for r in range(e.squares.shape[0])])
