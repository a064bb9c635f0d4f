# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.clamping import image_of, noise
from figurekit.intervals import Interval
from figurekit.plotting import curve, log_axes, panels, pictures
from figurekit.run import Run

FIGURE = Figure(
    title="Averaging images under rising bounds",
    reported="The running average of images under bounds that rise step by step converges to the image of the whole density; the first ones are visibly biased.",
    settings="Our grid of 32^3 densities up to 16 (the paper's smoke is not public), one bound for all that starts at 0.1 and rises by 0.5 an image, and by the factor 1.5 as in "
             "rule 13; transmittance without noise, so that all error is bias.",
    seconds=30)

COUNT = 128


def rise(rule: str, index: int) -> float:
    return 0.1 + 0.5 * index if rule == "plus 0.5" else 0.1 * 1.5**index


def make(run: Run) -> None:
    grid = noise()
    truth, _ = image_of(run, grid, "whole")
    count = run.pick(COUNT, 48)
    plot, axes = panels(4, 4, (1.95, 2.1), ["RMS error", "first", "average of 16", "right"])
    twin, (timed,) = panels(1, 1, (5, 3))
    rows, errors = [], {}
    for index, rule in enumerate(("plus 0.5", "times 1.5")):
        total, seconds, curve_seconds, found = np.zeros_like(truth), 0.0, [], []
        for step in range(count):
            bound = rise(rule, step)
            image, took = (truth, seconds / max(1, step)) if bound >= grid.max() else image_of(run, np.minimum(grid, np.float32(bound)), f"bound-{bound:.3g}")
            total += image
            seconds += took
            found.append(float(np.sqrt(((total / (step + 1) - truth)**2).mean())))
            curve_seconds.append(seconds)
            rows.append({"rule": rule, "image": step + 1, "bound": bound, "rms_error_of_average": found[-1], "cpu_seconds": seconds})
            if rule == "plus 0.5" and step in (0, 15):
                pictures(axes[1 if step == 0 else 2], np.repeat((total / (step + 1))[:, :, None], 3, axis=2))
        errors[rule] = found
        curve(axes[0], list(range(1, count + 1)), found, index, rule, marks="")
        curve(timed, curve_seconds, found, index, rule, marks="")
    for panel, name in ((axes[0], "images"), (timed, "CPU seconds of rendering")):
        log_axes(panel)
        panel.set_xlabel(name, fontsize=8)
        panel.legend(fontsize=6.5, frameon=False)
    timed.set_ylabel("RMS error of the average")
    pictures(axes[3], np.repeat(truth[:, :, None], 3, axis=2))
    run.plot(plot)
    run.time_plot(twin)
    run.table(rows)
    for rule, found in errors.items():
        run.claim(f"{rule}: the average converges to the right image, RMS error after {count} images over that of the first", Interval.exact(found[-1] / found[0]), below=8 / count)
        half = found[-1] / found[len(found) // 2 - 1]
        run.claim(f"{rule}: once bounds are high enough error falls like 1 / images, last over that at half of them", Interval.exact(half), above=0.45, below=0.55)
    run.claim("the first images are visibly biased: RMS error of the average of eight, plus 0.5", Interval.exact(errors["plus 0.5"][7]), above=0.02)
