# SPDX-License-Identifier: BSD-2-Clause
"""Confidence intervals of means, products and their ratios. All are of 95 % unless told otherwise."""
import functools
import math
from dataclasses import dataclass

import numpy as np

LEVEL = 0.95


def incomplete_beta(a: float, b: float, x: float) -> float:
    """Regularised incomplete beta function, a continued fraction by Lentz's method; relative error below 1e-12."""
    if x <= 0 or x >= 1:
        return float(x >= 1)
    if x > (a + 1) / (a + b + 2):
        return 1 - incomplete_beta(b, a, 1 - x)
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)) / a
    tiny = 1e-300
    c, d = 1.0, 1 - (a + b) * x / (a + 1)
    d = 1 / (d if abs(d) > tiny else tiny)
    value = d
    for m in range(1, 1000):
        for term in (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)), -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))):
            d = 1 + term * d
            c = 1 + term / c
            d = 1 / (d if abs(d) > tiny else tiny)
            c = c if abs(c) > tiny else tiny
            value *= d * c
        if abs(d * c - 1) < 1e-14:
            break
    return front * value


@functools.cache
def student_quantile(freedom: float, level: float = LEVEL) -> float:
    """t such that |T| < t with probability `level`, for Student's distribution; infinite without a degree of freedom."""
    if freedom < 1:
        return math.inf
    low, high = 0.0, 1.0

    def inside(t: float) -> float:
        return 1 - incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t))
    while inside(high) < level:
        high *= 2
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if inside(middle) < level else (low, middle)
    return (low + high) / 2


@dataclass(frozen=True)
class Estimate:
    """A value with its standard error and the degrees of freedom of that."""
    value: float
    error: float
    freedom: float

    def half_width(self) -> float:
        return student_quantile(self.freedom) * self.error if self.freedom >= 1 else math.inf

    def low(self) -> float:
        return self.value - self.half_width()

    def high(self) -> float:
        return self.value + self.half_width()

    def z(self) -> float:
        """Distance from 0 in standard errors."""
        return self.value / self.error if self.error > 0 else (0.0 if self.value == 0 else math.copysign(math.inf, self.value))

    def json(self) -> dict:
        return {"value": self.value, "error": self.error, "low": self.low(), "high": self.high()}


def mean_estimate(values: list[float] | np.ndarray) -> Estimate:
    """The mean of independent values."""
    count = len(values)
    error = float(np.std(values, ddof=1)) / math.sqrt(count) if count > 1 else math.inf
    return Estimate(float(np.mean(values)), error, count - 1)


def welch(first: Estimate, second: Estimate, sign: float = -1) -> Estimate:
    """first - second of two independent estimates (sign 1: their sum), with Welch's degrees of freedom."""
    a, b = first.error**2, second.error**2
    parts = sum(v * v / e.freedom for v, e in ((a, first), (b, second)) if v > 0 and e.freedom > 0)
    freedom = (a + b)**2 / parts if parts > 0 else max(first.freedom, second.freedom)
    return Estimate(first.value + sign * second.value, math.sqrt(a + b), freedom)


@dataclass(frozen=True)
class Work:
    """Variance x cost of a setting: its inverse efficiency. From pairs of slices: each tells a variance (half of the mean squared
    difference) and a cost."""
    variances: np.ndarray
    costs: np.ndarray

    def value(self) -> float:
        return float(self.variances.mean() * self.costs.mean())

    def influences(self) -> np.ndarray:
        """How much each pair moves the logarithm of `value`, to first order; the mean is 0."""
        parts = np.zeros(len(self.variances))
        for values in (self.variances, self.costs):
            if values.mean() > 0:
                parts = parts + values / values.mean() - 1
        return parts

    def log(self) -> Estimate:
        """Logarithm of `value`; -inf with error 0 when there is no noise."""
        value = self.value()
        if value <= 0:
            return Estimate(-math.inf, 0, max(1, len(self.variances) - 1))
        found = mean_estimate(self.influences())
        return Estimate(math.log(value), found.error, found.freedom)

    def interval(self) -> tuple[float, float]:
        log = self.log()
        return math.exp(log.low()), math.exp(min(700, log.high()))

    def tail_share(self) -> float:
        """Share of the largest pair in all variance. Near 1 the variance is a matter of luck."""
        total = self.variances.sum()
        return float(self.variances.max() / total) if total > 0 else 0.0


def log_ratio(first: Work, second: Work) -> Estimate:
    """log(first / second). Pairs with one number were rendered next to each other, on the same machine in the same state: when
    both have as many, what slowed down both cancels."""
    a, b = first.log(), second.log()
    if len(first.variances) != len(second.variances) or not (math.isfinite(a.value) and math.isfinite(b.value)):
        return welch(a, b)
    found = mean_estimate(first.influences() - second.influences())
    return Estimate(a.value - b.value, found.error, found.freedom)


def tied_with_best(works: list[Work]) -> tuple[int, list[bool]]:
    """The index of the smallest work, and which of the others cannot be told from it at 95 %. Bonferroni over all pairs of
    settings, as the same numbers say which is the best."""
    best = min(range(len(works)), key=lambda i: works[i].value())
    level = 1 - (1 - LEVEL) / max(1, len(works) * (len(works) - 1) // 2)
    ties = []
    for work in works:
        difference = log_ratio(work, works[best])
        same = work is works[best] or work.value() == works[best].value()
        limit = student_quantile(difference.freedom, level) * difference.error if difference.error > 0 else 0.0
        ties.append(same or abs(difference.value) < limit)
    return best, ties
