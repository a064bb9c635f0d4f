# SPDX-License-Identifier: BSD-2-Clause
from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import curve, log_axes, panels
from figurekit.puffs import SCENE, SKY, bounds, learned
from figurekit.run import Run

FIGURE = Figure(
    title="Convergence of learned bounds and of the error",
    reported="Bounds are found fast: 92 % of the super-voxels bound after a pass, 97.7 % after 4096, where the curve flattens; the squared error is nearly that with exact bounds.",
    settings="Perlin clouds, 24^3 super-voxels, absorption 0.3 and scattering 0.7 of the extinction (the paper's cloud is not public), start value 0.01, epsilon 0.2, ratio and "
             "weighted delta tracking. Shares are of super-voxels that paths visited.",
    seconds=120)

COMMON = {"estimator": "ratio", "flight": "weighted-delta", "depth": 20}


def make(run: Run) -> None:
    most = run.pick(128, 32)
    truth = (run.pick(512, 128), {**COMMON, **bounds("exact")})
    curves, stats = {}, {}
    for name, define in (("exact", bounds("exact")), ("learned", learned())):
        image = run.render(SCENE, most, define={**COMMON, **define}, files=SKY, reference=truth)
        curves[name], stats[name] = image.curve, image.statistics
    passes = stats["learned"]["renders"][0]["learnedBounds"][0]["passes"]
    share = [float(p["boundingShare"]) for p in passes]
    plot, (left, right) = panels(2, 2, titles=["visited super-voxels that do not bound", "mean squared error"])
    curve(left, list(range(1, len(share) + 1)), [1 - s for s in share], 0, marks="")
    log_axes(left)
    left.set_xlabel("passes", fontsize=8)
    for index, (name, rows) in enumerate(curves.items()):
        curve(right, [float(r["spp"]) for r in rows], [float(r["mse"]) for r in rows], index, name)
    log_axes(right)
    right.set_xlabel("samples of a pixel", fontsize=8)
    right.legend(fontsize=7, frameon=False)
    run.plot(plot)
    run.table([{"pass": i + 1, **p} for i, p in enumerate(passes)])
    run.render_twin(curves)
    run.claim("bounds are found fast: share that bounds after 16 passes", Interval.exact(share[15]), above=0.9,
              why="with one sample of 32 x 32 pixels a pass sees few of the super-voxels, and the share is of all that were ever visited")
    run.claim("share that bounds in the end", Interval.exact(share[-1]), above=0.95, why="paths visit new super-voxels in every pass; the paper has 180 times as many pixels")
    run.claim("the curve flattens: growth of the share in the last half of the passes over that in the first half",
              Interval.exact((share[-1] - share[len(share) // 2]) / (share[len(share) // 2] - share[0])), below=0.1)
    last = {n: float(r[-1]["mse"]) for n, r in curves.items()}
    repeated = renders.compare(run, SCENE, {"exact": bounds("exact"), "learned": learned()}, most // 4, truth, 3, COMMON, files=SKY, longer=1)
    run.claim(f"squared error is nearly that with exact bounds, {most // 4} passes, over it",
              renders.ratio_of_means(repeated.settings["learned"].errors, repeated.settings["exact"].errors), above=0.5, below=1.5,
              why="the bias of the first passes, which see a thinner medium, is still there")
    run.claim(f"the same after {most} passes, of one render", Interval.exact(last["learned"] / last["exact"]), above=0.5, below=1.5,
              why="the bias of the first passes fades like one over their number")
