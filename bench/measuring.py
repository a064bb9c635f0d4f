# SPDX-License-Identifier: BSD-2-Clause
"""What programs cost, for the scripts beside."""
import os
import pathlib
import subprocess
import tempfile
import time
from dataclasses import dataclass


STEP = 0.002  # seconds between two looks at a program


@dataclass(frozen=True)
class Cost:
    seconds: float    # of the processor, all threads, user and system
    elapsed: float    # seconds on the wall, good to STEP
    megabytes: float  # resident at most


def peak_of(process: int) -> float:
    """Megabytes so far, 0 when it has ended. The kernel's account of ended programs would begin with what this script has."""
    try:
        status = pathlib.Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    except OSError:
        return 0
    return next((int(line.split()[1]) / 1024 for line in status.splitlines() if line.startswith("VmHWM:")), 0)


def run(words: list[str], folder: pathlib.Path | None = None) -> Cost:
    """Runs a program to its end in the folder. Throws subprocess.CalledProcessError with what it said when it fails."""
    with tempfile.TemporaryFile() as said:
        before, peak, ended = time.perf_counter(), 0.0, 0
        program = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=said)
        while ended == 0:
            time.sleep(STEP)
            peak = max(peak, peak_of(program.pid))
            ended, status, used = os.wait4(program.pid, os.WNOHANG)
        elapsed = time.perf_counter() - before
        program.returncode = os.waitstatus_to_exitcode(status)
        if program.returncode != 0:
            said.seek(0)
            raise subprocess.CalledProcessError(program.returncode, words, stderr=said.read().decode(errors="replace"))
    return Cost(used.ru_utime + used.ru_stime, elapsed, peak)
