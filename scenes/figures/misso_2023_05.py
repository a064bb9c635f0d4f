# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.clamping import cell_peaks, image_of, noise
from figurekit.intervals import Interval
from figurekit.plotting import curve, panels, pictures
from figurekit.run import Run

FIGURE = Figure(
    title="Cutting densities to a bound",
    reported="Cutting the density to a bound below it is stable but biased: dense regions lose their detail.",
    settings="Left ten sines under the control 1.7, and cut at 1; right our grid of 32^3 densities (the paper has a cloud that is not public), whole and cut to 0.4 times "
             "the largest density of each cell of 4^3, without noise. Over time: ratio tracking of both lines; bias is what cutting leaves.",
    seconds=10)

SINES = ((.459536, 3.835247, .373294), (.366002, 1.978004, .421999), (.495886, 1.230734, .306225), (.334674, 3.250040, .052114), (.179380, 1.203935, .205598),
         (.472080, 2.554358, .129045), (.211228, 3.173115, .041064), (.094325, 2.238707, .233507), (.458915, 1.589567, .121171), (.052476, 1.855387, .169688))


def extinction(x: np.ndarray) -> np.ndarray:
    return sum(a / 2 * (1 + np.sin(2 * np.pi * x / p + f)) for p, f, a in SINES)


def make(run: Run) -> None:
    x = np.linspace(0, 1, 4001)
    whole = extinction(x)
    cut = np.minimum(whole, 1)
    run.expect("largest extinction", "1.6463", float(whole.max()))
    run.expect("least extinction", "0.4403", float(whole.min()))
    run.expect("transmittance", "0.367879", math.exp(-float(((whole[1:] + whole[:-1]) / 2).mean())))
    plot, axes = panels(4, 4, (1.95, 2.1), ["extinction", "transmittance up to x", "whole", "cut at 0.4"])
    for index, (name, values) in enumerate((("whole", whole), ("cut at 1", cut))):
        curve(axes[0], list(x[::20]), list(values[::20]), index, name, marks="")
        steps = np.concatenate([[0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(x))])
        curve(axes[1], list(x[::20]), list(np.exp(-steps)[::20]), index, name, marks="")
    axes[0].legend(fontsize=6.5, frameon=False)
    grid = noise()
    images = [image_of(run, grid, "whole")[0], image_of(run, np.minimum(grid, 0.4 * cell_peaks(grid)), "cut")[0]]
    for panel, image in zip(axes[2:], images):
        pictures(panel, np.repeat(image[:, :, None], 3, axis=2))
    run.plot(plot)
    run.table([{"x": a, "whole": w, "cut": c} for a, w, c in zip(x, whole, cut)])
    table = run.text_file("cut.csv", "x,density\n" + "".join(f"{a:.9g},{b:.9g}\n" for a, b in zip(x, cut)))
    depths = [float(((v[1:] + v[:-1]) / 2).mean()) for v in (whole, cut)]
    run.claim("cutting at 1 makes the line too thin: transmittance of the cut one over the right one", Interval.exact(math.exp(depths[0] - depths[1])), above=1)
    row, = run.lab("estimate", files=[table], estimator="ratio", extinction=str(table), depth=f"{depths[1]:.12g}", trials=run.pick(400_000, 40_000))
    run.unbiased([row])
    run.claim("and stable: standard deviation of ratio tracking on the cut line", Interval.exact(math.sqrt(float(row["variance"]))), below=1)
    opaque = [-np.log(np.maximum(i, 1e-6)) for i in images]
    dense = opaque[0] > np.quantile(opaque[0], 0.9)
    run.claim("the image is too bright: mean optical depth of the cut one over the right one, densest tenth of the pixels",
              Interval.exact(float(opaque[1][dense].mean() / opaque[0][dense].mean())), below=0.95)
    run.claim("and dense regions lose detail: deviation of optical depths there, cut over right", Interval.exact(float(opaque[1][dense].std() / opaque[0][dense].std())), below=0.95)
    lines = [{"extinction": "composite-sine", "depth": 1, "control": 1.7 / 1.6463394402399593}, {"files": [table], "extinction": str(table), "depth": f"{depths[1]:.12g}"}]
    rows = [dict(r) for line in lines for r in run.lab("converge", estimator=["ratio"], doublings=run.pick(14, 10), trials=run.pick(256, 64), **line)]
    off = math.exp(-depths[1]) - math.exp(-depths[0])
    twin, (panel,) = panels(1, 1, (5, 3))
    for index, (name, bias, part) in enumerate((("whole", 0.0, rows[:len(rows) // 2]), ("cut at 1", off, rows[len(rows) // 2:]))):
        curve(panel, [float(r["seconds"]) for r in part], [math.hypot(float(r["rmse"]), bias) for r in part], index, name)
    panel.set_xscale("log")
    panel.set_yscale("log")
    panel.set_xlabel("seconds")
    panel.set_ylabel("RMSE against the whole line")
    panel.legend(fontsize=7, frameon=False)
    run.time_plot(twin)
