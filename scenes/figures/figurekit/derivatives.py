# SPDX-License-Identifier: BSD-2-Clause
"""Derivatives of images by finite differences: figures 4 to 6 of Misso et al. 2022."""
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from compare.slope import slope_estimate

from .intervals import Interval
from .plotting import Axes, curve, log_axes, panels
from .run import Run


def difference(variable: str, step: float, debias: str, **more: Any) -> dict[str, Any]:
    """Options of pbrt for a derivative."""
    return {"--derivative": variable, "--step": step, "--debias": debias, **{"--" + k.replace("_", "-"): v for k, v in more.items()}}


@dataclass(frozen=True)
class Errors:
    """Mean squared errors [repeat, size] and mean CPU seconds at each number of samples."""
    samples: list[int]
    squares: np.ndarray
    seconds: list[float]
    image: np.ndarray

    def slope(self, first: int = 0) -> Interval:
        found = slope_estimate([([float(s) for s in self.samples[first:]], list(row[first:])) for row in self.squares])
        assert found is not None
        return Interval.student(found)

    def last_over_before(self) -> Interval:
        """The error at the most samples over that at a quarter of them."""
        return Interval.mean(list(self.squares[:, -1] / self.squares[:, -3].mean()))


def errors(run: Run, scene: str, define: dict[str, Any], truth: np.ndarray, samples: list[int], repeats: int) -> Errors:
    squares, seconds, image = np.zeros((repeats, len(samples))), [0.0] * len(samples), np.zeros(0)
    for at, spp in enumerate(samples):
        for repeat in range(repeats):
            found = run.render(scene, spp, seed=1 + repeat, define=define)
            squares[repeat, at] = float(((found.pixels - truth)**2).mean())
            seconds[at] += found.processor_seconds / repeats
            image = found.pixels
    return Errors(samples, squares, seconds, image)


def signed(axes: Axes, image: np.ndarray, most: float, title: str) -> None:
    axes.imshow(image[:, :, 0], cmap="RdBu_r", vmin=-most, vmax=most, interpolation="nearest")
    axes.set_title(title, fontsize=7.5)
    axes.grid(False)
    axes.set_xticks([])
    axes.set_yticks([])


def draw(run: Run, truth: np.ndarray, results: dict[str, Errors]) -> None:
    """Images, error against samples, and the twin over time."""
    plot, axes = panels(len(results) + 2, len(results) + 2, (1.9, 2.1))
    most = float(np.quantile(np.abs(truth), 0.98))
    signed(axes[0], truth, most, "right")
    for panel, (name, found) in zip(axes[1:], results.items()):
        signed(panel, found.image, most, name)
    twin, (timed,) = panels(1, 1, (5.5, 3))
    for index, (name, found) in enumerate(results.items()):
        values = [math.sqrt(v) for v in found.squares.mean(axis=0)]
        curve(axes[-1], found.samples, values, index, name)
        curve(timed, found.seconds, values, index, name)
    for panel, label in ((axes[-1], "samples of a pixel"), (timed, "CPU seconds")):
        log_axes(panel)
        panel.set_xlabel(label, fontsize=7)
        panel.tick_params(labelsize=6.5)
    axes[-1].set_title("RMS error", fontsize=7.5)
    axes[-1].legend(fontsize=6, frameon=False)
    timed.set_ylabel("RMS error")
    timed.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.time_plot(twin)
    run.table([{"setting": name, "samples": s, "repeat": r, "mse": found.squares[r, i], "cpu_seconds": found.seconds[i]}
               for name, found in results.items() for i, s in enumerate(found.samples) for r in range(found.squares.shape[0])])
