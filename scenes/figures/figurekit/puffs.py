# SPDX-License-Identifier: BSD-2-Clause
"""Clouds whose bounds are exact, given or learned: figures of Misso et al. 2023."""
from typing import Any

SCENE = "puff.pbrt"
SKY = ["../data/evening-sky.exr"]


def bounds(kind: str, majorant: float | None = None) -> dict[str, Any]:
    """Values for the template: `exact`, or `constant` with a majorant, an extinction."""
    return {"--mediumparams": f'"string bounds" "{kind}"' + (f' "float majorant" {majorant}' if majorant is not None else "")}


def learned(start: float = 0.01, epsilon: float = 0.2) -> dict[str, Any]:
    """Learned from `start` on, without a warm-up, as the paper does."""
    return {"--mediumparams": f'"string bounds" "progressive" "float initialextinction" {start} "float epsilon" {epsilon} "integer warmup" 0'}
