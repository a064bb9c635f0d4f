# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import panels
from figurekit.run import Run

FIGURE = Figure(
    title="Ratio tracking along a line, with a control that bounds and one that does not",
    reported="Under a bound the weights are in [0, 1] and fall; without it they change sign and grow where the extinction is more than twice the control.",
    settings="Five sines and a step at x = 1 on [0, 5], controls 3.5 and 0.4 (extinctions from 0.16 to 3.2); running weights of 60 walks, and the mean of many.",
    seconds=30)

CONTROLS = (3.5, 0.4)
LARGEST = 3.2158351064865616
DEPTH = 12.661604218246856


def walks(run: Run, control: float, count: int) -> list[tuple[list[float], list[float]]]:
    """Where each walk looked, and its weight from there on."""
    found = []
    for seed in range(1, count + 1):
        rows = run.lab("profile", estimator="ratio", extinction="step-sine", depth=DEPTH, control=control / LARGEST, points=2, seed=seed)
        x, weights = [0.0], [1.0]
        for row in rows:
            if row["kind"] == "ratio":
                x.append(float(row["s"]))
                weights.append(weights[-1] * (1 - float(row["extinction"]) / control))
        found.append((x, weights))
    return found


def make(run: Run) -> None:
    plot, axes = panels(2, 2, titles=[f"control {c:g}" for c in CONTROLS])
    table, extremes = [], {}
    for panel, control in zip(axes, CONTROLS):
        found = walks(run, control, run.pick(60, 20))
        for index, (x, weights) in enumerate(found):
            panel.step([*x, 5], [*weights, weights[-1]], where="post", color="#888888", linewidth=0.5, alpha=0.6)
            table += [{"control": control, "walk": index, "x": a, "weight": w} for a, w in zip(x, weights)]
        extremes[control] = (min(min(w) for _, w in found), max(max(w) for _, w in found))
        # Up to x the optical depth is that of the piece; the lab scales a piece to its depth.
        lengths = (0.5, 1.0, 1.5, 2.0, 3.0)
        means = []
        for length in lengths:
            row, = run.lab("estimate", estimator="ratio", extinction="step-sine", length=length, depth=DEPTH * share(length), control=control / peak(length),
                           trials=run.pick(200_000, 20_000))
            run.unbiased([row])
            means.append((length, float(row["mean"]), float(row["mean_stderr"]), float(row["exact"])))
        panel.errorbar([m[0] for m in means], [m[1] for m in means], yerr=[1.96 * m[2] for m in means], fmt="o-", color="#d55e00", markersize=3, linewidth=1.2)
        panel.set_xlim(0, 3)
        panel.set_ylim(-1, 2)
        panel.set_xlabel("x", fontsize=8)
        if control == 3.5:
            for length, printed in ((1.0, "0.8123"), (3.0, "0.0016")):
                run.expect(f"T(0, {length:g})", printed, next(m[3] for m in means if m[0] == length))
    run.plot(plot)
    run.table(table)
    run.claim("3.5: no weight is below 0, the least", Interval.exact(extremes[3.5][0]), above=-1e-9)
    run.claim("3.5: no weight is above 1, the largest", Interval.exact(extremes[3.5][1]), below=1 + 1e-9)
    run.claim("0.4: weights change sign, the least", Interval.exact(extremes[0.4][0]), below=0)
    run.claim("0.4: weights grow, the largest magnitude", Interval.exact(max(map(abs, extremes[0.4]))), above=100)
    run.time_twin(["ratio"], extinction="step-sine", length=1.5, depth=DEPTH * share(1.5), control=[3.5 / LARGEST, 0.4 / LARGEST])


PERIODS = (.459536, .366002, .495886, .334674, .179380)
PHASES = (3.835247, 1.978004, 1.230734, 3.250040, 1.203935)
AMPLITUDES = (.061865, .069937, .050750, .008637, .034073)


def extinction(x: np.ndarray) -> np.ndarray:
    sines = sum(a / 2 * (1 + np.sin(2 * np.pi * x / p + f)) for p, f, a in zip(PERIODS, PHASES, AMPLITUDES))
    return sines + np.where(x < 1, 0.1, 3.0)


def share(length: float) -> float:
    """Of the optical depth of the whole line, up to `length`."""
    x = (np.arange(200_000) + 0.5) / 200_000
    return float(extinction(length * x).mean() * length) / float(extinction(5 * x).mean() * 5)


def peak(length: float) -> float:
    """The largest extinction up to `length`."""
    return float(extinction(np.linspace(0, length, 200_001)[:-1]).max())
