#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""What scenes cost as they grow: processor time of a sample, seconds to the first pixel, and memory, against size. A cliff shows as a step.

  sizes.py BIN [--kinds NAME,...] [--spp N] [--rounds N] [--quick] [-o FILE.csv] [--plot FILE.png]

BIN is the folder of pbrt (and of example_volume and vdb2pbrt, which make the volumes; without them voxels are left out). Kinds:

  triangles   a ball of fog whose boundary is a mesh of 10^2 to 10^6 triangles, under a sky
  lights      1 to 10^4 lamps of the same power in all, over a floor in fog
  voxels      smoke, sparse, in boxes of 64^3 to 1024^3 voxels, nine tenths empty
  instances   1 to 10^5 placed balls
  threads-*   the scenes of bench/peer_scenes.py by 1, 2, 4, ... threads, as many as there are processors

Times are medians over the rounds, on one thread but for the last kind; the sizes of a kind take turns in each round.
"""
import argparse
import csv
import json
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))
from bench.light_choice import in_fog  # noqa: E402
from bench.measuring import run  # noqa: E402
from bench.peer_scenes import SCENES, V3  # noqa: E402

HEAD = """Film "image" "integer xresolution" 64 "integer yresolution" 64
PixelFilter "box"
Sampler "02sequence" "integer pixelsamples" 1
Integrator "volpath" "integer maxdepth" 5
LookAt 0 -4 0  0 0 0  0 0 1
Camera "perspective" "float fov" 40
WorldBegin
LightSource "infinite" "rgb L" [ .5 .6 .7 ]
"""
NUMBERS = ("us_per_sample", "elapsed_us_per_sample", "first_pixel_seconds", "megabytes")


def ball(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of a closed bumpy ball of radius about 1, of `count` triangles or a few less. They face outward."""
    rows = max(2, int((1 + np.sqrt(1 + count)) / 2))
    columns = 2 * rows
    theta, phi = np.meshgrid(np.arange(1, rows) * np.pi / rows, np.arange(columns) * np.pi / rows, indexing="ij")
    radius = 1 + 0.05 * np.sin(9 * phi) * np.sin(theta) ** 4 * np.cos(7 * theta)
    ring = np.stack([radius * np.sin(theta) * np.cos(phi), radius * np.sin(theta) * np.sin(phi), radius * np.cos(theta)], -1).reshape(-1, 3)
    points = np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]])
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns), indexing="ij")
    at, right = i * columns + j, i * columns + (j + 1) % columns
    top = np.stack([np.full(columns, len(ring)), at[0], right[0]], -1)
    bottom = np.stack([np.full(columns, len(ring) + 1), right[-1], at[-1]], -1)
    above, beside = at[:-1].ravel(), right[:-1].ravel()
    quads = np.concatenate([np.stack([above, above + columns, beside + columns], -1), np.stack([above, beside + columns, beside], -1)])
    return points, np.concatenate([top, quads, bottom])


def write_ply(path: pathlib.Path, points: np.ndarray, triangles: np.ndarray) -> None:
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    faces = np.zeros(len(triangles), dtype=[("count", "u1"), ("index", "<i4", 3)])
    faces["count"], faces["index"] = 3, triangles
    path.write_bytes(header.encode() + points.astype("<f4").tobytes() + faces.tobytes())


def with_triangles(folder: pathlib.Path, count: int, _: pathlib.Path) -> str:
    write_ply(folder / "ball.ply", *ball(count))
    return (HEAD + 'MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ .1 .1 .1 ] "rgb sigma_s" [ 1 1 1 ]\n'
            'Material ""\nMediumInterface "fog" ""\nShape "plymesh" "string filename" "ball.ply"\nWorldEnd\n')


def with_lights(_: pathlib.Path, count: int, __: pathlib.Path) -> str:
    return in_fog(count)


def with_voxels(folder: pathlib.Path, edge: int, bin_folder: pathlib.Path) -> str:
    run([str(bin_folder / "example_volume"), str(folder), str(edge)])
    run([str(bin_folder / "vdb2pbrt"), str(folder / "plume.vdb"), "--precision", "fp8", "--quiet", "--sigma-a", "1", "1", "1", "--sigma-s", "25", "25", "25"])
    (folder / "plume.vdb").unlink()
    return HEAD.replace("0 -4 0  0 0 0", "0 -4.4 1.3  0 0 1") + 'Include "plume.pbrt"\nWorldEnd\n'


def with_instances(_: pathlib.Path, count: int, __: pathlib.Path) -> str:
    chance = random.Random(5)
    place = "AttributeBegin\nTranslate {:.4f} {:.4f} {:.4f}\nScale {s:.5f} {s:.5f} {s:.5f}\nObjectInstance \"ball\"\nAttributeEnd\n"
    size = 0.6 * count ** (-1 / 3)
    return (HEAD + 'ObjectBegin "ball"\nShape "sphere"\nObjectEnd\n'
            + "".join(place.format(*(chance.uniform(-1, 1) for _ in range(3)), s=size) for _ in range(count)) + "WorldEnd\n")


