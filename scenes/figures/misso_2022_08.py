# SPDX-License-Identifier: BSD-2-Clause
from compare.slope import slope_of
from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.plotting import panels
from figurekit.run import Run

FIGURE = Figure(
    title="Debiased ray marching under four laws",
    reported="Debiased ray marching renders classical and non-exponential transmittance without bias, and its variance falls like one over the number of samples.",
    settings="Our plume instead of the paper's cloud, the exponential law and three of Davis and Mineev-Weinstein (C, beta = 0.5, 1; 0.8, 1; 0.8, 0.5; the paper's are in its "
             "picture only), against regular tracking of the same law.",
    seconds=60)

LAWS = {"exponential": ("exponential", 0, 1), "C 0.5, beta 1": ("davis", 0.5, 1), "C 0.8, beta 1": ("davis", 0.8, 1), "C 0.8, beta 0.5": ("davis", 0.8, 0.5)}
FILES = ["../data/plume.nvdb"]


def medium(estimator: str, law: tuple[str, float, float]) -> dict[str, str]:
    name, correlation, beta = law
    more = f' "float correlation" {correlation} "float beta" {beta}' if name == "davis" else ""
    return {"estimator": estimator, "--mediumparams": f'"string law" "{name}"{more}'}


def make(run: Run) -> None:
    plot, axes = panels(8, 4, (1.5, 2.2))
    rows, curves = [], {}
    for index, (name, law) in enumerate(LAWS.items()):
        found = renders.compare(run, "plume.pbrt", {name: medium("debiased-ray-marching", law)}, 4, (run.pick(2048, 128), medium("regular", law)), run.pick(8, 4), files=FILES,
                                longer=run.pick(48, 12))
        renders.pictures(axes[index], found.reference)
        renders.pictures(axes[4 + index], found.settings[name].first)
        axes[index].set_title(name, fontsize=7.5)
        rows += found.rows()
        curves.update(found.curves())
        run.claim(f"{name}: no bias, mean difference in shares of the mean", found.bias(name), above=-0.01, below=0.01)
        curve = [r for r in found.settings[name].curve if float(r["spp"]) >= 1]
        slope = slope_of([float(r["spp"]) for r in curve], [float(r["mse"]) for r in curve])
        run.claim(f"{name}: squared error falls like 1 / samples, slope of one render", Interval.exact(slope if slope is not None else float("nan")), above=-1.2, below=-0.8)
    run.plot(plot)
    run.table(rows)
    run.render_twin(curves)
