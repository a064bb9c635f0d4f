#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""What weights that know the transmittance save: docs/mis-transmittance.md.

  mis_transmittance.py [--bin FOLDER] [--only TEXT] [--renders N] [--quick] [--csv FILE.csv] [--docs FILE.md]

Renders scenes of scenes/weights with each value of "mistransmittance", many times with different seeds, on one thread. Variance is that between
the renders, per pixel, mean over the image; times the density look-ups of a render, and times its processor seconds, it is what a render of given noise
costs. Ratios to "none" come with intervals of two standard errors, by leaving out one render of each in turn. Variance and look-ups depend on the seeds
alone; seconds on the machine. Exits with 1 when an image of "bounds" or "independent" is not that of "none" (5 standard errors).
"""
import argparse
import array
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes" / "weights"
MODES = ("none", "bounds", "independent", "joint")
# name: what it is, file, variables
CASES = {
    "window, thin": ("a matte floor lit by a window through dark smoke of optical depth 0.5 or so", "smoke", {"depth": "1"}),
    "window": ("the same, depth 2", "smoke", {"depth": "4"}),
    "window, dense": ("the same, depth 4", "smoke", {"depth": "8"}),
    "window, white": ("the same, depth 4, smoke that absorbs nothing", "smoke", {"depth": "8", "sigma_a": "0", "sigma_s": "1"}),
    "window, broken": ("dark smoke with holes, through which most of the light comes", "smoke", {"depth": "16", "threshold": ".35"}),
    "sky": ("the floor under an evening sky, depth 4", "smoke", {"light": "sky", "depth": "8"}),
    "mirrored lamp": ("a metal floor that mirrors a small lamp, depth 4", "smoke", {"light": "lamp", "floor": "metal", "depth": "8"}),
    "window, ratio": ("the window, depth 4, by ratio tracking, which does not tell its noise", "smoke", {"depth": "8", "estimator": "ratio"}),
    "window, marched": ("the window, depth 4, by unbiased ray marching, which does not either", "smoke",
                        {"depth": "8", "estimator": "unbiased-ray-marching"}),
    "fog": ("a small lamp seen through fog that scatters forward", "fog", {}),
    "fog, even": ("the same, scattered evenly: g 0", "fog", {"g": "0"}),
    "fog, window": ("a window seen through that fog", "fog", {"light": "window"}),
}
COLUMNS = ("case", "weights", "mean", "mean_error", "relative_variance", "lookups", "seconds", "variance_lookups", "variance_lookups_error",
           "variance_seconds", "variance_seconds_error")


def read_pfm(path: pathlib.Path) -> list:
    with path.open("rb") as file:
        file.readline()
        size, scale = file.readline().split(), float(file.readline())
        numbers = array.array("f", file.read())
    if (scale < 0) != (sys.byteorder == "little"):
        numbers.byteswap()
    assert len(numbers) == int(size[0]) * int(size[1]) * 3
    return list(numbers[::3])


def render(pbrt: pathlib.Path, folder: pathlib.Path, scene: str, variables: dict, mode: str, seed: int, spp: int) -> tuple:
    """Pixels, look-ups, processor seconds of rendering."""
    image, stats = folder / "image.pfm", folder / "stats.json"
    command = [str(pbrt), "--quiet", "--strict", "--nthreads", "1", "--spp", str(spp), "--seed", str(seed), "--outfile", str(image),
               "--stats", str(stats), "--define", f"mistransmittance={mode}"]
    for name, value in variables.items():
        command += ["--define", f"{name}={value}"]
    done = subprocess.run([*command, str(SCENES / f"{scene}.pbrt")], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"error: {' '.join(command)}: status {done.returncode}\n{done.stderr}")
    told = json.loads(stats.read_text())["renders"][0]
    return read_pfm(image), told["counters"]["densityLookups"], told["seconds"]["render"]["cpu"]


def variance_of(images: list) -> float:
    """Between renders, mean over the pixels."""
    n = len(images)
    total = 0.0
    for pixel in zip(*images):
        mean = math.fsum(pixel) / n
        total += math.fsum((v - mean) ** 2 for v in pixel)
    return total / (n - 1) / len(images[0])


def measured(runs: list) -> dict:
    images, lookups, seconds = zip(*runs)
    means = [math.fsum(image) / len(image) for image in images]
    n, mean = len(runs), math.fsum(means) / len(runs)
    error = math.sqrt(math.fsum((m - mean) ** 2 for m in means) / (n - 1) / n)
    return {"mean": mean, "mean_error": error, "variance": variance_of(images), "lookups": sum(lookups) / n, "seconds": sum(seconds) / n}


def ratios(runs: list, base: list) -> dict:
    """Of variance times look-ups and times seconds, with standard errors by the jackknife over renders."""
    def of(a: dict, b: dict) -> tuple:
        return tuple(math.log(a["variance"] * a[cost] / (b["variance"] * b[cost])) for cost in ("lookups", "seconds"))

    whole = of(measured(runs), measured(base))
    spread = [0.0, 0.0]
    for which in (runs, base):
        n = len(which)
        left = [of(*(measured(r[:i] + r[i + 1:]) if r is which else measured(r) for r in (runs, base))) for i in range(n)]
        for k in range(2):
            mean = math.fsum(x[k] for x in left) / n
            spread[k] += (n - 1) / n * math.fsum((x[k] - mean) ** 2 for x in left)
    out = {}
    for k, cost in enumerate(("lookups", "seconds")):
        out[f"variance_{cost}"] = math.exp(whole[k])
        out[f"variance_{cost}_error"] = math.exp(whole[k]) * math.sqrt(spread[k])
    return out


def measure(o: argparse.Namespace) -> list:
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for case, (_, scene, variables) in CASES.items():
            if o.only and o.only not in case:
                continue
            runs = {mode: [] for mode in MODES}
            for i in range(o.renders):
                for m in range(len(MODES)):  # in turn, so that a slow minute slows all
                    mode = MODES[(i + m) % len(MODES)]
                    runs[mode].append(render(o.bin / "pbrt", folder, scene, variables, mode, 1000 * MODES.index(mode) + i, o.spp))
            for mode in MODES:
                m = measured(runs[mode])
                m["relative_variance"] = m["variance"] / m["mean"] ** 2
                if mode == "none":
                    m |= {"variance_lookups": 1.0, "variance_lookups_error": 0.0, "variance_seconds": 1.0, "variance_seconds_error": 0.0}
                else:
                    m |= ratios(runs[mode], runs["none"])
                rows.append({"case": case, "weights": mode} | {c: f"{m[c]:.5g}" for c in COLUMNS[2:]})
                print(*rows[-1].values(), file=sys.stderr, flush=True)
    return rows


def z_of(row: dict, base: dict) -> float:
    """Distance of two means in standard errors."""
    error = math.hypot(float(row["mean_error"]), float(base["mean_error"]))
    return (float(row["mean"]) - float(base["mean"])) / error if error > 0 else 0.0


def ratio_text(row: dict, cost: str) -> str:
    ratio, error = float(row[f"variance_{cost}"]), float(row[f"variance_{cost}_error"])
    return "1" if row["weights"] == "none" else f"{ratio:.2f} ± {2 * error:.2f}"


def verdict(rows: list, cost: str, says) -> list:
    """Names of the cases where `says(low, high)` of one of the weights."""
    def holds(row: dict) -> bool:
        ratio, error = float(row[f"variance_{cost}"]), 2 * float(row[f"variance_{cost}_error"])
        return row["weights"] != "none" and says(ratio - error, ratio + error)
    return [f"{row['case']} ({row['weights']})" for row in rows if holds(row)]


def listed(names: list) -> str:
    return "; ".join(names) if names else "none"


DERIVATION = """# Weights that know the transmittance

