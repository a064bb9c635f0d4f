# SPDX-License-Identifier: BSD-2-Clause
"""The slab of figures 14 and 15 of Kettunen et al. 2021: parallel rays, rougher to the right, thicker to the top."""
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .programs import Row
from .run import Run

THICKEST = 9.9
POINTS = 513


def density(x: float, t: np.ndarray) -> np.ndarray:
    """One cross-section: across at x in [0, 1], along the ray at t in [0, 1]; its Hurst exponent falls from 2 to 0.2."""
    hurst = 2 - 1.8 * x
    octaves = sum(2.0**(-k * hurst) * np.cos(2 * math.pi * 2**k * 1.37 * t + 0.7 * k * k + 3 * x) for k in range(8))
    return np.maximum(0.0, 2.2 + octaves)


@dataclass(frozen=True)
class Maps:
    """Maps over the slab, row 0 at the bottom, by estimator."""
    variance: dict[str, np.ndarray]
    lookups: dict[str, np.ndarray]
    seconds: dict[str, np.ndarray]
    rows: list[Row]

    def work(self, name: str) -> np.ndarray:
        return self.variance[name] * self.lookups[name]


class Slab:
    """Columns are tables of straight lines, which the lab integrates exactly; rows are optical depths."""

    def __init__(self, run: Run, size: int):
        self.run, self.size = run, size
        self.depths = [THICKEST * (i + 0.5) / size for i in range(size)]
        t = np.linspace(0, 1, POINTS)
        self.tables: list[Path] = []
        self.peaks: list[float] = []          # largest density over the mean
        for i in range(size):
            values = density((i + 0.5) / size, t)
            self.tables.append(run.text_file(f"column-{i:02}.csv", "x,density\n" + "".join(f"{a:.9g},{b:.9g}\n" for a, b in zip(t, values))))
            self.peaks.append(float(values.max() / ((values[1:] + values[:-1]).mean() / 2)))

    def measure(self, estimators: list[str], trials: int, raised: float = 1.0, is_global: bool = False) -> Maps:
        """`raised` times the largest density of each ray, or of the whole slab."""
        maps = Maps(*({n: np.zeros((self.size, self.size)) for n in estimators} for _ in range(3)), [])
        for column, table in enumerate(self.tables):
            if is_global:
                # The control of all rays is that of the thickest and most uneven one.
                highest = THICKEST * max(self.peaks)
                parts = [(depth, highest / (depth * self.peaks[column])) for depth in self.depths]
            else:
                parts = [(self.depths, raised)]
            for depth, control in parts:
                found = self.run.lab("estimate", files=[table], estimator=estimators, extinction=str(table), depth=depth, control=f"{control:.12g}", trials=trials)
                for row in found:
                    height = int(float(row["depth"]) / THICKEST * self.size)
                    name = str(row["estimator"])
                    for values, key in ((maps.variance, "variance"), (maps.lookups, "lookups"), (maps.seconds, "seconds_per_estimate")):
                        values[name][height, column] = float(row[key])
                    maps.rows.append({"column": float(column), "row": float(height), **row, "extinction": table.stem})
        return maps


def gain(above: np.ndarray, below: np.ndarray) -> float:
    """The median over the pixels of the ratio: no pixel's luck decides."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.nanmedian(above / np.maximum(below, 1e-14)))
