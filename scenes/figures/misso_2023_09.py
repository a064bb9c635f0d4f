# SPDX-License-Identifier: BSD-2-Clause
from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.puffs import SCENE, SKY, bounds, learned
from figurekit.run import Run

FIGURE = Figure(
    title="Equal look-ups in a medium that scatters much",
    reported="Ratio tracking is best as it is cheap, learned bounds come close to it, p-CMF, debiased and unbiased ray marching are behind, as most noise is not of transmittance.",
    settings="Perlin clouds, albedo 0.99, up to 100 scatterings, sun and sky (the paper's cloud is not public), weighted delta tracking; squared error x look-ups, free flight included. "
             "Estimators work on whole rays, over super-voxels with their own bounds, which are of interval arithmetic where exact: looser than learned ones.",
    seconds=120)

COMMON = {"flight": "weighted-delta", "scatter": "[ .99 .99 .99 ]", "absorb": "[ .01 .01 .01 ]", "depth": 100, "sigma": 20}
OTHERS = {"p-CMF": "p-series-cmf", "debiased": "debiased-ray-marching", "unbiased": "unbiased-ray-marching"}


def make(run: Run) -> None:
    settings = {"ratio": {"estimator": "ratio", **bounds("exact")}, **{n: {"estimator": e, **bounds("exact")} for n, e in OTHERS.items()},
                "learned": {"estimator": "ratio", **learned()}}
    found = renders.compare(run, SCENE, settings, run.pick(8, 3), (run.pick(128, 48), {"estimator": "ratio", **bounds("exact")}), run.pick(4, 3), COMMON, files=SKY, longer=2)
    run.plot(renders.gallery(found, columns=6, size=1.45))
    run.table(found.rows())
    run.render_twin(found.curves())
    for name in OTHERS:
        run.claim(f"{name} is behind ratio tracking, squared error x look-ups over its", found.gain(name, "ratio"), above=1,
                  why="on whole rays its look-ups pay back nearly what they cost" if name != "p-CMF" else "")
        run.claim(f"{name} in run time", found.timed_gain(name, "ratio"), above=1, why="look-ups in a row are cheaper than those of a walk")
    run.claim("learned bounds are as good as exact ones or close to it, squared error x look-ups over its", found.gain("learned", "ratio"), below=1.5,
              why="the first passes see a thinner medium, and few samples do not average that away")
    run.untested("called for each super-voxel interval, as published, the expensive estimators are far behind",
                 "our estimators take whole rays; a mode that multiplies estimates of intervals is not there")
