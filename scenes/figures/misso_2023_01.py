# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import panels
from figurekit.puffs import SCENE, SKY, bounds, learned
from figurekit.run import Run

FIGURE = Figure(
    title="Bounds that are right, far too low, cut to, and learned",
    reported="Without bounds that hold, weights explode; cutting densities to the start value is smooth but much too thin; learned bounds are right after tens of passes.",
    settings="Perlin clouds under an evening sky instead of the paper's shell, 24^3 super-voxels, ratio tracking and weighted delta tracking, start value 0.01, epsilon 0.2, "
             "no warm-up, proposals in force from the next pass on (the paper's rule; the published code puts them in force at once). 32 x 32 pixels.",
    seconds=90)

COMMON = {"estimator": "ratio", "flight": "weighted-delta"}


def make(run: Run) -> None:
    spp = run.pick(32, 8)
    settings = {"exact": bounds("exact"), "too low (0.3)": bounds("constant", 0.3), "learned": learned()}
    found = renders.compare(run, SCENE, settings, spp, (run.pick(512, 64), bounds("exact")), run.pick(4, 3), COMMON, files=SKY, longer=2)
    # The first pass alone knows the start value only: images of one pass each are cut to it.
    cut = np.mean([run.render(SCENE, 1, seed=s, define={**COMMON, **learned()}, files=SKY).pixels for s in range(1, run.pick(33, 9))], axis=0)
    plot, axes = panels(5, 5, (1.6, 1.85))
    renders.show(axes[:4], found, list(settings))
    renders.pictures(axes[4], cut)
    axes[4].set_title(f"cut to 0.01\nRMSE {np.sqrt(((cut - found.reference)**2).mean()):.2g}", fontsize=7.5)
    run.plot(plot)
    run.table(found.rows())
    run.render_twin(found.curves())
    exact = found.settings["exact"]
    run.claim("bounds far too low: squared error over that with exact bounds, as many samples", renders.ratio_of_means(found.settings["too low (0.3)"].errors, exact.errors), above=10)
    noise = float(np.mean(exact.errors))
    run.claim("cut to 0.01: squared error over that with exact bounds, as many samples", Interval.exact(float(((cut - found.reference)**2).mean()) / noise), above=2,
              why="the noise of so few samples hides it")
    sky = [np.abs(image - cut).mean() for image in (found.reference,)]
    run.claim("the cut image is that of hardly any medium: its mean difference from the right one, over its deviation from itself", Interval.exact(float(sky[0] / cut.mean())), above=0.02)
    run.claim(f"learned bounds: squared error over that with exact bounds after {spp} passes", renders.ratio_of_means(found.settings["learned"].errors, exact.errors), below=1.5,
              why="first passes see a thin medium, whose bias has not been averaged away yet")
    late = renders.compare(run, SCENE, {"exact": bounds("exact"), "learned": learned()}, spp * 4, (run.pick(512, 64), bounds("exact")), 3, COMMON, files=SKY, longer=1)
    run.claim(f"and after {spp * 4} passes", renders.ratio_of_means(late.settings["learned"].errors, late.settings["exact"].errors), below=1.5, why="bias of the first passes fades like one over their number")
    run.claim(f"mean of the image after {spp * 4} passes with learned bounds, in shares", late.bias("learned"), above=-0.01, below=0.01, why="the start of thin passes is still seen")
