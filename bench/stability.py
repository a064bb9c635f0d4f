#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""What stiff and extreme media (scenes/extreme) do to estimators, samplers and integrators, and extreme lines to estimators of reciprocals: docs/stability.md.

  stability.py [--bin FOLDER] [--only TEXT] [--jobs N] [--csv FILE.csv] [--docs FILE.md] [--check FILE.csv]

Every image of these scenes has the same known value in all of its pixels. Verdicts:
  ok        the mean of the image is within 5 standard errors, and what single precision costs, of the value
  noisy     as ok, but the standard error is more than 5 % of what is asked for: little is said
  told      it is not, and the program says so: in a warning, or as samples that it dropped
  refused   an error says why this cannot be rendered
  biased    it is not, and the list of estimators says that this one is biased
  told, not tried   of reciprocals, by `medialab stress`: what their traits say cannot work, and what would take too many look-ups, known beforehand
  wrong, slow, broken    never: another value in silence, longer than the limit, a crash or something that is no number
Exits with 1 when a verdict is one of the last three or, with --check, another than in that file (ok or noisy is the same there).
"""
import argparse
import array
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes" / "extreme"
LIMIT = 120.0  # seconds of one render
FAULTS = ("wrong", "slow", "broken")
TABLES = {"estimators": "Estimators, by the shadow of a slab (`floor.pbrt`)", "free flights": "Free flights, in a white furnace (`furnace.pbrt`)",
          "reciprocals": "Reciprocals, on lines (`medialab stress --quantity reciprocal`)", "integrators": "Integrators", "boundary": "The camera on and across a boundary (`boundary.pbrt`)"}
INTEGRATORS = ("volpath", "bdpt", "mlt", "sppm")
MLT_SEEDS = 10  # what the mean of an image of chains is worth, other seeds tell and not its pixels
# What is not run, and why.
LONG = "paths have up to thousands of vertices, and all of one end are connected with all of the other"
DEPTH = "the number of scatterings is that of a chain, here at most 60"
LEFT_OUT = {("bdpt", "furnace 1e6"): LONG, ("bdpt", "furnace deep"): LONG,
            ("mlt", "furnace 100"): DEPTH, ("mlt", "furnace 1e6"): DEPTH, ("mlt", "furnace deep"): DEPTH}


# Lines for estimators of 1 / F, src/tools/medialab/stress_cases.cpp; alpha: the integral of the control.
RECIPROCAL_CASES = {"depth-F": "a sum of sines, F as the name says, the control its largest value", "control-is-F, control-near-F": "a constant, alpha / F 1 and 1 + 1e-9",
                    "control-k": "a sum of sines, F 1, the control k times its largest value: below 1 it is no bound",
                    "touches-0, hole-1e-3": "a cosine that is 0 somewhere; a density that is 0 in 1/1000 of the line",
                    "contrast-1e12, jump, spike-w, fractal": "densities that differ by 1e12, jump, hold half of F in the part w of the line, or are rough",
                    "tiny-, huge-density, length-, offset-": "other units, and a line that begins a million lengths away",
                    "depth-0, length-0, no-density": "F 0: infinite is right", "no-density-under-a-control": "F 0, which the control does not tell",
                    "blind-bound, blind-supervoxel": "a control of 0 over density, on all of the line or an eighth"}


# Positions of the unit box in the world: edge and corner.
def placed(size: float, x: float, y: float, z: float) -> dict:
    s, i = repr(size), repr(1 / size)
    return {"radius": repr(.05 * size), "place": f"[ {s} 0 0 0  0 {s} 0 0  0 0 {s} 0  {x!r} {y!r} {z!r} 1 ]",
            "camera": f"[ {i} 0 0 0  0 {i} 0 0  0 0 {i} 0  {-x / size!r} {-y / size!r} {-z / size!r} 1 ]"}


def h_function(albedo: float) -> float:
    """Chandrasekhar's H of isotropic scattering straight up, by its integral equation on 200 midpoints."""
    nodes = [((k + .5) / 200) ** 2 for k in range(200)]
    weights = [2 * (k + .5) / 200 / 200 for k in range(200)]
    values = [1.0] * len(nodes)

    def at(mu: float) -> float:
        total = sum(w * m * h / (mu + m) for m, w, h in zip(nodes, weights, values))
        return 1 / (math.sqrt(1 - albedo) + albedo / 2 * total)

    for _ in range(2000):
        new = [(h + at(m)) / 2 for m, h in zip(nodes, values)]
        change = max(abs(a - b) for a, b in zip(new, values))
        values = new
        if change < 1e-10:
            break
    return at(1.0)


