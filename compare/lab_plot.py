# SPDX-License-Identifier: BSD-2-Clause
"""Plots of the tables of `medialab`: lines with error bars, one panel for each problem."""
import argparse
import csv
import json
import math
import sys
from pathlib import Path

from .lab_tables import KINDS, TWO_SIDED, Row, curve, grouped, kind_of, log_bar
from .plots import COLOURS, dress, plain_ticks
from .problems import CaseError

from matplotlib.axes import Axes  # isort: skip  (plots chooses the backend first)
from matplotlib.figure import Figure  # isort: skip

AXES = {"lookups": "density look-ups", "samples": "samples", "seconds": "seconds"}
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
    if not rows or not ({"rmse", "samples"} <= rows[0].keys() or {"variance", "exact"} <= rows[0].keys() or kind_of(rows[0])):
        raise CaseError(f"{path}: expected the rows of medialab converge, estimate, {', '.join(KINDS)}")
    return rows


def problem_of(row: Row) -> str:
    """What a panel is of."""
    parts = [row["extinction"], f"depth {float(row['depth']):g}", f"control {float(row['control']):g}"]
    parts += [f"{key} {row[key]}" for key in ("lower", "law") if key in row]
    return ", ".join([*parts, *([row["pattern"]] if row.get("pattern", "independent") != "independent" else [])])


def draw_curve(axes: Axes, rows: list[Row], over: str, index: int) -> bool:
    """One estimator; False if it has no error to draw."""
    slope, error = (float(rows[0].get(f"slope_{over}{end}", "nan")) for end in ("", "_stderr"))
    label = rows[0]["estimator"] + (f"  {slope:.2f} ± {TWO_SIDED * error:.2f}" if math.isfinite(slope) else "")
    return curve(axes, ((float(r[over]), float(r["rmse"]), float(r["rmse_stderr"])) for r in rows), index, label)


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


def lab_figure(rows: list[Row], over: str | None = None) -> Figure:
    """All problems of a table, in rows of two panels. `over`: cost, where the table has several."""
    kind = kind_of(rows[0])
    if kind and over:
        raise CaseError("this table has one axis only: --over is for those of converge and estimate")
    over = over or "lookups"
    converges = "rmse" in rows[0]
    if converges and over not in rows[0]:
        raise CaseError(f"the table has no {over}")
    panels = grouped(rows, kind.title if kind else problem_of)
    order = {name: i for i, name in enumerate(grouped(rows, lambda r: r.get("estimator", "")))}
    columns = min(2, len(panels))
    lines = math.ceil(len(panels) / columns)
    tall = 3.4 if converges or kind else 1.3 + 0.19 * max(len(p) for p in panels.values())
    figure = Figure(figsize=(7.2 * columns, tall * lines), layout="constrained")
    figure.get_layout_engine().set(h_pad=0.1, w_pad=0.1)
    all_axes = figure.subplots(lines, columns, squeeze=False).reshape(-1)
    for axes in all_axes[len(panels):]:
        axes.remove()
    for axes, (title, part) in zip(all_axes, panels.items()):
        dress(axes, title, 6 if converges or kind else 14)
        if kind:
            kind.draw(axes, part)
        elif converges:
            converge_panel(axes, part, over, order)
        else:
            estimate_panel(axes, part, over)
    return figure


def main(words: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="medialab-plot", description="Draws a table of medialab: converge, estimate, levels, running, power-law, progressive. Bars are of 95 %.")
    parser.add_argument("table", type=Path, help=".csv or .json")
    parser.add_argument("-o", "--outfile", type=Path, help="picture: .png, .svg or .pdf (TABLE.png)")
    parser.add_argument("--over", choices=AXES, help="cost in tables of converge and estimate (lookups)")
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
