# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import panels, style
from figurekit.run import Run

FIGURE = Figure(
    title="Terms of the power series under a control",
    reported="With the control equal to the extinction one term is all; a larger control spreads the terms like a Poisson law, a smaller one makes signs alternate.",
    settings="tau = 2.3; the paper does not tell its controls, ours are 1, 2.3, 4.6 and 9.2. Over time: the estimators of these terms at control 1 and 4.6.",
    seconds=8)

DEPTH = 2.3
CONTROLS = (1.0, 2.3, 4.6, 9.2)


def terms(control: float, count: int = 40) -> np.ndarray:
    """e^-control (control - tau)^k / k!"""
    found = [math.exp(-control)]
    for k in range(1, count):
        found.append(found[-1] * (control - DEPTH) / k)
    return np.array(found)


def make(run: Run) -> None:
    plot, axes = panels(4, 4, (1.85, 2.3), [f"control {c:g}" for c in CONTROLS])
    rows = []
    for index, (panel, control) in enumerate(zip(axes, CONTROLS)):
        found = terms(control)
        rows += [{"control": control, "k": k, "term": t} for k, t in enumerate(found)]
        panel.bar(range(14), found[:14], color=style(index)[0])
        panel.set_xlabel("k")
        panel.tick_params(labelsize=7)
        run.expect(f"sum of the terms, control {control:g}", "0.1002588437", float(found.sum()))
    run.claim("control = tau: share of the term k = 0", Interval.exact(float(terms(2.3)[0] / math.exp(-DEPTH))), above=1 - 1e-12, below=1 + 1e-12)
    run.claim("control 1 < tau: signs alternate, least product of two neighbours is below 0 (of the first ten)",
              Interval.exact(float(np.max(terms(1.0)[:9] * terms(1.0)[1:10]))), below=0)
    for control in (4.6, 9.2):
        mean = float((np.arange(40) * terms(control)).sum() / terms(control).sum())
        run.claim(f"control {control:g}: terms are a Poisson law around control - tau, mean of k / (control - tau)", Interval.exact(mean / (control - DEPTH)),
                  above=1 - 1e-9, below=1 + 1e-9)
    run.table(rows)
    run.plot(plot)
    run.time_twin(["p-series-next-flight", "p-series-cumulative", "p-series-cmf"], extinction="constant", depth=DEPTH, control=[1 / DEPTH, 2])
