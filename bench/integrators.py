#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""How bdpt, mlt and sppm compare with `path`, here and in PBRT-v3: error, processor time and their product, relative to `path` of the same program.

  integrators.py PBRT IMGTOOL FOLDER [--seeds N] [--only SCENE...] [--keep FOLDER] [-o FILE.csv]

FOLDER holds own-*.pbrt, the images that PBRT-v3 made of them in reference/*.exr, and its seconds in the table of reference/TIMES.md. Both programs
take the samples that the scene files ask for. In each round every scene is rendered once, on one thread, with the round's seed, in turn: what
slows the machine down slows all. Times are medians over the rounds, of the whole process. --keep: renders that are in this folder are not made
again, so that a measurement may be cut off.

Error is the mean over the pixels of (x - truth)² / (truth² + (mean / 10)²), truth being the mean of our images by bdpt of other seeds: as these are
independent, products of distances from two of them have no noise of their own on average, and biased images count what they are off. PBRT-v3's
image is one alone, so its error is good to some tenths.
"""
import argparse
import csv
import itertools
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))
from compare.pictures import read_pfm  # noqa: E402

BASE = "path-room"
TRUTHS = {"path-room": "bdpt-room", "bdpt-room": "bdpt-room", "mlt-room": "bdpt-room", "sppm-room": "bdpt-room", "bdpt-fog": "bdpt-fog",
          "bdpt-grid": "bdpt-grid"}
DARK = 0.1  # of the mean, below which errors count by it

Image = np.ndarray


def render(program: str, scene: pathlib.Path, seed: int, image: pathlib.Path) -> float:
    """Processor seconds of the whole program."""
    before = os.times()
    subprocess.run([*program.split(), str(scene), "--seed", str(seed), "--nthreads", "1", "--quiet", "--outfile", str(image)], check=True,
                   stdout=subprocess.DEVNULL)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def relative_error(images: list[Image], truths: list[Image]) -> float:
    """Of the images, each of a seed of its own; those of the truth may be the same."""
    truth = np.mean(truths, axis=0)
    scale = truth ** 2 + (DARK * truth.mean()) ** 2
    if any(np.array_equal(i, t) for i, t in itertools.product(images, truths)):
        return float((np.var(images, axis=0, ddof=1) / scale).mean())
    products = [(i - a) * (i - b) for i in images for a, b in itertools.combinations(truths, 2)]
    return float((np.mean(products, axis=0) / scale).mean())


def seconds_of_pbrt(times: str) -> dict[str, float]:
    """Per scene, from the rows `| own-NAME | seconds | ... |`."""
    return {name: float(seconds) for name, seconds in re.findall(r"^\| own-([\w-]+) \| ([\d.]+) \|", times, re.MULTILINE)}


def measure(options: argparse.Namespace) -> list[dict[str, str]]:
    scenes = [s for s in TRUTHS if not options.only or s in {BASE, *options.only} | {TRUTHS[o] for o in options.only} | {TRUTHS[BASE]}]
    seconds, images = {s: [] for s in scenes}, {s: [] for s in scenes}
    theirs_seconds = seconds_of_pbrt((options.folder / "reference" / "TIMES.md").read_text())
    theirs = {}
    with tempfile.TemporaryDirectory() as passing:
        folder = options.keep or pathlib.Path(passing)
        folder.mkdir(exist_ok=True)
        for seed, scene in itertools.product(range(options.seeds), scenes):
            file, time = folder / f"{scene}-{seed}.pfm", folder / f"{scene}-{seed}.seconds"
            if not time.is_file():
                took = render(options.pbrt, options.folder / f"own-{scene}.pbrt", 1000 + seed, file)
                time.write_text(f"{took:.2f}\n")
            seconds[scene].append(float(time.read_text()))
            images[scene].append(read_pfm(file).astype(np.float64))
        file = folder / "theirs.pfm"
        for scene in scenes:
            subprocess.run([options.imgtool, "convert", str(options.folder / "reference" / f"own-{scene}.exr"), str(file)], check=True,
                           stdout=subprocess.DEVNULL)
            theirs[scene] = read_pfm(file).astype(np.float64)
    ours = {s: (statistics.median(seconds[s]), relative_error(images[s], images[TRUTHS[s]])) for s in scenes}
    pbrt = {s: (theirs_seconds[s], relative_error([theirs[s]], images[TRUTHS[s]])) for s in scenes}
    return [{"picture": s, **{f"{whose}_{what}": f"{found[s][i] / found[BASE][i]:.3f}" for whose, found in (("ours", ours), ("pbrt", pbrt))
                              for i, what in enumerate(("seconds", "error"))}} for s in scenes]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pbrt")
    parser.add_argument("imgtool")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", nargs="+", choices=TRUTHS, help="these, and what they are compared with")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("-o", dest="out", type=pathlib.Path)
    options = parser.parse_args()
    if options.seeds < 2:
        parser.error("--seeds: an error takes at least 2")
    rows = measure(options)
    print("picture     seconds  error  product   of PBRT-v3: seconds  error  product   times better")
    for row in rows:
        ours, pbrt = ([float(row[f"{whose}_{what}"]) for what in ("seconds", "error")] for whose in ("ours", "pbrt"))
        better = pbrt[0] * pbrt[1] / (ours[0] * ours[1]) if ours[0] * ours[1] > 0 else float("nan")
        print(f"{row['picture']:10} {ours[0]:8.2f} {ours[1]:6.3f} {ours[0] * ours[1]:8.3f} {pbrt[0]:21.2f} {pbrt[1]:6.3f} {pbrt[0] * pbrt[1]:8.3f} "
              f"{better:14.2f}")
    if options.out:
        with options.out.open("w", newline="") as file:
            out = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            out.writeheader()
            out.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