def deep_value(albedo: float, depth: float) -> float:
    """A slab in uniform light from both sides, seen straight: what a half space absorbs, less what diffusion carries through."""
    length = 1 / math.sqrt(3 * (1 - albedo))
    return 1 - math.sqrt(1 - albedo) * h_function(albedo) * math.tanh((depth / 2 + .7104) / length)


def cases() -> dict:
    """name: scene, value, what it is, defines, parameters of the medium, what single precision and the closed form may cost"""
    thin, thick = 1e-8, 1e6
    grid_plane = {"window": "[ -1e-9 1e-9 -1e-9 1e-9 ]"}
    out = {}

    def add(name, scene, value, says, defines=None, medium="", slack=2e-6):
        out[name] = {"scene": scene, "value": value, "says": says, "defines": defines or {}, "medium": medium, "slack": slack}

    for scene, coefficient in (("floor", "sigma_a"), ("furnace", "sigma_s")):
        def value(depth):
            return math.exp(-depth) if scene == "floor" else 1.0
        add(f"{scene} 1e-8", scene, value(thin), "optical depth 1e-8", {coefficient: "1e-8"})
        add(f"{scene} 2", scene, value(2), "optical depth 2", {coefficient: "2"})
        add(f"{scene} 100", scene, value(100), "optical depth 100", {coefficient: "100", "spp": "4"})
        add(f"{scene} 1e6", scene, value(thick), "optical depth 1e6", {coefficient: "1e6", "spp": "1"})
        add(f"{scene} contrast", scene, value(2), "optical depth 2, neighbours in the grid differ by 1e12",
            {coefficient: "2", "low": "2e-12", "high": "2"})
        add(f"{scene} needle", scene, value(2), "optical depth 2 in 1/400 of the way", {coefficient: "2", "medium": "needle"})
        add(f"{scene} majorant", scene, value(2), "optical depth 2, the majorant 1000 times too low",
            {coefficient: "2"}, '"string bounds" "constant" "float majorant" .003')
        add(f"{scene} learned", scene, value(2), "optical depth 2, bounds learned from 1000 times too low",
            {coefficient: "2"}, '"string bounds" "progressive" "float initialextinction" .003', slack=1e-3)
        add(f"{scene} small", scene, value(2), "the scene scaled by 1e-6", {coefficient: "2e6"} | placed(1e-6, 0, 0, 0))
        add(f"{scene} large", scene, value(2), "the scene scaled by 1e6", {coefficient: "2e-6"} | placed(1e6, 0, 0, 0), slack=1e-5)
        # Heights are told to 2^-8 of the box there.
        add(f"{scene} far", scene, value(2), "the scene moved by 1e5 of its size", {coefficient: "2"} | placed(1, 1e5, 1e5, 1e5), slack=2e-3)
        add(f"{scene} planes", scene, value(2), "rays on planes between voxels and super-voxels", {coefficient: "2", "medium": "voxels"} | grid_plane)
    add("furnace deep", "furnace", deep_value(.99999, 1000), "optical depth 1000, albedo .99999",
        {"medium": "wide", "sigma_s": "999.99", "sigma_a": ".01", "spp": "4"} , slack=2e-5)
    return out


def frames() -> list:
    return [math.exp(-min(1.0, (120 - z) / 100)) for z in range(41)]


def read_pfm(path: pathlib.Path) -> list:
    with path.open("rb") as file:
        kind, size, scale = file.readline(), file.readline().split(), float(file.readline())
        numbers = array.array("f", file.read())
    if (scale < 0) != (sys.byteorder == "little"):
        numbers.byteswap()
    channels = 3 if kind.strip() == b"PF" else 1
    assert len(numbers) == int(size[0]) * int(size[1]) * channels
    return list(numbers[::channels])


