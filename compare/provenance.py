# SPDX-License-Identifier: BSD-2-Clause
"""Where numbers come from: enough to run everything again."""
import datetime
import os
import platform
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np

from .analysis import SceneResult
from .pictures import ImageTool
from .programs import file_hash
from .schedule import Entry


def processor() -> str:
    """What the system calls its processor."""
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or "unknown"


def version_of(program: Path) -> str:
    """The first line of --version; "" for a program that has none."""
    try:
        done = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=10, check=False, stdin=subprocess.DEVNULL)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.strip().splitlines()[0] if done.returncode == 0 and done.stdout.strip() else ""


def machine(command: list[str]) -> dict:
    return {"command": " ".join(command), "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
            "processor": processor(), "processors": os.cpu_count(), "system": platform.platform(), "load": list(os.getloadavg()),
            "python": f"{sys.version.split()[0]}, numpy {np.__version__}, matplotlib {matplotlib.__version__}"}


def entry_provenance(entry: Entry, tool: ImageTool) -> dict:
    """Program, scene and seeds of a setting, and the line that renders its first slice again."""
    slices = entry.slices()
    out = {"setting": entry.setting.name, "program": str(entry.renderer.program), "programHash": file_hash(entry.renderer.program),
           "version": version_of(entry.renderer.program), "key": entry.renderer.key, "filesHash": entry.renderer.scene_hash,
           "samplesPerSlice": entry.spp, "seeds": [[s.seed for s in run.slices] for run in entry.runs],
           "seedsAlone": [[s.seed for s in run.ladder] for run in entry.runs],
           "again": entry.renderer.shell(slices[0].seed if slices else entry.renderer.case.seed, entry.spp, "again.exr")}
    if slices and slices[0].image.suffix == ".exr":
        header = tool.info(slices[0].image)["metadata"]
        out.update({k: header[k] for k in ("sceneHash", "sceneText") if k in header})
    return out


def scene_provenance(result: SceneResult, entries: list[Entry], tool: ImageTool) -> list[dict]:
    return [entry_provenance(e, tool) for e in entries if e.setting.name not in result.failures]
