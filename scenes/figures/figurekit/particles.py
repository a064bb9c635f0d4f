# SPDX-License-Identifier: BSD-2-Clause
"""Single-particle tracing of Szirmay-Kalos et al. 2017 against the sampling extinction: figures 6 and 7."""
from . import renders
from .renders import Comparison
from .run import Run

SCENE = "sphere-particles.pbrt"
SKY = ["../data/evening-sky.exr"]


def sweep(run: Run, medium: str, models: tuple[str, ...], rates: tuple[float, ...], spp: int) -> Comparison:
    settings = {f"{model} {rate:g}": {"model": model, "rate": rate} for model in models for rate in rates}
    return renders.compare(run, SCENE, settings, spp, (run.pick(1024, 256), {"model": "terminating", "rate": 1}), run.pick(8, 4), {"medium": medium}, files=SKY, longer=4)
