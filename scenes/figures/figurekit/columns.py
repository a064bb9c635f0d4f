# SPDX-License-Identifier: BSD-2-Clause
"""One sample of a pixel by five estimators in four scenes: figures 1 and 11 of Kettunen et al. 2021."""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import volumes
from .intervals import Interval, ratio_of_means
from .plotting import panels, pictures
from .programs import Row
from .run import Run

COLUMNS = {"ratio": "ratio", "residual ratio": "residual-ratio", "p-CMF": "p-series-cmf", "unbiased": "unbiased-ray-marching", "biased": "biased-ray-marching"}
TRACKING = ("ratio", "residual ratio")
PREVIOUS = ("ratio", "residual ratio", "p-CMF")
MARCHING = ("unbiased", "biased")


@dataclass(frozen=True)
class Scene:
    """A template, its volume, and what the extinction of blue is more than its absorption."""
    template: str
    volume: Callable[[], np.ndarray] | None
    scattered: float = 0
    exposure: float = 1


SCENES = {"plume": Scene("plume.pbrt", None), "box": Scene("smoky-box.pbrt", volumes.smoke), "cloud": Scene("lit-cloud.pbrt", volumes.cloud, 0.9, 4),
          "glass": Scene("smoky-glass.pbrt", volumes.smoke)}


@dataclass(frozen=True)
class Column:
    """Of each render: squared errors of red and green against the reference, and against the same paths with exact transmittance."""
    errors: list[float]
    noise: list[float]
    lookups: list[float]           # of a pixel
    seconds: list[float]
    first: np.ndarray

    def work(self, is_noise: bool) -> list[float]:
        return [e * n for e, n in zip(self.noise if is_noise else self.errors, self.lookups)]

    def timed(self) -> list[float]:
        return [e * s for e, s in zip(self.noise, self.seconds)]


@dataclass(frozen=True)
class Columns:
    reference: np.ndarray
    raised: float
    columns: dict[str, Column]
    curves: dict[str, list[Row]]

    def rows(self, scene: str) -> list[dict[str, Any]]:
        return [{"scene": scene, "column": name, "repeat": i, "raised": self.raised if name in TRACKING else 1, "mse": c.errors[i], "mse_same_paths": c.noise[i],
                 "lookups_per_pixel": c.lookups[i], "cpu_seconds": c.seconds[i]} for name, c in self.columns.items() for i in range(len(c.errors))]

    def best_previous(self, is_noise: bool) -> str:
        return min(PREVIOUS, key=lambda n: float(np.mean(self.columns[n].work(is_noise))))

    def gain(self, above: str, below: str, is_noise: bool) -> Interval:
        """Inverse efficiency of the first over that of the second."""
        return ratio_of_means(self.columns[above].work(is_noise), self.columns[below].work(is_noise))


def measure(run: Run, scene: Scene) -> Columns:
    files: list[str] = []
    common: dict[str, Any] = {}
    if scene.volume:
        path = run.folder / f"{scene.template.removesuffix('.pbrt')}.raw"
        path.write_bytes(np.ascontiguousarray(scene.volume(), "<f4").tobytes())
        files, common = [str(path)], {"file": str(path)}
    else:
        files = ["../data/plume.nvdb"]
    repeats = run.pick(16, 6)

    def render(estimator: str, spp: int, seed: int, more: dict[str, Any], reference: bool = False):
        return run.render(scene.template, spp, seed=seed, define={"estimator": estimator, **common, **more}, files=files, reference=truth if reference else None)
    truth = (run.pick(512, 64), {"estimator": "regular", **common})
    right = run.render(scene.template, truth[0], seed=977, define=truth[1], files=files).pixels
    pixels = right.shape[0] * right.shape[1]
    exact = [render("regular", 1, s, {}).pixels for s in range(1, repeats + 1)]
    # Bounds of tracking are raised until it has as many look-ups as p-CMF.
    raised = max(1.0, round(render("p-series-cmf", 4, 1, {}).lookups / render("ratio", 4, 1, {}).lookups, 2))
    found, curves = {}, {}
    for name, estimator in COLUMNS.items():
        more = {"blue": raised - scene.scattered} if name in TRACKING else {}
        images = [render(estimator, 1, s, more) for s in range(1, repeats + 1)]
        shown = images[0].pixels.copy()
        shown[:, :, 2] = shown[:, :, 1] if more else shown[:, :, 2]
        noise = []
        for image, same in zip(images, exact):
            arrived = (same[:, :, :2] > 0).any(axis=2)
            noise.append(float(((image.pixels - same)[:, :, :2][arrived]**2).mean()))
        found[name] = Column([float(((i.pixels - right)[:, :, :2]**2).mean()) for i in images], noise, [i.lookups / pixels for i in images],
                             [i.processor_seconds for i in images], shown)
        if name not in TRACKING:  # their blue is another image
            curves[name] = render(estimator, run.pick(64, 8), 101, {}, True).curve
    return Columns(right, raised, found, curves)


def gallery(measured: dict[str, Columns], is_noise: dict[str, bool], size: float):
    plot, axes = panels(len(measured) * (len(COLUMNS) + 1), len(COLUMNS) + 1, (size, size * 1.2))
    for row, (scene, found) in enumerate(measured.items()):
        line = axes[row * (len(COLUMNS) + 1):]
        pictures(line[0], found.reference, SCENES[scene].exposure)
        line[0].set_title(f"{scene}, right", fontsize=7)
        for panel, (name, column) in zip(line[1:], found.columns.items()):
            pictures(panel, column.first, SCENES[scene].exposure)
            panel.set_title(f"{name}\n{np.mean(column.work(is_noise[scene])):.3g} / {np.mean(column.lookups):.3g}", fontsize=6.5)
    return plot
