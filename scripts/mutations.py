#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Plants small faults, one at a time, and requires that a test notices each. The faults stand in scripts/mutations.txt.

  mutations.py list                    checks the list: every text occurs exactly once, every room has faults
  mutations.py run [NAME...]           builds and tests with each fault (all, or those named)
      --count N --seed S               N of them, drawn by the seed (another each time, which is printed)
      --new                            only those that are not known to be noticed
      --record                         keeps the results in docs/mutations.csv and writes docs/mutations.md
  mutations.py docs                    writes docs/mutations.md from the list and the results

`run` works on a copy of the tracked files, build/mutations/tree, and builds only the test files that the faults name. A
fault is red when a test fails, crashes or hangs, or a static_assert stops the build. Without a fault all must be green.
"""
import argparse
import csv
import dataclasses
import hashlib
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import time

import check_house

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = "scripts/mutations.txt"
RESULTS = "docs/mutations.csv"
PAGE = "docs/mutations.md"
TIME_LIMIT = 300  # seconds of one test program; a hang is red
SHOWN_TESTS = 3


class ListError(Exception):
    """Something in the list that is no fault to plant."""


@dataclasses.dataclass(frozen=True)
class Mutation:
    name: str
    words: str  # what the fault is
    path: str
    before: str
    after: str
    test: str  # below tests/
    filter: str  # of gtest

    def key(self) -> str:
        """Of what a result is a result of."""
        parts = (self.path, self.before, self.after, self.test, self.filter)
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:12]

    def room(self) -> str:
        """The room, or the folder of a room, that the fault is in."""
        folder = pathlib.PurePosixPath(self.path).parent
        return str(folder.relative_to("src")) if folder.parts[0] == "src" else folder.parts[0]


def parse(text: str) -> list[Mutation]:
    """Blocks between blank lines: `name: words`, `in PATH`, lines of `- before` and `+ after`, `by TEST FILTER`."""
    mutations = []
    for block in re.split(r"\n\s*\n", re.sub(r"(?m)^#.*\n?", "", text).strip()):
        lines = block.splitlines()
        head = re.fullmatch(r"([\w-]+): (.+)", lines[0])
        fields: dict[str, list[str]] = {"in": [], "-": [], "+": [], "by": []}
        for line in lines[1:]:
            word, _, rest = line.partition(" ")
            if word not in fields:
                raise ListError(f"{lines[0]}: expected in, -, + or by, found \"{line}\"")
            fields[word].append(rest)
        by = fields["by"][0].split() if len(fields["by"]) == 1 else []
        if not head or len(fields["in"]) != 1 or not fields["-"] or len(by) != 2:
            raise ListError(f"{lines[0]}: expected \"name: words\" and then in, -, + and by with a test and a filter")
        before, after = "\n".join(fields["-"]), "\n".join(fields["+"])
        mutations.append(Mutation(head[1], head[2], fields["in"][0], before, after, *by))
    return mutations


def programs(root: pathlib.Path) -> dict[str, str]:
    """Test program of each test file below tests/, from the lists of the rooms."""
    found = {}
    listed = re.compile(r"room_test\(\s*(\w+)\s+SOURCES\s+([\w\s./]+?)\s+(?:DEPENDS|LIBRARIES|LABEL)")
    for listing in sorted((root / "tests").glob("*/CMakeLists.txt")):
        text = re.sub(r"#.*", "", listing.read_text())
        for name, sources in listed.findall(text):
            for source in sources.split():
                found[f"{listing.parent.name}/{source}"] = name
    return found


def list_problems(root: pathlib.Path, mutations: list[Mutation]) -> list[str]:
    found, names, keys = [], set(), set()
    tests = programs(root)
    for m in mutations:
        where = f"{LIST}: {m.name}: "
        if m.name in names or m.key() in keys:
            found.append(where + "stands twice in the list")
        names.add(m.name)
        keys.add(m.key())
        if m.before == m.after:
            found.append(where + "changes nothing")
        if not m.path.startswith(("src/", "exporters/")) or not (root / m.path).is_file():
            found.append(where + f"there is no {m.path}")
        elif (count := (root / m.path).read_text().count(m.before)) != 1:
            found.append(where + f"\"{m.before}\" occurs {count} times in {m.path}, expected once")
        if m.test not in tests:
            found.append(where + f"tests/{m.test} is in no list of tests")
    plan = check_house.Plan((root / "docs" / "architecture.md").read_text())
    rooms = {m.room() for m in mutations}
    for room in [*plan.level, *plan.folders, "exporters"]:
        if not any(r == room or r.startswith(room + "/") for r in rooms):
            found.append(f"{LIST}: no fault is planted in {room}")
    return found


def read_results(root: pathlib.Path) -> dict[str, list[str]]:
    """Rows by the key of the mutation: key, name, red or green, what noticed it."""
    path = root / RESULTS
    if not path.is_file():
        return {}
    with path.open(newline="") as file:
        return {row[0]: row for row in list(csv.reader(file))[1:]}


def write_results(root: pathlib.Path, mutations: list[Mutation], results: dict[str, list[str]]):
    with (root / RESULTS).open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["key", "name", "result", "noticed by"])
        out.writerows(results[m.key()] for m in mutations if m.key() in results)


def page(mutations: list[Mutation], results: dict[str, list[str]]) -> str:
    def code(text: str) -> str:
        return "`" + " ".join(text.split()).replace("|", "\\|") + "`" if text.strip() else "nothing"

    rows = []
    counts = {"red": 0, "green": 0, "not run": 0}
    for m in mutations:
        _, _, result, noticed = results.get(m.key(), [m.key(), m.name, "not run", ""])
        counts[result] += 1
        rows.append(f"| {m.words} | `{m.path}` | {code(m.before)} → {code(m.after)} | {result} | {noticed} |")
    said = ", ".join(f"{n} {result}" for result, n in counts.items() if n > 0)
    return "\n".join([
        "# Planted faults", "",
        "Faults that `scripts/mutations.py` plants, one at a time, to see whether a test notices. `./check` draws five of",
        "them anew each time. The list is `scripts/mutations.txt`; this page is written by `scripts/mutations.py docs`, its",
        "results by `scripts/mutations.py run --record`.", "",
        f"{len(mutations)} faults: {said}.", "",
        "| fault | file | change | result | noticed by |", "| --- | --- | --- | --- | --- |", *rows, ""])


def write_page(root: pathlib.Path, mutations: list[Mutation]):
    (root / PAGE).write_text(page(mutations, read_results(root)))


# One program for each test file, linked like the program of its room: a fault in a header recompiles that file alone.
ALONE = """
function(test_alone name program)
  if(NOT TARGET test_${program})
    return()
  endif()
  add_executable(${name} ${ARGN})
  foreach(property LINK_LIBRARIES COMPILE_DEFINITIONS COMPILE_OPTIONS INCLUDE_DIRECTORIES)
    get_target_property(value test_${program} ${property})
    if(value)
      set_target_properties(${name} PROPERTIES ${property} "${value}")
    endif()
  endforeach()
  get_target_property(value test_${program} MANUALLY_ADDED_DEPENDENCIES)
  if(value)
    add_dependencies(${name} ${value})
  endif()