def judged(pixels: list, value: float, slack: float) -> tuple:
    """Verdict, mean, standard error."""
    if not all(math.isfinite(v) for v in pixels):
        return "broken", math.nan, math.nan
    mean = math.fsum(pixels) / len(pixels)
    error = math.sqrt(math.fsum((v - mean) ** 2 for v in pixels) / (len(pixels) - 1) / len(pixels))
    if abs(mean - value) > 5 * error + slack:
        return "wrong", mean, error
    return ("noisy" if error > .05 * max(value, .02) else "ok"), mean, error


def first_message(text: str) -> str:
    for line in text.splitlines():
        for kind in ("error: ", "warning: "):
            if kind in line.lower():
                return line[line.lower().index(kind) + len(kind):]
    return ""


class Runner:
    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder
        self.estimators = json.loads(subprocess.run([folder / "medialab", "list", "estimators", "--format", "json"],
                                                    capture_output=True, check=True, text=True).stdout)["estimators"]

    def render(self, scene: str, defines: dict, medium: str, more: list, out: pathlib.Path) -> tuple:
        """Exit status (None: too long) and what was said."""
        command = [str(self.folder / "pbrt"), "--nthreads", "1", "--progress", "none", "--outfile", str(out), *more]
        for name, value in defines.items():
            if name == "radius" and defines.get("integrator") != "sppm":
                continue
            command += ["--define", f"{name}={value}"]
        if medium:
            command += ["--mediumparams", medium]
        try:
            done = subprocess.run([*command, str(SCENES / f"{scene}.pbrt")], capture_output=True, text=True, timeout=LIMIT, cwd=out.parent)
        except subprocess.TimeoutExpired:
            return None, ""
        return done.returncode, done.stderr

    def row(self, table: str, name: str, setting: str, bias: str, case: dict, defines: dict, medium: str) -> dict:
        with tempfile.TemporaryDirectory() as scratch:
            out = pathlib.Path(scratch) / "image.pfm"
            pixels, all_defines = [], case["defines"] | defines
            for seed in range(MLT_SEEDS if setting == "mlt" else 1):
                status, said = self.render(case["scene"], all_defines, (case["medium"] + " " + medium).strip(), ["--seed", str(seed)], out)
                if status != 0:
                    break
                pixels.append(read_pfm(out))
            mean = error = math.nan
            if status is None:
                verdict = "slow"
            elif status == 1:
                verdict = "refused"
            elif status != 0:
                verdict = "broken"
            else:
                independent = pixels[0] if len(pixels) == 1 else [math.fsum(p) / len(p) for p in pixels]
                verdict, mean, error = judged(independent, case["value"], case["slack"])
            told = first_message(said)
            if verdict == "wrong" and told:
                verdict = "told"
            elif verdict == "wrong" and bias != "unbiased":
                verdict = "biased"
            if verdict == "ok":
                told = ""
        return {"table": table, "setting": setting, "case": name, "verdict": verdict, "mean": mean, "standard_error": error,
                "value": case["value"], "message": told}

    def reciprocals(self, jobs: int) -> list:
        """Rows of the lab, whose verdicts are put into the words of this page."""
        done = subprocess.run([self.folder / "medialab", "stress", "--quantity", "reciprocal", "--no-seconds", "--quiet", "--format", "json", "--threads", str(jobs)],
                              capture_output=True, check=False, text=True)
        words = {"pass": "ok", "undecided": "noisy", "expected": "told", "skipped": "not tried", "fail": "wrong"}
        rows = []
        for r in json.loads(done.stdout)["rows"]:
            # What is no finite number is null there.
            mean, value = (math.inf if r[c] is None else r[c] for c in ("mean", "exact"))
            verdict, reason = words[r["verdict"]], re.sub(r"; noticed \d+ times|; trials ended at .*", "", r["reason"])
            if verdict == "ok" and r["unbiased"] == "not claimed":
                verdict = "biased" if abs(mean - value) > 1e-9 * value else "ok"
            rows.append({"table": "reciprocals", "setting": r["estimator"], "case": r["case"], "verdict": verdict, "mean": mean, "standard_error": math.nan,
                         "value": value, "message": "" if verdict in ("ok", "biased", "noisy") else reason})
        return rows

    def boundary(self, setting: str, defines: dict) -> dict:
        with tempfile.TemporaryDirectory() as scratch:
            status, said = self.render("boundary", defines, "", ["--frames", "0:40"], pathlib.Path(scratch) / "b-####.pfm")
            worst, verdict = 0.0, "ok" if status == 0 else "broken"
            for frame, value in enumerate(frames()):
                if status != 0:
                    break
                got, mean, _ = judged(read_pfm(pathlib.Path(scratch) / f"b-{frame:04}.pfm"), value, 2e-6)
                worst = max(worst, abs(mean - value))
                if got in FAULTS:
                    verdict = got
                    print(f"boundary, {setting}, frame {frame}: {mean} for {value}", file=sys.stderr)
        return {"table": "boundary", "setting": setting, "case": "41 steps", "verdict": verdict, "mean": worst, "standard_error": 0.0, "value": 0.0,
                "message": first_message(said)}

    def work(self) -> list:
        """What is to be run, as (label, function)."""
        out = []
        every = cases()
        for e in self.estimators:
            if "exponential" not in e["laws"]:
                continue
            for name, case in every.items():
                if case["scene"] == "floor":
                    out.append(("estimators", e["name"], name, e["bias"], case, {}, f'"string transmittance" "{e["name"]}"'))
        flights = {name: f'"string freeflight" "{name}"' for name in ("weighted-delta", "delta", "decomposition", "debiased-ray-marching", "ray-marching", "regular")}
        for model in ("adaptive", "terminating", "nonterminating"):
            flights[f"single-particle, {model}"] = f'"string freeflight" "single-particle" "string model" "{model}"'
        for flight, parameters in flights.items():
            for name, case in every.items():
                if case["scene"] == "furnace":
                    out.append(("free flights", flight, name, "biased" if flight == "ray-marching" else "unbiased", case, {}, parameters))
        for integrator in INTEGRATORS:
            for name, case in every.items():
                if (integrator, name) in LEFT_OUT:
                    continue
                out.append(("integrators", integrator, name, "consistent" if integrator == "sppm" else "unbiased", case, {"integrator": integrator}, ""))
        return out


