# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.run import Run
from figurekit.sphere import noise_line, walk_figure

FIGURE = Figure(
    title="One ray through a Perlin medium",
    reported="As figure 5, where the main part follows only the coarse octaves.",
    settings="Twelve octaves of our own gradient noise along a line of length 20 (the paper's are unknown), sampling extinction 0.4, 10 explorers.",
    seconds=20)


def make(run: Run) -> None:
    z, density = noise_line()
    square = float(np.mean((density[1:]**2 + density[1:] * density[:-1] + density[:-1]**2) / 3) * 20)
    depth = float(((density[1:] + density[:-1]) / 2).mean() * 20)
    walk_figure(run, z, density, 0.4, math.exp(-2 * depth) * math.expm1(square / 0.4))
