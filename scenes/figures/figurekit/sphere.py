# SPDX-License-Identifier: BSD-2-Clause
"""What the figures of Szirmay-Kalos et al. 2017 have in common: transmittance of a sphere at equal look-ups, and walks along one ray."""
import math

import numpy as np

from compare.lab_plot import lab_figure  # noqa: F401  (chooses matplotlib's backend)

from . import renders
from .closed_forms import sine_medium
from .intervals import Interval
from .plotting import panels
from .run import Run

SCENE = "sphere-transmittance.pbrt"
LENGTH = 20.0


def transmittance_images(run: Run, medium: str, budget: int, has_marching: bool) -> None:
    """Ray marching, Woodcock tracking and the random medium, all of nearly the same look-ups in a pixel, rays as the paper has them."""
    ray_marching = {"ray marching": {"estimator": "ray-marching", "stepsize": 0.9 * 10 / budget}} if has_marching else {}
    settings = {**ray_marching, "Woodcock": {"estimator": "track-length"}, "random medium": {"estimator": "random-medium", "explorers": 6}}
    reference = (run.pick(256, 64), {"estimator": "unbiased-ray-marching"})
    probe = {name: run.render(SCENE, 1, define={"medium": medium, **define}) for name, define in settings.items()}
    pixels = probe["Woodcock"].pixels.shape[0] * probe["Woodcock"].pixels.shape[1]
    spp = {name: max(1, round(budget * pixels / image.lookups)) for name, image in probe.items()}
    found = renders.compare(run, SCENE, settings, spp, reference, run.pick(16, 8), {"medium": medium})
    run.plot(renders.gallery(found, columns=4))
    run.table([{"samples_per_pixel": spp[r["setting"]], **r} for r in found.rows()])
    run.render_twin(found.curves())
    others = [n for n in settings if n != "random medium"]
    for name in others:
        run.claim(f"the random medium has less error than {name.replace('Woodcock', 'Woodcock tracking')} at equal look-ups, squared error x look-ups of that over its",
                  found.gain(name, "random medium"), above=1,
                  why="marching with a random offset for each ray has noise instead of structure, little of it at steps that resolve the medium, and its bias is small" if name == "ray marching" else
                  "explorers cost look-ups")
        run.claim(f"the same in run time, {name}", found.timed_gain(name, "random medium"), above=1, why="explorers and the main part through them cost time beside the look-ups")
    if has_marching:
        run.claim("ray marching has less error than Woodcock tracking at equal look-ups, squared error x look-ups of that over its", found.gain("Woodcock", "ray marching"), above=1)
        run.claim("marching darkens or brightens the image, mean difference in shares of the mean", found.bias("ray marching"), above=0,
                  why="its bias is below the noise")


def sine_line(count: int = 4001) -> tuple[np.ndarray, np.ndarray]:
    """The central ray of the analytic medium."""
    z = np.linspace(0, LENGTH, count)
    return z, sine_medium(np.zeros(count), np.zeros(count), z)


def noise_line(count: int = 8001) -> tuple[np.ndarray, np.ndarray]:
    """Twelve octaves of gradient noise along a line, in [0, 1] and below 0.6 mostly. Ours: the paper does not tell its frequencies."""
    z = np.linspace(0, LENGTH, count)
    rng, total, weight = np.random.default_rng(5), np.zeros(count), 0.0
    for octave in range(12):
        gradients = rng.uniform(-1, 1, int(LENGTH * 0.15 * 2**octave) + 3)
        at = z * 0.15 * 2**octave
        cell = at.astype(int)
        inside = at - cell
        fade = inside**3 * (inside * (6 * inside - 15) + 10)
        total += 0.5**octave * 2 * ((1 - fade) * gradients[cell] * inside + fade * gradients[cell + 1] * (inside - 1))
        weight += 0.5**octave
    return z, np.clip(((1 + total / weight) / 2 - 0.4) / 0.6, 0, 1)


def walk_figure(run: Run, z: np.ndarray, density: np.ndarray, rate: float, variance: float) -> None:
    """The density, the main part through ten explorers, points of one walk, and estimates of T with the band of one standard deviation. `variance`: of the walk
    without a main part, exact."""
    table = run.text_file("ray.csv", "x,density\n" + "".join(f"{a:.9g},{b:.9g}\n" for a, b in zip(z, density)))
    depth = float(((density[1:] + density[:-1]) / 2 * np.diff(z)).sum())
    line = {"files": [table], "extinction": str(table), "depth": f"{depth:.12g}"}
    estimator = f"random-medium:explorers=10:samplingextinction={rate}"
    profile = run.lab("profile", estimator=estimator, points=256, **line)
    points = [r for r in profile if r["kind"] != "field"]
    explorers = z[0] + LENGTH * (np.arange(10) + 0.5) / 10
    plot, (left, right) = panels(2, 2, (3.9, 2.8), ["one ray", "estimates of its transmittance"])
    left.plot(z, density, color="#444444", linewidth=1, label="extinction")
    left.plot(explorers, np.interp(explorers, z, density), color="#0072b2", linewidth=1.2, marker="o", markersize=2.5, label="main part")
    left.plot([float(r["s"]) for r in points], [float(r["extinction"]) for r in points], "x", color="#d55e00", markersize=4, label="look-ups")
    left.legend(fontsize=6.5, frameon=False)
    singles = [float(run.lab("estimate", estimator=estimator, trials=2, samples_per_estimate=1, seed=s, **line)[0]["mean"]) for s in range(1, run.pick(41, 13))]
    row, = run.lab("estimate", estimator=estimator, trials=run.pick(2_000_000, 200_000), **line)
    plain, = run.lab("estimate", estimator="ratio", control=rate / float(density.max()), trials=run.pick(200_000, 20_000), **line)
    exact = float(row["exact"])
    spread = math.sqrt(float(row["variance"]) / 2)  # means of two
    right.axhspan(exact - spread, exact + spread, color="#e8eef7")
    right.axhline(exact, color="#0072b2", linewidth=1)
    right.plot(range(len(singles)), singles, "o", color="#444444", markersize=2.5)
    right.set_xlabel("pairs of walks", fontsize=8)
    run.plot(plot)
    run.table([{**r} for r in profile])
    run.unbiased([row])
    inside = sum(abs(s - exact) <= spread for s in singles)
    run.claim("most estimates are inside the band of one standard deviation, share", Interval.share(inside, len(singles)), above=0.5)
    run.claim("variance of the walk without a main part (exact) over that with it",
              Interval(*(variance / (float(row["variance"]) + s * 1.96 * float(row["variance_stderr"])) for s in (0, 1, -1))), above=1,
              why="ten explorers do not follow the density, and the rate is low")
    run.claim("look-ups of a walk, explorers included, over those of ratio tracking at the same rate", Interval.exact(float(row["lookups"]) / float(plain["lookups"])), above=1)
    run.time_twin([estimator, "track-length", "ratio", "unbiased-ray-marching"], doublings=run.pick(10, 7), **line)
