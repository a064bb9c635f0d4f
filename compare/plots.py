# SPDX-License-Identifier: BSD-2-Clause
"""Curves of error against cost, drawn by matplotlib as PNG and SVG."""
import io
import math
from pathlib import Path

import matplotlib
from PIL import Image

matplotlib.use("Agg")
# Text stays text, and the same curves give the same file.
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "pbrt-compare", "font.size": 9.5, "font.family": "DejaVu Sans"})

from matplotlib.axes import Axes  # noqa: E402
from matplotlib.axis import Axis  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator  # noqa: E402

from .analysis import CurvePoint, SceneResult, SettingResult  # noqa: E402
from .intervals import Estimate  # noqa: E402

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#444444", "#8c6d31", "#b10026", "#4d9221", "#1b9e9e")
"""Told apart by most eyes (the first six are those of Okabe and Ito 2008)."""
DASHES = ("-", "--", ":")
AXIS_TITLES = {"cpu": "CPU seconds of rendering", "wall": "seconds of rendering", "lookups": "density look-ups", "samples": "samples per pixel"}
METRIC_TITLES = {"mse": "mean squared error", "relmse": "relative mean squared error", "relmse_robust": "relative MSE without the worst 0.01 %",
                 "smape": "SMAPE", "mse_cost": "mean squared error × cost"}
"""`mse_cost` is level where the error falls as it should, and tells curves apart that lie close to each other."""