This page is made by `bench/mis_transmittance.py --csv docs/mis-transmittance.csv --docs docs/mis-transmittance.md`.

`"string mistransmittance"` of `volpath` says what the weights between light samples and the directions that BSDFs and phase functions choose know of the
media on the way to the light. `none`, the default, is PBRT-v3's: the power heuristic of the densities of the direction alone.

## What is to be shared

A vertex sees a light in a direction that a light sample chooses with density p and scattering with density s, through media of transmittance T. A light sample
finds f L T̂ / p, T̂ an estimate of T. A scattered direction finds f L / s if the path's free flight passes, with probability T, else nothing. Weights w and 1 - w of the
two keep the sum right, and the sum of second moments w² E[T̂²] / p + (1 - w)² T / s is least for

    w = p / (p + q s),    q = E[T̂²] / T = T + Var[T̂] / T,

the balance heuristic with second moments (Grittmann et al. 2019). q is T where T̂ is exact: a flight that passes with probability 0.01 is worth a hundredth of its
density. It is 1 where T̂ is as noisy as a flight, and then directions alone say enough. `none` takes it for 1 always, which trusts flights through dense media too much.
The others use the power heuristic of p and q s, as `none` does with q = 1: its weights are less than a factor of two from the best ones, and better where one of the densities alone fits.

At the last vertex (`maxdepth`) what a scattered direction sees is dimmed by an estimate, as light samples are, and no flight is played: q is 1 there whatever T is, and the
weights are those of `none`. So they are for media that emit, whose light is found by distances, and for lights that no direction finds.

## What is known

`two-comb-umvu` looks at two independent combs, which give two depths X and Y. Its answer is the real part of the complex number
z = exp(-(X + Y)/2) (cos d + i sin d), d = (Y - X)/2 (Peters 2025). If depths are normal, with any variance, E[Re z] = T, E[(Re z)² - (Im z)²] = E[Re z²] = T², and E[(Im z)²] is
the variance of Re z. So each estimate brings unbiased second moments at no look-up more. What lies behind one another multiplies as complex numbers do, moments and
all. Media of one density everywhere are exact (Im z = 0); other estimators do not tell their noise, and Im z = 0 stands for that too. From one estimate, q is taken to be |z|² / |Re z|,
at most 1.

