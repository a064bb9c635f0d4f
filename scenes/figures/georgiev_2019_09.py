# SPDX-License-Identifier: BSD-2-Clause
from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.run import Run

FIGURE = Figure(
    title="A dense cloud under a tight and a loose control",
    reported="Ratio tracking is best, p-CMF second and faster in time, p-series cumulative third; next-flight and MIS are poor, and bidirectional MIS is slow under the loose control.",
    settings="Our plume of extinction up to 8 before a white environment instead of the paper's cloud in glass; one bound for the whole, 1 and 5 times the largest extinction; "
             "squared error x look-ups, 6 renders each.",
    seconds=60)

ESTIMATORS = {"ratio": "ratio", "next-flight": "next-flight", "MIS": "unidirectional-mis", "p-cumulative": "p-series-cumulative", "p-CMF": "p-series-cmf"}
SIGMA = 8


def make(run: Run) -> None:
    settings = {f"{name} x {factor}": {"estimator": e, "--mediumparams": f'"string bounds" "constant" "float majorant" {SIGMA * factor} "integer supervoxels" 0'}
                for factor in (1, 5) for name, e in ESTIMATORS.items()}
    found = renders.compare(run, "plume.pbrt", settings, {n: run.pick(8, 4) for n in settings}, (run.pick(1024, 512), {"estimator": "regular"}), run.pick(6, 4), {"sigma": SIGMA},
                            files=["../data/plume.nvdb"], longer=2)
    run.plot(renders.gallery(found, columns=6, size=1.2))
    run.table(found.rows())
    run.render_twin(found.curves())
    for factor in (1, 5):
        for name in ("next-flight", "MIS", "p-cumulative", "p-CMF"):
            run.claim(f"control x {factor}: ratio tracking is better than {name}, squared error x look-ups of that over its", found.gain(f"{name} x {factor}", f"ratio x {factor}"), above=1)
        run.claim(f"control x {factor}: p-CMF is faster than its look-ups tell, squared error x seconds of ratio tracking over its",
                  found.timed_gain(f"ratio x {factor}", f"p-CMF x {factor}"), above=1, why="its look-ups are cheaper than those of a walk, but there are more of them")
        run.claim(f"control x {factor}: p-CMF is second, before p-series cumulative, squared error x look-ups of that over its", found.gain(f"p-cumulative x {factor}", f"p-CMF x {factor}"),
                  above=1)
        run.claim(f"control x {factor}: next-flight is poor, squared error x look-ups over that of p-series cumulative", found.gain(f"next-flight x {factor}", f"p-cumulative x {factor}"), above=1)
