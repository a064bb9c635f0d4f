# SPDX-License-Identifier: BSD-2-Clause
"""What the slices of a scene say: curves of error against cost, slopes, work, bias, maps and worst pixels."""
import math
from dataclasses import dataclass, field

import numpy as np

from . import bias
from .case import Case
from .intervals import Estimate, Work, log_ratio, mean_estimate, student_quantile, tied_with_best
from .maps import Maps, WorstPixel, make_maps, worst_pixels
from .metrics import METRICS, Reference, errors
from .pictures import ImageTool, weighted_mean
from .problems import CaseError
from .schedule import Entry, Run
from .slices import Slice
from .slope import slope_estimate

AXES = ("cpu", "wall", "lookups", "samples")
"""What an error can be drawn over: seconds of all threads, of the clock on the wall, density look-ups, samples a pixel."""
HEAVY_TAIL = 0.5
"""From this share of one pair of slices in all variance on, the variance is a matter of luck."""
MOST_BIAS_Z = 5.0
"""A bias is told from chance when it is so many standard errors (as all statistical tests of this project)."""


def cost_on(axis: str, slices: list[Slice]) -> float | None:
    """The sum of slices; None where a program does not tell."""
    values = [getattr(s.cost, axis) for s in slices]
    return None if any(v is None for v in values) else float(sum(values))


@dataclass
class CurvePoint:
    """The error after so much work, a mean over repeats. `single`: one render of fewer samples than a slice."""
    single: bool
    slices: int
    costs: dict[str, float | None]
    errors: dict[str, Estimate]
    by_repeat: list[tuple[dict[str, float | None], dict[str, float]]]


@dataclass
class BiasFound:
    signed: Estimate
    squared: Estimate
    flat_at: float | None     # budget units after which the curve is flat: noise is as large as bias

    def seen(self) -> bool:
        return abs(self.signed.z()) > MOST_BIAS_Z or self.squared.z() > MOST_BIAS_Z


@dataclass
class SettingResult:
    name: str
    entry: Entry
    curve: list[CurvePoint] = field(default_factory=list)
    slope: Estimate | None = None               # of mse over the budget's unit, all points
    slope_single: Estimate | None = None        # of renders in one piece only
    works: dict[str, Work] = field(default_factory=dict)
    ratios: dict[str, Estimate] = field(default_factory=dict)    # log(work / best work)
    """To the best of those without bias; `tied` has no biased ones, if others are there."""
    tied: dict[str, bool] = field(default_factory=dict)
    bias: BiasFound | None = None
    flip: float | None = None
    picture: np.ndarray | None = None           # of the first repeat: one budget
    maps: Maps | None = None
    worst: list[WorstPixel] = field(default_factory=list)

    def biased(self) -> bool:
        return self.bias is not None and self.bias.seen()

    def ratio(self, axis: str) -> tuple[float, float, float] | None:
        """Work relative to the best setting's, and the ends of its 95 % interval; all 1 for the best itself. None: not known."""
        ratio = self.ratios.get(axis)
        if ratio is None or not math.isfinite(ratio.value):
            return None
        width = 0.0 if ratio.error == 0 else min(700.0, student_quantile(ratio.freedom) * ratio.error)
        return math.exp(ratio.value), math.exp(ratio.value - width), math.exp(ratio.value + width)

    def total(self, axis: str) -> float | None:
        return cost_on(axis, self.entry.slices())


@dataclass
class SceneResult:
    name: str
    reference: Reference
    reference_source: str
    results: list[SettingResult]
    failures: dict[str, str]
    window: tuple[int, int, int, int] = (0, 0, 1, 1)  # left, top corner in the whole image, and the size of that
    reference_tail: float = 0                         # share of the noisiest pair of its slices in all its variance

    def reference_warning(self) -> str:
        """What makes the reference a bad one; "" if nothing does."""
        if self.reference.variance is None:
            return ""
        if self.reference_tail > HEAVY_TAIL:
            return (f"The reference has a heavy tail: one pair of its slices has {100 * self.reference_tail:.0f} % of its variance. "
                    "Nothing here is to be trusted: let another setting make it.")
        if self.reference.noise() > 0.1 * min((r.curve[-1].errors["mse"].value for r in self.results), default=math.inf):
            return "The noise of the reference is more than a tenth of the smallest error: a longer one would tell more."
        return ""

    def axis_known(self, axis: str) -> bool:
        """Whether any setting can be drawn over the axis."""
        return any((p.costs[axis] or 0) > 0 for r in self.results for p in r.curve)