def style(index: int) -> tuple[str, str]:
    return COLOURS[index % len(COLOURS)], DASHES[index // len(COLOURS) % len(DASHES)]


def error_of(point: CurvePoint, axis: str, metric: str) -> Estimate:
    if metric != "mse_cost":
        return point.errors[metric]
    mse, cost = point.errors["mse"], point.costs[axis] or 0
    return Estimate(mse.value * cost, mse.error * cost, mse.freedom)


def draw_setting(axes: Axes, result: SettingResult, axis: str, metric: str, index: int) -> None:
    points = [p for p in result.curve if (p.costs[axis] or 0) > 0 and error_of(p, axis, metric).value > 0]
    if not points:
        return
    colour, dash = style(index)
    x = [p.costs[axis] for p in points]
    found = [error_of(p, axis, metric) for p in points]
    y = [e.value for e in found]
    # Intervals of logarithms: an error is above 0.
    widths = [min(5.0, e.half_width() / e.value) for e in found]
    low, high = ([v * math.exp(sign * w) for v, w in zip(y, widths, strict=True)] for sign in (-1, 1))
    axes.fill_between(x, low, high, color=colour, alpha=0.13, linewidth=0, gid=f"s{index}-band")
    axes.plot(x, y, dash, color=colour, linewidth=1.6, label=result.name, gid=f"s{index}-line")
    for single in (True, False):
        marked = [(a, b) for a, b, p in zip(x, y, points, strict=True) if p.single == single]
        if marked:
            axes.plot(*zip(*marked), "o", color=colour, markersize=4.2, markerfacecolor="white" if single else colour,
                      gid=f"s{index}-{'alone' if single else 'slices'}")


SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def tick_text(value: float, powers: bool) -> str:
    exponent = math.floor(math.log10(value) + 1e-9)
    if -3 < exponent < 4 and not powers:
        return f"{value:g}"
    factor = float(f"{value / 10.0**exponent:.4g}")
    return ("" if factor == 1 else f"{factor:g}·") + "10" + str(exponent).translate(SUPERSCRIPTS)


def plain_ticks(line: Axis, low: float, high: float) -> None:
    """Powers of ten, on short axes 2 and 5 of them too, on shorter ones even steps. matplotlib's own take most of the time of a drawing."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    span = math.log10(high / low)
    factors = (1,) if span > 2.5 else (1, 2, 5) if span > 0.7 else (1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9)
    step = max(1, round(span / 8))
    ticks = [f * 10.0**d for d in decades for f in factors if d % step == 0 and low <= f * 10.0**d <= high]
    if len(ticks) < 2:
        ticks = [t for t in MaxNLocator(4).tick_values(low, high) if low <= t <= high]
    line.set_major_locator(FixedLocator(ticks))
    line.set_minor_locator(NullLocator())
    line.set_major_formatter(FuncFormatter(lambda value, _: tick_text(value, len(factors) == 1)))


def dress(axes: Axes, title: str = "", pad: float = 6) -> None:
    """The look of a panel: its title, a faint grid behind the curves, no box."""
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold", pad=pad)
    axes.grid(True, color="#ececec", linewidth=0.7)
    axes.set_axisbelow(True)
    for name in ("top", "right"):
        axes.spines[name].set_visible(False)


def cut_off_outliers(axes: Axes, scene: SceneResult, axis: str, metric: str) -> None:
    """Ends the plot a factor of 100 above nine tenths of the points: one firefly must not flatten all other curves."""
    found = [error_of(p, axis, metric).value for r in scene.results for p in r.curve if (p.costs[axis] or 0) > 0]
    values = sorted(v for v in found if v > 0)
    if not values:
        return
    top = 100 * values[int(0.9 * (len(values) - 1))]
    if values[-1] > top:
        axes.set_ylim(top=top)
        highest = tick_text(float(f"{values[-1]:.1g}"), True)
        axes.annotate(f"points up to {highest} are cut off", (0.995, 0.985), xycoords="axes fraction", ha="right", va="top",
                      fontsize=7.5, color="#b3261e")


def draw_guides(axes: Axes, metric: str) -> None:
    """Lines of slope -1 (-1/2 for errors that are no squares) behind the curves."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    power = {"smape": 0.5, "mse_cost": 0.0}.get(metric, 1.0)
    axes.set_autoscale_on(False)
    first = math.floor(math.log10(bottom * left**power)) - 1
    last = math.ceil(math.log10(top * right**power)) + 1
    for exponent in range(first, last + 1):
        axes.plot([left, right], [10.0**exponent / left**power, 10.0**exponent / right**power], color="#e2e2e2", linewidth=0.8, zorder=0)


def error_figure(scene: SceneResult, order: dict[str, int], axis: str, metric: str) -> Figure:
    """All settings of a scene; `order` gives each its colour, in all plots the same."""
    figure = Figure(figsize=(8.6, 4.9))
    axes = figure.add_axes((0.12, 0.11, 0.57, 0.81))
    axes.set_xscale("log")
    axes.set_yscale("log")
    for result in scene.results:
        draw_setting(axes, result, axis, metric, order[result.name])
    cut_off_outliers(axes, scene, axis, metric)
    noise = scene.reference.noise()
    if metric == "mse" and noise > 0:
        if axes.get_ylim()[0] / 3 < noise:
            axes.set_ylim(bottom=min(axes.get_ylim()[0], noise / 1.5))
            axes.axhline(noise, color="#888888", linewidth=0.9, linestyle=(0, (1, 3)))
            axes.annotate("noise of the reference (taken out)", (0.995, noise), xycoords=("axes fraction", "data"), ha="right", va="bottom",
                          fontsize=7.5, color="#777777")
    draw_guides(axes, metric)
    axes.set_xlabel(AXIS_TITLES[axis])
    axes.set_ylabel(METRIC_TITLES[metric])
    axes.set_title(f"{scene.name}", loc="left", fontsize=10.5, fontweight="bold")
    axes.grid(True, which="major", color="#efefef", linewidth=0.7)
    axes.set_axisbelow(True)
    for name in ("top", "right"):
        axes.spines[name].set_visible(False)
    for line in (axes.xaxis, axes.yaxis):
        plain_ticks(line, *line.get_view_interval())
    legend(figure, scene, order, axis, metric)
    return figure


def legend(figure: Figure, scene: SceneResult, order: dict[str, int], axis: str, metric: str) -> None:
    """Names beside the plot, the lowest end of a curve last as in the plot, with slopes where they belong to it."""
    known = [r for r in scene.results if any((p.costs[axis] or 0) > 0 for p in r.curve)]
    known.sort(key=lambda r: -error_of(r.curve[-1], axis, "mse_cost" if metric.startswith("mse") else metric).value)
    step = min(0.062, 0.80 / max(1, len(known)))
    for row, result in enumerate(known):
        colour, dash = style(order[result.name])
        y = 0.90 - row * step
        figure.add_artist(matplotlib.lines.Line2D([0.71, 0.735], [y, y], color=colour, linestyle=dash, linewidth=2, gid=f"s{order[result.name]}-key"))
        text = result.name if len(result.name) < 34 else result.name[:32] + "…"
        if metric.startswith("mse") and result.slope and math.isfinite(result.slope.half_width()):
            text += f"\n  slope {result.slope.value:.2f} ± {result.slope.half_width():.2f}" if step > 0.05 else ""
        figure.text(0.743, y + 0.012, text, va="top", fontsize=8.2, linespacing=1.15, gid=f"s{order[result.name]}-name")
    slope = {"smape": "-1/2", "mse_cost": "0"}.get(metric, "-1")
    figure.text(0.71, 0.03, f"○ one render   ● mean of slices\nband: 95 %, from repeats; grey: slope {slope}",
                fontsize=7.3, color="#777777", linespacing=1.3)


def svg_of(figure: Figure) -> str:
    """The drawing as an element of a page."""
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None})
    text = out.getvalue()
    return text[text.index("<svg"):]


def save_png(figure: Figure, path: Path) -> None:
    """With a palette: a third of the size, for pages that keep many."""
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=130)
    with Image.open(out) as picture:
        picture.convert("RGB").quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)
