# SPDX-License-Identifier: BSD-2-Clause
from figurekit.catalogue import Figure
from figurekit.photons import signed_bias
from figurekit.run import Run

FIGURE = Figure(
    title="Progressive photon mapping, and the bias it still has",
    reported="Progressive photon mapping is blurred less and less; a signed estimate of what is left makes each of its images right on the average, with more noise.",
    settings="In fog instead of on surfaces: a beam that a glass ball gathers, photons within balls (the paper's scene is unknown), against bdpt; a cone kernel, 200 light paths an "
             "iteration (alpha = 2/3, c = 1.001), 16 renders of up to 128 iterations.",
    seconds=120)


def make(run: Run) -> None:
    signed_bias(run, "beam.pbrt", {"debias": "progressive"}, {"debias": "progressive-unbiased"}, [2**k for k in range(2, run.pick(8, 6))], run.pick(16, 6), 1.5)
