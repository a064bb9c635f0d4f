#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Makes scenes/data/fire-density.pbrt.gz: flames of our own, as a heterogeneous medium with a temperature for each sample.

Three tongues lean and thin out as they rise, eaten at by ridges of value noise that are drawn upward; the hottest gas
is inside. Densities are rounded to two decimals, temperatures to 10 K. Needs numpy. Deterministic: one seed.
"""
import gzip
import pathlib

import numpy as np

from make_cloud import value_noise

NX, NY, NZ = 40, 40, 64
P0, P1 = (-0.5, -0.5, 0.0), (0.5, 0.5, 1.6)
TONGUES = [(0.0, 0.0, 1.35, 0.30, 0.06), (-0.16, 0.06, 0.95, 0.20, -0.12), (0.17, -0.07, 0.8, 0.18, 0.16)]


def points():
    axes = [np.linspace(a, b, n, endpoint=False) + (b - a) / (2 * n) for a, b, n in zip(P0, P1, (NX, NY, NZ))]
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")  # x fastest
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)


def flames(p):
    """How deep inside a flame each point is: 0 at the border, 1 at most."""
    drawn = p * np.array([1.0, 1.0, 0.45])
    turbulence = sum(0.5**i * value_noise(drawn + 3.1 * i, 20 + i, 4.5 * 2**i) for i in range(3))
    sway = 0.10 * value_noise(drawn * [0, 0, 1.6] + 5.2, 31, 3.0)
    depth = np.full(len(p), -1.0)
    for x0, y0, height, width, lean in TONGUES:
        h = np.clip(p[:, 2] / height, 0, 1.5)
        radius = width * np.sqrt(np.clip(h + 0.05, 0, None)) * np.clip(1 - h, 0, None) ** 0.75 * 1.6 + 1e-3
        r = np.hypot(p[:, 0] - x0 - lean * h - sway * h, p[:, 1] - y0 - 0.5 * lean * h)
        depth = np.maximum(depth, 1 - r / radius + 0.55 * turbulence * (0.3 + h))
    return np.clip(depth, 0, 1) * np.clip(p[:, 2] / 0.06, 0, 1)


def numbers(values, form):
    return "\n".join(" ".join(form(v) for v in row) for row in values.reshape(-1, NX))


def main() -> None:
    depth = flames(points())
    soot = np.round(np.clip(2.2 * depth, 0, 1), 2)
    kelvin = np.where(soot > 0, np.round((1000 + 1150 * depth**0.7) / 10) * 10, 0)
    text = "\n".join([
        "# Made by scripts/make_fire.py.",
        'MakeNamedMedium "fire" "string type" "heterogeneous"',
        f'  "integer nx" {NX} "integer ny" {NY} "integer nz" {NZ}',
        f'  "point p0" [ {P0[0]} {P0[1]} {P0[2]} ] "point p1" [ {P1[0]} {P1[1]} {P1[2]} ]',
        '  "rgb sigma_a" [ 4 4 4 ] "rgb sigma_s" [ .6 .6 .6 ] "float Lescale" 110',
        '  "float density" [', numbers(soot, lambda v: f"{v:g}"), "]",
        '  "float temperature" [', numbers(kelvin, lambda v: f"{v:g}"), "]", ""])
    out = pathlib.Path(__file__).resolve().parent.parent / "scenes" / "data" / "fire-density.pbrt.gz"
    with out.open("wb") as raw, gzip.GzipFile(fileobj=raw, mode="wb", mtime=0, filename="") as file:
        file.write(text.encode())
    print(f"{out}: {out.stat().st_size} bytes, {np.mean(soot > 0):.3f} of the samples burn")


if __name__ == "__main__":
    main()
