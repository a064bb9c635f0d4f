# SPDX-License-Identifier: BSD-2-Clause
"""How fast an error falls: the slope of log(error) over log(cost). -1 for the squared error of independent samples."""
import math

import numpy as np

from .intervals import Estimate, mean_estimate

FEWEST_POINTS = 3


def slope_of(costs: list[float], values: list[float]) -> float | None:
    """Least squares in logarithms. None for fewer than three points with an error above 0, or of a single cost."""
    points = [(math.log(c), math.log(v)) for c, v in zip(costs, values, strict=True) if c > 0 and v > 0]
    if len(points) < FEWEST_POINTS:
        return None
    x, y = (np.array(axis) for axis in zip(*points))
    spread = ((x - x.mean())**2).sum()
    return float(((x - x.mean()) * (y - y.mean())).sum() / spread) if spread > 1e-12 else None


def slope_estimate(curves: list[tuple[list[float], list[float]]]) -> Estimate | None:
    """The mean slope of independent repeats, each a pair of costs and errors. Points of one repeat share samples and are
    not independent; repeats are."""
    slopes = [s for costs, values in curves if (s := slope_of(costs, values)) is not None]
    return mean_estimate(slopes) if slopes else None
