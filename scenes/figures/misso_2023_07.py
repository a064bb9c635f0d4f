# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import curve, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Distribution of the next step",
    reported="An illustration: steps at the rate of the null extinction are longer than those at the rate of the majorant.",
    settings="Left a Gaussian with its marker at 0.6 under the control 3.09, right null extinction 1 under the control 3; densities of the next step. Over time: both walks.",
    seconds=10)


def make(run: Run) -> None:
    t = np.linspace(0, 3, 121)
    cases = (("Gaussian at x = 0.6", 3.09, 3.09 - 2.0627 * float(np.exp(-(0.6 - 0.63)**2 / (2 * 0.04)))), ("null extinction 1", 3.0, 1.0))
    plot, axes = panels(2, 2, titles=[c[0] for c in cases])
    rows = []
    for panel, (name, control, null) in zip(axes, cases):
        laws = {"rate of the majorant": control * np.exp(-control * t), "rate of the null extinction": null * np.exp(-null * t)}
        for index, (law, values) in enumerate(laws.items()):
            curve(panel, list(t), list(values), index, law, marks="")
            rows += [{"case": name, "law": law, "step": a, "density": b} for a, b in zip(t, values)]
        panel.set_xlabel("length of the step", fontsize=8)
        run.claim(f"{name}: mean step at the rate of the null extinction over that at the majorant's", Interval.exact(control / null), above=1)
    axes[0].legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table(rows)
    measured = run.lab("estimate", estimator=["ratio", "adaptive-ratio"], extinction="gaussian-m23", depth=1, control=1.5, trials=run.pick(400_000, 40_000))
    run.unbiased(measured)
    lookups = [float(r["lookups"]) for r in measured]
    run.claim("so a walk has fewer look-ups, adaptive over ratio tracking, Gaussian", Interval.exact(lookups[1] / lookups[0]), below=1)
    run.time_twin(["ratio", "adaptive-ratio"], extinction="gaussian-m23", depth=1, control=1.5)
