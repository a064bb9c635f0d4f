#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""The list of skipped tests must name every one of them, with its reason."""
import unittest

import skipped_tests


def case(name: str, output: str = "", skipped: bool = False) -> str:
    mark = '<skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>' if skipped else ""
    return f'<testcase name="{name}">{mark}<system-out>{output}</system-out></testcase>'


def report(*cases: str) -> str:
    return "<testsuite>" + "".join(cases) + "</testsuite>"


NO_SCENES = """[ RUN      ] Scenes/Parity.Agrees/smoke
a.cpp:59: Skipped
the scenes are not
beside this checkout

[  SKIPPED ] Scenes/Parity.Agrees/smoke (0 ms)
"""
NO_CLAIM = "a.cpp:7: Skipped\nmakes no such claim\n[  SKIPPED ] All/Contract.Keeps/Delta (0 ms)\n"
SILENT = "a.cpp:7: Skipped\n\n[  SKIPPED ] Files.Full (0 ms)\n"


class SkippedTests(unittest.TestCase):
    def test_names_reasons_and_counts_instances(self):
        text = skipped_tests.summary("release", report(
            case("Scenes/Parity.Agrees/smoke  # GetParam() = smoke", NO_SCENES, True),
            case("Scenes/Parity.Agrees/own-hair  # GetParam() = own-hair", NO_SCENES, True),
            case("Box.HasFaces"),
            case("All/Contract.Keeps/Delta  # GetParam() = &quot;delta&quot;", NO_CLAIM, True),
            case("Typed/0.Adds", SILENT, True)))
        self.assertEqual(text, [
            "release: 4 of 5 tests skipped",
            "  makes no such claim: Contract.Keeps",
            "  no reason given: Typed.Adds",
            "  the scenes are not beside this checkout: Parity.Agrees (2)"])

    def test_says_so_when_none_was_skipped(self):
        self.assertEqual(skipped_tests.summary("asan", report(case("Box.HasFaces"))), ["asan: none of 1 tests skipped"])

    def test_a_word_in_the_output_of_a_test_that_ran_is_no_skip(self):
        self.assertEqual(skipped_tests.summary("asan", report(case("Box.HasFaces", NO_CLAIM))),
                         ["asan: none of 1 tests skipped"])

    def test_tells_what_was_not_built(self):
        log = "-- Found PNG\n-- NanoVDB not found (libnanovdb-dev): the medium and its tests are left out\n"
        self.assertEqual(skipped_tests.left_out(log),
                         ["NanoVDB not found (libnanovdb-dev): the medium and its tests are left out"])


if __name__ == "__main__":
    unittest.main()
