# SPDX-License-Identifier: BSD-2-Clause
from figurekit import chess, renders
from figurekit.catalogue import Figure
from figurekit.run import Run

FIGURE = Figure(
    title="A game of chess",
    reported="At equal look-ups p-series CMF has much less noise than ratio tracking in the homogeneous board and in the pieces of noise; next-flight, MIS and p-series cumulative are between.",
    settings="A game of our own, pieces turned from outlines: fields of extinction 2 and 4, pieces of Perlin noise up to 12, one bound for each of 1.5 times its largest, absorbing, "
             "before a white environment, without the paper's glass. 112 x 56 pixels; squared error x look-ups, 6 renders each.",
    seconds=90)

ESTIMATORS = {"ratio": "ratio", "next-flight": "next-flight", "MIS": "unidirectional-mis", "p-cumulative": "p-series-cumulative", "p-CMF": "p-series-cmf"}


def make(run: Run) -> None:
    game = str(run.text_file("game.pbrt", chess.game()))
    settings = {name: {"estimator": e} for name, e in ESTIMATORS.items()}
    found = renders.compare(run, "chess.pbrt", settings, run.pick(16, 4), (run.pick(1024, 256), {"estimator": "unbiased-ray-marching"}), run.pick(6, 4), {"game": game}, files=[game],
                            longer=run.pick(8, 4))
    run.plot(renders.gallery(found, columns=3, size=3, height=0.62))
    run.table(found.rows())
    run.render_twin(found.curves())
    for name in settings:
        if name != "ratio":
            run.claim(f"{name} beats ratio tracking at equal look-ups, squared error x look-ups of ratio tracking over its", found.gain("ratio", name), above=1,
                      why="on the noise of the pieces it has more variance than ratio tracking, and on bounds of 1.5 times the largest more look-ups")
    for name in ("next-flight", "MIS", "p-cumulative"):
        run.claim(f"p-CMF beats {name}, squared error x look-ups of that over its", found.gain(name, "p-CMF"), above=1, why="where tau is small p-CMF has its four look-ups all the same")
    run.claim("p-CMF in run time, squared error x seconds of ratio tracking over its", found.timed_gain("ratio", "p-CMF"), above=1)
