#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""What ways of choosing lights are worth: variance times processor time, in scenes of one lamp to ten thousand.

  light_choice.py PBRT [--before PBRT] [--strategies power,spatial,...] [--scenes NAME,...] [--scene FILE ...] [--spp N] [--rounds N]

Each round renders every scene with every strategy once, on one thread, with a seed of its own. Variance is that of a pixel over the rounds: the mean
over the image, and the median pixel's, which bright spots do not hide; times the median of the processor time. All relative to the first
strategy of a scene (of --before, if given, a program built from an earlier commit, which is then also run with it). --scene: other scenes.
"""
import argparse
import array
import os
import pathlib
import random
import re
import statistics
import subprocess
import sys
import tempfile

HEAD = """Film "image" "integer xresolution" 96 "integer yresolution" 64
PixelFilter "box"
Sampler "02sequence" "integer pixelsamples" 4
Integrator "volpath" "integer maxdepth" 5
LookAt 0 -9 3  0 0 1  0 0 1
Camera "perspective" "float fov" 50
"""
FOG = """MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ .01 .01 .01 ] "rgb sigma_s" [ .04 .04 .04 ]
MediumInterface "" "fog"
"""
FLOOR = """Material "matte" "rgb Kd" [ .5 .5 .5 ]
Shape "trianglemesh" "integer indices" [ 0 1 2 2 3 0 ] "point P" [ -20 -20 0  20 -20 0  20 20 0  -20 20 0 ]
AttributeBegin
Translate 0 0 1
Shape "sphere" "float radius" 1
AttributeEnd
"""
SHELL = """AttributeBegin
MediumInterface "fog" ""
Material ""
Shape "sphere" "float radius" 60
AttributeEnd
"""


def lamps(count: int) -> str:
    """Points of different colours over the floor, of the same power in all."""
    chance = random.Random(3)
    line = 'LightSource "point" "point from" [ %.3f %.3f %.3f ] "rgb I" [ %.5f %.5f %.5f ]\n'
    return "".join(line % (chance.uniform(-6, 6), chance.uniform(-4, 8), chance.uniform(0.1, 4), *(chance.random() * 60 / count for _ in range(3)))
                   for _ in range(count))


def in_fog(count: int) -> str:
    return HEAD + FOG + 'WorldBegin\nMediumInterface "fog" "fog"\n' + lamps(count) + FLOOR + SHELL + "WorldEnd\n"


def on_surfaces(count: int) -> str:
    return HEAD + "WorldBegin\n" + lamps(count) + FLOOR + "WorldEnd\n"


def two_rooms() -> str:
    """The camera is in one room with two lamps, ten more are in the next, behind a wall that is open at its end."""
    text = HEAD.replace("LookAt 0 -9 3  0 0 1", "LookAt -1 -7 2  -2 0 1.5") + "WorldBegin\n"
    for i in range(12):
        text += ('AttributeBegin\nAreaLightSource "diffuse" "rgb L" [ 5 5 5 ]\n'
                 f"Translate {-3 if i < 2 else 3} {-2 + i % 6 * 1.2:g} 3.5\n" 'Shape "sphere" "float radius" .2\nAttributeEnd\n')
    text += 'Material "matte" "rgb Kd" [ .5 .5 .5 ]\n'
    walls = [[(-8, -8, z), (8, -8, z), (8, 8, z), (-8, 8, z)] for z in (0, 4)] + [[(0, -8, 0), (0, 6, 0), (0, 6, 4), (0, -8, 4)]]
    walls += [[(x, -8, 0), (x, 8, 0), (x, 8, 4), (x, -8, 4)] for x in (-8, 8)] + [[(-8, y, 0), (8, y, 0), (8, y, 4), (-8, y, 4)] for y in (-8, 8)]
    for wall in walls:
        corners = "  ".join("%g %g %g" % p for p in wall)
        text += f'Shape "trianglemesh" "integer indices" [ 0 1 2 2 3 0 ] "point P" [ {corners} ]\n'
    return text + "WorldEnd\n"


SCENES = {
    **{f"fog-{n}": (lambda n=n: in_fog(n)) for n in (1, 10, 100, 1000, 10000)},
    **{f"surfaces-{n}": (lambda n=n: on_surfaces(n)) for n in (10, 1000, 10000)},
    "two-rooms": two_rooms,
}


def read_pfm(path: pathlib.Path) -> list[float]:
    """Mean of the channels of each pixel."""
    with path.open("rb") as f:
        kind, size, scale = (f.readline().split() for _ in range(3))
        values = array.array("f", f.read())
    if kind != [b"PF"]:
        raise SystemExit(f"{path}: no colour PFM")
    if (float(scale[0]) < 0) != (sys.byteorder == "little"):
        values.byteswap()
    pixels = int(size[0]) * int(size[1])
    return [sum(values[3 * i:3 * i + 3]) / 3 for i in range(pixels)]


def with_strategy(scene: str, strategy: str) -> str:
    text, count = re.subn(r'Integrator\s+"\w+"', lambda m: f'{m[0]} "string lightsamplestrategy" "{strategy}"', scene, count=1)
    if not count:
        raise SystemExit("the scene has no Integrator")
    return text


def render(pbrt: str, scene: str, folder: str, image: pathlib.Path, seed: int, spp: int) -> tuple[float, list[float]]:
    """Processor seconds, and the pixels. Scenes are read from standard input, in their folder."""
    before = os.times()
    subprocess.run([pbrt, "--quiet", "--nthreads", "1", "--seed", str(seed), "--spp", str(spp), "--outfile", str(image), "-"], input=scene.encode(),
                   cwd=folder, check=True)
    after = os.times()
    return after.children_user - before.children_user + after.children_system - before.children_system, read_pfm(image)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pbrt")
    parser.add_argument("--before")
    parser.add_argument("--strategies", default="power,spatial,tree,learned")
    parser.add_argument("--scenes", default=",".join(SCENES), help="known: " + ", ".join(SCENES))
    parser.add_argument("--scene", action="append", default=[], type=pathlib.Path)
    parser.add_argument("--spp", type=int, default=4)
    parser.add_argument("--rounds", type=int, default=4)
    args = parser.parse_args()
    if args.rounds < 2:
        raise SystemExit("a variance needs two rounds at least")
    scenes = {name: (SCENES[name](), ".") for name in args.scenes.split(",") if name}
    scenes |= {path.name: (path.read_text(encoding="utf-8"), str(path.parent)) for path in args.scene}
    strategies = args.strategies.split(",")
    runs = [(args.before, strategies[0])] if args.before else []
    runs += [(args.pbrt, strategy) for strategy in strategies]
    print("scene,program,strategy,seconds,variance,mean,variance x seconds,median variance x seconds")
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder) / "image.pfm"
        for name, (scene, place) in scenes.items():
            seconds = [[] for _ in runs]
            images = [[] for _ in runs]
            for seed in range(1, args.rounds + 1):
                for i, (pbrt, strategy) in enumerate(runs):
                    time, pixels = render(os.path.abspath(pbrt), with_strategy(scene, strategy), place, image, seed, args.spp)
                    seconds[i].append(time)
                    images[i].append(pixels)
            first = None
            for i, (pbrt, strategy) in enumerate(runs):
                variances = [statistics.variance(pixel) for pixel in zip(*images[i])]
                time, mean = statistics.median(seconds[i]), statistics.fmean(map(statistics.fmean, images[i]))
                costs = time * statistics.fmean(variances), time * statistics.median(variances)
                first = first or costs
                relative = [f"{c / f:.3f}" if f > 0 else "" for c, f in zip(costs, first)]
                program = "before" if args.before and i == 0 else "now"
                print(f"{name},{program},{strategy},{time:.3f},{statistics.fmean(variances):.4g},{mean:.5g},{','.join(relative)}", flush=True)


if __name__ == "__main__":
    main()
