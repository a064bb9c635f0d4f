# SPDX-License-Identifier: BSD-2-Clause
"""How to render one pixel again."""
from .analysis import SettingResult
from .maps import WorstPixel


def replay(result: SettingResult, worst: WorstPixel, window: tuple[int, int, int, int]) -> str:
    """The command that renders the pixel of its slice alone: random numbers depend on seed, pixel and sample only, so that the value is
    the same bit for bit, unless bounds are learned from other pixels. Of another program, or where options crop already, the whole slice."""
    renderer = result.entry.renderer
    seed, spp = worst.slice.seed, worst.slice.spp
    if renderer.setting.command or "--cropwindow" in (*renderer.case.options, *renderer.scene.options, *renderer.setting.options):
        return renderer.shell(seed, spp, "again.exr")
    left, top, width, height = window
    x, y = left + worst.x, top + worst.y
    # A window from a to b has the pixels from ceil(a) to ceil(b) - 1.
    ends = (max(0.0, x - 0.5) / width, (x + 0.5) / width, max(0.0, y - 0.5) / height, (y + 0.5) / height)
    return renderer.shell(seed, spp, "pixel.exr", ("--cropwindow", *(f"{e:.9g}" for e in ends)))
