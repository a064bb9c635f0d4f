# SPDX-License-Identifier: BSD-2-Clause
"""Panels of the tables that `medialab levels`, `running`, `power-law` and `progressive` write."""
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from .plots import plain_ticks, style

from matplotlib.axes import Axes  # isort: skip  (plots chooses the backend first)

Row = dict[str, str]
TWO_SIDED = 1.96
"""Standard errors of a bar: 95 %."""
MOST_RUNS = 24
"""Single runs that a panel shows."""


def grouped(rows: list[Row], key: Callable[[Row], str]) -> dict[str, list[Row]]:
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(key(row), []).append(row)
    return groups


def log_bar(value: float, error: float) -> tuple[float, float]:
    """Lower and upper part of a bar of a value above 0, in logarithms: it never reaches 0."""
    width = math.exp(min(3.0, TWO_SIDED * error / value)) if math.isfinite(error) else 1.0
    return value - value / width, value * width - value


def curve(axes: Axes, points: Iterable[tuple[float, float, float]], index: int, label: str) -> bool:
    """Values and standard errors over something, on logarithmic axes; those that have no logarithm are left out. False: none is left."""
    shown = [p for p in points if p[0] > 0 and math.isfinite(p[1]) and p[1] > 0]
    if not shown:
        return False
    colour, dash = style(index)
    bars = list(zip(*(log_bar(y, e) for _, y, e in shown)))
    axes.errorbar([p[0] for p in shown], [p[1] for p in shown], yerr=bars, fmt="o" + dash, color=colour, markersize=3.2, linewidth=1.3, elinewidth=1,
                  capsize=1.8, label=label)
    return True


def logarithmic(axes: Axes, x: str, y: str) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(x)
    axes.set_ylabel(y)


def finish(axes: Axes, drawn: bool, title: str = "") -> None:
    if not drawn:
        return
    for line in (axes.xaxis, axes.yaxis):
        plain_ticks(line, *line.get_view_interval())
    axes.legend(fontsize=7, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.02), title=title or None, title_fontsize=7, alignment="left")


def numbers(row: Row, *names: str) -> tuple[float, ...]:
    return tuple(float(row[name]) for name in names)


def levels_panel(axes: Axes, rows: list[Row]) -> None:
    """How the variance of a correction falls with its look-ups."""
    logarithmic(axes, "density look-ups of a correction", "variance of a correction")
    curves = grouped(rows, lambda r: f"{r['estimator']}, {r['coupling']}")
    drawn = [curve(axes, (numbers(r, "lookups", "variance", "variance_stderr") for r in part), i, name)
             for i, (name, part) in enumerate(curves.items())]
    finish(axes, any(drawn), "coupling")


def progressive_panel(axes: Axes, rows: list[Row]) -> None:
    logarithmic(axes, "passes", "mean squared error of their mean")
    curves = grouped(rows, lambda r: r["estimator"])
    drawn = [curve(axes, (numbers(r, "pass", "mse", "mse_stderr") for r in part), i, name) for i, (name, part) in enumerate(curves.items())]
    finish(axes, any(drawn))


def power_law_panel(axes: Axes, rows: list[Row]) -> None:
    logarithmic(axes, "samples", "error")
    drawn = []
    for i, (alpha, part) in enumerate(grouped(rows, lambda r: r["alpha"]).items()):
        slope, error, expected = numbers(part[0], "slope", "slope_stderr", "expected_slope")
        label = f"{float(alpha):g}:  {slope:.2f} ± {TWO_SIDED * error:.2f}, expected {expected:.2f}"
        drawn.append(curve(axes, (numbers(r, "samples", "error", "error_stderr") for r in part), i, label))
    finish(axes, any(drawn), "alpha and slope")


def running_panel(axes: Axes, rows: list[Row]) -> None:
    """Single runs faint, their mean with its 95 % as a band, the exact line dashed."""
    axes.set_xlabel("s")
    axes.set_ylabel("estimate up to s")
    for i, (name, part) in enumerate(grouped(rows, lambda r: r["estimator"]).items()):
        colour, _ = style(i)
        runs = {run: [numbers(r, "s", "value") for r in line] for run, line in grouped(part, lambda r: r["run"]).items()}
        exact, mean, error = (runs.pop(run, []) for run in ("exact", "mean", "stderr"))
        for line in list(runs.values())[:MOST_RUNS]:
            axes.plot(*zip(*line), color=colour, linewidth=0.5, alpha=0.35, drawstyle="steps-post")
        if mean:
            widths = [TWO_SIDED * e if math.isfinite(e) else 0.0 for _, e in error] or [0.0] * len(mean)
            axes.fill_between([s for s, _ in mean], [v - w for (_, v), w in zip(mean, widths)], [v + w for (_, v), w in zip(mean, widths)], color=colour,
                              alpha=0.2, linewidth=0)
            axes.plot(*zip(*mean), color=colour, linewidth=1.6, label=name)
        if exact:
            axes.plot(*zip(*exact), "--", color="black", linewidth=1.1, label="exact" if i == 0 else None)
    axes.legend(fontsize=7, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.02), alignment="left")


@dataclass(frozen=True)
class TableKind:
    """How the rows of a command are drawn."""
    columns: frozenset[str]
    """By which they are known."""
    title: Callable[[Row], str]
    """Of the panel that a row belongs to."""
    draw: Callable[[Axes, list[Row]], None]


KINDS = {
    "levels": TableKind(frozenset({"coupling", "level", "variance_lookups"}), lambda r: f"{r['extinction']}, depth {float(r['depth']):g}", levels_panel),
    "running": TableKind(frozenset({"s", "run", "value"}), lambda r: r["extinction"], running_panel),
    "power-law": TableKind(frozenset({"alpha", "error", "expected_slope"}), lambda r: "integrals of x^-alpha over [0, 1]", power_law_panel),
    "progressive": TableKind(frozenset({"pass", "mse", "bounded_share"}), lambda r: r["extinction"], progressive_panel),
}


def kind_of(row: Row) -> TableKind | None:
    return next((kind for kind in KINDS.values() if kind.columns <= row.keys()), None)
