# SPDX-License-Identifier: BSD-2-Clause
from figurekit.catalogue import Figure
from figurekit.photons import signed_bias
from figurekit.run import Run

FIGURE = Figure(
    title="Progressive photon mapping, and the bias it still has",
    reported="Progressive photon mapping is blurred less and less; a signed estimate of what is left makes each of its images right on the average, with more noise.",
    settings="In fog instead of on surfaces: a beam that a glass ball gathers, photons within balls (the paper's scene is unknown), against bdpt; a cone kernel, 200 light paths an "
             "iteration of the kernel alone; alpha = 2/3. 24 renders of up to 128 iterations for c = 1.001 as printed, of up to 16 for the 0.499 of the published code. Pictures and numbers are "
             "medians over renders: see figure 12 for why means do not tell.",
    seconds=240)


def make(run: Run) -> None:
    signed_bias(run, "beam.pbrt", {"debias": "progressive"}, {"debias": "progressive-unbiased"},
                {"biased": [2**k for k in range(2, run.pick(8, 6))], "c 1.001": [2**k for k in range(2, run.pick(8, 6))], "c 0.499": [2**k for k in range(run.pick(5, 3))]},
                run.pick(24, 8), 1.5)
