# SPDX-License-Identifier: BSD-2-Clause
from figurekit.catalogue import Figure
from figurekit.run import Run
from figurekit.sphere import transmittance_images

FIGURE = Figure(
    title="Transmittance of the analytic medium, ten look-ups",
    reported="At ten look-ups a pixel the random medium has less error than ray marching, and far less than Woodcock tracking.",
    settings="The cosine layers in a sphere of equation 21, about 10 look-ups a pixel, Woodcock and marching under one bound of 1; "
             "the random medium with 6 explorers a ray and its automatic rate. 48 x 48 pixels, 16 renders each.",
    seconds=40)


def make(run: Run) -> None:
    transmittance_images(run, "sine", 10, has_marching=True)
