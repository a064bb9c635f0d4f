# SPDX-License-Identifier: BSD-2-Clause
"""docs/figures.md: all figures with their pictures and verdicts, and what is not there yet."""
import json
import re
from dataclasses import dataclass
from pathlib import Path

from . import plotting, verdicts
from .catalogue import PAPERS, Entry, paper_of, title_of
from .not_there import NOT_THERE
from .programs import FigureError

MOST_BYTES = 2_000_000
OUTCOMES = (verdicts.REPRODUCED, verdicts.NOT_REPRODUCED, verdicts.UNTESTED)
ROW = re.compile(r"\| \[`(?P<name>[^`]+)`\]\(#[^)]+\) \| .* \| (?P<counts>[^|]+) \|")
"""Of the summary."""
SECTION = re.compile(r"(?ms)^### (?P<name>\S+)$.*?^!\[(?P=name): [^\n]*\.png\)$")
"""Of a figure: it ends with the second picture."""
HEAD = """\
# Figures of papers

This page is generated: `./figures`, then `./figures --docs`. Without parameters that command installs what is missing on a bare Debian 12 (Ubuntu 22.04 should do, and
is not tested: it has no NanoVDB, which the figures of the plume need), builds, and makes all of them, in half an hour on two cores; stopped, it goes on where
it was. `./figures NAME` makes one: data (CSV), plots (PNG, PDF) and verdicts in `build/figures/NAME/`, `--quick` a smaller one in `build/figures-quick/`. Each has a second plot that papers mostly lack: error against run time, on two cores
of a machine that did other things too.

A verdict is *reproduced* when all of our interval (95 %) agrees with the claim, *not reproduced* when none of it does, and *cannot be tested* otherwise.
Assets of the papers are not public: scenes and densities are our own of the same kind, and what is compared are rankings and ratios. Where numbers
are known independently (closed forms, other people's simulations), the scripts compare with them and fail when they differ by more than four standard errors;
"compared" counts these. `./check` runs `./figures --all --quick`: its exit status is 0 when every figure was made and all these numbers agree, whatever the verdicts.
Counts of look-ups include all look-ups of an estimate, end points and pivots too; free flight is not counted. `p-series-cmf` evaluates the levels that published code
does, one more than printed.
"""


def result_of(entry: Entry, out: Path) -> dict:
    path = out / entry.name / "result.json"
    if not path.is_file():
        raise FigureError(f"no {path}: run ./figures {entry.name}")
    return json.loads(path.read_text())


@dataclass(frozen=True)
class Part:
    """Of the page: what a figure has there."""
    counts: dict[str, int]  # verdicts of each outcome
    lines: list[str]

    @staticmethod
    def made(entry: Entry, result: dict) -> "Part":
        outcomes = [v["outcome"] for v in result["verdicts"]]
        return Part({o: outcomes.count(o) for o in OUTCOMES if o in outcomes}, section(entry, result))


def counts_of(page: str) -> dict[str, dict[str, int]]:
    """Verdicts of each outcome by figure, from the summary."""
    found = {}
    for line in page.splitlines():
        if row := ROW.fullmatch(line):
            found[row["name"]] = {outcome: int(count) for count, outcome in (part.split(" ", 1) for part in row["counts"].split(", "))}
    return found


def parts_of(page: str) -> dict[str, Part]:
    """What an earlier page has, by figure."""
    counts = counts_of(page)
    return {found["name"]: Part(counts[found["name"]], [*found[0].splitlines(), ""]) for found in SECTION.finditer(page) if found["name"] in counts}


