# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.derivatives import difference, draw, errors
from figurekit.intervals import ratio_of_means
from figurekit.run import Run

FIGURE = Figure(
    title="Derivative of ambient occlusion by the height of a ball",
    reported="Progressive differences converge to the right derivative without a plateau, a fixed step has one.",
    settings="A plane under a ball of radius 0.8 at height 2, against the closed form; steps 1.2 fixed, and 1.2 k^-1/3 and 1.2 k^-1/6 at pass k of one sample each. 16 x 16 "
             "pixels, 3 runs.",
    seconds=40)

RADIUS, HEIGHT, STEP = 0.8, 2.0, 1.2


def truth(size: int = 16, inside: int = 8) -> np.ndarray:
    """d/dh of 1 - r^2 h / (rho^2 + h^2)^(3/2), averaged over pixels."""
    at = ((np.arange(size * inside) + 0.5) / (size * inside) * 4 - 2)**2
    square = at[:, None] + at[None, :]
    values = RADIUS**2 * (2 * HEIGHT**2 - square) / (square + HEIGHT**2)**2.5
    return np.repeat(values.reshape(size, inside, size, inside).mean(axis=(1, 3))[:, :, None], 3, axis=2)


def make(run: Run) -> None:
    samples = [2**k for k in range(2, run.pick(10, 8), 1)]
    settings = {"fixed": difference("height", STEP, "none", pass_samples=1), "k^-1/3": difference("height", STEP, "progressive", pass_samples=1),
                "k^-1/6": difference("height", STEP, "progressive", pass_samples=1, step_decay=0.1666667)}
    right = truth()
    results = {name: errors(run, "rising-ball.pbrt", define, right, samples, run.pick(3, 2)) for name, define in settings.items()}
    draw(run, right, results)
    finest = np.mean([run.render("rising-ball.pbrt", run.pick(2048, 512), seed=50 + s, define=difference("height", 0.05, "none", difference="central")).pixels for s in range(4)], axis=0)
    run.expect("mean derivative of a small central step", f"{float(right.mean()):.4f}", float(finest.mean()), 0.004)
    run.claim("fixed step: a plateau, squared error at the most samples over that at a quarter of them", results["fixed"].last_over_before(), above=0.6,
              why="at so few samples noise is still as large as bias")
    for name, wanted in (("k^-1/3", -2 / 3), ("k^-1/6", -1 / 3)):
        run.claim(f"{name}: no plateau, squared error at the most samples over that at a quarter of them", results[name].last_over_before(), below=0.85)
        run.claim(f"{name}: slope of the squared error {wanted:.2f} as theory has it, ours", results[name].slope(len(samples) // 2), above=wanted - 0.2, below=wanted + 0.2,
                  why="noise falls faster than bias, and here it is the larger part")
    run.claim("at the most samples the fixed step has more error, squared error over that of k^-1/3",
              ratio_of_means(list(results["fixed"].squares[:, -1]), list(results["k^-1/3"].squares[:, -1])), above=1)
