# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.derivatives import difference, draw, errors
from figurekit.intervals import ratio_of_means
from figurekit.run import Run

FIGURE = Figure(
    title="Derivative of an image by roughness",
    reported="Debiased differences of a step of 0.005 match a reference of step 1e-4, and are noisier than plain ones.",
    settings="A metal ball of roughness 0.2 under a lamp that a bar partly hides, directly lit; step 0.1, plain and debiased by single levels, against plain differences of "
             "step 1e-4: a longer step than the paper's, so that bias is seen. 24 x 24 pixels, 3 runs.",
    seconds=40)

STEP = 0.1


def make(run: Run) -> None:
    samples = [16 * 2**k for k in range(0, run.pick(6, 4))]
    right = np.mean([run.render("rough-metal.pbrt", run.pick(4096, 1024), seed=90 + s, define=difference("roughness", 1e-4, "none")).pixels for s in range(2)], axis=0)
    settings = {"plain": difference("roughness", STEP, "none", pass_samples=1), "debiased": difference("roughness", STEP, "single", pass_samples=1)}
    results = {name: errors(run, "rough-metal.pbrt", define, right, samples, run.pick(3, 2)) for name, define in settings.items()}
    draw(run, right, results)
    scale = float(np.abs(right).mean())
    means = {name: [float(np.abs((run.render("rough-metal.pbrt", samples[-1], seed=1 + s, define=define).pixels - right).mean(axis=(0, 1))).mean() / scale)
                    for s in range(run.pick(3, 2))] for name, define in settings.items()}
    run.claim("plain differences are biased: squared error at the most samples over that at a quarter of them", results["plain"].last_over_before(), above=0.6)
    run.claim("debiased ones are not: the same", results["debiased"].last_over_before(), below=0.5)
    run.claim("debiased differences match the reference: bias of their mean over that of plain ones", ratio_of_means(means["debiased"], means["plain"]), below=0.5,
              why="light is sampled through the material as well, and the directions it draws jump across the edges of lamp and bar as roughness changes: single levels then have the noise of edges")
    run.claim("they are noisier at few samples: squared error of debiased over plain", ratio_of_means(list(results["debiased"].squares[:, 0]), list(results["plain"].squares[:, 0])), above=1, why="bias of the plain step is larger than noise already")
    run.claim("debiased: slope -1 of the squared error", results["debiased"].slope(len(samples) // 3), above=-1.25, below=-0.75,
              why="light is sampled through the material as well, and the directions it draws jump across the edges of lamp and bar as roughness changes: single levels then have the noise of edges")
