# SPDX-License-Identifier: BSD-2-Clause
import math

from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.closed_forms import cmf_moments
from figurekit.puffs import SCENE, SKY, bounds, learned
from figurekit.run import Run

FIGURE = Figure(
    title="Equal look-ups in a medium that scatters much",
    reported="Ratio tracking is best as it is cheap, learned bounds come close to it, p-CMF, debiased and unbiased ray marching are behind, as most noise is not of transmittance.",
    settings="Perlin clouds, albedo 0.99, up to 100 scatterings, sun and sky (the paper's cloud is not public), weighted delta tracking; squared error x look-ups, free flight included. "
             "Both ways: estimators of whole rays, over 24^3 super-voxels with their own bounds, which are of interval arithmetic where exact: looser than learned ones; and, as the published "
             "code does, one for each interval between super-voxel borders, multiplied (interval-product), unbiased ray marching also with that code's elementary means.",
    seconds=180)

COMMON = {"flight": "weighted-delta", "scatter": "[ .99 .99 .99 ]", "absorb": "[ .01 .01 .01 ]", "depth": 100, "sigma": 20}
OTHERS = {"p-CMF": "p-series-cmf", "debiased": "debiased-ray-marching", "unbiased": "unbiased-ray-marching"}


def intervals(base: str, more: str = "") -> dict[str, str]:
    """Of each interval an estimate of its own."""
    return {"estimator": "interval-product", "--mediumparams": f'{bounds("exact")["--mediumparams"]} "string base" "{base}"{more}'}


def check_known(run: Run) -> None:
    """On a step under eight bounds: means, second moments and look-ups of products are the products and sums of those of the parts."""
    depth, control, cells = 2.0, 1.5, 8
    extinctions = [0.2 * depth] * 4 + [None] + [2.2 * depth] * 3  # the step, at 0.6, is inside the fifth
    rows = run.lab("estimate", estimator=["interval-product:base=p-series-cmf", "interval-product:base=ratio", "p-series-cmf"], extinction="step", depth=depth,
                   control=control, supervoxels=cells, trials=run.pick(400_000, 40_000))
    run.unbiased(rows)
    second = lookups = walk = 0.0
    squares, walks = 1.0, 1.0
    for extinction in extinctions:
        parts = [(extinction, 1.0)] if extinction is not None else [(0.2 * depth, 0.8), (2.2 * depth, 0.2)]
        bar = control * max(mu for mu, _ in parts) / cells
        mean = sum(share * (1 - mu / cells / bar) for mu, share in parts)
        square = sum(share * (1 - mu / cells / bar)**2 for mu, share in parts)
        second, cost = cmf_moments(bar, mean, square)
        squares *= second
        lookups += cost
        walks *= math.exp(bar * (square - 1))
        walk += bar
    truth = math.exp(-2 * depth)
    for row, wanted, cost in ((rows[0], squares - truth, lookups), (rows[1], walks - truth, walk)):
        run.expect(f"{row['estimator']}: variance on a step", f"{wanted:.6g}", float(row["variance"]), float(row["variance_stderr"]))
        run.expect(f"{row['estimator']}: look-ups on a step", f"{cost:.6g}", float(row["lookups"]), 2 * math.sqrt(cost / float(row["trials"])))


def make(run: Run) -> None:
    check_known(run)
    exact = bounds("exact")
    whole = {"ratio": {"estimator": "ratio", **exact}, **{n: {"estimator": e, **exact} for n, e in OTHERS.items()}, "learned": {"estimator": "ratio", **learned()}}
    parts = {f"{n}, intervals": intervals(e) for n, e in OTHERS.items()}
    parts["unbiased, as published"] = intervals(OTHERS["unbiased"], ' "string elementarymeans" "published"')
    found = renders.compare(run, SCENE, whole | parts, run.pick(8, 3), (run.pick(128, 48), {"estimator": "ratio", **exact}), run.pick(4, 3), COMMON, files=SKY, longer=2)
    run.plot(renders.gallery(found, columns=5, size=1.45))
    run.table(found.rows())
    run.render_twin(found.curves())
    for name in OTHERS:
        run.claim(f"{name} is behind ratio tracking, squared error x look-ups over its", found.gain(name, "ratio"), above=1,
                  why="on whole rays its look-ups pay back nearly what they cost" if name != "p-CMF" else "")
        run.claim(f"{name} in run time", found.timed_gain(name, "ratio"), above=1, why="look-ups in a row are cheaper than those of a walk")
    run.claim("learned bounds are as good as exact ones or close to it, squared error x look-ups over its", found.gain("learned", "ratio"), below=1.5,
              why="the first passes see a thinner medium, and few samples do not average that away")
    for name in parts:
        run.claim(f"{name}: called for each super-voxel interval it is far behind ratio tracking, squared error x look-ups over its", found.gain(name, "ratio"), above=2,
                  why="few intervals of a ray are occupied, each by little")
    for name in OTHERS:
        run.claim(f"{name}: most of that is of the intervals, squared error x look-ups over that on whole rays", found.gain(f"{name}, intervals", name), above=1.5,
                  why="rays cross few occupied super-voxels here")
