# SPDX-License-Identifier: BSD-2-Clause
from figurekit.catalogue import Figure
from figurekit.photons import FIXED, signed_bias
from figurekit.run import Run

FIGURE = Figure(
    title="Photon mapping with a fixed kernel, and its bias",
    reported="Photon mapping is blurred; its image and a signed estimate of the bias make an image that is right on the average: blur is traded for noise.",
    settings="The caustic of a glass ball on a floor (the paper's scene is unknown), against bdpt; a cone kernel as wide as two thirds of the caustic, 200 photons an iteration "
             "of the kernel alone, where the paper has 3.3e10 in all; alpha = 2/3. 24 renders of up to 256 iterations for c = 1.001 as printed, of up to 16 for the 0.499 of the published "
             "code, whose photons grow as the square of iterations. Pictures and numbers are medians over renders: see figure 12 for why means do not tell.",
    seconds=240)


def make(run: Run) -> None:
    signed_bias(run, "caustic.pbrt", FIXED, {"debias": "single"},
                {"biased": [2**k for k in range(3, run.pick(9, 7))], "c 1.001": [2**k for k in range(3, run.pick(9, 7))], "c 0.499": [2**k for k in range(run.pick(5, 3))]},
                run.pick(24, 8), 0.6)
