# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.intervals import Interval, ratio
from figurekit.lamp import END, WAYS, integral, lamp_on_axis
from figurekit.plotting import curve, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Single scattering of a lamp on one ray",
    reported="The density of interaction points mimics no factor of what is scattered, so attenuation-driven sampling is poor; resampling (SIR) increases the variance but saves shadow "
             "rays. Source-driven samples follow 1 / r², scattering-driven ones extinction times transmittance.",
    settings="Axis of the analytic medium, a lamp 1 beside it and one 6 beside it; 64 x 64 pixels see this ray, each with many samples. Explorers of 4 x 4 pixels are shared, 32 of them. "
             "What each way has as its mean is compared with a quadrature.",
    seconds=60)

SCENE = "sphere-ray.pbrt"
LAMPS = {"near": (1.0, 8.0), "far": (6.0, 8.0)}


def make(run: Run) -> None:
    spp = run.pick(64, 16)
    rows, found = [], {}
    for lamp, (x, z) in LAMPS.items():
        s, _, scattered = lamp_on_axis((x, z))
        truth = integral(s, scattered)
        for name, way in WAYS.items():
            image = run.render(SCENE, spp, define={"way": way, "lampx": x, "lampz": z})
            values = image.pixels[..., 0].astype(float)
            count = values.size
            mean, variance = float(values.mean()), float(values.var(ddof=1)) * spp
            error = math.sqrt(variance / spp / count)
            moment = float(((values - mean)**4).mean())
            variance_error = math.sqrt(max(moment - (variance / spp)**2, 0) / count) * spp
            shadows = float(image.statistics["renders"][0]["counters"]["shadowRays"]) / (count * spp)
            found[lamp, name] = (variance, variance_error, image.lookups / (count * spp), shadows)
            run.expect(f"mean of {name}, lamp {lamp}", f"{truth:.9g}", mean, error)
            rows.append({"lamp": lamp, "way": name, "exact": truth, "mean": mean, "mean_stderr": error, "variance": variance, "variance_stderr": variance_error,
                         "lookups": found[lamp, name][2], "shadow_rays": shadows})
    run.table(rows)
    draw(run, rows)
    x, z = LAMPS["near"]
    run.render_twin({name: run.render(SCENE, 4 * spp, define={"way": way, "lampx": x, "lampz": z}, reference=(run.pick(1024, 256), {"way": "source-scattering-mis", "lampx": x, "lampz": z})).curve
                     for name, way in WAYS.items()})

    def gain(lamp: str, above: str, below: str, has_cost: bool = False) -> Interval:
        a, b = found[lamp, above], found[lamp, below]
        costs = (a[2], b[2]) if has_cost else (1.0, 1.0)
        return ratio(a[0] * costs[0], a[1] * costs[0], b[0] * costs[1], b[1] * costs[1])
    plain, chosen, source, scattering, both = list(WAYS)[1:]
    run.claim("SIR increases the variance: that of attenuation-driven sampling with it over without, lamp near", gain("near", chosen, plain), above=1)
    run.claim("SIR saves shadow rays: those without it over those with it", Interval.exact(found["near", plain][3] / found["near", chosen][3]), above=1)
    for lamp in LAMPS:
        run.claim(f"SIR pays: variance x look-ups without it over with it, lamp {lamp}", gain(lamp, plain, chosen, True), above=1,
                  why="every walk looks up all of its points again, and shadow rays are cheap where the lamp is near")
    run.claim("attenuation-driven sampling is poor: its variance x look-ups over that of source-driven sampling, lamp near", gain("near", plain, source, True), above=1)
    run.claim("source-driven samples are better near the lamp: variance of scattering-driven over source-driven ones, lamp near", gain("near", scattering, source), above=1)
    run.claim("scattering-driven samples are better far from it: variance of source-driven over scattering-driven ones, lamp far", gain("far", source, scattering), above=1)
    for lamp in LAMPS:
        for other in (source, scattering):
            run.claim(f"their combination has less variance: that of {other} sampling over MIS's, lamp {lamp}", gain(lamp, other, both), above=1)


def draw(run: Run, rows: list[dict]) -> None:
    plot, panel = panels(4, 2, (3.9, 2.6), ["lamp near: what is sampled", "lamp far: what is sampled", "lamp near: variance", "lamp far: variance"])
    for axes, (x, z) in zip(panel, LAMPS.values()):
        s, extinction, scattered = lamp_on_axis((x, z))
        axes.fill_between(s, scattered / integral(s, scattered), color="#dddddd", label="scattered light")
        cauchy = 1 / (x * x + (s - z)**2)
        flight = extinction * np.exp(-np.concatenate(([0.0], np.cumsum((extinction[1:] + extinction[:-1]) / 2 * np.diff(s)))))
        for index, (label, density) in enumerate({"source-driven": cauchy, "scattering-driven": flight, "attenuation-driven": np.full_like(s, 1 / END)}.items()):
            curve(axes, s, density / integral(s, density), index, label, marks="")
        axes.set_xlabel("distance on the ray", fontsize=8)
        axes.legend(fontsize=6.5, frameon=False)
    for axes, lamp in zip(panel[2:], LAMPS):
        own = [r for r in rows if r["lamp"] == lamp]
        at = np.arange(len(own))
        relative = [r["variance"] / r["exact"]**2 for r in own]
        axes.barh(at - 0.2, relative, 0.38, color="#0072b2", label="variance / mean²")
        axes.barh(at + 0.2, [v * r["lookups"] for v, r in zip(relative, own)], 0.38, color="#d55e00", label="× look-ups")
        axes.set_yticks(at, [r["way"].replace("attenuation-driven with SIR", "with SIR") for r in own], fontsize=7)
        axes.invert_yaxis()
        axes.set_xscale("log")
        axes.set_xlim(right=20 * max(v * r["lookups"] for v, r in zip(relative, own)))
        axes.legend(fontsize=6.5, frameon=False)
    run.plot(plot)
