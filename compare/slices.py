# SPDX-License-Identifier: BSD-2-Clause
"""The folder of finished slices. A slice is one run of a renderer with a seed of its own: an image and what it cost.

The record is written after the image and in one step, so that a slice is there as a whole or not at all, whenever the
program is killed. Its name has all that decides about its pixels: scene, files, program and setting (Renderer.key), samples and seed.
"""
import dataclasses
import fcntl
import json
import os
from dataclasses import dataclass
from pathlib import Path

from .problems import CaseError
from .programs import Cost, Renderer


@dataclass(frozen=True)
class Slice:
    seed: int
    spp: int                  # samples a pixel that were asked for
    cost: Cost
    image: Path
    fresh: bool = False       # rendered now, not found


class SliceStore:
    """One process works in a folder at a time. Throws CaseError when another one does."""

    def __init__(self, folder: Path):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        self.lock = (folder / "lock").open("w")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            self.lock.close()
            raise CaseError(f"{folder}: another pbrt-compare is at work here") from error
        for part in folder.glob("part-*"):  # of a run that was killed
            part.unlink()

    def close(self) -> None:
        """Lets others work in the folder; so does the end of the process."""
        self.lock.close()

    def image_path(self, renderer: Renderer, seed: int, spp: int) -> Path:
        return self.folder / f"{renderer.key}-{spp}-{seed}.{renderer.setting.image}"

    def find(self, renderer: Renderer, seed: int, spp: int) -> Slice | None:
        image = self.image_path(renderer, seed, spp)
        record = image.with_suffix(".json")
        if not (record.is_file() and image.is_file()):
            return None
        return Slice(seed, spp, Cost(**json.loads(record.read_text())["cost"]), image)

    def get(self, renderer: Renderer, seed: int, spp: int) -> Slice:
        """The slice, rendered if it is not there yet. Throws RenderFailure."""
        found = self.find(renderer, seed, spp)
        if found:
            return found
        image = self.image_path(renderer, seed, spp)
        part = image.with_stem(f"part-{image.stem}")
        try:
            cost, statistics = renderer.run(seed, spp, part)
            os.replace(part, image)
        finally:
            part.unlink(missing_ok=True)
            part.with_name(part.name + ".stats.json").unlink(missing_ok=True)
        record = {"scene": str(renderer.scene.file), "setting": renderer.setting.name, "seed": seed, "spp": spp,
                  "command": renderer.shell(seed, spp, image.name), "cost": dataclasses.asdict(cost), "statistics": statistics}
        written = part.with_suffix(".record")
        written.write_text(json.dumps(record, indent=1) + "\n")
        os.replace(written, image.with_suffix(".json"))
        return Slice(seed, spp, cost, image, fresh=True)
