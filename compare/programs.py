# SPDX-License-Identifier: BSD-2-Clause
"""Programs that render: our pbrt, another build of it, or anything that a command template starts."""
import hashlib
import json
import os
import resource
import shlex
import shutil
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

from .case import Case, SceneCase, Setting
from .problems import CaseError
from .scene_text import encode, read_text, rewrite, scene_hash


class RenderFailure(Exception):
    """A program that ended with an error or left no image; the text is what it said."""


@dataclass(frozen=True)
class Cost:
    """What a run spent on rendering; of programs that say nothing, the whole process. Look-ups are None where unknown."""
    wall: float               # seconds
    cpu: float                # seconds of all threads
    construct: float          # seconds of wall time before the first sample; 0 where unknown
    lookups: int | None
    rays: int | None
    samples: int              # camera samples a pixel, as the program rounded them

    def of(self, equal: str, clock: str) -> float:
        """In the unit of a budget."""
        if equal == "samples":
            return float(self.samples)
        if equal == "seconds":
            seconds = self.cpu if clock == "cpu" else self.wall
            if seconds <= 0:
                raise RenderFailure("too quick to be measured; compare at equal samples")
            return seconds
        if not self.lookups:
            raise RenderFailure("no density look-ups are counted here, so that none can be equal; compare at equal seconds or samples")
        return float(self.lookups)


def read_cost(statistics: dict, wall: float, cpu: float, spp: int) -> Cost:
    """The numbers of pbrt --stats, or what was measured from outside when there are none."""
    if not statistics:
        return Cost(wall, cpu, 0, None, None, spp)
    render = statistics["renders"][0]
    seconds, counters = render["seconds"], render["counters"]
    return Cost(seconds["render"]["wall"], seconds["render"]["cpu"], seconds["parse"]["wall"] + seconds["construct"]["wall"],
                counters["densityLookups"], counters["rays"] + counters["shadowRays"], render["samplesPerPixel"])


def processor_seconds() -> float:
    """Of all programs that were run so far and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def file_hash(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def found_program(name: str) -> Path:
    found = shutil.which(name)
    if not found:
        raise CaseError(f'no program "{name}"')
    return Path(found).resolve()


class Renderer:
    """One setting on one scene. Each run is one image of its own seed.

    A scene that was rewritten comes on standard input, and the program runs in the scene's folder, so that names of files stay right."""

    def __init__(self, case: Case, scene: SceneCase, setting: Setting, bin_folder: Path, work: Path):
        self.case, self.scene, self.setting, self.work = case, scene, setting, work
        self.folder = scene.file.parent
        self.lines = (*scene.rewrite, *setting.rewrite)
        self.text = rewrite(read_text(scene.file), list(self.lines), self.folder)
        if self.lines and "{scene}" in setting.command:
            raise CaseError(f'setting "{setting.name}": a rewritten scene comes on standard input: leave {{scene}} out of the command')
        self.program = found_program(shlex.split(setting.command)[0] if setting.command else setting.program or str(bin_folder / "pbrt"))
        self.scene_hash = scene_hash(self.text, self.folder)
        identity = [self.scene_hash, file_hash(self.program), setting.medium, setting.command, str(case.threads), *case.options, *scene.options, *setting.options]
        self.key = hashlib.sha256("\0".join(identity).encode("utf-8", "surrogateescape")).hexdigest()[:16]

    def scene_file(self, seed: int, spp: int) -> Path:
        """The file of the scene; a rewritten one is kept beside the slices. Rewritings may have {seed} and {spp}."""
        if not self.lines:
            return self.scene.file
        varies = any(word in line for line in self.lines for word in ("{seed}", "{spp}"))
        path = self.work / (f"{self.scene.name}-{self.key}" + (f"-{spp}-{seed}" if varies else "") + ".pbrt")
        if not path.is_file():
            part = path.with_name(f"part-{path.name}")
            part.write_bytes(encode(self.text.replace("{seed}", str(seed)).replace("{spp}", str(spp))))
            part.replace(path)
        return path

    def command(self, seed: int, spp: int, outfile: str, extra: tuple[str, ...] = ()) -> list[str]:
        """The words of the command line."""
        if self.setting.command:
            values = {"scene": self.scene.file, "seed": seed, "spp": spp, "outfile": outfile, "threads": self.case.threads or os.cpu_count()}
            try:
                return [word.format(**values) for word in shlex.split(self.setting.command)]
            except (KeyError, IndexError, ValueError) as error:
                raise CaseError(f'setting "{self.setting.name}": command: {error}; known: ' + ", ".join(f"{{{v}}}" for v in values)) from error
        words = [str(self.program), "-" if self.lines else self.scene.file.name, "--seed", str(seed), "--spp", str(spp), "--outfile", outfile,
                 "--pixeltype", "float", "--quiet", "--progress", "none"]
        if self.case.threads:
            words += ["--nthreads", str(self.case.threads)]
        if self.setting.medium:
            words += ["--mediumparams", self.setting.medium]
        return [*words, *self.case.options, *self.scene.options, *self.setting.options, *extra]

    def shell(self, seed: int, spp: int, outfile: str, extra: tuple[str, ...] = ()) -> str:
        """The same as a line that anybody can run again."""
        stdin = f" < {shlex.quote(str(self.scene_file(seed, spp)))}" if self.lines else ""
        return f"cd {shlex.quote(str(self.folder))} && {shlex.join(self.command(seed, spp, outfile, extra))}{stdin}"

    def run(self, seed: int, spp: int, outfile: Path) -> tuple[Cost, dict]:
        """Renders to `outfile`; the cost, and all statistics that the program gives. Throws RenderFailure."""
        statistics = outfile.with_name(outfile.name + ".stats.json")
        words = self.command(seed, spp, str(outfile), () if self.setting.command else ("--stats", str(statistics)))
        before = processor_seconds()
        begin = time.monotonic()
        with self.scene_file(seed, spp).open("rb") as scene:
            done = subprocess.run(words, cwd=self.folder, stdin=scene if self.lines else subprocess.DEVNULL, capture_output=True, check=False)
        wall, cpu = time.monotonic() - begin, processor_seconds() - before
        if done.returncode != 0 or not outfile.is_file():
            said = done.stderr.decode("utf-8", "replace").strip() or f"exit status {done.returncode}, no image, no word"
            raise RenderFailure(f"{shlex.join(words)}\n{said}")
        numbers = json.loads(statistics.read_text()) if statistics.is_file() else {}
        if numbers and len(numbers["renders"]) != 1:
            raise RenderFailure(f"the scene has {len(numbers['renders'])} worlds, and one image would take the place of the other")
        if numbers and numbers["renders"][0]["interrupted"]:
            raise RenderFailure(f"{shlex.join(words)}\nwas stopped by somebody")
        statistics.unlink(missing_ok=True)
        return read_cost(numbers, wall, cpu, spp), numbers
