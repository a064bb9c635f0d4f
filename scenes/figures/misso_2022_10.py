# SPDX-License-Identifier: BSD-2-Clause
from figurekit.catalogue import Figure
from figurekit.photons import FIXED, signed_bias
from figurekit.run import Run

FIGURE = Figure(
    title="Photon mapping with a fixed kernel, and its bias",
    reported="Photon mapping is blurred; its image and a signed estimate of the bias make an image that is right on the average: blur is traded for noise.",
    settings="The caustic of a glass ball on a floor (the paper's scene is unknown), against bdpt; a cone kernel as wide as two thirds of the caustic, 200 photons an iteration "
             "(alpha = 2/3, c = 1.001), 16 renders of up to 512 iterations: 1.6e6 photons of the kernel alone, where the paper has 3.3e10.",
    seconds=120)


def make(run: Run) -> None:
    signed_bias(run, "caustic.pbrt", FIXED, {"debias": "single"}, [2**k for k in range(3, run.pick(10, 7))], run.pick(16, 6), 0.6)
