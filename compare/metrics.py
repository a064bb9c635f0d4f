# SPDX-License-Identifier: BSD-2-Clause
"""Errors of an image a against a reference b. Means are over pixels and channels.

    mse              mean of (a - b)^2
    relmse           mean of (a - b)^2 / (b^2 + epsilon), as `imgtool diff`
    relmse_robust    the same without the worst 0.01 % of the pixels (rounded up)
    smape            mean of |a - b| / ((|a| + |b|) / 2), 0 where both are 0
    mean_signed      mean of a - b

A reference that was rendered has noise of its own, and (a - b)^2 is too large by its variance. Where that is known, the squared errors
are less its mean, so that they estimate the error against the true image without bias (and may come out negative near 0).
"""
from dataclasses import dataclass

import numpy as np

SQUARED = ("mse", "relmse", "relmse_robust")
METRICS = (*SQUARED, "smape", "mean_signed")
ROBUST_SHARE = 1e-4


@dataclass(frozen=True)
class Reference:
    """What images are measured against. `variance` is that of each value of `image`, None where nobody knows it."""
    image: np.ndarray
    variance: np.ndarray | None
    epsilon: float = 0.01

    def noise(self) -> float:
        """Mean variance, as mse; 0 if unknown."""
        return float(self.variance.mean()) if self.variance is not None else 0.0


def errors(image: np.ndarray, reference: Reference) -> dict[str, float]:
    """All metrics of an image."""
    b = reference.image
    difference = image - b
    squared = difference**2 if reference.variance is None else difference**2 - reference.variance
    relative = squared / (b**2 + reference.epsilon)
    pixels = np.sort(relative.mean(axis=2), axis=None)
    kept = pixels[:len(pixels) - int(np.ceil(ROBUST_SHARE * len(pixels)))]
    size = (np.abs(image) + np.abs(b)) / 2
    proportion = np.divide(np.abs(difference), size, out=np.zeros_like(size), where=size > 0)
    return {"mse": float(squared.mean()), "relmse": float(relative.mean()), "relmse_robust": float(kept.mean()) if kept.size else 0.0,
            "smape": float(proportion.mean()), "mean_signed": float(difference.mean())}
