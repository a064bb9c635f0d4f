# SPDX-License-Identifier: BSD-2-Clause
from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.run import Run

FIGURE = Figure(
    title="Weighted delta tracking under bounds that are too low",
    reported="Single scattering in a homogeneous medium: fireflies grow as the bound falls below the extinction.",
    settings="A cube of extinction 1.5 that only scatters, a distant light, one scattering, transmittance without noise; bounds 1, 0.3, 0.1 and 0.01 times the extinction, "
             "128 samples of each pixel.",
    seconds=30)

SCALES = (1.0, 0.3, 0.1, 0.01)


def make(run: Run) -> None:
    settings = {f"{s:g}": {"majorant": 1.5 * s} for s in SCALES}
    found = renders.compare(run, "cube.pbrt", settings, run.pick(128, 32), (run.pick(4096, 1024), {"majorant": 1.5}), run.pick(6, 4))
    run.plot(renders.gallery(found))
    run.table(found.rows())
    run.render_twin(found.curves())
    for high, low in zip(SCALES, SCALES[1:]):
        run.claim(f"squared error grows from {high:g} to {low:g} times the extinction, the one over the other",
                  renders.ratio_of_means(found.settings[f"{low:g}"].errors, found.settings[f"{high:g}"].errors), above=1)
    tall = [float(found.settings[f"{s:g}"].first.max() / found.reference.max()) for s in (1.0, 0.1)]
    run.claim("fireflies: brightest pixel at 0.1 over that at 1", Interval.exact(tall[1] / tall[0]), above=3)
    run.claim("at equal look-ups: squared error x look-ups at 0.1 over that at 1", found.gain("0.1", "1"), above=1, why="a low bound makes fewer look-ups, too")
    run.claim("in run time: the same", found.timed_gain("0.1", "1"), above=1)
    run.untested("means are right whatever the bound", "under 0.3 most of the variance is in single samples, so that no interval of a mean is to be trusted")
