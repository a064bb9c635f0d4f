#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Checks that the tree is the house that docs/architecture.md draws; exit 1 when it is not.

  - Rooms: the table "Rooms" names every folder of src/, bottom first, and the table "Folders in rooms" every folder in
    them. Every project include names a room that the including room may use; libraries stay behind the rooms below.
  - Lists: every source and test is named by the CMakeLists.txt of its room, once.
  - Every header has #pragma once, every file the licence line.

Usage: check_house.py [root]
"""
import pathlib
import re
import sys

# Headers of these libraries stay behind these rooms.
GUARDED = {"embree3/": {"accelerators"}, "OpenEXR/": {"image"}, "png.h": {"image"}, "CLI/": {"main", "tools"},
           "nanovdb/": {"fields"}, "blosc.h": {"fields"}, "httplib.h": {"display"}, "mpi.h": {"mpi"}}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
LICENCE = "// SPDX-License-Identifier: BSD-2-Clause\n"
SOURCES = (".h", ".cpp")


class Plan:
    """The rooms of docs/architecture.md: levels, bottom first; which peers a room may use; folders in rooms."""

    def __init__(self, text: str):
        self.level: dict[str, int] = {}
        self.peers: dict[str, set[str]] = {}
        self.folders: set[str] = set()
        for number, row in enumerate(self.rows(text, "## Rooms")):
            for room in re.findall(r"`(\w+)`", row[0]):
                self.level[room] = number
            for room, peers in re.findall(r"`(\w+)`→((?:`\w+`(?:, )?)+)", row[-1]):
                self.peers[room] = set(re.findall(r"`(\w+)`", peers))
        for row in self.rows(text, "### Folders in rooms"):
            self.folders.update(re.findall(r"`([\w/]+)`", row[0]))

    @staticmethod
    def rows(text: str, heading: str) -> list[list[str]]:
        """The first table below a heading, without its head."""
        lines = text.split(heading + "\n", 1)[1].splitlines() if heading + "\n" in text else []
        rows = []
        for line in lines:
            if line.startswith("#"):
                break
            if line.startswith("|"):
                rows.append([cell.strip() for cell in line.strip("|").split("|")])
            elif rows:
                break
        return rows[2:]


def sources_of(folder: pathlib.Path) -> list[pathlib.Path]:
    return sorted(p for p in folder.rglob("*") if p.suffix in SOURCES)


def room_problems(root: pathlib.Path, plan: Plan) -> list[str]:
    source = root / "src"
    found = []
    folders = {str(p.parent.relative_to(source)) for p in sources_of(source)}
    for folder in sorted({f for f in folders if "/" in f} ^ plan.folders):
        found.append(f"src/{folder}: {'not in the plan' if folder in folders else 'is in the plan, but not there'}")
    for room in sorted(set(plan.level) - {f.split("/")[0] for f in folders}):
        found.append(f"src/{room}: is in the plan, but not there")
    for path in sources_of(source):
        room = path.relative_to(source).parts[0]
        if room not in plan.level:
            found.append(f"{path}: unknown room {room}")
            continue
        found += include_problems(path, room, plan)
    return found


def include_problems(path: pathlib.Path, room: str, plan: Plan) -> list[str]:
    found = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        bracket, name = match.groups()
        for prefix, rooms in GUARDED.items():
            if name.startswith(prefix) and room not in rooms:
                found.append(f"{path}:{number}: <{name}> belongs to {', '.join(sorted(rooms))}")
        if bracket == "<":
            continue
        if name.endswith(".cpp"):
            found.append(f"{path}:{number}: \"{name}\" is a source, which its list compiles")
        target = name.split("/")[0]
        if target not in plan.level:
            found.append(f"{path}:{number}: \"{name}\" is not rooted at src/")
        elif target != room and plan.level[target] > plan.level[room]:
            found.append(f"{path}:{number}: {room} may not include {target} (it points up)")
        elif (target != room and plan.level[target] == plan.level[room]
              and target not in plan.peers.get(room, set())):
            found.append(f"{path}:{number}: {room} may not include its peer {target}")
    return found


def text_problems(paths: list[pathlib.Path]) -> list[str]:
    found = []
    for path in paths:
        text = path.read_text()
        if not text.startswith(LICENCE):
            found.append(f"{path}:1: no licence line")
        # A -inl.h is compiled once per instruction set, with a guard that flips.
        guard = "HWY_TARGET_TOGGLE" if path.name.endswith("-inl.h") else "#pragma once"
        if path.suffix == ".h" and guard not in text:
            found.append(f"{path}:1: no {guard}")
    return found


def list_problems(root: pathlib.Path, top: str) -> list[str]:
    """Sources below `top` that the list of their room does not name exactly once, and names of no source."""
    named: dict[pathlib.Path, int] = {}
    found = []
    for listing in sorted((root / top).rglob("CMakeLists.txt")):
        text = re.sub(r"#.*", "", listing.read_text())
        # A command that says more of a source does not list it.
        text = re.sub(r"set_source_files_properties\([^)]*\)", "", text)
        for name in re.findall(r"[\w./-]+\.cpp\b", re.sub(r"\$\{\w+\}[\w./-]*", "", text)):
            path = (listing.parent / name).resolve()
            named[path] = named.get(path, 0) + 1
            if path.exists() and listing.parent.resolve() not in path.parents:
                found.append(f"{listing}: lists {name} of another room")
    for path in sources_of(root / top):
        count = named.pop(path.resolve(), 0)
        if path.suffix == ".cpp" and count != 1:
            found.append(f"{path}: {'in no list' if count == 0 else 'listed more than once'}")
    return found + [f"{path}: is listed, but not there" for path in named if not path.exists()]


def problems(root: pathlib.Path) -> list[str]:
    plan = Plan((root / "docs" / "architecture.md").read_text())
    found = room_problems(root, plan)
    for top in ("src", "tests"):
        if (root / top).is_dir():
            found += text_problems(sources_of(root / top)) + list_problems(root, top)
    return found


def main() -> int:
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    found = problems(root)
    for problem in found:
        print(problem)
    print(f"{len(found)} problems of the house")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
