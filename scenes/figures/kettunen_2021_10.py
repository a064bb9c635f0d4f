# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="The jump at the end points, and its removal",
    reported="An illustration: where the ends differ the periodic extension jumps, and a linear control removes the jump.",
    settings="The density that rises (fractal B), its periodic extension less the line through its ends; unbiased ray marching of M teeth with and without matched ends.",
    seconds=10)

TEETH = (1, 2, 4, 8, 16, 32, 64)


def fractal(x: np.ndarray) -> np.ndarray:
    waves = sum(2.0**(-k / 2) * np.cos(2 * np.pi * 2**k * 1.37 * x + 0.7 * k * k) for k in range(8))
    return np.maximum(0, 0.8 + 6 * x + 0.3 * waves)


def make(run: Run) -> None:
    plot, (left, right) = panels(2, 2, titles=["periodic extension", "variance against look-ups"])
    x = np.linspace(0, 2, 1001)[:-1]
    values = fractal(x % 1)
    ends = fractal(np.array([0.0, 1.0]))
    curve(left, list(x), list(values), 0, "density", marks="")
    curve(left, list(x), list(values - (ends[1] - ends[0]) * (x % 1 - 0.5)), 1, "less the line", marks="")
    left.legend(fontsize=7, frameon=False)
    rows, found = [], {}
    for index, match in enumerate(("off", "on")):
        found[match] = [run.lab("estimate", estimator=f"unbiased-ray-marching:tuplesize={m}:endpointmatching={match}", extinction="fractal-b", depth=1.5,
                                trials=run.pick(200_000, 20_000))[0] for m in TEETH]
        run.unbiased(found[match], 1e-6)
        rows += found[match]
        curve(right, [float(r["lookups"]) for r in found[match]], [float(r["variance"]) for r in found[match]], index, f"matched ends: {match}")
    log_axes(right)
    right.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table(rows)
    last = found["off"][-1], found["on"][-1]
    run.claim("64 teeth: variance x look-ups without matched ends over that with them", ratio(*(float(r[c]) * float(r["lookups"]) for r in last for c in ("variance", "variance_stderr"))), above=10)
    straight = [run.lab("estimate", estimator=f"unbiased-ray-marching:tuplesize={m}:endpointmatching=on", extinction="linear-up", depth=1, trials=1000)[0] for m in (1, 2, 5, 8)]
    for row in straight:
        run.expect(f"variance on a straight density, {row['estimator']}", "0e-12", float(row["variance"]))
    run.claim("a straight density is exact with matched ends for every number of teeth, largest deviation", Interval.exact(max(float(r["variance"])**0.5 for r in straight)), below=1e-6)
    run.time_twin([f"unbiased-ray-marching:tuplesize=16:endpointmatching={m}" for m in ("off", "on")], extinction="fractal-b", depth=1.5, doublings=run.pick(9, 7))
