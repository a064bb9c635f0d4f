#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""What scenes pay for parts that they do not need: pbrt against itself, built without the part, on a scene that leaves the part alone.

  without_parts.py list                             checks bench/parts/parts.txt: every text occurs exactly once in its file
  without_parts.py run [NAME...] [--rounds N] [--instructions] [-o FILE.csv]
  without_parts.py page FILE.csv DOCS.md            the results as a page

`run` builds a copy of the tracked files in build/without/tree once as it is and once for each part without it, and renders the part's scene by both
in turn, on one thread, another seed each round. Both must give the same bits. The ratio is that of the processor time of the program as it is to
that of the program without the part; median over the rounds with the interval of 95 % that order statistics give. "control" is the
same program twice. With names, lines that FILE.csv has of other parts stay. --instructions also counts instructions by valgrind's cachegrind (4 samples of each pixel), which no load of the machine changes.
"""
import argparse
import csv
import dataclasses
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))

import mutations  # noqa: E402
from option_costs import interval, seconds_of  # noqa: E402

PARTS = ROOT / "bench" / "parts" / "parts.txt"
CONTROL = "control"
LIMIT = 1.02
COLUMNS = ["part", "scene", "left out", "time", "low", "high", "instructions"]


@dataclasses.dataclass(frozen=True)
class Edit:
    path: str
    before: str
    after: str


@dataclasses.dataclass(frozen=True)
class Part:
    name: str
    scene: str
    words: str
    edits: tuple[Edit, ...]


def parse(text: str) -> list[Part]:
    parts = []
    for block in re.split(r"\n\s*\n", re.sub(r"(?m)^#.*\n?", "", text).strip()):
        lines = block.splitlines()
        head = re.fullmatch(r"(\w+) (\w+): (.+)", lines[0])
        if not head:
            raise ValueError(f"{lines[0]}: expected \"name scene: words\"")
        edits: list[dict[str, list[str]]] = []
        for line in lines[1:]:
            word, _, rest = line.partition(" ")
            if word == "in":
                edits.append({"in": [rest], "-": [], "+": []})
            elif word in ("-", "+") and edits:
                edits[-1][word].append(rest)
            else:
                raise ValueError(f"{head[1]}: expected in, - or +, found \"{line}\"")
        parts.append(Part(*head.groups(), tuple(Edit(e["in"][0], "\n".join(e["-"]), "\n".join(e["+"])) for e in edits)))
    return parts


def problems(parts: list[Part]) -> list[str]:
    found = []
    for part in parts:
        if not (PARTS.parent / f"{part.scene}.pbrt").is_file():
            found.append(f"{part.name}: there is no scene {part.scene}")
        for edit in part.edits:
            path = ROOT / edit.path
            count = path.read_text().count(edit.before) if path.is_file() else 0
            if count != 1:
                found.append(f"{part.name}: \"{edit.before}\" occurs {count} times in {edit.path}, expected once")
    return found


def build(tree: mutations.Tree, edits: tuple[Edit, ...], program: pathlib.Path) -> None:
    whole = {edit.path: (tree.tree / edit.path).read_text() for edit in edits}
    try:
        for edit in edits:
            path = tree.tree / edit.path
            path.write_text(path.read_text().replace(edit.before, edit.after))
        built = tree.ninja(["pbrt"])
        if built.returncode != 0:
            sys.exit(f"error: {program.name} does not build:\n{built.stdout[-4000:]}")
        shutil.copy2(tree.build / "bin" / "pbrt", program)
    finally:
        for path, text in whole.items():
            (tree.tree / path).write_text(text)


def command(program: pathlib.Path, scene: str, seed: int, image: pathlib.Path, *options: str) -> list[str]:
    return [str(program), "--quiet", "--nthreads", "1", "--seed", str(seed), "--pixeltype", "float", "--outfile", str(image), *options,
            str(PARTS.parent / f"{scene}.pbrt")]


def pixels(image: pathlib.Path) -> str:
    """The image without its header, which tells seconds and versions."""
    imgtool = ROOT / "build" / "release" / "bin" / "imgtool"
    plain = image.with_suffix(".pfm")
    subprocess.run([str(imgtool), "convert", str(image), str(plain)], check=True, capture_output=True)
    return plain.read_bytes().hex()


def instructions_of(words: list[str]) -> int:
    done = subprocess.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", *words], capture_output=True, text=True)
    counted = re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)
    if done.returncode != 0 or not counted:
        sys.exit(f"error: valgrind: status {done.returncode}\n{done.stderr[-2000:]}")
    return int(counted[1].replace(",", ""))


def measure(part: Part, program: pathlib.Path, whole: pathlib.Path, rounds: int, counts: bool) -> list[str]:
    ratios = []
    with tempfile.TemporaryDirectory() as name:
        images = {program: pathlib.Path(name) / "without.exr", whole: pathlib.Path(name) / "whole.exr"}
        for round_number in range(rounds):
            turn = [program, whole] if round_number % 2 == 0 else [whole, program]
            seconds = {p: seconds_of(command(p, part.scene, round_number, images[p])) for p in turn}
            ratios.append(seconds[whole] / seconds[program])
        if pixels(images[program]) != pixels(images[whole]):
            sys.exit(f"error: {part.name}: scene {part.scene} is another image without it")
        counted = ""
        if counts:
            few = [instructions_of(command(p, part.scene, 0, images[p], "--spp", "4")) for p in (whole, program)]
            counted = f"{few[0] / few[1]:.4f}"
    low, high = interval(ratios)
    return [part.name, part.scene, part.words, f"{statistics.median(ratios):.4f}", f"{low:.4f}", f"{high:.4f}", counted]


def run(parts: list[Part], o: argparse.Namespace) -> int:
    tree = mutations.Tree(ROOT, "", "without")
    tree.configure()
    tree.must(["cmake", "--build", str(tree.build), "--target", "build.ninja"])
    folder = ROOT / "build" / "without"
    whole = folder / "pbrt-whole"
    build(tree, (), whole)
    again = folder / "pbrt-again"
    shutil.copy2(whole, again)
    rows = [measure(Part(CONTROL, "cloud", "nothing: the same program twice", ()), again, whole, o.rounds, False)]
    for part in parts:
        program = folder / f"pbrt-without-{part.name}"
        build(tree, part.edits, program)
        rows.append(measure(part, program, whole, o.rounds, o.instructions))
        print(", ".join(rows[-1]), file=sys.stderr, flush=True)
    if o.outfile and o.names and pathlib.Path(o.outfile).is_file():
        with open(o.outfile, newline="") as file:
            rows = with_others(rows, list(csv.reader(file))[1:])
    out = open(o.outfile, "w", newline="") if o.outfile else sys.stdout
    table = csv.writer(out, lineterminator="\n")
    table.writerows([COLUMNS, *rows])
    return 0


def with_others(rows: list[list[str]], earlier: list[list[str]]) -> list[list[str]]:
    """Rows of parts that were measured, and earlier ones of the others, in the order of the list; those of parts that are gone are left out."""
    found = {row[0]: row for row in (*earlier, *rows)}
    return [found[name] for name in (CONTROL, *(p.name for p in parse(PARTS.read_text()))) if name in found]


def page(rows: list[dict[str, str]]) -> str:
    body = []
    measured = {row["part"] for row in rows}
    missing = [name for name in (CONTROL, *(p.name for p in parse(PARTS.read_text()))) if name not in measured]
    left = f" Not measured yet: {', '.join(missing)}." if missing else ""
    for row in rows:
        count = f"{float(row['instructions']):.3f}" if row["instructions"] else ""
        body.append(f"| {row['part']} | {row['left out']} | `{row['scene']}` | {float(row['time']):.3f} "
                    f"| {float(row['low']):.3f} to {float(row['high']):.3f} | {count} |")
    beyond = [row["part"] for row in rows if row["part"] != CONTROL and float(row["low"]) > LIMIT]
    verdict = (f"No scene pays more than {100 * (LIMIT - 1):.0f} % for a part that it does not need, as far as the intervals can tell."
               if not beyond else f"More than {100 * (LIMIT - 1):.0f} % is paid for: {', '.join(beyond)}.")
    return "\n".join([
        "# What scenes pay for parts that they do not need", "",
        "This page is generated: `bench/without_parts.py run --instructions -o docs/unneeded.csv`, then `bench/without_parts.py page docs/unneeded.csv",
        "docs/unneeded.md`. The program is built as it is and once without each part (`bench/parts/parts.txt` has the edits); both render a scene of",
        "`bench/parts` that does not need it, in turn on one thread, to the same bits. That such a scene does not build the part either is a test",
        "(`tests/main/built_parts_test.cpp`; the counts are in `--stats`, [statistics](statistics.md)).", "",
        verdict + left, "",
        "| part | what the other program lacks | scene | processor time with / without | 95 % | instructions with / without |",
        "| --- | --- | --- | --- | --- | --- |", *body, ""])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("list")
    running = commands.add_parser("run")
    running.add_argument("names", nargs="*")
    running.add_argument("--rounds", type=int, default=9)
    running.add_argument("--instructions", action="store_true")
    running.add_argument("-o", "--outfile")
    paging = commands.add_parser("page")
    paging.add_argument("table")
    paging.add_argument("docs")
    o = parser.parse_args()
    if o.command == "page":
        with open(o.table, newline="") as file:
            pathlib.Path(o.docs).write_text(page(list(csv.DictReader(file))))
        return 0
    parts = parse(PARTS.read_text())
    if found := problems(parts):
        print("\n".join(found), file=sys.stderr)
        return 1
    if o.command == "list":
        print(f"{len(parts)} parts")
        return 0
    if unknown := set(o.names) - {p.name for p in parts}:
        sys.exit(f"error: no part is called {', '.join(sorted(unknown))}; there are {', '.join(p.name for p in parts)}")
    return run([p for p in parts if not o.names or p.name in o.names], o)


if __name__ == "__main__":
    sys.exit(main())
