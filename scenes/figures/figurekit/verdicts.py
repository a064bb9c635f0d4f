# SPDX-License-Identifier: BSD-2-Clause
"""What became of a claim."""
import math
from dataclasses import dataclass

from .intervals import Interval

REPRODUCED, NOT_REPRODUCED, UNTESTED = "reproduced", "not reproduced", "cannot be tested"


@dataclass(frozen=True)
class Verdict:
    claim: str
    number: str          # ours, with its interval
    outcome: str
    why: str             # "" where the number says all

    def line(self) -> str:
        return f"{self.claim}: {self.number}: {self.outcome}" + (f" ({self.why})" if self.why else "")


def judge(claim: str, number: Interval, *, above: float = -math.inf, below: float = math.inf, unit: str = "", why: str = "") -> Verdict:
    """`number` is claimed to lie between `above` and `below`. All of the interval has to; when only a part does, more trials are wanted and nothing
    is said. `why` explains a failure."""
    text = number.text() + (f" {unit}" if unit else "")
    if math.isnan(number.value):
        return Verdict(claim, text, UNTESTED, "there is no number")
    if above < number.low and number.high < below:
        return Verdict(claim, text, REPRODUCED, "")
    if number.high <= above or number.low >= below:
        return Verdict(claim, text, NOT_REPRODUCED, why)
    limits = " and ".join(f"{v:g}" for v in (above, below) if math.isfinite(v))
    return Verdict(claim, text, UNTESTED, f"the interval reaches across {limits}: more trials would tell")
