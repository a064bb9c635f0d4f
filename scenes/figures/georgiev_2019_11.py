# SPDX-License-Identifier: BSD-2-Clause
from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio_of_means
from figurekit.known import rows_of
from figurekit.run import Run

FIGURE = Figure(
    title="Stratified estimates in a render",
    reported="Latin hypercube samples across the eight paths of a pixel bring the error to 0.83 (next-flight), 0.56 (ratio), 0.46 (p-ratio), 0.50 (p-next-flight), 0.44 "
             "(p-cumulative) and 0.50 (p-CMF) of that of independent ones; both forms of ratio tracking are equal without, p-ratio is better with them.",
    settings="Our plume, absorbing, before a white environment, instead of the paper's smoke box; 8 samples of a pixel through points spread over it, pattern latinhypercube against "
             "independent, one bound for the whole, as the paper has.",
    seconds=40)

ESTIMATORS = {"next-flight": "next-flight", "ratio": "ratio", "p-ratio": "p-series-ratio", "p-next-flight": "p-series-next-flight", "p-cumulative": "p-series-cumulative",
              "p-CMF": "p-series-cmf"}
PRINTED = {k["estimator"]: float(k["stratified"]) / float(k["random"]) for k in rows_of("stratified_renders")}


def pattern(name: str) -> str:
    return f'"string pattern" "{name}" "integer supervoxels" 0'


def make(run: Run) -> None:
    for known in rows_of("stratified_renders"):
        run.expect(f"printed RMSE, stratified over independent, {known['estimator']}", known["share"], PRINTED[known["estimator"]])
    settings = {f"{name}{mark}": {"estimator": e, "--mediumparams": pattern(p)} for name, e in ESTIMATORS.items() for mark, p in (("", "independent"), (", LHS", "latinhypercube"))}
    found = renders.compare(run, "plume.pbrt", settings, 8, (run.pick(2048, 512), {"estimator": "regular"}), run.pick(8, 4), files=["../data/plume.nvdb"], longer=2)
    run.plot(renders.gallery(found, columns=7, size=1.1))
    run.table(found.rows())
    run.render_twin({n: c for n, c in found.curves().items() if n.startswith(("ratio", "p-ratio", "p-CMF"))})

    def rms(above: str, below: str) -> Interval:
        square = ratio_of_means(found.settings[above].errors, found.settings[below].errors)
        return Interval(*(v**0.5 for v in (square.value, square.low, square.high)))
    for name in ESTIMATORS:
        run.claim(f"{name}: stratified RMSE over independent (the paper: {PRINTED[name]:.2g})", rms(f"{name}, LHS", name), below=0.95,
                  why="paths of a pixel go through different points of it")
    run.claim("without stratification p-ratio and ratio tracking are equal, RMSE of one over the other", rms("p-ratio", "ratio"), above=0.9, below=1.1)
    run.claim("with it p-ratio is better, RMSE over ratio tracking's", rms("p-ratio, LHS", "ratio, LHS"), below=1)
    cost = ratio_of_means(found.settings["ratio, LHS"].seconds, found.settings["ratio"].seconds)
    run.claim("stratified samples cost no more time (the paper: 290 s against 299 s), seconds of ratio tracking with them over without", cost, below=1.15)
