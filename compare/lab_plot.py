# SPDX-License-Identifier: BSD-2-Clause
"""Plots of what `medialab converge` and `medialab estimate` write: lines with error bars, one panel for each problem."""
import argparse
import csv
import json
import math
import sys
from collections.abc import Callable
from pathlib import Path

from .plots import COLOURS, dress, plain_ticks, style
from .problems import CaseError

from matplotlib.axes import Axes  # isort: skip  (plots chooses the backend first)
from matplotlib.figure import Figure  # isort: skip

Row = dict[str, str]
AXES = {"lookups": "density look-ups", "samples": "samples", "seconds": "seconds"}
TWO_SIDED = 1.96
"""Standard errors of a bar: 95 %."""
MOST_BIAS_Z = 5.0


def read_rows(path: Path) -> list[Row]:
    """The rows of a table of the lab, .csv or .json."""
    try:
        text = path.read_text()
        if path.suffix == ".json":
            rows = [{k: "nan" if v is None else str(v) for k, v in row.items()} for row in json.loads(text)["rows"]]
        else:
            rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    except OSError as error:
        raise CaseError(f"{path}: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise CaseError(f"{path}: no table of medialab: {error}") from error
    if not rows or not ({"rmse", "samples"} <= rows[0].keys() or {"variance", "exact"} <= rows[0].keys()):
        raise CaseError(f"{path}: expected the rows of medialab converge or estimate")
    return rows


def problem_of(row: Row) -> str:
    """What a panel is of."""
    parts = [row["extinction"], f"depth {float(row['depth']):g}", f"control {float(row['control']):g}"]
    parts += [f"{key} {row[key]}" for key in ("lower", "law") if key in row]
    return ", ".join([*parts, *([row["pattern"]] if row.get("pattern", "independent") != "independent" else [])])


def grouped(rows: list[Row], key: Callable[[Row], str]) -> dict[str, list[Row]]:
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(key(row), []).append(row)
    return groups


def log_bar(value: float, error: float) -> tuple[float, float]:
    """Lower and upper part of a bar of a value above 0, in logarithms: it never reaches 0."""
    width = math.exp(min(3.0, TWO_SIDED * error / value)) if math.isfinite(error) else 1.0
    return value - value / width, value * width - value


def draw_curve(axes: Axes, rows: list[Row], over: str, index: int) -> bool:
    """One estimator; False if it has no error to draw."""
    points = [(float(r[over]), float(r["rmse"]), float(r["rmse_stderr"])) for r in rows]
    points = [p for p in points if p[0] > 0 and math.isfinite(p[1]) and p[1] > 0]
    if not points:
        return False
    colour, dash = style(index)
    bars = list(zip(*(log_bar(y, e) for _, y, e in points)))
    slope, error = (float(rows[0].get(f"slope_{over}{end}", "nan")) for end in ("", "_stderr"))
    label = rows[0]["estimator"] + (f"  {slope:.2f} ± {TWO_SIDED * error:.2f}" if math.isfinite(slope) else "")
    axes.errorbar([p[0] for p in points], [p[1] for p in points], yerr=bars, fmt="o" + dash, color=colour, markersize=3.2, linewidth=1.3,
                  elinewidth=1, capsize=1.8, label=label)
    return True


def converge_panel(axes: Axes, rows: list[Row], over: str, order: dict[str, int]) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    exact = [name for name, curve in grouped(rows, lambda r: r["estimator"]).items() if not draw_curve(axes, curve, over, order[name])]
    if len(exact) < len(grouped(rows, lambda r: r["estimator"])):
        for line in (axes.xaxis, axes.yaxis):
            plain_ticks(line, *line.get_view_interval())
        axes.legend(fontsize=7, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.02), title=f"slope over {over}", title_fontsize=7,
                    alignment="left")
    if exact:
        axes.text(0.03, 0.03, "without error: " + ", ".join(exact), transform=axes.transAxes, fontsize=7, color="#666666")
    axes.set_xlabel(AXES[over])
    axes.set_ylabel("RMSE")


