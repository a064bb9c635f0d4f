#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""What programs or settings make of a scene's noise and time: variance, processor time and their product, relative to the first of them.

  ways.py NAME=COMMAND NAME=COMMAND... --scene FILE... [--spp N] [--seeds N] [-o FILE.csv]

COMMAND is a pbrt with options, such as "build/release/bin/pbrt --mediumparams ...", or an earlier commit's pbrt. In each round every command renders the
scene once, on one thread, with the round's seed, in turn: what slows the machine down slows all. Variance is per pixel, over the seeds:
its mean over the pixels, the same without the worst 0.1 % of them, and its median. Times are medians over the rounds, of the whole process.
scripts/benchmarks.py record FILE.csv takes the ratios into docs/benchmarks.md.
"""
import argparse
import csv
import os
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))
from compare.pictures import read_pfm  # noqa: E402

WORST = 1e-3  # share of the pixels


def render(command: str, scene: pathlib.Path, spp: int, seed: int, image: pathlib.Path) -> float:
    """Processor seconds of the whole program."""
    before = os.times()
    subprocess.run([*shlex.split(command), str(scene), "--spp", str(spp), "--seed", str(seed), "--nthreads", "1", "--quiet", "--outfile", str(image)],
                   check=True, stdout=subprocess.DEVNULL)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def variances(images: list[np.ndarray]) -> dict[str, float]:
    """Of a pixel's value, over independent images."""
    each = np.sort(np.var(np.array(images, dtype=np.float64), axis=0, ddof=1).mean(axis=-1).ravel())
    return {"variance": each.mean(), "usual_variance": each[:each.size - int(each.size * WORST)].mean(), "median_variance": np.median(each)}


def measure(commands: dict[str, str], scene: pathlib.Path, spp: int, seeds: int) -> list[dict[str, str]]:
    seconds, images = {name: [] for name in commands}, {name: [] for name in commands}
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder) / "image.pfm"
        for seed in range(seeds):
            for name, command in commands.items():
                seconds[name].append(render(command, scene, spp, 1000 + seed, image))
                images[name].append(read_pfm(image))
    found = {name: {"seconds": statistics.median(seconds[name]), **variances(images[name])} for name in commands}
    base = next(iter(found.values()))
    return [{"scene": scene.stem, "way": name, **{key: f"{value / base[key]:.3f}" for key, value in row.items()}} for name, row in found.items()]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("commands", nargs="+", metavar="NAME=COMMAND")
    parser.add_argument("--scene", nargs="+", type=pathlib.Path, required=True)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("-o", dest="out", type=pathlib.Path)
    options = parser.parse_args()
    if options.seeds < 2:
        parser.error("--seeds: a variance takes at least 2")
    commands = dict(c.split("=", 1) if "=" in c else parser.error(f"{c}: expected NAME=COMMAND") for c in options.commands)
    rows = [row for scene in options.scene for row in measure(commands, scene, options.spp, options.seeds)]
    for row in rows:
        print("  ".join(row.values()))
    if options.out:
        with options.out.open("w", newline="") as file:
            out = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            out.writeheader()
            out.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
