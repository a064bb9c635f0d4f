# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from compare.slope import slope_of

from figurekit.catalogue import Figure
from figurekit.closed_forms import Roulette, bk_variance, cosine, ubk_variance
from figurekit.intervals import Interval, ratio
from figurekit.known import rows_of
from figurekit.plotting import curve, log_axes, panels
from figurekit.run import Run

FIGURE = Figure(
    title="Variance against the mean number of terms",
    reported="The plain estimator reaches a plateau, with the true pivot at once and a higher one; U-BK goes on falling like one over the cost, and its two pivots merge.",
    settings="The paper does not tell its medium; ours is 1 + cos(20 x + 0.8) scaled to tau = 1 under its tight majorant, factors of variance 0.5, one look-up each. Exact.",
    seconds=30)

CS = (0.5, 1, 2, 4, 8, 16)
PIVOTS = {"majorant": 2.0, "truth": 1.0}


def make(run: Run) -> None:
    plot, (panel,) = panels(1, 1, (5.2, 3.3))
    orders = [Roulette(c).mean_orders() for c in CS]
    found, table = {}, []
    for index, (law, variance) in enumerate((("bk", bk_variance), ("ubk", ubk_variance))):
        for at, (name, pivot) in enumerate(PIVOTS.items()):
            found[law, name] = [variance(Roulette(c), -pivot, pivot - 1, 0.5, 1.0) for c in CS]
            curve(panel, orders, found[law, name], 2 * index + at, f"{law.upper().replace('UBK', 'U-BK')}, pivot at the {name}")
    log_axes(panel)
    panel.set_xlabel("mean number of terms")
    panel.set_ylabel("variance")
    panel.legend(fontsize=7, frameon=False)
    run.plot(plot)
    for i, c in enumerate(CS):
        table.append({"c": c, "orders": orders[i], **{f"{law}_{name}": values[i] for (law, name), values in found.items()}})
    run.table(table)
    for known, row in zip(rows_of("series_lengths"), table, strict=True):
        for key, printed in known.items():
            run.expect(f"{key}, c = {known['c']}", printed, row[key])
    for name in PIVOTS:
        run.claim(f"the plain one has a plateau, pivot at the {name}: variance at c = 16 over that at c = 4", Interval.exact(found["bk", name][5] / found["bk", name][3]), above=0.99)
    run.claim("its plateau is higher with the true pivot, over that with the majorant", Interval.exact(found["bk", "truth"][5] / found["bk", "majorant"][5]), above=1)
    slope = slope_of(orders[3:], found["ubk", "truth"][3:])
    run.claim("U-BK falls like 1 / cost: slope from c = 4 on", Interval.exact(slope if slope is not None else math.nan), above=-1.15, below=-0.85)
    run.claim("the two pivots merge: variance with the majorant over that with the truth, c = 16", Interval.exact(found["ubk", "majorant"][5] / found["ubk", "truth"][5]),
              above=0.99, below=1.01)
    names = [f"{e}:pivot=fixed:pivotdepth={p:g}:expansion={c}" + (":tuplesize=1" if e == "u-bk" else "") for e in ("bhanot-kennedy", "u-bk") for p in (2, 1) for c in (2, 8)]
    rows = run.lab("estimate", estimator=names, extinction="cosine", depth=1, trials=run.pick(1_000_000, 100_000))
    run.unbiased(rows, 1e-6)
    shape = cosine((np.arange(100_000) + 0.5) / 100_000)
    spread = float(shape.var() / shape.mean()**2)  # 20 is not quite a whole number of periods: nearly 0.5
    settings = [(law, p, c) for law in (bk_variance, ubk_variance) for p in (2, 1) for c in (2, 8)]
    for row, (law, p, c) in zip(rows, settings, strict=True):
        run.expect(f"measured variance of {row['estimator']}", f"{law(Roulette(c), -p, p - 1, spread, 1.0):.5e}", float(row["variance"]), float(row["variance_stderr"]))
    by_name = {str(r["estimator"]): r for r in rows}
    pair = [by_name["bhanot-kennedy:pivot=fixed:pivotdepth=1:expansion=8"], by_name["u-bk:pivot=fixed:pivotdepth=1:expansion=8:tuplesize=1"]]
    run.claim("in run time, c = 8, true pivot: variance x seconds of the plain one over U-BK's",
              ratio(*(float(r[k]) * float(r["seconds_per_estimate"]) for r in pair for k in ("variance", "variance_stderr"))), above=1)
    run.time_twin(names, extinction="cosine", depth=1)
