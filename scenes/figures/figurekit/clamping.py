# SPDX-License-Identifier: BSD-2-Clause
"""A grid of our own, whole and cut to bounds, and images of its transmittance without noise: figures 5 and 6 of Misso et al. 2023."""
import numpy as np

from .run import Run

SIZE, CELL = 32, 4


def noise() -> np.ndarray:
    """Smoke-like densities in [0, 16]: exponentials of smooth noise within a ball, [z, y, x]."""
    rng = np.random.default_rng(8)
    at = (np.arange(SIZE) + 0.5) / SIZE
    z, y, x = np.meshgrid(at, at, at, indexing="ij")
    total = np.zeros((SIZE,) * 3)
    for octave in range(3):
        for _ in range(6):
            k = rng.normal(0, 3.0 * 2**octave, 3)
            total += 0.6**octave * np.cos(2 * np.pi * (k[0] * x + k[1] * y + k[2] * z) + rng.uniform(0, 6.28))
    ball = np.clip(1.6 - 3.4 * np.sqrt((x - 0.5)**2 + (y - 0.5)**2 + (z - 0.5)**2), 0, 1)
    found = ball * np.exp(0.9 * total)
    return (found * 16 / found.max()).astype(np.float32)


def cell_peaks(grid: np.ndarray) -> np.ndarray:
    """The largest density of each cell of 4 x 4 x 4 samples, at every sample."""
    peaks = grid.reshape(SIZE // CELL, CELL, SIZE // CELL, CELL, SIZE // CELL, CELL).max(axis=(1, 3, 5))
    return peaks.repeat(CELL, 0).repeat(CELL, 1).repeat(CELL, 2)


def image_of(run: Run, grid: np.ndarray, name: str, sigma: float = 6) -> tuple[np.ndarray, float]:
    """Transmittance by regular tracking, one channel, and the seconds it took."""
    path = run.folder / f"{name}.raw"
    path.write_bytes(np.ascontiguousarray(grid, "<f4").tobytes())
    found = run.render("block.pbrt", 4, define={"file": str(path), "sigma": sigma}, files=[str(path)])
    return found.pixels[:, :, 0], found.processor_seconds
