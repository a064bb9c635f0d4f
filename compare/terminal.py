# SPDX-License-Identifier: BSD-2-Clause
"""The summary as an aligned table of text."""
import math

from .analysis import SceneResult, SettingResult
from .case import Case
from .intervals import Estimate, student_quantile


def ratio_text(result: SettingResult, axis: str) -> str:
    """Work relative to the best setting, with the interval of the ratio."""
    ratio = result.ratios.get(axis)
    if ratio is None or not math.isfinite(ratio.value):
        return "-"
    if ratio.error == 0:
        return "1 best"
    width = min(700.0, student_quantile(ratio.freedom) * ratio.error)
    text = f"{math.exp(ratio.value):.3g} ({math.exp(ratio.value - width):.3g} to {math.exp(ratio.value + width):.3g})"
    return text + (" tie" if result.tied.get(axis) else "")


def slope_text(slope: Estimate | None) -> str:
    return "-" if slope is None else f"{slope.value:.2f} +- {slope.half_width():.2f}"


def bias_text(result: SettingResult, unit: str) -> str:
    bias = result.bias
    if bias is None:
        return "-"
    text = f"z {bias.signed.z():+.1f}"
    if not bias.seen():
        return text
    return f"BIASED, {text}" + (f", flat from {bias.flat_at:.3g} {unit}" if bias.flat_at is not None else "")


def terminal_table(case: Case, scene: SceneResult) -> str:
    """Best first; columns as wide as they need to be."""
    unit = {"seconds": "s", "lookups": "look-ups", "samples": "spp"}[case.equal]
    rows = [["setting", "variance x seconds", "variance x look-ups", "slope", "MSE", "bias"]]
    rows += [[r.name, ratio_text(r, case.clock), ratio_text(r, "lookups"), slope_text(r.slope), f"{r.curve[-1].errors['mse'].value:.3g}",
              bias_text(r, unit)] for r in scene.results]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = ["  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    failures = [f"{name}: left out: {text.splitlines()[-1]}" for name, text in scene.failures.items()]
    warning = scene.reference_warning()
    return "\n".join([f"\n{scene.name}", *lines, *failures, *([warning] if warning else [])])
