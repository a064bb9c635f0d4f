# SPDX-License-Identifier: BSD-2-Clause
"""What a script is given: programs, and where to leave tables, plots and verdicts."""
import csv
import json
import shutil
from pathlib import Path
from typing import Any, TypeVar

from compare.lab_plot import lab_figure

from . import plotting, printed, verdicts
from .catalogue import Entry
from .intervals import Interval
from .programs import FigureError, Image, Programs, Row

T = TypeVar("T")


class Run:
    """One figure being made. All files are in `folder`; result.json is written last, so that it is there when all is."""

    def __init__(self, entry: Entry, programs: Programs, folder: Path, quick: bool):
        self.entry, self.programs, self.folder, self.quick = entry, programs, folder, quick
        self.verdicts: list[verdicts.Verdict] = []
        self.mismatches: list[str] = []
        self.compared = 0
        folder.mkdir(parents=True, exist_ok=True)

    def pick(self, full: T, quick: T) -> T:
        return quick if self.quick else full

    # Programs

    def lab(self, command: str, files: list[Path] | None = None, **options: Any) -> list[Row]:
        """Rows of `medialab command`; an option `lower_depth=1` is --lower-depth 1, a list has commas between, True is a flag."""
        words = [command]
        for name, value in options.items():
            if value is None or value is False:
                continue
            words.append("--" + name.replace("_", "-"))
            if value is not True:
                words.append(",".join(f"{v}" for v in value) if isinstance(value, (list, tuple)) else str(value))
        return self.programs.lab(words, files or [])

    def render(self, scene: str, spp: int, seed: int = 1, define: dict[str, Any] | None = None, options: list[str] | None = None,
               files: list[str] | None = None, reference: tuple[int, dict[str, Any]] | None = None) -> Image:
        """A template of this folder with values for its variables; names that begin with -- are options. With `reference`, (samples per pixel, its own values), that image is rendered
        first, with another seed, and the result has the curve of the error against it."""
        path = self.entry.script.parent / scene
        read = [path.parent / f for f in files or []]

        def words(samples: int, number: int, values: dict[str, Any]) -> list[str]:
            defines = [word for name, value in values.items() for word in ((name, str(value)) if name.startswith("--") else ("--define", f"{name}={value}"))]
            return ["--spp", str(samples), "--seed", str(number), "--progress", "none", *defines, *(options or [])]

        if reference is None:
            return self.programs.render(path, words(spp, seed, define or {}), read)
        truth = words(reference[0], 977, reference[1])
        self.programs.render(path, truth, read)
        return self.programs.render(path, words(spp, seed, define or {}), read, self.programs.image_file(path, truth, read))

    def text_file(self, name: str, text: str) -> Path:
        """A file for a program to read, kept beside the results."""
        path = self.folder / name
        path.write_text(text)
        return path

    # Results

    def table(self, rows: list[dict[str, Any]], name: str = "data") -> None:
        with (self.folder / f"{name}.csv").open("w", newline="") as file:
            writer = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)), restval="")
            writer.writeheader()
            writer.writerows(rows)

    def plot(self, plot: plotting.Plot) -> None:
        plotting.save(plot, self.folder / self.entry.name)

    def time_plot(self, plot: plotting.Plot) -> None:
        """The twin of a figure: error against run time."""
        plotting.save(plot, self.folder / f"{self.entry.name}-time")

    def time_twin(self, estimators: list[str], doublings: int | None = None, trials: int | None = None, **options: Any) -> list[Row]:
        """The twin of a figure about lines: the error of means of 1, 2, 4, ... estimates against the seconds that they took."""
        rows = self.lab("converge", estimator=estimators, doublings=doublings or self.pick(12, 8), trials=trials or self.pick(256, 64), **options)
        for row in rows:
            row["extinction"] = Path(str(row["extinction"])).stem  # of a table: not where it lies
        self.table(rows, "time")
        self.time_plot(lab_figure([{k: str(v) for k, v in row.items()} for row in rows], "seconds"))
        return rows

    def render_twin(self, curves: dict[str, list[Row]]) -> None:
        """The twin of a figure of renders: RMSE against seconds, from `pbrt --convergence`."""
        self.table([{"setting": name, **row} for name, rows in curves.items() for row in rows], "time")
        plot, (axes,) = plotting.panels(1, 1, (7.2, 3.2))
        for index, (name, rows) in enumerate(curves.items()):
            found = [r for r in rows if float(r["seconds"]) > 0 and float(r["rmse"]) > 0]
            plotting.curve(axes, [float(r["cpu_seconds"]) for r in found], [float(r["rmse"]) for r in found], index, name)
        plotting.log_axes(axes)
        axes.set_xlabel("CPU seconds of rendering")
        axes.set_ylabel("RMSE")
        axes.legend(fontsize=7, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.02))
        self.time_plot(plot)

    def claim(self, claim: str, number: Interval, *, above: float = float("-inf"), below: float = float("inf"), unit: str = "", why: str = "") -> None:
        """See `verdicts.judge`."""
        self.verdicts.append(verdicts.judge(claim, number, above=above, below=below, unit=unit, why=why))

    def untested(self, claim: str, why: str) -> None:
        self.verdicts.append(verdicts.Verdict(claim, "no number", verdicts.UNTESTED, why))

    def expect(self, what: str, number: str, value: float, error: float = 0.0, printed_error: float = 0.0) -> None:
        """`value` is to agree with a number known from elsewhere: a regression test, whatever the paper claims."""
        self.compared += 1
        far = printed.disagreement(number, value, error, printed_error)
        if not far <= 1:
            self.mismatches.append(f"{what}: {value:.6g}, standard error {error:.2g}, expected {number}: {far:.2g} times what is allowed")

    def unbiased(self, rows: list[Row], bias: float = 0.0) -> None:
        """Means of the lab agree with the exact values within five standard errors, and `bias` as a share of these; efficiencies mean nothing else."""
        for row in rows:
            self.compared += 1
            off, error = float(row["mean"]) - float(row["exact"]), float(row["mean_stderr"])
            if not abs(off) <= 5 * error + bias * abs(float(row["exact"])):
                self.mismatches.append(f"{row['estimator']} on {row['extinction']}, depth {row['depth']}, control {row['control']}: mean off by {off:.3g}, "
                                       f"standard error {error:.2g}")

    def finish(self) -> None:
        missing = [suffix for suffix in ("", "-time") if not (self.folder / f"{self.entry.name}{suffix}.png").is_file()]
        if missing or not self.verdicts or not (self.folder / "data.csv").is_file():
            raise FigureError(f"{self.entry.script.name} left no table, no verdict, no plot or no plot over time")
        result = {"name": self.entry.name, "quick": self.quick, "compared": self.compared, "mismatches": self.mismatches,
                  "verdicts": [vars(v) for v in self.verdicts]}
        part = self.folder / "result.part"
        part.write_text(json.dumps(result, indent=1) + "\n")
        part.replace(self.folder / "result.json")

    def start(self) -> None:
        """Takes away what an earlier run left; what programs found is kept elsewhere."""
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
