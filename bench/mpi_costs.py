#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""What ranks of pbrt-mpi on this machine lose by being several: seconds of waiting and moving data, by pass and rank, and bytes.

  mpi_costs.py PBRT_MPI [--mpirun mpirun] [--ranks 2 3 4] [--edge N] [--spp N] [--page FILE.md]

Three renders, whose passes differ: of many samples (`volpath`), of one sample each (bounds that are learned), with light that goes to other pixels
(`bdpt`). Numbers are those of --stats: each rank's own. With more ranks than processors waiting is mostly that for the processor. --page writes the
table between `<!-- table ranks -->` and `<!-- end -->` of a page (docs/scaling.md); else it is printed.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SCENE = """Film "image" "integer xresolution" EDGE "integer yresolution" EDGE
PixelFilter "gaussian"
Sampler "halton"
Integrator "INTEGRATOR"
LookAt .5 .5 -2  .5 .5 0  0 1 0 Camera "perspective" "float fov" 40
WorldBegin
LightSource "infinite" "rgb L" [ .5 .7 1 ]
LightSource "point" "point from" [ 2 3 -1 ] "rgb I" [ 9 8 7 ]
MakeNamedMedium "fog" "rgb sigma_s" [ 9 8 7 ] "rgb sigma_a" [ .5 .5 .5 ] MEDIUM
Material "none" MediumInterface "fog" ""
Translate .5 .5 .5 Shape "sphere" "float radius" .9
WorldEnd
"""
FOG = '"string type" "homogeneous"'
LEARNED = '"string type" "perlin" "integer octaves" 3 "float frequency" 3 "integer supervoxels" 16 "string bounds" "progressive"'
RENDERS = {"`volpath`": ("volpath", FOG), "learned bounds": ("volpath", LEARNED), "`bdpt`": ("bdpt", FOG)}
COLUMNS = ["render", "ranks", "passes", "KB sent in a pass, by rank", "ms of waiting in a pass, by rank", "ms of moving in a pass, by rank",
           "seconds of rendering", "of them lost, by rank"]


def scene(integrator: str, medium: str, edge: int) -> str:
    return SCENE.replace("INTEGRATOR", integrator).replace("MEDIUM", medium).replace("EDGE", str(edge))


def by_rank(ranks: list[dict], value, digits: int = 1) -> str:
    return " / ".join(f"{value(rank):.{digits}f}" for rank in ranks)


def row_of(name: str, statistics: dict) -> list[str]:
    """A row of the table, of what --stats tells of one render."""
    ranks, wall = statistics["ranks"], statistics["seconds"]["render"]["wall"]
    passes = max(1, ranks[0]["passes"])
    return [name, str(len(ranks)), str(ranks[0]["passes"]), by_rank(ranks, lambda r: r["bytesSent"] / passes / 1e3),
            by_rank(ranks, lambda r: 1e3 * r["secondsWaiting"] / passes, 2), by_rank(ranks, lambda r: 1e3 * r["secondsMoving"] / passes, 2),
            f"{wall:.2f}", by_rank(ranks, lambda r: 100 * r["secondsLost"] / max(wall, 1e-9), 0) + " %"]


def markdown(rows: list[list[str]]) -> str:
    lines = [COLUMNS, ["---"] * len(COLUMNS), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def filled(page: str, table: str) -> str:
    """The page with the table in its place."""
    text, count = re.subn(r"(?s)(?<=<!-- table ranks -->\n).*?(?=<!-- end -->)", lambda _: table, page)
    if count != 1:
        sys.exit("error: the page has no place <!-- table ranks --> ... <!-- end -->")
    return text


def measure(o: argparse.Namespace, folder: pathlib.Path, ranks: int, integrator: str, medium: str) -> dict:
    (folder / "scene.pbrt").write_text(scene(integrator, medium, o.edge))
    command = [o.mpirun, "--oversubscribe", "-n", str(ranks), os.path.abspath(o.pbrt_mpi), "--quiet", "--nthreads", "1", "--spp", str(o.spp),
               "--outfile", "image.exr", "--stats", "statistics.json", "scene.pbrt"]
    # Open MPI asks root whether it means it.
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"error: {' '.join(command)}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return json.loads((folder / "statistics.json").read_text())["renders"][0]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pbrt_mpi")
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--ranks", type=int, nargs="+", default=[2, 3, 4])
    parser.add_argument("--edge", type=int, default=128, help="pixels of the image each way")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--page", type=pathlib.Path)
    o = parser.parse_args()
    if min(o.ranks) < 2:
        parser.error("one rank has nobody to wait for: --ranks 2 or more")
    rows = []
    with tempfile.TemporaryDirectory() as name:
        for render, (integrator, medium) in RENDERS.items():
            for ranks in o.ranks:
                rows.append(row_of(render, measure(o, pathlib.Path(name), ranks, integrator, medium)))
                print(" | ".join(rows[-1]), file=sys.stderr, flush=True)
    if o.page:
        o.page.write_text(filled(o.page.read_text(), markdown(rows)))
    else:
        print(markdown(rows), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