COLUMNS = ("table", "setting", "case", "verdict", "mean", "standard_error", "value", "message")


def write_csv(path: pathlib.Path, rows: list) -> None:
    with path.open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(COLUMNS)
        for r in rows:
            out.writerow([f"{r[c]:.6g}" if isinstance(r[c], float) else r[c] for c in COLUMNS])


def read_csv(path: pathlib.Path) -> list:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def shown(row: dict, notes: list) -> str:
    text = row["verdict"]
    if text == "ok":
        return text
    if row["table"] == "reciprocals":
        text += f" {float(row['mean']) / float(row['value']) - 1:.2g}" if text == "biased" else ""
    elif text not in ("refused",) and row["table"] != "boundary":
        text += f" {float(row['mean']):.3g}"
    message = re.sub(r"^\d+ (density|boundary)", r"\1", row["message"])  # how many is of no interest here
    if message:
        if message not in notes:
            notes.append(message)
        text += f" [{notes.index(message) + 1}]"
    return text


def docs_of(rows: list) -> str:
    """docs/stability.md."""
    every, notes = cases(), []
    out = ["# Stiff and extreme media", "",
           "This page is generated: `bench/stability.py --csv docs/stability.csv --docs docs/stability.md`. Every image of the scenes in `scenes/extreme` has the same",
           "known value in all of its pixels; `./check` renders them all again and compares the verdicts.", "",
           "| verdict | the mean of the image |", "| --- | --- |",
           "| ok | is within 5 standard errors, and what single precision costs, of the value |",
           "| noisy | as ok, but its standard error is more than 5 % of what is asked for: little is said |",
           "| told | is not, and the program says so in a warning |",
           "| biased | is not, and the method is listed as biased or consistent |",
           "| refused | there is none: an error says why |", "",
           "None is wrong in silence, takes longer than its limit or is no number. Numbers are means of images that are not ok; those in brackets are messages, below.", "",
           "Estimators of reciprocals are tried on lines instead, by the same command; there *told* is what their traits (`medialab list reciprocals`) say beforehand,",
           "*not tried* what would take more than 1e8 look-ups an estimate, and the number beside *biased* is the relative error of the mean.", "",
           "Why some cannot work: a majorant that is too low leaves estimators of any control unbiased, but their variance grows like",
           "exp(optical depth^2 / that of the majorant), so that a few samples say nothing, which is told; those that need a bounding one are cut. Weights of flights by",
           "`debiased-ray-marching` have either sign: after many scatterings few paths bring all, and means of few samples are too low, which is told. `regular` goes",
           "from voxel to voxel, and procedural densities and given or learned bounds have none. Photons are blurred by their kernel: `sppm` is consistent, and",
           "what is thinner than the radius, or denser than its inverse, takes more iterations than these. Chains of `mlt` have so many scatterings and no more.", ""]
    for table, title in TABLES.items():
        these = [r for r in rows if r["table"] == table]
        if not these:
            continue
        settings, names = list(dict.fromkeys(r["setting"] for r in these)), list(dict.fromkeys(r["case"] for r in these))
        cells = {(r["setting"], r["case"]): shown(r, notes) for r in these}
        out += [f"## {title}", ""]
        if table in ("integrators", "reciprocals"):  # the many rows down, the few settings across
            out += ["| case | " + " | ".join(settings) + " |", "| --- |" + " --- |" * len(settings)]
            out += [f"| {n} | " + " | ".join(cells.get((s, n), "not run") for s in settings) + " |" for n in names]
        else:
            out += ["| | " + " | ".join(n.removeprefix("floor ").removeprefix("furnace ") for n in names) + " |", "| --- |" + " --- |" * len(names)]
            out += [f"| {s} | " + " | ".join(cells[s, n] for n in names) + " |" for s in settings]
        out.append("")
    out += ["## The cases", "", "| case | what | value |", "| --- | --- | --- |"]
    out += [f"| {n} | {c['says']} | {c['value']:.6g} |" for n, c in every.items()]
    out += [f"| {n} | {says} | 1 / F |" for n, says in RECIPROCAL_CASES.items()]
    out += ["| boundary 41 steps | a camera that goes through the face of a box of optical depth 1, exactly on it at step 20 | exp(-optical depth above it) |", "",
            "## Messages", ""]
    out += [f"{k}. {m}" for k, m in enumerate(notes, 1)]
    out += ["", "## Not run", ""]
    out += [f"- `{s}`, {n}: {why}" for (s, n), why in LEFT_OUT.items()]
    return "\n".join(out) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "release" / "bin")
    parser.add_argument("--only", default="", help="only what has this in 'table/setting/case'")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--docs", type=pathlib.Path)
    parser.add_argument("--check", type=pathlib.Path)
    o = parser.parse_args()
    runner = Runner(o.bin.resolve())
    with concurrent.futures.ThreadPoolExecutor(o.jobs) as pool:
        waiting = [pool.submit(runner.row, w[0], w[2], w[1], *w[3:]) for w in runner.work() if o.only in f"{w[0]}/{w[1]}/{w[2]}"]
        for integrator in INTEGRATORS:
            for medium, level in (("layers", {"low": "1", "high": "1"}), ("constant", {})):
                if o.only in f"boundary/{integrator}, {medium}/41 steps":
                    waiting.append(pool.submit(runner.boundary, f"{integrator}, {medium}", {"integrator": integrator, "medium": medium} | level))
        rows = [w.result() for w in waiting]
    if not o.only or "reciprocal" in o.only:
        rows += [r for r in runner.reciprocals(o.jobs) if o.only in f"{r['table']}/{r['setting']}/{r['case']}"]
    known = {(r["table"], r["setting"], r["case"]): r["verdict"] for r in read_csv(o.check)} if o.check else {}
    bad = 0
    for r in rows:
        was = known.get((r["table"], r["setting"], r["case"]), "nothing") if o.check else r["verdict"]
        is_bad = r["verdict"] in FAULTS or (r["verdict"] != was and {r["verdict"], was} != {"ok", "noisy"})
        bad += is_bad
        if is_bad or (r["verdict"] != "ok" and not o.check):
            print(f"{r['table']}/{r['setting']}/{r['case']}: {r['verdict']}" + (f" (before: {was})" if was != r["verdict"] else "") +
                  f": {r['mean']:.6g} +- {r['standard_error']:.2g} for {r['value']:.6g}  {r['message'][:100]}")
    if o.csv:
        write_csv(o.csv, rows)
    if o.docs:
        o.docs.write_text(docs_of(read_csv(o.csv) if o.csv else rows))
    print(f"{len(rows)} renders of {SCENES.relative_to(ROOT)} and lines, {bad} not as they should be")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
