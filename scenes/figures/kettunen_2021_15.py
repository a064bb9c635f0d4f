# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import heat_map, panels
from figurekit.run import Run
from figurekit.slab import THICKEST, Slab

FIGURE = Figure(
    title="Raised controls on a slab",
    reported="p-CMF can get worse near T = 1 when the control is raised, as its pivot is bad there; unbiased ray marching improves with every factor.",
    settings="The slab of figure 14, each ray's tight control times 1, 10 and 100; log10 of variance. 16 x 16 pixels, 1000 estimates each.",
    seconds=120)

FACTORS = (1, 10, 100)
NAMES = {"p-CMF": "p-series-cmf", "unbiased ray marching": "unbiased-ray-marching"}


def make(run: Run) -> None:
    size = run.pick(16, 6)
    slab = Slab(run, size)
    maps = {f: slab.measure(list(NAMES.values()), run.pick(1000, 200), f) for f in FACTORS}
    plot, axes = panels(6, 3, (2.5, 1.9), [f"{n}, x {f}" for n in ("p-CMF", "unbiased") for f in FACTORS])
    for panel, (name, factor) in zip(axes, [(n, f) for n in NAMES.values() for f in FACTORS]):
        heat_map(panel, maps[factor].variance[name], (0, 1, 0, THICKEST), 1e-9, 1e-1)
        panel.tick_params(labelsize=6)
    run.plot(plot)
    run.table([{"raised": f, **r} for f in FACTORS for r in maps[f].rows])

    def logs(name: str, low: int, high: int, rows: slice, with_cost: bool) -> Interval:
        a, b = ((m.work(NAMES[name]) if with_cost else m.variance[NAMES[name]])[rows] for m in (maps[low], maps[high]))
        mean = Interval.mean([float(np.median(r)) for r in np.log(np.maximum(b, 1e-14) / np.maximum(a, 1e-14)).T])
        return Interval(*(float(np.exp(x)) for x in (mean.value, mean.low, mean.high)))
    thin, all_ = slice(0, max(1, size // 8)), slice(0, size)
    run.claim("p-CMF gets worse near T = 1: variance x look-ups at 10 over that at 1, lowest rows", logs("p-CMF", 1, 10, thin, True), above=1,
              why="variance falls there nearly as the cost rises")
    for low, high in ((1, 10), (10, 100)):
        run.claim(f"unbiased ray marching improves from {low} to {high}: variance, median over pixels", logs("unbiased ray marching", low, high, all_, False), below=1)
        run.claim(f"and so does its variance x look-ups from {low} to {high}", logs("unbiased ray marching", low, high, all_, True), below=1,
                  why="single precision of the optical depth is all that is left where the density is smooth")
    middle = slab.tables[size // 2]
    run.time_twin(list(NAMES.values()), files=[middle], extinction=str(middle), depth=3, control=[1, 10, 100], doublings=run.pick(9, 6), trials=64)