Maker = Callable[[pathlib.Path, int, pathlib.Path], str]
KINDS: dict[str, tuple[Maker, tuple[int, ...]]] = {
    "triangles": (with_triangles, (100, 1000, 10000, 100000, 1000000)), "lights": (with_lights, (1, 10, 100, 1000, 10000)),
    "voxels": (with_voxels, (64, 128, 256, 512, 1024)), "instances": (with_instances, (1, 10, 100, 1000, 10000, 100000)),
}


def rendered(bin_folder: pathlib.Path, folder: pathlib.Path, spp: int, threads: int) -> dict[str, float]:
    """What one render of scene.pbrt costs."""
    run([str(bin_folder / "pbrt"), "scene.pbrt", "--spp", str(spp), "--nthreads", str(threads), "--quiet", "--outfile", "image.pfm", "--stats", "stats.json"],
        folder)
    told = json.loads((folder / "stats.json").read_text())["renders"][0]
    seconds, samples = told["seconds"], told["samplesTaken"]
    one_pixel = run([str(bin_folder / "pbrt"), "scene.pbrt", "--spp", "1", "--cropwindow", "0.5", "0.51", "0.5", "0.51", "--nthreads", str(threads), "--quiet",
                "--outfile", "image.pfm"], folder)
    return {"us_per_sample": seconds["render"]["cpu"] / samples * 1e6, "elapsed_us_per_sample": seconds["render"]["wall"] / samples * 1e6,
            "first_pixel_seconds": one_pixel.elapsed, "megabytes": told["peakMemoryBytes"] / 1e6}


def measure(kind: str, cases: dict[int, pathlib.Path], bin_folder: pathlib.Path, o: argparse.Namespace) -> list[dict[str, str]]:
    """Of the sizes, whose scenes are in these folders. For threads the size is their number."""
    found: dict[int, list[dict[str, float]]] = {size: [] for size in cases}
    for _ in range(o.rounds):
        for size, folder in cases.items():
            found[size].append(rendered(bin_folder, folder, o.spp, size if kind.startswith("threads-") else 1))
    return [{"kind": kind, "size": str(size), **{n: f"{statistics.median(r[n] for r in rows):.4g}" for n in NUMBERS}} for size, rows in found.items()]


def rows_of(kind: str, bin_folder: pathlib.Path, o: argparse.Namespace) -> list[dict[str, str]]:
    with tempfile.TemporaryDirectory() as place:
        cases = {}
        if kind.startswith("threads-"):
            scene = SCENES[kind.removeprefix("threads-")](V3, 16 if o.quick else 128, 24 if o.quick else 192)
            (pathlib.Path(place) / "scene.pbrt").write_text(scene)
            most = os.cpu_count() or 1
            cases = {n: pathlib.Path(place) for n in sorted({*(2 ** k for k in range(most.bit_length())), most})}
        else:
            make, sizes = KINDS[kind]
            for size in sizes[:2] if o.quick else sizes:
                cases[size] = pathlib.Path(place) / str(size)
                cases[size].mkdir()
                (cases[size] / "scene.pbrt").write_text(make(cases[size], size, bin_folder))
        return measure(kind, cases, bin_folder, o)


def plot(rows: list[dict[str, str]], path: pathlib.Path) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 3, figsize=(13, 4), layout="constrained")
    labels = {"us_per_sample": "processor time of a sample (µs)", "first_pixel_seconds": "seconds to the first pixel", "megabytes": "memory (MB)"}
    for axis, (number, label) in zip(axes, labels.items()):
        for kind in KINDS:
            points = [(int(r["size"]), float(r[number])) for r in rows if r["kind"] == kind]
            if points:
                axis.plot(*zip(*points), marker="o", markersize=4, label=kind if kind != "voxels" else "voxels an edge")
        axis.set(xscale="log", yscale="log", xlabel="size", title=label)
        axis.grid(alpha=0.3)
    axes[1].legend(loc="upper left")
    figure.savefig(path, dpi=100)


def main() -> int:
    known = [*KINDS, *(f"threads-{s}" for s in SCENES)]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--kinds", default=",".join(known))
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--quick", action="store_true", help="the two smallest sizes of each kind")
    parser.add_argument("-o", dest="out", type=pathlib.Path)
    parser.add_argument("--plot", type=pathlib.Path)
    o = parser.parse_args()
    folder, kinds = o.bin.resolve(), o.kinds.split(",")
    if unknown := [k for k in kinds if k not in known]:
        parser.error(f"--kinds: unknown {', '.join(unknown)}; known: {', '.join(known)}")
    if "voxels" in kinds and not all((folder / p).is_file() for p in ("example_volume", "vdb2pbrt")):
        print("voxels are left out: no example_volume and vdb2pbrt there (they need OpenVDB)", file=sys.stderr)
        kinds.remove("voxels")
    try:
        rows = [row for kind in kinds for row in rows_of(kind, folder, o)]
    except subprocess.CalledProcessError as error:
        sys.exit(f"error: {error.cmd[0]}: status {error.returncode}\n{error.stderr}")
    for row in rows:
        print("  ".join(row.values()))
    if o.out:
        with o.out.open("w", newline="", encoding="utf-8") as file:
            out = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            out.writeheader()
            out.writerows(rows)
    if o.plot:
        plot(rows, o.plot)
    return 0


if __name__ == "__main__":
    sys.exit(main())
