# SPDX-License-Identifier: BSD-2-Clause
"""Numbers with their intervals of 95 %."""
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from compare.intervals import Estimate, mean_estimate, welch
from compare.slope import slope_of

TWO_SIDED = 1.96
"""Standard errors of 95 %, where they come from so many trials that they are known."""


@dataclass(frozen=True)
class Interval:
    """A value between two limits; of an exact number all three are the same."""
    value: float
    low: float
    high: float

    @staticmethod
    def exact(value: float) -> "Interval":
        return Interval(value, value, value)

    @staticmethod
    def of(value: float, error: float) -> "Interval":
        return Interval(value, value - TWO_SIDED * error, value + TWO_SIDED * error)

    @staticmethod
    def student(estimate: Estimate) -> "Interval":
        return Interval(estimate.value, estimate.low(), estimate.high())

    @staticmethod
    def mean(values: list[float]) -> "Interval":
        """Of the mean of a few independent values."""
        return Interval.student(mean_estimate(values))

    @staticmethod
    def median(values: list[float]) -> "Interval":
        """Of the median of independent values, by order statistics: whatever their law, also where it has no mean. All of their range for fewer than
        six, which covers less than 95 %."""
        ordered, n = sorted(values), len(values)
        left_out, outside = 0, 0.0  # values aside at either end; the chance that the median lies there
        while left_out < n // 2:
            outside += 2 * math.comb(n, left_out) * 0.5**n
            if outside > 0.05:
                break
            left_out += 1
        aside = max(0, left_out - 1)
        return Interval(float(np.median(ordered)), ordered[aside], ordered[n - 1 - aside])

    @staticmethod
    def share(count: int, of: int) -> "Interval":
        """Of a probability, from `count` successes: Wilson's."""
        p, z2 = count / of, TWO_SIDED**2
        middle = (p + z2 / (2 * of)) / (1 + z2 / of)
        width = TWO_SIDED * math.sqrt(p * (1 - p) / of + z2 / (4 * of * of)) / (1 + z2 / of)
        return Interval(p, max(0.0, middle - width), min(1.0, middle + width))

    def text(self) -> str:
        if self.low == self.high:
            return f"{self.value:.4g}"
        return f"{self.value:.3g} ({self.low:.3g} to {self.high:.3g})"


def ratio(above: float, above_error: float, below: float, below_error: float) -> Interval:
    """Of two independent positive estimates: an interval of the logarithm. Nothing known of either: from 0 to infinity."""
    if not (above > 0 and below > 0 and math.isfinite(above_error) and math.isfinite(below_error)):
        return Interval(above / below if below > 0 else math.inf, 0, math.inf)
    width = min(700.0, TWO_SIDED * math.hypot(above_error / above, below_error / below))
    return Interval(above / below, above / below * math.exp(-width), above / below * math.exp(width))


def ratio_of_means(above: list[float], below: list[float]) -> Interval:
    """Of the means of few positive values each: Welch's interval of the logarithm."""
    logs = []
    for values in (above, below):
        found = mean_estimate(values)
        logs.append(Estimate(math.log(found.value), found.error / found.value, found.freedom))
    found = welch(*logs)
    return Interval(*(math.exp(min(700, x)) for x in (found.value, found.low(), found.high())))


RESAMPLINGS = 1000


def drawn_medians(sample: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Medians of a sample (along its first axis) drawn again with replacement, RESAMPLINGS times."""
    return np.median(sample[rng.integers(0, len(sample), (RESAMPLINGS, len(sample)))], axis=1)


def between(value: float, drawn: np.ndarray) -> Interval:
    """Of 95 %, by quantiles of what drawing again gives: right for medians whether or not the law of a sample has a mean, where means and their bootstrap are not."""
    low, high = np.quantile(drawn, (0.025, 0.975))
    return Interval(value, float(low), float(high))


def ratio_of_medians(above: Sequence[float], below: Sequence[float]) -> Interval:
    """Of the medians of few positive values each."""
    rng = np.random.default_rng(1)
    return between(float(np.median(above) / np.median(below)), drawn_medians(np.array(above), rng) / drawn_medians(np.array(below), rng))


def slope_of_medians(costs: Sequence[np.ndarray], values: Sequence[np.ndarray]) -> Interval:
    """How the median of positive values grows with the median of their costs: the exponent. One array a size; costs and values of a run stand at the same place,
    and runs of different sizes are independent."""
    rng = np.random.default_rng(1)
    pairs = [np.stack(pair, axis=1) for pair in zip(costs, values, strict=True)]
    found = slope_of(*(list(column) for column in np.array([np.median(p, axis=0) for p in pairs]).T))
    x, y = np.moveaxis(np.log([drawn_medians(p, rng) for p in pairs]), 2, 0)  # [size, drawing]
    x, y = x - x.mean(axis=0), y - y.mean(axis=0)
    return between(math.nan if found is None else found, (x * y).sum(axis=0) / (x * x).sum(axis=0))
