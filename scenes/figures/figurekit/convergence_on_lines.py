# SPDX-License-Identifier: BSD-2-Clause
"""What figures 12 and 13 of Kettunen et al. 2021 have in common: variance against look-ups on one density, the cost raised by the control."""
import math
from collections.abc import Callable

import numpy as np

from compare.slope import slope_of

from .closed_forms import Roulette, teeth
from .intervals import Interval, ratio
from .known import rows_of
from .plotting import Axes, curve, log_axes
from .programs import Row
from .run import Run

URM = "unbiased-ray-marching:endpointmatching=off"
URM_EM = "unbiased-ray-marching:endpointmatching=on"
BIASED = "biased-ray-marching:endpointmatching=off"
BIASED_EM = "biased-ray-marching:endpointmatching=on"
NAMES = {"p-series-cmf": "p-CMF, control raised", URM: "unbiased", URM_EM: "unbiased, end points matched", BIASED: "biased"}
# Before they are scaled, with the waves that they share; their means, and the largest over the mean.
DENSITIES: dict[str, tuple[Callable[[np.ndarray, np.ndarray], np.ndarray], str, str]] = {
    "fractal-a": (lambda x, waves: 2.2 + waves, "2.21242", "2.136"),
    "fractal-b": (lambda x, waves: 0.8 + 6 * x + 0.3 * waves, "3.80373", ""),
}


def measured(run: Run, density: str, transmittance: float, factors: list[float], estimators: list[str]) -> list[Row]:
    """Rows of the lab by control, a raised majorant."""
    return run.lab("estimate", estimator=estimators, extinction=density, depth=f"{-math.log(transmittance):.12g}", control=factors, trials=run.pick(60_000, 10_000))


def square_error(row: Row) -> tuple[float, float]:
    """Variance and squared bias, and its standard error."""
    bias, noise = float(row["mean"]) - float(row["exact"]), float(row["mean_stderr"])
    return float(row["variance"]) + max(0.0, bias * bias - noise * noise), math.hypot(float(row["variance_stderr"]), 2 * bias * noise)


def draw(panel: Axes, rows: list[Row], estimators: list[str]) -> None:
    for index, name in enumerate(estimators):
        found = [r for r in rows if r["estimator"] == name]
        curve(panel, [float(r["lookups"]) for r in found], [square_error(r)[0] for r in found], index, NAMES[name], [square_error(r)[1] for r in found])
    first = next(r for r in rows if r["estimator"] == "p-series-cmf")
    runs = [1, 25]
    panel.plot([float(first["lookups"]) * n for n in runs], [float(first["variance"]) / n for n in runs], ":", color="#888888", linewidth=1.2, label="p-CMF, averaged")
    log_axes(panel)
    panel.set_xlabel("look-ups", fontsize=8)


def check_density(run: Run, density: str) -> float:
    """The largest over the mean, which the lab's tight control tells."""
    shape, mean, largest = DENSITIES[density]
    x = (np.arange(200_000) + 0.5) / 200_000
    waves = sum(2.0**(-k / 2) * np.cos(2 * np.pi * 2**k * 1.37 * x + 0.7 * k * k) for k in range(8))
    values = np.maximum(0, shape(x, waves))
    run.expect(f"mean of {density} before scaling", mean, float(values.mean()))
    row, = run.lab("estimate", estimator="ratio", extinction=density, depth=1, efficiency=1, trials=1000)
    found = 1 / float(row["control"])
    run.expect(f"largest over mean of {density}", largest or f"{values.max() / values.mean():.4f}", found)
    return found


def check_known(run: Run, density: str, transmittance: str) -> None:
    largest = check_density(run, density)
    for known in rows_of("one_density"):
        if (known["density"], known["T"]) != (density, transmittance):
            continue
        rows = {str(r["estimator"]): r for r in run.lab(
            "estimate", estimator=["p-series-cmf", URM, URM_EM, BIASED, BIASED_EM], extinction=density, depth=f"{-math.log(float(transmittance)):.12g}",
            control=known["f"], trials=run.pick(100_000, 10_000), seed=3)}
        what = f"{density}, T = {transmittance}, control raised by {known['f']}"
        variance, cost = known["pcmf"].split("/")
        row = rows["p-series-cmf"]
        run.expect(f"p-CMF, {what}", variance, float(row["variance"]), float(row["variance_stderr"]))
        run.expect(f"cost of p-CMF, {what}", cost, float(row["lookups"]), math.sqrt(2 * float(row["lookups"]) / float(row["trials"])))
        tight = -math.log(float(transmittance)) * largest
        run.expect(f"teeth of unbiased ray marching, {what}", f"{known['teeth']}.0", teeth(tight * float(known["f"]), Roulette(2, 0.9)))
        run.expect(f"cost of biased ray marching, {what}", f"{known['biased_cost']}.0", float(rows[BIASED]["lookups"]))
        run.expect(f"cost of unbiased ray marching, {what}", known["cost"], float(rows[URM]["lookups"]), 3 * float(known["teeth"]) / math.sqrt(float(row["trials"])))
        for key, name in (("urm", URM), ("urm_em", URM_EM), ("biased", BIASED), ("biased_em", BIASED_EM)):
            # Rare orders carry much of these variances, so that the other simulation's own error is not small: what 4e5 of its runs have.
            error, spread = square_error(rows[name])
            other = spread * math.sqrt(float(row["trials"]) / 4e5)
            if error > 1e-8:  # below, single precision of the optical depth is seen
                run.expect(f"{name}, {what}", known[key], error, spread, other)
            else:
                run.expect(f"{name}, {what}", "0e-8", float(known[key]))


def slopes(rows: list[Row], name: str) -> float:
    found = [r for r in rows if r["estimator"] == name]
    slope = slope_of([float(r["lookups"]) for r in found], [float(r["variance"]) for r in found])
    assert slope is not None
    return slope


def claims(run: Run, rows: list[Row], best: str, what: str) -> None:
    """Steeper than the series, with bumps that are seen and not hidden."""
    run.claim(f"{what}: p-CMF with a raised control, slope of the variance (averaging has -1)", Interval.exact(slopes(rows, "p-series-cmf")), above=-1.5, below=-1)
    run.expect(f"{what}: slope of p-CMF with a raised control", "-1.3", slopes(rows, "p-series-cmf"))
    run.claim(f"{what}: unbiased ray marching is steeper, its slope less p-CMF's", Interval.exact(slopes(rows, best) - slopes(rows, "p-series-cmf")), below=0)
    last = [[r for r in rows if r["estimator"] == n][-1] for n in ("p-series-cmf", best)]
    for unit, column in (("look-ups", "lookups"), ("seconds", "seconds_per_estimate")):
        run.claim(f"{what}: at the highest cost, variance x {unit} of p-CMF over unbiased ray marching's",
                  ratio(*(float(r[c]) * float(r[column]) for r in last for c in ("variance", "variance_stderr"))), above=1)
