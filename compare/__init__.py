# SPDX-License-Identifier: BSD-2-Clause
"""pbrt-compare: settings of a renderer side by side, in error against seconds, look-ups and samples.

`case` says what is compared, `schedule` has it rendered slice by slice, `slices` keeps what was rendered, `analysis` makes
numbers of it, and `report` writes them. docs/comparing.md tells how to use it and what the numbers mean.
"""
