# SPDX-License-Identifier: BSD-2-Clause
"""The report: one HTML page that needs no network, and the curves as PNG files."""
import base64
import dataclasses
import html
import json
import math
import re
import zlib
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

from . import plots
from .analysis import AXES, MOST_BIAS_Z, SceneResult
from .case import Case
from .intervals import student_quantile
from .page_table import summary_table, worst_table
from .tables import clean

PAGE = Path(__file__).parent / "page"
FEWEST = 1e-12
MOST_DECADES = 4
"""A scale of more would show a scene's dark corners and little else."""


def packed(values: np.ndarray) -> str:
    """Half floats, high bytes first and low bytes after them, deflated, as base64: pictures of a page."""
    halves = np.clip(values, -65504, 65504).astype("<f2")
    planes = halves.reshape(-1).view(np.uint8).reshape(-1, 2).T[::-1]
    return base64.b64encode(zlib.compress(planes.tobytes(), 9)).decode()


def logarithms(values: np.ndarray) -> np.ndarray:
    """Of maps that are drawn on a logarithmic scale; 0 becomes -12."""
    return np.log10(np.maximum(values, FEWEST))


def span_of(maps: list[np.ndarray], logarithmic: bool) -> list[float]:
    """One scale for the maps of all settings: between the percentiles 0.5 and 99.5 of the values that are not 0."""
    values = np.concatenate([m.reshape(-1) for m in maps])
    if not logarithmic:
        largest = float(np.percentile(np.abs(values), 99.5)) or 1.0
        return [-largest, largest]
    values = values[values > FEWEST]
    if not values.size:
        return [-1.0, 0.0]
    low, high = (math.log10(float(v)) for v in np.percentile(values, (0.5, 99.5)))
    return [min(max(low, high - MOST_DECADES), high - 0.5), high]


MAPS = (("error", "Error", "root mean squared error of a budget's image", "log"),
        ("variance", "Variance", "variance of a budget's image", "log"),
        ("bias", "Bias", "mean of all images − reference", "signed"),
        ("bias_z", "Bias / error", "the same in standard errors, noise of the reference included", "signed"),
        ("work", "Variance × seconds", "inverse efficiency: variance of a second's image; all pixels count the same time", "log"),
        ("flip", "FLIP", "LDR-FLIP of a budget's image, values clamped to [0, 1]", "unit"))


def first_exposure(image: np.ndarray) -> float:
    """Stops, in quarters, that bring nearly all of a bright picture below 1; 0 for one that is not bright."""
    bright = float(np.percentile(image.mean(axis=2), 98))
    return min(0.0, -math.ceil(4 * math.log2(bright)) / 4) if bright > 0 else 0.0


FIXED_SPANS = {"flip": [0.0, 1.0], "bias_z": [-MOST_BIAS_Z, MOST_BIAS_Z]}


def pictures(scene: SceneResult, order: dict[str, int]) -> dict[str, Any]:
    """What the viewer of a scene shows."""
    height, width = scene.reference.image.shape[:2]
    out: dict[str, Any] = {"width": width, "height": height, "exposure": first_exposure(scene.reference.image), "maps": [],
                           "images": [{"name": "reference", "data": packed(scene.reference.image)}]}
    for result in scene.results:
        assert result.picture is not None
        out["images"].append({"name": result.name, "data": packed(result.picture), "colour": plots.style(order[result.name])[0]})
    for key, title, words, kind in MAPS:
        all_maps = [getattr(r.maps, key) for r in scene.results]
        span = FIXED_SPANS.get(key) or span_of(all_maps, kind == "log")
        out["maps"].append({"key": key, "title": title, "words": words, "kind": kind, "span": span,
                            "data": [packed(logarithms(m) if kind == "log" else m) for m in all_maps]})
    return out


def colour_table(name: str) -> str:
    """256 colours, three bytes each, as base64."""
    colours = matplotlib.colormaps[name](np.linspace(0, 1, 256))[:, :3]
    return base64.b64encode((colours * 255).round().astype(np.uint8).tobytes()).decode()


