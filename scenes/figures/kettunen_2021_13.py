# SPDX-License-Identifier: BSD-2-Clause
import math

from figurekit.catalogue import Figure
from figurekit.convergence_on_lines import URM, URM_EM, check_known, claims, draw, measured
from figurekit.intervals import ratio
from figurekit.plotting import panels
from figurekit.run import Run

FIGURE = Figure(
    title="Matching the end points",
    reported="Where the density differs at both ends, unbiased ray marching gains orders of magnitude by matching the end points; where they are similar it costs little.",
    settings="Left a density that rises (T = 0.22), right the fractal of similar ends (T = 0.85), controls raised by 1 to 64; the paper's densities are unknown.",
    seconds=60)

CASES = (("fractal-b", 0.22), ("fractal-a", 0.85))
FACTORS = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0]
ESTIMATORS = ["p-series-cmf", URM, URM_EM]


def make(run: Run) -> None:
    plot, axes = panels(2, 2, titles=[f"{d}, T = {t:g}" for d, t in CASES])
    found = {}
    for panel, (density, transmittance) in zip(axes, CASES):
        found[density] = measured(run, density, transmittance, FACTORS, ESTIMATORS)
        draw(panel, found[density], ESTIMATORS)
    axes[0].set_ylabel("variance", fontsize=8)
    axes[0].legend(fontsize=6.5, frameon=False)
    run.plot(plot)
    run.table([row for rows in found.values() for row in rows])
    claims(run, found["fractal-b"], URM_EM, "unequal ends")
    for density, limit in (("fractal-b", {"above": 10}), ("fractal-a", {"below": 2})):
        for factor in (1.0, 16.0):
            pair = [next(r for r in found[density] if r["estimator"] == n and r["control"] == factor) for n in ((URM, URM_EM) if density == "fractal-b" else (URM_EM, URM))]
            told = "unequal ends: variance x look-ups without matching over that with it" if density == "fractal-b" else "similar ends: variance x look-ups with matching over that without"
            run.claim(f"{told}, control raised by {factor:g}", ratio(*(float(r[c]) * float(r["lookups"]) for r in pair for c in ("variance", "variance_stderr"))), **limit,
                      why="two look-ups more are a large share where a comb has few teeth")
    plain = [next(r for r in found["fractal-b"] if r["estimator"] == URM and r["control"] == f) for f in (FACTORS[0], FACTORS[-1])]
    decade = math.log(float(plain[1]["lookups"]) / float(plain[0]["lookups"]))
    run.expect("unequal ends, not matched: slope of the variance", "-2.0", math.log(float(plain[1]["variance"]) / float(plain[0]["variance"])) / decade,
               math.hypot(*(float(r["variance_stderr"]) / float(r["variance"]) for r in plain)) / decade)
    check_known(run, "fractal-b", ".22")
    check_known(run, "fractal-a", ".85")
    run.time_twin(ESTIMATORS, extinction="fractal-b", depth=-math.log(0.22), control=[1, 16], doublings=run.pick(10, 7))
