# SPDX-License-Identifier: BSD-2-Clause
"""The command line of ./figures."""
import argparse
import difflib
import json
import sys
import time
import traceback
from pathlib import Path

from compare.main import duration

from . import page
from .catalogue import FOLDER, Entry, all_figures, title_of
from .not_there import NOT_THERE
from .programs import FigureError, Programs
from .run import Run

ROOT = FOLDER.parent.parent

DESCRIPTION = """\
Makes figures of papers again: data, plots, and a verdict on what the paper claims.

  ./figures --list              what there is, and what is not there yet
  ./figures --verdicts          what came of each, by docs/figures.md: of the last full run that was written there
  ./figures NAME ...            these figures
  ./figures                     all of them, some half an hour; stop it whenever you like, the same command goes on
  ./figures --all --quick       all of them, smaller: some minutes
  ./figures --docs              writes docs/figures.md from what full runs have made; figures that were not made here stay as the page has them

Results are in build/figures/NAME (build/figures-quick with --quick). What programs found is kept, and made again only when program, scene or options changed.
The exit status is 0 when every figure was made and agrees with the numbers that are known (closed forms, independent simulations; within four standard errors).
Verdicts on claims of papers do not count."""


def arguments(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="figures", description=DESCRIPTION, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="a figure, or the beginning of names: kettunen-2021")
    parser.add_argument("--list", action="store_true", help="names, titles, and the verdicts of the last run")
    parser.add_argument("--verdicts", action="store_true", help="a line for each figure with its counts of verdicts, from docs/figures.md")
    parser.add_argument("--all", action="store_true", help="every figure: what is done without names, too")
    parser.add_argument("--quick", action="store_true", help="fewer trials, smaller images: a minute each at most")
    parser.add_argument("--docs", action="store_true", help="write docs/figures.md and its pictures")
    parser.add_argument("--out", type=Path, help="folder of results (build/figures, or build/figures-quick)")
    parser.add_argument("--bin", type=Path, help="folder of pbrt and medialab, which are not built then (build/release/bin)")
    return parser.parse_args(words)


def chosen(names: list[str], entries: list[Entry]) -> list[Entry]:
    """Figures of these names or beginnings of names, in order, each once. Throws FigureError."""
    wanted: set[str] = set()
    for name in names:
        found = {e.name for e in entries if e.name == name or e.name.startswith(name.rstrip("-") + "-")}
        if not found and name in NOT_THERE:
            raise FigureError(f"{name} is not there yet: {NOT_THERE[name]}")
        if not found:
            near = difflib.get_close_matches(name, [e.name for e in entries], 1)
            raise FigureError(f'unknown figure "{name}"{f"; did you mean {near[0]}?" if near else ""} ./figures --list shows all')
        wanted |= found
    return [e for e in entries if e.name in wanted]


def list_figures(entries: list[Entry], out: Path) -> None:
    for entry in entries:
        path = out / entry.name / "result.json"
        told = ", ".join(v["outcome"] for v in json.loads(path.read_text())["verdicts"]) if path.is_file() else "not made yet"
        print(f"{entry.name:24} {entry.figure.title}  [{told}]")
    for name, why in NOT_THERE.items():
        print(f"{name:24} not there yet: {why}")


class Progress:
    """Where we are, and how long it will take by what earlier runs took."""

    def __init__(self, entries: list[Entry], out: Path, quick: bool):
        self.file = out / "seconds.json"
        self.known: dict[str, float] = json.loads(self.file.read_text()) if self.file.is_file() else {}
        self.left = {e.name: self.known.get(e.name, e.figure.seconds * (0.2 if quick else 1)) for e in entries}
        self.count, self.now, self.begin = len(entries), "", time.monotonic()
        self.told, self.last = "", 0.0

    def start(self, name: str) -> None:
        self.now, self.begin = name, time.monotonic()

    def tell(self, what: str) -> None:
        """One line, and no more than one a second beside the first of a figure."""
        now = time.monotonic()
        if self.now == self.told and now - self.last < 1:
            return
        self.told, self.last = self.now, now
        spent = now - self.begin
        rest = sum(s for n, s in self.left.items() if n != self.now) + max(0.0, self.left.get(self.now, 0) - spent)
        print(f"[{self.count - len(self.left) + 1}/{self.count}, about {duration(rest)} left] {self.now}: {what}", file=sys.stderr, flush=True)

    def finish(self, did_work: bool) -> None:
        """Remembers how long it took, unless all was there already."""
        self.left.pop(self.now)
        if did_work:
            self.known[self.now] = round(time.monotonic() - self.begin, 1)
            self.file.write_text(json.dumps(self.known, indent=1) + "\n")


def make(entries: list[Entry], out: Path, bin_folder: Path, quick: bool, is_all: bool = False) -> int:
    """Makes them; 1 if any failed or differs from numbers that are known. What the paper claimed and we did not find is no failure."""
    out.mkdir(parents=True, exist_ok=True)
    progress = Progress(entries, out, quick)
    ran: list[str] = []

    def tell(what: str) -> None:
        ran.append(what)
        progress.tell(what)
    programs = Programs(bin_folder, out / "kept", tell)
    failures: list[str] = []
    made = compared = differing = 0
    for entry in entries:
        progress.start(entry.name)
        ran.clear()
        run = Run(entry, programs, out / entry.name, quick)
        run.start()
        try:
            entry.make(run)
            run.finish()
            made += 1
        except FigureError as error:
            failures.append(f"{entry.name}: {error}")
        except Exception:  # of one script: the others are made all the same
            failures.append(f"{entry.name}: {traceback.format_exc().strip()}")
        print(f"{entry.name}: {title_of(entry.name).lower()}, {entry.figure.title}")
        for verdict in run.verdicts:
            print(f"  {verdict.line()}")
        if run.compared:
            print(f"  {run.compared - len(run.mismatches)} of {run.compared} known numbers agree")
        failures += [f"{entry.name}: {m}" for m in run.mismatches]
        compared += run.compared
        differing += len(run.mismatches)
        sys.stdout.flush()
        progress.finish(bool(ran))
    print(f"{made} of {len(entries)} figures were made, {compared - differing} of {compared} known numbers agree")
    if is_all and made == len(entries):
        programs.forget_others()
    for failure in failures:
        print(f"figures: error: {failure}", file=sys.stderr)
    return 1 if failures else 0


def main(words: list[str] | None = None) -> int:
    options = arguments(words)
    out = (options.out or ROOT / "build" / ("figures-quick" if options.quick else "figures")).resolve()
    try:
        entries = all_figures()
        if options.list:
            list_figures(entries, out)
            return 0
        if options.verdicts:
            print("\n".join(page.verdict_lines((ROOT / "docs/figures.md").read_text(), entries)))
            return 0
        is_all, code = options.all or not (options.names or options.docs), 0
        if is_all or options.names:
            code = make(entries if is_all else chosen(options.names, entries), out, (options.bin or ROOT / "build/release/bin").resolve(), options.quick, is_all)
        if options.docs:
            if options.quick:
                raise FigureError("the page is made from a full run, without --quick")
            size, stay = page.write_page(entries, out, ROOT / "docs")
            print(f"wrote docs/figures.md, {size / 1e6:.2f} MB of pictures" + (f"; as they were: {', '.join(stay)}" if stay else ""))
        return code
    except FigureError as error:
        print(f"figures: error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nfigures: stopped; the same command goes on from here", file=sys.stderr)
        return 130
