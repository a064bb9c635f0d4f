# SPDX-License-Identifier: BSD-2-Clause
import math

import numpy as np

from figurekit.catalogue import Figure
from figurekit.known import rows_of
from figurekit.run import Run
from figurekit.sphere import sine_line, walk_figure

FIGURE = Figure(
    title="One ray through the analytic medium",
    reported="Estimates may leave [0, 1] and be negative; they are inside the band of one standard deviation most of the time.",
    settings="Central ray of equation 21 (tau = 3.4157), sampling extinction 0.4, main part through 10 equidistant explorers (the paper's are unknown).",
    seconds=20)


def make(run: Run) -> None:
    _, fine = sine_line(40_001)
    square = float(np.mean((fine[1:]**2 + fine[1:] * fine[:-1] + fine[:-1]**2) / 3) * 20)
    depth = float(((fine[1:] + fine[:-1]) / 2).mean() * 20)
    z, density = sine_line()
    run.expect("optical depth of the ray", "3.415684", depth)
    run.expect("transmittance of the ray", "3.28539e-2", math.exp(-depth))
    run.expect("integral of the squared extinction", "1.960753", square)
    run.expect("largest extinction on the ray", "0.95598", float(fine.max()))
    table = run.text_file("ray.csv", "x,density\n" + "".join(f"{a:.9g},{b:.9g}\n" for a, b in zip(z, density)))
    for known in rows_of("sine_ray"):
        rate = float(known["rate"])
        run.expect(f"variance at rate {rate:g}", known["variance"], math.exp(-2 * depth) * math.expm1(square / rate))
        run.expect(f"relative variance at rate {rate:g}", known["relative"], math.expm1(square / rate))
        row, = run.lab("estimate", files=[table], estimator="ratio", extinction=str(table), depth=f"{depth:.12g}", control=f"{rate / float(density.max()):.12g}",
                       trials=run.pick(2_000_000, 200_000))
        run.expect(f"measured look-ups at rate {rate:g}", known["lookups"], float(row["lookups"]), math.sqrt(float(row["lookups"]) / float(row["trials"])))
        if rate >= 0.8:  # below, rare estimates have much of the variance
            run.expect(f"measured variance at rate {rate:g}", known["variance"], float(row["variance"]), float(row["variance_stderr"]))
    walk_figure(run, z, density, 0.4, math.exp(-2 * depth) * math.expm1(square / 0.4))
