# SPDX-License-Identifier: BSD-2-Clause
"""Single scattering of a lamp at one point in the analytic medium of Szirmay-Kalos et al. 2017: figures 11 and 12."""
import numpy as np

from .closed_forms import sine_medium

ALBEDO = 0.7
INTENSITY = 100.0
END = 20.0

WAYS = {"Woodcock": "collision", "attenuation-driven": "attenuation-driven", "attenuation-driven with SIR": "attenuation-driven-sir", "source-driven": "source-driven",
        "scattering-driven": "scattering-driven", "MIS of both": "source-scattering-mis"}
"""The paper's names, and those of `mediumlightsampling`."""


def lamp_on_axis(lamp: tuple[float, float], points: int = 4000, way: int = 400) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Distances s along the axis of the sphere, the extinction there, and what is scattered once from the lamp at (x, 0, z) to its start per length (2 n + 1 points of
    Simpson's rule; ways to the lamp likewise)."""
    s = np.linspace(0, END, 2 * points + 1)
    extinction = sine_medium(np.zeros_like(s), np.zeros_like(s), s)
    depth = np.concatenate(([0.0], np.cumsum((extinction[1:] + extinction[:-1]) / 2 * np.diff(s))))
    x, z = lamp
    share = np.linspace(0, 1, 2 * way + 1)
    weights = simpson_weights(2 * way + 1, 1 / (2 * way))
    r = np.hypot(x, z - s)
    between = sine_medium(x * share[None], 0 * share[None], s[:, None] + (z - s)[:, None] * share[None]) @ weights * r
    cosine = (z - s) / r
    phase = 3 / (16 * np.pi) * (1 + cosine**2)
    return s, extinction, ALBEDO * extinction * np.exp(-depth - between) * phase * INTENSITY / r**2


def simpson_weights(count: int, step: float) -> np.ndarray:
    weights = np.full(count, 2.0)
    weights[1::2] = 4
    weights[[0, -1]] = 1
    return weights * step / 3


def integral(s: np.ndarray, values: np.ndarray) -> float:
    return float(values @ simpson_weights(len(s), float(s[1] - s[0])))
