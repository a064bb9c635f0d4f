#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Keeps the tables of docs/benchmarks.md and docs/convergence.md: nobody types a number there.

  benchmarks.py record FILE...   takes the results of a run into docs/benchmarks/: the JSON of layout_bench or estimator_bench
                                 (--json FILE), summary.csv of pbrt-compare, of one scene or of several, the CSV of bench/ways.py or bench/sizes.py. Rows that a
                                 run
                                 did not measure stay
  benchmarks.py docs             writes the tables of the pages from docs/benchmarks/
  benchmarks.py check            status 1 if a page has other tables
"""
import argparse
import csv
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = {"docs/benchmarks.md": ("layouts", "estimators", "renders", "ways", "sizes", "threads"), "docs/convergence.md": ("comparison",)}
DATA = "docs/benchmarks"
AXES = {"samples": "samples", "lookups": "lookups", "seconds": "cpu"}  # that variance times cost is told of; in summary.csv

Rows = list[dict[str, str]]
# Columns that tell the rows of a file apart.
KEYS = {"layouts": ("grid", "layout"), "estimators": ("field", "estimator"), "renders": ("setting",), "comparison": ("scene", "setting"),
        "ways": ("scene", "way"), "sizes": ("kind", "size")}


def number(value: float | None, form: str) -> str:
    return "" if value is None else format(value, form)


def from_layouts(report: dict) -> Rows:
    def row(grid: int, r: dict) -> dict[str, str]:
        return {"grid": str(grid), "layout": r["layout"],
                "megabytes": number(r["bytes"] / 1e6 if "bytes" in r else None, ".1f"),
                "scalar_ns": number(r.get("scalarNs"), ".1f"), "batched_ns": number(r["batchedNs"], ".1f"),
                "scalar_over_batched": number(r.get("scalarOverBatched"), ".2f"),
                "linear_scalar_over_batched": number(r["linearScalarOverBatched"], ".2f"),
                "point_ns": number(r.get("pointNs"), ".0f"), "lines_per_lookup": number(r.get("linesPerLookup"), ".2f"),
                "limit_ns": number(r.get("limitNs"), ".1f")}
    return [row(size["samplesPerAxis"], r) for size in report["sizes"] for r in size["rows"]]


def from_estimators(report: dict) -> Rows:
    return [{"field": r["field"], "estimator": r["estimator"], "ns": number(r["nsPerEstimate"], ".0f"),
             "lookups": number(r["lookups"], ".1f"), "mse": number(r["mse"], ".2g")}
            for r in report["rows"] if r["field"] != "constant"]


def from_renders(rows: Rows) -> Rows:
    return [{"setting": r["setting"], **{f"variance_x_{a}": number(float(r[f"variance_x_{c}"]), ".4g") for a, c in AXES.items()}}
            for r in rows]


def from_comparison(rows: Rows) -> Rows:
    return [{"scene": r["scene"], "setting": r["setting"], "biased": r["biased"],
             **{f"relative_seconds{end}": number(float(r[f"relative_cpu{end}"]), ".4g") if r[f"relative_cpu{end}"] else ""
                for end in ("", "_low", "_high")}}
            for r in rows]


def machine(report: dict) -> str:
    e = report["environment"]
    return f"{e['cpu']}, batches on {e['simd']}; {e['compiler']}, {e['flags']}"


def read(root: pathlib.Path, name: str) -> Rows:
    with (root / DATA / f"{name}.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def record(root: pathlib.Path, path: pathlib.Path) -> str:
    """Takes the results in; the name of the table they are of."""
    if path.suffix == ".json":
        report = json.loads(path.read_text())
        name, new = ("layouts", from_layouts(report)) if "sizes" in report else ("estimators", from_estimators(report))
        (root / DATA / f"{name}.txt").write_text(machine(report) + "\n")
    else:
        with path.open(newline="") as file:
            rows = list(csv.DictReader(file))
        if "way" in rows[0] or "kind" in rows[0]:
            name, new = "ways" if "way" in rows[0] else "sizes", rows
        else:
            several = len({r["scene"] for r in rows}) > 1
            name, new = ("comparison", from_comparison(rows)) if several else ("renders", from_renders(rows))
    fresh = {tuple(r[k] for k in KEYS[name]): r for r in new}
    merged = [fresh.pop(tuple(r[k] for k in KEYS[name]), r) for r in read(root, name)] + list(fresh.values())
    with (root / DATA / f"{name}.csv").open("w", newline="") as file:
        out = csv.DictWriter(file, merged[0].keys(), lineterminator="\n")
        out.writeheader()
        out.writerows(merged)
    return name


def table(header: list[str], rows: list[list[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "".join(("| " + " | ".join(line) + " |").replace("|  |", "| |").replace("|  |", "| |") + "\n" for line in lines)


def layouts(rows: Rows) -> str:
    def line(r: dict[str, str]) -> list[str]:
        beyond = number(float(r["batched_ns"]) / float(r["limit_ns"]) if r["limit_ns"] else None, ".2f")
        return [r["grid"] + "³", r["layout"], r["megabytes"], r["scalar_ns"], r["batched_ns"], r["scalar_over_batched"],
                r["linear_scalar_over_batched"], r["point_ns"], r["lines_per_lookup"], r["limit_ns"], beyond]
    return table(["grid", "layout", "MB", "scalar ns", "batched ns", "scalar / batched", "vs linear", "points ns",
                  "lines per look-up", "limit ns", "batched / limit"], [line(r) for r in rows])


def estimators(rows: Rows) -> str:
    fields = {"grid-40-smooth": "smooth 40³", "grid-40-rough": "rough 40³", "grid-256": "256³"}
    by = {(r["field"], r["estimator"]): r for r in rows}

    def cells(field: str, name: str) -> list[str]:
        r, base = by.get((field, name)), by[field, "ratio"]
        if r is None:
            return ["", "", "", ""]
        cost, error = float(r["ns"]), float(r["mse"])
        worth = number(float(base["mse"]) * float(base["ns"]) / (error * cost), ".2g") if error > 0 else "exact"
        return [r["ns"], r["lookups"], r["mse"], worth]

    names = list(dict.fromkeys(r["estimator"] for r in rows))
    header = ["estimator", *(text for f in fields.values() for text in (f + ": ns", "look-ups", "mse", "efficiency"))]
    return table(header, [[name, *(c for f in fields for c in cells(f, name))] for name in names])


def renders(rows: Rows) -> str:
    def line(r: dict[str, str]) -> list[str]:
        return [f"`{r['setting']}`", *(f"{float(r[c]) / float(rows[0][c]):.2f}" for c in (f"variance_x_{a}" for a in AXES))]
    return table(["setting", "samples", "look-ups", "seconds"], [line(r) for r in rows])


def comparison(rows: Rows) -> str:
    def cell(r: dict[str, str] | None) -> str:
        if r is None or not r["relative_seconds"]:
            return ""
        if r["biased"] == "True":
            return "biased"
        value, low, high = (float(r[c]) for c in ("relative_seconds", "relative_seconds_low", "relative_seconds_high"))
        return "**1**" if low == high else f"{value:.2f} ({low:.2f} – {high:.2f})"
    by = {(r["setting"], r["scene"]): r for r in rows}
    scenes = list(dict.fromkeys(r["scene"] for r in rows))
    settings = sorted({r["setting"] for r in rows})
    return table(["setting", *scenes], [[f"`{s}`", *(cell(by.get((s, scene))) for scene in scenes)] for s in settings])


def ways(rows: Rows) -> str:
    def line(r: dict[str, str]) -> list[str]:
        seconds, *noise = (float(r[c]) for c in ("seconds", "variance", "usual_variance", "median_variance"))
        return [r["way"], r["scene"], f"{seconds:.2f}", *(f"{seconds * v:.2f}" for v in noise)]
    changed = [r for r in rows if any(float(r[c]) != 1 for c in r if c not in ("scene", "way"))]  # not what the others are told relative to
    return table(["way", "scene", "seconds", "variance x seconds", "without the worst 0.1 %", "by the median pixel"], [line(r) for r in changed])


def sizes(rows: Rows) -> str:
    return table(["", "size", "µs of a sample", "seconds to the first pixel", "MB"],
                 [[r["kind"], r["size"], *(f"{float(r[c]):{form}}" for c, form in (("us_per_sample", ".3g"), ("first_pixel_seconds", ".2f"), ("megabytes", ".0f")))]
                  for r in rows if not r["kind"].startswith("threads-")])


def threads(rows: Rows) -> str:
    """How many times faster than one thread, by the clock on the wall."""
    several = [r for r in rows if r["kind"].startswith("threads-")]
    alone = {r["kind"]: float(r["elapsed_us_per_sample"]) for r in several if r["size"] == "1"}
    return table(["scene", "threads", "times faster"],
                 [[r["kind"].removeprefix("threads-"), r["size"], f"{alone[r['kind']] / float(r['elapsed_us_per_sample']):.2f}"] for r in several if r["size"] != "1"])


# The tables whose rows are in the file of another one.
DATA_OF = {"threads": "sizes"}
MAKERS = {"layouts": layouts, "estimators": estimators, "renders": renders, "comparison": comparison, "ways": ways, "sizes": sizes,
          "threads": threads}


def page(root: pathlib.Path, name: str, text: str) -> str:
    """The page with its tables written anew, each between `<!-- table NAME -->` and `<!-- end -->`."""
    made = {table_name: MAKERS[table_name](read(root, DATA_OF.get(table_name, table_name))) for table_name in PAGES[name]}
    for table_name in made:
        if (said := root / DATA / f"{table_name}.txt").is_file():
            made[table_name] = f"Measured by {said.read_text().strip()}.\n\n" + made[table_name]
    parts = re.split(r"(?s)(?<=<!-- table )(\w+)( -->\n).*?(?=<!-- end -->)", text)
    if sorted(parts[1::3]) != sorted(made):
        sys.exit(f"error: {name}: expected the tables {', '.join(made)}, found {', '.join(parts[1::3]) or 'none'}")
    for i in range(1, len(parts), 3):
        parts[i + 1] += made[parts[i]]
    return "".join(parts)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("record").add_argument("files", nargs="+", type=pathlib.Path)
    commands.add_parser("docs")
    commands.add_parser("check")
    options = parser.parse_args()
    if options.command == "record":
        for path in options.files:
            print(f"{path}: results of {DATA}/{record(ROOT, path)}.csv")
    status = 0
    for name in PAGES:
        text = (ROOT / name).read_text()
        made = page(ROOT, name, text)
        if options.command != "check":
            (ROOT / name).write_text(made)
        elif made != text:
            print(f"{name}: its tables are not what scripts/benchmarks.py docs writes")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