def curves_section(out: Path, scene: SceneResult, order: dict[str, int], number: int) -> str:
    """All plots of a scene; buttons choose which one shows."""
    axes = [a for a in AXES if scene.axis_known(a)]
    parts = []
    for axis in axes:
        for metric in plots.METRIC_TITLES:
            figure = plots.error_figure(scene, order, axis, metric)
            if metric == "mse":
                plots.save_png(figure, out / f"{file_word(scene.name)}-{metric}-{axis}.png")
            # Names within a drawing must differ from those of the other drawings of the page.
            prefix = f"f{number}{axis}{metric}"
            text = re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{prefix}-", plots.svg_of(figure))
            parts.append(f'<div class="plot" data-axis="{axis}" data-metric="{metric}">{text}</div>')
    buttons = [f'<button data-axis="{a}">{html.escape(plots.AXIS_TITLES[a])}</button>' for a in axes]
    metrics = [f'<button data-metric="{m}">{html.escape(t)}</button>' for m, t in plots.METRIC_TITLES.items()]
    return (f'<div class="plots"><div class="bar"><span>over</span>{"".join(buttons)}</div>'
            f'<div class="bar"><span>error</span>{"".join(metrics)}</div>{"".join(parts)}</div>')


def file_word(name: str) -> str:
    return re.sub(r"[^\w.-]+", "-", name)


def reference_words(scene: SceneResult) -> str:
    reference = scene.reference
    text = f"Reference: {html.escape(scene.reference_source)}. "
    if reference.variance is None:
        return text + "Its noise is not known: errors and biases include it. "
    warning = scene.reference_warning()
    text += f"Its own noise, a mean squared error of {reference.noise():.3g}, is taken out of squared errors. "
    return text + (f'<b class="bad">{html.escape(warning)}</b> ' if warning else "")


def scene_section(out: Path, case: Case, scene: SceneResult, where: list[dict], number: int) -> str:
    order = {s.name: i for i, s in enumerate(case.compared())}
    failures = "".join(f'<p class="bad"><b>{html.escape(name)}</b> is left out: <code>{html.escape(text)}</code></p>'
                       for name, text in scene.failures.items())
    if not scene.results:
        return f"<section><h2>{html.escape(scene.name)}</h2>{failures}</section>"
    data = json.dumps(clean(pictures(scene, order)), separators=(",", ":")).replace("</", "<\\/")
    repeats = len(scene.results[0].entry.runs)
    return f"""<section data-scene="{number}">
<h2>{html.escape(scene.name)}</h2>
<p>{reference_words(scene)}Intervals are of 95 %, those of slopes and bands from {repeats} repeats (t = {student_quantile(repeats - 1):.2f}).</p>
{failures}
{summary_table(case, scene, order)}
<h3>Error</h3>{curves_section(out, scene, order, number)}
<h3>Pictures</h3><div class="viewer"></div><script type="application/json" class="pictures">{data}</script>
<h3>Worst pixels</h3>{worst_table(scene)}
<details><summary>How each setting was made</summary><pre>{html.escape(json.dumps(where, indent=1))}</pre></details>
</section>"""


def head_words(case: Case, machine: dict) -> str:
    unit = {"seconds": f"seconds ({'of all threads' if case.clock == 'cpu' else 'wall clock'})", "lookups": "density look-ups",
            "samples": "samples per pixel"}[case.equal]
    budgets = sorted({s.budget for s in case.scenes})
    amount = " or ".join(f"{b:g}" for b in budgets)
    return (f"{len(case.compared())} settings at equal {case.equal}: {case.repeats} repeats of {amount} {unit} each, in alternating slices, "
            f"about {case.slices} a repeat. {html.escape(machine['processor'])}, {machine['processors']} processors, "
            f"load {machine['load'][0]:.1f} at the start and {machine['loadAtEnd'][0]:.1f} at the end. {machine['date']}.")


def machine_words(machine: dict) -> str:
    return "\n".join(f"{html.escape(k):12} {html.escape(', '.join(f'{v:.2f}' for v in value) if isinstance(value, list) else str(value))}"
                     for k, value in machine.items())


def write(out: Path, case: Case, scenes: list[tuple[SceneResult, list[dict]]], machine: dict) -> None:
    """Writes report.html and the PNG files."""
    sections = "\n".join(scene_section(out, case, scene, where, i) for i, (scene, where) in enumerate(scenes))
    fields = {"TITLE": html.escape(case.title), "HEAD": head_words(case, machine), "SECTIONS": sections,
              "MACHINE": machine_words(machine), "CASE": html.escape(json.dumps(dataclasses.asdict(case), indent=1, default=str)),
              "STYLE": (PAGE / "page.css").read_text(), "SCRIPT": (PAGE / "viewer.js").read_text() + (PAGE / "page.js").read_text(),
              "COLOURS": json.dumps({"log": colour_table("viridis"), "signed": colour_table("RdBu_r"), "unit": colour_table("magma")})}
    page = (PAGE / "page.html").read_text()
    (out / "report.html").write_text(re.sub(r"@(\w+)@", lambda m: fields[m[1]], page))

