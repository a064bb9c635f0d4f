# SPDX-License-Identifier: BSD-2-Clause
"""Comparing what was measured with numbers that were printed somewhere."""
import math
from decimal import Decimal

MOST_ERRORS = 4.0
"""Standard errors that a measured number may be off."""


def last_digit(printed: str) -> float:
    """A unit of the last digit of a printed number: 0.01 of "3.49". Printed numbers are right to this much: some are rounded twice."""
    exponent = Decimal(printed).as_tuple().exponent
    assert isinstance(exponent, int), printed
    return 10.0**exponent


def disagreement(printed: str, value: float, error: float = 0.0, printed_error: float = 0.0) -> float:
    """How far `value` is beyond what is allowed, as a multiple of that: at most 1 when they agree. Allowed are a unit of the last
    printed digit and four standard errors of both."""
    allowed = 1.000001 * last_digit(printed) + MOST_ERRORS * math.hypot(error, printed_error)
    return abs(value - float(printed)) / allowed if math.isfinite(value) else math.inf