def summary(entries: list[Entry], parts: dict[str, Part]) -> list[str]:
    counts = dict.fromkeys(OUTCOMES, 0)
    lines = ["| figure | | verdicts |", "| --- | --- | --- |"]
    for entry in entries:
        for outcome, count in parts[entry.name].counts.items():
            counts[outcome] += count
        told = ", ".join(f"{n} {o}" for o, n in parts[entry.name].counts.items())
        lines.append(f"| [`{entry.name}`](#{entry.name}) | {entry.figure.title} | {told} |")
    total = ", ".join(f"{n} {o}" for o, n in counts.items())
    return [f"{len(entries)} figures, {sum(counts.values())} claims: {total}.", "", *lines]


def verdict_lines(page: str, entries: list[Entry]) -> list[str]:
    """What the page says came of each figure, a line each, then the sums of each paper and of all. Throws FigureError for a figure that it does not have."""
    told = counts_of(page)
    lines, sums = [], {paper: dict.fromkeys(OUTCOMES, 0) for paper in (*PAPERS, "all")}
    for entry in entries:
        if entry.name not in told:
            raise FigureError(f"docs/figures.md has no {entry.name}: run ./figures {entry.name}, then ./figures --docs")
        found = told[entry.name]
        lines.append(f"{entry.name:24} {', '.join(f'{found[o]} {o}' for o in OUTCOMES if o in found):58} {entry.figure.title}")
        for key in (entry.paper, "all"):
            for outcome, count in found.items():
                sums[key][outcome] += count
    for key, counts in sums.items():
        of = [e for e in entries if key in (e.paper, "all")]
        lines.append(f"{key}: {len(of)} figures, {sum(counts.values())} claims: {', '.join(f'{n} {o}' for o, n in counts.items())}")
    return lines


def section(entry: Entry, result: dict) -> list[str]:
    name = entry.name
    verdicts = [f"- {v['claim']}. {v['number']}: **{v['outcome']}**" + (f", because {v['why']}" if v["why"] else "") for v in result["verdicts"]]
    compared = [f"", f"Compared with known numbers: {result['compared']}."] if result["compared"] else []
    return [f"### {name}", "", f"{title_of(name)}: {entry.figure.title}. {entry.figure.reported}", "", f"*Ours*: {entry.figure.settings}", "",
            *verdicts, *compared, "", f"![{name}](figures/{name}.png)", f"![{name}: error against run time](figures/{name}-time.png)", ""]


def page_text(entries: list[Entry], parts: dict[str, Part]) -> str:
    lines = [HEAD, *summary(entries, parts), ""]
    for paper, reference in PAPERS.items():
        lines += [f"## {reference}", ""]
        for entry in entries:
            if entry.paper == paper:
                lines += parts[entry.name].lines
        missing = [f"- `{name}`, {title_of(name).lower()}: not there yet: {why}" for name, why in NOT_THERE.items() if paper_of(name) == paper]
        lines += [*missing, ""] if missing else []
    return "\n".join(lines).rstrip() + "\n"


def write_page(entries: list[Entry], out: Path, docs: Path) -> tuple[int, list[str]]:
    """Writes the page and its pictures; how many bytes these are, and which figures stay as an earlier page has them, as `out` does not."""
    page, folder = docs / "figures.md", docs / "figures"
    folder.mkdir(exist_ok=True)
    parts = parts_of(page.read_text()) if page.is_file() else {}
    stay = [e.name for e in entries if e.name in parts and not (out / e.name / "result.json").is_file()]
    parts |= {e.name: Part.made(e, result_of(e, out)) for e in entries if e.name not in stay}
    pictures = {f"{e.name}{suffix}.png": e.name for e in entries for suffix in ("", "-time")}
    for old in folder.glob("*.png"):
        if pictures.get(old.name) not in stay:
            old.unlink()
    for file, name in pictures.items():
        if name not in stay:
            (folder / file).write_bytes(plotting.shrink(out / name / file))
    total = sum((folder / file).stat().st_size for file in pictures)
    if total > MOST_BYTES:
        raise FigureError(f"the pictures have {total} bytes, more than {MOST_BYTES}")
    page.write_text(page_text(entries, parts))
    return total, stay
