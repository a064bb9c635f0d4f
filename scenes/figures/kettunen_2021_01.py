# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit import columns
from figurekit.catalogue import Figure
from figurekit.columns import PREVIOUS, SCENES
from figurekit.intervals import Interval, ratio_of_means
from figurekit.run import Run

FIGURE = Figure(
    title="Smoke in glass",
    reported="On paths of two transmissions in a row unbiased ray marching has an order of magnitude less error than earlier estimators at equal look-ups, the biased form half of that again.",
    settings="Our smoke of 32^3 in a ball of glass that mirrors nothing: all light that arrives is of two transmissions. Green is absorbed twice as much as red. Errors are against the same "
             "paths with exact transmittance, so that edges and reflections have no part in them; one sample of a pixel, 16 renders each. Bounds of tracking are raised as for figure 11.",
    seconds=30)


def make(run: Run) -> None:
    found = columns.measure(run, SCENES["glass"])
    run.plot(columns.gallery({"glass": found}, {"glass": True}, 1.7))
    run.table(found.rows("glass"))
    run.render_twin(found.curves)
    for name in PREVIOUS:
        run.claim(f"squared error of {name} over that of unbiased ray marching (the paper: at least 11)", ratio_of_means(found.columns[name].noise, found.columns["unbiased"].noise), above=3)
    run.claim("squared error of unbiased over biased ray marching (the paper: 2.5)", ratio_of_means(found.columns["unbiased"].noise, found.columns["biased"].noise), above=1)
    for name in ("ratio", "unbiased"):
        run.claim(f"look-ups are equal: those of {name} over p-CMF's", Interval.exact(float(np.mean(found.columns[name].lookups) / np.mean(found.columns["p-CMF"].lookups))),
                  above=0.8, below=1.25)
    run.claim("in run time: squared error x seconds of p-CMF over unbiased", ratio_of_means(found.columns["p-CMF"].timed(), found.columns["unbiased"].timed()), above=1)