endfunction()
"""


def target_of(test: str) -> str:
    return "alone_" + test.removesuffix(".cpp").replace("/", "_")


def alone_lists(root: pathlib.Path, tests: list[str]) -> str:
    of_file = programs(root)
    text = ALONE
    for test in sorted(set(tests)):
        folder = test.split("/")[0]
        helpers = [t for t, p in of_file.items() if p == of_file[test] and not t.endswith("_test.cpp")]
        sources = " ".join([test, *(h for h in helpers if h.split("/")[0] == folder)])
        text += f"test_alone({target_of(test)} {of_file[test]} {sources})\n"
    return text


class Tree:
    """A copy of the checkout below build/ in which things may be changed, and its build. `alone`: CMake's list of
    programs of one test file."""

    def __init__(self, root: pathlib.Path, alone: str, folder: str = "mutations"):
        self.root = root
        self.alone = alone
        self.tree = root / "build" / folder / "tree"
        self.build = self.tree / "build" / "release"
        self.jobs = str(os.cpu_count() or 1)
        self.environment = os.environ | {"CCACHE_BASEDIR": str(self.tree), "CCACHE_NOHASHDIR": "1",
                                         "CCACHE_SLOPPINESS": "time_macros"}
        self.synchronise()

    def names(self) -> set[str]:
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=self.root, check=True, capture_output=True).stdout
        return {n for n in listed.decode().split("\0") if n and (self.root / n).is_file()}

    def content(self, name: str) -> bytes:
        content = (self.root / name).read_bytes()
        return content + self.alone.encode() if name == "tests/CMakeLists.txt" else content

    def synchronise(self):
        """Only what differs is written, so that only that is built anew."""
        names = self.names()
        for name in names:
            content = self.content(name)
            copy = self.tree / name
            if copy.is_file() and copy.read_bytes() == content:
                continue
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
            if (self.root / name).is_file():
                copy.chmod((self.root / name).stat().st_mode)
        for top in [t for t in self.tree.iterdir() if t.name != "build"]:
            for path in [top] if top.is_file() else list(top.rglob("*")):
                if path.is_file() and str(path.relative_to(self.tree)) not in names:
                    path.unlink()

    def configure(self):
        if (self.build / "build.ninja").is_file():
            return
        self.must(["cmake", "--preset", "release", "-DPBRT_MEDIA_TESTS=ON"])

    def must(self, command: list[str]):
        done = self.call(command)
        if done.returncode != 0:
            sys.exit(f"error: {' '.join(command[:3])} … failed:\n{done.stdout[-4000:]}")

    def call(self, command: list[str]) -> subprocess.CompletedProcess:
        return subprocess.run(command, cwd=self.tree, env=self.environment, text=True, errors="replace",
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def targets(self) -> set[str]:
        listed = self.call(["ninja", "-C", str(self.build), "-t", "targets", "all"]).stdout
        return set(re.findall(r"(?m)^(alone_\w+):", listed))

    def ninja(self, targets: list[str]) -> subprocess.CompletedProcess:
        return self.call(["ninja", "-C", str(self.build), "-j", self.jobs, *targets])

    def failures(self, m: Mutation) -> list[str]:
        """Tests that fail; empty when all pass. At least one must run."""
        report = self.build / "mutation.json"
        report.unlink(missing_ok=True)
        command = [str(self.build / "bin" / target_of(m.test)), f"--gtest_filter={m.filter}", "--gtest_brief=1",
                   f"--gtest_output=json:{report}"]
        try:
            done = subprocess.run(command, cwd=self.tree, env=self.environment, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, timeout=TIME_LIMIT)
        except subprocess.TimeoutExpired:
            return ["a hang"]
        if not report.is_file():
            return [f"a crash (status {done.returncode})"]
        cases = [c for suite in json.loads(report.read_text())["testsuites"] for c in suite["testsuite"]]
        failed = [f"{c['classname']}.{c['name']}" for c in cases if c.get("failures")]
        if not any(c.get("result") == "COMPLETED" for c in cases):
            raise ListError(f"{m.name}: {m.filter} runs no test of tests/{m.test}")
        return failed if done.returncode != 0 else []

    def attempt(self, m: Mutation) -> list[str]:
        """What notices the fault; empty when nothing does."""
        path = self.tree / m.path
        whole = path.read_text()
        path.write_text(whole.replace(m.before, m.after))
        try:
            built = self.ninja([target_of(m.test)])
            if built.returncode != 0:
                if re.search(r"static[ _]assert", built.stdout):
                    return ["the compiler (static_assert)"]
                raise ListError(f"{m.name}: does not compile:\n{built.stdout[-4000:]}")
            return self.failures(m)
        finally:
            path.write_text(whole)


def shown(failures: list[str]) -> str:
    # Without the numbers and words of instances.
    tests = sorted({re.sub(r"/\w+$|/\d+(?=\.)", "", f) for f in failures})
    more = f" and {len(tests) - SHOWN_TESTS} more" if len(tests) > SHOWN_TESTS else ""
    return ", ".join(tests[:SHOWN_TESTS]) + more


def run(root: pathlib.Path, mutations: list[Mutation], chosen: list[Mutation], record: bool) -> int:
    tree = Tree(root, alone_lists(root, [m.test for m in mutations]))
    tree.configure()
    tree.must(["cmake", "--build", str(tree.build), "--target", "build.ninja"])
    known = tree.targets()
    for m in [m for m in chosen if target_of(m.test) not in known]:
        print(f"{m.name}: left out, tests/{m.test} is not built on this machine", flush=True)
    chosen = [m for m in chosen if target_of(m.test) in known]
    print(f"building {len({m.test for m in chosen})} test files without a fault", flush=True)
    tree.must(["ninja", "-C", str(tree.build), "-j", tree.jobs, *sorted({target_of(m.test) for m in chosen})])
    green, broken = [], []
    unplanted: dict[tuple[str, str], str] = {}  # what fails without a fault, by test and filter
    for m in chosen:
        if (m.test, m.filter) not in unplanted:
            try:
                unplanted[m.test, m.filter] = shown(tree.failures(m))
            except ListError as error:
                unplanted[m.test, m.filter] = str(error)
        if wrong := unplanted[m.test, m.filter]:
            print(f"BROKEN {m.name}: fails without the fault: {wrong}", flush=True)
            broken.append(m.name)
    chosen = [m for m in chosen if m.name not in broken]
    for m in chosen:
        start = time.monotonic()
        try:
            failures = tree.attempt(m)
        except ListError as error:
            print(f"BROKEN {error}", flush=True)
            broken.append(m.name)
            continue
        result = "red" if failures else "green"
        seconds = time.monotonic() - start
        print(f"{result:5} {m.name} ({seconds:.0f} s): {shown(failures) or 'nobody noticed'}", flush=True)
        if not failures:
            green.append(m.name)
        if record:
            results = read_results(root)
            results[m.key()] = [m.key(), m.name, result, shown(failures)]
            write_results(root, mutations, results)
    if record:
        write_page(root, mutations)
    print(f"{len(chosen)} faults, {len(green)} unnoticed, {len(broken)} that could not be planted")
    for name in green + broken:
        print(f"  again: scripts/mutations.py run {name}")
    return 1 if green or broken else 0


def choose(mutations: list[Mutation], names: list[str], count: int | None, seed: int) -> list[Mutation]:
    unknown = set(names) - {m.name for m in mutations}
    if unknown:
        raise ListError(f"no fault is called {', '.join(sorted(unknown))}")
    chosen = [m for m in mutations if not names or m.name in names]
    return chosen if count is None else random.Random(seed).sample(chosen, min(count, len(chosen)))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("list")
    commands.add_parser("docs")
    runs = commands.add_parser("run")
    runs.add_argument("names", nargs="*", metavar="NAME")
    runs.add_argument("--count", type=int)
    runs.add_argument("--seed", type=int)
    runs.add_argument("--new", action="store_true")
    runs.add_argument("--record", action="store_true")
    options = parser.parse_args()
    try:
        mutations = parse((ROOT / LIST).read_text())
        if options.command == "docs":
            write_page(ROOT, mutations)
            return 0
        problems = list_problems(ROOT, mutations)
        if options.command == "list" and page(mutations, read_results(ROOT)) != (ROOT / PAGE).read_text():
            problems.append(f"{PAGE}: is not what scripts/mutations.py docs writes")
        if problems:
            print(*problems, sep="\n")
            return 1
        if options.command == "list":
            print(f"{len(mutations)} faults to plant, in every room")
            return 0
        known = {key for key, row in read_results(ROOT).items() if row[2] == "red"} if options.new else set()
        seed = options.seed or random.SystemRandom().randrange(1, 1 << 31)
        chosen = choose([m for m in mutations if m.key() not in known], options.names, options.count, seed)
        if options.count is not None:
            print(f"{len(chosen)} of {len(mutations)} faults, seed {seed} (the same again: "
                  f"scripts/mutations.py run --count {options.count} --seed {seed})", flush=True)
        return run(ROOT, mutations, chosen, options.record)
    except ListError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
