# SPDX-License-Identifier: BSD-2-Clause
"""The command line."""
import argparse
import dataclasses
import json
import sys
import time
from pathlib import Path

from . import provenance, report, tables
from .analysis import SceneAnalysis, SceneResult
from .case import SHORT_WORDS, UNITS, Case, SceneCase, load_case, quick, read_case
from .pictures import ImageTool
from .problems import CaseError
from .programs import Renderer
from .schedule import Entry, Schedule
from .slices import Slice, SliceStore
from .terminal import terminal_table

DESCRIPTION = """\
Compares settings of a renderer: error against seconds, density look-ups and samples.

  pbrt-compare CASE.toml                                        a test case, see docs/comparing.md
  pbrt-compare SCENE.pbrt --transmittance ratio,regular         all combinations of the lists, without a file

Stop it whenever you like: the same command goes on where it stopped. In the end OUT has report.html, CSV, JSON and PNG files."""


def arguments(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="pbrt-compare", description=DESCRIPTION, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", nargs="+", type=Path, metavar="FILE", help="one .toml or .json file, or scenes")
    for word in SHORT_WORDS:
        parser.add_argument(f"--{word}", metavar="A,B", help="list of methods; each may bring float parameters: ratio+roulettethreshold=0.3")
    parser.add_argument("--equal", choices=UNITS, help="what all settings get the same of (seconds)")
    parser.add_argument("--budget", type=float, help="of each setting, scene and repeat: seconds of processor time, look-ups, or samples a pixel (10)")
    parser.add_argument("--slices", type=int, help="into which a budget is divided (8)")
    parser.add_argument("--repeats", type=int, help="independent runs, from which the intervals are (4)")
    parser.add_argument("--threads", type=int, help="of the renderer; 0: one per processor")
    parser.add_argument("--quick", action="store_true", help="an eighth of the budget, three repeats, a shorter reference")
    parser.add_argument("--out", type=Path, help="folder of results (NAME-compare)")
    parser.add_argument("--bin", type=Path, help="folder of pbrt and imgtool (build/release/bin)")
    return parser.parse_args(words)


def case_of(options: argparse.Namespace) -> Case:
    overrides = {k: v for k in ("equal", "budget", "slices", "repeats", "threads") if (v := getattr(options, k)) is not None}
    lists = {w: v.split(",") for w in SHORT_WORDS if (v := getattr(options, w))}
    first: Path = options.inputs[0]
    if first.suffix in (".toml", ".json"):
        if len(options.inputs) > 1 or lists:
            raise CaseError(f"{first}: a test case comes alone, its settings are in the file")
        case = load_case(first)
        for key, least in (("slices", 2), ("repeats", 2), ("budget", 1e-9), ("threads", 0)):
            if overrides.get(key, least) < least:
                raise CaseError(f"--{key}: expected at least {least:g}")
        if "budget" in overrides:
            case = dataclasses.replace(case, scenes=tuple(dataclasses.replace(s, budget=overrides["budget"]) for s in case.scenes))
        case = dataclasses.replace(case, **overrides)
    else:
        content = {**overrides, "scene": [{"file": str(p.resolve())} for p in options.inputs], "matrix": lists, "title": first.stem}
        if not lists:
            content["setting"] = [{"name": "as it is"}]
            del content["matrix"]
        case = read_case(content, "command line", Path.cwd())
    return quick(case) if options.quick else case


class Progress:
    """One line a slice on standard error, with the time that is left by what fresh slices took so far."""

    def __init__(self, case: Case):
        self.case = case
        # The single renders before the slices take up to one slice more.
        repeats = case.repeats * len(case.compared()) * (1 + 1 / case.slices)
        self.total = sum(s.budget * (repeats + (0 if s.reference else case.reference_times)) for s in case.scenes)
        self.done = self.fresh = 0.0
        self.begin = time.monotonic()

    def __call__(self, what: str, slice_: Slice) -> None:
        cost = slice_.cost.of(self.case.equal, self.case.clock)
        self.done += cost
        if not slice_.fresh:
            return
        self.fresh += cost
        left = max(0.0, self.total - self.done) * (time.monotonic() - self.begin) / self.fresh if self.fresh > 0 else 0
        share = min(99, round(100 * self.done / self.total))
        print(f"[{share:2d} %, {duration(left)} left] {what}, seed {slice_.seed}, {slice_.cost.samples} spp: "
              f"{slice_.cost.wall:.3g} s", file=sys.stderr, flush=True)


def duration(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def compare_scene(case: Case, scene: SceneCase, store: SliceStore, tool: ImageTool, bin_folder: Path,
                  progress: Progress) -> tuple[SceneResult, list[Entry]]:
    """Renders and judges one scene."""
    entries = [Entry(s, Renderer(case, scene, s, bin_folder, store.folder)) for s in case.compared()]
    schedule = Schedule(case, scene, store, lambda what, slice_: progress(f"{scene.name}: {what}", slice_))
    schedule.compare(entries)
    used = list(entries)
    if scene.reference:
        references, source = [tool.read(scene.reference)], str(scene.reference)
    else:
        maker = Entry(case.reference_maker(), Renderer(case, scene, case.reference_maker(), bin_folder, store.folder))
        schedule.reference(maker)
        if maker.failure:
            raise CaseError(f'{scene.name}: the reference by "{maker.setting.name}": {maker.failure}')
        references = [tool.read(s.image) for s in maker.slices()]
        samples = sum(s.cost.samples for s in maker.slices())
        source = f"{maker.setting.name}, {samples} samples per pixel in {len(references)} slices"
        used.append(maker)
    print(f"{scene.name}: judging", file=sys.stderr)
    return SceneAnalysis(case, scene.name, tool, references, source).run(entries), used


def compare(options: argparse.Namespace) -> int:
    case = case_of(options)
    root = Path(__file__).resolve().parent.parent
    bin_folder = (options.bin or root / "build" / "release" / "bin").resolve()
    out: Path = options.out or Path(f"{options.inputs[0].stem}-compare")
    store = SliceStore(out.resolve() / "slices")
    tool = ImageTool(bin_folder)
    machine = provenance.machine(sys.argv)
    progress = Progress(case)
    scenes = []
    for scene in case.scenes:
        result, entries = compare_scene(case, scene, store, tool, bin_folder, progress)
        scenes.append((result, provenance.scene_provenance(result, entries, tool)))
        for name, failure in result.failures.items():
            print(f'pbrt-compare: error: {scene.name}: "{name}": {failure}', file=sys.stderr)
    results = [result for result, _ in scenes]
    machine["loadAtEnd"] = provenance.machine([])["load"]
    for name, rows in (("curves", tables.curve_rows), ("slices", tables.slice_rows)):
        tables.write_csv(out / f"{name}.csv", [row for result in results for row in rows(result)])
    tables.write_csv(out / "summary.csv", [tables.summary_row(s, r) for s in results for r in s.results])
    content = {"title": case.title, "machine": machine, "case": dataclasses.asdict(case),
               "scenes": [tables.scene_json(case, result, where) for result, where in scenes]}
    (out / "report.json").write_text(json.dumps(content, indent=1, default=str) + "\n")
    report.write(out, case, scenes, machine)
    for result in results:
        print(terminal_table(case, result))
    print(f"wrote {out / 'report.html'}, and CSV, JSON and PNG files beside it")
    return 1 if any(r.failures for r in results) else 0


def main(words: list[str] | None = None) -> int:
    try:
        return compare(arguments(words))
    except CaseError as error:
        print(f"pbrt-compare: error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\npbrt-compare: stopped; the same command goes on from here", file=sys.stderr)
        return 130
