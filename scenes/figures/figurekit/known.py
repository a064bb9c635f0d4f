# SPDX-License-Identifier: BSD-2-Clause
"""Numbers that are known independently, in scenes/figures/known: closed forms, and simulations that were written from the definitions."""
import csv

from .catalogue import FOLDER


def rows_of(name: str) -> list[dict[str, str]]:
    """The table known/NAME.csv; its numbers stay text, as their digits tell how exact they are."""
    lines = (FOLDER / "known" / f"{name}.csv").read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))
