# SPDX-License-Identifier: BSD-2-Clause
"""Volumes of our own by script: smoke that fills a box, and a cloud in a ball; figures 1 and 11 of Kettunen et al. 2021."""
import numpy as np

SIZE = 32


def waves(seed: int) -> np.ndarray:
    """Noise of deviation 1, [z, y, x]: plane waves of random directions, four octaves."""
    rng = np.random.default_rng(seed)
    at = (np.arange(SIZE) + 0.5) / SIZE
    total, weight = np.zeros((SIZE,) * 3), 0.0
    for octave in range(4):
        for _ in range(12):
            k = rng.normal(size=3)
            k *= 1.3 * 2**octave / np.linalg.norm(k)
            x, y, z = (np.exp(2j * np.pi * f * at) for f in k)
            total += 0.65**octave * (z[:, None, None] * y[None, :, None] * x[None, None, :] * np.exp(1j * rng.uniform(0, 6.28))).real
            weight += 0.65**(2 * octave) / 2
    return total / np.sqrt(weight)


def smoke() -> np.ndarray:
    """Swirls that fill the box, mean 1."""
    found = np.exp(0.9 * waves(5))
    return (found / found.mean()).astype(np.float32)


def cloud() -> np.ndarray:
    """A ball with a rough edge, mean 1 within."""
    at = (np.arange(SIZE) + 0.5) / SIZE * 2 - 1
    z, y, x = np.meshgrid(at, at, at, indexing="ij")
    radius = np.sqrt(x * x + y * y + z * z)
    noise = waves(9)
    found = np.clip(6 * (0.72 + 0.12 * noise - radius), 0, 1) * np.exp(0.5 * noise)
    return (found / found[radius < 0.6].mean()).astype(np.float32)
