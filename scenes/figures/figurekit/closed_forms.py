# SPDX-License-Identifier: BSD-2-Clause
"""Exact moments of estimators, and the densities of the papers as functions."""
import functools
import math
from collections.abc import Callable

import numpy as np

TERMS = 120
"""Orders that sums run to: far beyond what the roulettes reach with probability 1e-30."""


def poisson(mean: float, most: int) -> np.ndarray:
    """Probabilities of 0 .. most, each from its logarithm."""
    return np.array([math.exp(k * math.log(mean) - mean - math.lgamma(k + 1)) for k in range(most + 1)])


def ratio_variance(depth: float, control: float) -> float:
    """Of ratio tracking when the control is proportional to the extinction: e^(-2 tau) (e^(tau^2 / tau_bar) - 1); Georgiev et al. 2019 (44e)."""
    return math.exp(-2 * depth) * math.expm1(depth * depth / control)


def tracking_variance(extinction: Callable[[np.ndarray], np.ndarray], length: float, control: float, lower: float = 0.0, steps: int = 400_000) -> float:
    """Of (residual) ratio tracking under constant controls, bounding or not: the second moment is
    exp(-bar - low + integral of (bar - mu)^2 / (bar - low)). Midpoint rule."""
    x = (np.arange(steps) + 0.5) * (length / steps)
    mu = extinction(x)
    depth = mu.mean() * length
    second = -(control + lower) * length + ((control - mu)**2).mean() * length / (control - lower)
    return math.exp(second) - math.exp(-2 * depth)


def certain_levels(control: float, is_printed: bool = False) -> int:
    """Of p-series CMF under a control of this optical depth; Georgiev et al. 2019 (31). Published code has one more than printed."""
    certain, below = 1, 0.0
    while True:
        below += math.exp((certain - 1) * math.log(control) - control - math.lgamma(certain))
        if below >= 0.99:
            return certain - is_printed
        certain += 1


def cmf_reach(control: float, is_printed: bool = False) -> np.ndarray:
    """Probabilities that p-series CMF evaluates its levels 0, 1, ..., down to 1e-30."""
    reach = [1.0] * (certain_levels(control, is_printed) + 1)
    while reach[-1] > 1e-30:
        reach.append(reach[-1] * min(1.0, control / len(reach)))
    return np.array(reach)


def fitted_lookups(control: float) -> int:
    """What p-series CMF costs under a control of this optical depth, nearly; Kettunen et al. 2021, section 4.6."""
    return math.ceil(((0.015 + control) * (0.65 + control) * (60.3 + control))**(1 / 3))


def teeth(control: float, roulette: "Roulette") -> int:
    """Of each comb of unbiased ray marching that costs what p-series CMF does; Kettunen et al. 2021, section 4.6."""
    return max(1, math.floor(fitted_lookups(control) / (1 + roulette.mean_orders()) + 0.5))


def cmf_moments(control: float, mean: float, square: float) -> tuple[float, float]:
    """Second moment and mean look-ups of p-series CMF under a control of this optical depth, `mean` and `square` being those of 1 - extinction / control at points spread by
    it; with the certain levels of published code."""
    reach = cmf_reach(control)
    weights = poisson(control, len(reach) - 1)
    second = before = 0.0
    power = 1.0
    for k in range(len(reach)):
        a = weights[k] / reach[k]
        second += reach[k] * a * (a * power + 2 * before)
        before = mean * (before + a * power)
        power *= square
    return second, float(reach[1:].sum())


class Roulette:
    """How many terms a series of Bhanot and Kennedy has: the first floor(c) are certain, or of probability 1 - `zero` where that is given; from
    order k - 1 to k it goes on with c / k."""

    def __init__(self, c: float, zero: float | None = None):
        self.certain = max(1, math.floor(c)) if zero is not None else math.floor(c)
        reach = [1.0]
        for k in range(1, TERMS + 1):
            if k <= self.certain:
                reach.append(1.0 if zero is None else 1 - zero)
            else:
                reach.append(reach[-1] * min(1.0, c / k))
        self.reach = np.array(reach)

    def __hash__(self) -> int:
        return hash(self.reach.tobytes())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Roulette) and np.array_equal(self.reach, other.reach)

    def mean_orders(self) -> float:
        return float(self.reach[1:].sum())

    def weights(self) -> np.ndarray:
        """1 / (k! P_k)."""
        return np.array([math.exp(-math.lgamma(k + 1)) / p if p > 1e-290 else 0.0 for k, p in enumerate(self.reach)])


@functools.cache
def bk_moments(roulette: Roulette) -> np.ndarray:
    """Coefficients [r, d] of (s^2 + m^2)^r m^d in the second moment of the series of Bhanot and Kennedy, over e^(2 pivot)."""
    a, most = roulette.weights(), roulette.certain + 60
    found = np.zeros((most, most))
    for j in range(most):
        for k in range(most):
            found[min(j, k), abs(j - k)] += a[j] * a[k] * roulette.reach[max(j, k)]
    return found


@functools.cache
def ubk_moments(roulette: Roulette) -> np.ndarray:
    """The same with products replaced by elementary symmetric means, which overlap hypergeometrically."""
    a, most = roulette.weights(), 3 * roulette.certain + 26
    found = np.zeros((most, 2 * most))
    for n in range(most):
        chance = roulette.reach[n] - roulette.reach[n + 1]
        for j in range(n + 1) if chance > 0 else ():
            for k in range(n + 1):
                weight = chance * a[j] * a[k] / math.comb(n, k)
                for r in range(max(0, j + k - n), min(j, k) + 1):
                    found[r, j + k - 2 * r] += weight * math.comb(j, r) * math.comb(n - j, k - r)
    return found


def series_variance(moments: np.ndarray, pivot: float, mean: float, variance: float, depth: float) -> float:
    square = variance + mean * mean
    with np.errstate(over="ignore"):
        second = float(np.power(square, np.arange(moments.shape[0])) @ moments @ np.power(mean, np.arange(moments.shape[1])))
    return math.exp(2 * pivot) * second - math.exp(-2 * depth)


def bk_variance(roulette: Roulette, pivot: float, mean: float, variance: float, depth: float) -> float:
    """Of the series of Bhanot and Kennedy about `pivot` (minus an optical depth), its factors of `mean` and `variance`."""
    return series_variance(bk_moments(roulette), pivot, mean, variance, depth)


def ubk_variance(roulette: Roulette, pivot: float, mean: float, variance: float, depth: float) -> float:
    """Of its symmetrised form; Kettunen et al. 2021, 4.1."""
    return series_variance(ubk_moments(roulette), pivot, mean, variance, depth)


def cosine(x: np.ndarray) -> np.ndarray:
    """1 + cos(20 x + 0.8), not scaled to a mean of 1; Georgiev et al. 2019."""
    return 1 + np.cos(20 * x + 0.8)


def sine_medium(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Szirmay-Kalos et al. 2017 (21), without the sphere around it."""
    return ((np.cos(1.5 * (x + y + z)) + 1) / 2)**5 * (np.sin(z / 2) + 2) / 3
