# SPDX-License-Identifier: BSD-2-Clause
"""Plots in the look of `pbrt-compare`, and the pictures of the docs, which are small files."""
import io
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image as Picture

from compare.plots import dress, plain_ticks, style  # chooses matplotlib's backend

from matplotlib.axes import Axes  # isort: skip
from matplotlib.figure import Figure as Plot  # isort: skip

__all__ = ["Axes", "Plot", "curve", "dress", "heat_map", "legend_below", "log_axes", "panels", "pictures", "save", "shrink", "style"]

DPI = 100
WIDEST = 1100
MOST_BYTES = 40_000
"""Of a picture of the docs."""

# Pillow before 9.1, which Ubuntu 22.04 has, knows no such classes.
LANCZOS = getattr(Picture, "Resampling", Picture).LANCZOS
NO_DITHER = Picture.Dither.NONE if hasattr(Picture, "Dither") else 0
# Colours far from each other, however few pixels have them, then moved to what they stand for: other ways merge thin lines beside a picture of many shades.
SPREAD = Picture.Quantize.MAXCOVERAGE if hasattr(Picture, "Quantize") else 1


def panels(count: int, columns: int = 2, size: tuple[float, float] = (3.7, 2.7), titles: Sequence[str] = ()) -> tuple[Plot, list[Axes]]:
    """Axes in rows; `size` is that of one, in inches."""
    columns = min(columns, count)
    lines = math.ceil(count / columns)
    plot = Plot(figsize=(size[0] * columns, size[1] * lines), layout="constrained")
    all_axes = list(plot.subplots(lines, columns, squeeze=False).reshape(-1))
    for axes in all_axes[count:]:
        axes.remove()
    for i, axes in enumerate(all_axes[:count]):
        dress(axes, titles[i] if i < len(titles) else "")
    return plot, all_axes[:count]


def log_axes(axes: Axes, x: bool = True, y: bool = True) -> None:
    """Logarithmic axes with plain ticks: call it when all is drawn."""
    for line, wanted in ((axes.xaxis, x), (axes.yaxis, y)):
        if wanted:
            (axes.set_xscale if line is axes.xaxis else axes.set_yscale)("log")
            plain_ticks(line, *line.get_view_interval())


def curve(axes: Axes, x: Sequence[float], y: Sequence[float], index: int, label: str = "", errors: Sequence[float] | None = None,
          marks: str = "o") -> None:
    """A line with marks, and bars of 95 % where `errors` (standard errors) are given. What is not finite or not above 0 on a logarithmic axis is
    left out."""
    colour, dash = style(index)
    points = [(a, b, 1.96 * e) for a, b, e in zip(x, y, errors if errors is not None else [0.0] * len(x), strict=True) if math.isfinite(b)]
    if not points:
        return
    # On logarithmic axes a bar must not reach 0.
    bars = [[min(e, 0.9 * abs(b)) for _, b, e in points], [e for _, _, e in points]]
    axes.errorbar([p[0] for p in points], [p[1] for p in points], yerr=bars if errors is not None else None, fmt=marks + dash, color=colour, markersize=3,
                  linewidth=1.2, elinewidth=0.9, capsize=1.5, label=label or None)


def legend_below(plot: Plot, axes: Axes, columns: int, inches: float = 0.4) -> None:
    """What the labels of `axes` mean, below all panels."""
    width, height = plot.get_size_inches()
    plot.set_size_inches(width, height + inches)
    rect = (0, inches / (height + inches), 1, height / (height + inches))
    if hasattr(plot, "get_layout_engine"):
        plot.get_layout_engine().set(rect=rect)
    else:  # matplotlib before 3.6, which Ubuntu 22.04 has: room all around
        plot.set_constrained_layout_pads(h_pad=inches / 2)
    plot.legend(*axes.get_legend_handles_labels(), fontsize=7, frameon=False, loc="lower center", ncol=columns)


def heat_map(axes: Axes, values: np.ndarray, extent: tuple[float, float, float, float], low: float, high: float) -> None:
    """log10 of positive values, row 0 at the bottom, colours from `low` to `high` (values, not logarithms), with a bar."""
    axes.grid(False)
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.log10(np.maximum(values, 1e-300))
    shown = axes.imshow(logs, origin="lower", extent=extent, aspect="auto", cmap="viridis", vmin=math.log10(low), vmax=math.log10(high),
                        interpolation="nearest")
    bar = axes.figure.colorbar(shown, ax=axes, pad=0.02)
    bar.ax.tick_params(labelsize=6)
    bar.ax.set_title("log₁₀", fontsize=6)


def pictures(axes: Axes, pixels: np.ndarray, exposure: float = 1.0) -> None:
    """A render, as a display shows it."""
    light = np.clip(pixels * exposure, 0, 1)
    axes.imshow(np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.power(light, 1 / 2.4) - 0.055), interpolation="nearest")
    axes.grid(False)
    axes.set_xticks([])
    axes.set_yticks([])


def save(plot: Plot, path: Path) -> None:
    """PNG and PDF: the same plot gives the same files."""
    plot.savefig(path.with_suffix(".png"), dpi=DPI, metadata={"Software": None})
    plot.savefig(path.with_suffix(".pdf"), metadata={"CreationDate": None})


def shrink(source: Path, most: int = MOST_BYTES) -> bytes:
    """A PNG as a smaller file: fewer colours, and where these do not suffice fewer pixels."""
    picture = Picture.open(source).convert("RGB")
    if picture.width > WIDEST:
        picture = picture.resize((WIDEST, round(picture.height * WIDEST / picture.width)), LANCZOS)
    while True:
        for colours in (64, 32, 16):
            out = io.BytesIO()
            picture.quantize(colours, method=SPREAD, kmeans=1, dither=NO_DITHER).save(out, "PNG", optimize=True)
            if out.tell() <= most:
                return out.getvalue()
        picture = picture.resize((picture.width * 4 // 5, picture.height * 4 // 5), LANCZOS)