def group_sizes(count: int) -> list[int]:
    """1, 2, 4, ... and `count`."""
    sizes = [1 << i for i in range(count.bit_length()) if 1 << i <= count]
    return sizes if sizes[-1] == count else [*sizes, count]


def run_point(slices: list[Slice], images: list[np.ndarray], size: int, reference: Reference) -> tuple[dict[str, float | None], dict[str, float]]:
    """Mean cost and mean errors of disjoint groups of `size` slices of one repeat."""
    groups = [range(i, i + size) for i in range(0, len(slices) - size + 1, size)]
    found = [errors(weighted_mean([images[i] for i in g], [slices[i].cost.samples for i in g]), reference) for g in groups]
    used = [s for g in groups for s in (slices[i] for i in g)]
    costs = {axis: None if (c := cost_on(axis, used)) is None else c / len(groups) for axis in AXES}
    return costs, {m: float(np.mean([f[m] for f in found])) for m in METRICS}


def join_repeats(single: bool, size: int, points: list[tuple[dict[str, float | None], dict[str, float]]]) -> CurvePoint:
    costs = {axis: None if any(c[axis] is None for c, _ in points) else float(np.mean([c[axis] for c, _ in points])) for axis in AXES}
    return CurvePoint(single, size, costs, {m: mean_estimate([e[m] for _, e in points]) for m in METRICS}, points)


