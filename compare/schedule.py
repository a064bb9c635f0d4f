# SPDX-License-Identifier: BSD-2-Clause
"""Which slice is rendered next. Settings take turns, so that a machine that slows down or speeds up is fair to all."""
from collections.abc import Callable
from dataclasses import dataclass, field

from .case import Case, SceneCase, Setting
from .programs import Renderer, RenderFailure
from .slices import Slice, SliceStore

MOST_SPP = 1 << 30
SEEDS_OF_A_RUN = 1 << 16
"""Each run (a repeat, the reference) has a block of seeds of its own."""
LADDER_SEED = SEEDS_OF_A_RUN // 2
"""Within the block, slices count from 0, the steps of the ladder from here."""


@dataclass
class Run:
    """What one setting rendered with one budget: a repeat."""
    slices: list[Slice] = field(default_factory=list)
    ladder: list[Slice] = field(default_factory=list)   # single renders of 1, 2, 4, ... samples, fewer than a slice has
    spent: float = 0                                    # in the unit of the budget, by slices


@dataclass
class Entry:
    """A setting on a scene, with all that was rendered of it."""
    setting: Setting
    renderer: Renderer
    spp: int = 1                                        # samples a pixel of a slice
    runs: list[Run] = field(default_factory=list)
    failure: str = ""

    def slices(self) -> list[Slice]:
        return [s for run in self.runs for s in run.slices]


Report = Callable[[str, Slice], None]
"""Hears of each slice: which part of the work, and the slice."""


class Schedule:
    """Renders a scene under all settings. What is in the store already costs nothing, so a second run goes on where the
    first one stopped; the order of work depends on the case and on the costs in the store alone."""

    def __init__(self, case: Case, scene: SceneCase, store: SliceStore, report: Report):
        self.case, self.scene, self.store, self.report = case, scene, store, report

    def cost(self, slice_: Slice) -> float:
        return slice_.cost.of(self.case.equal, self.case.clock)

    def take(self, entry: Entry, what: str, seed: int, spp: int) -> Slice | None:
        try:
            found = self.store.get(entry.renderer, seed, spp)
            self.cost(found)
        except RenderFailure as failure:
            entry.failure = str(failure)
            return None
        self.report(what, found)
        return found

    def ladder(self, entry: Entry, run: Run, first_seed: int, below: float, what: str) -> None:
        """Single renders of 1, 2, 4, ... samples while one stays cheaper than `below`."""
        spp, step = 1, 0
        while spp <= MOST_SPP:
            rung = self.take(entry, f"{what}, {spp} spp alone", first_seed + LADDER_SEED + step, spp)
            if rung is None:
                return
            run.ladder.append(rung)
            # Samplers round samples up: the next step is beyond what was taken.
            spp, step = max(2 * spp, 2 * rung.cost.samples), step + 1
            if 2 * self.cost(rung) > below:
                return

    @staticmethod
    def fitting_spp(ladder: list[Slice], costs: list[float], wanted: float) -> int:
        """Samples a pixel of a render that costs `wanted`: by the last and largest step, less what a render costs
        without any sample, if the step before tells."""
        samples, cost = ladder[-1].cost.samples, costs[-1]
        slope = cost / samples
        if len(ladder) > 1 and samples > ladder[-2].cost.samples:
            between = (cost - costs[-2]) / (samples - ladder[-2].cost.samples)
            slope = between if 0.5 * slope < between else slope
        return min(MOST_SPP, max(1, round(wanted / slope))) if slope > 0 else max(1, samples)

    def begin(self, entry: Entry, number: int, budget: float) -> None:
        """The first steps of repeat `number`: its ladder, and with the first one the size of all slices."""
        run = Run()
        entry.runs.append(run)
        name = f"{entry.setting.name}, repeat {number + 1}"
        if number > 0:
            steps = entry.runs[0].ladder
            found = [self.take(entry, f"{name}, {s.spp} spp alone", self.seed(number) + LADDER_SEED + i, s.spp) for i, s in enumerate(steps)]
            run.ladder = [s for s in found if s]
            return
        wanted = budget / self.case.slices
        self.ladder(entry, run, self.seed(number), wanted, name)
        if not entry.failure:
            entry.spp = self.fitting_spp(run.ladder, [self.cost(s) for s in run.ladder], wanted)
            run.ladder = [s for s in run.ladder if s.cost.samples < entry.spp]

    def seed(self, run: int) -> int:
        return self.case.seed + run * SEEDS_OF_A_RUN

    def render_run(self, entries: list[Entry], number: int, budget: float) -> None:
        """One budget for each entry, slice by slice: next is whoever has spent least of it. Half a slice is let go over."""
        for entry in entries:
            if not entry.failure:
                self.begin(entry, number, budget)
        while True:
            waiting = [e for e in entries if not e.failure and self.wants_more(e.runs[-1], budget)]
            if not waiting:
                return
            entry = min(waiting, key=lambda e: e.runs[-1].spent)
            run = entry.runs[-1]
            at = len(run.slices)
            found = self.take(entry, f"{entry.setting.name}, repeat {number + 1}", self.seed(number) + at, entry.spp)
            if found:
                run.slices.append(found)
                run.spent += self.cost(found)

    def wants_more(self, run: Run, budget: float) -> bool:
        """At least two slices, so that there is a variance; then until the budget is met as well as whole slices can."""
        count = len(run.slices)
        if count < 2:
            return True
        return count < LADDER_SEED and run.spent + 0.5 * run.spent / count <= budget

    def compare(self, entries: list[Entry]) -> None:
        """All repeats, one after the other."""
        for number in range(self.case.repeats):
            self.render_run(entries, number, self.scene.budget)

    def reference(self, entry: Entry) -> None:
        """Renders the reference: `reference_times` budgets in one run, with the seeds behind those of all repeats."""
        number = self.case.repeats
        probe = Run()
        name = f"reference, {entry.setting.name}"
        # Slices of a reference are longer: fewer images to keep.
        budget = self.scene.budget * self.case.reference_times
        wanted = budget / max(4, min(32, self.case.slices * 2))
        self.ladder(entry, probe, self.seed(number), wanted, name)
        if entry.failure:
            return
        entry.spp = self.fitting_spp(probe.ladder, [self.cost(s) for s in probe.ladder], wanted)
        run = Run()
        entry.runs.append(run)
        while self.wants_more(run, budget):
            found = self.take(entry, name, self.seed(number) + len(run.slices), entry.spp)
            if found is None:
                return
            run.slices.append(found)
            run.spent += self.cost(found)
