# SPDX-License-Identifier: BSD-2-Clause
"""What the random term of debiased photon mapping does to means: Misso et al. 2022, section 5.3 and appendix C, and what follows from it.

Kernel n = 1, 2, ... has n^(alpha - 1) of the first one's size. Its level is drawn with Pr{n or beyond} = n^(alpha - 1), and gets (n + 1)^(1 - c alpha) times the photons. The correction
I(n + 1) - I(n) of a cone kernel has the variance n^(-alpha - 1) over the photons (the paper's equation 44), so over its probability it is of the size n^noise_power.
"""
import math
from dataclasses import dataclass

import numpy as np

PRINTED, CODE = 1.001, 0.499
"""The paper's c, and that of its published code."""
ALPHA = 2 / 3


@dataclass(frozen=True)
class Series:
    """Exponents: x is of the order of n^exponent for large n."""
    c: float
    alpha: float = ALPHA

    def noise_power(self) -> float:
        """Of a correction over its probability, by level."""
        return 1 - self.alpha + (self.c - 1) * self.alpha / 2

    def mean_power(self) -> float:
        """Of the terms of the series for the mean |correction over probability|, by level: it has a sum below -1 only. -1 + (c - 1) alpha / 2: for c < 1."""
        return self.alpha - 2 + self.noise_power()

    def photon_mean_power(self) -> float:
        """Of the terms of the series for the mean number of photons of an iteration: -1 + (1 - c) alpha. It has a sum for c > 1: there is no c for both."""
        return self.alpha - 2 + 1 - self.c * self.alpha

    def error_power(self) -> float:
        """Of the typical error of the mean of n corrections of independent photons. With tails of the index (1 - alpha) / noise_power below 2 means are as stable laws
        have it, otherwise as independent samples of finite variance. At 0 or above means do not settle."""
        return max(-0.5, self.noise_power() / (1 - self.alpha) - 1)

    def photon_power(self) -> float:
        """Of the typical number of photons of n iterations."""
        return max(1.0, (1 - self.c * self.alpha) / (1 - self.alpha))

    def slope(self) -> float:
        """Of the typical error over photons."""
        return self.error_power() / self.photon_power()

    def progressive_error_power(self) -> float:
        """As `error_power`, where kernels shrink from one iteration to the next: their own noise falls as n^(-alpha / 2)."""
        return max(-self.alpha / 2, self.error_power())

    def progressive_slope(self) -> float:
        return self.progressive_error_power() / self.photon_power()

    def size_of_correction(self, level: np.ndarray, photons: float) -> np.ndarray:
        """Standard deviation of the correction over its probability, as a share of the irradiance, where this is the same all over the first kernel, which gets
        `photons` of the first level on the average. For kernels of radii a > b, integral of (k_b - k_a)^2 = 3 / (2 pi a^2) (1 - q)^2 (1 + 2 q) / q^2, q = b / a."""
        shrinks = -np.expm1((self.alpha - 1) / 2 * np.log1p(1 / level))
        squares = 1.5 * shrinks**2 * (3 - 2 * shrinks) / (1 - shrinks)**2 * level**(1 - self.alpha)
        return np.sqrt(squares / (photons * (level + 1)**(1 - self.c * self.alpha))) / self.probability(level)

    def probability(self, level: np.ndarray) -> np.ndarray:
        return -level**(self.alpha - 1) * np.expm1((self.alpha - 1) * np.log1p(1 / level))

    def mean_size(self, most: float, photons: float) -> float:
        """Mean over levels up to `most` of that size: what a mean correction is, where higher levels are never drawn."""
        few = np.arange(1, min(most, 1000) + 1)
        total = float((self.probability(few) * self.size_of_correction(few, photons)).sum())
        if most > 1000:  # a sum of so smooth terms is an integral, over the logarithm
            edges = np.linspace(math.log(1000.5), math.log(most + 0.5), 4001)
            middle = np.exp((edges[1:] + edges[:-1]) / 2)
            total += float((self.probability(middle) * self.size_of_correction(middle, photons) * middle * np.diff(edges)).sum())
        return total


def why_no_mean(c: float) -> str:
    """The reason of a verdict, where means of corrections do not settle."""
    s = Series(c)
    return (f"level n comes with the probability n^{s.alpha - 2:.3g}, and its correction over that is of the size n^{s.noise_power():.3g}: the mean of this size is a sum of "
            f"n^{s.mean_power():.4g}, which is infinite. So there is no law of large numbers, and the typical error of n iterations goes as n^{s.error_power():+.2g}")
