# SPDX-License-Identifier: BSD-2-Clause
import math

from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import panels
from figurekit.run import Run

FIGURE = Figure(
    title="Ratio tracking along a line, with a control that bounds and one that does not",
    reported="Under a bound the weights are in [0, 1] and fall; without it they change sign and grow where the extinction is more than twice the control.",
    settings="medialab running: five sines and a step at x = 1 on [0, 5], controls 3.5 and 0.4 (extinctions from 0.16 to 3.2); running weights of 100 walks, and the mean of 100000 "
             "(the paper: 1000), whose interval is drawn.",
    seconds=20)

CONTROLS = (3.5, 0.4)
LARGEST = 3.2158351064865616
DEPTH = 12.661604218246856


def make(run: Run) -> None:
    plot, axes = panels(2, 2, titles=[f"control {c:g}" for c in CONTROLS])
    table, extremes = [], {}
    for panel, control in zip(axes, CONTROLS):
        rows = run.lab("running", estimator="ratio", extinction="step-sine", depth=DEPTH, control=control / LARGEST, points=100, runs=run.pick(100_000, 10_000), curves=100)
        table += [{"control": control, **row} for row in rows]

        def series(what: float | str) -> dict[float, float]:
            """Values by the end of the line, from 0 on."""
            return {0.0: 0.0 if what == "stderr" else 1.0, **{round(float(r["s"]), 6): float(r["value"]) for r in rows if r["run"] == what}}
        walks = [series(float(number)) for number in range(100)]
        for walk in walks:
            panel.step(list(walk), list(walk.values()), where="post", color="#888888", linewidth=0.5, alpha=0.4)
        extremes[control] = (min(min(w.values()) for w in walks), max(max(w.values()) for w in walks))
        mean, error, exact = series("mean"), series("stderr"), series("exact")
        panel.fill_between(list(mean), [mean[s] - 1.96 * error[s] for s in mean], [mean[s] + 1.96 * error[s] for s in mean], color="#d55e00", alpha=0.25)
        panel.plot(list(mean), list(mean.values()), color="#d55e00", linewidth=1.2, label="mean")
        panel.plot(list(exact), list(exact.values()), ":", color="#0072b2", linewidth=1.2, label="exact")
        panel.set_xlim(0, 3)
        panel.set_ylim(-1, 2)
        panel.set_xlabel("x", fontsize=8)
        panel.legend(fontsize=7, frameon=False)
        for s in (0.5, 1.0, 1.5, 2.0):
            # Beyond the step the variance under the low control lies in events that no such run sees.
            if control == 3.5 or s <= 1:
                run.expect(f"mean at {s:g}, control {control:g}", f"{exact[s]:.6f}", mean[s], error[s])
        for s, printed in ((1.0, "0.8123"), (3.0, "0.0016")):
            run.expect(f"T(0, {s:g})", printed, exact[s])
    run.plot(plot)
    run.table(table)
    run.claim("3.5: no weight is below 0, the least", Interval.exact(extremes[3.5][0]), above=-1e-9)
    run.claim("3.5: no weight is above 1, the largest", Interval.exact(extremes[3.5][1]), below=1 + 1e-9)
    run.claim("0.4: weights change sign, the least", Interval.exact(extremes[0.4][0]), below=0)
    run.claim("0.4: weights grow, the largest magnitude", Interval.exact(max(map(abs, extremes[0.4]))), above=100)
    # The lab scales a piece of a line to its depth.
    run.time_twin(["ratio"], extinction="step-sine", length=1.5, depth=-math.log(exact[1.5]), control=[3.5 / LARGEST, 0.4 / LARGEST])
