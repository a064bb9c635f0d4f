#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Says which tests were skipped and why: skipped_tests.py [--configured LOG] NAME=REPORT.xml...

REPORT.xml is what `ctest --output-junit` wrote of the run NAME; LOG what cmake printed, where it says what is left out of
the build. Instances of one test are counted together. Says so when nothing was skipped.
"""
import argparse
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree


def reason_of(output: str) -> str:
    """What a test said when it skipped itself: the lines after `Skipped` up to GoogleTest's own next line."""
    said = re.search(r"(?m)^.*: Skipped\n(.*(?:\n(?!\[|$).*)*)", output)
    return " ".join(said[1].split()) if said and said[1].strip() else "no reason given"


def test_of(name: str) -> str:
    """Name of a test without its instance: `Scenes/Parity.AgreesWithPbrt/smoke` is `Parity.AgreesWithPbrt`."""
    test = re.sub(r"^\w+/(?=[A-Za-z]\w*[./])", "", name.partition("  #")[0])
    return re.sub(r"(?<=\w)/[\w-]+(?=\.|$)", "", test)


def skipped(report: str) -> tuple[int, dict[str, dict[str, int]]]:
    """How many tests there were; by reason and test, how many were skipped."""
    cases = list(ElementTree.fromstring(report).iter("testcase"))
    found: dict[str, dict[str, int]] = {}
    for case in cases:
        if case.find("skipped") is None:
            continue
        tests = found.setdefault(reason_of(case.findtext("system-out") or ""), {})
        test = test_of(case.get("name", ""))
        tests[test] = tests.get(test, 0) + 1
    return len(cases), found


def left_out(log: str) -> list[str]:
    return [line.removeprefix("-- ").strip() for line in log.splitlines() if "left out" in line or "cannot be read" in line]


def summary(name: str, report: str) -> list[str]:
    total, found = skipped(report)
    count = sum(sum(tests.values()) for tests in found.values())
    lines = [f"{name}: {count or 'none'} of {total} tests skipped"]
    for reason, tests in sorted(found.items()):
        names = ", ".join(f"{test} ({n})" if n > 1 else test for test, n in sorted(tests.items()))
        lines.append(f"  {reason}: {names}")
    return lines


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--configured", metavar="LOG", type=pathlib.Path)
    parser.add_argument("reports", nargs="+", metavar="NAME=REPORT.xml")
    options = parser.parse_args()
    for report in options.reports:
        name, _, path = report.partition("=")
        print(*summary(name, pathlib.Path(path).read_text(errors="replace")), sep="\n")
    if options.configured and options.configured.is_file():
        for line in left_out(options.configured.read_text(errors="replace")):
            print(f"not built: {line}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
