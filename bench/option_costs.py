#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""What options of pbrt that only watch a render cost: processor time with them, relative to the same render without.

  option_costs.py PBRT [--scene FILE] [--spp N] [--rounds N] [--before PBRT] [-o FILE.csv]

Each round runs every setting once, in another order, on one thread; a setting's ratio is to the plain run of its round, so that what slows the
machine down for a minute slows both. Median over the rounds with the interval of 95 % that order statistics give. "plain, again" is the control:
what it differs from 1 by is noise. --before: a program built from an earlier commit, to see what is paid by renders that ask for nothing.
"""
import argparse
import csv
import os
import pathlib
import random
import socket
import statistics
import subprocess
import sys
import tempfile
import threading

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Viewer:
    """Takes what --display-server sends and throws it away."""

    def __init__(self) -> None:
        self.socket = socket.create_server(("127.0.0.1", 0))
        self.port = self.socket.getsockname()[1]
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self) -> None:
        while True:
            peer = self.socket.accept()[0]
            threading.Thread(target=self.drain, args=(peer,), daemon=True).start()

    @staticmethod
    def drain(peer: socket.socket) -> None:
        with peer:
            while peer.recv(1 << 20):
                pass


def settings_of(folder: pathlib.Path, port: int) -> dict[str, list[str]]:
    return {
        "plain, again": [],
        "--convergence (halves)": ["--convergence", str(folder / "halves.csv")],
        "--convergence --reference": ["--convergence", str(folder / "reference.csv"), "--reference", str(folder / "reference.exr")],
        "--checkpoint (10 s)": ["--checkpoint", str(folder / "checkpoint")],
        "--layers depth,normal,albedo": ["--layers", "depth,normal,albedo"],
        "--layers all": ["--layers", "all"],
        "--display-server": ["--display-server", f"127.0.0.1:{port}"],
        "--serve": ["--serve"],
    }


def seconds_of(command: list[str]) -> float:
    """Processor seconds of the whole program."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"error: {' '.join(command)}: status {process.returncode}\n{said.decode(errors='replace')}")
    return usage.ru_utime + usage.ru_stime


def interval(ratios: list[float]) -> tuple[float, float]:
    """Of the median, from order statistics: covers it with 95 % or more, or is all of the sample."""
    ordered, n = sorted(ratios), len(ratios)
    outside, k, term = 0.0, 0, 0.5 ** n
    while outside + 2 * term <= 0.05 and 2 * k < n - 1:
        outside += 2 * term
        k += 1
        term *= (n - k + 1) / k
    k = max(k - 1, 0)
    return ordered[k], ordered[n - 1 - k]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pbrt")
    parser.add_argument("--scene", default=str(ROOT / "scenes" / "cloud.pbrt"))
    parser.add_argument("--spp", type=int, default=8)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--before", help="pbrt of an earlier commit")
    parser.add_argument("-o", "--outfile")
    o = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def command(program: str, options: list[str], seed: int) -> list[str]:
            return [program, "--quiet", "--nthreads", "1", "--spp", str(o.spp), "--seed", str(seed), "--outfile", str(folder / "image.exr"),
                    *options, o.scene]

        seconds_of([o.pbrt, "--quiet", "--spp", str(o.spp), "--seed", "1000", "--outfile", str(folder / "reference.exr"), o.scene])
        runs = {"plain": (o.pbrt, []), **{name: (o.pbrt, words) for name, words in settings_of(folder, Viewer().port).items()}}
        if o.before:
            version = subprocess.run([o.before, "--version"], capture_output=True, text=True, check=True).stdout
            runs["commit " + version.split("commit ")[1].split(",")[0]] = (o.before, [])
        ratios: dict[str, list[float]] = {name: [] for name in runs}
        order = random.Random(1)
        for round_number in range(o.rounds):
            turn = list(runs)
            order.shuffle(turn)
            seconds = {}
            for name in turn:
                (folder / "checkpoint").unlink(missing_ok=True)  # pbrt writes over none
                seconds[name] = seconds_of(command(*runs[name], round_number))
            for name in runs:
                ratios[name].append(seconds[name] / seconds["plain"])
            print(f"round {round_number + 1} of {o.rounds}: plain {seconds['plain']:.2f} s", file=sys.stderr, flush=True)
    out = open(o.outfile, "w", newline="") if o.outfile else sys.stdout
    table = csv.writer(out, lineterminator="\n")
    table.writerow(["option", "ratio", "low", "high"])
    for name, values in ratios.items():
        if name != "plain":
            table.writerow([name, *(f"{x:.4f}" for x in (statistics.median(values), *interval(values)))])
    return 0


if __name__ == "__main__":
    sys.exit(main())
