# SPDX-License-Identifier: BSD-2-Clause
from figurekit.catalogue import Figure
from figurekit.convergence_on_lines import BIASED, URM, check_known, claims, draw, measured
from figurekit.intervals import Interval
from figurekit.plotting import panels
from figurekit.run import Run

FIGURE = Figure(
    title="Variance against look-ups on a fractal density",
    reported="Averaged p-CMF falls like one over the cost, with a raised majorant a little faster; unbiased ray marching falls much faster, with bumps.",
    settings="Our fractal density of eight octaves, T = 0.22; the control is raised by 1 to 64, of ray marching for the number of teeth alone; end points not matched. "
             "For the biased variant the mean squared error.",
    seconds=60)

ESTIMATORS = ["p-series-cmf", URM, BIASED]
FACTORS = [1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0, 22.0, 32.0, 45.0, 64.0]


def make(run: Run) -> None:
    rows = measured(run, "fractal-a", 0.22, FACTORS, ESTIMATORS)
    run.table(rows)
    plot, (panel,) = panels(1, 1, (5.2, 3.3))
    draw(panel, rows, ESTIMATORS)
    panel.set_ylabel("variance")
    panel.legend(fontsize=7, frameon=False)
    run.plot(plot)
    claims(run, rows, URM, "fractal density")
    urm = [float(r["variance"]) for r in rows if r["estimator"] == URM]
    run.claim("its curve has bumps: the largest rise from one cost to the next", Interval.exact(max(b / a for a, b in zip(urm, urm[1:]))), above=1.5,
              why="")
    check_known(run, "fractal-a", ".22")
    run.time_twin([*ESTIMATORS, "ratio"], extinction="fractal-a", depth=1.514127732629775, control=[1, 8], doublings=run.pick(10, 7))
