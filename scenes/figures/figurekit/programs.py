# SPDX-License-Identifier: BSD-2-Clause
"""Runs `medialab` and `pbrt`, and keeps what they found under a name made of all that decides about it."""
import csv
import hashlib
import io
import json
import os
import shlex
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from compare.pictures import read_pfm
from compare.programs import file_hash

Row = dict[str, float | str]


class FigureError(Exception):
    """A program that failed, or an unknown name: the message says all."""


def parse_rows(text: str) -> list[Row]:
    """A CSV table with remarks; what reads as a number becomes one."""
    return [{key: number_or_word(value) for key, value in row.items()}
            for row in csv.DictReader(io.StringIO("".join(line + "\n" for line in text.splitlines() if not line.startswith("#"))))]


def number_or_word(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


@dataclass(frozen=True)
class Image:
    """A render: its pixels, what it cost, and how its error fell where that was asked for."""
    pixels: np.ndarray
    seconds: float
    processor_seconds: float
    lookups: float
    statistics: dict
    curve: list[Row]


class Programs:
    """`tell` gets a line before a program starts, nothing when its result is kept."""

    def __init__(self, bin_folder: Path, cache: Path, tell: Callable[[str], None]):
        self.bin, self.cache, self.tell = bin_folder, cache, tell
        self.hashes: dict[str, str] = {}
        self.used: set[str] = set()
        cache.mkdir(parents=True, exist_ok=True)

    def key(self, program: str, words: list[str], files: list[Path]) -> str:
        if program not in self.hashes:
            path = self.bin / program
            if not path.is_file():
                raise FigureError(f"no {path}; build it: ninja -C build/release {program}")
            self.hashes[program] = file_hash(path)
        parts = [self.hashes[program], *words, *(file_hash(p) for p in files)]
        key = hashlib.sha256("\0".join(parts).encode()).hexdigest()[:20]
        self.used.add(key)
        return key

    def forget_others(self) -> None:
        """Takes away what is kept under names that nobody has asked for: of other programs, scenes and options."""
        for path in self.cache.iterdir():
            if path.stem not in self.used:
                path.unlink()

    def run(self, program: str, words: list[str], folder: Path) -> str:
        """Standard output. Throws FigureError."""
        self.tell(shlex.join([program, *words])[:150])
        done = subprocess.run([self.bin / program, *words], cwd=folder, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            raise FigureError(f"{shlex.join([program, *words])}\n{done.stderr.strip() or f'exit status {done.returncode}'}")
        return done.stdout

    def lab(self, words: list[str], files: list[Path] = []) -> list[Row]:
        """Rows of a table of `medialab`; `files` are the tables that `words` name, for the name of what is kept."""
        kept = self.cache / f"{self.key('medialab', words, files)}.csv"
        if not kept.is_file():
            # A program that is killed leaves no table that looks whole.
            part = kept.with_name(f"part-{os.getpid()}.csv")
            part.write_text(self.run("medialab", [*words, "--format", "csv", "--quiet"], self.cache))
            part.replace(kept)
        return parse_rows(kept.read_text())

    def render(self, scene: Path, words: list[str], files: list[Path] = [], convergence: Path | None = None) -> Image:
        """An image of `pbrt`; `files` are those that the scene reads, `convergence` is a reference (.pfm) to measure the error against."""
        key = self.key("pbrt", [*words, str(convergence and file_hash(convergence))], [scene, *files])
        image, record, curve = (self.cache / f"{key}.{suffix}" for suffix in ("pfm", "json", "csv"))
        if not record.is_file():
            more = ["--convergence", str(curve), "--reference", str(convergence)] if convergence else []
            part = record.with_suffix(".part")
            self.run("pbrt", [str(scene), "--outfile", str(image), "--stats", str(part), "--quiet", *words, *more], scene.parent)
            part.replace(record)
        statistics = json.loads(record.read_text())
        render = statistics["renders"][0]
        seconds = render["seconds"]["render"]
        return Image(read_pfm(image), seconds["wall"], seconds["cpu"], render["counters"]["densityLookups"], statistics,
                     parse_rows(curve.read_text()) if convergence else [])

    def image_file(self, scene: Path, words: list[str], files: list[Path] = []) -> Path:
        """Where `render` keeps the pixels of such an image, as .pfm."""
        return self.cache / f"{self.key('pbrt', [*words, 'None'], [scene, *files])}.pfm"
