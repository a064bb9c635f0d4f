#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Makes the surroundings of the example scenes, in scenes/data: a winter evening of our own.

  evening-sky.exr      latitude-longitude map of a sky after a clear day, its sun near +x +y
  mountains.pbrt.gz    a ridge of triangles in the north (y from 22 to 60)
  snowfield.pbrt.gz    uneven snow around the origin, and pines on it

Needs numpy. Deterministic: fixed seeds.
"""
import gzip
import pathlib
import struct
import zlib

import numpy as np

SUN = np.array([3.2, 2.7, 0.62])
DATA = pathlib.Path(__file__).resolve().parent.parent / "scenes" / "data"


def noise(x, y, seed):
    """Smoothly interpolated random lattice values in [-1, 1]."""
    lattice = np.random.default_rng(seed).uniform(-1, 1, (64, 64))
    ix, iy = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = x - ix, y - iy
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)

    def at(i, j):
        return lattice[i % 64, j % 64]

    return (1 - fx) * ((1 - fy) * at(ix, iy) + fy * at(ix, iy + 1)) + fx * (
        (1 - fy) * at(ix + 1, iy) + fy * at(ix + 1, iy + 1))


def sky(width=96, height=48):
    """Radiance by row (pole first) and column: warm at the sun's horizon, mauve opposite, blue above."""
    v, u = np.meshgrid((np.arange(height) + 0.5) / height * np.pi, (np.arange(width) + 0.5) / width * 2 * np.pi,
                       indexing="ij")
    d = np.stack([np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), np.cos(v)], -1)
    sun = SUN / np.linalg.norm(SUN)
    level = d[..., :2] @ sun[:2] / np.maximum(
        np.linalg.norm(d[..., :2], axis=-1) * np.linalg.norm(sun[:2]), 1e-6)
    towards = np.clip((level + 1) / 2, 0, 1)[..., None] ** 2
    horizon = np.array([0.26, 0.25, 0.36]) * (1 - towards) + np.array([0.80, 0.42, 0.24]) * towards
    elevation = np.clip(d[..., 2], 0, 1)
    low, middle = np.exp(-elevation / 0.13)[..., None], np.exp(-elevation / 0.45)[..., None]
    colour = np.array([0.03, 0.07, 0.20]) * (1 - middle) + np.array([0.14, 0.20, 0.37]) * middle
    colour = colour * (1 - low) + horizon * low
    near = (d @ sun)[..., None] - 1
    colour = colour + np.exp(near / 0.03) * [0.55, 0.30, 0.12] + np.exp(near / 0.16) * [0.22, 0.10, 0.045]
    colour[d[..., 2] < -0.02] = [0.10, 0.11, 0.14]
    return colour


