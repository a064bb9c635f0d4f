# SPDX-License-Identifier: BSD-2-Clause
"""Numbers with their intervals of 95 %."""
import math
from dataclasses import dataclass

from compare.intervals import Estimate, mean_estimate, welch

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
