# SPDX-License-Identifier: BSD-2-Clause
"""Figures that cannot be made yet, and why."""

NOT_THERE = {
    "georgiev-2019-01": "it needs a scene of our own like the paper's chess game, whose models are not public",
    "kettunen-2021-01": "it needs our own smoke in glass, measured only on paths of two transmissions in a row, which no integrator tells apart",
    "kettunen-2021-11": "it needs four volumes of our own (plume, box, cloud, glass); the plume alone is there, see figure 16",
    "szirmay-kalos-2017-11": "light samples driven by attenuation, source and scattering are not in the renderer yet",
    "szirmay-kalos-2017-12": "as figure 11",
    "misso-2022-10": "debiased photon mapping is not in the renderer yet",
    "misso-2022-11": "debiased photon mapping is not in the renderer yet",
    "misso-2022-12": "debiased photon mapping is not in the renderer yet",
}