def exr(image):
    """The bytes of an RGB OpenEXR file of half numbers, ZIP-compressed in blocks of 16 lines."""
    height, width, _ = image.shape

    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    channels = b"".join(c + b"\0" + struct.pack("<iBxxxii", 1, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = (struct.pack("<ii", 20000630, 2) + attribute("channels", "chlist", channels) +
            attribute("compression", "compression", b"\3") + attribute("dataWindow", "box2i", window) +
            attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0") +
            attribute("pixelAspectRatio", "float", struct.pack("<f", 1)) +
            attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)) +
            attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0")
    blocks = []
    for y in range(0, height, 16):
        rows = image[y:y + 16, :, ::-1].transpose(0, 2, 1).astype("<f2")  # line, channel, column
        raw = np.frombuffer(rows.tobytes(), np.uint8)
        halves = np.concatenate([raw[0::2], raw[1::2]]).astype(int)
        halves[1:] = (halves[1:] - halves[:-1] + 128) % 256
        packed = zlib.compress(halves.astype(np.uint8).tobytes(), 9)
        blocks.append(struct.pack("<ii", y, len(packed)) + packed)
    offsets, at = b"", len(head) + 8 * len(blocks)
    for block in blocks:
        offsets += struct.pack("<Q", at)
        at += len(block)
    return head + offsets + b"".join(blocks)


def mesh(xs, ys, heights, colour):
    n = len(xs)
    points = [f"{x:.3g} {y:.3g} {heights[j, i]:.3g}" for j, y in enumerate(ys) for i, x in enumerate(xs)]
    corners = (j * n + i for j in range(len(ys) - 1) for i in range(n - 1))
    faces = [f"{a} {a + 1} {a + n + 1} {a} {a + n + 1} {a + n}" for a in corners]
    return (f'Material "matte" "rgb Kd" [ {colour} ]\nShape "trianglemesh"\n"integer indices" [\n' + "\n".join(faces) +
            '\n]\n"point P" [\n' + "\n".join(points) + "\n]\n")


def mountains():
    xs, ys = np.linspace(-60, 60, 121), np.linspace(22, 60, 34)
    x, y = np.meshgrid(xs, ys)
    ridges, amplitude, frequency = 0.0, 1.0, 0.11
    for octave in range(6):
        ridges = ridges + amplitude * (1 - np.abs(noise(x * frequency + octave * 7.1, y * frequency, 40 + octave))) ** 2
        amplitude, frequency = amplitude * 0.48, frequency * 2.05
    heights = (ridges - 0.75) * 7 * np.clip((y - 22) / 26, 0, 1) ** 1.2 - 0.8
    return mesh(xs, ys, heights * (1 + 0.25 * np.sin(x * 0.05 + 1)), ".50 .55 .66")


def snow_height(x, y):
    """Flat where the cabin stands, falling away behind the wood."""
    far = np.hypot(x, y)
    height = 0.10 * noise(x * 0.55, y * 0.55, 3)
    height += 0.25 * noise(x * 0.17 + 3, y * 0.17, 4) * np.clip((far - 1.2) / 4, 0, 1)
    return height * np.clip((np.hypot(x + 0.1, y) - 0.9) / 1.2, 0, 1) - np.clip((y - 8) / 16, 0, 1) * 0.6


PINE = """ObjectBegin "pine"
  Material "matte" "rgb Kd" [ 0.05 0.075 0.06 ]
  AttributeBegin
    Translate 0 0 .16
    Shape "cone" "float radius" .30 "float height" .52
    Translate 0 0 .24
    Shape "cone" "float radius" .235 "float height" .46
    Translate 0 0 .23
    Shape "cone" "float radius" .16 "float height" .42
  AttributeEnd
  Material "matte" "rgb Kd" [ 0.08 0.05 0.035 ]
  Shape "cylinder" "float radius" .035 "float zmin" -.2 "float zmax" .2
ObjectEnd
"""
NEAR_PINES = [(1.25, .9, 1.2), (1.75, .4, .85), (1.05, 1.7, 1.35), (2.2, 1.5, 1.5), (2.7, .7, 1.0), (-1.35, .8, 1.1),
              (-1.9, 1.3, 1.4), (-1.0, 1.9, 1.2), (-2.5, .5, .8), (-2.35, 2.2, 1.5), (3.3, 2.1, 1.3), (-3.1, 1.6, 1.2),
              (.4, 2.6, 1.3), (-.3, 3.1, 1.5)]


def snowfield():
    def steps(*parts):
        return np.concatenate([np.linspace(*part)[1 if i else 0:] for i, part in enumerate(parts)])

    xs = steps((-30, -6, 13), (-6, 6, 41), (6, 30, 13))
    ys = steps((-9, 4, 44), (4, 24, 16))
    text = mesh(xs, ys, snow_height(*np.meshgrid(xs, ys)), ".72 .76 .84") + PINE
    rng = np.random.default_rng(4)
    wood = [(rng.uniform(-9, 9), rng.uniform(3, 14), rng.uniform(0.9, 1.7)) for _ in range(70)]
    for x, y, size in NEAR_PINES + wood:
        z = float(snow_height(np.array(x), np.array(y))) - 0.02
        text += (f"AttributeBegin Translate {x:.2f} {y:.2f} {z:.3f} Scale {size:.2f} {size:.2f} {size:.2f} "
                 'ObjectInstance "pine" AttributeEnd\n')
    return text


def main() -> None:
    (DATA / "evening-sky.exr").write_bytes(exr(sky()))
    for name, text in (("mountains", mountains()), ("snowfield", snowfield())):
        with (DATA / f"{name}.pbrt.gz").open("wb") as raw, gzip.GzipFile(
                fileobj=raw, mode="wb", mtime=0, filename="") as out:
            out.write(("# Made by scripts/make_winter.py.\n" + text).encode())
    for path in sorted(DATA.iterdir()):
        print(f"{path.name}: {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
