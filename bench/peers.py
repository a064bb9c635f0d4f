#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Error times processor time of this renderer and of others, on four scenes of media (bench/peer_scenes.py).

  peers.py PBRT [--peer NAME=LANGUAGE=COMMAND]... [--scenes NAME,...] [--spp N] [--rounds N] [--quick] [-o FILE.csv] [--docs PAGE.md]

LANGUAGE is v3 or v4: the words in which a program gets its scenes. In COMMAND {scene}, {image}, {spp} and {seed} stand for what is to be rendered, to where
(a PFM), by how many samples a pixel and from which seed. Another program is, for instance,

  --peer 'v3=v3=pbrt-v3 --nthreads 1 --quiet --outfile {image} {scene}'          (it takes the samples of the scene, which are {spp} as well)
  --peer 'v4=v4=pbrt-v4 --nthreads 1 --quiet --spp {spp} --seed {seed} --outfile {image} {scene}'
  --peer 'before=v3=old/pbrt --nthreads 1 --quiet --spp {spp} --seed {seed} --outfile {image} {scene}'

In each round every program renders the scene once, on one thread, with the round's seed, in turn: what slows the machine down slows all. The error of an
image is its squared distance from a reference, which this renderer makes with 32 times the samples of a round, and whose own noise is taken off: by the mean over
pixels and channels, without the worst 0.1 % of the pixels, and by the median pixel. Error times seconds is told relative to this renderer, and so is the mean of the
image, by which one sees whether all render the same. A program without a seed makes the same image in each round, so that its error is that of one image.
"""
import argparse
import csv
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))
from bench.measuring import run  # noqa: E402
from bench.peer_scenes import LANGUAGES, SCENES  # noqa: E402
from compare.pictures import read_pfm  # noqa: E402

OURS = "this renderer"
WORST = 1e-3           # share of the pixels
REFERENCE_TIMES = 32   # samples of a round, in pieces of so many rounds each:
REFERENCE_PIECES = 4
DEFAULT = " --nthreads 1 --quiet --spp {spp} --seed {seed} --outfile {image} {scene}"

Image = np.ndarray


class Program:
    def __init__(self, name: str, language: str, command: str):
        self.name, self.language, self.command = name, language, shlex.split(command)

    def render(self, scene: pathlib.Path, spp: int, seed: int, image: pathlib.Path) -> tuple[Image, float, float]:
        """The image, processor seconds and megabytes of the whole program."""
        image.unlink(missing_ok=True)
        values = {"scene": scene, "spp": spp, "seed": seed, "image": image}
        cost = run([word.format(**values) for word in self.command], scene.parent)
        return read_pfm(image).astype(np.float64), cost.seconds, cost.megabytes


def errors(image: Image, reference: Image, noise: Image) -> dict[str, float]:
    """Squared distances, those of the reference from the truth taken off; pixels are means of their channels."""
    each = ((image - reference) ** 2 - noise).mean(axis=-1).ravel()
    order = np.sort(each)
    return {"error": order.mean(), "usual_error": order[:order.size - int(order.size * WORST)].mean(), "median_error": float(np.median(order))}


def reference_of(program: Program, scene: pathlib.Path, spp: int, image: pathlib.Path) -> tuple[Image, Image]:
    """The mean of renders of other seeds than the rounds have, and the variance of that mean by channel."""
    pieces = [program.render(scene, spp * REFERENCE_TIMES // REFERENCE_PIECES, 900 + i, image)[0] for i in range(REFERENCE_PIECES)]
    return np.mean(pieces, axis=0), np.var(pieces, axis=0, ddof=1) / REFERENCE_PIECES


def measure(programs: list[Program], name: str, options: argparse.Namespace) -> list[dict[str, str]]:
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        files = {}
        for language in {p.language for p in programs}:
            files[language] = folder / f"{name}-{language}.pbrt"
            text = SCENES[name](LANGUAGES[language], options.picture, options.volume)
            files[language].write_text(text.replace('"integer pixelsamples" 1', f'"integer pixelsamples" {options.spp}', 1))
        reference, noise = reference_of(programs[0], files[programs[0].language], options.spp, folder / "image.pfm")
        rounds: dict[str, list[dict[str, float]]] = {p.name: [] for p in programs}
        for seed in range(options.rounds):
            for p in programs:
                image, seconds, megabytes = p.render(files[p.language], options.spp, 100 + seed, folder / "image.pfm")
                rounds[p.name].append({"seconds": seconds, "megabytes": megabytes, "mean": image.mean(), **errors(image, reference, noise)})
    found = {n: {"seconds": statistics.median(r["seconds"] for r in rows), "megabytes": max(r["megabytes"] for r in rows),
                 **{key: statistics.fmean(r[key] for r in rows) for key in ("mean", "error", "usual_error", "median_error")}} for n, rows in rounds.items()}
    base = found[OURS]

    def worth(row: dict[str, float], key: str) -> str:
        """Nothing where this renderer has no error: most pixels of a plain sky."""
        whole = base[key] * base["seconds"]
        return f"{row[key] * row['seconds'] / whole:.3f}" if whole > 0 else ""

    return [{"scene": name, "program": n, "seconds": f"{r['seconds'] / base['seconds']:.3f}", "megabytes": f"{r['megabytes']:.0f}",
             "mean": f"{r['mean'] / base['mean']:.4f}",
             **{key: worth(r, key) for key in ("error", "usual_error", "median_error")}} for n, r in found.items()]


def table(rows: list[dict[str, str]]) -> str:
    header = "| scene | program | error x seconds | without the worst 0.1 % | by the median pixel | seconds | MB | mean |\n" + "| --- " * 8 + "|\n"
    return header + "".join("| " + " | ".join(r[c] for c in ("scene", "program", "error", "usual_error", "median_error", "seconds", "megabytes", "mean")) + " |\n"
                            for r in rows)


def write_docs(page: pathlib.Path, rows: list[dict[str, str]]) -> None:
    """The table of the page, between `<!-- table peers -->` and `<!-- end -->`, is written anew."""
    text = page.read_text(encoding="utf-8")
    head, found, rest = text.partition("<!-- table peers -->\n")
    _, ended, tail = rest.partition("<!-- end -->")
    if not found or not ended:
        raise SystemExit(f"error: {page}: no lines <!-- table peers --> and <!-- end -->")
    page.write_text(head + found + table(rows) + ended + tail, encoding="utf-8")


def programs_of(options: argparse.Namespace, parser: argparse.ArgumentParser) -> list[Program]:
    found = [Program(OURS, "v3", shlex.quote(str(options.pbrt.resolve())) + DEFAULT)]
    for peer in options.peer:
        name, _, rest = peer.partition("=")
        language, _, command = rest.partition("=")
        if language not in LANGUAGES or "{image}" not in command or "{scene}" not in command:
            parser.error(f"--peer {peer}: expected NAME=v3=COMMAND or NAME=v4=COMMAND, with {{scene}} and {{image}} in the command")
        found.append(Program(name, language, command))
    if len({p.name for p in found}) < len(found):
        parser.error("--peer: each needs a name of its own")
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pbrt", type=pathlib.Path)
    parser.add_argument("--peer", action="append", default=[], metavar="NAME=LANGUAGE=COMMAND")
    parser.add_argument("--scenes", default=",".join(SCENES))
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--rounds", type=int, default=6)
    parser.add_argument("--quick", action="store_true", help="pictures of 16 pixels an edge, volumes of 24: is everything there?")
    parser.add_argument("-o", dest="out", type=pathlib.Path)
    parser.add_argument("--docs", type=pathlib.Path, metavar="PAGE.md", help="writes the table of this page anew")
    options = parser.parse_args()
    options.picture, options.volume = (16, 24) if options.quick else (128, 192)
    names = options.scenes.split(",")
    if unknown := [n for n in names if n not in SCENES]:
        parser.error(f"--scenes: unknown {', '.join(unknown)}; known: {', '.join(SCENES)}")
    programs = programs_of(options, parser)
    try:
        rows = [row for name in names for row in measure(programs, name, options)]
    except subprocess.CalledProcessError as error:
        sys.exit(f"error: {shlex.join(map(str, error.cmd))}: status {error.returncode}\n{error.stderr}")
    print(table(rows), end="")
    if options.out:
        with options.out.open("w", newline="", encoding="utf-8") as file:
            out = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            out.writeheader()
            out.writerows(rows)
    if options.docs:
        write_docs(options.docs, rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
