# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.derivatives import difference, draw, errors
from figurekit.intervals import ratio_of_means
from figurekit.run import Run

FIGURE = Figure(
    title="Derivative of an image by the place of a lamp",
    reported="As figure 5 with edges of shadows: progressive differences have no plateau. The printed schedule k^-1/6 falls more slowly than k^-1/3.",
    settings="The shadow of a ball under a point light that moves right; first step 0.4, 16 samples a pass, against central differences of step 0.02. 24 x 24 pixels, 3 runs.",
    seconds=40)

STEP = 0.4


def make(run: Run) -> None:
    samples = [16 * 2**k for k in range(0, run.pick(6, 4))]
    right = np.mean([run.render("moving-lamp.pbrt", run.pick(16384, 2048), seed=90 + s, define=difference("x", 0.02, "none", difference="central")).pixels for s in range(2)], axis=0)
    settings = {"fixed": difference("x", STEP, "none", pass_samples=16), "k^-1/3": difference("x", STEP, "progressive", pass_samples=16),
                "k^-1/6": difference("x", STEP, "progressive", pass_samples=16, step_decay=0.1666667)}
    results = {name: errors(run, "moving-lamp.pbrt", define, right, samples, run.pick(3, 2)) for name, define in settings.items()}
    draw(run, right, results)
    run.claim("fixed step: a plateau, squared error at the most samples over that at a quarter of them", results["fixed"].last_over_before(), above=0.8)
    for name in ("k^-1/3", "k^-1/6"):
        run.claim(f"{name}: no plateau, squared error at the most samples over that at a quarter of them", results[name].last_over_before(), below=0.9)
    slopes = [results[n].slope(len(samples) // 3) for n in ("k^-1/3", "k^-1/6")]
    run.claim("k^-1/3: slope of the squared error, -0.67 in theory", slopes[0], above=-0.87, below=-0.47, why="first passes of long steps are still averaged in")
    run.claim("k^-1/6, as printed: slope of the squared error, -0.33 in theory", slopes[1], above=-0.53, below=-0.13, why="first passes of long steps are still averaged in")
    run.claim("the printed schedule is the slower one, its squared error at the most samples over that of k^-1/3",
              ratio_of_means(list(results["k^-1/6"].squares[:, -1]), list(results["k^-1/3"].squares[:, -1])), above=1)
