# SPDX-License-Identifier: BSD-2-Clause
import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import heat_map, panels
from figurekit.run import Run
from figurekit.slab import THICKEST, Maps, Slab

FIGURE = Figure(
    title="Ablation on a slab",
    reported="Each step (symmetrised series with combs, matched end points, rare corrections) lowers variance x cost, by two to three orders where the density is "
             "rough and up to five where it is smooth; the rare corrections are the largest step.",
    settings="Our slab, rougher to the right, optical depth 0 at the bottom to 9.9 on top; log10 of variance x look-ups, under each ray's tight control and under one "
             "control for all. The paper has 256 x 256 pixels or more, here are 20 x 20 with 2000 estimates each.",
    seconds=120)

STEPS = {
    "p-CMF": "p-series-cmf",
    "U-BK and combs": "unbiased-ray-marching:endpointmatching=off:roulette=bk",
    "+ end points": "unbiased-ray-marching:endpointmatching=auto:roulette=bk",
    "+ rare corrections": "unbiased-ray-marching:endpointmatching=auto",
}


def steps(maps: Maps, part: slice) -> list[Interval]:
    """Gain of each step in variance x look-ups over columns `part`: the median over pixels, and the interval of the median over rows of pixels."""
    names, found = list(STEPS.values()), []
    for before, after in zip([*names[:-1], names[0]], [*names[1:], names[-1]]):
        logs = np.log(np.maximum(maps.work(before)[:, part], 1e-16) / np.maximum(maps.work(after)[:, part], 1e-16))
        mean = Interval.mean([float(np.median(row)) for row in logs])
        found.append(Interval(*(float(np.exp(x)) for x in (mean.value, mean.low, mean.high))))
    return found


def make(run: Run) -> None:
    size = run.pick(20, 8)
    slab = Slab(run, size)
    names = list(STEPS.values())
    tight = slab.measure(names, run.pick(2000, 1000))
    wide = slab.measure(names, run.pick(1000, 300), is_global=True)
    plot, axes = panels(8, 4, (2.0, 1.75), [*STEPS, *("" for _ in STEPS)])
    for row, maps in enumerate((tight, wide)):
        for panel, name in zip(axes[4 * row:], names):
            heat_map(panel, maps.work(name), (0, 1, 0, THICKEST), 1e-7, 5e-1)
            panel.tick_params(labelsize=6)
    axes[0].set_ylabel("tight control\noptical depth", fontsize=7)
    axes[4].set_ylabel("one control\noptical depth", fontsize=7)
    run.plot(plot)
    run.table([{"control_of": what, **r} for what, maps in (("ray", tight), ("slab", wide)) for r in maps.rows])
    rough, smooth = slice(size // 2, size), slice(0, size // 4)
    for what, maps in (("tight controls", tight), ("one control", wide)):
        combs, ends, rare, whole = steps(maps, rough)
        run.claim(f"{what}, rough half: combs gain, factor in variance x look-ups", combs, above=1)
        run.claim(f"{what}, rough half: matched end points gain on top", ends, above=1, why="two look-ups a comb are a large share, and only combs of eight teeth or more get them")
        run.claim(f"{what}, rough half: rare corrections gain on top", rare, above=1)
        run.claim(f"{what}, rough half: two to three orders in all", whole, above=100, why="medians over pixels; our slab is another one, and its thin lower rows gain least")
        run.claim(f"{what}, smooth quarter: up to five orders; our median of all", steps(maps, smooth)[3], above=1000, why="the median is over thin rows too")
    run.unbiased([r for r in tight.rows if float(r["depth"]) < 3])
    middle = slab.tables[size // 2]
    run.time_twin([*names, "ratio"], files=[middle], extinction=str(middle), depth=3, doublings=run.pick(10, 7))
