#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Counts includes that break the direction of docs/architecture.md; exit 1 when there is any.

Checks: every project include names a room that the including room may use; Embree is included by accelerators only;
every header has #pragma once and every source file the licence line. Usage: check_includes.py [source folder]
"""
import pathlib
import re
import sys

# Bottom first; each inner list is one level, whose rooms are peers.
LEVELS = [
    ["base"],
    ["spectrum"],
    ["image"],
    ["accelerators"],
    ["filters", "samplers", "film", "cameras", "shapes", "textures", "materials", "lights"],
    ["fields"],
    ["transmittance"],
    ["freeflight"],
    ["media"],
    ["lighting"],
    ["world"],
    ["render"],
    ["integrators"],
    ["scene"],
    ["construct"],
    ["tools"],
    ["main"],
]
PEERS = {
    "film": {"filters"},
    "textures": {"shapes"},
    "materials": {"textures", "shapes"},
    "lights": {"shapes"},
}
# Headers of these libraries stay behind one room.
GUARDED = {"embree3/": {"accelerators"}, "OpenEXR/": {"image"}, "png.h": {"image"}, "CLI/": {"main", "tools"}, "nanovdb/": {"fields"}, "blosc.h": {"fields"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def problems(source: pathlib.Path) -> list[str]:
    level = {room: i for i, rooms in enumerate(LEVELS) for room in rooms}
    found = []
    for path in sorted(source.rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        room = path.relative_to(source).parts[0]
        if room not in level:
            found.append(f"{path}: unknown room {room}")
            continue
        text = path.read_text()
        if not text.startswith("// SPDX-License-Identifier: BSD-2-Clause\n"):
            found.append(f"{path}:1: no licence line")
        # A -inl.h is compiled once per instruction set, with a guard that flips.
        guard = "HWY_TARGET_TOGGLE" if path.name.endswith("-inl.h") else "#pragma once"
        if path.suffix == ".h" and guard not in text:
            found.append(f"{path}:1: no {guard}")
        for number, line in enumerate(text.splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            bracket, name = match.groups()
            for prefix, rooms in GUARDED.items():
                if name.startswith(prefix) and room not in rooms:
                    found.append(f"{path}:{number}: <{name}> belongs to {', '.join(sorted(rooms))}")
            if bracket == "<":
                continue
            target = name.split("/")[0]
            if target not in level:
                found.append(f"{path}:{number}: \"{name}\" is not rooted at src/")
            elif target != room and level[target] > level[room]:
                found.append(f"{path}:{number}: {room} may not include {target} (it points up)")
            elif target != room and level[target] == level[room] and target not in PEERS.get(room, set()):
                found.append(f"{path}:{number}: {room} may not include its peer {target}")
    return found


def main() -> int:
    source = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "src")
    found = problems(source)
    for problem in found:
        print(problem)
    print(f"{len(found)} include problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