def estimate_panel(axes: Axes, rows: list[Row], over: str) -> None:
    """Variance x cost of each estimator, best on top; red where the mean is not the exact value."""
    column = {"lookups": "inverse_efficiency_lookups", "seconds": "inverse_efficiency_seconds", "samples": "variance"}[over]
    if column not in rows[0]:
        raise CaseError(f"the table has no {column}")
    drawn = sorted((r for r in rows if math.isfinite(float(r[column])) and float(r[column]) > 0), key=lambda r: -float(r[column]))
    axes.set_xscale("log")
    for place, row in enumerate(drawn):
        value, variance = float(row[column]), float(row["variance"])
        left, right = log_bar(value, value * float(row["variance_stderr"]) / variance)
        error = float(row["mean_stderr"])
        biased = error > 0 and abs(float(row["mean"]) - float(row["exact"])) > MOST_BIAS_Z * error
        axes.errorbar([value], [place], xerr=[[left], [right]], fmt="o", color="#b3261e" if biased else COLOURS[0], markersize=4.5, elinewidth=1.2,
                      capsize=2.5)
    rest = [r["estimator"] for r in rows if r not in drawn]
    if drawn:
        plain_ticks(axes.xaxis, *axes.xaxis.get_view_interval())
    axes.set_yticks(range(len(drawn)), [r["estimator"] for r in drawn], fontsize=7.5)
    axes.set_ylim(-0.7, len(drawn) - 0.3)
    axes.set_xlabel("variance" if over == "samples" else f"variance × {AXES[over]}")
    axes.text(1.0, 1.02, "red: biased (z > 5)" + (f";  without variance: {', '.join(rest)}" if rest else ""), transform=axes.transAxes, fontsize=6.8,
              color="#666666", ha="right", va="bottom")


def lab_figure(rows: list[Row], over: str) -> Figure:
    """All problems of a table, in rows of two panels."""
    converges = "rmse" in rows[0]
    if converges and over not in rows[0]:
        raise CaseError(f"the table has no {over}")
    panels = grouped(rows, problem_of)
    order = {name: i for i, name in enumerate(grouped(rows, lambda r: r["estimator"]))}
    columns = min(2, len(panels))
    lines = math.ceil(len(panels) / columns)
    tall = 3.4 if converges else 1.3 + 0.19 * max(len(p) for p in panels.values())
    figure = Figure(figsize=(7.2 * columns, tall * lines), layout="constrained")
    figure.get_layout_engine().set(h_pad=0.1, w_pad=0.1)
    all_axes = figure.subplots(lines, columns, squeeze=False).reshape(-1)
    for axes in all_axes[len(panels):]:
        axes.remove()
    for axes, (title, part) in zip(all_axes, panels.items()):
        dress(axes, title, 6 if converges else 14)
        if converges:
            converge_panel(axes, part, over, order)
        else:
            estimate_panel(axes, part, over)
    return figure


def main(words: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="medialab-plot", description="Draws a table of medialab converge or estimate. Bars are of 95 %.")
    parser.add_argument("table", type=Path, help=".csv or .json")
    parser.add_argument("-o", "--outfile", type=Path, help="picture: .png, .svg or .pdf (TABLE.png)")
    parser.add_argument("--over", choices=AXES, default="lookups", help="cost (lookups)")
    options = parser.parse_args(words)
    outfile = options.outfile or options.table.with_suffix(".png")
    try:
        if outfile.suffix not in (".png", ".svg", ".pdf"):
            raise CaseError(f"{outfile}: expected a name ending in .png, .svg or .pdf")
        figure = lab_figure(read_rows(options.table), options.over)
        try:
            figure.savefig(outfile, dpi=130, metadata={"Software": None} if outfile.suffix == ".png" else None)
        except OSError as error:
            raise CaseError(f"{outfile}: {error.strerror}") from error
    except CaseError as error:
        print(f"medialab-plot: error: {error}", file=sys.stderr)
        return 1
    return 0
