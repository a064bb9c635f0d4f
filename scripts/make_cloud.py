#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Makes scenes/data/cloud-density.pbrt.gz: a cumulus of our own, as a PBRT-v3 heterogeneous medium.

Balls of decreasing size grow on each other's tops; their union is a smooth distance field whose border is eroded by
fractal value noise. Values are rounded to two decimals. Needs numpy. Deterministic: one seed.
"""
import gzip
import pathlib

import numpy as np

NX, NY, NZ = 128, 88, 100
P0, P1 = (-1.25, -0.85, 0.0), (1.25, 0.85, 1.9)
SEED = 11


def value_noise(points, rng_seed, frequency):
    """Smoothly interpolated random lattice values in [-1, 1] at points (n, 3)."""
    lattice = np.random.default_rng(rng_seed).uniform(-1, 1, (32, 32, 32))
    x = points * frequency
    cell = np.floor(x).astype(int)
    f = x - cell
    f = f * f * (3 - 2 * f)
    out = np.zeros(len(points))
    for corner in range(8):
        offset = np.array([(corner >> i) & 1 for i in range(3)])
        weight = np.prod(np.where(offset == 1, f, 1 - f), axis=1)
        i = (cell + offset) % 32
        out += weight * lattice[i[:, 0], i[:, 1], i[:, 2]]
    return out


def balls(rng):
    """Centre and radius of every ball: a flat base row and a tower, then three generations on their upper surfaces."""
    out = [((-0.74, 0.0, 0.34), 0.30), ((-0.34, 0.04, 0.48), 0.40), ((0.12, -0.02, 0.66), 0.50),
           ((0.22, 0.04, 1.06), 0.40), ((0.52, 0.0, 0.44), 0.38), ((0.86, 0.02, 0.33), 0.26)]
    parents = list(out)
    for radius_scale, children in ((0.55, 9), (0.50, 7), (0.5, 5)):
        born = []
        for (cx, cy, cz), r in parents:
            for _ in range(children):
                azimuth, z = rng.uniform(0, 2 * np.pi), rng.uniform(-0.1, 1)
                s = np.sqrt(1 - z * z)
                direction = np.array([s * np.cos(azimuth), s * np.sin(azimuth), z])
                centre = np.array([cx, cy, cz]) + direction * r * rng.uniform(0.7, 0.95)
                born.append((tuple(centre), r * radius_scale * rng.uniform(0.7, 1.1)))
        out += born
        parents = born
    return out


def main():
    rng = np.random.default_rng(SEED)
    axes = [np.linspace(a, b, n, endpoint=False) + (b - a) / (2 * n) for a, b, n in zip(P0, P1, (NX, NY, NZ))]
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)

    distance = np.full(len(points), np.inf)
    for centre, radius in balls(rng):
        distance = np.minimum(distance, np.linalg.norm(points - np.array(centre), axis=1) - radius)
    noise = sum(0.5**i * value_noise(points + 7.3 * i, SEED + i, 3.1 * 2.03**i) for i in range(5))
    depth = -distance + 0.05 * noise - 0.01
    base = np.clip((points[:, 2] - 0.22 - 0.03 * noise) / 0.07, 0, 1)
    density = np.clip(depth / 0.05, 0, 1) * base
    border = np.ones(len(points))
    for axis in range(3):
        inside = np.minimum(points[:, axis] - P0[axis], P1[axis] - points[:, axis])
        border *= np.clip(inside / 0.06, 0, 1)
    density = np.round(density * border, 2)

    lines = [
        "# Density of the example cloud; made by scripts/make_cloud.py.",
        'MakeNamedMedium "cloud" "string type" "heterogeneous"',
        f'  "integer nx" {NX} "integer ny" {NY} "integer nz" {NZ}',
        f'  "point p0" [ {P0[0]} {P0[1]} {P0[2]} ] "point p1" [ {P1[0]} {P1[1]} {P1[2]} ]',
        '  "rgb sigma_a" [ 0.02 0.02 0.02 ] "rgb sigma_s" [ 14.98 14.98 14.98 ] "float g" 0.4',
        '  "float density" [',
    ]
    rows = density.reshape(NZ * NY, NX)
    lines += [" ".join(f"{v:g}" for v in row) for row in rows]
    lines.append("]\n")
    target = pathlib.Path(__file__).parent.parent / "scenes" / "data" / "cloud-density.pbrt.gz"
    with open(target, "wb") as raw, gzip.GzipFile(fileobj=raw, mode="wb", mtime=0, filename="") as out:
        out.write("\n".join(lines).encode())
    print(f"{target.name}: {target.stat().st_size} bytes, {np.mean(density > 0):.3f} of the voxels filled")


if __name__ == "__main__":
    main()
