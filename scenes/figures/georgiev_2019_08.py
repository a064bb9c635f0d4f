# SPDX-License-Identifier: BSD-2-Clause
from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.intervals import Interval
from figurekit.run import Run

FIGURE = Figure(
    title="A homogeneous pawn",
    reported="At equal look-ups p-series CMF is practically free of noise, and fast; next-flight and MIS beat ratio tracking, p-series cumulative is between.",
    settings="A pawn of extinction 0.6 under a bound of 1.5 times that, absorbing, before a white environment; without the paper's glass and mirror, whose choices of "
             "direction would hide the noise of transmittance. Squared error x look-ups, 8 renders each.",
    seconds=30)

ESTIMATORS = {"ratio": "ratio", "next-flight": "next-flight", "unidirectional MIS": "unidirectional-mis", "bidirectional MIS": "bidirectional-mis",
              "p-cumulative": "p-series-cumulative", "p-CMF": "p-series-cmf"}


def make(run: Run) -> None:
    settings = {name: {"estimator": e} for name, e in ESTIMATORS.items()}
    # Marching is exact here. Outlines are noise of every setting.
    found = renders.compare(run, "pawn.pbrt", settings, run.pick(16, 8), (run.pick(1024, 512), {"estimator": "ray-marching"}), run.pick(8, 4))
    inside = {}
    mask = (found.reference[:, :, 0] < 0.85)[1:-1, 1:-1]
    for y in (-1, 1):
        mask &= (found.reference[1 + y:found.reference.shape[0] - 1 + y, 1:-1, 0] < 0.97)
    for x in (-1, 1):
        mask &= (found.reference[1:-1, 1 + x:found.reference.shape[1] - 1 + x, 0] < 0.97)
    for name in settings:
        image = found.settings[name].first[1:-1, 1:-1]
        inside[name] = float(((image - found.reference[1:-1, 1:-1])**2)[mask].mean())
    run.plot(renders.gallery(found, columns=7, size=1.2))
    run.table([*found.rows(), *({"setting": n, "repeat": "inside", "mse": v} for n, v in inside.items())])
    run.render_twin(found.curves())
    for name in ("next-flight", "unidirectional MIS"):
        run.claim(f"{name} beats ratio tracking, squared error x look-ups of ratio tracking over its", found.gain("ratio", name), above=1)
    run.claim("p-series cumulative beats ratio tracking", found.gain("ratio", "p-cumulative"), above=1)
    run.claim("p-CMF beats ratio tracking", found.gain("ratio", "p-CMF"), above=1)
    run.claim("p-CMF beats next-flight, squared error x look-ups of next-flight over its", found.gain("next-flight", "p-CMF"), above=1,
              why="at outlines pixels see both the pawn and the sky, which is noise of every estimator and costs p-CMF as many look-ups as elsewhere")
    run.claim("p-CMF is fast, squared error x seconds of ratio tracking over its", found.timed_gain("ratio", "p-CMF"), above=1)
    run.claim("p-CMF is practically free of noise, its squared error away from outlines over ratio tracking's", Interval.exact(inside["p-CMF"] / inside["ratio"]), below=0.01)
