# SPDX-License-Identifier: BSD-2-Clause
"""Figures that cannot be made yet, and why. All are there."""

NOT_THERE: dict[str, str] = {}
