# SPDX-License-Identifier: BSD-2-Clause
"""The numbers as CSV and JSON."""
import csv
import math
from pathlib import Path
from typing import Any

from .analysis import AXES, CurvePoint, SceneResult, SettingResult
from .case import Case
from .intervals import Estimate
from .metrics import METRICS
from .replay import replay


def write_csv(path: Path, rows: list[dict[str, Any]]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys() if rows else ["nothing"])
        writer.writeheader()
        writer.writerows(rows)


def spread(name: str, estimate: Estimate | None) -> dict[str, float | None]:
    """A value and its interval as columns."""
    if estimate is None:
        return {name: None, f"{name}_low": None, f"{name}_high": None}
    return {name: estimate.value, f"{name}_low": estimate.low(), f"{name}_high": estimate.high()}


def curve_rows(scene: SceneResult) -> list[dict[str, Any]]:
    rows = []
    for result in scene.results:
        for point in result.curve:
            for repeat, (costs, errors) in enumerate(point.by_repeat, 1):
                rows.append({"scene": scene.name, "setting": result.name, "repeat": repeat, "slices": point.slices, "seconds": costs["wall"],
                             "cpu_seconds": costs["cpu"], "lookups": costs["lookups"], "spp": costs["samples"], **errors})
    return rows


def slice_rows(scene: SceneResult) -> list[dict[str, Any]]:
    return [{"scene": scene.name, "setting": result.name, "repeat": repeat, "seed": s.seed, "alone": s in run.ladder, "spp": s.cost.samples,
             "seconds": s.cost.wall, "cpu_seconds": s.cost.cpu, "construct_seconds": s.cost.construct, "lookups": s.cost.lookups, "rays": s.cost.rays,
             "image": s.image.name}
            for result in scene.results for repeat, run in enumerate(result.entry.runs, 1) for s in [*run.ladder, *run.slices]]


def summary_row(scene: SceneResult, result: SettingResult) -> dict[str, Any]:
    row: dict[str, Any] = {"scene": scene.name, "setting": result.name}
    for axis in AXES:
        work = result.works.get(axis)
        low, high = work.interval() if work else (None, None)
        row.update({f"variance_x_{axis}": work.value() if work else None, f"variance_x_{axis}_low": low, f"variance_x_{axis}_high": high,
                    f"tied_{axis}": result.tied.get(axis)})
        relative = result.ratio(axis) or (None, None, None)
        row.update({f"relative_{axis}": relative[0], f"relative_{axis}_low": relative[1], f"relative_{axis}_high": relative[2]})
    row["biased"] = result.biased()
    row.update(spread("slope", result.slope))
    row.update(spread("slope_alone", result.slope_single))
    assert result.bias is not None
    row.update({"mean_signed": result.bias.signed.value, "mean_signed_error": result.bias.signed.error,
                "squared_bias": result.bias.squared.value, "squared_bias_error": result.bias.squared.error, "flat_at": result.bias.flat_at})
    last = result.curve[-1]
    row.update({f"{m}_at_budget": last.errors[m].value for m in METRICS})
    row["flip_at_budget"] = result.flip
    return row


def point_json(point: CurvePoint) -> dict[str, Any]:
    return {"alone": point.single, "slices": point.slices, "costs": point.costs, "errors": {m: point.errors[m].json() for m in METRICS}}


def setting_json(scene: SceneResult, result: SettingResult) -> dict[str, Any]:
    out = summary_row(scene, result)
    out["curve"] = [point_json(p) for p in result.curve]
    left, top, _, _ = scene.window
    out["worstPixels"] = [{"x": left + w.x, "y": top + w.y, "share": w.share, "value": w.value, "reference": w.reference,
                           "seed": w.slice.seed, "spp": w.slice.spp, "again": replay(result, w, scene.window)} for w in result.worst]
    return out


def clean(value: Any) -> Any:
    """JSON has no infinity and no NaN: they become null."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {k: clean(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [clean(v) for v in value]
    return value


def scene_json(case: Case, scene: SceneResult, provenance: list[dict]) -> dict[str, Any]:
    return clean({"scene": scene.name, "equal": case.equal, "clock": case.clock,
                  "reference": {"source": scene.reference_source, "noise": scene.reference.noise() if scene.reference.variance is not None else None,
                                "epsilon": case.epsilon},
                  "settings": [setting_json(scene, r) for r in scene.results], "failures": scene.failures, "provenance": provenance})
