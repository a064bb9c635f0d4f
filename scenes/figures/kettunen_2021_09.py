# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import ratio
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Combs with one offset",
    reported="An illustration: a comb of M equidistant points with one random offset samples the periodic extension of the extinction evenly.",
    settings="The cosine, combs of M points with one offset, jittered and independent; variance of exp of minus the mean, measured as unbiased ray marching without corrections would.",
    seconds=10)

COMBS = ("equidistant", "stratified", "independent")
TEETH = (1, 2, 4, 8, 16, 32)


def make(run: Run) -> None:
    plot, (left, right) = panels(2, 2, titles=["a comb of 8 teeth", "variance against teeth"])
    x = np.linspace(-0.25, 1.25, 400)
    left.plot(x, 1 + np.cos(20 * (x % 1) + 0.8), color="#444444", linewidth=1)
    teeth = (np.arange(8) + 0.37) / 8
    left.plot(teeth, 1 + np.cos(20 * teeth + 0.8), "o", color="#d55e00", markersize=4)
    left.axvspan(0, 1, color="#eef3fa", zorder=0)
    left.set_xlabel("x", fontsize=8)
    rows = []
    for index, comb in enumerate(COMBS):
        found = [run.lab("estimate", estimator=f"biased-ray-marching:comb={comb}:tuplesize={m}:endpointmatching=off", extinction="cosine", depth=1, trials=run.pick(200_000, 20_000))[0]
                 for m in TEETH]
        rows += found
        curve(right, TEETH, [float(r["variance"]) for r in found], index, comb)
    log_axes(right)
    right.set_xlabel("look-ups", fontsize=8)
    right.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table(rows)

    def at(comb: str, teeth_: int) -> tuple[float, float]:
        row = rows[COMBS.index(comb) * len(TEETH) + TEETH.index(teeth_)]
        return float(row["variance"]), float(row["variance_stderr"])
    for other in COMBS[1:]:
        run.claim(f"16 teeth of one offset vary less than {other.replace('stratified', 'jittered')} ones, variance of those over its", ratio(*at(other, 16), *at("equidistant", 16)), above=1)
    for m in (2, 3, 8):
        row, = run.lab("estimate", estimator=f"biased-ray-marching:comb=equidistant:tuplesize={m}:endpointmatching=off", extinction="sine", depth=1, trials=1000)
        run.expect(f"variance of {m} equidistant teeth on one period of a sine", "0e-12", float(row["variance"]))
    row = rows[COMBS.index("stratified") * len(TEETH) + TEETH.index(8)]  # with fewer teeth exponents are skewed, with more their bias drowns in noise
    predicted = float(row["variance"]) / (2 * float(row["exact"]))  # T Var[X] / 2, as the variance is T^2 Var[X]
    run.expect("bias of 8 jittered teeth over T Var[X] / 2", "1.0", (float(row["mean"]) - float(row["exact"])) / predicted, float(row["mean_stderr"]) / predicted)
    run.time_twin([f"biased-ray-marching:comb={c}:tuplesize=16:endpointmatching=off" for c in COMBS], extinction="cosine", depth=1, doublings=run.pick(9, 7))
