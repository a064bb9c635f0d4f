#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# scripts/make_plume.sh BIN: makes scenes/data/plume.nvdb, the smoke of scenes/nanovdb.pbrt, by the programs
# example_volume and vdb2pbrt of the folder BIN. 8 bits a voxel, zipped.
set -euo pipefail
bin=$(cd "${1:?usage: scripts/make_plume.sh BIN (the folder of example_volume and vdb2pbrt)}" && pwd)
data=$(cd "$(dirname "${BASH_SOURCE[0]}")/../scenes/data" && pwd)
made=$(mktemp -d)
trap 'rm -r "$made"' EXIT
"$bin/example_volume" "$made"
"$bin/vdb2pbrt" "$made/plume.vdb" --precision fp8 --zip --quiet --outfile "$made/plume.pbrt"
cp "$made/plume.nvdb" "$data/plume.nvdb"
echo "$data/plume.nvdb: $(stat -c %s "$data/plume.nvdb") bytes"
