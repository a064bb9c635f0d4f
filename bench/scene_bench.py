#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Error against time of whole renders: transmittance estimators and free-flight samplers, scene by scene.

    bench/scene_bench.py build/release/bin SCENE.pbrt... [--estimators ratio,regular] [--samplers delta,weighted-delta]
                         [--spp 8] [--rounds 3] [--crop x0 x1 y0 y1] [--csv FILE]

A method may bring float parameters: ratio+roulettethreshold=0.3.

Each round renders every variant twice with seeds of its own, in turn, so that all meet the same machine. The variance of
a variant is half the mean squared difference of its two images, which needs no reference image and is its error as
far as it is unbiased. Printed are look-ups per camera sample and the variance as means over the rounds, CPU microseconds
per camera sample as the median, and "work", variance times CPU, as a ratio to the first variant: the time to equal error.
The range is that of the rounds' own ratios.
"""
import argparse
import csv
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path


def parameter(kind: str, method: str) -> str:
    name, *values = method.split("+")
    text = f'"string {kind}" "{name}"'
    for value in values:
        text += ' "float {}" {}'.format(*value.split("="))
    return text


def render(tools: Path, scene: str, variant: tuple[str, str], seed: int, options, out: Path) -> dict:
    stats = out.with_suffix(".json")
    command = [tools / "pbrt", scene, "--spp", str(options.spp), "--seed", str(seed), "--outfile", out, "--quiet",
               "--stats", stats, "--mediumparams", f'{parameter("transmittance", variant[0])} {parameter("freeflight", variant[1])} {options.params}']
    if options.crop:
        command += ["--cropwindow", *map(str, options.crop)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return json.loads(stats.read_text())["renders"][0]


def measure(tools: Path, scene: str, variant: tuple[str, str], round_: int, options, folder: Path) -> dict:
    images = [folder / "a.exr", folder / "b.exr"]
    runs = [render(tools, scene, variant, 1000 * round_ + i, options, image) for i, image in enumerate(images)]
    difference = subprocess.run([tools / "imgtool", "diff", *images, "--json"], capture_output=True, text=True)
    samples = sum(run["samplesTaken"] for run in runs)
    cpu = sum(run["seconds"]["render"]["cpu"] for run in runs)
    variance = json.loads(difference.stdout)["mse"] / 2
    return {"lookups": sum(run["counters"]["densityLookups"] for run in runs) / samples, "cpu": 1e6 * cpu / samples,
            "variance": variance, "work": variance * cpu / samples}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tools", type=Path, help="folder of pbrt and imgtool")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--estimators", default="ratio", help="comma-separated; the first with the first sampler is the measure")
    parser.add_argument("--samplers", default="weighted-delta")
    parser.add_argument("--spp", type=int, default=8)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--crop", type=float, nargs=4)
    parser.add_argument("--params", default="", help="further medium parameters for every variant, as pbrt --mediumparams takes them")
    parser.add_argument("--csv", type=Path)
    options = parser.parse_args()
    variants = [(e, s) for e in options.estimators.split(",") for s in options.samplers.split(",")]
    rows = []
    for scene in options.scenes:
        found: dict = {variant: [] for variant in variants}
        with tempfile.TemporaryDirectory() as folder:
            for round_ in range(options.rounds):
                for variant in variants:
                    found[variant].append(measure(options.tools, scene, variant, round_, options, Path(folder)))
        print(f"\n{scene}: {options.spp} samples per pixel, {options.rounds} rounds")
        width = 2 + max(len(method) for variant in variants for method in variant)
        print(f"{'transmittance':{width}}{'free flight':{width}}{'lookups':>9}{'us CPU':>9}{'variance':>11}{'work':>8}{'range':>16}")
        summaries = {}
        for variant in variants:
            rounds = found[variant]
            average = {key: statistics.fmean(m[key] for m in rounds) for key in ("lookups", "variance")}
            average["cpu"] = statistics.median(m["cpu"] for m in rounds)
            average["work"] = average["variance"] * average["cpu"]
            summaries[variant] = average
            base = summaries[variants[0]]["work"]
            work = average["work"] / base if base > 0 else float("nan")
            ratios = [m["work"] / first["work"] for m, first in zip(rounds, found[variants[0]]) if first["work"] > 0]
            span = f"{min(ratios):.2f}..{max(ratios):.2f}" if ratios else ""
            print(f"{variant[0]:{width}}{variant[1]:{width}}{average['lookups']:9.2f}{average['cpu']:9.2f}{average['variance']:11.3e}"
                  f"{work:8.2f}{span:>16}", flush=True)
            rows.append({"scene": scene, "transmittance": variant[0], "freeflight": variant[1], **average, "ratio": work})
    if options.csv:
        with options.csv.open("w", newline="") as out:
            writer = csv.DictWriter(out, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
