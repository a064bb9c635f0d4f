# SPDX-License-Identifier: BSD-2-Clause
"""Comparing settings of one scene: repeated renders of seeds of their own, against a reference."""
from dataclasses import dataclass
from typing import Any

import numpy as np

from .intervals import Interval, ratio_of_means
from .plotting import Axes, panels, pictures
from .programs import Row
from .run import Run


@dataclass(frozen=True)
class Setting:
    """Repeats of one setting: mean squared errors over pixels and channels, and what a repeat cost."""
    name: str
    errors: list[float]
    lookups: list[float]
    seconds: list[float]
    mean: np.ndarray             # the mean of the repeats
    first: np.ndarray            # one of them
    curve: list[Row]             # error against run time of a longer render

    def rmse(self) -> float:
        return float(np.sqrt(np.mean(self.errors)))

    def work(self) -> list[float]:
        """Squared error times look-ups, of each repeat."""
        return [e * c for e, c in zip(self.errors, self.lookups)]

    def timed_work(self) -> list[float]:
        """Squared error times processor seconds."""
        return [e * c for e, c in zip(self.errors, self.seconds)]


@dataclass(frozen=True)
class Comparison:
    reference: np.ndarray
    settings: dict[str, Setting]

    def gain(self, above: str, below: str) -> Interval:
        """Squared error x look-ups of the first over the second's."""
        return ratio_of_means(self.settings[above].work(), self.settings[below].work())

    def timed_gain(self, above: str, below: str) -> Interval:
        return ratio_of_means(self.settings[above].timed_work(), self.settings[below].timed_work())

    def bias(self, name: str) -> Interval:
        """Mean over the image, of the repeats less the reference, in shares of the reference's mean. Its noise is that of the repeats."""
        found = self.settings[name]
        off = float((found.mean - self.reference).mean() / self.reference.mean())
        spread = float(np.sqrt(np.mean(found.errors) / found.mean.size / len(found.errors)) / self.reference.mean())
        return Interval.of(off, spread)

    def rows(self) -> list[dict[str, Any]]:
        return [{"setting": s.name, "repeat": i, "mse": s.errors[i], "lookups": s.lookups[i], "cpu_seconds": s.seconds[i]}
                for s in self.settings.values() for i in range(len(s.errors))]

    def curves(self) -> dict[str, list[Row]]:
        return {s.name: s.curve for s in self.settings.values()}


def compare(run: Run, scene: str, settings: dict[str, dict[str, Any]], spp: int | dict[str, int], reference: tuple[int, dict[str, Any]], repeats: int = 4,
            common: dict[str, Any] | None = None, options: list[str] | None = None, files: list[str] | None = None, longer: int = 8) -> Comparison:
    """`settings` give variables of the template, `common` those of all. `reference`: samples per pixel and variables. A curve over time is of `longer`
    times as many samples."""
    shared = common or {}
    truth = (reference[0], {**shared, **reference[1]})
    image = run.render(scene, truth[0], seed=977, define=truth[1], options=options, files=files)
    found = {}
    for name, values in settings.items():
        samples = spp[name] if isinstance(spp, dict) else spp
        define = {**shared, **values}
        renders = [run.render(scene, samples, seed=i + 1, define=define, options=options, files=files) for i in range(repeats)]
        long = run.render(scene, samples * longer, seed=101, define=define, options=options, files=files, reference=truth)
        found[name] = Setting(name, [float(((r.pixels - image.pixels)**2).mean()) for r in renders], [r.lookups for r in renders],
                              [r.processor_seconds for r in renders], np.mean([r.pixels for r in renders], axis=0), renders[0].pixels, long.curve)
    return Comparison(image.pixels, found)


def show(axes: list[Axes], comparison: Comparison, names: list[str], exposure: float = 1.0) -> None:
    """The reference, then one render of each setting with its error."""
    pictures(axes[0], comparison.reference, exposure)
    axes[0].set_title("reference", fontsize=8)
    for panel, name in zip(axes[1:], names):
        found = comparison.settings[name]
        pictures(panel, found.first, exposure)
        panel.set_title(f"{name}\nRMSE {found.rmse():.2g}", fontsize=7.5)


def gallery(comparison: Comparison, names: list[str] | None = None, columns: int = 5, size: float = 1.6, exposure: float = 1.0, height: float = 1.15):
    """All of it as one plot; `height` of a picture with its title over its width."""
    shown = names or list(comparison.settings)
    plot, axes = panels(len(shown) + 1, columns, (size, size * height))
    show(axes, comparison, shown, exposure)
    return plot