class SceneAnalysis:
    """Reads the images of a scene and judges them."""

    def __init__(self, case: Case, name: str, tool: ImageTool, references: list[np.ndarray], source: str):
        self.case, self.name, self.tool = case, name, tool
        self.references = references
        mean = np.mean(np.array(references, np.float64), axis=0)
        count = len(references)
        variance = np.var(np.array(references, np.float64), axis=0, ddof=1) / count if count > 1 else None
        self.reference = Reference(mean, variance, case.epsilon)
        self.source = source

    def read(self, slice_: Slice, name: str) -> np.ndarray:
        image = self.tool.read(slice_.image)
        if image.shape != self.reference.image.shape:
            raise CaseError(f"{name}: an image of {image.shape[1]} x {image.shape[0]} pixels; the reference ({self.source}) has "
                            f"{self.reference.image.shape[1]} x {self.reference.image.shape[0]}")
        broken = int((~np.isfinite(image)).any(axis=2).sum())
        if broken:
            raise CaseError(f"{name}, seed {slice_.seed}: {broken} pixels are no numbers")
        return image

    def curve(self, runs: list[Run], images: list[list[np.ndarray]], name: str) -> list[CurvePoint]:
        points = []
        for step in range(min(len(run.ladder) for run in runs)):
            rungs = [run.ladder[step] for run in runs]
            points.append(join_repeats(True, 0, [run_point([s], [self.read(s, name)], 1, self.reference) for s in rungs]))
        for size in group_sizes(min(len(run.slices) for run in runs)):
            found = [run_point(run.slices, pictures, size, self.reference) for run, pictures in zip(runs, images, strict=True)]
            points.append(join_repeats(False, size, found))
        return points

    def slope(self, curve: list[CurvePoint]) -> Estimate | None:
        axis = self.budget_axis()
        repeats = len(curve[0].by_repeat)
        return slope_estimate([([p.by_repeat[r][0][axis] or 0 for p in curve], [p.by_repeat[r][1]["mse"] for p in curve])
                               for r in range(repeats)])

    def budget_axis(self) -> str:
        return self.case.clock if self.case.equal == "seconds" else self.case.equal

    def works(self, runs: list[Run], images: list[list[np.ndarray]]) -> dict[str, Work]:
        variances, pairs = [], []
        for run, pictures in zip(runs, images, strict=True):
            for i in range(0, len(pictures) - 1, 2):
                difference = pictures[i].astype(np.float64) - pictures[i + 1]
                variances.append(float((difference**2).mean()) / 2)
                pairs.append((run.slices[i], run.slices[i + 1]))
        works = {}
        for axis in AXES:
            costs = [cost_on(axis, list(pair)) for pair in pairs]
            if all(c is not None and c > 0 for c in costs):
                works[axis] = Work(np.array(variances), np.array(costs, float) / 2)
        return works

    def find_bias(self, images: list[np.ndarray], work: Work | None) -> BiasFound:
        squared = bias.squared_bias(images, self.references)
        flat = work.value() / squared.value if work and squared.z() > MOST_BIAS_Z and squared.value > 0 else None
        return BiasFound(bias.mean_signed(images, self.references), squared, flat)

    def judge(self, entry: Entry) -> SettingResult:
        result = SettingResult(entry.setting.name, entry)
        images = [[self.read(s, entry.setting.name) for s in run.slices] for run in entry.runs]
        flat = [image for run in images for image in run]
        if entry.setting.command and np.array_equal(flat[0], flat[1]):
            raise CaseError(f"{entry.setting.name}: slices of different seeds are equal: the program takes no {{seed}}")
        result.curve = self.curve(entry.runs, images, entry.setting.name)
        result.slope = self.slope(result.curve)
        singles = [p for p in result.curve if p.single or p.slices == 1]
        result.slope_single = self.slope(singles)
        result.works = self.works(entry.runs, images)
        result.bias = self.find_bias(flat, result.works.get(self.budget_axis()))
        merged = [weighted_mean(pictures, [s.cost.samples for s in run.slices]) for run, pictures in zip(entry.runs, images, strict=True)]
        result.picture = merged[0]
        result.flip, flip_map = self.tool.flip(merged[0], self.reference.image)
        seconds = [getattr(s.cost, self.case.clock) for s in entry.slices()]
        result.maps = make_maps(flat, merged, self.reference, len(entry.runs[0].slices), float(np.mean(seconds)), flip_map)
        result.worst = worst_pixels(flat, entry.slices(), self.reference.image)
        return result

    def run(self, entries: list[Entry]) -> SceneResult:
        """Judges all settings that rendered, and compares them with the best one."""
        results, failures = [], {e.setting.name: e.failure for e in entries if e.failure}
        for entry in entries:
            if entry.failure or not entry.runs:
                continue
            try:
                results.append(self.judge(entry))
            except CaseError as error:
                failures[entry.setting.name] = str(error)
        for axis in AXES:
            known = [r for r in results if axis in r.works]
            if not known:
                continue
            # A biased setting may well have little variance: it is measured, but it is not the best.
            fair = [r for r in known if not r.biased()] or known
            best, ties = tied_with_best([r.works[axis] for r in fair])
            for result, tie in zip(fair, ties, strict=True):
                result.tied[axis] = tie
            for result in known:
                result.ratios[axis] = log_ratio(result.works[axis], fair[best].works[axis])
        axis = self.budget_axis()
        results.sort(key=lambda r: (r.biased(), r.works[axis].value() if axis in r.works else math.inf))
        return SceneResult(self.name, self.reference, self.source, results, failures, self.window(results), self.reference_tail())

    def reference_tail(self) -> float:
        """0 for fewer than three pairs."""
        pairs = [float(((a.astype(np.float64) - b)**2).mean()) for a, b in zip(self.references[::2], self.references[1::2])]
        return max(pairs) / sum(pairs) if len(pairs) > 2 and sum(pairs) > 0 else 0.0

    def window(self, results: list[SettingResult]) -> tuple[int, int, int, int]:
        """Where the pixels are in the whole image, as the header of an EXR file tells."""
        height, width = self.reference.image.shape[:2]
        for result in results:
            image = result.entry.slices()[0].image
            if image.suffix == ".exr":
                info = self.tool.info(image)
                (left, top, _, _), (x0, y0, x1, y1) = info["dataWindow"], info["displayWindow"]
                return left - x0, top - y0, x1 - x0, y1 - y0
        return 0, 0, width, height
