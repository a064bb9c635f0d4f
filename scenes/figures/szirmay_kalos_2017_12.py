# SPDX-License-Identifier: BSD-2-Clause
from figurekit import renders
from figurekit.catalogue import Figure
from figurekit.lamp import WAYS
from figurekit.renders import Comparison
from figurekit.run import Run

FIGURE = Figure(
    title="Single scattering of a lamp at equal look-ups",
    reported="At 300 look-ups a pixel errors are 104 (ray marching), 128 (Woodcock), 114 (attenuation-driven), 72 (with SIR), and 54 and 52 of the ways that follow; at 50 they are 157, 250, and "
             "102 and 93 of the last two. MIS of source- and scattering-driven sampling is best where the lamp is strong against the sky.",
    settings="Our lamp and a grey sky (the paper's are unknown), 64 x 64 pixels, about 300 and 50 look-ups a pixel, shadow rays included. The view is close to the lamp, so that the 4 x 4 "
             "pixels which share explorers are small against the layers, as in an image of the paper's size; from afar explorers are not like their neighbours, and the walks have rare and "
             "large weights. Ray marching inverts a march of step 0.9 for the flight and marches to the lights; all others have ratio tracking under a bound of 1 for shadow rays.",
    seconds=100)

SCENE = "sphere-lamp.pbrt"
BUDGETS = (300, 50)


def make(run: Run) -> None:
    walking = {name: {"way": way} for name, way in WAYS.items() if way != "collision"}
    settings = {"ray marching": {"way": "collision", "estimator": "ray-marching", "flight": "ray-marching", "step": 0.9},
                "Woodcock": {"way": "collision"}, **walking}
    reference = (run.pick(768, 256), {"way": "mis", "estimator": "unbiased-ray-marching"})
    common = {"edge": run.pick(64, 56)}
    probe = {name: run.render(SCENE, 4, define={**common, **define}) for name, define in settings.items()}
    found, rows = {}, []
    for budget in BUDGETS:
        spp = {name: max(1, round(budget * image.pixels.shape[0] * image.pixels.shape[1] * 4 / image.lookups)) for name, image in probe.items()}
        found[budget] = renders.compare(run, SCENE, settings, spp, reference, run.pick(6, 5), common, longer=4)
        rows += [{"budget": budget, "samples_per_pixel": spp[r["setting"]], **r} for r in found[budget].rows()]
    run.plot(renders.gallery(found[BUDGETS[0]], columns=4, exposure=0.4))
    run.table(rows)
    run.render_twin(found[BUDGETS[0]].curves())
    for budget in BUDGETS:
        claims(run, found[budget], budget)
    strong(run)


def claims(run: Run, found: Comparison, budget: int) -> None:
    plain, chosen, source, scattering, both = list(WAYS)[1:]
    at = f"{budget} look-ups"
    for other in (plain, chosen, source, scattering, both):
        run.claim(f"{at}: {other} has less error than Woodcock tracking, squared error x look-ups of that over its", found.gain("Woodcock", other), above=1,
                  why="collisions of Woodcock tracking are driven by scattering, too, and need no walk" if other == scattering else
                  "walks sample points that scatter little, and paths fly besides")
    if budget == BUDGETS[0]:
        run.claim(f"{at}: SIR pays, squared error x look-ups without it over with it", found.gain(plain, chosen), above=1)
        run.claim(f"{at}: source-driven sampling is better than SIR", found.gain(chosen, source), above=1)
    for other in (source, scattering):
        run.claim(f"{at}: MIS is better than {other} sampling", found.gain(other, both), above=1, why="it takes two shadow rays where that takes one")
    run.claim(f"{at}: ray marching has more error than MIS", found.gain("ray marching", both), above=1, why="its path collides at random, as Woodcock tracking's, at little cost")
    run.claim(f"{at}: the same in run time, Woodcock tracking over MIS", found.timed_gain("Woodcock", both), above=1, why="exploring and walking cost time beside look-ups")


def strong(run: Run) -> None:
    """The same lamp under a sky that outshines it."""
    sky = {"sky": 50, "edge": run.pick(64, 56)}
    names = list(WAYS)[3:]
    settings = {name: {"way": WAYS[name]} for name in names}
    found = renders.compare(run, SCENE, settings, 4, (run.pick(256, 128), {"way": "mis", "estimator": "unbiased-ray-marching"}), run.pick(8, 4), sky, longer=1)
    for other in names[:2]:
        run.claim(f"under a sky that outshines the lamp MIS gains little: squared error x look-ups of {other} sampling over its", found.gain(other, names[2]), below=1.25, why="the lamp's noise is still most of it")
