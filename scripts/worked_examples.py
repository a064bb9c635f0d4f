#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Does what the worked examples of docs/architecture.md say, and sees whether it works.

  worked_examples.py          all of them, in a copy of the tracked files (build/examples/tree)
  worked_examples.py list     only reads them: files and texts that they name must be there

Each example is a list of steps under a heading of the section "Worked examples". Steps that the script does:

  copy `A` to `B`, with `X` for `x` and `Y` for `y`     a file under another name, words replaced
  in `A` put `NEW` after `OLD`                          OLD occurs exactly once; "for" instead of "after": in its place
  run `COMMAND`: `WORD`                                 in the build folder, after building; its output has the word

A text of several lines is written with \\n between them, a backtick in a text as \\'. All examples are done in one tree, so that what they have in common
is built once. Tests run from programs of one test file each, alone_FOLDER_FILE, as in scripts/mutations.py.
"""
import dataclasses
import pathlib
import re
import shlex
import subprocess
import sys
import time

import mutations

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = "docs/architecture.md"


class ExampleError(Exception):
    """A step that cannot be done as it stands."""


@dataclasses.dataclass
class Example:
    title: str
    copies: list[tuple[str, str, list[tuple[str, str]]]] = dataclasses.field(default_factory=list)
    edits: list[tuple[str, str, str]] = dataclasses.field(default_factory=list)  # file, text there, text instead
    runs: list[tuple[str, str]] = dataclasses.field(default_factory=list)


def parse(page: str) -> list[Example]:
    section = re.search(r"(?ms)^## Worked examples\n(.*?)(?=^## |\Z)", page)
    if not section:
        raise ExampleError(f"{PAGE}: no section \"Worked examples\"")
    examples = []
    for part in re.split(r"(?m)^### ", section[1])[1:]:
        title, _, body = part.partition("\n")
        example = Example(title.strip())
        for step in re.findall(r"(?ms)^\d+\. (.*?)(?=^\d+\. |^$|\Z)", body):
            text = " ".join(step.split())
            said = [q.replace("\\n", "\n").replace("\\'", "`") for q in re.findall(r"`([^`]*)`", text)]
            if text.startswith("copy ") and len(said) >= 2 and len(said) % 2 == 0:
                example.copies.append((said[0], said[1], list(zip(said[3::2], said[2::2]))))
            elif len(said) == 3 and (how := re.fullmatch(r"in `.*?` put `.*?` (after|for) `.*?`", text)):
                path, new, old = said
                example.edits.append((path, old, old + new if how[1] == "after" else new))
            elif text.startswith("run ") and len(said) == 2:
                example.runs.append((said[0], said[1]))
            else:
                raise ExampleError(f"{PAGE}: {example.title}: no step that could be done: {text}")
        if not example.copies or not example.edits or not example.runs:
            raise ExampleError(f"{PAGE}: {example.title}: expected steps that copy, put and run")
        examples.append(example)
    return examples


def apply(tree: dict[str, str], example: Example, read) -> None:
    """Does the steps that change files. `tree`: texts of changed files by path; `read`: text of any other."""
    def text_of(path: str) -> str:
        if path not in tree:
            text = read(path)
            if text is None:
                raise ExampleError(f"{example.title}: there is no {path}")
            tree[path] = text
        return tree[path]

    for source, target, words in example.copies:
        text = text_of(source)
        for old, new in words:
            if old not in text:
                raise ExampleError(f"{example.title}: {source} has no \"{old}\"")
            text = text.replace(old, new)
        if target in tree or read(target) is not None:
            raise ExampleError(f"{example.title}: {target} is there already")
        tree[target] = text
    for path, old, new in example.edits:
        if (count := text_of(path).count(old)) != 1:
            raise ExampleError(f"{example.title}: \"{old}\" occurs {count} times in {path}, expected once")
        tree[path] = tree[path].replace(old, new)


def changed(root: pathlib.Path, examples: list[Example]) -> dict[str, str]:
    tree: dict[str, str] = {}

    def read(path: str) -> str | None:
        return (root / path).read_text() if (root / path).is_file() else None

    for example in examples:
        apply(tree, example, read)
    return tree


class Tree(mutations.Tree):
    """A copy of the checkout in which the examples are done."""

    def __init__(self, root: pathlib.Path, changes: dict[str, str], alone: str):
        self.changes = changes
        super().__init__(root, alone, folder="examples")

    def content(self, name: str) -> bytes:
        return self.changes[name].encode() if name in self.changes else super().content(name)

    def names(self) -> set[str]:
        return super().names() | set(self.changes)


def targets_of(example: Example) -> set[str]:
    return {w for command, _ in example.runs for w in re.findall(r"(?<=bin/)\w+", command)}


def main() -> int:
    try:
        examples = parse((ROOT / PAGE).read_text())
        changes = changed(ROOT, examples)
        if sys.argv[1:] == ["list"]:
            print(f"{len(examples)} worked examples: {', '.join(e.title for e in examples)}")
            return 0
        targets = {t for e in examples for t in targets_of(e)}
        programs = mutations.programs(ROOT)
        tests = [t for t in programs if mutations.target_of(t) in targets]
        start = time.monotonic()
        tree = Tree(ROOT, changes, mutations.alone_lists(ROOT, tests))
        tree.configure()
        tree.must(["ninja", "-C", str(tree.build), "-j", tree.jobs, *sorted(targets)])
        print(f"built {', '.join(sorted(targets))} in {time.monotonic() - start:.0f} s", flush=True)
        failed = 0
        for example in examples:
            for command, word in example.runs:
                done = subprocess.run(shlex.split(command), cwd=tree.build, text=True, errors="replace",
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=mutations.TIME_LIMIT)
                good = done.returncode == 0 and word in done.stdout
                print(f"{'good' if good else 'FAILED':6} {example.title}: {command}: {word}", flush=True)
                if not good:
                    failed = 1
                    print(done.stdout[-3000:])
        return failed
    except ExampleError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