## Three forms

A weight that depends on the estimate it multiplies is correlated with it: what light samples find has the mean E[w(z) Re z], scattered directions T E[1 - w(z)], and the sum of these is
T + Cov[w(z), Re z]. Noise that lowers T̂ raises w, so images get too dark.

- `bounds`, without bias: q = exp(-D), D the optical depth that the super-voxels' means, or bounds where there are none, give of the way. It is not random, so the weights add up to one. No look-ups.
- `independent`, without bias of its own: two estimates a and b of the media for a light sample, which finds ½ (w(a) Re b + w(b) Re a); a third one, c, for a scattered direction that
  has come through to a light, which is multiplied by 1 - w(c). a, b and c are independent and have one distribution, and c knows nothing of the path's flights. So the sum has the mean
  E[w] E[Re z] + T (1 - E[w]), which is T where the estimator is unbiased, whatever w is. It costs one more estimate a light sample, and one where a path finds a light.
- `joint`, biased: one estimate for a light sample, for both. For a function F that is analytic, Re F(z) has the mean F(T) as far as depths are normal (the jackknife: the second order of the
  bias vanishes for every distribution). Light samples find Re F(z), F(z) = z p² / (p² + s² z²); scattered directions are multiplied by Re G(z), G(z) = s² z² / (p² + s² z²). With q = T, their sum has
  the mean F(T) + T G(T) = T. Not a look-up more for light samples. With estimators that do not tell their noise F is that of the noisy estimate, and the bias is the covariance above.

The tests hold all forms to this: exactly for estimates of a few values and for normal depths, and statistically for real estimators, with the correlated form as the control that must fail.
"""


def write_docs(path: pathlib.Path, rows: list, o: argparse.Namespace) -> None:
    if not rows:
        path.write_text(DERIVATION + "\n## What it saves\n\nThis table has not been made yet.\n")
        return
    lines = [DERIVATION, "## What it saves", ""]
    lines += [f"`smoke.pbrt` and `fog.pbrt` of `scenes/weights`, 24 x 16 pixels of {o.spp} samples, {o.renders} renders of each, one thread. Variance between renders, relative to the squared "
              "mean of the image; variance times look-ups, and times processor seconds, relative to `none` (below 1: cheaper for the same noise), ± two standard errors. "
              "Last: how far the mean of the image is from that of `none`, in standard errors, and what these are of it.", "",
              "| case | weights | relative variance | look-ups | variance x look-ups | variance x seconds | mean |", "| --- | --- | --- | --- | --- | --- | --- |"]
    base = {}
    for row in rows:
        if row["weights"] == "none":
            base = row
        apart = "" if row is base else (f"{z_of(row, base):+.1f} of "
                                        f"{math.hypot(float(row['mean_error']), float(base['mean_error'])) / float(base['mean']):.1%}")
        lines.append(f"| {row['case'] if row is base else ''} | `{row['weights']}` | {float(row['relative_variance']):.3g} | {float(row['lookups']):.3g} | "
                     f"{ratio_text(row, 'lookups')} | {ratio_text(row, 'seconds')} | {apart} |")
    lines += ["", "Cases:", ""] + [f"- {case}: {says}." for case, (says, *_) in CASES.items()]
    better = [r for r in rows if r["weights"] != "none"]
    lines += ["", "Beyond two standard errors:", "",
              f"- cheaper in look-ups: {listed(verdict(better, 'lookups', lambda low, high: high < 1))}.",
              f"- dearer in look-ups: {listed(verdict(better, 'lookups', lambda low, high: low > 1))}.",
              f"- cheaper in seconds: {listed(verdict(better, 'seconds', lambda low, high: high < 1))}.",
              f"- dearer in seconds: {listed(verdict(better, 'seconds', lambda low, high: low > 1))}."]
    path.write_text("\n".join(lines) + "\n")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "release" / "bin")
    parser.add_argument("--only", help="cases whose names hold this")
    parser.add_argument("--renders", type=int, default=12)
    parser.add_argument("--spp", type=int, default=8)
    parser.add_argument("--quick", action="store_true", help="few small renders, to see that everything works")
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--docs", type=pathlib.Path)
    parser.add_argument("--from-csv", type=pathlib.Path, help="measured before; renders nothing; without the file the page has the derivation alone")
    o = parser.parse_args()
    if o.quick:
        o.renders, o.spp = 4, 2
    if o.from_csv:
        rows = list(csv.DictReader(o.from_csv.open())) if o.from_csv.exists() else []
    else:
        rows = measure(o)
    if o.csv:
        with o.csv.open("w", newline="") as file:
            table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            table.writeheader()
            table.writerows(rows)
    if o.docs:
        write_docs(o.docs, rows, o)
    base, wrong = {}, []
    for row in rows:
        if row["weights"] == "none":
            base = row
        elif row["weights"] != "joint" and abs(z_of(row, base)) >= 5:
            wrong.append(f"{row['case']}, {row['weights']}: {z_of(row, base):+.1f} standard errors")
    for line in wrong:
        print(f"error: another image: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
