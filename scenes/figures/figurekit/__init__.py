# SPDX-License-Identifier: BSD-2-Clause
"""What the scripts of scenes/figures share: running programs, keeping what they found, tables, plots, verdicts, and the page of all.

It stands on `compare`, whose intervals and plots it uses.
"""
