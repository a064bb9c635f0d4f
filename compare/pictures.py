# SPDX-License-Identifier: BSD-2-Clause
"""Images as numpy arrays of shape (height, width, 3), linear Rec. 709, row 0 on top."""
import json
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from .problems import CaseError


def read_pfm(path: Path) -> np.ndarray:
    """A PFM file as float32; one channel is repeated. Throws CaseError for anything else."""
    data = path.read_bytes()
    words = data.split(maxsplit=4)
    if len(words) < 4 or words[0] not in (b"PF", b"Pf"):
        raise CaseError(f"{path}: no PFM file")
    # One single whitespace character ends the header.
    header = data[:len(data) - len(data.split(b"\n", 3)[3])] if data.count(b"\n", 0, 200) >= 3 else b""
    width, height, scale = int(words[1]), int(words[2]), float(words[3])
    channels = 3 if words[0] == b"PF" else 1
    values = np.frombuffer(data, "<f4" if scale < 0 else ">f4", offset=len(header))
    if not header or values.size != width * height * channels:
        raise CaseError(f"{path}: {values.size} values for {width} x {height} pixels of {channels} channels")
    image = values.reshape(height, width, channels)[::-1].astype(np.float32)
    return np.repeat(image, 3, axis=2) if channels == 1 else image


def write_pfm(path: Path, image: np.ndarray) -> None:
    height, width = image.shape[:2]
    path.write_bytes(f"PF\n{width} {height}\n-1.0\n".encode() + np.ascontiguousarray(image[::-1], "<f4").tobytes())


class ImageTool:
    """The program imgtool, for what is no PFM."""

    def __init__(self, bin_folder: Path):
        self.program = bin_folder / "imgtool"

    def run(self, *words: str | Path) -> str:
        try:
            done = subprocess.run([self.program, *words], capture_output=True, text=True, check=False)
        except OSError as error:
            raise CaseError(f"{self.program}: {error.strerror}; build it: ninja -C build/release imgtool") from error
        if done.returncode != 0 and not done.stdout:
            raise CaseError(done.stderr.strip())
        return done.stdout

    def read(self, path: Path) -> np.ndarray:
        if path.suffix == ".pfm":
            return read_pfm(path)
        with tempfile.TemporaryDirectory() as folder:
            converted = Path(folder) / "image.pfm"
            self.run("convert", path, converted)
            return read_pfm(converted)

    def info(self, path: Path) -> dict:
        """What the header says: dataWindow, displayWindow, metadata and more."""
        return json.loads(self.run("info", "--json", path))[0]

    def flip(self, image: np.ndarray, reference: np.ndarray) -> tuple[float, np.ndarray]:
        """The mean LDR-FLIP error of values clamped to [0, 1], and its map."""
        with tempfile.TemporaryDirectory() as folder:
            a, b, out = (Path(folder) / name for name in ("a.pfm", "b.pfm", "map.pfm"))
            write_pfm(a, image)
            write_pfm(b, reference)
            found = json.loads(self.run("diff", a, b, "--flip", "--json", "--flip-map", out))
            return found["flip"], read_pfm(out)[:, :, 0]


def weighted_mean(images: Iterable[np.ndarray], weights: Iterable[float]) -> np.ndarray:
    """The mean of renders of one scene, as float64, each by its weight: its samples a pixel."""
    total, sum_ = 0.0, None
    for image, weight in zip(images, weights, strict=True):
        sum_ = weight * image.astype(np.float64) if sum_ is None else sum_ + weight * image
        total += weight
    if sum_ is None or total <= 0:
        raise ValueError("a mean of nothing")
    return sum_ / total
