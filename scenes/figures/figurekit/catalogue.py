# SPDX-License-Identifier: BSD-2-Clause
"""Which figures there are: one script each, beside this package, and a list of those that cannot be made yet."""
import importlib.util
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .run import Run

FOLDER = Path(__file__).resolve().parent.parent

PAPERS = {
    "georgiev-2019": "Georgiev, Misso, Hachisuka, Nowrouzezahrai, Křivánek, Jarosz 2019: Integral formulations of volumetric transmittance",
    "kettunen-2021": "Kettunen, d'Eon, Pantaleoni, Novák 2021: An unbiased ray-marching transmittance estimator",
    "szirmay-kalos-2017": "Szirmay-Kalos, Georgiev, Magdics, Molnár, Légrády 2017: Unbiased light transport estimators for inhomogeneous participating media",
    "misso-2022": "Misso, Bitterli, Georgiev, Jarosz 2022: Unbiased and consistent rendering using biased estimators",
    "misso-2023": "Misso, Li, Burley, Teece, Jarosz 2023: Progressive null-tracking for volumetric rendering",
}


@dataclass(frozen=True)
class Figure:
    """What a script says of its figure."""
    title: str
    reported: str                     # what the paper reported: one sentence
    settings: str                     # ours, and where they differ from the paper's
    seconds: float = 10               # of a full run on two processors, until a run has told better


@dataclass(frozen=True)
class Entry:
    name: str                         # paper-year-number, with dashes
    figure: Figure
    make: "Callable[[Run], None]"
    script: Path

    @property
    def paper(self) -> str:
        return paper_of(self.name)


def paper_of(name: str) -> str:
    """The key in PAPERS of a figure's name."""
    return name.rsplit("-", 1)[0]


def title_of(name: str) -> str:
    """Figure number as people write it."""
    return f"Figure {name.rsplit('-', 1)[1].lstrip('0')}"


def load(script: Path) -> Entry:
    """Imports a script, which has a `FIGURE` and a `make(run)`."""
    spec = importlib.util.spec_from_file_location(script.stem, script)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[script.stem] = module
    spec.loader.exec_module(module)
    name = script.stem.replace("_", "-")
    if paper_of(name) not in PAPERS:
        raise ValueError(f"{script}: no paper of that name; known: {', '.join(PAPERS)}")
    return Entry(name, module.FIGURE, module.make, script)


def order(name: str) -> tuple[int, str]:
    """Papers in the order of PAPERS, then numbers."""
    return list(PAPERS).index(paper_of(name)), name


def all_figures(folder: Path = FOLDER) -> list[Entry]:
    return sorted((load(p) for p in folder.glob("*_*_*.py")), key=lambda e: order(e.name))
