# SPDX-License-Identifier: BSD-2-Clause
"""Figures that cannot be made yet, and why."""

NOT_THERE = {
    "szirmay-kalos-2017-11": "light samples driven by attenuation, source and scattering are not in the renderer yet",
    "szirmay-kalos-2017-12": "as figure 11",
}
