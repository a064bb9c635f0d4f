# SPDX-License-Identifier: BSD-2-Clause
"""Tables of the report."""
import html
import math

from .analysis import HEAVY_TAIL, MOST_BIAS_Z, SceneResult, SettingResult
from .case import Case
from .intervals import Estimate
from .maps import WorstPixel
from .plots import style
from .replay import replay


def cell(text: str, value: float | None, title: str = "", kind: str = "") -> str:
    """One cell; `value` is what the column is sorted by."""
    sort = value if value is not None and math.isfinite(value) else 1e300
    return f'<td data-value="{sort:.9g}" title="{html.escape(title)}" class="{kind}">{text}</td>'


def ratio_cell(result: SettingResult, axis: str, unit: str) -> str:
    """Variance x cost relative to the best setting, with its interval."""
    work, ratio = result.works.get(axis), result.ratios.get(axis)
    if work is None or ratio is None:
        return cell("–", None)
    low, high = work.interval()
    title = f"variance x {unit} {work.value():.4g}, 95 % interval {low:.4g} to {high:.4g}"
    relative = result.ratio(axis)
    if relative is None:
        return cell("no noise" if work.value() == 0 else "–", work.value(), title)
    if ratio.error == 0:
        text, kind = "1 <small>best</small>", "best"
    else:
        value, least, most = relative
        tied = result.tied.get(axis, False)
        text, kind = f"{value:.3g} <small>{least:.3g} – {most:.3g}</small>", "tie" if tied else ""
        text += " <em>tie</em>" if tied else ""
    return cell(text, work.value(), title, kind)


def slope_cell(slope: Estimate | None) -> str:
    if slope is None:
        return cell("–", None, "fewer than three points")
    width = slope.half_width()
    text = f"{slope.value:.2f}" + (f" <small>± {width:.2f}</small>" if math.isfinite(width) else "")
    flat = math.isfinite(width) and slope.value - width > -1
    return cell(text, slope.value, "flatter than -1" if flat else "", "bad" if flat and slope.value > -0.9 else "")


def bias_cells(result: SettingResult, unit: str) -> str:
    bias = result.bias
    assert bias is not None
    signed = bias.signed
    text = f"{signed.value:+.2g} <small>± {signed.error:.1g} (z {signed.z():+.1f})</small>" if math.isfinite(signed.z()) else f"{signed.value:+.2g}"
    cells = cell(text, abs(signed.value), "mean of all pixels less that of the reference, ± one standard error",
                 "bad" if abs(signed.z()) > MOST_BIAS_Z else "")
    squared = bias.squared
    if squared.z() > MOST_BIAS_Z:
        text = f"{math.sqrt(squared.value):.2g}"
        if bias.flat_at is not None:
            text += f" <small>flat from {bias.flat_at:.3g} {unit}</small>"
        return cells + cell(text, math.sqrt(squared.value), f"mean squared bias {squared.value:.3g} ± {squared.error:.2g} (one standard error)", "bad")
    limit = math.sqrt(max(0.0, squared.value) + 2 * squared.error)
    return cells + cell(f"<small>none above {limit:.1g}</small>", 0, f"mean squared bias {squared.value:.3g} ± {squared.error:.2g} (one standard error)")


def cost_cells(result: SettingResult) -> str:
    """What a sample costs, and the variance it has."""
    entry = result.entry
    spp = sum(s.cost.samples for s in entry.slices())
    pixels = result.picture.shape[0] * result.picture.shape[1] if result.picture is not None else 1
    cpu, lookups = result.total("cpu") or 0.0, result.total("lookups")
    variance = result.works["samples"].value()
    share = max((w.tail_share() for w in result.works.values()), default=0.0)
    tail = f"one pair of slices has {100 * share:.0f} % of all variance: a matter of luck" if share > HEAVY_TAIL else ""
    return (cell(f"{1e6 * cpu / (spp * pixels):.3g}", cpu / spp) + cell("–" if lookups is None else f"{lookups / (spp * pixels):.3g}", lookups)
            + cell(f"{variance:.3g}" + (" <em>heavy tail</em>" if tail else ""), variance, tail, "bad" if tail else ""))


def summary_table(case: Case, scene: SceneResult, order: dict[str, int]) -> str:
    """Best first, by variance x what the budget is of; biased settings last."""
    unit = {"seconds": "s", "lookups": "look-ups", "samples": "spp"}[case.equal]
    clock = "CPU s" if case.clock == "cpu" else "s"
    heads = (("setting", ""), (f"variance × {clock}", "relative to the best without bias; 95 % interval of the ratio. Time to the same error"),
             ("variance × look-ups", "relative to the best; look-ups to the same error"),
             ("µs / sample", "CPU microseconds of a camera sample"), ("look-ups / sample", ""),
             ("variance of a sample", "mean over pixels and channels of the variance of an image of one sample per pixel"),
             ("slope", f"of log(mean squared error) over log({case.equal}), 95 %"),
             ("slope, one render", "the same of renders in one piece, which sampling patterns can make steeper"),
             ("mean signed difference", ""), ("RMS bias", "root of the mean squared bias; noise taken out"),
             ("MSE at budget", ""), ("FLIP", "LDR-FLIP of the first repeat, values clamped to [0, 1]"))
    rows = []
    for result in scene.results:
        colour, _ = style(order[result.name])
        last = result.curve[-1]
        mark = ' <em class="bad">biased</em>' if result.biased() else ""
        rows.append(f'<tr data-setting="{order[result.name]}"><th><i style="background:{colour}"></i>{html.escape(result.name)}{mark}</th>'
                    + ratio_cell(result, case.clock, clock) + ratio_cell(result, "lookups", "look-ups") + cost_cells(result) + slope_cell(result.slope)
                    + slope_cell(result.slope_single) + bias_cells(result, unit)
                    + cell(f"{last.errors['mse'].value:.3g}", last.errors["mse"].value)
                    + cell("–" if result.flip is None else f"{result.flip:.3f}", result.flip) + "</tr>")
    head = "".join(f'<th title="{html.escape(title)}">{html.escape(text)}</th>' for text, title in heads)
    return f'<div class="wide"><table class="sortable"><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}</tbody></table></div>'


def colour_text(values: tuple[float, ...]) -> str:
    return " ".join(f"{v:.4g}" for v in values)


def worst_row(scene: SceneResult, result: SettingResult, worst: WorstPixel) -> str:
    cells = (f"{scene.window[0] + worst.x}, {scene.window[1] + worst.y}", f"{100 * worst.share:.3g} %", colour_text(worst.value),
             colour_text(worst.reference), str(worst.slice.seed), f"<code>{html.escape(replay(result, worst, scene.window))}</code>")
    return "<tr>" + "".join(f"<td>{c}</td>" for c in cells) + "</tr>"


def worst_table(scene: SceneResult) -> str:
    """For each setting the pixels with most of the squared error of all slices, and the commands that render them again."""
    parts = []
    for result in scene.results:
        rows = "".join(worst_row(scene, result, w) for w in result.worst)
        share = sum(w.share for w in result.worst)
        parts.append(f"<details><summary>{html.escape(result.name)}: the worst {len(result.worst)} have {100 * share:.3g} % of the squared error</summary>"
                     f'<div class="wide"><table><thead><tr><th>pixel</th><th>share</th><th>worst slice</th><th>reference</th><th>its seed</th>'
                     f"<th>again</th></tr></thead><tbody>{rows}</tbody></table></div></details>")
    return "".join(parts)
